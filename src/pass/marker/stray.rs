//! Short strokes and slits that begin on no outline: notches whose place was lost.

use crate::analysis::outlines::Outlines;
use crate::diagnostic::{Diagnostic, code};
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, polyline};
use crate::ir::marker::{Contour, Marker, Notch};
use crate::source::Span;

/// The finding on strokes of the length of a slit in a piece that neither touch nor cross an edge of it, and on slits that
/// begin on none. Drawings have marks inside their parts; cutter files have only what is to be cut. `part` is the outline of
/// the piece.
pub(super) fn strays(marker: &Marker, piece: usize, part: &Outlines, work: &mut Budget) -> Option<Diagnostic> {
    let contours = &marker.pieces[piece].contours;
    if marker.drawing.is_some() || contours.is_empty() {
        return None;
    }
    let reach = Notch::MISS + marker.unit;
    let slits = loose_slits(&marker.pieces[piece].notches, part, reach, work);
    let is_closed = contours.iter().all(|contour| contour.closed);
    let strokes = if is_closed { Vec::new() } else { loose_strokes(marker, contours, part, reach, work) };
    let kind = if slits.is_empty() { "short stroke" } else { "slit" };
    let count = slits.len() + strokes.len();
    let (span, from) = slits.into_iter().chain(strokes).next()?;
    let more = if count > 1 { format!(", and {} more", count - 1) } else { String::new() };
    let message = format!("a {kind} begins on no edge of piece {}{more}", marker.pieces[piece].number);
    let finding = Diagnostic::new(&code::MARKER_STRAY, message).at(span).on_cloth(from);
    Some(finding.hint("its place may be wrong: look where it is in the picture (`-t svg`)"))
}

/// Open strokes of the length of a slit, with both ends off all edges and on one side of them.
fn loose_strokes(
    marker: &Marker,
    contours: &[Contour],
    part: &Outlines,
    reach: f64,
    work: &mut Budget,
) -> Vec<(Span, Point)> {
    let ends = |contour: &Contour| -> Option<[Point; 2]> {
        let points = marker.list.points(contour.range);
        let [from, to] = points[..] else { return None };
        (!contour.closed && (to - from).norm() <= Notch::LONGEST).then_some([from, to])
    };
    // Without an edge the other lines may be the sides of one that is not closed.
    let has_edge = part.closed().next().is_some();
    if !has_edge && !contours.iter().all(|contour| ends(contour).is_some()) {
        return Vec::new();
    }
    let distance = |from: Point| {
        let edges = part.closed().flat_map(|points| points.windows(2));
        edges.map(|edge| polyline::distance_to_segment(from, edge[0], edge[1])).fold(f64::INFINITY, f64::min)
    };
    let mut is_stray = |[from, to]: [Point; 2]| {
        work.spend(4 * part.points.len())
            && distance(from).min(distance(to)) > reach
            && part.holds(from) == part.holds(to)
    };
    let strokes = contours.iter().filter_map(|contour| Some((contour, ends(contour)?)));
    let strays = strokes.filter(|&(_, ends)| is_stray(ends));
    let span = |contour: &Contour| marker.list.spans(contour.range).first().copied().unwrap_or_default();
    strays.map(|(contour, [from, _])| (span(contour), from)).collect()
}

/// Slits that begin on no edge: neither on another slit nor across an edge, or inside and longer than any notch.
fn loose_slits(slits: &[Notch], part: &Outlines, reach: f64, work: &mut Budget) -> Vec<(Span, Point)> {
    let meets_edge = |ends: [Point; 2], work: &mut Budget| {
        let mut edges = part.edges_near(Extent::of(&ends).grown(reach));
        edges.any(|edge| !work.spend(1) || polyline::distance_of_segments(ends, edge) <= reach)
    };
    let is_branch = |slit: &Notch, work: &mut Budget| {
        let mut others = slits.iter().filter(|other| other.root != slit.root);
        work.spend(slits.len())
            && others.any(|other| polyline::distance_to_segment(slit.root, other.root, other.tip) <= reach)
    };
    let is_loose = |slit: &Notch, work: &mut Budget| {
        !meets_edge([slit.root; 2], work)
            && (!meets_edge([slit.root, slit.tip], work) && !is_branch(slit, work)
                || slit.depth() > Notch::LONGEST && work.spend(part.points.len()) && part.holds(slit.root))
            && !work.is_spent()
    };
    slits.iter().filter(|slit| is_loose(slit, work)).map(|slit| (slit.span, slit.root)).collect()
}
