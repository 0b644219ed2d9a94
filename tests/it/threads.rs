//! Threads: where a ring closes, where the knife is lifted amid a line and at corners, the end of one cut meets the start of the
//! next, so that no thread of cloth is left between the two. Measured by points and distances on the rows of the program.

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

use crate::ONE_IN;

/// Head of a cut file, and its unit, mm.
const UNITS: [(&str, f64); 3] = [("H1*G71*", 0.1), ("H1*", 0.254), ("H1*G70*", 0.0254)];
/// Distance between end and start that rows may show, mm: they have six decimals, and chords of a tick.
const NONE: f64 = 1e-3;
/// Length of the overlap that is looked at, back from the end, and of the start that it must lie on, mm.
const TAIL: f64 = 0.4;
const HEAD: f64 = 3.0;

/// Contours of each kind in the long tests.
const CONTOURS: usize = 1000;
/// Widths of a blade and of its back, mm.
const BLADES: [[f64; 2]; 4] = [[6.6, 6.35], [6.0, 4.0], [8.89, 6.35], [3.0, 1.5]];
/// Widest thread that is left anywhere, mm.
const WIDEST: f64 = 0.01;

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

/// What the blade cuts in one: its heel where it plunges, then the way of its tip.
fn strokes(program: &str, [tip, heel]: [f64; 2]) -> Vec<Vec<[f64; 2]>> {
    let mut strokes: Vec<Vec<[f64; 2]>> = vec![Vec::new()];
    for line in program.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit())) {
        let fields: Vec<f64> = line.split(',').take(5).map(|field| field.parse().expect("a number")).collect();
        let (sine, cosine) = fields[3].to_radians().sin_cos();
        match (fields[4] == 1.0, strokes.last_mut()) {
            (true, Some(stroke)) => {
                if stroke.is_empty() {
                    stroke.push([fields[1] - heel * cosine, fields[2] - heel * sine]);
                }
                stroke.push([fields[1] + tip * cosine, fields[2] + tip * sine]);
            }
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

/// Distance of two lines of two points each.
fn between(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> f64 {
    let side = |[from, to]: [[f64; 2]; 2], at: [f64; 2]| {
        (to[0] - from[0]) * (at[1] - from[1]) - (to[1] - from[1]) * (at[0] - from[0])
    };
    let parts = |line, ends: [[f64; 2]; 2]| side(line, ends[0]) * side(line, ends[1]) < 0.0;
    if parts(a, b) && parts(b, a) {
        return 0.0;
    }
    [beside(a[0], b), beside(a[1], b), beside(b[0], a), beside(b[1], a)].into_iter().fold(f64::INFINITY, f64::min)
}

/// What the blade cuts of a contour.
fn cut(points: &[[f64; 2]], unit: (&str, f64), job: &Job, case: usize) -> Vec<Vec<[f64; 2]>> {
    let source = source(points, unit);
    let target = TARGETS.iter().find(|target| target.name == "csv").expect("setpoints are a target");
    let (mut out, mut found) = (Cursor::new(Vec::new()), Diagnostics::default());
    let order = Order { from: None, target, verify: true };
    let compiled = pipeline::compile(&source, job, order, &mut out, &mut found).expect("memory takes everything");
    assert!(compiled.is_some(), "case {case}: {}", render(&found, &source));
    let program = String::from_utf8(out.into_inner()).expect("ASCII");
    let knife = &job.profile.knife;
    strokes(&program, [knife.radius(), knife.width_mm - knife.radius()])
}

/// Whether the tip goes on from where it plunged.
fn moves(stroke: &[[f64; 2]]) -> bool {
    stroke[1..].iter().any(|&tip| apart(tip, stroke[1]) > NONE)
}

/// Distance between the end of a stroke and the start of another one.
fn gap(stroke: &[[f64; 2]], next: &[[f64; 2]], width: f64) -> f64 {
    let lines = |points: &[[f64; 2]]| points.windows(2).map(|ends| [ends[0], ends[1]]).collect::<Vec<_>>();
    let (tail, head) = (first(stroke.iter().rev(), width + HEAD), first(next.iter(), 2.0 * width));
    let apart = lines(&tail).into_iter().flat_map(|a| lines(&head).into_iter().map(move |b| between(a, b)));
    apart.fold(f64::INFINITY, f64::min)
}

fn follow(case: usize) -> Follow {
    if case.is_multiple_of(2) { Follow::Tangent } else { Follow::Chord }
}

#[test]
fn the_end_of_a_ring_runs_over_its_start() {
    let mut random = ChaCha8Rng::seed_from_u64(45);
    let (mut measured, count) = (0, CONTOURS / ONE_IN);
    for case in 0..count {
        let unit = UNITS[case % UNITS.len()];
        let points = outline(&mut random, unit.1);
        let mut job = Job::default();
        job.profile.knife.follow = follow(case);
        let strokes = cut(&points, unit, &job, case);
        let [stroke] = &strokes[..] else { continue };
        // The heel plunges behind the start.
        let tips = &stroke[1..];
        let (tail, head) = (first(tips.iter().rev(), TAIL), first(tips.iter(), HEAD));
        let off = |&point: &[f64; 2]| {
            head.windows(2).map(|ends| beside(point, [ends[0], ends[1]])).fold(f64::INFINITY, f64::min)
        };
        let worst = tail.iter().map(off).fold(0.0, f64::max);
        assert!(worst <= NONE, "case {case}: the end is {worst} mm beside the start");
        measured += 1;
    }
    assert!(10 * measured >= 8 * count, "only {measured} of {count} were cut in one stroke");
}

#[test]
fn a_cut_that_is_lifted_amid_a_line_meets_the_next_one() {
    let mut random = ChaCha8Rng::seed_from_u64(451);
    let (mut lifts, mut wide, count) = (0, 0, CONTOURS / ONE_IN);
    for case in 0..count {
        let unit = UNITS[case % UNITS.len()];
        let points = outline(&mut random, unit.1);
        let mut job = Job::default();
        job.profile.knife.follow = follow(case);
        job.profile.knife.max_down_mm = Some(random.random_range(30.0..100.0));
        let strokes = cut(&points, unit, &job, case);
        let runs: Vec<usize> = (0..strokes.len()).filter(|&k| moves(&strokes[k])).collect();
        if runs.len() < 2 {
            continue; // in one stroke, or by plunges
        }
        for (i, &run) in runs.iter().enumerate() {
            let next = runs[(i + 1) % runs.len()];
            let count = (next + strokes.len() - run) % strokes.len();
            let chain: Vec<&[[f64; 2]]> = (0..=count).map(|k| &strokes[(run + k) % strokes.len()][..]).collect();
            // A plunge amid both may lie beside them where they meet themselves.
            let direct = gap(chain[0], chain[count], job.profile.knife.width_mm);
            let links = chain.windows(2).map(|pair| gap(pair[0], pair[1], job.profile.knife.width_mm));
            let least = direct.min(links.fold(0.0, f64::max));
            assert!(least <= WIDEST, "case {case}, run {i}: {least} mm between a cut and the next one");
            wide += usize::from(least > NONE);
            lifts += 1;
        }
    }
    assert!(lifts >= count, "only {lifts} lifts of {count} contours");
    assert!(1000 * wide <= count, "{wide} of {lifts} are wider than {NONE} mm");
}

/// A contour of straight edges about (300, 300), with corners in and out, none sharper than some 40 degrees.
fn corners(random: &mut ChaCha8Rng) -> Vec<[f64; 2]> {
    let (count, radius) = (random.random_range(4..9), random.random_range(30.0..90.0));
    let place = |k: i32| {
        let angle = TAU * f64::from(k) / f64::from(count);
        let reach = radius * random.random_range(0.6..1.0);
        [300.0 + reach * angle.cos(), 300.0 + reach * angle.sin()]
    };
    (0..count).map(place).collect()
}

#[test]
fn the_cuts_of_two_edges_meet_at_their_corner() {
    let mut random = ChaCha8Rng::seed_from_u64(452);
    let (mut met, count) = (0, CONTOURS / ONE_IN);
    for case in 0..count {
        let points = corners(&mut random);
        let mut job = Job::default();
        let [width, back] = BLADES[case / UNITS.len() % BLADES.len()];
        (job.profile.knife.width_mm, job.profile.knife.back_mm) = (width, Some(back));
        let strokes = cut(&points, UNITS[case % UNITS.len()], &job, case);
        for (i, stroke) in strokes.iter().enumerate() {
            let next = &strokes[(i + 1) % strokes.len()];
            let lines = |points: &[[f64; 2]]| points.windows(2).map(|ends| [ends[0], ends[1]]).collect::<Vec<_>>();
            let (one, other) = (lines(stroke), lines(next));
            let least = one.iter().flat_map(|a| other.iter().map(|b| between(*a, *b))).fold(f64::INFINITY, f64::min);
            assert!(least <= WIDEST, "case {case}, stroke {i}: {least} mm between the cuts of two edges");
            met += 1;
        }
    }
    assert!(met >= 4 * count, "only {met} corners of {count} contours");
}
