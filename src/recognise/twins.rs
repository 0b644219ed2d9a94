//! Twins: lines along which another line of the same use runs from end to end with other vertices. A second pass of an outline
//! may start elsewhere, have other vertices, or be a unit aside.
//!
//! Two parts never share all of their edges, so twins are one line. An open line that lies on a closed one draws a part of it
//! again.

use super::line::{Class, Closing, Line};
use crate::geom::along::Lines;
use crate::geom::budget::Budget;
use crate::ir::drawing::Vertex;

/// Marks repeated lines: those that are within `reach`, mm, of another line all along, and that line of them. The line that
/// needs no closing stays; of two such lines, the first.
pub(super) fn mark(lines: &mut [Line], vertices: &[Vertex], reach: f64, work: &mut Budget) {
    let mut order: Vec<usize> = (0..lines.len()).filter(|&i| !lines[i].is_set_aside()).collect();
    order.sort_by_key(|&i| (lines[i].closing != Closing::Drawn, i));
    let all = Lines {
        extents: order.iter().map(|&i| lines[i].extent).collect(),
        points: |k: usize| lines[order[k]].points(vertices),
        may_be: |one, other| may_be_twins([one, other].map(|k: usize| &lines[order[k]]), reach),
    };
    for [_, twin] in all.twins(reach, work) {
        lines[order[twin]].class = Class::Again;
    }
}

/// True if two lines have the same use and kind, and nearly the same area.
fn may_be_twins([one, other]: [&Line; 2], reach: f64) -> bool {
    let is_as_large = (one.area - other.area).abs() <= reach * one.length.max(other.length);
    is_as_large && one.usage == other.usage && one.is_closed == other.is_closed
}

/// Marks open lines that would be cut although they lie within `reach`, mm, of a closed line of the same use that is cut, all
/// along. Notches begin on it and lead away.
pub(super) fn mark_parts(lines: &mut [Line], vertices: &[Vertex], reach: f64, work: &mut Budget) {
    let is_lying = |line: &Line| line.is_cut && !line.is_closed && line.class != Class::Notch;
    if !lines.iter().any(is_lying) {
        return; // as in nearly all drawings
    }
    let cut: Vec<usize> =
        (0..lines.len()).filter(|&i| lines[i].is_cut && (lines[i].is_closed || is_lying(&lines[i]))).collect();
    let lying: Vec<usize> = (0..cut.len()).filter(|&k| is_lying(&lines[cut[k]])).collect();
    let all = Lines {
        extents: cut.iter().map(|&i| lines[i].extent).collect(),
        points: |k: usize| lines[cut[k]].points(vertices),
        may_be: |one: usize, other: usize| {
            let [one, other] = [one, other].map(|k| &lines[cut[k]]);
            other.is_closed && one.usage == other.usage
        },
    };
    for [line, _] in all.lying_on(&lying, reach, work) {
        (lines[cut[line]].class, lines[cut[line]].is_cut) = (Class::Again, false);
    }
}
