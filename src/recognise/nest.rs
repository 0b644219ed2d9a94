//! Nesting of closed lines.

use std::borrow::Cow;

use super::line::{Line, SMALL_OUTLINE};
use crate::analysis::nesting::{self, Hold, Nesting};
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point};
use crate::ir::drawing::Vertex;

/// Criteria of nesting: hems are drawn past the corners of their parts, and touching parts overlap by rounding. Of a line that
/// is drawn twice, one contains the other.
const MOSTLY: Hold = Hold { box_share: 0.8, share: 0.75, twins: true, band: 0.0 };

/// Nesting of the lines that may be outlines; only large ones contain others.
pub(super) fn nesting(lines: &[Line], vertices: &[Vertex], work: &mut Budget) -> Nesting {
    let line = |(line, group): (&Line, u32)| nesting::Line {
        extent: if line.may_hold() { line.extent } else { Extent::EMPTY },
        group,
        is_closed: line.may_hold() || line.is_closed,
        may_hold: line.may_hold() && line.size() > SMALL_OUTLINE,
    };
    let points = |line: usize| Cow::Owned(lines[line].points(vertices));
    Nesting::new(lines.iter().zip(0..).map(line).collect(), MOSTLY, points, work)
}

/// Middle of a box.
pub(super) fn middle(extent: &Extent) -> Point {
    extent.min + (extent.max - extent.min) / 2.0
}
