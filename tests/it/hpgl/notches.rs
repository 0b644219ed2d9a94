//! Notches that a plot draws as strokes of their own: from the edge of a part inwards, of any pen that is not ignored.

use std::fmt::Write as _;
use std::io::Cursor;

use cutc::back::TARGETS;
use cutc::diagnostic::{Diagnostics, render};
use cutc::front::by_name;
use cutc::ir::Marker;
use cutc::ir::marker::{NotchKind, OutlineNotch};
use cutc::machine::plot::Inner;
use cutc::machine::{Job, OrderPolicy};
use cutc::pipeline::{self, Order};
use cutc::verify::{DrawingCuts, drawing_audit};

use super::audit::audit;
use super::closing::found;
use super::{as_read, key, read, rectangle, source};

/// The slits of each piece of a plot behind the passes, root and tip in units; the account of the lines is whole.
fn slits(text: &str, job: &Job) -> Vec<Vec<[[i64; 2]; 2]>> {
    let source = source(format!("IN;SP1;{text}PU;SP0;"));
    assert_eq!(audit(&source, &as_read(&source, job), job), [], "{text}");
    let marker: Marker = read(&source, job).0;
    let of = |piece: &cutc::ir::marker::Piece| {
        let mut slits: Vec<_> = piece.notches.iter().map(|notch| [key(notch.root), key(notch.tip)]).collect();
        slits.sort_unstable();
        slits
    };
    marker.pieces.iter().map(of).collect()
}

/// A part of 300 by 300 mm from (100, 100) on.
fn part() -> String {
    rectangle(4000, 4000, 12_000, 12_000)
}

/// The one notch that a mark on that part is, or none.
fn check(mark: &str, expected: Option<[[i64; 2]; 2]>) {
    let found = slits(&(part() + mark), &Job::default());
    assert_eq!(found, [Vec::from_iter(expected)], "{mark}");
}

#[test]
fn a_stroke_from_the_edge_inwards_is_a_notch_however_it_is_drawn() {
    let notch = Some([[8000, 4000], [8000, 4240]]);
    check("PU8000,4000;PD8000,4240;", notch);
    check("PU8000,4240;PD8000,4000;", notch);
    check("PU8000,4000;PD8000,4240,8000,4000;", notch);
    check("PU8000,4000;PD8000,4120,8000,4240;", notch);
    check("PU8000,4000;PD8000,4120;PU8000,4240;PD8000,4120;", notch);
    check("SP7;PU8000,4000;PD8000,4240;", notch);
    check("PU4000,9000;PD4240,9100;", Some([[4000, 9000], [4240, 9100]]));
}

#[test]
fn what_is_too_short_too_long_outside_or_in_the_midst_is_no_notch() {
    for mark in [
        "PU8000,4000;PD8000,4030;",
        "PU8000,4000;PD8000,4640;",
        "PU8000,4000;PD8000,3760;",
        "PU8000,4800;PD8000,5000;",
        "PU8000,4000;PD8200,4000;",
        "PU8000,3840;PD8000,4160;",
        "PU8000,4000;PD8000,4240,8600,4240,8600,4000;",
    ] {
        check(mark, None);
    }
}

#[test]
fn a_mark_that_misses_its_edge_by_some_units_reaches_it() {
    for miss in [1, 4, 16] {
        let found = slits(&(part() + &format!("PU8000,{};PD8000,4240;", 4000 + miss)), &Job::default());
        assert_eq!(found[0].len(), 1, "{miss}");
    }
    check("PU8000,4040;PD8000,4240;", None);
}

#[test]
fn a_stroke_that_misses_the_edge_farther_is_named() {
    // From 0.8 and 1.5 mm inside the edge, and from 1 mm outside on.
    for mark in ["PU8000,4032;PD8000,4240;", "PU8000,4060;PD8000,4240;", "PU8000,3960;PD8000,4240;"] {
        let codes = read(&source(format!("IN;SP1;{}{mark}PU;SP0;", part())), &Job::default()).1;
        assert_eq!(codes, ["drawing/line-from-edge"], "{mark}");
    }
}

#[test]
fn two_legs_that_meet_are_one_notch_of_the_outline_and_none_alone() {
    for mark in ["PU7880,4000;PD8000,4240,8120,4000;", "PU7880,4000;PD8000,4240;PU8120,4000;PD8000,4240;"] {
        let text = part() + mark;
        assert_eq!(slits(&text, &Job::default()), [[[[0; 2]; 2]; 0]], "{mark}");
        let marker = read(&source(format!("IN;SP1;{text}PU;SP0;")), &Job::default()).0;
        assert!(matches!(marker.pieces[0].outline_notches[..], [notch] if notch.word() == "v"), "{mark}");
        assert_eq!(marker.contours().count(), 1, "{mark}");
    }
    check("PU7880,4000;PD8000,4240,8120,4200;", None);
}

#[test]
fn a_stroke_over_the_tip_of_a_notch_is_its_crossbar() {
    let text = format!("IN;SP1;{}PU8000,4000;PD8000,4200;PU7900,4200;PD8100,4200;PU;SP0;", part());
    let source = source(text);
    assert_eq!(audit(&source, &as_read(&source, &Job::default()), &Job::default()), []);
    let marker = read(&source, &Job::default()).0;
    assert!(matches!(marker.pieces[0].notches[..], [notch] if matches!(notch.kind, NotchKind::T(_))));
    assert_eq!(marker.contours().count(), 1);
}

#[test]
fn a_mark_on_an_edge_of_two_parts_is_a_notch_of_the_one_that_it_leads_into() {
    // The parts stay as they are drawn.
    let mut job = Job::default();
    job.profile.order.policy = OrderPolicy::File;
    for gap in [-4, 0, 4] {
        let parts = [rectangle(0, 0, 8000, 4000), rectangle(0, 4000 + gap, 8000, 4000)].concat();
        for (tip, counts) in [(4240, [0, 1]), (3760, [1, 0])] {
            let found = slits(&format!("{parts}PU3000,4000;PD3000,{tip};"), &job);
            assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>(), counts, "{gap} {tip}");
        }
    }
}

/// Both start where the two edges meet, so that they are joined as strokes that continue each other.
#[test]
fn marks_that_face_each_other_on_an_edge_of_two_parts_are_a_notch_of_either() {
    for gap in [-4, 0, 4] {
        let parts = [rectangle(0, 0, 8000, 4000), rectangle(0, 4000 + gap, 8000, 4000)].concat();
        let own = 4000 + gap;
        for marks in [
            format!("PU3000,4000;PD3000,3760;PU3000,{own};PD3000,4240;"),
            format!("PU3000,3760;PD3000,4000;PU3000,4240;PD3000,{own};"),
            "PU3000,3760;PD3000,4000,3000,4240;".to_owned(),
        ] {
            let found = slits(&format!("{parts}{marks}"), &Job::default());
            assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>(), [1, 1], "{gap} {marks}");
        }
    }
}

#[test]
fn an_outline_that_is_lifted_where_a_mark_starts_is_whole_and_has_the_notch() {
    let outline = "PU4000,4000;PD8000,4000;PU8000,4000;PD16000,4000,16000,16000,4000,16000,4000,4000;";
    let found = slits(&format!("{outline}PU8000,4000;PD8000,4240;"), &Job::default());
    assert_eq!(found, [vec![[[8000, 4000], [8000, 4240]]]]);
}

#[test]
fn a_mark_beside_a_cut_out_is_no_notch() {
    let job =
        Job { lines: cutc::machine::plot::Lines { inner: Some(Inner::Cut), ..Default::default() }, ..Job::default() };
    let found = slits(&format!("{}{}PU8000,8000;PD8000,7800;", part(), rectangle(7000, 8000, 2000, 2000)), &job);
    assert!(found[0].is_empty() && found.len() == 1, "{found:?}");
}

/// Letters as plots draw them: strokes on a grid 4 wide and 6 high.
const LETTERS: [(char, &[&[[i64; 2]]]); 12] = [
    ('A', &[&[[0, 0], [2, 6], [4, 0]], &[[1, 3], [3, 3]]]),
    ('E', &[&[[4, 0], [0, 0], [0, 6], [4, 6]], &[[0, 3], [3, 3]]]),
    ('F', &[&[[0, 0], [0, 6], [4, 6]], &[[0, 3], [3, 3]]]),
    ('H', &[&[[0, 0], [0, 6]], &[[4, 0], [4, 6]], &[[0, 3], [4, 3]]]),
    ('I', &[&[[2, 0], [2, 6]]]),
    ('K', &[&[[0, 0], [0, 6]], &[[4, 6], [0, 3], [4, 0]]]),
    ('L', &[&[[0, 6], [0, 0], [4, 0]]]),
    ('M', &[&[[0, 0], [0, 6], [2, 3], [4, 6], [4, 0]]]),
    ('N', &[&[[0, 0], [0, 6], [4, 0], [4, 6]]]),
    ('T', &[&[[2, 0], [2, 6]], &[[0, 6], [4, 6]]]),
    ('V', &[&[[0, 6], [2, 0], [4, 6]]]),
    ('W', &[&[[0, 6], [1, 0], [2, 3], [3, 0], [4, 6]]]),
];

#[test]
fn words_that_stand_beside_an_edge_are_never_cut() {
    let mut random = fastrand::Rng::with_seed(44);
    for case in 0..300 {
        // 3 to 9 mm high, 0.2 to 0.45 mm off the edge.
        let (scale, off, count) = (random.i64(20..60), random.i64(8..18), random.i64(3..9));
        let mut word = String::new();
        let mut text = part();
        for k in 0..count {
            let (letter, strokes) = LETTERS[random.usize(..LETTERS.len())];
            word.push(letter);
            for stroke in strokes {
                let at = |[x, y]: [i64; 2]| format!("{},{}", 6000 + (5 * k + x) * scale, 4000 + off + y * scale);
                let places: Vec<String> = stroke.iter().map(|&place| at(place)).collect();
                text.extend(["PU", &places[0], ";PD", &places[1..].join(","), ";"]);
            }
        }
        let found = slits(&text, &Job::default());
        assert_eq!(
            found,
            [Vec::<[[i64; 2]; 2]>::new()],
            "case {case}: {word} at {off} units, {scale} a unit of its grid"
        );
        let marker = read(&source(format!("IN;SP1;{text}PU;SP0;")), &Job::default()).0;
        assert_eq!(super::outlines(&marker)[0].len(), 5, "case {case}: {word}");
    }
}

#[test]
fn strokes_across_an_edge_are_named_and_a_stroke_there_and_back_is_taken_once() {
    for mark in ["PU8000,3900;PD8000,4240;", "PU8000,3700;PD8000,4200;"] {
        let codes = read(&source(format!("IN;SP1;{}{mark}PU;SP0;", part())), &Job::default()).1;
        assert_eq!(codes, ["drawing/line-from-edge"], "{mark}");
    }
    let once = "PU8000,4000;PD8100,4240,8200,4000;";
    let cut =
        |mark: &str| super::outlines(&read(&source(format!("IN;SP1;{}{mark}PU;SP0;", part())), &Job::default()).0);
    for mark in [
        "PU8000,4000;PD8100,4240,8200,4000,8100,4240,8000,4000;",
        "PU8100,4240;PD8000,4000,8100,4240,8200,4000,8100,4240;",
        "PU8200,4000;PD8100,4240,8000,4000,8100,4240;",
    ] {
        assert_eq!(cut(mark), cut(once), "{mark}");
    }
    let t = "PU8000,4000;PD8000,4240,7900,4240,8000,4240,8100,4240,8000,4240,8000,4000;";
    check(t, Some([[8000, 4000], [8000, 4240]]));
}

#[test]
fn a_stroke_that_stands_askew_on_its_edge_is_the_notch_that_it_draws() {
    let mut random = fastrand::Rng::with_seed(16);
    for case in 0..240 {
        let mut between = |least: f64, most: f64| least + (most - least) * random.f64();
        let (half, depth) = (between(1.25, 3.0), between(2.0, 8.0));
        let round = |k: i32| {
            let angle = std::f64::consts::PI * f64::from(k) / 12.0;
            [-half * angle.cos(), depth + half * angle.sin()]
        };
        let (word, places) = match case % 3 {
            0 => ("v", vec![[-half, 0.0], [0.0, depth], [half, 0.0]]),
            1 => ("castle", vec![[-half, 0.0], [-half, depth], [half, depth], [half, 0.0]]),
            _ => ("u", [&[[-half, 0.0]][..], &(0..=12).map(round).collect::<Vec<_>>(), &[[half, 0.0]]].concat()),
        };
        // As a program lays it that knows the seam, on an edge that is not quite parallel to it; then all is turned.
        let (askew, off) = (between(-0.14, 0.14), between(-0.05, 0.05));
        let turn = between(-std::f64::consts::PI, std::f64::consts::PI);
        let turned =
            |[x, y]: [f64; 2], angle: f64| [x * angle.cos() - y * angle.sin(), x * angle.sin() + y * angle.cos()];
        // In units of 0.025 mm, rounded as a file of 0.1 mm is in every other case.
        let step = if case % 2 == 0 { 1.0 } else { 4.0 };
        let place = |at: [f64; 2]| turned(at, turn).map(|mm| ((mm + 400.0) * 40.0 / step).round() * step);
        let line = |places: &[[f64; 2]]| {
            let all: Vec<String> = places.iter().map(|&at| place(at).map(|unit| unit.to_string()).join(",")).collect();
            format!("PU{};PD{};", all[0], all[1..].join(","))
        };
        let stroke: Vec<[f64; 2]> = places.iter().map(|&at| turned(at, askew)).map(|[x, y]| [x, y + off]).collect();
        let outline = [[-90.0, 0.0], [110.0, 0.0], [110.0, 120.0], [-90.0, 120.0], [-90.0, 0.0]];
        let (marker, codes) = found(&format!("{}{}", line(&outline), line(&stroke)), &Job::default());
        let words: Vec<&str> = marker.pieces[0].outline_notches.iter().map(OutlineNotch::word).collect();
        assert_eq!((words, codes), (vec![word], vec![]), "case {case}: {stroke:?}");
    }
}

/// Strokes through places in mm, in a plot of units of 0.025 mm.
fn strokes(all: &[Vec<[f64; 2]>]) -> String {
    let place = |[x, y]: [f64; 2]| format!("{},{}", ((x + 400.0) * 40.0).round(), ((y + 400.0) * 40.0).round());
    let stroke = |places: &Vec<[f64; 2]>| {
        let places: Vec<String> = places.iter().map(|&at| place(at)).collect();
        format!("PU{};PD{};", places[0], places[1..].join(","))
    };
    all.iter().map(stroke).collect()
}

/// The words of the notches of the one part of a plot that is told nothing about.
fn words(all: &[Vec<[f64; 2]>], case: &str) -> Vec<&'static str> {
    let (marker, codes) = found(&strokes(all), &Job::default());
    assert_eq!((marker.contours().count(), codes), (1, vec![]), "{case}");
    marker.pieces[0].outline_notches.iter().map(OutlineNotch::word).collect()
}

const OUTLINE: [[f64; 2]; 5] = [[-90.0, 0.0], [110.0, 0.0], [110.0, 120.0], [-90.0, 120.0], [-90.0, 0.0]];

#[test]
fn a_stroke_of_any_shape_from_edge_to_edge_has_a_row_and_is_the_notch_of_its_twin() {
    let mut random = fastrand::Rng::with_seed(44);
    for case in 0..120 {
        let mut between = |least: f64, most: f64| least + (most - least) * random.f64();
        let (half, lean) = (between(1.25, 2.5), between(-0.7, 0.7));
        let depth = between(2.8 * half + 0.5, 9.0);
        let round = |k: i32| {
            let angle = std::f64::consts::PI * f64::from(k) / 12.0;
            [-half * angle.cos(), depth - half + half * angle.sin()]
        };
        let (word, places) = match case % 3 {
            0 => ("v", vec![[-half, 0.0], [0.0, depth], [half, 0.0]]),
            1 => ("castle", vec![[-half, 0.0], [-half, depth], [half, depth], [half, 0.0]]),
            _ => ("u", [&[[-half, 0.0]][..], &(0..=12).map(round).collect::<Vec<_>>(), &[[half, 0.0]]].concat()),
        };
        // Sheared along the edge, or turned with the walls led to the edge.
        let led_on = |[x, y]: [f64; 2]| {
            let [x, y] = [x * lean.cos() + y * lean.sin(), y * lean.cos() - x * lean.sin()];
            if y.abs() < half * lean.sin().abs() + 1e-9 { [x - y * lean.tan(), 0.0] } else { [x, y] }
        };
        let is_sheared = case % 2 == 0 || word == "v";
        let notch: Vec<[f64; 2]> = if is_sheared {
            places.iter().map(|[x, y]| [x + y * lean.sin(), y * lean.cos()]).collect()
        } else {
            places.iter().map(|&at| led_on(at)).collect()
        };
        let turn = between(-std::f64::consts::PI, std::f64::consts::PI);
        let turned = |places: &[[f64; 2]]| {
            let turned = |[x, y]: [f64; 2]| [x * turn.cos() - y * turn.sin(), x * turn.sin() + y * turn.cos()];
            places.iter().map(|&at| turned(at)).collect::<Vec<_>>()
        };
        let case = format!("case {case}: {word} {half} {depth} leans {lean}");
        assert_eq!(words(&[turned(&OUTLINE), turned(&notch)], &case), [word], "{case}");
        let drawn = [&OUTLINE[..1], &notch, &OUTLINE[1..]].concat();
        assert_eq!(words(&[turned(&drawn)], &case), [word], "{case}, in the outline");
    }
}

#[test]
fn strokes_that_touch_are_as_many_notches_in_one_stroke_or_in_several() {
    let v = |k: f64| vec![[4.0 * k, 0.0], [4.0 * k + 2.0, 5.0], [4.0 * k + 4.0, 0.0]];
    let touching = |count: i32| (0..count).map(|k| v(f64::from(k))).collect::<Vec<_>>();
    let outline = || vec![OUTLINE.to_vec()];
    for count in [2, 3] {
        let apart = [outline(), touching(count)].concat();
        let mut one = touching(count).concat();
        one.dedup();
        for (all, how) in [(apart, "apart"), ([outline(), vec![one]].concat(), "in one")] {
            assert_eq!(words(&all, how), vec!["v"; count as usize], "{count} {how}");
        }
    }
}

#[test]
fn a_stroke_over_a_corner_or_at_one_has_a_row() {
    for stroke in [
        vec![[-90.0, 3.0], [-86.0, 4.0], [-87.0, 0.0]],
        vec![[-90.0, 0.0], [-88.0, 5.0], [-86.0, 0.0]],
        vec![[-90.0, 6.0], [-85.0, 8.0], [-90.0, 10.0]],
    ] {
        assert_eq!(words(&[OUTLINE.to_vec(), stroke.clone()], "corner"), ["v"], "{stroke:?}");
    }
}

#[test]
fn closed_marks_at_an_edge_and_crosses_in_a_part_are_named() {
    let edge = "drawing/line-from-edge";
    for (mark, code) in [
        ("PU7920,4008;PD8000,4200,8080,4008,7920,4008;", edge), // 0.2 mm off the edge
        ("PU7920,4000;PD8000,4080,8080,4000,8000,3920,7920,4000;", edge), // a diamond across it
        ("PU8000,4000;PD8080,4080,8000,4160,7920,4080,8000,4000;", edge), // a diamond on its tip
        ("PU8000,8000;PD8240,8000;PU8120,7880;PD8120,8120;", "drawing/holes"),
    ] {
        let codes = read(&source(format!("IN;SP1;{}{mark}PU;SP0;", part())), &Job::default()).1;
        assert_eq!(codes, [code], "{mark}");
    }
}

#[test]
fn a_stroke_of_touching_notches_that_is_not_cut_is_caught() {
    let text = strokes(&[OUTLINE.to_vec(), vec![[0.0, 0.0], [2.0, 5.0], [4.0, 0.0], [6.0, 5.0], [8.0, 0.0]]]);
    let source = source(format!("IN;SP1;{text}PU;SP0;"));
    let mut marker = as_read(&source, &Job::default());
    let judged = |marker: &Marker| {
        let found = drawing_audit("hpgl", source.bytes(), &DrawingCuts::of(marker), &Job::default());
        found.iter().filter(|finding| !finding.holds()).map(|finding| finding.rule.name).collect::<Vec<_>>()
    };
    assert_eq!(judged(&marker), [""; 0]);
    marker.pieces[0].contours.retain(|contour| contour.closed);
    assert_eq!(judged(&marker), ["source/strokes"]);
}

/// Circles of many chords, of which the mouth of each notch takes up several, also at the start of the outline.
#[test]
fn a_notch_that_is_drawn_over_several_chords_of_a_curve_is_cut() {
    let at = |k: usize, count: usize, reach: f64| {
        let (sine, cosine) = (std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
        format!("{:.0},{:.0}", 8000.0 + reach * cosine, 8000.0 + reach * sine)
    };
    for count in [72, 144, 360] {
        let circle: Vec<String> = (0..=count).map(|k| at(k, count, 2400.0)).collect();
        let mut text = format!("PU{};PD{};", circle[0], circle[1..].join(","));
        // Mouths of 5.2 mm: from one vertex to another, the last over the start of the outline.
        let wide = count / 72;
        for first in [count / 5, count / 2, count - wide / 2 - 1] {
            let middle = at(2 * first + wide, 2 * count, 2200.0);
            let [from, to] = [first, first + wide].map(|k| at(k, count, 2400.0));
            write!(text, "PU{from};PD{middle},{to};").expect("a text takes all");
        }
        let source = source(format!("IN;SP1;{text}PU;SP0;"));
        let (mut out, mut told) = (Cursor::new(Vec::new()), Diagnostics::default());
        let order = Order { from: by_name("hpgl"), target: &TARGETS[0], verify: true };
        let compiled = pipeline::compile(&source, &Job::default(), order, &mut out, &mut told);
        assert!(compiled.expect("memory takes everything").is_some(), "{count}: {}", render(&told, &source));
        let marker = read(&source, &Job::default()).0;
        assert_eq!(marker.pieces[0].outline_notches.len(), 3, "{count}");
    }
}
