//! Bytes that are no plot, or one that is made to be slow or to overflow: each is refused after a bounded search, and nothing is cut in
//! silence. Where a bound is lacking a test goes on for minutes or for ever; none looks at a clock, which would say more of
//! the computer than of the reader.

use cutc::diagnostic::Diagnostics;
use cutc::front::{self, by_name};
use cutc::machine::Job;

use super::{read, rectangle, source};

#[test]
fn a_nesting_that_was_cut_short_is_an_error() {
    let nested: String = (0..20_000).map(|i| rectangle(i, i, 100_000 - 2 * i, 100_000 - 2 * i)).collect();
    assert!(codes(nested.into_bytes()).contains(&"drawing/too-many-lines"));
}

/// The codes of what is found in a plot.
fn codes(bytes: Vec<u8>) -> Vec<&'static str> {
    codes_with(bytes, &Job::default())
}

fn codes_with(bytes: Vec<u8>, job: &Job) -> Vec<&'static str> {
    let source = source(bytes);
    let mut found = Diagnostics::default();
    cutc::pipeline::marker_of(by_name("hpgl").expect("a dialect"), &source, job, &mut found);
    found.iter().map(|diagnostic| diagnostic.code.name).collect()
}

/// Expects that this is found in a drawing.
fn check(what: &str, text: &str, expected: &[&str]) {
    assert_eq!(codes(format!("{text}PU;").into_bytes()), expected, "{what}");
}

#[test]
fn a_hundred_megabytes_of_garbage_are_refused() {
    const SIZE: usize = 100 << 20;
    let mut random = fastrand::Rng::with_seed(8);
    let mut garbage = |pick: &mut dyn FnMut(&mut fastrand::Rng) -> u8| -> Vec<u8> {
        // A stretch is random, and repeated: making it must not take longer than reading it.
        let stretch: Vec<u8> = (0..1 << 16).map(|_| pick(&mut random)).collect();
        stretch.into_iter().cycle().take(SIZE).collect()
    };
    let bytes = garbage(&mut |random| random.u8(..));
    assert_eq!(codes(bytes), ["source/unknown-format"]);
    let text = garbage(&mut |random| random.u8(b' '..=b'~'));
    let found = codes(text.clone());
    assert!(found.iter().any(|code| ["hpgl/not-a-plot", "hpgl/encoding-damaged"].contains(code)), "{found:?}");
    let detected =
        front::choose(&source(text), None, Some("plt"), &mut Diagnostics::default()).map(|dialect| dialect.name);
    assert_ne!(detected, Some("hpgl"));
    for (what, word) in
        [("numbers", "1,"), ("semicolons", ";"), ("labels", "LB"), ("escapes", "\u{1b}%0B"), ("junk", "!?")]
    {
        let bytes: Vec<u8> = word.bytes().cycle().take(SIZE).collect();
        let found = codes(bytes);
        let refused = ["hpgl/not-a-plot", "drawing/nothing-to-cut", "source/unknown-format"];
        assert!(found.iter().any(|code| refused.contains(code)), "{what}: {found:?}");
    }
}

/// Some lines, each by its number.
fn many(count: i64, line: &dyn Fn(i64) -> String) -> String {
    (0..count).map(line).collect()
}

#[test]
fn holes_and_texts_whose_part_was_not_found_in_time_are_said() {
    // All of them overlap in their middle, and none lies in another.
    let parts: String = (0..15_000).map(|i| rectangle(-i, i, 40_000 + 3 * i, 40_000 - 2 * i)).collect();
    let mut drilling = Job::default();
    drilling.profile.hpgl.drill_max_mm = Some(5.0);
    let holes: String =
        (0..15_000).map(|i| rectangle(20_000 + i % 1000 * 20, 20_000 + i / 1000 * 20, 40, 40)).collect();
    let found = codes_with(format!("{parts}{holes}PU;").into_bytes(), &drilling);
    assert_eq!(found, ["drawing/too-many-lines"]);
    let texts = many(15_000, &|i| format!("PU{},20000;LBx\u{3};", 20_000 + i));
    let found = codes_with(format!("{parts}{texts}PU;").into_bytes(), &Job::default());
    assert_eq!(found, ["drawing/too-many-lines"]);
}

#[test]
fn curves_and_polygons_that_never_end_are_refused_in_time() {
    let repeated = |word: &str, count: usize| word.repeat(count);
    check("circles", &format!("PU0,0;{}", repeated("CI99999999;", 300)), &["hpgl/far-place"]);
    check(
        "near circles",
        &format!("PU0,0;{}", repeated("CI30000000;", 3000)),
        &["hpgl/too-many-chords", "hpgl/unit-doubtful"],
    );
    let arcs = repeated("AA0,0,360;", 200_000);
    check("arcs with the pen up", &format!("PU30000000,0;{arcs}"), &["drawing/nothing-to-cut"]);
    check(
        "a polygon of arcs with the pen up",
        &format!("PU30000000,0;PM0;{arcs}"),
        &["hpgl/ends-in-polygon", "hpgl/too-many-chords"],
    );
    let edges = repeated("EP;", 100_000);
    for places in ["PD9,9,5,5,", "PU9,9,5,5,", "PD9,9,9,9,"] {
        let (pen, pair) = places.split_at(2);
        let polygon = format!("PM0;{pen}{}PM2;{edges}", repeated(pair, 10_000).trim_end_matches(','));
        check(places, &polygon, &["hpgl/too-many-chords", "hpgl/unit-doubtful"]);
    }
}

#[test]
fn labels_without_their_terminator_are_read_in_time() {
    check("labels", &"IN;LBx;".repeat(1 << 20), &["hpgl/open-label", "drawing/nothing-to-cut"]);
}

#[test]
fn no_coordinate_wraps_around() {
    for number in
        ["2147483647", "2147483648", "4294967296", "4294971296", "18446744073709551616", "99999999999999999999999"]
    {
        for sign in ["", "-"] {
            let text = format!("IN;PU0,0;PD{sign}{number},0,4000,4000,0,0;PU;");
            let (_, found) = read(&source(text), &Job::default());
            assert!(found.contains(&"hpgl/number-overflow"), "{sign}{number}: {found:?}");
        }
    }
    let sums = format!("IN;PR;PD{}PU;", "99999999,1,".repeat(30) + "0,0;");
    assert!(read(&source(sums), &Job::default()).1.contains(&"hpgl/far-place"));
}

#[test]
fn an_outline_that_is_cut_short_is_never_cut_in_silence() {
    let first = format!("IN;SP1;{}", rectangle(1000, 1000, 8000, 4000));
    let whole = format!("{first}{}PU;SP0;", rectangle(10_000, 1000, 8000, 4000));
    let complete = read(&source(whole.clone()), &Job::default()).0.drawn_length();
    for length in 1..whole.len() {
        let (marker, found) = read(&source(&whole.as_bytes()[..length]), &Job::default());
        let is_complete = (marker.drawn_length() - complete).abs() < 1e-9;
        // Where the pen is up or was just lowered, or an outline is whole, nobody can tell that a part should follow.
        let is_whole = length + 1 >= first.len() && length <= first.len();
        let pen_is_up =
            !whole[..length].rsplit_once('P').is_some_and(|(_, last)| last.starts_with('D') && last.len() > 1);
        // What ends amid a pair of numbers leaves one of them without its partner.
        let is_named = |code: &&str| {
            ["drawing/cut-short", "hpgl/odd-coordinate", "hpgl/lost-place", "drawing/nothing-to-cut"].contains(code)
        };
        assert!(
            is_complete || is_whole || pen_is_up || found.iter().any(is_named),
            "after {length} bytes: {}",
            &whole[..length]
        );
    }
}

#[test]
fn marks_that_cross_many_edges_are_searched_in_time_and_what_was_not_searched_is_said() {
    let zigzag = many(20_000, &|i| format!("{},{},", 90_000 * (i % 2), 40 * i));
    // Those within the band are one mark drawn again.
    let marks = many(20_000, &|i| {
        let (x, y) = (4 * i, 2000 + 200 * (i % 3));
        format!("PU{x},{y};PD{x},{},{},{};", y + 600, x + 40, y + 600)
    });
    let found = codes(format!("PU0,0;PD{zigzag}-900000,0,0,0;{marks}PU;").into_bytes());
    assert!(found.contains(&"drawing/search-ended"), "{found:?}");
    assert!(!found.contains(&"hpgl/missed-mark"), "{found:?}");
}
