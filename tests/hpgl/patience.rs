//! Bytes that are no plot, or one that is made to be slow or to overflow: each is refused in time, and nothing is cut in
//! silence.

use std::time::{Duration, Instant};

use cutc::diagnostic::Diagnostics;
use cutc::front::{self, by_name};
use cutc::machine::Job;

use super::{read, rectangle, source};

#[test]
fn a_nesting_that_was_cut_short_is_an_error() {
    let nested: String = (0..20_000).map(|i| rectangle(i, i, 100_000 - 2 * i, 100_000 - 2 * i)).collect();
    assert!(within_patience("nested outlines", nested.into_bytes()).contains(&"hpgl/too-many-lines"));
}

/// The longest that a hostile file may take in a test build, far above what it takes.
const PATIENCE: Duration = Duration::from_secs(20);

fn within_patience(what: &str, bytes: Vec<u8>) -> Vec<&'static str> {
    let source = source(bytes);
    let mut found = Diagnostics::default();
    let start = Instant::now();
    (by_name("hpgl").expect("a dialect").read)(&source, &Job::default(), &mut found);
    assert!(start.elapsed() < PATIENCE, "{what}: {:?}", start.elapsed());
    found.iter().map(|diagnostic| diagnostic.code.name).collect()
}

#[test]
fn a_hundred_megabytes_of_garbage_are_refused_quickly() {
    const SIZE: usize = 100 << 20;
    let mut random = fastrand::Rng::with_seed(8);
    let mut garbage = |pick: &mut dyn FnMut(&mut fastrand::Rng) -> u8| -> Vec<u8> {
        // A stretch is random, and repeated: making it must not take longer than reading it.
        let stretch: Vec<u8> = (0..1 << 16).map(|_| pick(&mut random)).collect();
        stretch.into_iter().cycle().take(SIZE).collect()
    };
    let bytes = garbage(&mut |random| random.u8(..));
    assert_eq!(within_patience("bytes", bytes), ["source/unknown-format"]);
    let text = garbage(&mut |random| random.u8(b' '..=b'~'));
    let found = within_patience("text", text.clone());
    assert!(found.iter().any(|code| ["hpgl/not-a-plot", "hpgl/encoding-damaged"].contains(code)), "{found:?}");
    let start = Instant::now();
    let detected = front::detect(&source(text), Some("plt"), &mut Diagnostics::default()).map(|dialect| dialect.name);
    assert!(detected != Some("hpgl") && start.elapsed() < PATIENCE / 10);
    for (what, word) in
        [("numbers", "1,"), ("semicolons", ";"), ("labels", "LB"), ("escapes", "\u{1b}%0B"), ("junk", "!?")]
    {
        let bytes: Vec<u8> = word.bytes().cycle().take(SIZE).collect();
        let found = within_patience(what, bytes);
        let refused = ["hpgl/not-a-plot", "hpgl/nothing-to-cut", "source/unknown-format"];
        assert!(found.iter().any(|code| refused.contains(code)), "{what}: {found:?}");
    }
}

#[test]
fn drawings_made_to_be_slow_are_read_in_time() {
    let nested: String = (0..20_000).map(|i| rectangle(i, i, 100_000 - 2 * i, 100_000 - 2 * i)).collect();
    within_patience("nested outlines", nested.into_bytes());
    let specks: String = (0..60_000).map(|i| rectangle(i % 300, i / 300, 1, 1) + "PU5,5;PD6,6;").collect();
    within_patience("specks", specks.into_bytes());
    let comb = (0..40_000).fold(String::new(), |comb, i| comb + &format!("PU{i},100;PD{i},200;"));
    within_patience("marks", format!("{}{comb}", rectangle(0, 100, 40_000, 10_000)).into_bytes());
    let fan = (0..60_000).fold(String::new(), |fan, i| fan + &format!("PU0,0;PD{i},900;"));
    within_patience("strokes that all meet", fan.into_bytes());
    let curves = "CI99999999;".repeat(300);
    assert_eq!(within_patience("circles", format!("PU0,0;{curves}").into_bytes()), ["hpgl/far-place"]);
    let curves = "CI30000000;".repeat(3000);
    let found = within_patience("near circles", format!("PU0,0;{curves}").into_bytes());
    assert!(found.contains(&"hpgl/too-many-chords"), "{found:?}");
    let polygons = format!("PM0;PD{}PM2;{}", "9,9,5,5,".repeat(10_000), "EP;".repeat(100_000));
    let found = within_patience("polygons", polygons.into_bytes());
    assert!(found.contains(&"hpgl/too-many-chords"), "{found:?}");
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
    let complete = read(&source(whole.clone()), &Job::default()).0.cut_length();
    for length in 1..whole.len() {
        let (marker, found) = read(&source(&whole.as_bytes()[..length]), &Job::default());
        let is_complete = (marker.cut_length() - complete).abs() < 1e-9;
        // Where the pen is up or was just lowered, or an outline is whole, nobody can tell that a part should follow.
        let is_whole = length + 1 >= first.len() && length <= first.len();
        let pen_is_up =
            !whole[..length].rsplit_once('P').is_some_and(|(_, last)| last.starts_with('D') && last.len() > 1);
        assert!(
            is_complete || is_whole || pen_is_up || !found.is_empty(),
            "after {length} bytes: {}",
            &whole[..length]
        );
    }
}
