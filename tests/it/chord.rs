//! The chord mode, from the file to the program: heel and tip of the blade are both on the line; and what is done about
//! curves that are tighter than the blade.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fmt::Write as _;
use std::io::Cursor;

use cutc::back::TARGETS;
use cutc::diagnostic::{Diagnostics, Severity, render};
use cutc::geom::{Heading, Point, Vector};
use cutc::ir::toolpath::{OrientationMode, Shape, Step};
use cutc::machine::{Follow, Job, TightCurves};
use cutc::pipeline::{self, Compiled, Order};
use cutc::source::Source;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::support;

/// A worn knife, the same with its axis far behind its tip, and a new one: width and back, mm.
const BLADES: [(f64, f64); 3] = [(6.6, 6.35), (6.6, 2.2), (8.89, 6.35)];
/// Curves of each kind.
const CURVES: u64 = 6;

fn job(follow: Follow, (width, back): (f64, f64)) -> Job {
    let mut job = Job::default();
    let knife = &mut job.profile.knife;
    (knife.follow, knife.width_mm, knife.back_mm) = (follow, width, Some(back));
    job
}

fn source(points: &[Point]) -> Source {
    let mut text = String::from("x_mm,y_mm\n");
    for point in points {
        let _ = writeln!(text, "{:.4},{:.4}", point.x, point.y);
    }
    Source::new("curve.csv", text.into_bytes()).expect("small")
}

/// What comes of a compile: the program and its figures, unless it is refused, and what is said.
struct Outcome {
    compiled: Option<Compiled>,
    program: String,
    found: Diagnostics,
}

fn compile(points: &[Point], job: &Job, target: &str) -> Outcome {
    let target = TARGETS.iter().find(|known| known.name == target).expect("a target");
    let (mut out, mut found) = (Cursor::new(Vec::new()), Diagnostics::default());
    let order = Order { from: None, target, verify: true };
    let compiled =
        pipeline::compile(&source(points), job, order, &mut out, &mut found).expect("memory takes everything");
    Outcome { compiled, program: String::from_utf8_lossy(out.get_ref()).into_owned(), found }
}

/// A program that is proven, with nothing said about it but how far its heel swings, and how small it is.
fn proven(points: &[Point], job: &Job, what: &str) -> Compiled {
    let Outcome { compiled, found, .. } = compile(points, job, "csv");
    let compiled = compiled.unwrap_or_else(|| panic!("{what}: {}", render(&found, &source(points))));
    let may_be_said = ["path/swing", "marker/small"];
    let codes: Vec<_> = found.iter().map(|said| said.code.name).filter(|code| !may_be_said.contains(code)).collect();
    assert!(codes.is_empty(), "{what}: {codes:?}");
    compiled
}

fn worst(compiled: &Compiled, rule: &str) -> f64 {
    let verdict = compiled.verdict.as_ref().expect("it was judged");
    verdict.findings.iter().find(|finding| finding.rule.name == rule).expect("every rule is reported").worst
}

/// An arc about a centre, from one angle on through another.
fn arc(centre: Point, radius: f64, [from, through]: [f64; 2]) -> Vec<Point> {
    let steps = ((through.abs() * (radius / 0.1).sqrt()).ceil() as usize).max(8);
    let angle = |i: usize| from + through * i as f64 / steps as f64;
    (0..=steps).map(|i| centre + Heading::new(angle(i)).unit() * radius).collect()
}

fn circle(radius: f64) -> Vec<Point> {
    let mut points = arc(Point::new(50.0, 50.0), radius, [0.0, TAU]);
    let last = points.len() - 1;
    points[last] = points[0];
    points
}

/// Two straights of 30 mm with a rounding of a right angle between them.
fn rounding(radius: f64) -> Vec<Point> {
    let mut points = vec![Point::new(-30.0, 0.0)];
    points.extend(arc(Point::new(0.0, radius), radius, [-FRAC_PI_2, FRAC_PI_2]));
    points.push(Point::new(radius, radius + 30.0));
    points
}

#[test]
fn the_body_leaves_an_arc_by_the_sagitta_of_the_blade_and_not_by_the_swing_of_its_heel() {
    let (radius, width) = (6.5_f64, 6.0);
    let off = |follow| {
        let mut job = job(follow, (width, 2.0));
        job.profile.path.tolerance_mm = Some(0.005);
        worst(&proven(&circle(radius), &job, "a circle"), "verify/body")
    };
    let (chord, tangent) = (radius - (radius * radius - width * width / 4.0).sqrt(), radius.hypot(width) - radius);
    assert!((chord - 0.73).abs() < 0.005 && (tangent - 2.35).abs() < 0.005);
    assert!((off(Follow::Chord) - chord).abs() < 0.02, "{} instead of {chord}", off(Follow::Chord));
    assert!((off(Follow::Tangent) - tangent).abs() < 0.02, "{} instead of {tangent}", off(Follow::Tangent));
}

/// Curves of a kind: their name, and one of them by chance for a blade of a width.
type Kind = (&'static str, fn(&mut ChaCha8Rng, f64) -> Vec<Point>);

const KINDS: &[Kind] = &[
    ("an arc", |random, width| {
        let radius = random.random_range(2.0..20.0) * width;
        arc(Point::origin(), radius, [random.random_range(-3.0..3.0), random.random_range(0.8..3.0)])
    }),
    ("an S with an inflection", |random, width| {
        let (height, length) = (random.random_range(0.5..1.5) * width, random.random_range(1.5..4.0) * width);
        let at = |i: i32| f64::from(i) * 0.7;
        (0..120).map(|i| Point::new(at(i), height * (at(i) / length).sin())).collect()
    }),
    ("the seam of a closed contour", |random, width| circle(random.random_range(0.8..8.0) * width)),
    ("a run shorter than the blade", |random, width| {
        let length = random.random_range(0.3..0.9) * width;
        let radius = random.random_range(1.0..5.0) * width;
        arc(Point::origin(), radius, [0.3, length / radius])
    }),
    ("a curve that starts at a corner", |random, width| {
        let radius = random.random_range(2.0..10.0) * width;
        let turn = random.random_range(1.0..1.8);
        let mut points =
            vec![Heading::new(FRAC_PI_2 + turn).unit() * -30.0].into_iter().map(Point::from).collect::<Vec<_>>();
        let curve = arc(Point::new(-radius, 0.0), radius, [0.0, random.random_range(0.6..1.5)]);
        points.extend(curve);
        points
    }),
    ("a rounded right angle", |random, width| rounding(random.random_range(0.43..2.0) * width)),
];

#[test]
fn curves_of_every_kind_are_cut_as_chords_and_proven_with_every_blade() {
    for (kind, (name, make)) in KINDS.iter().enumerate() {
        for seed in 0..CURVES {
            for blade in BLADES {
                let mut random = ChaCha8Rng::seed_from_u64(seed + 100 * kind as u64);
                let points = make(&mut random, blade.0);
                let what = format!("{name}, seed {seed}, {blade:?}");
                let compiled = proven(&points, &job(Follow::Chord, blade), &what);
                assert_eq!(compiled.report.program.tangent_runs, Some(0), "{what}");
                assert!(worst(&compiled, "verify/heading") < 0.05, "{what}");
            }
        }
    }
}

#[test]
fn the_blade_is_a_chord_from_its_plunge_to_its_lift() {
    for blade in BLADES {
        let job = job(Follow::Chord, blade);
        for (points, shape) in [(circle(20.0), Shape::Ring), (arc(Point::origin(), 20.0, [0.0, 2.0]), Shape::Open)] {
            let toolpath = &support::toolpaths(&support::marker(&points), &job)[0];
            let runs = support::runs(toolpath);
            assert_eq!((runs.len(), runs[0].shape, runs[0].orientation), (1, shape, OrientationMode::Chord));
            // The places that passes tell are those of the polyline, with the overlaps straight on.
            let away =
                |place: Point| (place - Point::new(50.0, 50.0)).norm().min((place - Point::origin()).norm()) - 20.0;
            let knife = &job.profile.knife;
            for pose in [runs[0].start, runs[0].end] {
                let ends = [pose.ahead(knife.radius()), pose.ahead(-knife.back())];
                assert!(ends.iter().all(|&end| away(end).abs() < 0.15), "{shape:?} {ends:?}");
            }
        }
    }
}

#[test]
fn a_program_says_which_mode_its_blade_follows() {
    let job = job(Follow::Chord, BLADES[0]);
    let points = circle(20.0);
    let report = |points: &[Point]| compile(points, &job, "csv").compiled.expect("a program").report.program;
    assert_eq!(report(&points).follow, Some(Follow::Chord));
    assert_eq!((report(&points).tangent_runs, report(&rounding(2.0)).tangent_runs), (Some(0), Some(1)));
    let json = compile(&points, &job, "json").program;
    assert!(json.contains("\"kind\": \"cut\"") && json.contains("\"follow\": \"chord\""), "{json}");
    assert!(compile(&points, &job, "svg").program.contains("the blade as a chord"));
}

#[test]
fn g_code_has_straight_cuts_under_either_mode_and_refuses_curves_as_chords() {
    let job = job(Follow::Chord, BLADES[0]);
    let square = [(0.0, 0.0), (80.0, 0.0), (80.0, 60.0), (0.0, 60.0), (0.0, 0.0)].map(|(x, y)| Point::new(x, y));
    assert!(compile(&square, &job, "gcode").compiled.is_some());
    let refused = compile(&circle(20.0), &job, "gcode");
    let codes: Vec<_> = refused.found.iter().map(|said| said.code.name).collect();
    assert!(refused.compiled.is_none() && codes == ["target/refused"], "{codes:?}");
    for target in ["csv", "npy", "json"] {
        assert!(compile(&circle(20.0), &job, target).compiled.is_some(), "{target}");
    }
}

#[test]
fn a_curve_that_is_tighter_than_the_blade_follows_the_tangent_with_a_warning() {
    for blade in BLADES {
        let Outcome { compiled, found, .. } = compile(&rounding(2.0), &job(Follow::Chord, blade), "csv");
        assert!(compiled.is_some(), "{}", render(&found, &source(&rounding(2.0))));
        let said: Vec<_> = found.iter().map(|said| (said.code.name, said.message.clone())).collect();
        let [("path/tight-curve", message)] = &said[..] else { panic!("{said:?}") };
        assert!(message.contains("a curve of radius 2.00 mm"), "{message}");
    }
}

/// Contours with tight curves: rounded outwards, rounded inwards, a rounded notch, a hairpin, a small hole.
fn tight() -> Vec<(&'static str, Vec<Point>)> {
    let at = |list: &[(f64, f64)]| list.iter().map(|&(x, y)| Point::new(x, y)).collect::<Vec<_>>();
    let chain = |parts: [Vec<Point>; 3]| parts.concat();
    let quarter = |x: f64, y: f64, from: f64, through: f64| arc(Point::new(x, y), 2.0, [from, through]);
    vec![
        (
            "a rounded corner",
            chain([
                at(&[(0.0, 0.0)]),
                quarter(58.0, 2.0, -FRAC_PI_2, FRAC_PI_2),
                at(&[(60.0, 50.0), (0.0, 50.0), (0.0, 0.0)]),
            ]),
        ),
        (
            "a rounded step",
            chain([
                at(&[(0.0, 0.0), (60.0, 0.0), (60.0, 30.0)]),
                quarter(32.0, 32.0, -FRAC_PI_2, -FRAC_PI_2),
                at(&[(30.0, 60.0), (0.0, 60.0), (0.0, 0.0)]),
            ]),
        ),
        (
            "a rounded notch",
            chain([
                at(&[(0.0, 0.0), (80.0, 0.0), (80.0, 60.0)]),
                quarter(40.0, 60.0, 0.0, -PI),
                at(&[(0.0, 60.0), (0.0, 0.0)]),
            ]),
        ),
        ("a hairpin", chain([at(&[(0.0, 0.0)]), quarter(40.0, 2.0, -FRAC_PI_2, PI), at(&[(0.0, 4.0)])])),
        ("a small hole", circle(2.0)),
        ("an arc of long chords at the start of a line", {
            let mut points: Vec<Point> =
                (0..=8).map(|i| Point::origin() + Heading::new(0.35 * f64::from(i)).unit() * 2.0).collect();
            points.push(points[8] + Heading::new(0.35 * 8.0 - 0.175 + FRAC_PI_2).unit() * 40.0);
            points
        }),
    ]
}

#[test]
fn tight_curves_are_nibbled_by_plunges_that_leave_nothing_uncut() {
    for (name, points) in tight() {
        for blade in BLADES {
            for follow in [Follow::Chord, Follow::Tangent] {
                let mut job = job(follow, blade);
                job.profile.knife.tight_curves = TightCurves::Nibble;
                let Outcome { compiled, found, .. } = compile(&points, &job, "csv");
                let what = format!("{name}, {blade:?}, {follow:?}");
                let compiled = compiled.unwrap_or_else(|| panic!("{what}: {}", render(&found, &source(&points))));
                assert!(worst(&compiled, "verify/complete") <= 0.01, "{what}");
                assert!(compiled.report.program.plunge_cuts.is_some_and(|plunge_cuts| plunge_cuts >= 4), "{what}");
                assert_eq!(compiled.report.program.tangent_runs, Some(0), "{what}");
                let said: Vec<_> = found.iter().filter(|said| said.code.name == "path/tight-curve").collect();
                assert!(said.len() == 1 && said[0].message.contains("nibbled with "), "{what}: {said:?}");
            }
        }
    }
}

#[test]
fn nibbles_are_as_long_as_the_tolerance_lets_them_be() {
    // sqrt(8 R e), e being 0.9 of the tolerance: on the arc of a right angle.
    for (radius, tolerance) in [(2.0_f64, 0.05), (2.0, 0.2), (1.0, 0.05)] {
        let mut job = job(Follow::Tangent, BLADES[0]);
        job.profile.knife.tight_curves = TightCurves::Nibble;
        job.profile.path.tolerance_mm = Some(tolerance);
        let steps = 200;
        let mut points = vec![Point::new(-30.0, 0.0)];
        points.extend(
            (0..=steps)
                .map(|i| FRAC_PI_2 * f64::from(i) / f64::from(steps))
                .map(|a| Point::new(0.0, radius) + Vector::new(a.sin(), -a.cos()) * radius),
        );
        points.push(Point::new(radius, radius + 30.0));
        let toolpath = &support::toolpaths(&support::marker(&points), &job)[0];
        let plunge_cuts = toolpath.steps.iter().filter(|step| matches!(step, Step::PlungeCut(_))).count();
        let expected = (FRAC_PI_2 * radius / (8.0 * radius * 0.9 * tolerance).sqrt()).ceil() as usize;
        assert!(plunge_cuts.abs_diff(expected) <= 1, "{plunge_cuts} instead of {expected}");
    }
}

#[test]
fn tight_curves_are_refused_when_the_profile_says_so_and_wide_ones_never() {
    for follow in [Follow::Chord, Follow::Tangent] {
        let mut job = job(follow, BLADES[0]);
        job.profile.knife.tight_curves = TightCurves::Refuse;
        for (name, points) in tight() {
            let Outcome { compiled, found, .. } = compile(&points, &job, "csv");
            let errors: Vec<_> = found.iter().filter(|said| said.code.severity == Severity::Error).collect();
            assert!(compiled.is_none() && errors.len() == 1, "{name}");
            assert_eq!(errors[0].code.name, "path/tight-curve-refused", "{name}");
            assert!(errors[0].message.contains(" mm is tighter"), "{name}: {}", errors[0].message);
        }
        proven(&rounding(4.0), &job, "a wide rounding");
    }
}
