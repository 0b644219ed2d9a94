//! Stitches from the moves of a stitch file: relative, in whole tenths of a millimetre.

use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Point;
use crate::sew::stitches::{Op, Step, Stitches};
use crate::source::Span;
use crate::units::TENTHS_PER_MM;

/// Number of consecutive jumps above which a file is most likely damaged: the largest machine is crossed in fewer.
const JUMP_STORM: u32 = 200;

/// Collector of moves.
#[derive(Debug, Default)]
pub(super) struct Moves {
    stitches: Stitches,
    /// Needle position, in tenths of a millimetre.
    at: [i64; 2],
    thread: u16,
    /// True if the thread runs from the last stitch to the needle: no trim has come between.
    has_thread: bool,
    /// Number of jumps since the last entry, and the record of the first of them.
    jumps: u32,
    jumped_from: u32,
    trims: Trims,
}

/// Jumps that stand for a thread cut.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Trims {
    /// Number of consecutive jumps from which on they do; `None` if their number does not matter.
    pub(super) jumps: Option<u32>,
    /// Way of X or Y, tenths of a millimetre, beyond which they do; `None` if it does not matter.
    pub(super) way: Option<i64>,
}

impl Moves {
    /// Creates a collector.
    pub(super) fn new(trims: Trims) -> Self {
        Self { trims, thread: 1, ..Self::default() }
    }

    /// Needle position, tenths of a millimetre.
    pub(super) fn at(&self) -> [i64; 2] {
        self.at
    }

    /// True if the thread runs from the last stitch to the needle.
    pub(super) fn has_thread(&self) -> bool {
        self.has_thread
    }

    fn push(&mut self, op: Op, record: u32) {
        let to = Point::new(self.at[0] as f64 / TENTHS_PER_MM, self.at[1] as f64 / TENTHS_PER_MM);
        let last = self.stitches.steps.last();
        let is_first = last.is_none_or(|step| step.op.ends_run());
        let before = last.map_or(Point::origin(), |step| step.to);
        // The needle goes down at the end of a jump; this stitch has no length because none was lost.
        let is_tie = op == Op::Stitch && is_first && before == to;
        self.stitches.steps.push(Step { op, to, is_tie, record });
        match op {
            Op::Stitch => self.has_thread = true,
            Op::Trim => self.has_thread = false,
            Op::Jump | Op::Color(_) | Op::Stop => {}
        }
    }

    /// Adds a stitch.
    pub(super) fn stitch(&mut self, way: [i64; 2], record: u32, out: &mut Diagnostics) {
        self.land(out);
        self.go(way);
        self.push(Op::Stitch, record);
    }

    /// Adds a move with the needle up.
    pub(super) fn jump(&mut self, way: [i64; 2], record: u32) {
        if self.jumps == 0 {
            self.jumped_from = record;
        }
        self.jumps += 1;
        self.go(way);
    }

    /// Adds a thread cut if there is a thread to cut.
    pub(super) fn trim(&mut self, record: u32, out: &mut Diagnostics) {
        self.land(out);
        if self.has_thread {
            self.push(Op::Trim, record);
        }
    }

    /// Adds a stop for the operator.
    pub(super) fn stop(&mut self, record: u32, out: &mut Diagnostics) {
        self.land(out);
        self.push(Op::Stop, record);
    }

    /// Adds a change to the next thread.
    pub(super) fn next_thread(&mut self, record: u32, out: &mut Diagnostics) {
        self.thread(self.thread.saturating_add(1), record, out);
    }

    /// Adds a change to a thread, unless it is in use.
    pub(super) fn thread(&mut self, thread: u16, record: u32, out: &mut Diagnostics) {
        self.land(out);
        if thread != self.thread {
            self.thread = thread;
            self.push(Op::Color(thread), record);
        }
    }

    fn go(&mut self, [x, y]: [i64; 2]) {
        self.at = [self.at[0] + x, self.at[1] + y];
    }

    /// Combines consecutive jumps into one.
    fn land(&mut self, out: &mut Diagnostics) {
        let (jumps, record) = (std::mem::take(&mut self.jumps), self.jumped_from);
        if jumps == 0 {
            return;
        }
        if jumps > JUMP_STORM {
            let message = format!("{jumps} jumps follow one another from record {record} on");
            let hint = "a pattern crosses its machine in fewer: compare it with the original";
            out.push(Diagnostic::new(&code::SEW_JUMPS, message).hint(hint));
        }
        let landed = self.at;
        let before = self.stitches.steps.last().map_or(Point::origin(), |step| step.to);
        self.at = [before.x, before.y].map(|value| (value * TENTHS_PER_MM).round() as i64);
        let way = [0, 1].map(|axis| (landed[axis] - self.at[axis]).abs());
        let is_trim = self.trims.jumps.is_some_and(|least| jumps >= least)
            || self.trims.way.is_some_and(|most| way[0].max(way[1]) > most);
        if self.has_thread && is_trim {
            self.push(Op::Trim, record);
        }
        if landed != self.at {
            self.at = landed;
            self.push(Op::Jump, record);
        }
    }

    /// The collected stitches.
    pub(super) fn finish(mut self, out: &mut Diagnostics) -> Stitches {
        self.land(out);
        self.stitches
    }
}

/// Location of a record in the source.
pub(super) fn span(start: usize, bytes: usize, record: u32) -> Span {
    Span { start: start as u32, end: (start + bytes) as u32, block: record }
}
