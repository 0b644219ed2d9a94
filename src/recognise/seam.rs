//! Seam lines: closed lines that follow the outline around them at a nearly constant distance along each of its edges. The
//! distance may differ from edge to edge: hems are wider than seams. If an outline lacks a side, its remaining sides are
//! compared.

use crate::geom::{Extent, Point, Vector, cross, polyline, ring};

/// Greatest distance of a seam line from its outline, mm: the width of hems.
pub(super) const FARTHEST: f64 = 60.0;
/// Greatest distance between the sides of their boxes, mm: at a sharp point of a part the two lines are farther apart.
pub(super) const BOX_MARGIN: f64 = 2.5 * FARTHEST;
/// Greatest distance of a seam line from its edge without a hem, mm.
const WIDEST_ALLOWANCE: f64 = 26.0;
/// Least share of a seam line within [`WIDEST_ALLOWANCE`]: hems are on some edges only, and an opening, such as that of a
/// facing, is farther off all around.
const LEAST_AT_SEAM: f64 = 0.25;
/// Sine of the greatest angle between a seam line and the edge beside it: curved edges are hemmed along their chord.
const LARGEST_TURN: f64 = 0.5;
/// Least shares of a line that are near the outline, and that run along it.
const NEAR: f64 = 0.75;
const ALONG: f64 = 0.7;
/// Least area of a seam line, as a share of its part: a smaller line runs along edges, but not around.
const LEAST_AREA: f64 = 0.15;
/// Number of sampled places on a line.
const SAMPLES: usize = 48;
/// Number of closed lines of a part tried as its seam line, the largest first.
pub(super) const CANDIDATES: usize = 3;
/// Cost of comparing one edge with all samples, in comparisons of boxes.
pub(super) const COST: usize = SAMPLES;

/// Least share of a closed line that an incomplete outline goes around, by its length and by its box.
const LEAST_LEFT: f64 = 0.4;

/// True if the box of an open line fits an incomplete outline around a closed line.
pub(super) fn may_be_left_of(outline: &Extent, line: &Extent) -> bool {
    let (low, high) = (outline.min.sup(&line.min), outline.max.inf(&line.max));
    let (shared, size) = ((high - low).map(|side| side.max(0.0)), line.max - line.min);
    line.grown(BOX_MARGIN).covers(outline) && shared.x * shared.y >= LEAST_LEFT * size.x * size.y
}

/// True if an open line is an incomplete outline around a closed line: it runs beside that line, around much of it.
pub(super) fn is_left_of(outline: &[Point], line: &[Point]) -> bool {
    if polyline::length(outline) < LEAST_LEFT * polyline::length(line) {
        return false;
    }
    let samples = samples(outline);
    let runs_beside = |(at, way): &&(Point, Vector)| {
        let (distance, edge) = nearest(*at, line);
        distance <= FARTHEST && is_along(*way, edge) && !ring::contains(line, *at)
    };
    samples.iter().filter(runs_beside).count() as f64 >= NEAR * samples.len() as f64
}

/// True if a closed line follows the outline in which it lies.
pub(super) fn follows(line: &[Point], outline: &[Point]) -> bool {
    let (inner, outer) = (Extent::of(line), Extent::of(outline));
    let margins = [inner.min - outer.min, outer.max - inner.max];
    let goes_around = ring::area(line).abs() >= LEAST_AREA * ring::area(outline).abs();
    if !goes_around || margins.iter().any(|margin| margin.x > BOX_MARGIN || margin.y > BOX_MARGIN) {
        return false;
    }
    let samples = samples(line);
    let (mut near, mut at_seam, mut along) = (0, 0, 0);
    for (at, way) in &samples {
        let (distance, edge) = nearest(*at, outline);
        near += usize::from(distance <= FARTHEST);
        at_seam += usize::from(distance <= WIDEST_ALLOWANCE);
        along += usize::from(is_along(*way, edge));
    }
    let share = |count: usize| count as f64 / samples.len() as f64;
    share(near) >= NEAR && share(at_seam) >= LEAST_AT_SEAM && share(along) >= ALONG
}

/// Nearest edge of a line to a place: its distance, mm, and its vector.
fn nearest(at: Point, line: &[Point]) -> (f64, Vector) {
    let edges = line.windows(2).map(|edge| (polyline::distance_to_segment(at, edge[0], edge[1]), edge[1] - edge[0]));
    edges.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, Vector::zeros()))
}

/// True if two vectors have nearly the same direction, forwards or backwards.
pub(super) fn is_along(way: Vector, edge: Vector) -> bool {
    cross(way, edge).abs() <= LARGEST_TURN * way.norm() * edge.norm()
}

/// Evenly spaced places along a line, each with the vector of its edge.
pub(super) fn samples(line: &[Point]) -> Vec<(Point, Vector)> {
    let step = polyline::length(line) / SAMPLES as f64;
    let mut samples = Vec::with_capacity(SAMPLES);
    let mut next = step / 2.0;
    for ends in line.windows(2) {
        let way = ends[1] - ends[0];
        let length = way.norm();
        while next <= length && samples.len() < SAMPLES {
            samples.push((ends[0] + way * (next / length), way));
            next += step;
        }
        next -= length;
    }
    samples
}

#[cfg(test)]
mod tests {
    use super::*;

    fn closed(places: &[(f64, f64)]) -> Vec<Point> {
        places.iter().chain(&places[..1]).map(|&(x, y)| Point::new(x, y)).collect()
    }

    fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Vec<Point> {
        closed(&[(x, y), (x + width, y), (x + width, y + height), (x, y + height)])
    }

    #[test]
    fn a_line_at_an_even_distance_from_each_edge_is_a_seam_line_whatever_the_hems() {
        let part = rectangle(0.0, 0.0, 400.0, 300.0);
        for (seam, is_seam) in [
            (rectangle(10.0, 10.0, 380.0, 280.0), true),
            (rectangle(10.0, 50.0, 380.0, 240.0), true),
            (rectangle(10.0, 10.0, 380.0, 100.0), false),
            (rectangle(100.0, 100.0, 100.0, 100.0), false),
            // The opening of a facing is far from all edges.
            (rectangle(50.0, 50.0, 300.0, 200.0), false),
            // A slot beside an edge runs along it, but not around.
            (rectangle(10.0, 10.0, 100.0, 4.0), false),
        ] {
            assert_eq!(follows(&seam, &part), is_seam, "{seam:?}");
        }
        for (part, slot) in
            [([160.0, 90.0], [60.0, 4.0]), ([250.0, 110.0], [80.0, 14.0]), ([200.0, 100.0], [80.0, 20.0])]
        {
            let at = [0, 1].map(|axis| (part[axis] - slot[axis]) / 2.0);
            let (slot, part) = (rectangle(at[0], at[1], slot[0], slot[1]), rectangle(0.0, 0.0, part[0], part[1]));
            assert!(!follows(&slot, &part), "{slot:?}");
        }
    }

    #[test]
    fn an_outline_that_lacks_a_side_is_known_by_what_is_left_of_it() {
        let seam = rectangle(10.0, 10.0, 380.0, 280.0);
        let points = |places: &[[f64; 2]]| places.iter().map(|&at| Point::from(at)).collect::<Vec<_>>();
        for (open, is_left) in [
            // Without a side, with a gap amid a side, with two sides only.
            (points(&[[400.0, 0.0], [0.0, 0.0], [0.0, 300.0], [400.0, 300.0]]), true),
            (points(&[[270.0, 0.0], [400.0, 0.0], [400.0, 300.0], [0.0, 300.0], [0.0, 0.0], [130.0, 0.0]]), true),
            (points(&[[0.0, 300.0], [0.0, 0.0], [400.0, 0.0]]), true),
            // One side, a line inside, and the sides of the cloth around several parts.
            (points(&[[0.0, 0.0], [200.0, 0.0], [400.0, 0.0]]), false),
            (points(&[[390.0, 100.0], [100.0, 100.0], [100.0, 200.0], [390.0, 200.0]]), false),
            (points(&[[900.0, 0.0], [0.0, 0.0], [0.0, 300.0], [900.0, 300.0]]), false),
        ] {
            let found = may_be_left_of(&Extent::of(&open), &Extent::of(&seam)) && is_left_of(&open, &seam);
            assert_eq!(found, is_left, "{open:?}");
        }
    }

    #[test]
    fn a_round_hole_follows_no_straight_edges() {
        let hole: Vec<(f64, f64)> = (0..40)
            .map(|k| f64::from(k) / 40.0 * std::f64::consts::TAU)
            .map(|a| (75.0 + 30.0 * a.cos(), 75.0 + 30.0 * a.sin()))
            .collect();
        assert!(!follows(&closed(&hole), &rectangle(0.0, 0.0, 150.0, 150.0)));
    }
}
