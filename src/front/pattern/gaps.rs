//! Gaps: outlines whose ends nearly meet are closed by straight lines, and it is reported.

use super::chain::Chain;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Point, polyline, ring};
use crate::ir::drawing::Vertex;
use crate::machine::CLOSE_MOST_MM;
use crate::source::Span;

/// Maximum number of open lines whose ends are compared; only a damaged file has more.
const MOST_OPEN: usize = 500;
/// Minimum number of vertices of a line with an interior.
const LEAST_RING: usize = 3;
/// Step in which `drawing.close_mm` is suggested, mm, and the rounding of a gap that is a multiple of it, in steps.
const STEP: f64 = 0.1;
const STEP_EPSILON: f64 = 1e-6;

/// A gap that was closed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gap {
    width: f64,
    /// Location of the outline in the file.
    span: Span,
}

/// An end of an open line: twice the index of the line, plus one for its last vertex.
type End = usize;

/// Closes outlines whose gaps are at most `most` mm wide.
pub(super) fn closed(lines: Vec<Chain>, most: f64, gaps: &mut Vec<Gap>) -> Vec<Chain> {
    let open: Vec<usize> = (0..lines.len()).filter(|&k| !lines[k].is_closed).collect();
    if open.is_empty() || open.len() > MOST_OPEN {
        return lines;
    }
    let ends: Vec<End> = open.iter().flat_map(|&k| [2 * k, 2 * k + 1]).collect();
    let partner = |end: End| {
        let other = nearest(&lines, &ends, end).filter(|(gap, _)| *gap <= most)?;
        nearest(&lines, &ends, other.1).is_some_and(|(_, back)| back == end).then_some(other)
    };
    let mut rings: Vec<Option<Chain>> = vec![None; lines.len()];
    let mut is_used = vec![false; lines.len()];
    for &first in open.iter() {
        let Some((ring, of_ring, used)) = ring_from(&lines, first, partner).filter(|_| !is_used[first]) else {
            continue;
        };
        if is_wider_than(&ring, most) {
            used.into_iter().for_each(|k| is_used[k] = true);
            rings[first] = Some(ring);
            gaps.extend(of_ring);
        }
    }
    let rest = lines.into_iter().zip(rings).zip(is_used);
    rest.filter_map(|((line, ring), is_used)| if is_used { ring } else { Some(line) }).collect()
}

fn place(lines: &[Chain], end: End) -> Point {
    let vertices = &lines[end / 2].vertices;
    vertices[if end.is_multiple_of(2) { 0 } else { vertices.len() - 1 }].at
}

/// The nearest other end, and its distance, mm.
fn nearest(lines: &[Chain], ends: &[End], end: End) -> Option<(f64, End)> {
    let others = ends.iter().filter(|&&other| other != end);
    let all = others.map(|&other| ((place(lines, other) - place(lines, end)).norm(), other));
    all.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
}

/// The ring of lines from one line over its gaps back to it, with the gaps and the lines.
fn ring_from(
    lines: &[Chain],
    first: usize,
    partner: impl Fn(End) -> Option<(f64, End)>,
) -> Option<(Chain, Vec<Gap>, Vec<usize>)> {
    let span = lines[first].vertices[0].span;
    let (mut vertices, mut gaps, mut used): (Vec<Vertex>, Vec<Gap>, Vec<usize>) = Default::default();
    let mut start = 2 * first;
    loop {
        let line = &lines[start / 2];
        let is_forward = start.is_multiple_of(2);
        let of_line = line.vertices.iter().copied();
        if is_forward {
            vertices.extend(of_line)
        } else {
            vertices.extend(of_line.rev())
        };
        used.push(start / 2);
        let (width, next) = partner(start ^ 1)?;
        gaps.push(Gap { width, span });
        if next == 2 * first {
            let is_ring = vertices.len() >= LEAST_RING;
            return is_ring.then(|| (Chain { vertices, is_closed: true }, gaps, used));
        }
        if used.contains(&(next / 2)) {
            return None;
        }
        start = next;
    }
}

/// True if a ring is wider than a gap, unlike two lines beside each other.
fn is_wider_than(ring: &Chain, gap: f64) -> bool {
    let points = ring.points();
    ring::area(&points).abs() > gap * polyline::length(&points) / 2.0
}

/// Reports the outlines that were closed.
pub(super) fn say_gaps(gaps: &[Gap], out: &mut Diagnostics) {
    let Some(first) = gaps.first() else { return };
    let widest = gaps.iter().map(|gap| gap.width).fold(0.0, f64::max);
    let message = match gaps.len() {
        1 => format!("an outline has a gap of {widest:.1} mm: closed straight"),
        count => format!("outlines have {count} gaps: closed straight, by up to {widest:.1} mm"),
    };
    let finding = Diagnostic::new(&code::DRAWING_CLOSED, message).at(first.span);
    out.push(finding.hint("look at them in the picture (`-t svg`); `--set drawing.close_mm=0` leaves them open"));
}

/// The error for an outline that does not close; `all` are the outlines of its block.
pub(super) fn open_outline<'a>(edge: &Chain, all: impl Iterator<Item = &'a Chain>) -> Diagnostic {
    let ends = |line: &Chain| [line.vertices[0], line.vertices[line.vertices.len() - 1]];
    let [first, last] = ends(edge);
    let others: Vec<Point> = all.filter(|line| !line.is_closed).flat_map(|line| ends(line).map(|end| end.at)).collect();
    let gap = |at: Point, own: Point| {
        let others = others.iter().filter(|other| **other != at).chain([&own]);
        others.map(|other| (other - at).norm()).fold(f64::INFINITY, f64::min)
    };
    let gap = gap(first.at, last.at).max(gap(last.at, first.at));
    let message = format!("the outline that begins here does not close: its gap is {gap:.1} mm wide");
    let finding = Diagnostic::new(&code::DXF_OPEN_OUTLINE, message).at(first.span);
    // Rounded up: the gap itself must be within it.
    let close = (gap / STEP - STEP_EPSILON).ceil() * STEP;
    if close > CLOSE_MOST_MM {
        return finding.hint(format!("close it in the CAD system: no key closes gaps above {CLOSE_MOST_MM} mm"));
    }
    finding.hint(format!("let the CAD close it, or close gaps of that width: `--set drawing.close_mm={close:.1}`"))
}
