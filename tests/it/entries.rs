//! Cuts that begin on a curve: what the plunged blade cannot enter is nibbled, what it enters is cut from there, and how far
//! it then lies beside the line is said.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::io::Cursor;

use cutc::back::TARGETS;
use cutc::diagnostic::code::Severity;
use cutc::diagnostic::{Diagnostics, render};
use cutc::ir::declaration::Kind;
use cutc::machine::{Follow, Job, TightCurves};
use cutc::pipeline::{self, Compiled, Order};
use cutc::source::Source;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::ONE_IN;

/// A worn knife, the same with its axis far behind its tip, and a new one: width and back, mm.
const BLADES: [(f64, f64); 3] = [(6.6, 6.35), (6.6, 2.2), (8.89, 6.35)];
/// In bows that are worth a word, how far a curve must lie beside the blade, by the formula for slight ones, to be sure of
/// one, and of none.
const MUCH: f64 = 1.4;
const LITTLE: f64 = 0.8;
/// Places of a file, mm: as coarse as cut files are.
const UNIT_MM: f64 = 0.1;

fn job((width, back): (f64, f64)) -> Job {
    let mut job = Job::default();
    (job.profile.knife.width_mm, job.profile.knife.back_mm) = (width, Some(back));
    job
}

/// A cut file with one piece of closed outline.
fn source(points: &[[f64; 2]]) -> Source {
    let mut text = String::from("H1*G71*M70*N1*");
    let mut before = None;
    for point in points.iter().chain(points.first()) {
        let place = point.map(|value| (value / UNIT_MM).round() as i64);
        if before == Some(place) {
            continue;
        }
        let _ = match before {
            None => write!(text, "M15*X{}Y{}*M14*", place[0], place[1]),
            Some(_) => write!(text, "X{}Y{}*", place[0], place[1]),
        };
        before = Some(place);
    }
    text.push_str("M15*M0*");
    Source::new("piece.cut", text.into_bytes()).expect("small")
}

/// A plot of the same, which draws it with one instruction: all its vertices are of one block.
fn plot(points: &[[f64; 2]]) -> Source {
    let place = |point: &[f64; 2]| point.map(|value| (value * 40.0).round().to_string()).join(",");
    let places: Vec<String> = points[1..].iter().chain(points.first()).map(place).collect();
    let text = format!("IN;SP1;PU{};PD{};PU;SP0;", place(&points[0]), places.join(","));
    Source::new("piece.plt", text.into_bytes()).expect("small")
}

/// A program that is proven; else what was said.
fn tried(source: &Source, job: &Job, target: &str) -> Result<(Compiled, Diagnostics), Diagnostics> {
    let target = TARGETS.iter().find(|known| known.name == target).expect("a target");
    let (mut out, mut found) = (Cursor::new(Vec::new()), Diagnostics::default());
    let order = Order { from: None, target, verify: true };
    match pipeline::compile(source, job, order, &mut out, &mut found).expect("memory takes everything") {
        Some(compiled) => Ok((compiled, found)),
        None => Err(found),
    }
}

/// A program that is proven, and the codes of what was said.
fn proven(source: &Source, job: &Job, (target, what): (&str, &str)) -> (Compiled, Vec<&'static str>) {
    let (compiled, found) =
        tried(source, job, target).unwrap_or_else(|found| panic!("{what}, {target}: {}", render(&found, source)));
    (compiled, found.iter().map(|said| said.code.name).collect())
}

/// An arc about a centre, from one angle to another, its chords as flat as a unit.
fn arc([x, y]: [f64; 2], radius: f64, [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
    let steps = ((to - from).abs() / (2.0 * (1.0 - 0.5 * UNIT_MM / radius).acos())).ceil().max(3.0);
    let angle = |i: usize| from + (to - from) * i as f64 / steps;
    (0..=steps as usize).map(|i| [x + radius * angle(i).cos(), y + radius * angle(i).sin()]).collect()
}

/// Two arcs that meet in corners: every cut of it begins on a curve.
fn lens(radius: f64) -> Vec<[f64; 2]> {
    let half = 1.2; // rad
    let mut points = arc([0.0, 0.0], radius, [-half, half]);
    points.extend(arc([2.0 * radius * half.cos(), 0.0], radius, [PI - half, PI + half]));
    points
}

#[test]
fn a_piece_that_is_all_curve_is_cut_at_any_radius_and_where_it_is_not_cut_true_that_is_said() {
    for radius in [2.0, 3.0, 4.0, 8.0, 12.0, 20.0, 60.0] {
        let source = source(&lens(radius));
        for blade in BLADES {
            let mut said = Vec::new();
            for target in ["csv", "gcode"] {
                let what = format!("radius {radius}, blade {blade:?}");
                let (compiled, codes) = proven(&source, &job(blade), (target, &what));
                let verdict = compiled.verdict.expect("it was judged");
                assert!(verdict.findings.iter().all(cutc::ir::Finding::holds), "{what}");
                said.push(codes);
            }
            assert_eq!(said[0], said[1], "the knife is the same whoever drives it");
            let (bow, worth) = (blade.0 * blade.0 / (8.0 * radius), Job::default().profile.knife.max_bow_mm);
            let warned =
                said[0].iter().filter(|code| matches!(**code, "path/bowed-plunge" | "path/tight-curve")).count();
            if bow > MUCH * worth {
                assert!(warned > 0, "radius {radius}, blade {blade:?}: nothing is said of {bow} mm");
            } else if bow < LITTLE * worth {
                assert_eq!(warned, 0, "radius {radius}, blade {blade:?}: {bow} mm is worth no word");
            }
        }
    }
}

#[test]
fn what_lies_beside_a_curve_is_nibbled_when_the_profile_says_so() {
    for radius in [8.0, 12.0, 16.0] {
        let source = source(&lens(radius));
        let mut job = job(BLADES[0]);
        let (followed, _) = proven(&source, &job, ("csv", "followed"));
        job.profile.knife.tight_curves = TightCurves::Nibble;
        job.profile.knife.max_bow_mm = 0.1;
        let (nibbled, codes) = proven(&source, &job, ("csv", "nibbled"));
        let body = |compiled: &Compiled| {
            let verdict = compiled.verdict.as_ref().expect("it was judged");
            verdict.findings.iter().find(|finding| finding.rule.name == "verify/body").expect("reported").worst
        };
        assert!(nibbled.report.program.plunge_cuts > followed.report.program.plunge_cuts, "radius {radius}");
        assert!(body(&nibbled) < body(&followed), "radius {radius}");
        assert!(codes.contains(&"path/bowed-plunge"), "radius {radius}: {codes:?}");
    }
}

/// An outline of straight edges and round corners, by chance.
fn rounded(random: &mut ChaCha8Rng) -> Vec<[f64; 2]> {
    let count = random.random_range(4..8);
    let corner = |i: i32, random: &mut ChaCha8Rng| {
        let angle = TAU * (f64::from(i) + random.random_range(-0.3..0.3)) / f64::from(count);
        let reach = random.random_range(60.0..150.0);
        [300.0 + reach * angle.cos(), 300.0 + reach * angle.sin()]
    };
    let corners: Vec<[f64; 2]> = (0..count).map(|i| corner(i, random)).collect();
    let radius = random.random_range(3.0..20.0);
    let mut points = Vec::new();
    for i in 0..corners.len() {
        let [before, here, after] = [i + corners.len() - 1, i, i + 1].map(|k| corners[k % corners.len()]);
        let unit = |to: [f64; 2]| {
            let way = [to[0] - here[0], to[1] - here[1]];
            let length = way[0].hypot(way[1]);
            (way.map(|value| value / length), length)
        };
        let ((u, lu), (v, lv)) = (unit(before), unit(after));
        let half = (u[0] * v[0] + u[1] * v[1]).acos() / 2.0;
        let reach = (radius / half.tan()).min(0.45 * lu.min(lv));
        let radius = reach * half.tan();
        let middle = [u[0] + v[0], u[1] + v[1]];
        let scale = radius / half.sin() / middle[0].hypot(middle[1]);
        let centre = [here[0] + middle[0] * scale, here[1] + middle[1] * scale];
        let angle = |w: [f64; 2]| (here[1] + w[1] * reach - centre[1]).atan2(here[0] + w[0] * reach - centre[0]);
        let from = angle(u);
        let turn = (angle(v) - from + PI).rem_euclid(TAU) - PI;
        points.extend(arc(centre, radius, [from, from + turn]));
    }
    points
}

#[test]
fn rounded_outlines_as_coarse_as_files_have_them_become_programs_of_every_kind() {
    let mut random = ChaCha8Rng::seed_from_u64(6);
    for case in 0..60 / ONE_IN {
        let points = rounded(&mut random);
        let source = source(&points);
        for blade in BLADES {
            for (follow, target) in [(Follow::Tangent, "gcode"), (Follow::Tangent, "csv"), (Follow::Chord, "csv")] {
                let mut job = job(blade);
                job.profile.knife.follow = follow;
                proven(&source, &job, (target, &format!("case {case}, blade {blade:?}, {follow:?}")));
            }
        }
    }
}

#[test]
fn no_heel_leaves_its_line_by_more_than_the_profile_permits() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let mut lifted = 0;
    for case in 0..30 / ONE_IN {
        let points = rounded(&mut random);
        let source = if case % 2 == 0 { plot(&points) } else { source(&points) };
        for blade in BLADES {
            for (follow, target) in [(Follow::Tangent, "gcode"), (Follow::Tangent, "csv"), (Follow::Chord, "csv")] {
                let limit = random.random_range(1.0..4.0);
                let mut job = job(blade);
                job.profile.knife.follow = follow;
                let what = format!("case {case}, blade {blade:?}, {follow:?}, limit {limit}");
                let (free, _) = proven(&source, &job, (target, &what));
                job.profile.knife.max_swing_mm = Some(limit);
                let (kept, codes) = proven(&source, &job, (target, &what));
                let swings = kept.declared.iter().filter(|entry| entry.kind == Kind::Swing);
                let worst = swings.map(|entry| entry.magnitude_mm).fold(0.0, f64::max);
                assert!(worst <= limit + 1e-3, "{what}: {worst} mm");
                assert!(!codes.contains(&"path/swing") || limit > 3.0, "{what}: {codes:?}");
                lifted += usize::from(kept.report.program.lifts > free.report.program.lifts);
            }
        }
    }
    assert!(lifted > 30 / ONE_IN, "only {lifted} of the jobs have a bend to lift at");
}

/// A piece on whose upper edge a short curve stands between two V notches.
fn between_notches(random: &mut ChaCha8Rng) -> Vec<[f64; 2]> {
    let (radius, length) = (random.random_range(12.0..60.0), random.random_range(3.0..9.0));
    let middle: f64 = random.random_range(1.2..1.9);
    let half = length / radius / 2.0;
    let centre = [100.0, 150.0 - radius];
    let at = |angle: f64, reach: f64| [centre[0] + reach * angle.cos(), centre[1] + reach * angle.sin()];
    let (chords, mouth) = (random.random_range(2..6), 2.2 / radius);
    let mut points = vec![[0.0, 0.0], [200.0, 0.0], [200.0, 100.0]];
    // From right to left: a notch, the curve, a notch.
    let [first, last] = [middle - half, middle + half];
    points.extend([at(first - mouth, radius), at(first - mouth / 2.0, radius - 5.0)]);
    let shares = (0..=chords).map(|i| f64::from(i) / f64::from(chords));
    // Chords of a curve are seldom all of one length.
    let uneven = random.random_range(0.8..1.25);
    points.extend(shares.map(|share: f64| at(first + (last - first) * share.powf(uneven), radius)));
    points.extend([at(last + mouth / 2.0, radius - 5.0), at(last + mouth, radius), [0.0, 100.0]]);
    points
}

#[test]
fn short_curves_between_two_notches_become_programs_of_every_kind() {
    let mut random = ChaCha8Rng::seed_from_u64(9);
    let mut pieces: Vec<Vec<[f64; 2]>> = (0..120).map(|_| between_notches(&mut random)).collect();
    // One whose sharper vertex makes two thirds of the turn under the blade.
    let tenths = [[1860, 1825], [3380, 1825], [3380, 3425], [2377, 2570], [2297, 2617], [2283, 2625]];
    let more = [[2260, 2636], [2244, 2641], [2222, 2595], [2224, 2646], [1860, 2650]];
    pieces.push(tenths.iter().chain(&more).map(|&[x, y]| [f64::from(x), f64::from(y)].map(|v| v / 10.0)).collect());
    let mut refused = Vec::new();
    for (case, points) in pieces.iter().enumerate() {
        let source = source(points);
        for blade in BLADES {
            let what = format!("case {case}, blade {blade:?}");
            proven(&source, &job(blade), ("csv", &what));
            if let Err(found) = tried(&source, &job(blade), "gcode") {
                let broken = found.iter().filter(|said| said.code.severity == Severity::Error);
                assert!(broken.clone().all(|said| said.message.starts_with("verify/heading")), "{what}");
                refused.push(what);
            }
        }
    }
    // Where a blade that lies askew has a few tenths of a millimetre to come to the tangent in, arcs of the controller's
    // decimals are too coarse for that.
    assert!(refused.len() <= pieces.len() * BLADES.len() / 100, "{refused:?}");
}
