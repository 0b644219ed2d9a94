//! Parts that touch: edges within the band are one edge, whatever the gap between them, and no gap gives a program that is
//! refused.

use std::fmt::Write as _;

use cutc::ir::declaration::{Declaration, Kind, Which};
use cutc::machine::{CommonLines, Job, Lines, NotchStyle, Spare};
use cutc::pipeline::Compiled;

use crate::support::nests::{Recipe, compiled as verified};

/// The part of the band within which facing edges lie.
const WITHIN: f64 = 0.8;
/// The automatic band of a file in thousandths of an inch, and how far rounding to them may move an edge, mm.
const BAND: f64 = 0.2;
const ROUNDING: f64 = 0.0254;
/// What a gap may turn a blade that is led over to a common edge, degrees: the rest of the way does not depend on it.
const LED_OVER: i32 = 4;
/// What a gap may add to the way along an outline, mm: where something is declared is told to this.
const PLACE: f64 = 2.0;

/// A nest of bricks as CAD draws it: rows that share their edges, with T joints, V notches, and slits drawn as boxes on the
/// common edges; each part is drawn in by half of the gap, mm, all round (negative: they overlap). In thousandths of an inch.
pub(crate) fn bricks(gap: f64) -> String {
    let rows: [(f64, &[f64]); 3] =
        [(0.0, &[110.0, 90.0, 100.0]), (70.0, &[60.0, 150.0, 90.0]), (150.0, &[140.0, 160.0])];
    let heights = [70.0, 80.0, 60.0];
    let mut text = "H1*G70*".to_owned();
    let mut number = 0;
    for ((y, widths), height) in rows.into_iter().zip(heights) {
        let mut x = 0.0;
        for &width in widths {
            number += 1;
            let (left, right) = (x + gap / 2.0, x + width - gap / 2.0);
            let (low, high) = (y + gap / 2.0, y + height - gap / 2.0);
            // A V in the lower edge, a box in the upper one, a V in the right one.
            let points = [
                (left, low),
                (left + 30.0, low),
                (left + 31.0, low + 4.0),
                (left + 32.0, low),
                (right, low),
                (right, low + 25.0),
                (right - 4.0, low + 26.0),
                (right, low + 27.0),
                (right, high),
                (left + 22.1, high),
                (left + 22.1, high - 5.0),
                (left + 22.0, high - 5.0),
                (left + 22.0, high),
                (left, high),
                (left, low),
            ];
            let mils = |value: f64| ((20.0 + value) / 0.0254).round();
            let at = points.map(|(x, y)| format!("X{}Y{}", mils(x), mils(y)));
            let _infallible = write!(text, "N{number}*M15*M15*{}*M14*{}*M15*", at[0], at[1..].join("*"));
            x += width;
        }
    }
    text + "M0*\n"
}

/// A program with its verdict; every rule must hold, and nothing may be refused.
fn compiled(gap: f64, job: &Job) -> (Compiled, Vec<u8>) {
    made(&bricks(gap), &format!("a gap of {gap} mm"), job)
}

fn made(nest: &str, case: &str, job: &Job) -> (Compiled, Vec<u8>) {
    verified(nest, "csv", job).unwrap_or_else(|why| panic!("{case}: {why}"))
}

/// Headings of the blade at its plunges, whole degrees within a turn.
fn headings(program: &[u8]) -> Vec<i32> {
    let text = std::str::from_utf8(program).expect("rows are text");
    let rows = text.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    let mut down = false;
    let mut found = Vec::new();
    for row in rows {
        let is_down = row[4] == "1";
        if is_down && !down {
            let degrees: f64 = row[3].parse().expect("a number");
            found.push((degrees.round() as i32).rem_euclid(360));
        }
        down = is_down;
    }
    found
}

/// A decision: what is done, at which cut, at which end, and about where.
type Decision = (Kind, u32, Option<Which>, i64);

fn decisions(declared: &[Declaration]) -> Vec<Decision> {
    declared.iter().map(|d| (d.kind, d.cut, d.end, (d.from_mm / PLACE).round() as i64)).collect()
}

#[test]
fn within_the_band_the_gap_decides_nothing() {
    let job = Job::default();
    let most = WITHIN * BAND - ROUNDING;
    let (first, program) = compiled(0.0, &job);
    let (decided, headed, figures) = (decisions(&first.declared), headings(&program), first.report.program);
    assert!(decided.iter().any(|decision| decision.0 == Kind::Surplus) && headed.len() > 60, "something is decided");
    for step in -4..=4_i32 {
        let gap = most * f64::from(step) / 4.0;
        let (compiled, program) = compiled(gap, &job);
        let now = decisions(&compiled.declared);
        let without = |these: &[Decision], those: &[Decision]| {
            // A place at the middle between two told ones may be told as either.
            let near = |a: &Decision, b: &Decision| (a.0, a.1, a.2) == (b.0, b.1, b.2) && (a.3 - b.3).abs() <= 1;
            these.iter().filter(|a| !those.iter().any(|b| near(a, b))).copied().collect::<Vec<_>>()
        };
        assert_eq!([without(&now, &decided), without(&decided, &now)], [vec![], vec![]], "a gap of {gap} mm");
        let now = headings(&program);
        let turned = now.iter().zip(&headed).map(|(a, b)| (a - b + 540).rem_euclid(360) - 180);
        assert_eq!(now.len(), headed.len(), "a gap of {gap} mm");
        assert!(
            turned.clone().all(|turn| turn.abs() <= LED_OVER),
            "a gap of {gap} mm: {:?}",
            turned.collect::<Vec<_>>()
        );
        assert_eq!(compiled.report.program.plunge_cuts, figures.plunge_cuts, "a gap of {gap} mm");
    }
}

#[test]
fn the_profile_says_which_part_is_spared() {
    let deepest = |spare: Spare| {
        let mut job = Job::default();
        job.profile.knife.spare = spare;
        let (compiled, _) = compiled(0.5, &job);
        let surplus = compiled.declared.iter().filter(|declared| declared.kind == Kind::Surplus);
        // Each piece is a part here, with two cuts: its slit and its outline.
        surplus.fold([0.0_f64; 2], |[own, other], declared| match declared.part.expect("it lies in a part") {
            part if part == declared.cut / 2 => [own.max(declared.magnitude_mm), other],
            _ => [own, other.max(declared.magnitude_mm)],
        })
    };
    let [both, own, other] = [Spare::Both, Spare::Own, Spare::Other].map(deepest);
    assert!(own[0] < both[0] && both[1] < own[1], "the part itself is spared: {own:?}, {both:?}");
    assert!(other[1] < both[1] && both[0] < other[0], "the neighbours are spared: {other:?}, {both:?}");
}

#[test]
fn no_gap_is_refused_and_all_that_is_cut_beside_the_drawing_is_declared() {
    for (width, back) in [(6.6, 6.35), (3.0, 1.5)] {
        let mut job = Job::default();
        (job.profile.knife.width_mm, job.profile.knife.back_mm) = (width, Some(back));
        for gap in [-1.0, -0.6, -0.35, -0.25, -0.2, -0.15, -0.05, 0.0, 0.1, 0.19, 0.21, 0.3, 0.5, 1.0, 2.0] {
            compiled(gap, &job);
        }
    }
}

#[test]
fn edges_as_far_apart_as_the_profile_lets_them_be_are_cut_once_and_nothing_is_refused() {
    let mut job = Job::default();
    job.profile.common.lines = Lines::Within(1.0);
    for gap in [0.3, 0.5, 0.8] {
        let (made, _) = compiled(gap, &job);
        let common = made.report.common.expect("edges are cut once");
        assert!((common.shift_mm - gap).abs() <= 2.0 * ROUNDING, "{gap} mm: {common:?}");
        // The farther apart edges lie the longer are the ways on which open cuts are led over to them.
        assert!((0.5..1.0).contains(&(common.spared_m / common.length_m)), "{gap} mm: {common:?}");
    }
}

/// A part with a V notch in its upper edge, and a strap of this width along that, behind which lies waste, mm.
fn strap(width: f64) -> String {
    let part = [(0.0, 0.0), (100.0, 0.0), (100.0, 50.0), (51.0, 50.0), (50.0, 46.0), (49.0, 50.0), (0.0, 50.0)];
    let strap = [(0.0, 50.0), (100.0, 50.0), (100.0, 50.0 + width), (0.0, 50.0 + width)];
    let piece = |number: usize, corners: &[(f64, f64)]| {
        let at = |&(x, y): &(f64, f64)| format!("X{}Y{}", (x / 0.0254).round(), (y / 0.0254).round());
        let all: Vec<String> = corners.iter().map(at).collect();
        format!("N{number}*M15*{}*M14*{}*{}*M15*", all[0], all[1..].join("*"), all[0])
    };
    format!("H1*G70*{}{}M0*\n", piece(1, &part), piece(2, &strap))
}

#[test]
fn no_strap_is_cut_across_undeclared_however_narrow_it_is_and_however_wide_the_band() {
    for width in [0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.85, 1.2, 2.0] {
        for band in [None, Some(1.0)] {
            let case = format!("a strap of {width} mm, a band of {band:?}");
            let mut job = Job::default();
            job.profile.nest.band_mm = band;
            job.profile.common.lines = Lines::Word(CommonLines::Off);
            let (made, program) = made(&strap(width), &case, &job);
            let declared = made.declared.iter().any(|said| said.kind == Kind::Surplus && said.part == Some(1));
            // A blade that stands upright amid the strap's length cuts across it.
            let knife = &job.profile.knife;
            let text = std::str::from_utf8(&program).expect("rows are text");
            let across = text.lines().skip(1).any(|line| {
                let row: Vec<f64> = line.split(',').map(|word| word.parse().expect("a number")).collect();
                let [x, y, c] = [row[1], row[2], row[3].to_radians()];
                let ends = [knife.radius(), knife.radius() - knife.width_mm].map(|way| y + way * c.sin());
                row[4] == 1.0
                    && (5.0..95.0).contains(&x)
                    && ends[0].min(ends[1]) < 49.0
                    && ends[0].max(ends[1]) > 50.0 + width
            });
            assert!(declared || !across, "{case}");
        }
    }
}

/// Forms of notches: places along the edge and how deep they stand in the part, mm.
const FORMS: [(&str, &[(f64, f64)]); 5] = [
    ("none", &[]),
    ("v", &[(0.0, 0.0), (2.0, 5.0), (4.0, 0.0)]),
    ("castle", &[(0.0, 0.0), (0.0, 4.0), (4.0, 4.0), (4.0, 0.0)]),
    ("box", &[(0.0, 0.0), (0.0, 5.0), (0.1, 5.0), (0.1, 0.0)]),
    ("u", &[(0.0, 0.0), (0.2, 1.5), (1.0, 2.6), (2.0, 3.0), (3.0, 2.6), (3.8, 1.5), (4.0, 0.0)]),
];
/// Where on an edge a notch stands, mm.
const NOTCH_AT: f64 = 30.0;

/// Two rows of three parts of 100 by 80 mm with a notch in the lower edges; those of the upper row face one in the upper
/// edge of the part below, or the rows are shifted so that corners stand amid edges.
fn rows(gap: f64, notch: &[(f64, f64)], is_facing: bool) -> String {
    let mut text = "H1*G70*".to_owned();
    let mils = |value: f64| ((60.0 + value) / 0.0254).round();
    for number in 0..6 {
        let (column, row) = (f64::from(number % 3), f64::from(number / 3));
        let x = 100.0 * column + if is_facing { 0.0 } else { 40.0 * row };
        let (left, right) = (x + gap / 2.0, x + 100.0 - gap / 2.0);
        let (low, high) = (80.0 * row + gap / 2.0, 80.0 * row + 80.0 - gap / 2.0);
        let mut points = vec![(left, low)];
        points.extend(notch.iter().map(|(along, deep)| (x + NOTCH_AT + along, low + deep)));
        points.extend([(right, low), (right, high)]);
        let upper = notch.iter().rev().map(|(along, deep)| (x + NOTCH_AT + along, high - deep));
        points.extend(upper.filter(|_| is_facing && row == 0.0));
        points.extend([(left, high), (left, low)]);
        let at: Vec<String> = points.into_iter().map(|(x, y)| format!("X{}Y{}", mils(x), mils(y))).collect();
        let _infallible = write!(text, "N{}*M15*{}*M14*{}*M15*", number + 1, at[0], at[1..].join("*"));
    }
    text + "M0*\n"
}

#[test]
fn whatever_notches_stand_on_common_edges_nothing_is_refused() {
    for (form, notch) in FORMS {
        for is_facing in [false, true] {
            for gap in [-0.2, -0.1, 0.0, 0.1, 0.5, 2.0] {
                let case = format!("{form}, facing {is_facing}, a gap of {gap} mm");
                let (compiled, _) = made(&rows(gap, notch, is_facing), &case, &Job::default());
                let length = compiled.report.common.map_or(0.0, |common| common.length_m);
                // Four edges of 80 mm, and 300 mm between the rows, 40 less where they are shifted.
                let expected = if gap.abs() <= WITHIN * BAND { if is_facing { 0.62 } else { 0.58 } } else { 0.0 };
                assert!((expected - 0.02..=expected + 0.03).contains(&length) || gap == -0.2, "{case}: {length} m");
            }
        }
    }
}

/// A part of 100 by 80 mm in a cut-out of another, so many units of 0.1 mm smaller than that on each side.
fn filled(gap: i32, is_first: bool) -> String {
    let ring = |[left, low, right, high]: [i32; 4]| {
        let corners = [(left, low), (right, low), (right, high), (left, high), (left, low)];
        let at = corners.map(|(x, y)| format!("X{x}Y{y}*"));
        format!("M15*{}M14*{}M15*", at[0], at[1..].concat())
    };
    let outer = format!("N1*{}{}", ring([600, 600, 1600, 1400]), ring([100, 100, 2100, 1900]));
    let inner = format!("N2*{}", ring([600 + gap, 600 + gap, 1600 - gap, 1400 - gap]));
    let parts = if is_first { inner + &outer } else { outer + &inner };
    format!("H1*G71*{parts}M0*")
}

#[test]
fn a_part_that_fills_a_cut_out_lies_in_it_whichever_of_the_two_was_rounded_up() {
    let mut whole = Job::default();
    whole.profile.common.lines = Lines::Word(CommonLines::Off);
    for (gap, is_first) in [(-1, true), (-1, false), (0, true), (0, false), (1, true), (1, false), (20, true)] {
        let case = format!("{gap} units, the part first: {is_first}");
        let nest = filled(gap, is_first);
        let length = made(&nest, &case, &Job::default()).0.report.common.map_or(0.0, |common| common.length_m);
        assert_eq!((length * 100.0).round(), if gap == 20 { 0.0 } else { 36.0 }, "{case}");
        let (compiled, _) = made(&nest, &case, &whole);
        assert!((compiled.report.cut_m - (1.48 - 0.0008 * f64::from(gap))).abs() < 1e-6, "{case}");
    }
}

/// The cloth of a notch that is cut as a slit, or not at all, stays with its part: what a blade cuts of it is declared.
#[test]
fn a_frame_that_is_drawn_close_round_a_part_is_cut_with_it_unless_it_is_the_part() {
    let ring = |low: i32, right: i32, high: i32| {
        format!("PU{low},{low};PD{right},{low},{right},{high},{low},{high},{low},{low};")
    };
    let mut job = Job::default();
    job.lines.all = true;
    // Nearer than ends of lines may miss each other it is the part, drawn once more.
    for (units, metres) in [(1, 1.2), (6, 2.4)] {
        let inner = ring(units, 16000 - units, 8000 - units);
        let (compiled, _) = made(&format!("IN;SP1;{}{inner}PU;SP0;", ring(0, 16000, 8000)), "a frame", &job);
        assert!((compiled.report.cut_m - metres).abs() < 0.01, "{units} units: {:?}", compiled.report);
    }
}

#[test]
fn slits_that_were_drawn_as_notches_are_cut_beside_the_parts_they_face() {
    for apart in [0, 1, 5, 12] {
        let nest = format!(
            "H1*G71*N1*M15*X100Y100*M14*X2000Y100*X2000Y1000*X1010Y1000*X1000Y960*X990Y1000*X100Y1000*X100Y100*M15*\
             N2*M15*X100Y{y}*M14*X{}Y{y}*X{}Y{}*X{}Y{y}*X2000Y{y}*X2000Y1900*X100Y1900*X100Y{y}*M15*M0*",
            990 + apart,
            1000 + apart,
            1041,
            1010 + apart,
            y = 1001,
        );
        for style in [NotchStyle::AsDrawn, NotchStyle::Slit, NotchStyle::Skip] {
            for lines in [CommonLines::Auto, CommonLines::Off] {
                let mut job = Job::default();
                job.profile.notch.style = style;
                job.profile.common.lines = Lines::Word(lines);
                made(&nest, &format!("{apart} units apart, {style:?}, {lines:?}"), &job);
            }
        }
    }
}

/// Some faults show only among dozens of parts; `tests/heavy/nests.rs` has more of them.
#[test]
fn nests_of_dozens_of_parts_are_cut_with_the_notches_that_they_were_drawn_with() {
    let wrong = |&(seed, parts): &(u64, usize)| {
        let recipe = Recipe::of(seed, parts, 10);
        let nest = recipe.nest();
        assert_eq!(nest.text, recipe.nest().text, "the same recipe, the same bytes");
        let compiled = match verified(&nest.text, "csv", &Job::default()) {
            Ok((compiled, _)) => compiled,
            Err(why) => return Some(format!("{recipe:?}: {why}")),
        };
        assert!(recipe.gap > 0.4 || compiled.report.common.is_some(), "{recipe:?}: edges are cut once");
        let found = compiled.report.notches;
        (found != nest.notches).then(|| format!("{recipe:?}: {found:?}, drawn were {:?}", nest.notches))
    };
    // In the last one a cut is led on along an edge beside the cut that stands for that.
    let nests = [(2, 30), (5, 30), (8, 30), (11, 30), (13, 30), (17, 30), (22, 30), (25, 30), (54, 16)];
    let found: Vec<String> = nests.iter().filter_map(wrong).collect();
    assert!(found.is_empty(), "{}", found.join("\n\n"));
}
