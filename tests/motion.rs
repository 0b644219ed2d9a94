//! What planning promises: certified samples, near time-optimal, the tip inside the tube, nothing left uncut.

mod support;

use std::f64::consts::{FRAC_PI_4, PI};

use cutc::geom::{Point, angle, polyline};
use cutc::ir::list::Joint;
use cutc::ir::toolpath::{End, Law, Pose, Run, Shape, Step, Toolpath};
use cutc::machine::{Fit, Job};
use cutc::plan::{self, Cut};
use cutc::source::Span;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const PERIOD: f64 = 1e-3;

/// Knife a point, no overlaps, no feed cap, tolerance 0.05 mm.
fn score_job(fit: Fit) -> Job {
    let mut job = Job::default();
    job.profile.knife.width_mm = 0.0;
    job.profile.knife.feed_mm_s = None;
    job.profile.path.fit = fit;
    job
}

fn run(points: Vec<Point>, job: &Job) -> Run {
    let knife = &job.profile.knife;
    Run {
        spans: vec![Span::default(); points.len() - 1],
        joints: vec![Joint::default(); points.len()],
        feeds: vec![knife.feed_mm_s.unwrap_or(f64::INFINITY); points.len() - 1],
        points,
        shape: Shape::Open,
        law: Law::Tangent,
        front: 0.0,
        heel: 0.0,
        ends: [End::default(); 2],
        start: Pose::default(),
        end: Pose::default(),
    }
}

fn solve(run: Run, tolerance: f64, job: &Job) -> Cut {
    let toolpath = Toolpath { piece: 1, tolerance, entry: Pose::default(), steps: vec![Step::Run(run)] };
    plan::solve(&toolpath, job).expect("a motion").remove(0)
}

fn duration(points: Vec<Point>, fit: Fit) -> f64 {
    let job = score_job(fit);
    solve(run(points, &job), 0.05, &job).duration
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
        let time = duration(support::contour(name), Fit::Polygon);
        assert!(time <= 1.01 * reference, "{name}: {time:.4} s against {reference} s");
    }
}

#[test]
fn a_straight_line_takes_its_analytic_time() {
    let time = duration(vec![Point::new(0.0, 0.0), Point::new(500.0, 0.0)], Fit::Polygon);
    assert!((time - 0.606_67).abs() < 2e-4 * 0.606_67);
}

#[test]
fn every_random_run_is_certified_tangent_and_inside_its_tube() {
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
        assert!(excess(&cut.poses, &job) <= 1.0 + 1e-6, "case {case}: {}", excess(&cut.poses, &job));
        let tips: Vec<Point> = cut.poses.iter().map(|pose| pose.ahead(radius)).collect();
        let reach = tolerance + cut.bulge + 1e-9;
        for tip in &tips {
            let away = extended.windows(2).map(|w| polyline::distance_to_segment(*tip, w[0], w[1]));
            assert!(away.fold(f64::INFINITY, f64::min) <= reach, "case {case}: off the path at {tip}");
        }
        let mut way = 0.0;
        for (w, pose) in tips.windows(3).zip(&cut.poses[1..]) {
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
                    let tips: Vec<Point> = cut.poses.iter().map(|pose| pose.ahead(radius)).collect();
                    if run.shape == Shape::Open {
                        swept.push([cut.poses[0].ahead(radius - width), tips[0]]);
                        bow = bow.max(width * turned_within(&run.points, width) / 8.0);
                    }
                    swept.extend(tips.windows(2).map(|w| [w[0], w[1]]));
                    bulge = bulge.max(cut.bulge);
                }
                for step in &toolpath.steps {
                    if let Step::Stab(stab) = step {
                        swept.push([stab.pose.ahead(radius - width), stab.pose.ahead(radius)]);
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
