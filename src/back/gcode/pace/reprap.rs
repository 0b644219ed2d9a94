//! The planner of `RepRapFirmware` 3.5.
//!
//! Read in its sources (Duet3D/RepRapFirmware, branch 3.5: `Movement/DDA.cpp`, `GCodes/GCodes.cpp`, `Config/Configuration.h`).
//! The length of a block is that of its linear axes if one of them moves, or else that of the rotary axis in degrees, and the
//! direction is the distance of each axis by that length (`DDA::InitStandardMove`). Limits of an axis, divided by its share of
//! the direction, limit speed and acceleration. From block to block the speed of an axis may change at once by M566: at a
//! junction the speed is the greatest at which no axis changes by more (`DDA::MatchSpeeds`). With the usual jerk policy (M566
//! P0) blocks that move X or Y and others do not go on without a stop. A block begins and ends at rest without such a change.
//! Arcs become chords that deviate by 0.005 mm or take 5 ms, between 0.02 and 1 mm long (`GCodes::DoArcMove`), along which the
//! rotary axis turns evenly. Not considered are blocks that are prepared 50 ms ahead and no longer change, input shaping, and
//! the acceleration limits of M204.

use super::axes::{norm, slowest};
use super::blocks::{self, Joint, Rules};
use super::planner::Move;
use crate::machine::gcode::Gcode;

/// Deviation of a chord from its arc, mm, its shortest and its longest length, mm, and the greatest number of chords a second
/// (`MaxArcDeviation`, `MinArcSegmentLength`, `MaxArcSegmentLength`, `MaxArcSegmentsPerSec`).
const ARC_DEVIATION: f64 = 0.005;
const CHORD_MIN: f64 = 0.02;
const CHORD_MAX: f64 = 1.0;
const CHORDS_S: f64 = 200.0;
/// Fraction of a chord above which an arc gets one more.
const ROUNDED_UP: f64 = 0.8;
/// Least speed of a block, mm/s (`DefaultMinFeedrate`).
const SPEED_MIN: f64 = 0.5;

/// Planner of the firmware.
pub(super) type Pace = blocks::Pace<Reprap>;

/// Rules of the firmware.
#[derive(Debug)]
pub(super) struct Reprap;

impl Rules for Reprap {
    fn length([x, y, z, c]: [f64; 4]) -> f64 {
        let linear = norm([x, y, z, 0.0]);
        if linear > 0.0 { linear } else { c.abs() }
    }

    fn speed(asked: f64, most: f64) -> f64 {
        asked.max(SPEED_MIN).min(most)
    }

    /// F counts the linear axes, as the length of the block does.
    fn feed(step: &Move, _: f64) -> f64 {
        step.feed.speed
    }

    fn chords(_: &Gcode, step: &Move) -> f64 {
        let radius = step.curvature.abs().recip();
        let chord = (8.0 * radius * ARC_DEVIATION).sqrt().min(step.feed.speed / CHORDS_S).clamp(CHORD_MIN, CHORD_MAX);
        (step.length / chord + ROUNDED_UP).floor().max(1.0)
    }

    fn junction(keys: &Gcode, &Joint { along: [before, after], speed, .. }: &Joint) -> f64 {
        let moves_xy = |[x, y, ..]: [f64; 4]| x != 0.0 || y != 0.0;
        if moves_xy(before) != moves_xy(after) {
            return 0.0;
        }
        let Gcode { jump_mm_s, jump_deg_s, .. } = *keys;
        let jumps = [jump_mm_s, jump_mm_s, jump_mm_s, jump_deg_s];
        let change = std::array::from_fn(|axis| after[axis] - before[axis]);
        slowest(change, jumps).0.min(speed).powi(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::back::gcode::pace::axes::Axis;
    use crate::back::gcode::pace::planner::{Feed, Planner};
    use crate::back::target::Limit;
    use crate::geom::{Vector, left};
    use crate::machine::Job;
    use crate::machine::gcode::Step;
    use crate::units::rad;

    /// A controller whose X and Y take 500 mm/s and 4000 mm/s2, and jump by 10 mm/s; its C axis 1000 degrees/s, 10,000 degrees/s2
    /// and 100 degrees/s.
    fn pace() -> Pace {
        let mut job = Job::default();
        let gcode = &mut job.profile.gcode;
        (gcode.jump_mm_s, gcode.jump_deg_s, gcode.planner_blocks) = (10.0, 100.0, 1000);
        (gcode.z_speed_mm_s, gcode.z_acceleration_mm_s2) = (Some(50.0), Some(500.0));
        let mut pace = Pace::new(&job);
        let axis = |speed, acceleration| Axis { speed, acceleration };
        let all = [axis(500.0, 4000.0), axis(500.0, 4000.0), axis(50.0, 500.0), axis(1000.0, 1e4)];
        pace.axes = [all, all];
        pace
    }

    fn line(way: Vector, turn_deg: f64) -> Move {
        let feed = Feed { speed: 200.0, limit: Limit::Feed };
        Move {
            ways: [way.x, way.y, rad(turn_deg)],
            length: way.norm(),
            feed,
            along: [way.normalize(); 2],
            curvature: 0.0,
        }
    }

    fn check(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-9, "{found} instead of {expected}");
    }

    fn time(moves: &[Move]) -> f64 {
        let mut pace = pace();
        for step in moves {
            pace.go(step);
        }
        pace.finish().time
    }

    /// Duration of a trapezoid from and to speeds.
    fn ramps(length: f64, [from, to]: [f64; 2], acceleration: f64) -> f64 {
        let top = 200.0;
        let ways = (2.0 * top * top - from * from - to * to) / (2.0 * acceleration);
        (2.0 * top - from - to) / acceleration + (length - ways) / top
    }

    #[test]
    fn f_counts_the_linear_axes_and_the_slowest_axis_sets_the_acceleration() {
        let way = Vector::new(100.0, 0.0);
        check(time(&[line(way, 0.0)]), ramps(100.0, [0.0, 0.0], 4000.0));
        // 300 degrees on 100 mm: 10,000 degrees/s2 are 3333 mm/s2, and 1000 degrees/s are 333 mm/s.
        check(time(&[line(way, 300.0)]), ramps(100.0, [0.0, 0.0], 1e4 / 3.0));
        // At 1000 degrees/s 600 degrees take 0.6 s, and the ramps 0.1 s more.
        check(time(&[line(way, 600.0)]), 0.7);
    }

    #[test]
    fn at_a_junction_no_axis_changes_its_speed_by_more_than_it_may() {
        let [right, up] = [Vector::new(100.0, 0.0), Vector::new(0.0, 100.0)];
        let corner = |speed: f64, acceleration: f64| {
            ramps(100.0, [0.0, speed], 4000.0) + ramps(100.0, [speed, 0.0], acceleration)
        };
        check(time(&[line(right, 0.0), line(right, 0.0)]), ramps(200.0, [0.0, 0.0], 4000.0));
        check(time(&[line(right, 0.0), line(up, 0.0)]), corner(10.0, 4000.0));
        // There and back: from 5 to -5 mm/s.
        check(time(&[line(right, 0.0), line(-right, 0.0)]), corner(5.0, 4000.0));
        // C begins to turn by 2 degrees a mm: at 50 mm/s that is 100 degrees/s.
        check(time(&[line(right, 0.0), line(right, 200.0)]), corner(50.0, 4000.0));
    }

    #[test]
    fn an_arc_is_chords_by_deviation_and_by_time() {
        let count = |radius: f64, speed: f64| {
            let sweep = 1.5_f64;
            let along = Vector::new(0.0, 1.0);
            let end = Vector::new(radius * (sweep.cos() - 1.0), radius * sweep.sin());
            let feed = Feed { speed, limit: Limit::Feed };
            let ways = [end.x, end.y, sweep];
            let along = [along, left(end.normalize())];
            let mut pace = pace();
            pace.go(&Move { ways, length: radius * sweep, feed, along, curvature: radius.recip() });
            (pace.queue.blocks.len(), pace.finish().time * speed / (radius * sweep))
        };
        // sqrt(8 * 5 * 0.005) = 0.447 mm, 100 / 200 = 0.5 mm.
        assert_eq!(count(5.0, 100.0).0, 17);
        // At most 1 mm.
        assert_eq!(count(50.0, 300.0).0, 75);
        // 20 mm/s / 200 = 0.1 mm.
        let (chords, share) = count(50.0, 20.0);
        assert!(chords == 750 && (1.0..1.01).contains(&share), "{chords} {share}");
    }

    #[test]
    fn z_and_the_blade_alone_start_and_end_at_rest() {
        let mut pace = pace();
        let z = |to_mm| Step::Z { to_mm, feed_mm_min: None };
        let way = Vector::new(100.0, 0.0);
        let alone = ramps(100.0, [0.0, 0.0], 4000.0);
        pace.steps(&[z(5.0)]);
        pace.go(&line(way, 0.0));
        pace.go(&Move { ways: [0.0, 0.0, rad(90.0)], length: 0.0, feed: Feed::RAPID, ..line(way, 0.0) });
        pace.go(&line(way, 0.0));
        pace.steps(&[z(-5.0), Step::Dwell { time: 0.25 }]);
        let turned = 2.0 * (90.0_f64 / 1e4).sqrt();
        let spent = pace.finish();
        check(spent.time, 2.0 * alone + turned + 10.0 / 50.0 + 50.0 / 500.0 + 0.25);
        check(spent.limits.iter().map(|(_, time)| time).sum(), spent.time);
    }
}
