//! Strokes of a drawing in its second reading.

use std::collections::BTreeSet;

use crate::geom::Point;
use crate::machine::{Job, layers};

/// Strokes of a drawing.
pub(in crate::verify::source) struct Drawn {
    /// Points between two lifts, mm.
    pub(in crate::verify::source) strokes: Vec<Vec<Point>>,
    /// Unit of which the numbers of the file are multiples, mm; 0 when they are not rounded.
    pub(in crate::verify::source) unit: f64,
    /// Names of the layers with strokes; empty for a plot, which has pens.
    pub(in crate::verify::source) layers: BTreeSet<String>,
}

impl Drawn {
    /// True if the use of pens or layers is specified: then shapes do not determine what is cut.
    pub(in crate::verify::source) fn is_said(&self, job: &Job) -> bool {
        let layers: Vec<&str> = self.layers.iter().map(String::as_str).collect();
        let uses = layers::uses(&layers, job.lines.layers.as_ref(), &job.profile.drawing.layers);
        if layers.is_empty() {
            job.lines.pens.is_some() || !job.profile.hpgl.pens.is_empty()
        } else {
            uses.iter().any(Option::is_some)
        }
    }
}
