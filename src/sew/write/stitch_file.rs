//! Common part of stitch files: moves in whole tenths of a millimetre, of limited length.

use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::sew::program::Program;
use crate::sew::stitches::{Op, Step};
use crate::units::TENTHS_PER_MM;

/// Kind of a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Record {
    /// A stitch.
    Stitch,
    /// A move with the needle up.
    Jump,
    /// The thread is cut.
    Trim,
    /// The machine stops for its operator.
    Stop,
    /// The machine stops for a thread.
    Thread(u16),
}

/// Extents of the records from the start: right, left, up, down, tenths of a millimetre.
#[derive(Debug, Default)]
pub(super) struct Extents {
    pub(super) reach: [i64; 4],
    /// End of the last record.
    pub(super) at: [i64; 2],
}

impl Extents {
    /// Adds the move of a record.
    pub(super) fn add(&mut self, way: [i64; 2]) {
        self.at = [self.at[0] + way[0], self.at[1] + way[1]];
        let now = [self.at[0], -self.at[0], self.at[1], -self.at[1]];
        self.reach.iter_mut().zip(now).for_each(|(most, now)| *most = (*most).max(now));
    }
}

/// Calls `each` for all records with their displacement, tenths of a millimetre, at most `longest` in each axis. Positions are
/// rounded, not moves, so that errors do not add up; longer moves are reached by jumps.
pub(super) fn records(program: &Program, longest: i64, mut each: impl FnMut(Record, [i64; 2])) {
    let mut at = [0_i64; 2];
    for step in &program.stitches.steps {
        let to = place(step);
        let way = [to[0] - at[0], to[1] - at[1]];
        at = to;
        let record = match step.op {
            Op::Stitch => Record::Stitch,
            Op::Jump => Record::Jump,
            Op::Trim => Record::Trim,
            Op::Stop => Record::Stop,
            Op::Color(thread) => Record::Thread(thread),
        };
        let reach = way[0].abs().max(way[1].abs());
        let parts = ((reach + longest - 1) / longest).max(1);
        let part = |i: i64| way.map(|way| way * i / parts);
        for i in 1..=parts {
            let (before, now) = (part(i - 1), part(i));
            each(if i == parts { record } else { Record::Jump }, [now[0] - before[0], now[1] - before[1]]);
        }
    }
}

/// Reports moves without a trim at which machines cut the thread: `is_cut` of their number of jumps and their longer way,
/// tenths of a millimetre. The words are the rule and the name of the format with its article.
pub(super) fn told_cuts(
    program: &Program,
    longest: i64,
    (rule, name): (&str, &str),
    is_cut: impl Fn((usize, i64)) -> bool,
    out: &mut Diagnostics,
) {
    // Jumps in a row and their way, while the thread runs on; the flag is true for one that is counted.
    let mut jumps: Option<(usize, [i64; 2], bool)> = None;
    let mut cuts = 0;
    records(program, longest, |kind, way| match (kind, &mut jumps) {
        (Record::Stitch, _) => jumps = Some((0, [0; 2], false)),
        (Record::Jump, Some((count, sum, is_counted))) => {
            *count += 1;
            *sum = [sum[0] + way[0], sum[1] + way[1]];
            if !*is_counted && is_cut((*count, sum[0].abs().max(sum[1].abs()))) {
                *is_counted = true;
                cuts += 1;
            }
        }
        (Record::Jump, None) => {}
        (Record::Trim | Record::Stop | Record::Thread(_), _) => jumps = None,
    });
    if cuts > 0 {
        let message =
            format!("{cuts} moves without a trim are {rule} in {name} file: most machines cut the thread there");
        let hint = "set `sewing.trim`, move such seams nearer to each other, or write EXP";
        out.push(Diagnostic::new(&code::SEW_JUMPS_CUT, message).hint(hint));
    }
}

/// Needle position after an entry, tenths of a millimetre.
pub(super) fn place(step: &Step) -> [i64; 2] {
    [step.to.x, step.to.y].map(|value| (value * TENTHS_PER_MM).round() as i64)
}
