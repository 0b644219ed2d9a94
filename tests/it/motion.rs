//! What planning promises: certified samples, near time-optimal, the tip inside the tolerance band, nothing left uncut.

use std::f64::consts::{FRAC_PI_4, PI};

use cutc::diagnostic::Diagnostics;
use cutc::geom::{Point, angle, polyline};
use cutc::ir::list::Joint;
use cutc::ir::toolpath::{Edge, End, OrientationMode, Pose, Run, Shape, Step, Toolpath};
use cutc::machine::{self, Job};
use cutc::pipeline;
use cutc::plan::{self, Cut};
use cutc::source::{Source, Span};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::support;

const PERIOD: f64 = 1e-3;
/// Tolerance of the score profile, mm.
const TOLERANCE: f64 = 0.05;

/// The score profile, with changes.
fn score_job(changes: &[&str]) -> Job {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/machines/score.toml");
    let file = Source::new("score.toml", std::fs::read(path).expect("the score profile")).expect("it is small");
    let changes: Vec<String> = changes.iter().map(|&change| change.to_owned()).collect();
    Job { profile: machine::load(Some(&file), &changes).expect("a profile"), ..Job::default() }
}

fn run(points: Vec<Point>, job: &Job) -> Run {
    let knife = &job.profile.knife;
    Run {
        spans: vec![Span::default(); points.len() - 1],
        joints: vec![Joint::default(); points.len()],
        feeds: vec![knife.feed_mm_s.unwrap_or(f64::INFINITY); points.len() - 1],
        junctions: Vec::new(),
        points,
        shape: Shape::Open,
        orientation: OrientationMode::Tangent,
        front: 0.0,
        heel: 0.0,
        ends: [End::default(); 2],
        turned: false,
        edge: Edge::Front,
        start: Pose::default(),
        end: Pose::default(),
    }
}

fn solve(run: Run, tolerance: f64, job: &Job) -> Cut {
    let toolpath = Toolpath { piece: 1, part: 0, tolerance, entry: Pose::default(), steps: vec![Step::Run(run)] };
    plan::solve(&toolpath, job).expect("a motion").remove(0)
}

/// The poses at the ticks of a cut, the one at its end included.
fn poses(cut: &Cut) -> Vec<Pose> {
    cut.poses().collect()
}

/// The score profile's motion along points: the duration before it is stretched to whole periods, s.
fn duration(points: Vec<Point>, changes: &[&str]) -> f64 {
    let job = score_job(changes);
    solve(run(points, &job), TOLERANCE, &job).duration
}

/// A path as files have it: straights, flattened curves, kinks below the corner angle, rounded to a grid.
fn random_path(random: &mut ChaCha8Rng, grid: f64) -> Vec<Point> {
    let mut heading: f64 = random.random_range(-PI..PI);
    let mut at = Point::new(0.0, 0.0);
    let mut points = vec![at];
    for _ in 0..random.random_range(2..12) {
        let (chords, length, turn) = match random.random_range(0..3) {
            0 => (1, random.random_range(0.5..200.0), random.random_range(-0.7..0.7)),
            1 => (random.random_range(3..30), random.random_range(0.5..6.0), random.random_range(-0.25..0.25)),
            _ => (random.random_range(2..6), random.random_range(2.0..30.0), random.random_range(-0.02..0.02)),
        };
        for _ in 0..chords {
            heading += turn;
            at += cutc::geom::Heading::new(heading).unit() * length;
            let rounded = Point::new((at.x / grid).round() * grid, (at.y / grid).round() * grid);
            let turns = points.windows(2).last().is_none_or(|w| {
                polyline::direction(w[1], rounded).is_some_and(|d| angle::turn(w[1] - w[0], d).abs() < FRAC_PI_4)
            });
            if turns && points.last() != Some(&rounded) {
                points.push(rounded);
            }
        }
    }
    if points.len() < 2 {
        points.push(Point::new(10.0 * grid, 0.0));
    }
    points
}

/// Greatest finite differences of order 1 to 3 in parts of the limits, the axes at rest before and behind.
fn excess(poses: &[Pose], job: &Job) -> f64 {
    let row = |pose: &Pose| [pose.centre.x, pose.centre.y, pose.c.0];
    let mut rows: Vec<[f64; 3]> = poses.iter().map(row).collect();
    rows.splice(0..0, [rows[0]; 3]);
    rows.extend([rows[rows.len() - 1]; 3]);
    let limits = job.profile.axes.limits();
    let mut worst = 0.0_f64;
    for w in rows.windows(4) {
        for (axis, limit) in limits.iter().enumerate() {
            let [a, b, c, d] = [0, 1, 2, 3].map(|i| w[i][axis]);
            worst = worst.max((d - c).abs() / PERIOD / limit.speed);
            worst = worst.max((d - 2.0 * c + b).abs() / PERIOD.powi(2) / limit.acceleration);
            worst = worst.max((d - 3.0 * c + 3.0 * b - a).abs() / PERIOD.powi(3) / limit.jerk);
        }
    }
    worst
}

#[test]
fn the_four_contours_come_near_their_references() {
    for (name, reference) in
        [("contour2m_flat", 2.2276), ("sleeve_flat", 0.7023), ("circle64_flat", 0.4051), ("rrect5_flat", 1.5324)]
    {
        let points = support::contour(name);
        let job = score_job(&[]);
        let cut = solve(run(points.clone(), &job), TOLERANCE, &job);
        let time = cut.duration;
        assert!(time <= 1.01 * reference, "{name}: {time:.4} s against {reference} s");
        let tips: Vec<Point> = cut.poses().map(|pose| pose.centre).collect();
        for (from, to, what) in [(&tips, &points, "the knife off the line"), (&points, &tips, "the line off the way")] {
            let away = from.iter().map(|&point| distance(point, to)).fold(0.0, f64::max);
            // Between two samples the way is no chord: at 1 mm a sample and a radius of 5 mm they differ by 25 um.
            assert!(away <= TOLERANCE + 0.025, "{name}: {what} by {away} mm");
        }
    }
}

/// From a point to the nearest of a polyline, mm.
fn distance(point: Point, line: &[Point]) -> f64 {
    line.windows(2).map(|w| polyline::distance_to_segment(point, w[0], w[1])).fold(f64::INFINITY, f64::min)
}

#[test]
fn the_circle_of_the_seed_file_is_cut_in_two_fifths_of_a_second() {
    let job = score_job(&["path.fit=\"curve\""]);
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/iso/seed-circle.cut");
    let source = Source::new("seed-circle.cut", std::fs::read(path).expect("the file")).expect("it is small");
    let input = pipeline::read(&source, None, &job, &mut Diagnostics::default()).expect("a cut file");
    let marker = &input.marker;
    let segments: Vec<_> = marker.list.walk(marker.pieces[0].contours[0].range).map(|(_, segment)| segment).collect();
    let points = std::iter::once(segments[0].from).chain(segments.iter().map(|segment| segment.to)).collect();
    let cut = solve(run(points, &job), job.profile.tolerance(marker.unit), &job);
    assert!(cut.duration <= 0.42, "{} s", cut.duration);
}

#[test]
fn a_straight_line_takes_its_analytic_time() {
    let time = duration(vec![Point::new(0.0, 0.0), Point::new(500.0, 0.0)], &[]);
    assert!((time - 0.606_67).abs() < 2e-4 * 0.606_67);
}

/// A path of straights and bends, 0.3 mm to 3 m long.
fn path_of_any_length(random: &mut ChaCha8Rng) -> Vec<Point> {
    let length = 0.3 * 10_f64.powf(random.random_range(0.0..4.0));
    let chords = random.random_range(2..40);
    let mut heading: f64 = random.random_range(-PI..PI);
    let mut points = vec![Point::origin()];
    for _ in 0..chords {
        heading += random.random_range(-0.7..0.7) * random.random_range(0.0_f64..1.0).powi(3);
        let share = random.random_range(0.2..1.8) * length / f64::from(chords);
        points.push(points[points.len() - 1] + cutc::geom::Heading::new(heading).unit() * share);
    }
    points
}

#[test]
fn runs_of_any_length_keep_the_limits_and_take_as_long_backward_and_turned() {
    let point = score_job(&[]);
    let mut eccentric = Job::default();
    eccentric.profile.knife.back_mm = Some(2.2);
    assert!((eccentric.profile.knife.radius() - 4.4).abs() < 1e-9);
    (0..1000 / crate::ONE_IN as u64).into_par_iter().for_each(|seed| {
        let points = path_of_any_length(&mut ChaCha8Rng::seed_from_u64(seed));
        let job = if seed % 2 == 0 { &point } else { &eccentric };
        let width = job.profile.knife.width_mm;
        if width > 0.0 && polyline::first_at_distance(&points, width + 1.0).is_none() {
            return; // shorter than the blade: a plunge cut, which is no run
        }
        let cut = solve(run(points.clone(), job), TOLERANCE, job);
        let excess = excess(&poses(&cut), job);
        assert!(excess <= 1.001, "seed {seed}: {excess} of a limit");
        if width == 0.0 {
            let backward: Vec<Point> = points.iter().rev().copied().collect();
            let turned: Vec<Point> = points.iter().map(|p| Point::new(-p.y, p.x)).collect();
            for (points, what) in [(backward, "backward"), (turned, "turned")] {
                let share = solve(run(points, job), TOLERANCE, job).duration / cut.duration;
                assert!((share - 1.0).abs() < 0.002, "seed {seed}: {what} it takes {share} of the time");
            }
        }
    });
}

#[test]
fn every_random_run_is_certified_tangent_and_inside_its_band() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    for case in 0..150 {
        let grid = [0.001, 0.1, 0.254][case % 3];
        let points = random_path(&mut random, grid);
        let mut job = Job::default();
        job.profile.knife.back_mm = Some([6.35, 2.2][case % 2]);
        let knife = &job.profile.knife;
        let (tolerance, radius, width) = (job.profile.tolerance(grid), knife.radius(), knife.width_mm);
        let mut run = run(points, &job);
        (run.front, run.heel) = (0.8, 0.5);
        let extended = run.extended();
        if polyline::first_at_distance(&extended, width + 1.0).is_none() {
            continue;
        }
        let cut = solve(run, tolerance, &job);
        let poses = poses(&cut);
        assert!(excess(&poses, &job) <= 1.0 + 1e-6, "case {case}: {}", excess(&poses, &job));
        let tips: Vec<Point> = cut.poses().map(|pose| pose.ahead(radius)).collect();
        let reach = tolerance + cut.sagitta + 1e-9;
        for tip in &tips {
            let away = extended.windows(2).map(|w| polyline::distance_to_segment(*tip, w[0], w[1]));
            assert!(away.fold(f64::INFINITY, f64::min) <= reach, "case {case}: off the path at {tip}");
        }
        let mut way = 0.0;
        for (w, pose) in tips.windows(3).zip(&poses[1..]) {
            way += (w[1] - w[0]).norm();
            let along = w[2] - w[0];
            if way > width && along.norm() > 0.02 {
                let off = angle::wrap(along.y.atan2(along.x) - pose.c.0).to_degrees();
                assert!(off.abs() < 0.05, "case {case}: the blade is {off} degrees off at {}", w[1]);
            }
        }
    }
}

#[test]
fn a_lower_limit_never_makes_a_run_faster() {
    let mut random = ChaCha8Rng::seed_from_u64(8);
    for case in 0..40 {
        let points = random_path(&mut random, 0.1);
        let job = Job::default();
        let time = |job: &Job| solve(run(points.clone(), job), 0.071, job).duration;
        let free = time(&job);
        let mut slower = job.clone();
        let (axes, factor) = (&mut slower.profile.axes, random.random_range(0.3..0.95));
        match case % 9 {
            0 => axes.x.speed_mm_s *= factor,
            1 => axes.y.speed_mm_s *= factor,
            2 => axes.c.speed_deg_s *= factor,
            3 => axes.x.acceleration_mm_s2 *= factor,
            4 => axes.y.acceleration_mm_s2 *= factor,
            5 => axes.c.acceleration_deg_s2 *= factor,
            6 => axes.x.jerk_mm_s3 *= factor,
            7 => axes.y.jerk_mm_s3 *= factor,
            _ => axes.c.jerk_deg_s3 *= factor,
        }
        let bound = free * (1.0 - 0.002) - PERIOD;
        assert!(time(&slower) >= bound, "case {case}: {} s against {free} s", time(&slower));
    }
}

/// How far a path turns over its first `length` mm, rad.
fn turned_within(points: &[Point], length: f64) -> f64 {
    let stations = polyline::stations(points);
    let near = points.windows(3).zip(&stations[1..]).take_while(|(_, station)| **station < length);
    near.map(|(w, _)| polyline::turn_at(w[0], w[1], w[2]).abs()).sum()
}

#[test]
fn no_stretch_of_the_contours_is_left_uncut() {
    for name in ["contour2m_flat", "sleeve_flat", "circle64_flat", "rrect5_flat", "wavy751"] {
        for back in [6.35, 2.2] {
            let points = support::contour(name);
            let mut job = Job::default();
            job.profile.knife.back_mm = Some(back);
            let knife = &job.profile.knife;
            let (radius, width) = (knife.radius(), knife.width_mm);
            // What the blade sweeps: its body where it plunges, then the way of its tip.
            let mut swept: Vec<[Point; 2]> = Vec::new();
            let (mut bulge, mut bow) = (0.0_f64, 0.0_f64);
            for toolpath in support::toolpaths(&support::marker(&points), &job) {
                let cuts = plan::solve(&toolpath, &job).expect("a motion");
                for (run, cut) in support::runs(&toolpath).iter().zip(cuts) {
                    let tips: Vec<Point> = cut.poses().map(|pose| pose.ahead(radius)).collect();
                    if run.shape == Shape::Open {
                        swept.extend(cut.poses().next().map(|pose| [pose.ahead(radius - width), tips[0]]));
                        bow = bow.max(width * turned_within(&run.points, width) / 8.0);
                    }
                    swept.extend(tips.windows(2).map(|w| [w[0], w[1]]));
                    bulge = bulge.max(cut.sagitta);
                }
                for step in &toolpath.steps {
                    if let Step::PlungeCut(plunge_cut) = step {
                        swept.push([plunge_cut.pose.ahead(radius - width), plunge_cut.pose.ahead(radius)]);
                    }
                }
            }
            let reach = 0.05 + bulge + bow;
            for chord in points.windows(2) {
                for part in 0..=4 {
                    let point = chord[0] + (chord[1] - chord[0]) * (f64::from(part) / 4.0);
                    let away = swept.iter().map(|s| polyline::distance_to_segment(point, s[0], s[1]));
                    let away = away.fold(f64::INFINITY, f64::min);
                    assert!(away <= reach, "{name}: {point} is {away} mm from anything cut");
                }
            }
        }
    }
}
