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

use super::buffer::Block;
use super::planner::{Move, Planner};
use super::queue::{Axis, Queue, axes, norm, slowest};
use crate::back::target::{Limit, Spent};
use crate::geom::Vector;
use crate::machine::Job;
use crate::machine::gcode::{Gcode, Outputs, Step};
use crate::units::{S_PER_MIN, deg};

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

/// Planner with the blocks since the last rest.
#[derive(Debug)]
pub(super) struct Pace {
    keys: Gcode,
    axes: [[Axis; 4]; 2],
    /// Place of Z, mm; `None` before its first move.
    z: Option<f64>,
    queue: Queue,
    /// Distances of the axes in the last block by its length, and whether X or Y moves in it.
    along: [f64; 4],
    moves_xy: bool,
}

/// A block as it is asked for.
struct Asked {
    /// Distances along the axes, mm and degrees.
    ways: [f64; 4],
    /// Speed of the linear axes, mm/s; infinite for rapid moves.
    speed: f64,
    limit: Limit,
    is_line: bool,
}

impl Pace {
    pub(super) fn new(job: &Job) -> Self {
        let keys = job.profile.gcode.clone();
        let queue = Queue::new(&keys);
        Self { keys, axes: axes(job), z: None, queue, along: [0.0; 4], moves_xy: false }
    }

    /// Adds a block with the limits of the axes along it.
    fn push(&mut self, asked: &Asked) {
        let [x, y, z, c] = asked.ways;
        let linear = norm([x, y, z, 0.0]);
        let length = if linear > 0.0 { linear } else { c.abs() };
        if length == 0.0 {
            return;
        }
        let along = asked.ways.map(|way| way / length);
        let axes = self.axes[usize::from(asked.speed.is_infinite())];
        let (most, axis) = slowest(along, axes.map(|axis| axis.speed));
        let (acceleration, ramp) = slowest(along, axes.map(|axis| axis.acceleration));
        let limit = if most < asked.speed { Limit::Speed(axis) } else { asked.limit };
        let speed = asked.speed.max(SPEED_MIN).min(most);
        let moves_xy = x != 0.0 || y != 0.0;
        let entry = match self.queue.blocks.last() {
            Some(before) if self.moves_xy == moves_xy => self.junction(along).min(before.speed).min(speed),
            Some(_) | None => 0.0,
        };
        let block = Block { length, speed, acceleration, entry: entry * entry, is_line: asked.is_line };
        self.queue.push(block, [limit, Limit::Acceleration(ramp)]);
        (self.along, self.moves_xy) = (along, moves_xy);
    }

    /// Greatest speed from the last block to one with a direction.
    fn junction(&self, along: [f64; 4]) -> f64 {
        let Gcode { jump_mm_s, jump_deg_s, .. } = self.keys;
        let jumps = [jump_mm_s, jump_mm_s, jump_mm_s, jump_deg_s];
        let change = std::array::from_fn(|axis| along[axis] - self.along[axis]);
        slowest(change, jumps).0
    }

    /// Adds the chords of an arc.
    fn arc(&mut self, step: &Move, turn: f64) {
        let (radius, sweep) = (step.curvature.abs().recip(), step.length * step.curvature);
        let chord = (8.0 * radius * ARC_DEVIATION).sqrt().min(step.feed.speed / CHORDS_S).clamp(CHORD_MIN, CHORD_MAX);
        let count = (step.length / chord + ROUNDED_UP).floor().max(1.0);
        let angle = sweep / count;
        let length = 2.0 * radius * (0.5 * angle.abs()).sin();
        for i in 0..count as usize {
            let (sin, cos) = ((i as f64 + 0.5) * angle).sin_cos();
            let along = step.along[0];
            let chord = Vector::new(along.x * cos - along.y * sin, along.x * sin + along.y * cos) * length;
            let ways = [chord.x, chord.y, 0.0, turn / count];
            self.push(&Asked { ways, speed: step.feed.speed, limit: step.feed.limit, is_line: i == 0 });
        }
    }

    /// Moves Z. Its first move starts from an unknown place and takes no time, like all of them without its limits.
    fn lift(&mut self, to: f64, feed_mm_min: Option<f64>) {
        let way = self.z.replace(to).map_or(0.0, |from| to - from);
        if self.keys.z_speed_mm_s.is_none() || self.keys.z_acceleration_mm_s2.is_none() {
            self.queue.stop();
            return;
        }
        let speed = feed_mm_min.map_or(f64::INFINITY, |feed| feed / S_PER_MIN);
        self.push(&Asked { ways: [0.0, 0.0, way, 0.0], speed, limit: Limit::Speed('z'), is_line: true });
    }
}

impl Planner for Pace {
    fn go(&mut self, step: &Move) {
        let [x, y, c] = step.ways;
        let turn = deg(c);
        if step.curvature == 0.0 {
            let Move { feed, .. } = *step;
            self.push(&Asked { ways: [x, y, 0.0, turn], speed: feed.speed, limit: feed.limit, is_line: true });
        } else {
            self.arc(step, turn);
        }
    }

    fn steps(&mut self, steps: &[Step]) {
        for step in steps {
            match step {
                Step::Z { to_mm, feed_mm_min } => self.lift(*to_mm, *feed_mm_min),
                Step::Dwell { time } => self.queue.wait(*time),
                // Outputs that are switched when they are read leave the moves before them running.
                _ if self.keys.outputs == Outputs::Immediate && step.switches_when_read() => {}
                Step::Output { .. } | Step::Code { .. } => self.queue.stop(),
            }
        }
    }

    fn wait(&mut self, time: f64) {
        self.queue.wait(time);
    }

    /// F does not change the speeds of junctions.
    fn best_speed(&self, _: f64, _: f64) -> f64 {
        f64::INFINITY
    }

    fn finish(&mut self) -> Spent {
        self.queue.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::back::gcode::pace::planner::Feed;
    use crate::geom::left;
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
