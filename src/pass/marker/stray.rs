//! Short strokes that begin on no outline: notches whose place was lost.

use crate::analysis::outlines::Outlines;
use crate::diagnostic::{Diagnostic, code};
use crate::geom::budget::Budget;
use crate::geom::{Point, polyline};
use crate::ir::marker::{Contour, Marker, Notch};

/// The finding on strokes of the length of a slit in a piece that neither touch nor cross an edge of it. Drawings have marks
/// inside their parts; cutter files have only what is to be cut. `part` is the outline of the piece.
pub(super) fn strays(marker: &Marker, piece: usize, part: &Outlines, work: &mut Budget) -> Option<Diagnostic> {
    let contours = &marker.pieces[piece].contours;
    if marker.drawing.is_some() || contours.iter().all(|contour| contour.closed) {
        return None; // the usual case
    }
    let ends = |contour: &Contour| -> Option<[Point; 2]> {
        let points = marker.list.points(contour.range);
        let [from, to] = points[..] else { return None };
        (!contour.closed && (to - from).norm() <= Notch::LONGEST).then_some([from, to])
    };
    // Without an edge the other lines may be the sides of one that is not closed.
    let has_edge = part.closed().next().is_some();
    if !has_edge && !contours.iter().all(|contour| ends(contour).is_some()) {
        return None;
    }
    let distance = |from: Point| {
        let edges = part.closed().flat_map(|points| points.windows(2));
        edges.map(|edge| polyline::distance_to_segment(from, edge[0], edge[1])).fold(f64::INFINITY, f64::min)
    };
    let reach = Notch::MISS + marker.unit;
    let mut is_stray = |[from, to]: [Point; 2]| {
        work.spend(4 * part.points.len())
            && distance(from).min(distance(to)) > reach
            && part.holds(from) == part.holds(to)
    };
    let mut strays = contours.iter().filter_map(|contour| Some((contour, ends(contour)?)));
    let (first, [from, _]) = strays.find(|&(_, ends)| is_stray(ends))?;
    let more = match strays.filter(|&(_, ends)| is_stray(ends)).count() {
        0 => String::new(),
        more => format!(", and {more} more"),
    };
    let span = marker.list.spans(first.range).first().copied().unwrap_or_default();
    let message = format!("a short stroke begins on no edge of piece {}{more}", marker.pieces[piece].number);
    let finding = Diagnostic::new(&code::MARKER_STRAY, message).at(span).on_cloth(from);
    Some(finding.hint("its place may be wrong: look where it is in the picture (`-t svg`)"))
}
