//! Markers of plain outlines, for tests.

use crate::geom::Point;
use crate::ir::Marker;
use crate::ir::list::{Joint, Segment};
use crate::ir::marker::{Contour, Piece};
use crate::source::Span;

/// Marker of pieces whose outlines have these corners, mm.
pub(in crate::verify) fn marker<'a>(outlines: impl IntoIterator<Item = &'a [[f64; 2]]>) -> Marker {
    let mut marker = Marker::default();
    for outline in outlines {
        let corners: Vec<Point> = outline.iter().chain(&outline[..1]).copied().map(Point::from).collect();
        let edges = corners.windows(2).map(|ends| Segment {
            from: ends[0],
            to: ends[1],
            span: Span { start: 0, end: 0, block: 1 },
            joint: Joint::default(),
            percent: 100,
        });
        let range = marker.list.append(edges).expect("it has a length");
        marker.pieces.push(Piece { contours: vec![Contour { range, closed: true }], ..Piece::default() });
    }
    marker
}
