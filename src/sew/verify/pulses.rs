//! Checks of every pulse: number, direction, time, and the needle position that results.

use super::clock;
use super::ground::{Ground, sighting};
use super::rules;
use super::spindle::Spindle;
use crate::geom::Point;
use crate::ir::verdict::{Sighting, WorstByRule};
use crate::sew::stitches::Op;
use crate::units::US_PER_S;
use crate::units::columns::Unread;

/// A row of a program.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    /// Its entry, from 1.
    pub(super) entry: u32,
    /// Action of the entry, as an index of [`OPS`]; the number of a thread is separate.
    pub(super) op: u8,
    pub(super) rpm: f64,
    pub(super) thread: u16,
    pub(super) time_us: f64,
    /// Pulses of X and of Y.
    pub(super) pulse: [i8; 2],
}

/// Words of the actions, by index.
pub(super) const OPS: [&str; 5] = ["STITCH", "JUMP", "TRIM", "STOP", "COLOR"];

/// Index of an action.
fn number(op: Op) -> u8 {
    match op {
        Op::Stitch => 0,
        Op::Jump => 1,
        Op::Trim => 2,
        Op::Stop => 3,
        Op::Color(_) => 4,
    }
}

/// Verifies rows, which `read` supplies one by one; `tick_us` is the uncertainty of intervals, microseconds.
pub(super) fn judge(
    read: impl FnOnce(&mut dyn FnMut(Row)) -> Result<(), Unread>,
    tick_us: f64,
    ground: &Ground,
    worst: &mut WorstByRule,
) -> Result<(), Unread> {
    let mut judge = Judge {
        ground,
        worst,
        tick_us,
        first_us: clock::first_step_us(ground.sewing),
        least_us: clock::least_interval_us(ground.sewing),
        spindle: Spindle::new(ground),
        entry: None,
        next: 0,
        at: [0; 2],
        thread: 1,
    };
    read(&mut |row| judge.row(row))?;
    judge.end();
    Ok(())
}

struct Judge<'a> {
    ground: &'a Ground<'a>,
    worst: &'a mut WorstByRule,
    tick_us: f64,
    /// Minimum first interval, and minimum of all intervals, microseconds.
    first_us: f64,
    least_us: f64,
    spindle: Spindle,
    entry: Option<Entry>,
    /// Index of the next entry.
    next: usize,
    /// Position of the motors, steps.
    at: [i64; 2],
    thread: u16,
}

/// The entry that is being read.
struct Entry {
    /// Index of the entry.
    i: usize,
    rpm: f64,
    axes: [Axis; 2],
    time_us: f64,
}

/// Pulses of one axis so far in an entry.
#[derive(Debug, Clone, Copy, Default)]
struct Axis {
    count: i64,
    sum: i64,
    last_us: f64,
    /// The last interval; `None` before the second pulse.
    interval: Option<f64>,
    /// True once intervals have begun to increase.
    rises: bool,
}

impl Judge<'_> {
    fn place(&self, i: usize) -> Option<Sighting> {
        self.ground.stitches.steps.get(i).map(|step| sighting(i as u32 + 1, step.to))
    }

    fn row(&mut self, row: Row) {
        let is_same = self.entry.as_ref().is_some_and(|entry| entry.i as u64 + 1 == u64::from(row.entry));
        if !is_same {
            self.finish();
            self.begin(&row);
        }
        let Some(mut entry) = self.entry.take() else { return };
        let place = self.place(entry.i);
        if row.rpm != entry.rpm {
            self.worst.see(&rules::STEADY_SPEED, (row.rpm - entry.rpm).abs(), place);
        }
        self.worst.see(&rules::TIME, entry.time_us - row.time_us, place);
        entry.time_us = row.time_us;
        for (axis, pulse) in entry.axes.iter_mut().zip(row.pulse) {
            if pulse != 0 {
                self.pulse(axis, (row.time_us, pulse), place);
            }
        }
        self.entry = Some(entry);
    }

    /// Begins an entry.
    fn begin(&mut self, row: &Row) {
        let i = (row.entry as usize).wrapping_sub(1);
        let Some(step) = self.ground.stitches.steps.get(i) else {
            self.worst.count(&rules::ENTRIES, 1, None);
            return;
        };
        let place = sighting(row.entry, step.to);
        let thread = if let Op::Color(thread) = step.op { thread } else { self.thread };
        self.thread = thread;
        let is_other = i != self.next || row.op != number(step.op) || row.thread != thread;
        self.worst.count(&rules::ENTRIES, usize::from(is_other), place);
        self.next = i + 1;
        self.spindle.see(i, row.rpm, self.ground, self.worst);
        self.entry = Some(Entry { i, rpm: row.rpm, axes: [Axis::default(); 2], time_us: 0.0 });
    }

    /// Checks a pulse of an axis.
    fn pulse(&mut self, axis: &mut Axis, (time, pulse): (f64, i8), place: Option<Sighting>) {
        let sewing = self.ground.sewing;
        let interval = time - axis.last_us;
        axis.last_us = time;
        axis.count += 1;
        axis.sum += i64::from(pulse);
        self.worst.see(&rules::LEAST_INTERVAL, self.least_us - interval, place);
        match axis.interval {
            None => self.worst.see(&rules::FIRST_INTERVAL, self.first_us - interval, place),
            Some(before) => {
                // The rounding errors of both intervals add up.
                let rounding = 2.0 * self.tick_us;
                axis.rises |= interval > before + rounding;
                if axis.rises {
                    self.worst.see(&rules::RAMP, before - interval - rounding, place);
                }
                // The mean speeds of adjacent intervals, which are those at their middles.
                let [v0, v1] = [before, interval].map(|interval| sewing.step_mm * US_PER_S / interval);
                let apart = f64::midpoint(before, interval) / US_PER_S;
                let rounding = (v0 / before + v1 / interval) * self.tick_us;
                self.worst.see(&rules::ACCELERATION, ((v1 - v0).abs() - rounding) / apart, place);
            }
        }
        axis.interval = Some(interval);
    }

    /// Ends an entry.
    fn finish(&mut self) {
        let Some(entry) = self.entry.take() else { return };
        let (steps, sewing) = (&self.ground.stitches.steps, self.ground.sewing);
        let step = &steps[entry.i];
        let before = if entry.i == 0 { Point::origin() } else { steps[entry.i - 1].to };
        let place = sighting(entry.i as u32 + 1, step.to);
        let nearest = |coordinate: f64| (coordinate / sewing.step_mm).round() as i64;
        let asked = [(before.x, step.to.x), (before.y, step.to.y)].map(|(from, to)| nearest(to) - nearest(from));
        for (k, axis) in entry.axes.iter().enumerate() {
            self.worst.see(&rules::COUNT, (axis.count - asked[k].abs()).abs() as f64, place);
            // Number of pulses against the others, or of all if their sum is against the stitch.
            let against = if axis.sum * asked[k] < 0 { axis.count } else { axis.count - axis.sum.abs() };
            self.worst.see(&rules::DIRECTION, against as f64, place);
            self.at[k] += axis.sum;
            if let Some(last) = axis.interval {
                self.worst.see(&rules::FIRST_INTERVAL, self.first_us - last, place);
            }
        }
        let off = [step.to.x, step.to.y].into_iter().zip(self.at);
        let off = off.map(|(planned, at)| (at as f64 * sewing.step_mm - planned).abs()).fold(0.0, f64::max);
        self.worst.see(&rules::END_POINT, off, place);
        if entry.rpm > 0.0 {
            let last = entry.axes.iter().map(|axis| axis.last_us).fold(0.0, f64::max);
            self.worst.see(&rules::WINDOW, last - clock::window_us(sewing, entry.rpm), place);
        }
    }

    /// Ends the program.
    fn end(&mut self) {
        self.finish();
        let missing = self.ground.stitches.steps.len().saturating_sub(self.next);
        self.worst.count(&rules::ENTRIES, missing, self.place(self.next));
    }
}
