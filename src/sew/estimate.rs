//! Time estimate of a pattern: runs with their soft starts, jumps and trims. The time of an operator at stops is unknown and
//! not included.

use serde::Serialize;

use super::pace;
use super::program::Program;
use super::speed;
use super::stitches::Op;
use super::train::Drive;
use crate::machine::Job;

/// Totals of a pattern.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Estimate {
    /// Number of penetrations.
    pub stitches: usize,
    /// Number of runs of stitches.
    pub runs: usize,
    /// Number of moves with the needle up.
    pub jumps: usize,
    /// Number of thread cuts.
    pub trims: usize,
    /// Number of waits for the operator, including changes of thread.
    pub stops: usize,
    /// Total length of the stitches, m.
    pub thread_m: f64,
    /// Minimum and maximum speed of the runs after their soft start, stitches per minute.
    pub rpm: [f64; 2],
    /// Total time of the stitches, s.
    pub sewing_s: f64,
    /// Total time of starting and stopping, s.
    pub starting_s: f64,
    /// Total time of the jumps, s.
    pub jumping_s: f64,
    /// Total time of the trims, s.
    pub trimming_s: f64,
    /// Total time, s.
    pub time_s: f64,
}

/// Estimates a program.
pub fn estimate(program: &Program, job: &Job) -> Estimate {
    let sewing = &job.profile.sewing;
    let drive = Drive::of(sewing);
    let mut sum = Estimate { runs: program.runs.len(), rpm: [f64::INFINITY, 0.0], ..Estimate::default() };
    for (from, step) in program.stitches.moves() {
        match step.op {
            Op::Stitch => {
                sum.stitches += 1;
                sum.thread_m += (step.to - from).norm() / crate::units::MM_PER_M;
            }
            Op::Jump => {
                sum.jumps += 1;
                sum.jumping_s += speed::jump_time(from, step.to, &drive);
            }
            Op::Trim => sum.trims += 1,
            Op::Stop | Op::Color(_) => sum.stops += 1,
        }
    }
    for run in &program.runs {
        sum.sewing_s += pace::duration(&run.speeds, sewing);
        sum.rpm = [sum.rpm[0].min(run.slowest), sum.rpm[1].max(run.rpm)];
    }
    sum.starting_s = program.runs.len() as f64 * sewing.start_time();
    sum.trimming_s = sum.trims as f64 * sewing.trim_time();
    sum.time_s = sum.sewing_s + sum.starting_s + sum.jumping_s + sum.trimming_s;
    sum
}
