//! How long planning takes: `cargo run --release --features bench --example motion`; with numbers behind `--`, runs of that many vertices
//! alone, so that `/usr/bin/time -v` says what memory one takes.
//!
//! Medians over rounds in one process; the page `figures` of the manual holds them.

#![expect(clippy::print_stdout, reason = "a measurement prints what it finds")]

#[expect(dead_code, reason = "one of its shapes is enough here")]
#[path = "garment.rs"]
mod garment;

use std::error::Error;
use std::fs;
use std::path::Path;
use std::time::Instant;

use cutc::diagnostic::Diagnostics;
use cutc::geom::Point;
use cutc::ir::list::Joint;
use cutc::ir::toolpath::{Edge, End, OrientationMode, Pose, Run, Shape, Step, Toolpath};
use cutc::machine::{self, Job};
use cutc::source::{Source, Span};
use cutc::{pipeline, plan};

/// Rounds of which the median counts.
const ROUNDS: usize = 21;
/// From here on vertices are too many for that.
const MANY: usize = 100_000;
/// Tolerance of the tip, mm.
const TOLERANCE: f64 = 0.05;

type Failure = Box<dyn Error>;

fn main() -> Result<(), Failure> {
    let profile = fs::read(fixture("machines/score.toml"))?;
    let profile =
        machine::load(Some(&Source::new("score.toml", profile)?), &[]).map_err(|_| "score.toml has faults")?;
    let score = Job { profile, ..Job::default() };

    let counts = std::env::args().skip(1).map(|count| count.parse()).collect::<Result<Vec<usize>, _>>()?;
    if !counts.is_empty() {
        waves(&counts, &score);
        return Ok(());
    }
    let contour = points("contour2m_flat.csv")?;
    let count = contour.len();
    let seconds = median(ROUNDS, || plan_run(&contour, &score));
    println!("contour of 2 m, {count} points       {:>9.2} ms", 1e3 * seconds);
    for length in [10.0, 10_000.0] {
        let line = [Point::origin(), Point::new(length, 0.0)];
        let seconds = median(ROUNDS, || plan_run(&line, &score));
        println!("straight of {length:>5} mm              {:>9.2} us", 1e6 * seconds);
    }
    waves(&[1_000, 10_000, 100_000, 1_000_000], &score);
    for pieces in [40, 160] {
        let mut file = Vec::new();
        garment::write(&garment::Order { pieces, ..garment::Order::default() }, &mut file)?;
        let (source, job) = (Source::new("marker.cut", file)?, Job::default());
        let mut diagnostics = Diagnostics::default();
        let mut input = pipeline::read(&source, None, &job, &mut diagnostics).ok_or("no marker")?;
        let seconds = median(ROUNDS, || {
            let program = pipeline::estimate(&mut input, &source, &job, &mut Diagnostics::default());
            assert!(program.is_ok_and(|program| program.program.time_s.is_some()), "it has a motion");
        });
        println!("marker of {pieces:>3} pieces                {:>9.1} ms", 1e3 * seconds);
    }
    Ok(())
}

/// How long one run of each number of vertices takes.
fn waves(counts: &[usize], score: &Job) {
    for &count in counts {
        let wave = wave(count);
        let seconds = median(if count < MANY { ROUNDS } else { 1 }, || plan_run(&wave, score));
        println!("wave of {count:>7} vertices, a vertex  {:>9.2} us", 1e6 * seconds / count as f64);
    }
}

fn fixture(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name)
}

/// The rows `x_mm,y_mm` of a motion fixture.
fn points(name: &str) -> Result<Vec<Point>, Failure> {
    let text = fs::read_to_string(fixture("motion").join(name))?;
    let mut points = Vec::new();
    for row in text.lines() {
        let mut numbers = row.split(',').map(str::parse);
        if let (Some(Ok(x)), Some(Ok(y))) = (numbers.next(), numbers.next()) {
            points.push(Point::new(x, y));
        }
    }
    Ok(points)
}

/// A sine of amplitude 5 mm and wavelength 60 mm with a vertex every 2 mm of its axis: all its runs are alike.
fn wave(count: usize) -> Vec<Point> {
    let at = |i: usize| 2.0 * i as f64;
    (0..count).map(|i| Point::new(at(i), 5.0 * (at(i) * std::f64::consts::TAU / 60.0).sin())).collect()
}

/// Plans one open run through the points on this thread.
fn plan_run(points: &[Point], job: &Job) {
    let chords = points.len() - 1;
    let run = Run {
        points: points.to_vec(),
        spans: vec![Span::default(); chords],
        joints: vec![Joint::default(); points.len()],
        feeds: vec![f64::INFINITY; chords],
        junctions: Vec::new(),
        shape: Shape::Open,
        orientation: OrientationMode::Tangent,
        front: 0.0,
        heel: 0.0,
        ends: [End::default(); 2],
        turned: false,
        edge: Edge::Front,
        start: Pose::default(),
        end: Pose::default(),
    };
    let toolpath =
        Toolpath { piece: 1, part: 0, tolerance: TOLERANCE, entry: Pose::default(), steps: vec![Step::Run(run)] };
    assert!(plan::solve(&toolpath, job).is_ok(), "it has a motion");
}

/// The median time of some rounds, s.
fn median(rounds: usize, mut work: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..rounds)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[rounds / 2]
}
