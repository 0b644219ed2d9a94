//! Outlines that close in another way than by their last place, and notches that are strokes from edge to edge.

use std::fmt::Write as _;

use cutc::diagnostic::Diagnostics;
use cutc::front::by_name;
use cutc::geom::{Point, ring};
use cutc::ir::Marker;
use cutc::ir::marker::OutlineNotch;
use cutc::machine::plot::{Inner, Lines, PenUse};
use cutc::machine::{Job, Numbers};
use cutc::pipeline;
use cutc::verify::{DrawingCuts, drawing_audit};

use super::audit::audit;
use super::{as_read, read, rectangle, source};

/// What a plot is behind the passes, and the codes of what is said; the account of its lines is whole and its parts are
/// right.
pub(super) fn found(text: &str, job: &Job) -> (Marker, Vec<&'static str>) {
    let source = source(format!("IN;SP1;{text}PU;SP0;"));
    let marker = as_read(&source, job);
    assert_eq!(audit(&source, &marker, job), [], "{text}");
    assert_eq!(judged(&source, &marker, job), [] as [&str; 0], "{text}");
    read(&source, job)
}

/// The rules that what is cut of a plot breaks.
fn judged(source: &cutc::source::Source, marker: &Marker, job: &Job) -> Vec<&'static str> {
    let findings = drawing_audit("hpgl", source.bytes(), &DrawingCuts::of(marker), job);
    findings.iter().filter(|finding| !finding.holds()).map(|finding| finding.rule.name).collect()
}

/// Area of each closed contour, mm2.
pub(super) fn areas(marker: &Marker) -> Vec<f64> {
    let closed = marker.contours().filter(|(_, contour)| contour.closed);
    closed.map(|(_, contour)| ring::area(&marker.points(contour)).abs().round()).collect()
}

/// A stroke through places in units.
fn stroke(places: &[[i64; 2]]) -> String {
    let mut text = format!("PU{},{};", places[0][0], places[0][1]);
    for [x, y] in &places[1..] {
        _ = write!(text, "PD{x},{y};");
    }
    text
}

/// A ring of 12 places around a part of some 200 mm.
fn ring_of(random: &mut fastrand::Rng, [x, y]: [i64; 2]) -> Vec<[i64; 2]> {
    let place = |k: i32| {
        let (angle, radius) = (f64::from(k) * std::f64::consts::TAU / 12.0, 3000.0 + 1000.0 * random.f64());
        [x + 5000 + (radius * angle.cos()) as i64, y + 5000 + (radius * angle.sin()) as i64]
    };
    (0..12).map(place).collect()
}

/// A place so many units along a ring from one of its corners.
fn along(ring: &[[i64; 2]], length: f64) -> Vec<[i64; 2]> {
    let (mut left, mut places) = (length, Vec::new());
    for k in 0..ring.len() {
        let [a, b] = [ring[k], ring[(k + 1) % ring.len()]].map(|[x, y]| Point::new(x as f64, y as f64));
        let step = (b - a).norm();
        let at = a + (b - a) * (left / step).min(1.0);
        places.push([at.x.round() as i64, at.y.round() as i64]);
        left -= step;
        if left <= 0.0 {
            return places;
        }
    }
    places
}

/// The length of a closed line, in units of the file.
fn round_of(ring: &[[i64; 2]]) -> f64 {
    let sides = ring.iter().zip(ring.iter().cycle().skip(1));
    sides.map(|([ax, ay], [bx, by])| ((bx - ax) as f64).hypot((by - ay) as f64)).sum()
}

#[test]
fn a_part_is_the_same_whether_its_outline_has_a_gap_runs_past_its_start_or_goes_round_again() {
    let mut random = fastrand::Rng::with_seed(20);
    for _ in 0..40 {
        let ring = ring_of(&mut random, [0, 0]);
        let closed = [&ring[..], &ring[..1]].concat();
        let (plain, codes) = found(&stroke(&closed), &Job::default());
        assert_eq!((areas(&plain).len(), codes), (1, vec![]));

        // Up to nearly a whole round.
        let past = along(&ring, random.f64() * 0.95 * round_of(&ring) + 8.0);
        let (overrun, codes) = found(&stroke(&[&closed[..], &past].concat()), &Job::default());
        assert_eq!((areas(&overrun), codes), (areas(&plain), vec!["marker/overrun"]), "{ring:?}");

        let rounds = [&closed[..], &closed[1..]].concat();
        let (again, codes) = found(&stroke(&rounds), &Job::default());
        assert_eq!((areas(&again), codes), (areas(&plain), vec!["marker/round-again"]), "{ring:?}");

        let way_back: Vec<[i64; 2]> = closed.iter().rev().skip(1).copied().collect();
        let (back, codes) = found(&stroke(&[&closed[..], &way_back].concat()), &Job::default());
        assert_eq!((areas(&back), codes), (areas(&plain), vec!["marker/round-again"]), "{ring:?}");

        let (both, codes) = found(&stroke(&[&rounds[..], &past].concat()), &Job::default());
        assert_eq!(areas(&both), areas(&plain), "{ring:?}");
        assert_eq!(codes, ["marker/overrun", "marker/round-again"]);

        // The last edge ends up to 1.4 mm before the start.
        let [last, first] = [ring[11], ring[0]].map(|[x, y]| Point::new(x as f64, y as f64));
        let gap = 8.0 + 46.0 * random.f64();
        let end = first + (last - first) * (gap / (last - first).norm());
        let open = [&ring[..], &[[end.x.round() as i64, end.y.round() as i64]]].concat();
        let (nearly, codes) = found(&stroke(&open), &Job::default());
        assert_eq!((areas(&nearly).len(), codes), (1, vec!["drawing/closed"]), "{ring:?}");
        assert!((areas(&nearly)[0] - areas(&plain)[0]).abs() <= 3.0, "{ring:?}");
    }
}

#[test]
fn a_seam_line_is_no_part_whatever_the_gap_of_the_outline_around_it() {
    let seam = rectangle(800, 800, 11_200, 11_200);
    let sound = rectangle(20_400, 400, 12_000, 12_000) + &rectangle(20_800, 800, 11_200, 11_200);
    let outline = |gap: i64| format!("PU{},400;PD12400,400,12400,12400,400,12400,400,400;", 400 + gap);
    for (gap, parts, code) in [
        (0, 2, None),
        (4, 2, None),
        (32, 2, Some("drawing/closed")),
        (59, 2, Some("drawing/closed")),
        (61, 1, Some("drawing/open-part")),
        (400, 1, Some("drawing/open-part")),
        (3000, 1, Some("drawing/open-part")),
    ] {
        let text = outline(gap) + &seam + &sound;
        let (marker, codes) = found(&text, &Job::default());
        assert_eq!(marker.pieces.len(), parts, "{gap}");
        let areas = areas(&marker);
        assert!(areas.len() == parts && areas.iter().all(|area| (area - 90_000.0).abs() < 50.0), "{gap} {areas:?}");
        assert_eq!(codes.iter().any(|name| Some(*name) == code), code.is_some(), "{gap} {codes:?}");
    }
}

#[test]
fn a_stroke_from_edge_to_edge_is_a_notch_of_its_outline_as_if_that_drew_it() {
    let outline = "PU4000,4000;PD16000,4000,16000,16000,4000,16000,4000,4000;";
    for (stroke, drawn, kind) in [
        ("PU7880,4000;PD8000,4240,8120,4000;", "7880,4000,8000,4240,8120,4000", "v"),
        ("PU8120,4000;PD8000,4240,7880,4000;", "7880,4000,8000,4240,8120,4000", "v"),
        ("PU7920,4000;PD7920,4160,8080,4160,8080,4000;", "7920,4000,7920,4160,8080,4160,8080,4000", "castle"),
        ("PU7920,4004;PD7920,4160,8080,4160,8080,4004;", "7920,4000,7920,4160,8080,4160,8080,4000", "castle"),
    ] {
        let (one, _) = found(&format!("{outline}{stroke}"), &Job::default());
        let whole = format!("PU4000,4000;PD{drawn},16000,4000,16000,16000,4000,16000,4000,4000;");
        let (other, _) = found(&whole, &Job::default());
        for marker in [&one, &other] {
            let words: Vec<&str> = marker.pieces[0].outline_notches.iter().map(OutlineNotch::word).collect();
            assert_eq!((words, marker.contours().count()), (vec![kind], 1), "{stroke}");
        }
        assert_eq!(areas(&one), areas(&other), "{stroke}");
    }
    // The outline may start in the mouth.
    let (marker, _) = found(
        "PU8000,4000;PD16000,4000,16000,16000,4000,16000,4000,4000,8000,4000;PU7880,4000;PD8000,4240,8120,4000;",
        &Job::default(),
    );
    assert_eq!(marker.pieces[0].outline_notches.len(), 1);
}

#[test]
fn outlines_that_end_at_the_frame_are_closed_along_it_and_lines_across_the_cloth_are_not() {
    let bytes = include_str!("../../../fixtures/hpgl/outlines-that-end-at-the-frame.plt");
    let text = bytes.trim_start_matches("IN;SP1;").trim_end().trim_end_matches("PU;SP0;");
    let (marker, codes) = found(text, &Job::default());
    assert_eq!((marker.pieces.len(), areas(&marker).len(), codes), (4, 4, vec!["drawing/closed"]));
    let (across, codes) = found(&format!("{text}PU9050,0;PD9050,12000;"), &Job::default());
    assert_eq!((across.pieces.len(), codes), (4, vec!["drawing/closed", "drawing/open-outlines"]));
}

/// Reads one plot and judges it by the bytes of another, as if the reader had missed what only the other draws.
pub(super) fn missed(text: &str, all: &str) -> Vec<&'static str> {
    missed_by(text, all, &Job::default())
}

fn missed_by(text: &str, all: &str, job: &Job) -> Vec<&'static str> {
    let [part, whole] = [text, all].map(|text| source(format!("IN;SP1;{text}PU;SP0;")));
    let mut said = Diagnostics::default();
    let marker = pipeline::marker_of(by_name("hpgl").expect("a dialect"), &part, job, &mut said);
    judged(&whole, &marker, job)
}

#[test]
fn a_reader_that_cuts_a_seam_line_for_its_outline_or_loses_a_notch_is_caught() {
    let (outline, seam) = (rectangle(400, 400, 16_000, 12_000), rectangle(800, 800, 15_200, 11_200));
    let open = "PU432,400;PD16400,400,16400,12400,400,12400,400,400;";
    let other = rectangle(20_400, 400, 16_000, 12_000);
    let notch = "PU8000,400;PD8080,600,8160,400;";
    assert_eq!(missed(&format!("{seam}{other}"), &format!("{outline}{seam}{other}")), ["source/outermost"]);
    assert_eq!(missed(&format!("{seam}{other}"), &format!("{open}{seam}{other}")), ["source/outermost"]);
    assert_eq!(
        missed(&format!("{outline}{seam}{other}"), &format!("{outline}{seam}{other}{notch}")),
        ["source/strokes"]
    );
    assert_eq!(
        missed(&format!("{outline}{seam}{other}{notch}"), &format!("{outline}{seam}{other}{notch}")),
        [] as [&str; 0]
    );
}

#[test]
fn a_seam_line_cut_for_its_outline_is_caught_however_wide_the_gap_and_whatever_gaps_are_closed() {
    let seam = rectangle(800, 800, 15_200, 11_200);
    let other = rectangle(20_400, 400, 16_000, 12_000);
    for gap in [61, 120, 600, 2000, 4100] {
        let open = format!("PU{},400;PD16400,400,16400,12400,400,12400,400,400;", 400 + gap);
        assert_eq!(missed(&format!("{seam}{other}"), &format!("{open}{seam}{other}")), ["source/outermost"], "{gap}");
    }
    // The widest gap that may be closed is as wide as the seam is deep.
    let mut job = Job::default();
    for close_mm in [0.0, 1.5, 5.0, 10.0] {
        job.profile.drawing.close_mm = close_mm;
        for (x, gap) in [(400, 0), (400, 30), (760, 0), (785, 0), (785, 30)] {
            let (right, top) = (17_600 - x - 800, 13_600 - x - 800);
            let outline = format!("PU{},{x};PD{right},{x},{right},{top},{x},{top},{x},{x};", x + gap);
            let all = format!("{outline}{seam}{other}");
            assert_eq!(
                missed_by(&format!("{seam}{other}"), &all, &job),
                ["source/outermost"],
                "{close_mm} mm, {x}, {gap}"
            );
            let whole = format!("{outline}{other}");
            assert_eq!(missed_by(&whole, &whole, &job), [""; 0], "{close_mm} mm, {x}, {gap}");
        }
    }
}

#[test]
fn an_outline_of_two_strokes_is_cut_though_the_shorter_one_bulges() {
    let hole = rectangle(4000, 4000, 2000, 1600);
    let text =
        format!("PU16400,2400;PD16400,12400,400,12400,400,400,16400,400;PU16400,400;PD16800,1400,16400,2400;{hole}");
    let lines = Lines { inner: Some(Inner::All), ..Lines::default() };
    let (marker, _) = found(&text, &Job { lines, ..Job::default() });
    assert_eq!(areas(&marker).len(), 2);
}

/// Jobs without a word about pens and with one, in the profile or as an option.
fn jobs_of_pens() -> [Job; 3] {
    let mut jobs = [(); 3].map(|()| Job::default());
    jobs[1].lines.pens = Numbers::parse("1").ok();
    jobs[2].profile.hpgl.pens.insert("1".to_owned(), PenUse::Knife);
    jobs
}

#[test]
fn a_line_that_closes_an_outline_where_nothing_is_drawn_is_caught() {
    // A frame of 500 mm by 300 mm, a part in it, and another rectangle.
    let drawn = [rectangle(0, 0, 20_000, 12_000), rectangle(400, 400, 8000, 6000), rectangle(9000, 400, 8000, 6000)];
    let source = source(format!("IN;SP1;{}PU;SP0;", drawn.concat()));
    let all = |closed: &[[f64; 2]]| -> Vec<Vec<&str>> {
        let judge = |job: &Job| {
            let mut marker = as_read(&source, job);
            let account = marker.drawing.as_mut().expect("a plot has an account");
            account.aside.moved.closed.push(closed.iter().copied().map(Point::from).collect());
            judged(&source, &marker, job)
        };
        jobs_of_pens().iter().map(judge).collect()
    };
    let wrong: [&[[f64; 2]]; 10] = [
        &[[50.0, 50.0], [90.0, 50.0]],
        // From side to side of the frame, across the cloth, and by way of a corner.
        &[[0.0, 100.0], [500.0, 100.0]],
        &[[200.0, 0.0], [200.0, 300.0]],
        &[[0.0, 0.5], [499.5, 300.0]],
        &[[0.0, 100.0], [100.0, 0.0]],
        &[[0.0, 100.0], [0.0, 300.0], [500.0, 100.0]],
        // In line with a side, beyond the corner.
        &[[450.0, 0.0], [550.0, 0.0]],
        &[[520.0, 300.0], [540.0, 300.0]],
        // Beside it by more than the limit.
        &[[100.0, 1.6], [200.0, 1.6]],
        &[[50.0, 50.0], [51.6, 50.0]],
    ];
    for closed in wrong {
        assert_eq!(all(closed), [["source/outermost"]; 3], "{closed:?}");
    }
    let right: [&[[f64; 2]]; 5] = [
        &[[50.0, 50.0], [51.4, 50.0]],
        &[[100.0, 0.0], [200.0, 0.0]],
        &[[100.0, 1.4], [200.0, -1.4]],
        &[[0.0, 100.0], [0.0, 0.0], [200.0, 0.0]],
        &[[500.0, 20.0], [500.0, 300.0], [20.0, 300.0]],
    ];
    for closed in right {
        assert_eq!(all(closed), [[""; 0]; 3], "{closed:?}");
    }
}

#[test]
fn a_rectangle_without_a_corner_draws_nothing_there() {
    // The corner is less than a hundredth of the frame.
    let text = "PU0,0;PD20000,0,20000,10800,19000,12000,0,12000,0,0;";
    let source = source(format!("IN;SP1;{text}{}PU;SP0;", rectangle(400, 400, 8000, 6000)));
    let mut marker = as_read(&source, &Job::default());
    let closed = [[500.0, 272.0], [500.0, 300.0], [478.0, 300.0]].map(Point::from).to_vec();
    marker.drawing.as_mut().expect("a plot has an account").aside.moved.closed.push(closed);
    assert_eq!(judged(&source, &marker, &Job::default()), ["source/outermost"]);
}
