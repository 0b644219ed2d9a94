//! Threads: where a ring closes its end runs over its start, so that no thread of cloth is left between the two. Measured by
//! points and distances on the rows of the program.

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::io::Cursor;

use cutc::back::TARGETS;
use cutc::diagnostic::{Diagnostics, render};
use cutc::machine::{Follow, Job};
use cutc::pipeline::{self, Order};
use cutc::source::Source;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Head of a cut file, and its unit, mm.
const UNITS: [(&str, f64); 3] = [("H1*G71*", 0.1), ("H1*", 0.254), ("H1*G70*", 0.0254)];
/// Distance between end and start that rows may show, mm: they have six decimals, and chords of a tick.
const NONE: f64 = 1e-3;
/// Length of the overlap that is looked at, back from the end, and of the start that it must lie on, mm.
const TAIL: f64 = 0.4;
const HEAD: f64 = 3.0;

/// A smooth contour about (300, 300): a circle, an ellipse or one with three bays.
fn outline(random: &mut ChaCha8Rng, unit: f64) -> Vec<[f64; 2]> {
    let (radius, kind) = (random.random_range(4.0..60.0), random.random_range(0..3));
    let (flat, phase) = (random.random_range(0.5..0.9), random.random_range(0.0..TAU));
    let turn = if random.random_bool(0.5) { 1.0 } else { -1.0 };
    // Chords whose sagitta is a quarter of the unit.
    let count = (TAU / (2.0 * (1.0 - 0.25 * unit / radius).acos())).clamp(14.0, 400.0) as i32;
    let place = |i: i32| {
        let angle = turn * TAU * f64::from(i) / f64::from(count);
        let reach = if kind == 2 { radius * (1.0 + 0.1 * (3.0 * angle + phase).cos()) } else { radius };
        [300.0 + reach * angle.cos(), 300.0 + reach * angle.sin() * if kind == 1 { flat } else { 1.0 }]
    };
    (0..count).map(place).collect()
}

fn source(points: &[[f64; 2]], (head, unit): (&str, f64)) -> Source {
    let mut places: Vec<[i64; 2]> = points.iter().map(|p| p.map(|value| (value / unit).round() as i64)).collect();
    places.push(places[0]);
    places.dedup();
    let mut text = format!("{head}N1*M15*X{}Y{}*M14*", places[0][0], places[0][1]);
    for [x, y] in &places[1..] {
        write!(text, "X{x}Y{y}*").expect("a text takes all");
    }
    Source::new("ring.cut", (text + "M15*M0*").into_bytes()).expect("small")
}

/// The tips of each stretch that is cut in one.
fn strokes(program: &str, radius: f64) -> Vec<Vec<[f64; 2]>> {
    let mut strokes: Vec<Vec<[f64; 2]>> = vec![Vec::new()];
    for line in program.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit())) {
        let fields: Vec<f64> = line.split(',').take(5).map(|field| field.parse().expect("a number")).collect();
        let (sine, cosine) = fields[3].to_radians().sin_cos();
        match (fields[4] == 1.0, strokes.last_mut()) {
            (true, Some(stroke)) => stroke.push([fields[1] + radius * cosine, fields[2] + radius * sine]),
            (false, Some(stroke)) if !stroke.is_empty() => strokes.push(Vec::new()),
            _ => {}
        }
    }
    strokes.retain(|stroke| !stroke.is_empty());
    strokes
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

/// How far a point lies from a line between two others.
fn beside(point: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let way = [b[0] - a[0], b[1] - a[1]];
    let squared = way[0] * way[0] + way[1] * way[1];
    let along = (point[0] - a[0]) * way[0] + (point[1] - a[1]) * way[1];
    let share = if squared > 0.0 { (along / squared).clamp(0.0, 1.0) } else { 0.0 };
    apart(point, [a[0] + way[0] * share, a[1] + way[1] * share])
}

/// The first points of a stroke, over so much of it.
fn first<'a>(stroke: impl Iterator<Item = &'a [f64; 2]>, length: f64) -> Vec<[f64; 2]> {
    let mut way = 0.0;
    let mut found: Vec<[f64; 2]> = Vec::new();
    for &point in stroke {
        way += found.last().map_or(0.0, |&last| apart(last, point));
        if way > length {
            break;
        }
        found.push(point);
    }
    found
}

#[test]
fn the_end_of_a_ring_runs_over_its_start() {
    let mut random = ChaCha8Rng::seed_from_u64(45);
    let mut measured = 0;
    for case in 0..90 {
        let unit = UNITS[case % UNITS.len()];
        let source = source(&outline(&mut random, unit.1), unit);
        let mut job = Job::default();
        job.profile.knife.follow = if case % 2 == 0 { Follow::Tangent } else { Follow::Chord };
        let target = TARGETS.iter().find(|target| target.name == "csv").expect("setpoints are a target");
        let (mut out, mut found) = (Cursor::new(Vec::new()), Diagnostics::default());
        let order = Order { from: None, target, verify: true };
        let compiled = pipeline::compile(&source, &job, order, &mut out, &mut found).expect("memory takes everything");
        assert!(compiled.is_some(), "case {case}: {}", render(&found, &source));
        let program = String::from_utf8(out.into_inner()).expect("ASCII");
        let strokes = strokes(&program, job.profile.knife.radius());
        let [stroke] = &strokes[..] else { continue };
        let (tail, head) = (first(stroke.iter().rev(), TAIL), first(stroke.iter(), HEAD));
        let off = |&point: &[f64; 2]| {
            head.windows(2).map(|ends| beside(point, [ends[0], ends[1]])).fold(f64::INFINITY, f64::min)
        };
        let worst = tail.iter().map(off).fold(0.0, f64::max);
        assert!(worst <= NONE, "case {case}: the end is {worst} mm beside the start");
        measured += 1;
    }
    assert!(measured >= 80, "only {measured} were cut in one stroke");
}
