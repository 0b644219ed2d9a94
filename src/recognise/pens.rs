//! Uses of pens and layers, as given by a user, a profile or a name.

use crate::ir::drawing::Pen;
use crate::machine::Job;
use crate::machine::layers::{self, Known};
use crate::machine::plot::PenUse;

/// Use of the lines of a pen or a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Use {
    /// Unknown: decided by the shapes of the lines.
    Unsaid,
    /// Cuts of parts.
    Knife,
    /// Cuts: a layer is a tool, and all of its lines are cut.
    Tool,
    /// Edges of parts and marks that are only drawn.
    Drawn,
    /// Notches and holes by the name of their layer: only notches are cut, and others are reported.
    Marks,
    /// Ignored lines.
    Ignore,
}

impl Use {
    /// True if lines are cut by this use.
    pub(super) fn is_knife(self) -> bool {
        matches!(self, Self::Knife | Self::Tool)
    }

    /// True if lines of this use are drawn, but for notches.
    pub(super) fn is_drawn(self) -> bool {
        matches!(self, Self::Drawn | Self::Marks)
    }
}

impl From<PenUse> for Use {
    fn from(used: PenUse) -> Self {
        match used {
            PenUse::Knife => Self::Knife,
            PenUse::Pen => Self::Drawn,
            PenUse::Ignore => Self::Ignore,
        }
    }
}

/// Uses of the pens of a drawing in a job, in their order.
pub(super) fn uses(pens: &[Pen], job: &Job) -> Vec<Use> {
    let mut of_layers = of_layers(pens, job).into_iter();
    pens.iter()
        .map(|pen| {
            if pen.is_layer {
                match of_layers.next().flatten() {
                    Some((PenUse::Knife, _)) => Use::Tool,
                    Some((PenUse::Pen, Known::Named)) if layers::names_marks(&pen.name) => Use::Marks,
                    Some((used, _)) => used.into(),
                    None => Use::Unsaid,
                }
            } else {
                of_pen(pen, job)
            }
        })
        .collect()
}

/// Uses of the layers among the pens of a drawing, in their order, and their sources.
pub(super) fn of_layers(pens: &[Pen], job: &Job) -> Vec<Option<(PenUse, Known)>> {
    let names: Vec<&str> = pens.iter().filter(|pen| pen.is_layer).map(|pen| pen.name.as_str()).collect();
    layers::uses(&names, job.lines.layers.as_ref(), &job.profile.drawing.layers)
}

/// Use of a pen of a plotter.
fn of_pen(pen: &Pen, job: &Job) -> Use {
    let number = pen.name.parse::<u32>().ok();
    match (&job.lines.pens, job.profile.hpgl.pen(&pen.name)) {
        // A plotter without a pen draws nothing.
        _ if !pen.draws => Use::Ignore,
        (_, Some(PenUse::Ignore)) => Use::Ignore,
        (Some(pens), _) => {
            if number.is_some_and(|number| pens.has(number)) {
                Use::Knife
            } else {
                Use::Drawn
            }
        }
        (None, Some(used)) => used.into(),
        (None, None) => Use::Unsaid,
    }
}
