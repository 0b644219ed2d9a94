//! V notches that are drawn as marks on an outline: the outline goes into them, as cut files have it.

use super::drawing::Vertex;
use super::shape::{ROUNDING, is_near};
use crate::geom::moments::Moments;
use crate::geom::{Extent, Point, polyline, ring};

/// How much longer than the mouth is wide the outline may be between its ends: a longer way is no edge that is notched.
const LONGEST_EDGE: f64 = 1.1;

/// How much longer than the other a leg may be.
const LEG_RATIO: f64 = 1.25;

/// A mark of two legs.
struct Vee {
    apex: Point,
    mouth: [Point; 2],
}

impl Vee {
    /// Whether it has the shape of a V notch: 2 to 15 mm deep, no wider than that, the legs equal within a quarter.
    fn has_shape(&self) -> bool {
        let depth = (self.apex - (self.mouth[0] + (self.mouth[1] - self.mouth[0]) / 2.0)).norm();
        let legs = self.mouth.map(|end| (self.apex - end).norm());
        (2.0..=15.0).contains(&depth)
            && self.width() <= depth
            && self.width() > 0.0
            && legs[0].max(legs[1]) <= LEG_RATIO * legs[0].min(legs[1])
    }

    /// Width of the mouth, mm.
    fn width(&self) -> f64 {
        (self.mouth[1] - self.mouth[0]).norm()
    }
}

/// Where the material is that a notch goes into.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Material {
    /// Within the outline of a part.
    Inside,
    /// Around a cut-out.
    Outside,
}

/// An outline that marks may be put into.
#[derive(Debug)]
pub(super) struct Outline {
    /// Its places; the span of each is what leads there. The first is not repeated.
    ring: Vec<Vertex>,
    material: Material,
    /// Length of a unit, mm.
    unit: f64,
}

/// A place of an outline: so far, from 0 to 1, along the segment that starts at a vertex; less than 1.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Station {
    segment: usize,
    along: f64,
}

/// What is drawn and no longer cut where an outline goes into a mark.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mouth {
    /// Of the outline between the ends of the mark; and what rounding makes of the edges and legs that meet there.
    pub(super) moments: Moments,
    pub(super) bounds: Extent,
}

/// An end of a mark on an outline.
type Foot = (Station, Point);

impl Outline {
    /// A closed line whose last place is its first.
    pub(super) fn new(vertices: &[Vertex], material: Material, unit: f64) -> Self {
        let mut ring = vertices.to_vec();
        if let Some(last) = ring.pop() {
            // What leads to the first place stood at the last.
            ring[0].span = last.span;
        }
        Self { ring, material, unit }
    }

    /// The places again, the first one repeated.
    pub(super) fn into_vertices(mut self) -> Vec<Vertex> {
        self.ring.push(self.ring[0]);
        self.ring
    }

    /// How many places it has.
    pub(super) fn len(&self) -> usize {
        self.ring.len()
    }

    /// Leads the outline along a mark of two legs in place of its mouth, when that is a V notch: of the shape of one, into
    /// the material, on a stretch of the outline that is straight; the mouth, if it did.
    pub(super) fn notch(&mut self, mark: [Vertex; 3]) -> Option<Mouth> {
        let [first, apex, last] = mark;
        let vee = Vee { apex: apex.at, mouth: [first.at, last.at] };
        let (a, b) = (self.station(first.at)?, self.station(last.at)?);
        if !vee.has_shape() {
            return None;
        }
        let most = LONGEST_EDGE * vee.width() + 2.0 * ROUNDING * self.unit;
        // Along the outline, whichever way the mark was drawn; turned round, each leg keeps what drew it.
        let (from, to, legs) = if self.way(a, b, most) {
            ((a, first.at), (b, last.at), [apex.span, last.span])
        } else if self.way(b, a, most) {
            ((b, last.at), (a, first.at), [last.span, apex.span])
        } else {
            return None;
        };
        let points: Vec<Point> = self.ring.iter().map(|vertex| vertex.at).collect();
        if ring::contains(&points, apex.at) != (self.material == Material::Inside) {
            return None;
        }
        let closed = self.mouth([from, to], apex.at);
        let count = self.ring.len();
        // The vertices that stay: from the one behind the mouth round to the one before it.
        let (start, end) = (to.0.segment + 1, from.0.segment);
        let kept = if from.0.segment == to.0.segment { count } else { (end + count - start) % count + 1 };
        let mut ring: Vec<Vertex> = Vec::with_capacity(kept + 3);
        let mouth = [self.placed(from), self.placed(to)];
        ring.push(Vertex { at: mouth[1], span: legs[1] });
        ring.extend((start..start + kept).map(|i| self.ring[i % count]));
        let lead = self.ring[(end + 1) % count].span;
        // A mouth at a vertex is that vertex.
        if ring.last().is_some_and(|last| last.at != mouth[0]) {
            ring.push(Vertex { at: mouth[0], span: lead });
        }
        ring.push(Vertex { at: apex.at, span: legs[0] });
        // The line starts where it did, while that place is there.
        let first = self.ring[0];
        if let Some(at) = ring.iter().position(|vertex| *vertex == first) {
            ring.rotate_left(at);
        }
        self.ring = ring;
        Some(closed)
    }

    /// What is drawn between two ends of a mark, measured on the outline as it is.
    fn mouth(&self, [from, to]: [Foot; 2], apex: Point) -> Mouth {
        let ends = [self.placed(from), self.placed(to)];
        let is_one_edge = from.0.segment == to.0.segment && from.0.along < to.0.along;
        let count = self.ring.len();
        let between = match (to.0.segment + count - from.0.segment) % count {
            0 if !is_one_edge => count,
            steps => steps,
        };
        let inner = (1..=between).map(|i| self.vertex(from.0.segment + i));
        let path: Vec<Point> = std::iter::once(ends[0]).chain(inner).chain([ends[1]]).collect();
        let mut mouth = Mouth { moments: Moments::of(path.iter().copied()), bounds: Extent::EMPTY };
        path.iter().chain([&from.1, &to.1]).for_each(|&at| mouth.bounds.add(at));
        // The end of a mark that lies beside its edge bends it; one beside a vertex goes there.
        let mut bend = |segment: usize, places: &[Point]| {
            let edge = [self.vertex(segment), self.vertex(segment + 1)];
            let bent = edge[..1].iter().chain(places).chain(&edge[1..]);
            mouth.moments += Moments::line(edge[0], edge[1]) - Moments::of(bent.copied());
        };
        if is_one_edge {
            bend(from.0.segment, &ends);
        } else {
            bend(from.0.segment, &ends[..1]);
            bend(to.0.segment, &ends[1..]);
        }
        for (end, drawn) in ends.into_iter().zip([from.1, to.1]) {
            mouth.moments += Moments::line(drawn, apex) - Moments::line(end, apex);
        }
        mouth
    }

    fn vertex(&self, i: usize) -> Point {
        self.ring[i % self.ring.len()].at
    }

    /// Where a place lies on the outline; `None` when it lies off it by more than rounding.
    fn station(&self, at: Point) -> Option<Station> {
        let distance = |i: usize| polyline::distance_to_segment(at, self.vertex(i), self.vertex(i + 1));
        let all = (0..self.ring.len()).map(|i| (i, distance(i)));
        let (segment, off) = all.min_by(|a, b| a.1.total_cmp(&b.1))?;
        if off > ROUNDING * self.unit {
            return None;
        }
        if is_near(at, self.vertex(segment + 1), self.unit) {
            return Some(Station { segment: (segment + 1) % self.ring.len(), along: 0.0 });
        }
        let is_start = is_near(at, self.vertex(segment), self.unit);
        let along = if is_start { 0.0 } else { polyline::foot(at, self.vertex(segment), self.vertex(segment + 1)) };
        Some(Station { segment, along })
    }

    /// The place of a station: a vertex, or the end of the mark.
    fn placed(&self, (station, at): Foot) -> Point {
        if station.along == 0.0 { self.vertex(station.segment) } else { at }
    }

    /// Whether the way from one place along the outline to another is no longer than that, mm.
    fn way(&self, from: Station, to: Station, most: f64) -> bool {
        let place = |Station { segment, along }: Station| {
            let (a, b) = (self.vertex(segment), self.vertex(segment + 1));
            a + (b - a) * along
        };
        if from.segment == to.segment && from.along < to.along {
            return (place(to) - place(from)).norm() <= most;
        }
        let (mut at, mut length) = (place(from), 0.0);
        for step in 1..=self.ring.len() {
            let next = self.vertex(from.segment + step);
            length += (next - at).norm();
            at = next;
            if (from.segment + step) % self.ring.len() == to.segment {
                return length + (place(to) - at).norm() <= most;
            }
            if length > most {
                return false;
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Span;

    const UNIT: f64 = 0.025;
    const SQUARE: [(f64, f64); 5] = [(0., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.)];

    fn vertices(points: &[(f64, f64)], block: u32) -> Vec<Vertex> {
        let span = |i: usize| Span { start: i as u32, end: i as u32, block };
        points.iter().enumerate().map(|(i, &(x, y))| Vertex { at: Point::new(x, y), span: span(i) }).collect()
    }

    /// The places behind a mark; the spans of the two legs in its order are those of the mark.
    fn check(ring: &[(f64, f64)], material: Material, mark: [(f64, f64); 3], expected: &[(f64, f64)]) {
        let mut outline = Outline::new(&vertices(ring, 1), material, UNIT);
        let drawn = vertices(&mark, 2);
        let mouth = outline.notch([drawn[0], drawn[1], drawn[2]]);
        let is_notch = mouth.is_some();
        let found = outline.into_vertices();
        assert_eq!(found.iter().map(|v| (v.at.x, v.at.y)).collect::<Vec<_>>(), expected, "{mark:?}");
        assert_eq!(is_notch, expected != ring);
        // What is left aside is what was drawn and is not cut.
        let length =
            |points: &[(f64, f64)]| polyline::length(&vertices(points, 1).iter().map(|v| v.at).collect::<Vec<_>>());
        let aside = mouth.map_or(length(&mark), |mouth| mouth.moments.length());
        assert!((length(ring) + length(&mark) - length(expected) - aside).abs() < 1e-9, "{mark:?}");
        for pair in found.windows(2).filter(|pair| pair.iter().any(|v| v.at == drawn[1].at)) {
            let leg = if pair.iter().any(|v| v.at == drawn[0].at) { drawn[1].span } else { drawn[2].span };
            assert_eq!(pair[1].span, leg, "{mark:?}");
        }
        let others = found.windows(2).filter(|pair| pair.iter().all(|v| v.at != drawn[1].at));
        assert!(others.clone().all(|pair| pair[1].span.block == 1 || pair[0].at == pair[1].at), "{found:?}");
    }

    #[test]
    fn the_outline_goes_into_the_mark_whichever_way_either_is_drawn() {
        let notched = [(0., 0.), (20., 0.), (22., 5.), (24., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.)];
        check(&SQUARE, Material::Inside, [(20., 0.), (22., 5.), (24., 0.)], &notched);
        check(&SQUARE, Material::Inside, [(24., 0.), (22., 5.), (20., 0.)], &notched);
        let mut clockwise = SQUARE;
        clockwise.reverse();
        let mut expected = notched;
        expected.reverse();
        check(&clockwise, Material::Inside, [(20., 0.), (22., 5.), (24., 0.)], &expected);
    }

    #[test]
    fn the_vertices_of_the_mouth_are_no_longer_cut() {
        let ring = [(0., 0.), (22., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.)];
        let notched = [(0., 0.), (20., 0.), (22., 5.), (24., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.)];
        check(&ring, Material::Inside, [(20., 0.), (22., 5.), (24., 0.)], &notched);
        let ring = [(0., 0.), (20., 0.), (24., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.)];
        check(&ring, Material::Inside, [(24., 0.), (22., 5.), (20., 0.)], &notched);
        // Where the line starts in the mouth, or at an end of it.
        let ring = [(22., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.), (22., 0.)];
        let notched = [(24., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.), (20., 0.), (22., 5.), (24., 0.)];
        check(&ring, Material::Inside, [(20., 0.), (22., 5.), (24., 0.)], &notched);
        let ring = [(24., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.), (24., 0.)];
        check(&ring, Material::Inside, [(20., 0.), (22., 5.), (24., 0.)], &notched);
        let ring = [(20., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.), (20., 0.)];
        let notched = [(20., 0.), (22., 5.), (24., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.), (20., 0.)];
        check(&ring, Material::Inside, [(20., 0.), (22., 5.), (24., 0.)], &notched);
    }

    #[test]
    fn what_is_no_v_notch_stays_beside_the_outline() {
        // Out of the part, too wide, too deep, askew, off the edge, across a corner.
        for mark in [
            [(20., 0.), (22., -5.), (24., 0.)],
            [(20., 0.), (26., 5.), (32., 0.)],
            [(20., 0.), (22., 16.), (24., 0.)],
            [(20., 0.), (27., 5.), (24., 0.)],
            [(20., 0.1), (22., 5.), (24., 0.1)],
            [(3., 0.), (4., 4.), (0., 3.)],
        ] {
            check(&SQUARE, Material::Inside, mark, &SQUARE);
        }
        check(&SQUARE, Material::Outside, [(20., 0.), (22., 5.), (24., 0.)], &SQUARE);
        let notched = [(0., 0.), (20., 0.), (22., -5.), (24., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.)];
        check(&SQUARE, Material::Outside, [(20., 0.), (22., -5.), (24., 0.)], &notched);
    }
}
