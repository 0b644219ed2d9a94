//! Edges of two parts that loose lines in a drawing draw separately for each part.
//!
//! Lines in the order of the file distinguish the parts ([`succession`](super::succession)). In any other order the ends of
//! such an edge meet at least four lines, and one part may be lost: the drawing is then refused. An edge drawn once for two
//! parts is reported.

use std::collections::BTreeMap;

use super::line::Line;
use super::meeting;
use super::pens::Use;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline};
use crate::ir::drawing::{Drawing, Vertex};
use crate::source::Span;
use crate::units::number::fixed;

/// Least length of a shared edge of two parts, mm: shorter ones are letters and signs.
const SHORTEST: f64 = 25.0;
/// Distance within which ends are at one place, mm.
const REACH: f64 = 0.2;
/// Number of lines that meet where two parts do, with the shared edge counted once.
const MEETING: usize = 3;
/// Decimals of lengths in messages.
const DECIMALS: u32 = 1;

/// Number of a place where ends meet.
type Node = usize;

/// Edge drawn by two strokes with others continuing from both its ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct SharedEdge {
    middle: Point,
    length: f64,
    span: Span,
}

/// Edges of a drawing with layers that are drawn twice between places where at least three lines meet.
pub(super) fn edges(drawing: &Drawing, uses: &[Use]) -> Vec<SharedEdge> {
    let is_asked = |pen: u16| {
        let pen = usize::from(pen);
        drawing.pens.get(pen).is_some_and(|pen| pen.is_layer)
            && !matches!(uses.get(pen), Some(Use::Ignore | Use::Drawn | Use::Marks))
    };
    let mut strokes: Vec<(u16, [Point; 2], SharedEdge)> = Vec::new();
    for stroke in drawing.strokes.iter().filter(|stroke| is_asked(stroke.pen)) {
        let vertices = &drawing.vertices[stroke.range()];
        let points: Vec<Point> = vertices.iter().map(|vertex| vertex.at).collect();
        let ends = [points[0], points[points.len() - 1]];
        let length = polyline::length(&points);
        if length < SHORTEST || (ends[1] - ends[0]).amax() <= REACH {
            continue;
        }
        let middle = points[(points.len() - 1) / 2];
        let middle = middle + (points[points.len() / 2] - middle) / 2.0;
        let span = vertices[vertices.len() - 1].span;
        strokes.push((stroke.pen, ends, SharedEdge { middle, length, span }));
    }
    let ends: Vec<(u16, Point)> = strokes.iter().flat_map(|&(pen, ends, _)| ends.map(|end| (pen, end))).collect();
    let nodes = meeting::places(&ends, REACH);
    let mut edges: BTreeMap<[Node; 2], Vec<(usize, SharedEdge)>> = BTreeMap::new();
    for (k, (_, _, edge)) in strokes.iter().enumerate() {
        let mut ends = [nodes[2 * k], nodes[2 * k + 1]];
        ends.sort_unstable();
        let between = edges.entry(ends).or_default();
        match between.iter_mut().find(|(_, other)| (other.length - edge.length).abs() <= REACH) {
            Some((count, _)) => *count += 1,
            None => between.push((1, *edge)),
        }
    }
    let mut degree: BTreeMap<Node, usize> = BTreeMap::new();
    for (ends, between) in &edges {
        for node in ends {
            *degree.entry(*node).or_default() += between.len();
        }
    }
    let is_shared = |ends: &[Node; 2]| ends.iter().all(|node| degree[node] >= MEETING);
    let twice = edges.iter().filter(|(ends, _)| is_shared(ends)).flat_map(|(_, between)| between);
    twice.filter(|(count, _)| *count > 1).map(|(_, edge)| *edge).collect()
}

/// Reports edges that are drawn once for the outlines of two parts.
pub(super) fn say_doubled(doubled: &[Vec<Vertex>], out: &mut Diagnostics) {
    let Some(first) = doubled.first().and_then(|places| places.get(1)) else { return };
    let length = |places: &Vec<Vertex>| places.windows(2).map(|ends| (ends[1].at - ends[0].at).norm()).sum::<f64>();
    let longest = fixed(doubled.iter().map(length).fold(0.0, f64::max), DECIMALS);
    let (count, what) = (doubled.len(), if doubled.len() == 1 { "edge is" } else { "edges are" });
    let message =
        format!("{count} {what} drawn once between two areas, up to {longest} mm: each area is cut as a part");
    let finding = Diagnostic::new(&code::DRAWING_EDGE_OF_TWO, message).at(first.span);
    let finding = finding.hint("leave out an area that is waste with `--skip`; `-t svg` shows all with their numbers");
    out.push(
        finding.hint("if it is a fold, name its layer: `--layers FOLD=ignore`; `--inner ignore` keeps parts whole"),
    );
}

/// Refuses a drawing with a shared edge that is not on the outlines of two parts.
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
    let message =
        format!("{count} {edges} drawn twice {are} on fewer than two outlines, up to {length} mm: a part is lost");
    let finding = Diagnostic::new(&code::DRAWING_PART_LOST, message).at(longest.span);
    out.push(finding.hint("let the CAD draw each part as one closed polyline, or its lines one after the other"));
}
