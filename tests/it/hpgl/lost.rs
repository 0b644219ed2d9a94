//! A character that is lost or changed amid an outline is an error, or changes nothing.

use cutc::diagnostic::Diagnostics;
use cutc::front::by_name;
use cutc::machine::Job;
use cutc::machine::plot::PenUse;
use cutc::pipeline;

use super::closing::areas;
use super::{as_read, outlines, read, rectangle, source};
use crate::ONE_IN;

/// The same outlines in the spellings of several drivers.
const PLOTS: [&str; 5] = [
    "IN;SP1;PU400,400;PD4400,400;PD4400,2400;PD2400,2600;PD400,2400;PD400,400;PU;PU5000,0;PD9000,0;PD9000,900;PD5000,0;PU;SP0;",
    "IN;SP1;PU400,400;PD4400,400,4400,2400,2400,2600,400,2400,400,400;PU5000,0;PD9000,0,9000,900,5000,0;PU;SP0;",
    "IN;SP1;PU;PA400,400;PD;PA4400,400;PA4400,2400;PA2400,2600;PA400,2400;PA400,400;PU;PA5000,0;PD;PA9000,0;PA9000,900;PA5000,0;PU;",
    "IN;SP1;PU;PA400,400;PD;PR4000,0;PR0,2000;PR-2000,200;PR-2000,-200;PR0,-2000;PU;PA5000,0;PD;PR4000,0,0,900,-4000,-900;PU;",
    "INSP1PU400,400PD4400 400,4400 2400PD2400,2600,400 2400,400,400PU5000,0PD9000,0,9000,900,5000,0PU;",
];

/// Expects no plot whose outlines are others without a word.
fn expect_none(silent: &[String]) {
    let few = &silent[..silent.len().min(8)];
    assert!(silent.is_empty(), "{} outlines are others in silence: {few:#?}", silent.len());
}

#[test]
fn a_character_that_is_lost_is_an_error_or_changes_nothing() {
    let job = Job::default();
    let mut silent = Vec::new();
    let (mut refused, mut same) = (0, 0);
    for plot in PLOTS {
        let whole = outlines(&as_read(&source(plot), &job));
        assert_eq!(whole.len(), 2, "{plot}");
        for at in plot.find("PU").expect("a move")..plot.len() {
            let byte = plot.as_bytes()[at];
            let [before, behind] = [&plot[..at], &plot[at + 1..]];
            let mut damaged = vec![format!("{before}#{behind}"), format!("{before}~{behind}")];
            // A digit or a sign that is gone leaves another number, and nothing in the file tells.
            if !byte.is_ascii_digit() && byte != b'-' {
                damaged.push(format!("{before}{behind}"));
            }
            if byte.is_ascii_digit() && !plot.contains(' ') {
                damaged.push(format!("{before},{behind}"));
            }
            if byte == b',' {
                damaged.extend([
                    format!("{before},,{behind}"),
                    format!("{before}.{behind}"),
                    format!("{before};{behind}"),
                ]);
            }
            for text in damaged {
                let mut found = Diagnostics::default();
                let read = pipeline::read(&source(text.as_str()), by_name("hpgl"), &job, &mut found);
                let is_refused = found.has_errors() || found.iter().any(|told| told.code.name == "hpgl/lone-separator");
                let is_same = read.is_some_and(|_| outlines(&as_read(&source(text.as_str()), &job)) == whole);
                refused += usize::from(is_refused);
                same += usize::from(is_same);
                if !is_refused && !is_same {
                    silent.push(text);
                }
            }
        }
    }
    assert!(refused > 1000 && same > 100, "{refused} refused, {same} the same");
    expect_none(&silent);
}

#[test]
fn a_letter_or_a_digit_that_changed_is_told_or_changes_nothing() {
    let job = Job::default();
    let mut silent = Vec::new();
    let mut told = 0;
    for plot in &PLOTS[..3] {
        let whole = outlines(&as_read(&source(*plot), &job));
        for at in (plot.find("PU").expect("a move")..plot.len()).step_by(ONE_IN) {
            let byte = plot.as_bytes()[at];
            // PR instead of PA is another sound move.
            let others = match byte {
                b'A' => "BCDEFGHIJKLMNOPQSTUVWXYZ",
                byte if byte.is_ascii_alphabetic() => "ABCDEFGHIJKLMNOPQRSTUVWXYZ",
                byte if byte.is_ascii_digit() => " ",
                _ => "",
            };
            for other in others.chars() {
                let text = format!("{}{other}{}", &plot[..at], &plot[at + 1..]);
                let mut found = Diagnostics::default();
                let read = pipeline::read(&source(text.as_str()), by_name("hpgl"), &job, &mut found);
                told += usize::from(found.iter().next().is_some());
                let is_same = || read.is_some() && outlines(&as_read(&source(text.as_str()), &job)) == whole;
                if found.iter().next().is_none() && !is_same() {
                    silent.push(text);
                }
            }
        }
    }
    assert!(told * ONE_IN > 1500, "{told}");
    expect_none(&silent);
}

#[test]
fn commas_and_blanks_that_a_program_writes_at_every_place_are_no_fault() {
    let plot = PLOTS[0];
    let whole = outlines(&read(&source(plot), &Job::default()).0);
    for (from, to) in [(",", " "), (",", " , "), ("PD", "PD "), ("PD", "PD,"), (";", ",;"), ("PD", "PD+")] {
        let text = plot.replace(from, to).replace(",;PU,;", ";PU;");
        let (marker, told) = read(&source(text.as_str()), &Job::default());
        assert_eq!(told, [""; 0], "{text}");
        assert_eq!(outlines(&marker), whole, "{text}");
    }
    let told = |text: String| read(&source(text), &Job::default()).1;
    assert_eq!(told(plot.replace("PD9000,900", "PD9000 ,900")), ["hpgl/lone-separator"]);
    assert_eq!(told(plot.replace("PD9000,900", "PD+000,900")), ["hpgl/lone-separator", "marker/deep-overlap"]);
    assert_eq!(told(plot.replace("PD9000,900", "PD9000,90,")), ["hpgl/lone-separator"]);
    assert_eq!(told(plot.replace("PD9000,900", "PD,9000,900")), ["hpgl/lost-place"]);
}

/// An outline and a slit in it, encoded.
const ENCODED: &[u8] = b"IN;SP1;PE<=\xbf\xbf?y\xc2\xbf\xbf?v\xc4@y\xc2\xbf\xbf@v\xc4;PE<=?|\xc0\xbf\xbf\xc9;PU;SP0;";

#[test]
fn an_encoded_line_that_loses_a_byte_is_refused_unless_another_number_is_left() {
    let job = Job::default();
    let is_refused = |bytes: &[u8]| {
        let mut found = Diagnostics::default();
        pipeline::read(&source(bytes), by_name("hpgl"), &job, &mut found);
        found.has_errors()
    };
    assert!(!is_refused(ENCODED));
    let slit = ENCODED.windows(2).rposition(|pair| pair == b"PE").expect("a slit");
    for at in slit..ENCODED.len() - 8 {
        let [before, behind] = [&ENCODED[..at], &ENCODED[at + 1..]];
        // Digits before the last one, and flags, are another place: nothing in the file tells.
        if !b"?|<=".contains(&ENCODED[at]) && ENCODED[at] != b';' {
            assert!(is_refused(&[before, behind].concat()), "{at}");
        }
    }
}

#[test]
fn figures_that_lack_numbers_are_errors() {
    for figure in ["AA400,400", "CI", "EA400", "EW400,0", "AT1,2,3", "BZ1,2,3,4", "AR0,0"] {
        let mut found = Diagnostics::default();
        let plot = source(format!("IN;SP1;PU0,0;PD800,0,800,800,0,0;PU900,900;{figure};PU;"));
        pipeline::read(&plot, by_name("hpgl"), &Job::default(), &mut found);
        assert!(found.iter().any(|finding| finding.code.name == "hpgl/lost-place"), "{figure}");
    }
}

#[test]
fn what_drivers_write_between_outlines_is_no_error() {
    for junk in ["!PG;", "%%", "QQ;", "QQ12,3;", "!", "\0\0"] {
        let mut found = Diagnostics::default();
        let plot =
            format!("IN;{junk}SP1;PU0,0;PD4000,0,4000,4000,0,0;PU;{junk}PU5000,0;PD9000,0,9000,4000,5000,0;{junk}");
        pipeline::read(&source(plot), by_name("hpgl"), &Job::default(), &mut found);
        assert!(!found.has_errors(), "{junk:?}");
    }
}

/// A number in the encoding of PE, so many bits a byte.
fn encoded(number: i64, bits: u32) -> Vec<u8> {
    let mut left = number.unsigned_abs() << 1 | u64::from(number < 0);
    let mut bytes = Vec::new();
    while left >> bits > 0 {
        bytes.push(63 + (left & ((1 << bits) - 1)) as u8);
        left >>= bits;
    }
    bytes.push(if bits == 5 { 95 } else { 191 } + left as u8);
    bytes
}

/// A ring of some places about another one, units.
fn ring(random: &mut fastrand::Rng, [x, y]: [i64; 2]) -> Vec<[i64; 2]> {
    let count = random.usize(4..20);
    let place = |k: usize| {
        let (angle, radius) = (k as f64 / count as f64 * std::f64::consts::TAU, 3000.0 + 1000.0 * random.f64());
        [x + (radius * angle.cos()) as i64, y + (radius * angle.sin()) as i64]
    };
    let mut ring: Vec<[i64; 2]> = (0..count).map(place).collect();
    ring.push(ring[0]);
    ring
}

/// Rings, each in an encoded polyline, and the bytes that may be lost: all but those of where a ring starts. A ring that starts
/// elsewhere is the same ring.
fn plot(rings: &[Vec<[i64; 2]>], bits: u32) -> (Vec<u8>, Vec<usize>) {
    let (mut bytes, mut may_be_lost) = (b"IN;SP1;".to_vec(), Vec::new());
    for ring in rings {
        bytes.extend(if bits == 5 { &b"PE7<="[..] } else { b"PE<=" });
        may_be_lost.extend(bytes.len() - 2..bytes.len() - 1);
        bytes.extend(ring[0].iter().flat_map(|&value| encoded(value, bits)));
        let first = bytes.len();
        for ends in ring.windows(2) {
            bytes.extend((0..2).flat_map(|axis| encoded(ends[1][axis] - ends[0][axis], bits)));
        }
        bytes.push(b';');
        may_be_lost.extend(first..bytes.len());
    }
    bytes.extend(b"PU;SP0;");
    (bytes, may_be_lost)
}

#[test]
fn a_byte_that_an_encoded_outline_loses_is_an_error_or_changes_nothing() {
    let job = Job::default();
    let (mut refused, mut same) = (0, 0);
    for seed in 0..24 {
        let mut random = fastrand::Rng::with_seed(seed);
        let rings = [[5000, 5000], [25_000, 5000]].map(|at| ring(&mut random, at));
        let (bytes, may_be_lost) = plot(&rings, if seed % 2 == 0 { 5 } else { 6 });
        let of = |bytes: Vec<u8>| cutc::source::Source::new("a.plt", bytes).expect("small");
        let whole = areas(&as_read(&of(bytes.clone()), &job));
        assert_eq!(whole.len(), 2, "seed {seed}");
        for at in may_be_lost {
            let damaged = [&bytes[..at], &bytes[at + 1..]].concat();
            let mut found = Diagnostics::default();
            let read = pipeline::read(&of(damaged.clone()), by_name("hpgl"), &job, &mut found);
            if read.is_none() || found.has_errors() {
                refused += 1;
                continue;
            }
            same += 1;
            let left = areas(&as_read(&of(damaged.clone()), &job));
            assert_eq!(left, whole, "seed {seed}, byte {at} of {}", damaged.escape_ascii());
        }
    }
    assert!(refused > 1000, "{refused} refused, {same} the same");
}

#[test]
fn a_polygon_that_another_one_replaces_has_no_end() {
    let polygon = "PU20000,0;PM0;PD28000,0,28000,9000,20000,9000,20000,0;";
    let told =
        |end: &str| read(&source(format!("IN;SP1;{}{polygon}{end}", rectangle(0, 0, 8000, 8000))), &Job::default()).1;
    assert!(!told("PM2;EP;PU;SP0;").contains(&"hpgl/ends-in-polygon"));
    for end in ["", "PM;", "PM", "PM0;PD100,100;PM2;EP;PU;SP0;"] {
        assert!(told(end).contains(&"hpgl/ends-in-polygon"), "{end}");
    }
}

#[test]
fn a_point_far_off_is_told_however_far_it_is() {
    for far in [20_000, 40_000, 400_000] {
        let outline = format!("PU0,0;PD4000,0,4800,400,5200,1000,5400,2000,5200,{far},5000,3200,4000,3600,0,3600,0,0;");
        let (_, told) = read(&source(format!("IN;SP1;{outline}PU;SP0;")), &Job::default());
        assert!(told.contains(&"marker/far-point"), "{far}: {told:?}");
    }
    let near = "PU0,0;PD4000,0,4800,400,5200,1000,5400,2000,5200,2600,5000,3200,4000,3600,0,3600,0,0;";
    assert_eq!(read(&source(format!("IN;SP1;{near}PU;SP0;")), &Job::default()).1, [""; 0]);
}

#[test]
fn a_plot_that_ends_too_soon_is_told_and_usual_ends_are_not() {
    let part = rectangle(0, 0, 8000, 8000);
    let is_told = |end: &str| {
        let told = read(&source(format!("IN;SP1;{part}{end}")), &Job::default()).1;
        told.contains(&"hpgl/no-end")
    };
    for end in ["PU20000,4", "PU20000,", "PU", "PD", "PU20000,400;", "PU;PA20000,400;", "PU20000,400;PD;\n"] {
        assert!(is_told(end), "{end:?}");
    }
    for end in [
        "",
        "PU;",
        "PU;SP0;",
        "PU0,0;",
        "PU20000,0;",
        "PU0,0;SP0",
        "PU20000,9000;SP0;",
        "PU;PG;\n",
        "PU;IN;",
        "PU;\x1a",
    ] {
        assert!(!is_told(end), "{end:?}");
    }
    let language = |end: &str| {
        let plot = source(format!("\x1bE\x1b%0BIN;SP1;{part}PU;{end}"));
        read(&plot, &Job::default()).1.contains(&"hpgl/no-end")
    };
    assert!(language("") && language("VS40;"));
    for end in ["\x1b%0A", "\x1b%-12345X", "\x1bE", "PG;", "SP0;", "SP0;\x1b%1A\x1bE"] {
        assert!(!language(end), "{end:?}");
        assert!(!language(&format!("PU20000,8000;PD20000,8200;PU;{end}")), "{end:?}");
    }
}

#[test]
fn places_that_are_passed_in_the_air_are_told_where_an_outline_may_be_lost() {
    let is_told = |moves: &str| {
        let plot = source(format!("IN;SP1;{}{moves}PU;SP0;", rectangle(0, 0, 8000, 8000)));
        read(&plot, &Job::default()).1.contains(&"hpgl/uncut-places")
    };
    for moves in [
        "PU20000,0,28000,0,28000,8000,20000,0;",
        "PU20000,0;PA28000,0,28000,8000,20000,0;",
        "PU20000,0;PU;PA28000,0;PA28000,8000;PA20000,0;",
        "PU9000,0;PU20000,0;PU28000,0;PU28000,8000;PU20000,0;",
        "PU20000,0;PR8000,0,0,8000,-8000,-8000;",
        "PU20000,0;VS40;PU28000,0;FS80;PU28000,8000;SP1;PU20000,0;",
    ] {
        assert!(is_told(moves), "{moves}");
    }
    for moves in [
        "PU20000,0,28000,0;",
        "PU20000,0;PU28000,0;PU28000,8000;",
        "PU20000,0;PU28000,0;PU20000,0;",
        "PU0,0;PA0,0;PU0,0;PU0,0;",
        "PU20000,0;RR80,80;PU28000,0;WG80,0,360;PU28000,8000;XT;PU20000,0;RA20080,80;",
        "PU20000,0;PD20000,200;PU28000,0;PD28000,200;PU20000,0;PD20200,0;",
    ] {
        assert!(!is_told(moves), "{moves}");
    }
}

/// Two moves in a row lead past a part whose PD is lost; programs park the pen on an axis, at a change of pen and at the end.
#[test]
fn a_start_that_the_pen_leaves_without_drawing_is_told_where_it_is_rare() {
    let (part, next) = (rectangle(0, 0, 8000, 8000), "PD24000,800,24000,8800,16000,8800,16000,800;");
    let is_told = |moves: &str| {
        let plot = source(format!("IN;SP1;{part}{moves}PU;SP0;"));
        read(&plot, &Job::default()).1.contains(&"hpgl/uncut-places")
    };
    for moves in ["PU800,9800;PU16000,800;", "PU800,9800;PU;PA16000,800;", "PU800,9800,16000,9800;PU16000,800;"] {
        assert!(is_told(&format!("{moves}{next}")), "{moves}");
    }
    for moves in ["PU16000,800;PU16000,800;", "PU0,800;PU16000,800;", "PU800,9800;SP2;PU16000,800;"] {
        assert!(!is_told(&format!("{moves}{next}")), "{moves}");
    }
    assert!(!is_told("PU800,9800;PU16000,800;"));
    // A program that does so always means nothing by it.
    let each = |k: i64| format!("PU800,9800;{}", rectangle(16_000 + 9000 * k, 800, 8000, 8000));
    let each = (0..3).map(each).collect::<Vec<_>>().concat();
    assert!(!is_told(&each));
}

#[test]
fn a_lone_letter_that_makes_places_displacements_is_told() {
    let plot = |lone: &str, others: usize| {
        let absolute = |k: usize| format!("PU;PA{},0;PD;PA{0},80;", 100 * k + 9000);
        let absolute = (0..others).map(absolute).collect::<Vec<_>>().concat();
        source(format!("IN;SP1;{}PA9000,0;{absolute}{lone}PU;SP0;", rectangle(0, 0, 8000, 8000)))
    };
    let is_told = |lone: &str, others| read(&plot(lone, others), &Job::default()).1.contains(&"hpgl/lone-mode");
    assert!(is_told("PU;PR90,0;PA0,0;", 6));
    assert!(!is_told("PU;PR90,0;PA0,0;", 2) && !is_told("PR;PA;", 6) && !is_told("", 6));
}

#[test]
fn queries_of_the_interface_amid_places_lose_nothing() {
    let cut = |text: &str| {
        let (marker, told) = read(&source(format!("IN;SP1;{text}PU;SP0;")), &Job::default());
        (outlines(&marker), told)
    };
    let whole = cut("PU800,800;PD12800,800,12800,8800,800,8800,800,800;");
    assert_eq!(cut("PU800,800;PD12800,800,12800,8800\x1b.B,800,8800,800,800;"), whole);
    // Amid an outline an unknown instruction may have been a place.
    let amid = "PU800,800;PD12800,800,12800,8800;ZP800,8800;PD800,800;";
    assert!(cut(amid).1.contains(&"hpgl/lost-place"));
}

#[test]
fn a_last_list_without_a_semicolon_is_told_though_its_outline_closes() {
    let part = rectangle(0, 0, 8000, 8000);
    let open = part.trim_end_matches(';');
    let is_told = |text: &str| read(&source(format!("IN;SP1;{text}")), &Job::default()).1.contains(&"hpgl/no-end");
    assert!(is_told(open) && !is_told(&part) && !is_told(&format!("{open}\n")));
}

/// A digit of IP or SC that is lost stretches every part; a calibration makes less than one percent.
#[test]
fn scales_of_x_and_y_that_differ_are_told_with_what_they_draw() {
    let is_told = |scale: &str| {
        let text = format!("IN;{scale}SP1;PU1,1;PD11,1,11,9,1,9,1,1;PU;SP0;");
        read(&source(text), &Job::default()).1.contains(&"hpgl/uneven-scale")
    };
    assert!(is_told("IP0,0,1016,1000;SC0,1,0,1;") && is_told("SC0,1016,0,1000,2;"));
    assert!(is_told("SC0,1,0,1;IP0,0,10016,1016;"));
    for even in
        ["IP0,0,1016,1012;SC0,1,0,1;", "IP0,0,1016,1000;SC0,1,0,1,1;", "IP0,0,9,1016;IP0,0,1016,1016;SC0,1,0,1;"]
    {
        assert!(!is_told(even), "{even}");
    }
}

#[test]
fn instructions_with_more_numbers_than_they_take_are_errors() {
    let is_refused = |instruction: &str| {
        let plot = source(format!("IN;{instruction}SP1;{}PU;SP0;", rectangle(0, 0, 8000, 8000)));
        read(&plot, &Job::default()).1.contains(&"hpgl/too-many-numbers")
    };
    for mnemonic in ["PT", "PW", "PS", "PC", "PM", "PB", "AD", "OD", "SD", "WU", "CA", "SI"] {
        let places = "8000,0,8000,8000,0,8000,0,0".repeat(2).replace("00,08", "00,0,8");
        assert!(is_refused(&format!("{mnemonic}{places};")), "{mnemonic}");
    }
    assert!(is_refused("PW8000,400;"));
    for changed in
        ["PC8000,400;", "AD8000,400;", "SD8000,400;", "LA8000,400;", "CA8000,400;", "CR8000,400;", "SR8000,400;"]
    {
        assert!(is_refused(changed), "{changed}");
    }
    for amid in ["PS", "PC", "DR", "EA", "ER", "SR"] {
        let line = format!("PU20000,0;PD28000,0;PD28000,8000;{amid}20000,8000;PD20000,0;");
        let plot = format!("IN;SP1;{}{line}PU;SP0;", rectangle(0, 0, 8000, 8000));
        let told = read(&source(plot.as_str()), &Job::default()).1;
        assert!(told.contains(&"hpgl/too-many-numbers"), "{plot} {told:?}");
    }
    for usual in [
        "VS40,1;",
        "FS80,8;",
        "PW0.3,1;",
        "LT4,5,1;",
        "SP1;",
        "PC1,255,0,0;",
        "PS41000,36000;",
        "ZZ1,2,3,4,5,6;",
        "LA1,4,2,4;",
        "AD1,21,2,1,4,12,7,52;",
        "SD1,277,2,1,4,14,5,0,6,0,7,4148;",
        "CA5;",
        "SR0.75,1.5;",
        "DR1,0;",
    ] {
        assert!(!is_refused(usual), "{usual}");
    }
}

/// The line in a lost outline is a seam line or a cut-out, and is never cut in its place.
#[test]
fn an_outline_that_is_passed_in_the_air_around_a_line_is_refused() {
    let found = |plot: &str, job: &Job| read(&source(format!("IN;SP1;{plot}PU;SP0;")), job).1;
    let is_refused = |plot: &str| found(plot, &Job::default()).contains(&"drawing/passed-outline");
    let (other, seam) = (rectangle(16_000, 0, 12_000, 8000), rectangle(400, 400, 11_200, 7200));
    let windows = [rectangle(800, 800, 2000, 2000), rectangle(6000, 800, 2000, 2000)].concat();
    let passed = [
        "PU0,0;PU12000,0,12000,8000,0,8000,0,0;",
        "PU;PA0,0;PA12000,0;PA12000,8000;PA0,8000;PA0,0;",
        "PU0,0;PR12000,0,0,8000,-12000,0,0,-8000;PA;",
        "PU0,0;PU12000,0;VS40;PU12000,8000;PU0,8000;PU0,0;",
    ];
    for outline in passed {
        for inside in [&seam, &windows] {
            assert!(is_refused(&format!("{outline}{inside}{other}")), "{outline}{inside}");
            assert!(is_refused(&format!("{other}{outline}{inside}")), "{outline}{inside}");
        }
        assert!(!is_refused(&format!("{outline}{other}")), "{outline}: nothing in it");
        assert!(!is_refused(&format!("{outline}{windows}")), "{outline}: the way around a page");
    }
    let row = |k: i64| rectangle(3000 * k, 200, 2000, 2000);
    let parts = (0..4).map(row).collect::<Vec<_>>().concat();
    assert!(!is_refused(&format!("{}{parts}{other}", passed[0])), "the way around a page of a longer plot");
    let mut job = Job::default();
    job.profile.hpgl.pens.insert("1".to_owned(), PenUse::Knife);
    assert!(
        !found(&format!("{}{seam}{other}", passed[0]), &job).contains(&"drawing/passed-outline"),
        "a knife by name"
    );
}
