//! Planners that join blocks with a look-ahead: those of the grbl family and of `RepRapFirmware`. They share the order of blocks,
//! rests and moves of Z; [`Rules`] says what differs.

use super::axes::{Axis, axes, slowest};
use super::buffer::Block;
use super::planner::{Move, Planner};
use super::queue::Queue;
use crate::back::target::{Limit, Spent};
use crate::geom::Vector;
use crate::machine::Job;
use crate::machine::gcode::{Gcode, Outputs, Step};
use crate::units::{S_PER_MIN, deg};

/// Rules of a firmware for its blocks. Distances are along X, Y, Z and the axis of the blade, mm and degrees.
pub(super) trait Rules: std::fmt::Debug {
    /// Length of a block, mm, or degrees of a turn alone; 0 for one that is left out.
    fn length(ways: [f64; 4]) -> f64;

    /// Speed of a block, per s, of the speed that is asked for and the greatest that its axes allow.
    fn speed(asked: f64, most: f64) -> f64;

    /// Speed along the block of a move that turns the blade, degrees, per s: the meaning of F.
    fn feed(step: &Move, turn: f64) -> f64;

    /// Number of the chords of an arc.
    fn chords(keys: &Gcode, step: &Move) -> f64;

    /// Square of the greatest speed at a junction.
    fn junction(keys: &Gcode, joint: &Joint) -> f64;
}

/// Two blocks that meet.
pub(super) struct Joint {
    /// Distances of the axes in each, by its length.
    pub(super) along: [[f64; 4]; 2],
    /// Lower one of their speeds, per s.
    pub(super) speed: f64,
    pub(super) axes: [Axis; 4],
}

/// Planner with the blocks since the last rest.
#[derive(Debug)]
pub(super) struct Pace<R> {
    pub(super) keys: Gcode,
    /// Limits of the axes with the knife down, and with the knife up.
    pub(super) axes: [[Axis; 4]; 2],
    /// Place of Z, mm; `None` before its first move.
    z: Option<f64>,
    pub(super) queue: Queue,
    /// Distances of the axes in the last block, by its length.
    along: [f64; 4],
    rules: std::marker::PhantomData<R>,
}

/// A block as it is asked for.
struct Asked {
    /// Distances along the axes, mm and degrees.
    ways: [f64; 4],
    /// Speed along it, per s; infinite for rapid moves.
    speed: f64,
    limit: Limit,
    is_line: bool,
}

impl<R: Rules> Pace<R> {
    pub(super) fn new(job: &Job) -> Self {
        let keys = job.profile.gcode.clone();
        let queue = Queue::new(&keys);
        Self { keys, axes: axes(job), z: None, queue, along: [0.0; 4], rules: std::marker::PhantomData }
    }

    /// Adds a block with the limits of the axes along it.
    fn push(&mut self, asked: &Asked) {
        let length = R::length(asked.ways);
        if length == 0.0 {
            return;
        }
        let along = asked.ways.map(|way| way / length);
        let axes = self.axes[usize::from(asked.speed.is_infinite())];
        let (most, axis) = slowest(along, axes.map(|axis| axis.speed));
        let (acceleration, ramp) = slowest(along, axes.map(|axis| axis.acceleration));
        let limit = if most < asked.speed { Limit::Speed(axis) } else { asked.limit };
        let speed = R::speed(asked.speed, most);
        let entry = self.queue.blocks.last().map_or(0.0, |before| {
            let joint = Joint { along: [self.along, along], speed: before.speed.min(speed), axes };
            R::junction(&self.keys, &joint)
        });
        let block = Block { length, speed, acceleration, entry, is_line: asked.is_line };
        self.queue.push(block, [limit, Limit::Acceleration(ramp)]);
        self.along = along;
    }

    /// Adds the chords of an arc, along which the blade turns evenly.
    fn arc(&mut self, step: &Move, turn: f64) {
        let (radius, sweep) = (step.curvature.abs().recip(), step.length * step.curvature);
        let count = R::chords(&self.keys, step);
        let (angle, speed) = (sweep / count, R::feed(step, turn));
        let length = 2.0 * radius * (0.5 * angle.abs()).sin();
        for i in 0..count as usize {
            let (sin, cos) = ((i as f64 + 0.5) * angle).sin_cos();
            let along = step.along[0];
            let chord = Vector::new(along.x * cos - along.y * sin, along.x * sin + along.y * cos) * length;
            let ways = [chord.x, chord.y, 0.0, turn / count];
            self.push(&Asked { ways, speed, limit: step.feed.limit, is_line: i == 0 });
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

impl<R: Rules> Planner for Pace<R> {
    fn go(&mut self, step: &Move) {
        let [x, y, c] = step.ways;
        let turn = deg(c);
        if step.curvature == 0.0 {
            let speed = R::feed(step, turn);
            self.push(&Asked { ways: [x, y, 0.0, turn], speed, limit: step.feed.limit, is_line: true });
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
