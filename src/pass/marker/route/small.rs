//! Small pieces first: once the pieces around it are cut out, only suction holds a small piece, so it is cut before its larger
//! neighbours.

use crate::analysis::nesting::Nesting;
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline, ring};
use crate::ir::Marker;
use crate::machine::Order;

/// Greatest distance of neighbouring pieces, mm: a narrower strip of waste holds nothing.
const NEXT: f64 = 10.0;
/// Greatest distance along X by which a small piece may begin after a larger one and still be cut before it, as a share of the
/// window: farther on the work would leave the surroundings of the larger one behind.
pub(super) const AHEAD: f64 = 0.5;

/// Outline of a piece.
struct Outline {
    points: Vec<Point>,
    extent: Extent,
    is_small: bool,
}

/// Larger pieces that must follow each piece because it is small and they are next to it.
pub(super) fn held(marker: &Marker, nesting: &Nesting, order: &Order) -> Vec<Vec<usize>> {
    let outlines: Vec<Option<Outline>> = (0..marker.pieces.len())
        .map(|piece| outline(marker, nesting, piece))
        .map(|points| points.map(|points| Outline::new(points, order)))
        .collect();
    let mut held = vec![Vec::new(); outlines.len()];
    if !outlines.iter().flatten().any(|outline| outline.is_small) {
        return held;
    }
    let large = |outline: &&Outline| !outline.is_small;
    let edges = outlines.iter().zip(0..).flat_map(|(outline, piece)| {
        let of_large = outline.as_ref().filter(large).map_or(&[][..], |outline| &outline.points);
        of_large.windows(2).map(move |ends| (piece, [ends[0], ends[1]]))
    });
    let edges: Vec<(usize, [Point; 2])> = edges.collect();
    let boxes = Boxes::new(edges.iter().map(|(_, [from, to])| Extent::between(*from, *to)).collect());
    for (piece, small) in outlines.iter().enumerate() {
        let Some(small) = small.as_ref().filter(|outline| outline.is_small) else { continue };
        let is_near_in_x = |other: usize| {
            let other = outlines[other].as_ref().expect("its edges are there");
            small.extent.min.x <= other.extent.min.x + AHEAD * order.window_mm
        };
        let mut next: Vec<usize> = Vec::new();
        for ends in small.points.windows(2).map(|ends| [ends[0], ends[1]]) {
            for (other, edge) in boxes.near(Extent::between(ends[0], ends[1]).grown(NEXT)).map(|edge| edges[edge]) {
                if !next.contains(&other) && polyline::distance_of_segments(ends, edge) <= NEXT && is_near_in_x(other) {
                    next.push(other);
                }
            }
        }
        next.sort_unstable();
        held[piece] = next;
    }
    held
}

impl Outline {
    fn new(points: Vec<Point>, order: &Order) -> Self {
        let is_small = ring::area(&points).abs() < order.small_mm2;
        Self { extent: Extent::of(&points), points, is_small }
    }
}

/// Points of the outline of a piece; `None` if it does not bound a part.
fn outline(marker: &Marker, nesting: &Nesting, piece: usize) -> Option<Vec<Point>> {
    let line = nesting.widest(piece).filter(|&line| nesting.lines()[line].is_closed && !nesting.is_inner(line))?;
    let contour = marker.pieces[piece].contours[line - nesting.of_group(piece).start];
    Some(marker.list.points(contour.range).into_owned())
}
