//! Common part of stitch files: moves in whole tenths of a millimetre, of limited length.

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
    /// The machine stops, for its operator or for another thread.
    Stop,
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
            Op::Stop | Op::Color(_) => Record::Stop,
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

/// Needle position after an entry, tenths of a millimetre.
pub(super) fn place(step: &Step) -> [i64; 2] {
    [step.to.x, step.to.y].map(|value| (value * TENTHS_PER_MM).round() as i64)
}
