//! What a user or a profile says of pens and layers.

use crate::ir::drawing::Pen;
use crate::machine::Job;
use crate::machine::plot::PenUse;

/// What the lines of a pen stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Use {
    /// Nobody says: their shapes do.
    Unsaid,
    /// Cuts.
    Knife,
    /// Edges of parts and marks that are drawn only.
    Drawn,
    /// Nothing.
    Ignore,
}

/// What a pen stands for in a job.
pub(super) fn usage(pen: &Pen, job: &Job) -> Use {
    let number = pen.name.parse::<u32>().ok();
    match (&job.lines.pens, job.profile.hpgl.pen(&pen.name)) {
        // While no pen is taken nothing is drawn.
        _ if !pen.draws => Use::Ignore,
        (_, Some(PenUse::Ignore)) => Use::Ignore,
        (Some(pens), _) => {
            if number.is_some_and(|number| pens.has(number)) {
                Use::Knife
            } else {
                Use::Drawn
            }
        }
        (None, Some(PenUse::Knife)) => Use::Knife,
        (None, Some(PenUse::Pen)) => Use::Drawn,
        (None, None) => Use::Unsaid,
    }
}
