//! Common lines: what one cut stands for, that it is measured, and that nothing holds where cuts of several parts meet.

use std::io::{BufReader, Cursor};

use cutc::back::TARGETS;
use cutc::diagnostic::{Diagnostics, render};
use cutc::geom::{Point, Vector, polyline};
use cutc::ir::list::Segment;
use cutc::ir::marker::{Contour, Cut, CutKind, Notch, NotchKind};
use cutc::ir::verdict::Verdict;
use cutc::ir::{Marker, text};
use cutc::machine::{CommonLines, Job, Lines, Numbers, Selection, Start};
use cutc::pipeline::{self, Compiled};
use cutc::source::Source;
use cutc::verify::{self, Ground};

use crate::support::program::{declared, setpoints};
use crate::support::with_cuts;
use crate::verifier::case::{marker, source};

/// Rows of parts that share their edges, each of whose outlines was rounded by itself, with T joints and V notches.
const NEST: &str = "touching-parts";

/// How far a damage moves a cut, mm.
const AWAY: f64 = 3.0;

fn compiled(job: &Job) -> Compiled {
    made(&source(NEST), job)
}

fn made(source: &Source, job: &Job) -> Compiled {
    let target = TARGETS.iter().find(|target| target.name == "csv").expect("setpoints are a target");
    let order = pipeline::Order { from: None, target, verify: true };
    let (mut out, mut found) = (Cursor::new(Vec::new()), Diagnostics::default());
    let compiled = pipeline::compile(source, job, order, &mut out, &mut found).expect("memory takes everything");
    compiled.unwrap_or_else(|| panic!("{}", render(&found, source)))
}

/// Parts of which each is a rectangle from one corner to another, in 0.1 mm, with what stands between them.
fn rectangles(parts: &[[i32; 4]], between: &str) -> Source {
    let part = |(&[left, low, right, high], number): (&[i32; 4], u32)| {
        let corners = [(left, low), (right, low), (right, high), (left, high), (left, low)];
        let at = corners.map(|(x, y)| format!("X{x}Y{y}"));
        format!("N{number}*M15*{}*M14*{}*M15*", at[0], at[1..].join("*"))
    };
    let parts: Vec<String> = parts.iter().zip(1..).map(part).collect();
    Source::new("parts.cut", format!("H1*G71*{}M0*", parts.join(between)).into_bytes()).expect("it is short")
}

fn without() -> Job {
    let mut job = Job::default();
    job.profile.common.lines = Lines::Word(CommonLines::Off);
    job
}

fn length(marker: &Marker, cut: &Cut) -> f64 {
    polyline::length(&marker.list.points(cut.range))
}

#[test]
fn an_edge_of_two_parts_is_cut_once() {
    let (once, twice) = (compiled(&Job::default()).report, compiled(&without()).report);
    let common = once.common.as_ref().expect("parts touch");
    assert!(common.length_m > 0.4 && common.shift_mm <= 0.2 + 1e-9, "{common:?}");
    assert!(twice.common.is_none());
    let spared = twice.cut_m - once.cut_m;
    assert!((common.spared_m - spared).abs() < 1e-9, "{} m, in truth {spared} m", common.spared_m);
    // What runs over the mouths of notches and what is led on are the rest.
    let mouths = once.cut_m - (twice.cut_m - common.length_m);
    assert!((0.0..0.05 * twice.cut_m).contains(&mouths), "{mouths} m");
    let time = |report: pipeline::Report| report.program.time_s.expect("it is planned");
    assert!(time(once) < time(twice));
}

/// An advance may be off by more than edges lie apart.
#[test]
fn no_edge_is_cut_once_over_an_advance_of_the_cloth() {
    let parts = [[100, 100, 2000, 1000], [100, 1000, 2000, 1900]];
    let common = |between: &str| made(&rectangles(&parts, between), &Job::default()).report.common;
    assert!(common("").is_some());
    assert!(common("M69*").is_none());
}

#[test]
fn a_strap_between_two_parts_keeps_both_of_its_edges_however_wide_common_lines_are() {
    let parts = [[100, 100, 2000, 1000], [100, 1000, 2000, 1005], [100, 1005, 2000, 1900]];
    let mut job = Job::default();
    job.profile.common.lines = Lines::Within(1.0);
    for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        let common = made(&rectangles(&order.map(|i| parts[i]), ""), &job).report.common;
        assert!(common.as_ref().is_none_or(|common| common.shift_mm < 1e-9), "{order:?}: {common:?}");
    }
}

/// A part with a V 1.8 mm wide, no wider than two edges may be apart for a gap between them to be one of rounding; and one
/// beside it, without.
const NOTCHED: &str = "N1*M15*X0Y0*M14*X2000Y0*X2000Y1000*X1009Y1000*X1000Y950*X991Y1000*X0Y1000*X0Y0*M15*";
const PLAIN: &str = "N2*M15*X0Y1000*M14*X2000Y1000*X2000Y2000*X0Y2000*X0Y1000*M15*";

/// Two parts in this order.
fn two(parts: [&str; 2]) -> Source {
    Source::new("v.cut", format!("H1*G71*{}M0*", parts.concat()).into_bytes()).expect("it is short")
}

/// A job in which edges so far apart are cut once, mm.
fn within(distance: f64) -> Job {
    let mut job = Job::default();
    job.profile.common.lines = Lines::Within(distance);
    job
}

#[test]
fn waste_of_a_notch_that_is_left_on_the_part_that_it_faces_is_refused() {
    let (job, mut found) = (within(1.0), Diagnostics::default());
    let input = pipeline::read(&two([NOTCHED, PLAIN]), None, &job, &mut found).expect("it is read");
    let mut marker = with_cuts(&input.marker, &job);
    // The first part is cut as it is drawn, round its notch, and not straight over that.
    let drawn = marker.pieces[0].contours[0].range;
    let outline = marker.cuts.iter().position(|cut| cut.piece == 0 && cut.kind == CutKind::Outline);
    marker.cuts[outline.expect("it has one")].range = drawn;
    marker.cuts.retain(|cut| cut.piece != 0 || cut.kind == CutKind::Outline);
    let program = setpoints(&marker, &job);
    let ground = Ground::new(&marker, &job.profile);
    let declared = declared(&marker, &job);
    let verdict = verify::setpoints(&mut BufReader::new(&program[..]), Some(&declared), &ground, &job);
    assert!(breaks(&verdict, "verify/complete"), "{:#?}", verdict.broken().collect::<Vec<_>>());
}

#[test]
fn the_waste_of_a_notch_is_cut_off_from_the_part_that_it_faces_however_wide_common_lines_are() {
    for parts in [[NOTCHED, PLAIN], [PLAIN, NOTCHED]] {
        let cut_m = [0.2, 0.5, 1.0].map(|distance| made(&two(parts), &within(distance)).report.cut_m);
        assert!(cut_m.iter().all(|length| (length - cut_m[0]).abs() < 1e-4), "{cut_m:?}");
    }
}

#[test]
fn a_cut_goes_on_through_a_part_that_overlaps_the_next_no_deeper_than_edges_may_be_apart() {
    // The first part ends on the upper edge of the last, which the second overlaps by 0.5 mm: the cut beside that crosses it so
    // much lower.
    let parts = rectangles(&[[1003, 1005, 2000, 2000], [0, 1000, 1000, 2000], [0, 0, 2000, 1005]], "");
    let mut job = Job::default();
    job.profile.common.lines = Lines::Within(1.0);
    let Compiled { report, .. } = made(&parts, &job);
    assert!(report.common.is_some());
}

#[test]
fn each_outline_is_whole_where_that_is_asked_and_where_a_part_is_cut_alone() {
    let marker = marker(NEST, &Job::default());
    let whole = with_cuts(&marker, &without());
    assert!(whole.cuts.iter().all(|cut| cut.kind == CutKind::Outline) && whole.cuts.len() == marker.pieces.len());
    for number in 1..=marker.pieces.len() as u32 {
        let selection = Selection { pieces: Numbers::parse(&number.to_string()).ok(), ..Selection::default() };
        let job = Job { selection, ..Job::default() };
        let alone = compiled(&job);
        assert!(alone.report.common.is_none() && alone.verdict.is_some_and(|verdict| verdict.passes()));
    }
}

/// What was cut before the program was interrupted is not known to be: the parts that are left are cut whole, and their own
/// common edges once.
#[test]
fn a_resumed_program_cuts_the_parts_that_are_left_whole() {
    let parts = [[100, 100, 1000, 1000], [1000, 100, 2000, 1000], [100, 1000, 1000, 1900], [1000, 1000, 2000, 1900]];
    let source = rectangles(&parts, "");
    let all = made(&source, &Job::default()).report;
    let selection = Selection { resume_from: Some(Start::Piece { number: 3, copy: 1 }), ..Selection::default() };
    let rest = made(&source, &Job { selection, ..Job::default() });
    assert!(rest.verdict.is_some_and(|verdict| verdict.passes()));
    let length = |report: &pipeline::Report| report.common.as_ref().map_or(0.0, |common| common.length_m);
    // Four edges of about 90 mm; the last two parts share one of them.
    assert!((length(&all) - 0.37).abs() < 1e-6 && (length(&rest.report) - 0.09).abs() < 1e-6);
    assert!((rest.report.cut_m - (4.0 * 0.09 + 2.0 * 0.09 + 2.0 * 0.1 - 0.09)).abs() < 0.002, "{}", rest.report.cut_m);
}

/// A machine that cuts nothing past the ends of cuts, with a blade that is narrower than the legs of notches are long: what
/// meets then does so by itself.
fn bare() -> Job {
    let mut job = Job::default();
    let knife = &mut job.profile.knife;
    (knife.width_mm, knife.back_mm) = (3.0, Some(1.5));
    (knife.front_overlap_mm, knife.corner_front_overlap_mm) = (0.0, 0.0);
    (knife.heel_overlap_mm, knife.corner_heel_overlap_mm) = (0.0, 0.0);
    job
}

/// The marker with a slit more, 5 mm deep, on an edge of the fourth piece that is cut with the first.
fn with_slit(job: &Job) -> Marker {
    let mut marker = marker(NEST, job);
    let [root, tip] = [90.0, 95.0].map(|y| Point::new(65.0, y));
    let span = marker.list.walk(marker.pieces[3].contours[0].range).next().expect("it is not empty").1.span;
    marker.pieces[3].notches.push(Notch { kind: NotchKind::Slit, root, tip, percent: 100, span });
    with_cuts(&marker, job)
}

/// What is found in the program of other cuts than those of the marker.
fn judged(change: impl FnOnce(&mut Marker)) -> Verdict {
    let job = bare();
    let marker = with_cuts(&marker(NEST, &job), &job);
    let mut other = marker.clone();
    change(&mut other);
    let program = setpoints(&other, &job);
    let ground = Ground::new(&marker, &job.profile);
    verify::setpoints(&mut BufReader::new(&program[..]), Some(&declared(&marker, &job)), &ground, &job)
}

/// The same, where both are judged by what the other cuts are said to be.
fn claimed(change: impl FnOnce(&mut Marker)) -> Verdict {
    let job = bare();
    let mut marker = with_cuts(&marker(NEST, &job), &job);
    change(&mut marker);
    let program = setpoints(&marker, &job);
    let ground = Ground::new(&marker, &job.profile);
    verify::setpoints(&mut BufReader::new(&program[..]), Some(&declared(&marker, &job)), &ground, &job)
}

fn breaks(verdict: &Verdict, rule: &str) -> bool {
    verdict.broken().any(|finding| finding.rule.name == rule)
}

/// The place of an open cut of an outline that is long enough to be damaged.
fn open_cut(marker: &Marker) -> usize {
    let is_long = |cut: &Cut| cut.kind == CutKind::Edge && length(marker, cut) > 20.0 * AWAY;
    marker.cuts.iter().position(is_long).expect("there is one")
}

/// Gives a cut other segments.
fn redraw(marker: &mut Marker, cut: usize, change: impl FnOnce(&mut Vec<Segment>)) {
    let mut segments: Vec<Segment> = marker.list.walk(marker.cuts[cut].range).map(|(_, segment)| segment).collect();
    change(&mut segments);
    marker.cuts[cut].range = marker.list.append(segments).expect("something is left");
}

#[test]
fn the_program_of_a_nest_is_sound() {
    for verdict in [judged(|_| {}), claimed(|_| {})] {
        assert!(verdict.passes(), "{:#?}", verdict.broken().collect::<Vec<_>>());
    }
}

/// A cut that ends before the one that it should cross leaves a thread, whoever says that it should end there.
#[test]
fn a_cut_that_does_not_reach_the_next_is_refused() {
    let shorter = |marker: &mut Marker| {
        let cut = open_cut(marker);
        redraw(marker, cut, |segments| {
            // Without the way on which it is led on.
            segments.pop();
            let last = segments.last_mut().expect("it is longer");
            last.to -= (last.to - last.from).normalize() * AWAY;
        });
    };
    assert!(breaks(&judged(shorter), "verify/complete"));
    let verdict = claimed(shorter);
    assert!(breaks(&verdict, "verify/complete") || breaks(&verdict, "verify/joint"), "{:#?}", verdict.findings);
}

/// The same by less than the outline tells: only where the cuts meet it is seen.
#[test]
fn a_thread_between_two_cuts_is_refused() {
    let verdict = claimed(|marker| {
        let cut = open_cut(marker);
        redraw(marker, cut, |segments| {
            // It is led on at either end; without that it ends where its outline leaves the common edge.
            segments.pop();
            segments.remove(0);
            let back = |from: Point, to: Point| (to - from).normalize() * 0.3;
            let first = segments.first_mut().expect("some is left");
            first.from += back(first.from, first.to);
            let last = segments.last_mut().expect("some is left");
            last.to -= back(last.from, last.to);
        });
    });
    assert!(breaks(&verdict, "verify/joint"), "{:#?}", verdict.findings);
}

/// Where the legs of a notch end before the run over its mouth the part hangs by a thread, wherever else they cross a cut.
#[test]
fn a_thread_at_one_end_of_a_notch_is_refused() {
    for is_start in [true, false] {
        let verdict = claimed(|marker| {
            let is_notch = |cut: &Cut| cut.kind == CutKind::Edge && length(marker, cut) < 5.0 * AWAY;
            let cut = marker.cuts.iter().position(is_notch).expect("notches stand on common edges");
            redraw(marker, cut, |segments| {
                let end = if is_start { segments.first_mut() } else { segments.last_mut() }.expect("it has legs");
                let back = (end.to - end.from).normalize() * 0.5;
                if is_start { end.from += back } else { end.to -= back }
            });
        });
        assert!(breaks(&verdict, "verify/joint"), "{:#?}", verdict.findings);
    }
}

/// An edge that is cut with another part lies up to the band off: a slit on it reaches that cut, so that it is open.
#[test]
fn a_slit_on_a_common_edge_reaches_the_cut_that_stands_for_it() {
    let job = bare();
    let marker = with_slit(&job);
    let slit = marker.cuts.iter().position(|cut| cut.kind == CutKind::Slit).expect("it is cut");
    let root = marker.list.points(marker.cuts[slit].range)[0];
    // The first piece ends at 89.8 mm. A slit that begins beside every edge goes on by the tolerance and a sagitta, 0.2 mm.
    assert!((89.5..89.8).contains(&root.y), "{root}");
    for (back, is_open) in [(0.0, true), (0.45, false)] {
        let mut other = marker.clone();
        redraw(&mut other, slit, |segments| segments[0].from.y += back);
        let program = setpoints(&other, &job);
        let ground = Ground::new(&marker, &job.profile);
        let declared = declared(&marker, &job);
        let verdict = verify::setpoints(&mut BufReader::new(&program[..]), Some(&declared), &ground, &job);
        assert_eq!(breaks(&verdict, "verify/joint"), !is_open, "{:#?}", verdict.findings);
        assert!(!is_open || verdict.passes(), "{:#?}", verdict.findings);
    }
}

#[test]
fn an_open_line_of_a_part_with_common_edges_that_is_not_cut_is_refused() {
    let verdict = claimed(|marker| {
        let owner = marker.cuts[open_cut(marker)].piece as usize;
        let [from, to] = [Point::new(500.0, 500.0), Point::new(510.0, 500.0)];
        let like = marker.list.walk(marker.pieces[owner].contours[0].range).next().expect("it is not empty").1;
        let range = marker.list.append([Segment { from, to, ..like }]).expect("it has a length");
        marker.pieces[owner].contours.push(Contour { range, closed: false });
    });
    assert!(breaks(&verdict, "verify/complete"), "{:#?}", verdict.findings);
}

#[test]
fn an_edge_that_no_cut_stands_for_is_left_uncut() {
    // Nothing is cut where the outline of the second part is said to be another's.
    let verdict = claimed(|marker| {
        let cut = open_cut(marker);
        marker.cuts.remove(cut);
    });
    assert!(breaks(&verdict, "verify/complete"), "{:#?}", verdict.findings);
}

/// An open cut ends beside a corner that no overlap passes: only what is led on past it meets that cut.
#[test]
fn a_corner_that_is_not_passed_leaves_a_thread() {
    let job = bare();
    let marker = with_cuts(&marker(NEST, &job), &job);
    let mut other = marker.clone();
    other.junctions.clear();
    for (program, is_sound) in [(setpoints(&marker, &job), true), (setpoints(&other, &job), false)] {
        let ground = Ground::new(&marker, &job.profile);
        let declared = declared(&marker, &job);
        let verdict = verify::setpoints(&mut BufReader::new(&program[..]), Some(&declared), &ground, &job);
        assert_eq!(breaks(&verdict, "verify/joint"), !is_sound, "{:#?}", verdict.findings);
    }
}

#[test]
fn a_cut_that_is_led_into_a_part_is_refused() {
    let verdict = claimed(|marker| {
        let cut = open_cut(marker);
        let side = if marker.cuts[cut].sides[0].is_some() { AWAY } else { -AWAY };
        redraw(marker, cut, |segments| {
            let last = segments.last_mut().expect("it has some");
            let (along, end) = ((last.to - last.from).normalize(), last.to);
            last.to -= along * (2.0 * AWAY);
            let led = Segment { from: last.to, to: end + Vector::new(-along.y, along.x) * side, ..*last };
            segments.push(led);
        });
    });
    let is_deep = breaks(&verdict, "verify/overcut-neighbour") || breaks(&verdict, "verify/overcut-part");
    assert!(is_deep, "{:#?}", verdict.findings);
}

/// A part with a strip of 1 mm to the next along one side, and that next part.
const STRIP: &str = "marker unit-mm 0.1
piece 1
contour closed
  from 0 0 to 100 0 @0..1#1
  to 100 80 @1..2#2
  to 0 80 @2..3#3
  to 0 0 @3..4#4
piece 2
contour closed
  from 101 20 to 150 20 @10..11#10
  to 150 60 @11..12#11
  to 101 60 @12..13#12
  to 101 20 @13..14#13
";

#[test]
fn near_lines_are_cut_as_slowly_as_is_asked_and_one_that_is_cut_faster_is_refused() {
    let mut slow = Job::default();
    slow.profile.knife.near_percent = 40.0;
    let marker = with_cuts(&text::read_marker(STRIP).expect("a marker"), &slow);
    assert!((marker.near_length() - 80.0).abs() < 1e-6, "{}", marker.near_length());
    for (made, is_sound) in [(&slow, true), (&Job::default(), false)] {
        let program = setpoints(&marker, made);
        let ground = Ground::new(&marker, &slow.profile);
        let declared = declared(&marker, made);
        let verdict = verify::setpoints(&mut BufReader::new(&program[..]), Some(&declared), &ground, &slow);
        assert_eq!(breaks(&verdict, "verify/feed"), !is_sound, "{:#?}", verdict.findings);
        assert!(!is_sound || verdict.passes(), "{:#?}", verdict.findings);
    }
}

#[test]
fn an_edge_is_moved_as_far_as_the_profile_lets_it_and_no_farther() {
    let mut wide = Job::default();
    wide.profile.common.lines = Lines::Within(1.0);
    let marker = with_cuts(&text::read_marker(STRIP).expect("a marker"), &wide);
    let shifts: Vec<f64> = marker.common.iter().map(|edge| edge.shift).collect();
    assert!(matches!(shifts[..], [shift] if (shift - 1.0).abs() < 1e-6), "{shifts:?}");
    let program = setpoints(&marker, &wide);
    let declared = declared(&marker, &wide);
    for (job, is_sound) in [(&wide, true), (&Job::default(), false)] {
        let ground = Ground::new(&marker, &job.profile);
        let verdict = verify::setpoints(&mut BufReader::new(&program[..]), Some(&declared), &ground, job);
        assert_eq!(verdict.passes(), is_sound, "{:#?}", verdict.findings);
        assert_eq!(breaks(&verdict, "verify/complete"), !is_sound, "{:#?}", verdict.findings);
    }
}

/// A part with a U in its right edge, and one that stands out into that with a narrower V.
const FACING: [&str; 2] = [
    "contour closed
  from 0 0 to 100 0 @0..1#1
  to 100 38 @1..2#2
  to 97 38.6 @2..3#3
  to 96 40 @3..4#4
  to 97 41.4 @4..5#5
  to 100 42 @5..6#6
  to 100 80 @6..7#7
  to 0 80 @7..8#8
  to 0 0 @8..9#9
notch u 100 38 to 96 40 to 100 42 segments 4 @3..4#4
",
    "contour closed
  from 100 80 to 100 41 @20..21#20
  to 97.5 40 @21..22#21
  to 100 39 @22..23#22
  to 100 0 @23..24#23
  to 200 0 @24..25#24
  to 200 80 @25..26#25
  to 100 80 @26..27#26
notch v out 100 41 to 97.5 40 to 100 39 segments 2 @21..22#21
",
];

#[test]
fn a_mouth_is_not_cut_over_where_the_other_part_stands_out_into_it() {
    for order in [[0, 1], [1, 0]] {
        let pieces = order.iter().zip(1..).map(|(&i, number)| format!("piece {number}\n{}", FACING[i]));
        let text = pieces.fold(String::from("marker unit-mm 0.1\n"), |text, piece| text + &piece);
        let marker = with_cuts(&text::read_marker(&text).expect("a marker"), &Job::default());
        assert!(!marker.common.is_empty(), "the edges beside it are cut once");
        let middle = Point::new(100.0, 40.0);
        for cut in &marker.cuts {
            let away = polyline::distance(middle, &marker.list.points(cut.range));
            assert!(away > 0.5, "{order:?}: a cut passes {away} mm from the middle of the mouth");
        }
    }
}
