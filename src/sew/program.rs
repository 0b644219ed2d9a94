//! Programs: needle points and a speed for each run, ready to be written.

use super::pattern::Pattern;
use super::speed::{self, Run};
use super::stitches::{Step, Stitches};
use super::train::{Drive, Train};
use crate::geom::Point;
use crate::machine::{Job, Sewing};
use crate::units::S_PER_MIN;

/// Needle points and speeds, ready to be written.
#[derive(Debug)]
pub struct Program {
    /// Format or dialect of the source.
    pub format: &'static str,
    /// Word for the records of that format.
    pub record_word: &'static str,
    /// The pattern; `None` if the file contained stitches.
    pub pattern: Option<Pattern>,
    /// The pattern as the file draws it, before it is placed in the field; `None` if the file contained stitches.
    pub drawn: Option<Pattern>,
    /// The stitches.
    pub stitches: Stitches,
    /// The runs with their speeds.
    pub runs: Vec<Run>,
}

/// An entry with the motion of the machine.
#[derive(Debug, Clone, Copy)]
pub struct Move<'a> {
    /// The entry.
    pub step: &'a Step,
    /// Number of the entry, from 1.
    pub entry: u32,
    /// Needle position before it.
    pub from: Point,
    /// Speed of the spindle, stitches per minute; 0 if it stands.
    pub rpm: f64,
    /// Pulses of X and Y, signed.
    pub pulses: [i64; 2],
}

impl Program {
    /// All entries, in order.
    pub fn moves<'a>(&'a self, job: &'a Job) -> impl Iterator<Item = Move<'a>> {
        let sewing = &job.profile.sewing;
        let drive = Drive::of(sewing);
        let speeds = speed::speeds(&self.stitches, &self.runs);
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
    /// Time available for the motion of X and Y, s; `None` with the needle up.
    pub fn window(&self, sewing: &Sewing) -> Option<f64> {
        (self.rpm > 0.0).then(|| sewing.window() * S_PER_MIN / self.rpm)
    }

    /// The timed pulses of X and of Y.
    pub fn trains(&self, sewing: &Sewing) -> [Train; 2] {
        let (drive, window) = (Drive::of(sewing), self.window(sewing));
        self.pulses.map(|pulses| drive.train(u32::try_from(pulses.unsigned_abs()).unwrap_or(u32::MAX), window))
    }
}
