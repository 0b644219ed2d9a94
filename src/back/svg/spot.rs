//! Spot of a piece's number: inside the piece, away from everything that is cut.

use crate::geom::{Extent, Point, Vector, cross, polyline};

/// A place for text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spot {
    /// Its middle, mm.
    pub(super) at: Point,
    /// Distance to the nearest line or hole, mm; 0 when the piece has no interior.
    pub(super) clear: f64,
}

/// Number of levels at which the interior is searched: enough to meet the body of a slender, bent piece.
const LEVELS: u32 = 24;
/// Maximum number of stretches that are measured, the widest first. It bounds the work on pieces with many teeth.
const CANDIDATES: usize = 24;
/// Measured positions on a stretch, as fractions of its width from its middle: labels often fill the middle. The middle is
/// last, so that it wins a tie.
const SHARES: [f64; 3] = [-0.25, 0.25, 0.0];
/// Factor by which another place must have more room than the centroid to be preferred: people look at the centroid first.
const CENTROID_BONUS: f64 = 1.6;

/// The spot of a piece that is bounded by `rings` (closed, with the first point repeated; a ring inside a ring is a hole) and
/// has drill holes at `holes`. `None` when no ring encloses anything.
pub(super) fn find(rings: &[&[Point]], holes: &[Point]) -> Option<Spot> {
    let clear = |at: Point| {
        let lines =
            rings.iter().flat_map(|ring| ring.windows(2)).map(|w| polyline::distance_to_segment(at, w[0], w[1]));
        lines.chain(holes.iter().map(|hole| (hole - at).norm())).fold(f64::INFINITY, f64::min)
    };
    let spot = |at: Point| Spot { at, clear: clear(at) };
    let places =
        stretches(rings).into_iter().flat_map(|(at, width)| SHARES.map(|share| at + Vector::new(share * width, 0.0)));
    let best = places.map(spot).max_by(|a, b| a.clear.total_cmp(&b.clear))?;
    let central = centroid(rings).filter(|&at| is_inside(rings, at)).map(spot);
    Some(central.filter(|c| c.clear * CENTROID_BONUS >= best.clear).unwrap_or(best))
}

/// Middles and widths of the horizontal stretches inside, the widest [`CANDIDATES`].
fn stretches(rings: &[&[Point]]) -> Vec<(Point, f64)> {
    let mut extent = Extent::EMPTY;
    rings.iter().flat_map(|ring| ring.iter()).for_each(|&point| extent.add(point));
    let (_, height) = extent.size();
    let mut found = Vec::new();
    for level in 0..LEVELS {
        let y = extent.min.y + height * (f64::from(level) + 0.5) / f64::from(LEVELS);
        let mut crossings: Vec<f64> =
            rings.iter().flat_map(|ring| ring.windows(2)).filter_map(|w| at_level(w, y)).collect();
        crossings.sort_by(f64::total_cmp);
        for pair in crossings.chunks_exact(2) {
            let width = pair[1] - pair[0];
            if width > 0.0 {
                found.push((Point::new(f64::midpoint(pair[0], pair[1]), y), width));
            }
        }
    }
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    found.truncate(CANDIDATES);
    found
}

/// Position where a chord crosses a level; the lower end of the chord is included, the upper is not.
fn at_level(ends: &[Point], y: f64) -> Option<f64> {
    let (a, b) = (ends[0], ends[1]);
    ((a.y <= y) != (b.y <= y)).then(|| a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y))
}

fn is_inside(rings: &[&[Point]], at: Point) -> bool {
    let crossings = rings.iter().flat_map(|ring| ring.windows(2)).filter_map(|w| at_level(w, at.y));
    crossings.filter(|&x| x > at.x).count() % 2 == 1
}

/// The centroid of the ring with the largest area.
fn centroid(rings: &[&[Point]]) -> Option<Point> {
    let mut largest = (0.0, None);
    for ring in rings {
        let origin = ring[0];
        let (mut area, mut moment) = (0.0, Point::origin() - Point::origin());
        for w in ring.windows(2) {
            let (a, b) = (w[0] - origin, w[1] - origin);
            let twice = cross(a, b);
            area += twice / 2.0;
            moment += (a + b) * (twice / 6.0);
        }
        if area.abs() > largest.0 {
            largest = (area.abs(), Some(origin + moment / area));
        }
    }
    largest.1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(points: &[(f64, f64)]) -> Vec<Point> {
        points.iter().chain(points.first()).map(|&(x, y)| Point::new(x, y)).collect()
    }

    #[test]
    fn the_number_of_a_square_stands_in_its_middle() {
        let square = ring(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]);
        let spot = find(&[&square], &[]).expect("an inside");
        assert!((spot.at - Point::new(5.0, 5.0)).norm() < 1e-9 && (spot.clear - 5.0).abs() < 1e-9);
    }

    #[test]
    fn the_number_of_a_concave_piece_stands_inside_it_and_off_its_cut_outs_and_holes() {
        let bracket = ring(&[
            (0.0, 0.0),
            (100.0, 0.0),
            (100.0, 20.0),
            (20.0, 20.0),
            (20.0, 100.0),
            (100.0, 100.0),
            (100.0, 120.0),
            (0.0, 120.0),
        ]);
        let cut_out = ring(&[(5.0, 40.0), (15.0, 40.0), (15.0, 60.0), (5.0, 60.0)]);
        let hole = Point::new(60.0, 10.0);
        let rings: [&[Point]; 2] = [&bracket, &cut_out];
        let spot = find(&rings, &[hole]).expect("an inside");
        assert!(is_inside(&rings, spot.at), "{spot:?}");
        assert!(spot.clear > 6.0 && (spot.at - hole).norm() > 6.0, "{spot:?}");
    }

    #[test]
    fn the_number_of_a_strip_stands_beside_what_fills_its_middle() {
        let strip = ring(&[(0.0, 0.0), (100.0, 0.0), (100.0, 10.0), (0.0, 10.0)]);
        let label: Vec<Point> = (40..=60).map(|x| Point::new(f64::from(x), 5.0)).collect();
        let spot = find(&[&strip], &label).expect("an inside");
        assert!(spot.clear > 4.0 && (spot.at.x - 25.0).abs().min((spot.at.x - 75.0).abs()) < 1e-9, "{spot:?}");
    }

    #[test]
    fn what_encloses_nothing_has_no_spot() {
        let there_and_back = ring(&[(0.0, 0.0), (10.0, 0.0)]);
        assert_eq!(find(&[&there_and_back], &[]), None);
        assert_eq!(find(&[], &[]), None);
    }
}
