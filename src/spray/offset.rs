//! Path of a head at a distance from the edges: the common offset of all rings, as exact arcs and lines.
//!
//! The offset is computed by `cavalier_contours`; the manual has a comparison. The library also resolves collisions of the path
//! with itself and with paths around other parts: it drops whatever comes nearer to an edge than the distance.

use cavalier_contours::polyline::{PlineSource, PlineSourceMut, Polyline, seg_arc_radius_and_center};
use cavalier_contours::shape_algorithms::{Shape, ShapeOffsetOptions};

use super::edge::Ring;
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, Vector, polyline};

/// Search radius of the chord or vertex of an element, mm. The library joins pieces at 1e-4.
const FOUND_EPSILON: f64 = 1e-2;
/// Length below which pieces of the path are rounding, mm.
const LENGTH_EPSILON: f64 = 1e-6;

/// Size below which a closed path is dropped, as a fraction of the distance. The head would turn on the spot there.
const SMALL_SHARE: f64 = 0.01;

/// Origin of an element of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Beside {
    /// A straight line, parallel to a chord.
    Chord {
        /// Index of the ring.
        ring: usize,
        /// Index of the chord.
        chord: usize,
    },
    /// An arc around a vertex.
    Vertex {
        /// Index of the ring.
        ring: usize,
        /// Index of the vertex.
        vertex: usize,
    },
}

/// A straight line or an arc of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Element {
    /// Start and end point, mm.
    pub(super) ends: [Point; 2],
    /// Origin of the element.
    pub(super) beside: Beside,
}

/// The closed paths at a distance from all rings, each with the part on its left.
pub(super) fn loops(rings: &[Ring], distance: f64) -> Vec<Vec<Element>> {
    let lines = rings.iter().map(|ring| {
        let mut line = Polyline::new_closed();
        for point in &ring.points {
            line.add(point.x, point.y, 0.0);
        }
        line
    });
    let offset = Shape::from_plines(lines).parallel_offset(-distance, &ShapeOffsetOptions::new());
    let places = Places::new(rings);
    let ways = offset.ccw_plines.iter().chain(&offset.cw_plines);
    let ways = ways.map(|way| elements(&way.polyline, rings, &places, distance));
    ways.filter(|way| !is_small(way, distance)).collect()
}

/// True if a closed path is hardly more than a point, such as that of a hole as wide as twice the distance.
fn is_small(way: &[Element], distance: f64) -> bool {
    let places: Vec<Point> = way.iter().flat_map(|element| element.ends).collect();
    let Extent { min, max } = Extent::of(&places);
    way.is_empty() || (max - min).norm() < SMALL_SHARE * distance
}

/// The elements of one path.
fn elements(way: &Polyline<f64>, rings: &[Ring], places: &Places, distance: f64) -> Vec<Element> {
    let mut elements = Vec::new();
    for (from, to) in way.iter_segments() {
        let ends = [Point::new(from.x, from.y), Point::new(to.x, to.y)];
        if (ends[1] - ends[0]).norm() < LENGTH_EPSILON {
            continue;
        }
        let beside = if from.bulge == 0.0 {
            places.chord(rings, ends, distance)
        } else {
            let (_, centre) = seg_arc_radius_and_center(from, to);
            places.vertex(rings, Point::new(centre.x, centre.y))
        };
        elements.extend(beside.map(|beside| Element { ends, beside }));
    }
    elements
}

/// Index of chords and vertices by position.
struct Places {
    boxes: Boxes,
    chords: Vec<(usize, usize)>,
}

impl Places {
    fn new(rings: &[Ring]) -> Self {
        let chords: Vec<(usize, usize)> = rings
            .iter()
            .enumerate()
            .flat_map(|(i, ring)| (0..ring.points.len()).map(move |chord| (i, chord)))
            .collect();
        let extent = |&(ring, chord): &(usize, usize)| {
            let [from, to] = rings[ring].chord(chord);
            Extent::between(from, to)
        };
        Self { boxes: Boxes::new(chords.iter().map(extent).collect()), chords }
    }

    /// The chord beside which a line runs. It contains the middle of the line, moved back by the distance.
    fn chord(&self, rings: &[Ring], ends: [Point; 2], distance: f64) -> Option<Beside> {
        let along = (ends[1] - ends[0]).normalize();
        let foot = ends[0] + (ends[1] - ends[0]) * 0.5 + Vector::new(-along.y, along.x) * distance;
        let off = |&(ring, chord): &(usize, usize)| {
            let [from, to] = rings[ring].chord(chord);
            // Of chords that meet at the foot, the one parallel to the line is right.
            polyline::distance_to_segment(foot, from, to) + (rings[ring].along(chord) - along).norm()
        };
        let near = self.boxes.near(Extent::between(foot, foot).grown(FOUND_EPSILON)).map(|i| self.chords[i]);
        let (ring, chord) = near.min_by(|a, b| off(a).total_cmp(&off(b)))?;
        Some(Beside::Chord { ring, chord })
    }

    /// The vertex around which an arc runs.
    fn vertex(&self, rings: &[Ring], centre: Point) -> Option<Beside> {
        let near = self.boxes.near(Extent::between(centre, centre).grown(FOUND_EPSILON)).map(|i| self.chords[i]);
        let off = |&(ring, vertex): &(usize, usize)| (rings[ring].points[vertex] - centre).norm();
        let (ring, vertex) = near.min_by(|a, b| off(a).total_cmp(&off(b)))?;
        Some(Beside::Vertex { ring, vertex })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Span;

    fn ring(points: &[[f64; 2]]) -> Ring {
        let points: Vec<Point> = points.iter().map(|&[x, y]| Point::new(x, y)).collect();
        let spans = vec![Span::default(); points.len()];
        Ring::new(points, spans, 0.2)
    }

    fn length(way: &[Element]) -> f64 {
        way.iter().map(|element| (element.ends[1] - element.ends[0]).norm()).sum()
    }

    #[test]
    fn corners_become_arcs_and_sides_stay_lines() {
        let square = ring(&[[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0]]);
        let ways = loops(&[square], 50.0);
        assert_eq!((ways.len(), ways[0].len()), (1, 8));
        let chord = 50.0 * std::f64::consts::SQRT_2;
        assert!((length(&ways[0]) - 4.0 * (100.0 + chord)).abs() < 1e-6);
        assert!(ways[0].contains(&Element {
            ends: [Point::new(0.0, -50.0), Point::new(100.0, -50.0)],
            beside: Beside::Chord { ring: 0, chord: 0 }
        }));
    }

    #[test]
    fn a_slot_that_is_too_narrow_is_left_out_and_a_wide_one_is_followed() {
        let slotted = |width: f64| {
            let (left, right) = (500.0 - width / 2.0, 500.0 + width / 2.0);
            let top = [[right, 400.0], [right, 100.0], [left, 100.0], [left, 400.0]];
            let points = [&[[0.0, 0.0], [1000.0, 0.0], [1000.0, 400.0]][..], &top, &[[0.0, 400.0]]].concat();
            loops(&[ring(&points)], 100.0)
        };
        let floor = |ways: &[Vec<Element>]| ways[0].iter().any(|e| e.beside == Beside::Chord { ring: 0, chord: 4 });
        assert!(!floor(&slotted(150.0)) && floor(&slotted(350.0)));
    }

    #[test]
    fn holes_are_followed_inside_and_small_ones_not_at_all() {
        let outer = ring(&[[0.0, 0.0], [1000.0, 0.0], [1000.0, 1000.0], [0.0, 1000.0]]);
        let hole = |half: f64| {
            let (least, most) = (500.0 - half, 500.0 + half);
            ring(&[[least, least], [least, most], [most, most], [most, least]])
        };
        assert_eq!(loops(&[outer.clone(), hole(300.0)], 100.0).len(), 2);
        assert_eq!(loops(&[outer, hole(80.0)], 100.0).len(), 1);
    }
}
