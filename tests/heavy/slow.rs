//! Programs that were accepted, looked at once more by somebody who knows nothing but points and distances: every point of
//! the outline against everything that was cut, and the other way round. No index, and nothing of the verifier.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::io::Cursor;

use cutc::back::TARGETS;
use cutc::diagnostic::Diagnostics;
use cutc::ir::declaration::{Declaration, Kind};
use cutc::machine::{Job, TightCurves};
use cutc::pipeline::{self, Order};
use cutc::source::Source;
use fastrand::Rng;
use rayon::prelude::*;

type Place = [f64; 2];

/// Shapes that are looked at with every machine.
const SHAPES: u64 = 60;
/// What is still the edge of a part, mm.
const BAND: f64 = 0.2;
/// How far beyond the chords of a curve the cut may bow, mm: the default of `path.chord_sag_max_mm`.
const SAGITTA: f64 = 0.15;
/// Distance of two places of an outline that are looked at, mm.
const STEP: f64 = 0.25;
/// How far beside where it is declared a deviation may be, mm.
const ASIDE: f64 = 1.5;
/// Rounding of the rows and of the sums over them, mm.
const ROUNDING: f64 = 1e-4;

/// A way to set the machine.
type Machine = (&'static str, fn(&mut Job));

const MACHINES: &[Machine] = &[
    ("default", |_| {}),
    ("wide", |job| (job.profile.knife.width_mm, job.profile.knife.back_mm) = (8.89, Some(6.35))),
    ("narrow", |job| (job.profile.knife.width_mm, job.profile.knife.back_mm) = (3.0, Some(1.5))),
    ("nibble", |job| job.profile.knife.tight_curves = TightCurves::Nibble),
    ("coarse", |job| job.profile.path.tolerance_mm = Some(0.3)),
    ("corners", |job| job.profile.corner.angle_deg = 70.0),
];

fn away(a: Place, b: Place) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

fn to_segment(point: Place, [a, b]: [Place; 2]) -> f64 {
    let way = [b[0] - a[0], b[1] - a[1]];
    let square = way[0] * way[0] + way[1] * way[1];
    let along = (point[0] - a[0]) * way[0] + (point[1] - a[1]) * way[1];
    let share = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
    away(point, [a[0] + way[0] * share, a[1] + way[1] * share])
}

fn to_polyline(point: Place, line: &[Place]) -> f64 {
    line.windows(2).map(|ends| to_segment(point, [ends[0], ends[1]])).fold(f64::INFINITY, f64::min)
}

fn is_inside(point: Place, ring: &[Place]) -> bool {
    let crossed = ring.windows(2).filter(|ends| {
        let (a, b) = (ends[0], ends[1]);
        (a[1] > point[1]) != (b[1] > point[1]) && a[0] + (b[0] - a[0]) * (point[1] - a[1]) / (b[1] - a[1]) > point[0]
    });
    crossed.count() % 2 == 1
}

/// An outline of a seed: a star, a bumpy curve or a rectangle with notches, in the unit of its file, closed.
fn outline(seed: u64) -> Vec<Place> {
    let rng = &mut Rng::with_seed(seed);
    let mut between = |low: f64, high: f64| low + (high - low) * rng.f64();
    let mut points: Vec<Place> = Vec::new();
    match seed % 3 {
        0 => {
            let count = between(5.0, 14.0) as usize;
            for i in 0..count {
                let (turn, reach) = (TAU * i as f64 / count as f64, between(25.0, 70.0));
                points.push([100.0 + reach * turn.cos(), 100.0 + reach * turn.sin()]);
            }
        }
        1 => {
            let (size, wave, count) = (between(15.0, 60.0), between(0.0, 0.15), between(60.0, 400.0) as usize);
            let waves = between(2.0, 6.0).floor();
            for i in 0..count {
                let turn = TAU * i as f64 / count as f64;
                let reach = size * (1.0 + wave * (waves * turn).cos());
                points.push([100.0 + reach * turn.cos(), 100.0 + reach * turn.sin()]);
            }
        }
        _ => {
            points.push([20.0, 20.0]);
            for i in 0..4 {
                let (x, half, deep) = (45.0 + 40.0 * f64::from(i), between(1.0, 4.0), between(2.0, 9.0));
                match i {
                    0 => points.extend([[x - half, 20.0], [x, 20.0 + deep], [x + half, 20.0]]),
                    1 => points.extend([
                        [x - half, 20.0],
                        [x - half, 20.0 + deep],
                        [x + half, 20.0 + deep],
                        [x + half, 20.0],
                    ]),
                    2 => points.extend((0..=12).map(|k| {
                        let turn = std::f64::consts::PI * f64::from(k) / 12.0;
                        [x - half * turn.cos(), 20.0 + half * turn.sin()]
                    })),
                    _ => points.extend([[x - half, 20.0], [x, 20.0 - deep], [x + half, 20.0]]),
                }
            }
            points.extend([[205.0, 20.0], [205.0, 120.0], [20.0, 120.0]]);
        }
    }
    let mut rounded: Vec<Place> = points.iter().map(|place| place.map(|value| (value * 10.0).round() / 10.0)).collect();
    rounded.push(rounded[0]);
    rounded.dedup();
    rounded
}

fn source(ring: &[Place]) -> Source {
    let mut text = String::from("H1*G71*M70*N1*M15*");
    for (i, place) in ring.iter().enumerate() {
        let [x, y] = place.map(|value| (value * 10.0).round() as i64);
        let _ = write!(text, "X{x}Y{y}*{}", if i == 0 { "M14*" } else { "" });
    }
    text.push_str("M15*M0*");
    Source::new("shape.cut", text.into_bytes()).expect("small")
}

/// What the strokes of a program cut: the blade from its heel to its tip where it plunges, then the way of the tip.
fn strokes(program: &str, job: &Job) -> Vec<Vec<Place>> {
    let knife = &job.profile.knife;
    let [lead, heel] = knife.ends();
    let mut strokes: Vec<Vec<Place>> = Vec::new();
    let mut was_down = false;
    for row in program.lines().skip(1) {
        let numbers: Vec<f64> = row.split(',').map(|field| field.parse().expect("a number")).collect();
        let [x, y, c, is_down] = [numbers[1], numbers[2], numbers[3].to_radians(), numbers[4]];
        let ahead = |reach: f64| [x + reach * c.cos(), y + reach * c.sin()];
        if is_down == 1.0 {
            if !was_down {
                strokes.push(vec![ahead(-heel)]);
            }
            strokes.last_mut().expect("begun").push(ahead(lead));
        }
        was_down = is_down == 1.0;
    }
    strokes
}

/// The greatest magnitude that is declared of some kinds about a station of the only cut.
fn declared(entries: &[Declaration], kinds: &[Kind], station: f64, length: f64) -> f64 {
    let about = entries.iter().filter(|entry| kinds.contains(&entry.kind)).filter(|entry| {
        let span = (entry.to_mm - entry.from_mm).rem_euclid(length) + 2.0 * ASIDE;
        (station - entry.from_mm + ASIDE).rem_euclid(length) <= span
    });
    about.map(|entry| entry.magnitude_mm).fold(0.0, f64::max)
}

/// What is wrong with the program of a shape.
fn wrong(seed: u64, (name, set): Machine) -> Option<String> {
    let ring = outline(seed);
    let mut job = Job::default();
    set(&mut job);
    let target = TARGETS.iter().find(|target| target.name == "csv").expect("a target");
    let (mut out, mut found) = (Cursor::new(Vec::new()), Diagnostics::default());
    let order = Order { from: None, target, verify: true };
    let compiled = pipeline::compile(&source(&ring), &job, order, &mut out, &mut found).expect("memory takes it");
    let Some(compiled) = compiled else { return Some(format!("{name} {seed}: no program: {found:?}")) };
    let program = String::from_utf8(out.into_inner()).expect("ASCII");
    let strokes = strokes(&program, &job);
    let knife = &job.profile.knife;
    let tolerance = job.profile.tolerance(0.1) + SAGITTA + ROUNDING;
    let length: f64 = ring.windows(2).map(|ends| away(ends[0], ends[1])).sum();
    // Left: every place of the outline is near something that was cut.
    let mut before = 0.0;
    for ends in ring.windows(2) {
        let chord = away(ends[0], ends[1]);
        let steps = (chord / STEP).ceil() as usize;
        for i in 0..steps {
            let share = i as f64 / steps as f64;
            let place = [0, 1].map(|axis| ends[0][axis] + (ends[1][axis] - ends[0][axis]) * share);
            let left = strokes.iter().map(|stroke| to_polyline(place, stroke)).fold(f64::INFINITY, f64::min);
            let allowed = tolerance + declared(&compiled.declared, &[Kind::Plunge], before + chord * share, length);
            if left > allowed {
                return Some(format!("{name} {seed}: {left} mm left at {place:?}, {allowed} allowed"));
            }
        }
        before += chord;
    }
    // Off and deep: what was cut is near the outline, or in waste beyond an end, or as deep in the part as is declared.
    let reflex = knife.reflex_front_overlap_mm.max(knife.reflex_heel_overlap_mm);
    let kinds = [Kind::Plunge, Kind::Surplus, Kind::Overcut];
    let most = compiled.declared.iter().filter(|entry| kinds.contains(&entry.kind));
    let most = most.map(|entry| entry.magnitude_mm).fold(reflex.max(BAND), f64::max);
    for stroke in &strokes {
        let blade = (1..40).map(|i| {
            let share = f64::from(i) / 40.0;
            [0, 1].map(|axis| stroke[0][axis] + (stroke[1][axis] - stroke[0][axis]) * share)
        });
        for place in blade.chain(stroke.iter().copied().step_by(7)) {
            let off = to_polyline(place, &ring);
            let allowed = if is_inside(place, &ring) { most + tolerance } else { knife.width_mm };
            if off > allowed {
                return Some(format!("{name} {seed}: {off} mm off at {place:?}, {allowed} allowed"));
            }
        }
    }
    None
}

#[test]
fn accepted_programs_leave_nothing_and_cut_nothing_that_is_not_drawn_or_declared() {
    let cases: Vec<(u64, Machine)> =
        (0..SHAPES).flat_map(|seed| MACHINES.iter().map(move |&machine| (seed, machine))).collect();
    let found: Vec<String> = cases.par_iter().filter_map(|&(seed, machine)| wrong(seed, machine)).collect();
    assert!(found.is_empty(), "{} of {}: {found:#?}", found.len(), cases.len());
}
