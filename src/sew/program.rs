//! A pattern that is ready to be written: needle points, and how fast each run is sewn.

use super::pattern::Pattern;
use super::speed::{self, Run};
use super::stitches::{Step, Stitches};
use super::train::{Drive, Train};
use crate::geom::Point;
use crate::machine::{Job, Sewing};
use crate::units::S_PER_MIN;

/// A pattern that is ready to be written.
#[derive(Debug)]
pub struct Program {
    /// What it was read as.
    pub format: &'static str,
    /// What the records of such a file are called.
    pub record_word: &'static str,
    /// What was to be sewn; `None` where the file had the stitches.
    pub pattern: Option<Pattern>,
    /// What is sewn.
    pub stitches: Stitches,
    /// How fast.
    pub runs: Vec<Run>,
}

/// An entry with all that the machine does for it.
#[derive(Debug, Clone, Copy)]
pub struct Move<'a> {
    /// The entry.
    pub step: &'a Step,
    /// Its number, from 1.
    pub entry: u32,
    /// Where the needle stands before it.
    pub from: Point,
    /// Speed of the spindle, stitches a minute; 0 = it stands.
    pub rpm: f64,
    /// Pulses of X and Y, with their signs.
    pub pulses: [i64; 2],
}

impl Program {
    /// Every entry, in order.
    pub fn moves<'a>(&'a self, job: &'a Job) -> impl Iterator<Item = Move<'a>> {
        let sewing = &job.profile.sewing;
        let drive = Drive::of(sewing);
        let speeds = speed::speeds(&self.stitches, &self.runs, sewing);
        self.stitches.moves().zip(speeds).zip(1..).map(move |(((from, step), rpm), entry)| Move {
            step,
            entry,
            from,
            rpm,
            pulses: speed::pulses(from, step.to, &drive),
        })
    }
}

impl Move<'_> {
    /// Time in which X and Y may move, s; `None` with the needle up.
    pub fn window(&self, sewing: &Sewing) -> Option<f64> {
        (self.rpm > 0.0).then(|| sewing.window() * S_PER_MIN / self.rpm)
    }

    /// The pulses of X and of Y in time.
    pub fn trains(&self, sewing: &Sewing) -> [Train; 2] {
        let (drive, window) = (Drive::of(sewing), self.window(sewing));
        self.pulses.map(|pulses| drive.train(u32::try_from(pulses.unsigned_abs()).unwrap_or(u32::MAX), window))
    }
}
