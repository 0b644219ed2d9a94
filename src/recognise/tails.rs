//! Tails: slits that a plot draws in one stroke with their outline. The pen goes from the tip to the edge and round the
//! outline, or the reverse.

use super::line::SHORTEST_NOTCH;
use crate::geom::closing;
use crate::ir::drawing::{Drawing, PenStroke};
use crate::ir::marker::Notch;

/// Least number of places of an outline with its tail: a triangle's, its first one again, and the tip.
const LEAST: usize = 5;

/// Splits each outline with a tail into two strokes: the slit, and the outline. Places within `reach` along an axis merge, mm.
pub(super) fn split(drawing: &mut Drawing, reach: f64) {
    let strokes = std::mem::take(&mut drawing.strokes);
    drawing.strokes.reserve(strokes.len());
    for stroke in strokes {
        let PenStroke { first, end, pen } = stroke;
        match foot(drawing, &stroke, reach) {
            Some(foot) => {
                drawing.strokes.push(PenStroke { first, end: foot + 1, pen });
                drawing.strokes.push(PenStroke { first: foot, end, pen });
            }
            None => drawing.strokes.push(stroke),
        }
    }
}

/// Index of the place of a stroke at which its tail stands on its outline; `None` without a tail.
fn foot(drawing: &Drawing, stroke: &PenStroke, reach: f64) -> Option<u32> {
    let vertices = &drawing.vertices[stroke.range()];
    // A line that runs past its start has an overcut, not a tail.
    let runs_past = || closing::retrace(vertices.len(), |k| vertices[k].at, closing::reach(drawing.unit)).is_some();
    if vertices.len() < LEAST {
        return None;
    }
    let last = vertices.len() - 1;
    let way = |a: usize, b: usize| vertices[a].at - vertices[b].at;
    let meet = |a: usize, b: usize| way(a, b).amax() <= reach;
    let is_slit = |a: usize, b: usize| (SHORTEST_NOTCH..=Notch::LONGEST).contains(&way(a, b).norm());
    let foot = if meet(0, last) {
        None
    } else if meet(1, last) && is_slit(0, 1) {
        Some(stroke.first + 1)
    } else if meet(0, last - 1) && is_slit(last, last - 1) {
        Some(stroke.end - 2)
    } else {
        None
    };
    foot.filter(|_| !runs_past())
}
