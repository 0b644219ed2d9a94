//! Simulation of the queue between host and motion part, to check that the host keeps up.
//!
//! The host adds entries one after the other at its rate whenever there is room. The motion part starts when the queue is full
//! or holds the whole program, and takes an entry at each turn of the spindle.

use serde::Serialize;

use super::program::Program;
use super::speed;
use super::stitches::Op;
use super::train::Drive;
use crate::machine::Job;
use crate::units::S_PER_MIN;

/// Rounding of times, s: an entry that arrives at the moment when it is needed is in time.
const TIME_EPSILON: f64 = 1e-9;

/// Result of a simulation.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Fifo {
    /// Capacity of the queue, entries.
    pub depth: usize,
    /// Rate of the host, entries per second.
    pub producer_hz: f64,
    /// Number of entries that were missing when needed.
    pub underruns: usize,
    /// First missing entry, from 1; 0 if there is none.
    pub first_underrun: usize,
    /// Total waiting time of the machine, s.
    pub waited_s: f64,
    /// Minimum number of entries in the queue when one was taken, while the host still had more to add.
    pub lowest: usize,
    /// Rate at which the fastest run takes entries, per second: a host of this rate keeps up with any pattern.
    pub needed_hz: f64,
}

/// Simulates the queue of a program.
pub fn simulate(program: &Program, job: &Job) -> Fifo {
    let sewing = &job.profile.sewing;
    let (depth, interval) = (sewing.queue_depth as usize, 1.0 / sewing.producer_hz);
    let count = program.stitches.steps.len();
    let mut fifo = Fifo { depth, producer_hz: sewing.producer_hz, lowest: depth.min(count), ..Fifo::default() };
    let drive = Drive::of(sewing);
    // Time at which each entry is taken, and time at which it becomes available.
    let (mut taken, mut there): (Vec<f64>, Vec<f64>) = (Vec::with_capacity(count), Vec::with_capacity(count));
    let put = |taken: &[f64], there: &mut Vec<f64>| {
        let i = there.len();
        let last = there.last().copied().unwrap_or(0.0);
        let room = if i < depth { 0.0 } else { taken[i - depth] };
        there.push(last.max(room) + interval);
    };
    for _ in 0..depth.min(count) {
        put(&taken, &mut there);
    }
    let mut now = there.last().copied().unwrap_or(0.0);
    for entry in program.moves(job) {
        let i = taken.len();
        if there.len() == i {
            put(&taken, &mut there);
        }
        if there[i] > now + TIME_EPSILON {
            fifo.underruns += 1;
            fifo.waited_s += there[i] - now;
            if fifo.first_underrun == 0 {
                fifo.first_underrun = i + 1;
            }
            now = there[i];
        }
        taken.push(now);
        while there.len() < count && there.len() < i + 1 + depth {
            put(&taken, &mut there);
        }
        if there.get(count - 1).is_none_or(|&last| last > now) {
            fifo.lowest = fifo.lowest.min(there.partition_point(|&time| time <= now).saturating_sub(i));
        }
        now += match entry.step.op {
            Op::Stitch => {
                fifo.needed_hz = fifo.needed_hz.max(entry.rpm / S_PER_MIN);
                S_PER_MIN / entry.rpm
            }
            Op::Jump => speed::jump_time(entry.from, entry.step.to, &drive),
            Op::Trim => sewing.trim_time(),
            Op::Stop | Op::Color(_) => 0.0,
        };
    }
    fifo
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::sew::stitches::{Step, Stitches};

    fn check(stitches: usize, depth: u32, producer_hz: f64) -> Fifo {
        let mut job = Job::default();
        job.profile.sewing.queue_depth = depth;
        job.profile.sewing.producer_hz = producer_hz;
        job.profile.sewing.soft_start_rpm = None;
        let step = |i| Step { op: Op::Stitch, to: Point::new(i as f64, 0.0), is_tie: false, record: 0 };
        let stitches = Stitches { steps: (0..stitches).map(step).collect() };
        let runs = speed::runs(&stitches, &speed::Limits::new(&job.profile.sewing, None));
        simulate(&Program { format: "test", record_word: "record", pattern: None, drawn: None, stitches, runs }, &job)
    }

    #[test]
    fn a_host_that_is_fast_enough_never_lets_the_queue_run_dry() {
        let needed = 3200.0 / 60.0;
        let fifo = check(1000, 8, needed);
        assert_eq!((fifo.underruns, fifo.needed_hz), (0, needed));
        let slow = check(1000, 8, needed / 2.0);
        // The queue is filled before the first stitch, and each entry after that waits for the host.
        assert!(slow.underruns > 900 && slow.first_underrun > 8, "{slow:?}");
        assert!((slow.waited_s - 1000.0 / needed).abs() < 0.5, "{slow:?}");
    }

    #[test]
    fn a_deep_queue_bridges_a_slow_host() {
        assert_eq!(check(100, 128, 1.0).underruns, 0);
        assert!(check(100, 64, 1.0).underruns > 0);
    }
}
