//! The planner of the grbl family: grbl 1.1, grbl-Mega-5X, grblHAL and `FluidNC`.
//!
//! All of them plan alike (`planner.c`: gnea/grbl 12f48a00, fra589/grbl-Mega-5X baaa1be3, grblHAL/core 030c8299;
//! `Planner.cpp`: bdring/FluidNC 035e77e2). The length of a block is the norm of its distances along all axes, degrees of a
//! rotary axis counted as mm. Limits of an axis, divided by its share of the direction, limit speed and acceleration. At a
//! junction the speed is that of an arc which passes it at the junction deviation d: v^2 = a d s / (1 - s), where s is the sine
//! of half the angle between the blocks and a the acceleration along the difference of their directions. Arcs become chords
//! (`mc_arc` in `motion_control.c`), along which the rotary axis turns evenly. Not considered are steps of motors, single
//! precision, and the jerk of grblHAL's `ENABLE_JERK_ACCELERATION`, which is off unless built in. `tests/bench/grbl_time.py`
//! compares the times with those of a simulation by small steps of time.

use super::axes::{norm, slowest};
use super::blocks::{self, Joint, Rules};
use super::planner::Move;
use crate::machine::gcode::Gcode;
use crate::units::S_PER_MIN;

/// Cosine of the angle between two directions above which they are one, and below whose negative they are opposite.
const STRAIGHT: f64 = 0.999_999;
/// Greatest number of chords of an arc: the firmware counts them in 16 bits.
const MOST_CHORDS: f64 = 65_535.0;
/// Least speed of a block: 1 mm/min.
const SPEED_MIN: f64 = 1.0 / S_PER_MIN;

/// Planner of the family.
pub(super) type Pace = blocks::Pace<Grbl>;

/// Rules of the family.
#[derive(Debug)]
pub(super) struct Grbl;

impl Rules for Grbl {
    fn length(ways: [f64; 4]) -> f64 {
        norm(ways)
    }

    fn speed(asked: f64, most: f64) -> f64 {
        most.min(asked).max(SPEED_MIN)
    }

    /// F counts X and Y; the block is longer by the turn.
    fn feed(step: &Move, turn: f64) -> f64 {
        let ratio = if step.length > 0.0 { step.length.hypot(turn) / step.length } else { 1.0 };
        step.feed.speed * ratio
    }

    fn chords(keys: &Gcode, step: &Move) -> f64 {
        let (radius, tolerance) = (step.curvature.abs().recip(), keys.arc_tolerance_mm);
        let half = (tolerance * (2.0 * radius - tolerance)).max(0.0).sqrt();
        // An arc of a radius below half the tolerance is one chord.
        if half > 0.0 { (0.5 * step.length / half).floor().clamp(1.0, MOST_CHORDS) } else { 1.0 }
    }

    fn junction(keys: &Gcode, &Joint { along, speed, axes }: &Joint) -> f64 {
        let corner = junction(along, axes.map(|axis| axis.acceleration), keys.junction_deviation_mm);
        corner.min(speed.powi(2))
    }
}

/// Square of the greatest speed between two directions.
fn junction([before, after]: [[f64; 4]; 2], accelerations: [f64; 4], deviation: f64) -> f64 {
    let cosine: f64 = before.iter().zip(after).map(|(a, b)| a * b).sum();
    if cosine > STRAIGHT {
        return f64::INFINITY;
    }
    if cosine < -STRAIGHT {
        return 0.0;
    }
    let mut change: [f64; 4] = std::array::from_fn(|i| after[i] - before[i]);
    let size = norm(change);
    change = change.map(|way| way / size);
    let (acceleration, _) = slowest(change, accelerations);
    let sine = (0.5 * (1.0 + cosine)).sqrt();
    acceleration * deviation * sine / (1.0 - sine)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::back::gcode::pace::planner::{Feed, Planner};
    use crate::back::target::Limit;
    use crate::geom::{Vector, left};
    use crate::machine::Job;
    use crate::machine::gcode::{Outputs, Planner as Kind, Step};
    use crate::units::{deg, rad};

    /// A controller with Z whose C axis takes 1000 degrees/s and 10,000 degrees/s2, X and Y 500 mm/s and 4000 mm/s2.
    fn pace() -> Pace {
        let mut job = Job::default();
        let keys = &mut job.profile.gcode;
        keys.planner = Kind::Grbl;
        keys.outputs = Outputs::Immediate;
        (keys.z_speed_mm_s, keys.z_acceleration_mm_s2) = (Some(50.0), Some(500.0));
        let axes = &mut job.profile.axes;
        for axis in [&mut axes.x, &mut axes.y] {
            (axis.speed_mm_s, axis.acceleration_mm_s2) = (500.0, 4000.0);
        }
        (axes.c.speed_deg_s, axes.c.acceleration_deg_s2) = (1000.0, 10_000.0);
        Pace::new(&job)
    }

    fn line(way: Vector, turn_deg: f64) -> Move {
        let along = way.try_normalize(0.0).unwrap_or_default();
        let feed = Feed { speed: 200.0, limit: Limit::Feed };
        Move { ways: [way.x, way.y, rad(turn_deg)], length: way.norm(), feed, along: [along; 2], curvature: 0.0 }
    }

    fn time(moves: &[Move]) -> f64 {
        let mut pace = pace();
        for step in moves {
            pace.go(step);
        }
        pace.finish().time
    }

    fn check(time: f64, expected: f64) {
        assert!((time - expected).abs() < 1e-9, "{time} {expected}");
    }

    #[test]
    fn a_line_takes_its_whole_acceleration() {
        check(time(&[line(Vector::new(100.0, 0.0), 0.0)]), 100.0 / 200.0 + 200.0 / 4000.0);
        check(time(&[line(Vector::new(50.0, 0.0), 0.0); 2]), 100.0 / 200.0 + 200.0 / 4000.0);
    }

    #[test]
    fn degrees_count_as_mm_and_the_slowest_axis_limits_the_block() {
        // 30 mm and 40 degrees are 50 long: the speed of 200 mm/s is 333, of which C takes 0.8.
        let block = line(Vector::new(30.0, 0.0), 40.0);
        let speed = 200.0 / 0.6;
        let acceleration: f64 = (4000.0_f64 / 0.6).min(10_000.0 / 0.8);
        check(time(&[block]), 50.0 / speed + speed / acceleration);
        let mut pace = pace();
        pace.go(&line(Vector::new(1.0, 0.0), -100.0));
        let spent = pace.finish();
        assert_eq!(
            spent.limits.iter().map(|(limit, _)| *limit).collect::<Vec<_>>(),
            [Limit::Acceleration('c'), Limit::Speed('c'),]
        );
        // C alone.
        check(time(&[line(Vector::default(), 180.0)]), 180.0 / 200.0 + 200.0 / 10_000.0);
    }

    #[test]
    fn a_right_angle_is_taken_as_fast_as_the_junction_deviation_allows() {
        // The change of direction is at 45 degrees, so both axes together reach sqrt(2) of their acceleration.
        let half = 0.5_f64.sqrt();
        let corner = 4000.0 / half * 0.01 * half / (1.0 - half);
        let leg = (200.0 * 200.0 - corner) / 8000.0;
        let ramps = 200.0 / 4000.0 + (200.0 - corner.sqrt()) / 4000.0;
        let level = (100.0 - 200.0 * 200.0 / 8000.0 - leg) / 200.0;
        let [there, up] = [Vector::new(100.0, 0.0), Vector::new(0.0, 100.0)].map(|way| line(way, 0.0));
        check(time(&[there, up]), 2.0 * (ramps + level));
        // It stops where it turns back.
        check(time(&[there, line(Vector::new(-100.0, 0.0), 0.0)]), 2.0 * time(&[there]));
    }

    #[test]
    fn an_arc_is_chords_of_its_tolerance_on_which_c_turns_evenly() {
        let (radius, sweep) = (50.0, 1.5_f64);
        let along = Vector::new(0.0, 1.0);
        let end = Vector::new(radius * (sweep.cos() - 1.0), radius * sweep.sin());
        let feed = Feed { speed: 100.0, limit: Limit::Feed };
        let arc = Move {
            ways: [end.x, end.y, sweep],
            length: radius * sweep,
            feed,
            along: [along, left(end.normalize())],
            curvature: radius.recip(),
        };
        let mut pace = pace();
        pace.go(&arc);
        // floor(0.5 r t / sqrt(d (2 r - d))), as the firmware counts them.
        assert_eq!(pace.queue.blocks.len(), 83);
        let turn = deg(sweep) / 83.0;
        let chord = 2.0 * radius * (0.5 * sweep / 83.0).sin();
        assert!(pace.queue.blocks.iter().all(|block| (block.length - chord.hypot(turn)).abs() < 1e-9));
        assert_eq!(pace.queue.blocks.iter().filter(|block| block.is_line).count(), 1);
        let spent = pace.finish();
        assert!((spent.time - 0.78).abs() < 0.02, "{spent:?}");
        assert!(spent.time >= arc.length / 100.0 * 0.9999);
    }

    #[test]
    fn z_is_a_move_and_rests_and_codes_stop_the_axes() {
        let mut pace = pace();
        let z = |to_mm, feed_mm_min| Step::Z { to_mm, feed_mm_min };
        // The first move of Z starts from an unknown place.
        pace.steps(&[z(5.0, None), Step::Dwell { time: 0.25 }, z(-5.0, None)]);
        pace.steps(&[Step::Code { m: 3, parameters: Vec::new() }, z(5.0, Some(600.0)), Step::Dwell { time: 0.0 }]);
        let fast = 10.0 / 50.0 + 50.0 / 500.0;
        let slow = 10.0 / 10.0 + 10.0 / 500.0;
        let spent = pace.finish();
        check(spent.time, 0.25 + fast + slow);
        assert!(spent.limits.contains(&(Limit::Rest, 0.25)));
        check(spent.limits.iter().map(|(_, time)| time).sum(), spent.time);
    }

    #[test]
    fn only_an_output_that_is_switched_when_it_is_read_lets_the_axes_go_on() {
        let block = line(Vector::new(50.0, 0.0), 0.0);
        let output = Step::Output { pin: crate::machine::gcode::Number::Plain(0.0), on: true };
        for (outputs, stops) in [(Outputs::Immediate, 1), (Outputs::Queued, 2)] {
            let mut pace = pace();
            pace.keys.outputs = outputs;
            pace.go(&block);
            pace.steps(std::slice::from_ref(&output));
            pace.go(&block);
            check(pace.finish().time, 100.0 / 200.0 + f64::from(stops) * 200.0 / 4000.0);
        }
    }
}
