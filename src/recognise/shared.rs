//! Edges of two parts that loose lines of a drawing draw, each part for itself.
//!
//! Lines in the order of the file tell the parts apart ([`succession`](super::succession)). In any other order the ends of
//! such an edge meet four lines or more, and one part may be lost: then the drawing is refused.

use std::collections::BTreeMap;

use super::line::Line;
use super::pens::Use;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline};
use crate::ir::drawing::{Drawing, Vertex};
use crate::source::Span;
use crate::units::number::fixed;

/// Shortest edge of two parts that is looked at, mm: shorter ones are letters and signs.
const SHORTEST: f64 = 25.0;
/// Distance within which ends are at one place, mm.
const REACH: f64 = 0.2;
/// Lines that meet where two parts do, the edge that they share counted once.
const MEETING: usize = 3;
/// Digits of the length that a message tells.
const DECIMALS: u32 = 1;

/// A place of a grid, and the pen that draws there.
type Node = (u16, [i64; 2]);

/// An edge that two strokes draw where others go on from both its ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct SharedEdge {
    middle: Point,
    length: f64,
    span: Span,
}

/// Edges of a drawing with layers that are drawn twice between places where three lines or more meet.
pub(super) fn edges(drawing: &Drawing, uses: &[Use]) -> Vec<SharedEdge> {
    let is_asked = |pen: u16| {
        let pen = usize::from(pen);
        drawing.pens.get(pen).is_some_and(|pen| pen.is_layer)
            && !matches!(uses.get(pen), Some(Use::Ignore | Use::Drawn))
    };
    let mut edges: BTreeMap<([Node; 2], i64), (usize, SharedEdge)> = BTreeMap::new();
    for stroke in drawing.strokes.iter().filter(|stroke| is_asked(stroke.pen)) {
        let vertices = &drawing.vertices[stroke.range()];
        let points: Vec<Point> = vertices.iter().map(|vertex| vertex.at).collect();
        let (from, to) = (points[0], points[points.len() - 1]);
        let length = polyline::length(&points);
        if length < SHORTEST || (to - from).amax() <= REACH {
            continue;
        }
        let node = |at: Point| (stroke.pen, [at.x, at.y].map(|mm| (mm / REACH).round() as i64));
        let mut ends = [node(from), node(to)];
        ends.sort_unstable();
        let middle = points[(points.len() - 1) / 2];
        let middle = middle + (points[points.len() / 2] - middle) / 2.0;
        let edge = SharedEdge { middle, length, span: vertices[vertices.len() - 1].span };
        edges.entry((ends, (length / REACH).round() as i64)).or_insert((0, edge)).0 += 1;
    }
    if edges.values().all(|(count, _)| *count < 2) {
        return Vec::new();
    }
    let mut meeting: BTreeMap<Node, usize> = BTreeMap::new();
    for node in edges.keys().flat_map(|(ends, _)| ends) {
        *meeting.entry(*node).or_default() += 1;
    }
    let is_shared = |ends: &[Node; 2]| ends.iter().all(|node| meeting[node] >= MEETING);
    let shared = edges.iter().filter(|((ends, _), (count, _))| *count > 1 && is_shared(ends));
    shared.map(|(_, (_, edge))| *edge).collect()
}

/// Refuses a drawing of whose shared edges not each is on the outlines of two parts.
pub(super) fn refuse(edges: &[SharedEdge], lines: &[Line], vertices: &[Vertex], out: &mut Diagnostics) {
    if edges.is_empty() {
        return;
    }
    let outlines: Vec<&Line> = lines.iter().filter(|line| line.is_cut && line.is_closed).collect();
    let boxes = Boxes::new(outlines.iter().map(|line| line.extent.grown(REACH)).collect());
    let parts = |edge: &&SharedEdge| {
        let is_on = |k: &usize| polyline::distance(edge.middle, &outlines[*k].points(vertices)) <= REACH;
        boxes.near(Extent::between(edge.middle, edge.middle)).filter(is_on).count()
    };
    let lost: Vec<&SharedEdge> = edges.iter().filter(|edge| parts(edge) < 2).collect();
    let Some(longest) = lost.iter().max_by(|a, b| a.length.total_cmp(&b.length)) else { return };
    let (edges, are) = if lost.len() == 1 { ("edge", "is") } else { ("edges", "are") };
    let (count, length) = (lost.len(), fixed(longest.length, DECIMALS));
    let message = format!("{count} {edges} of loose lines {are} drawn for two parts, up to {length} mm long");
    let finding = Diagnostic::new(&code::DRAWING_SHARED_EDGE, message).at(longest.span);
    out.push(finding.hint("let the CAD draw each part as one closed polyline, or its lines one after the other"));
}
