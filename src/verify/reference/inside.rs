//! Point location: the parts that a point lies in, by even-odd containment in the closed contours of each piece as they are
//! cut.

use std::borrow::Cow;

use rayon::prelude::*;

use super::{notches, parts};
use crate::geom::boxes::Boxes;
use crate::geom::shape::Shape;
use crate::geom::slots::Slots;
use crate::geom::{Extent, Point, cross, polyline};
use crate::ir::Marker;
use crate::ir::list::Segment;
use crate::ir::marker::{Contour, Piece};
use crate::machine::{NotchStyle, Notches};

/// Least mean number of edges per band of a part.
const EDGES_A_BAND: usize = 4;
/// Greatest mean number of bands per edge.
const BANDS_AN_EDGE: f64 = 4.0;

/// Rounding, mm: a shorter crossing of a part is ignored, and a path nearer to an edge runs along it.
const NONE: f64 = 1e-6;

/// The parts, each by its box.
#[derive(Debug)]
pub struct Inside<'a> {
    boxes: Boxes,
    parts: Vec<Part<'a>>,
    /// Index of the part to which each piece belongs.
    part_of: Vec<usize>,
}

/// The edges of a piece's closed contours, in bands along Y.
#[derive(Debug)]
struct Part<'a> {
    piece: usize,
    /// Its contours; each ends with its first point.
    rings: Box<[Cow<'a, [Point]>]>,
    /// Number of points before those of each ring.
    firsts: Box<[u32]>,
    extent: Extent,
    /// Height of a band, mm, and number of bands.
    height: f64,
    bands: usize,
    /// The edges of each band, by the indices of their start points in all rings, one behind the other.
    edges: Slots,
}

impl<'a> Inside<'a> {
    /// The index of a marker with notches in the given style: the cloth of a notch that is cut as a slit, or not at all, stays
    /// with its part. Edges of two parts at most `merge` mm apart are one edge.
    pub fn new(marker: &'a Marker, notches: Notches, merge: f64) -> Self {
        let part = |i: usize| Part::new(i, marker, notches);
        let parts: Vec<Part> = (0..marker.pieces.len()).into_par_iter().filter_map(part).collect();
        let boxes = Boxes::new(parts.iter().map(|part| part.extent).collect());
        let mut inside = Self { boxes, parts, part_of: Vec::new() };
        // A piece that lies in another one is a cut-out of it, even if the file has it as a part. A piece that merely overlaps
        // another one is a part of its own.
        let holders = |point| inside.rings_at(point).map(|piece| piece as u32).collect();
        let of_piece = |piece: u32| &inside.parts[inside.parts.partition_point(|part| part.piece < piece as usize)];
        let lies_in = |own: u32, other: u32| of_piece(own).lies_in(of_piece(other), merge);
        let shape = |piece: &Piece| {
            let closed = piece.contours.iter().filter(|contour| contour.closed);
            Shape::new(&closed.map(|contour| marker.list.points(contour.range)).collect::<Vec<_>>())
        };
        let shapes: Vec<Shape> = marker.pieces.par_iter().map(shape).collect();
        let part_of = parts::regions(&shapes, holders, lies_in);
        inside.part_of = marker.owners().into_iter().map(|owner| part_of[owner] as usize).collect();
        inside
    }

    /// The part to which a piece belongs: itself, or the one of which it is a cut-out.
    pub(in crate::verify) fn part_of(&self, piece: usize) -> usize {
        self.part_of[piece]
    }

    /// Part to which a piece belongs; `None` without such a piece.
    pub(in crate::verify) fn find_part(&self, piece: usize) -> Option<usize> {
        self.part_of.get(piece).copied()
    }

    /// The parts whose cloth lies at a point: inside their outline, not inside a cut-out.
    pub(in crate::verify) fn pieces_at(&self, point: Point) -> Vec<usize> {
        let mut odd: Vec<usize> = Vec::new();
        for part in self.rings_at(point).map(|piece| self.part_of[piece]) {
            match odd.iter().position(|&other| other == part) {
                Some(place) => drop(odd.swap_remove(place)),
                None => odd.push(part),
            }
        }
        odd.sort_unstable();
        odd
    }

    /// True if a point lies in the rings of a piece, be that a part or a cut-out.
    pub fn is_in_ring(&self, point: Point) -> bool {
        self.rings_at(point).next().is_some()
    }

    /// Distance of a point from all lines that bound a part, mm; exact only if less than `reach`.
    pub(in crate::verify) fn distance_to_edges(&self, point: Point, reach: f64) -> f64 {
        let near = self.boxes.near(Extent::between(point, point).grown(reach));
        near.map(|part| self.parts[part].distance(point, reach)).fold(f64::INFINITY, f64::min)
    }

    /// True if a straight segment leads through a part, however narrow, or along an edge of one, whichever side of the edge
    /// rounding puts it on.
    pub(in crate::verify) fn is_crossed(&self, [from, to]: [Point; 2]) -> bool {
        let mut shares: Vec<f64> = vec![0.0, 1.0];
        for part in self.boxes.near(Extent::between(from, to)) {
            self.parts[part].crossings([from, to], &mut shares);
        }
        shares.sort_by(f64::total_cmp);
        let middle = |ends: &[f64]| from + (to - from) * f64::midpoint(ends[0], ends[1]);
        let way = (to - from).norm();
        let stretches = shares.windows(2).filter(|ends| (ends[1] - ends[0]) * way > NONE);
        stretches.map(middle).any(|at| !self.pieces_at(at).is_empty() || self.distance_to_edges(at, NONE) <= NONE)
    }

    /// Pieces whose own rings contain a point.
    fn rings_at(&self, point: Point) -> impl Iterator<Item = usize> + '_ {
        let near = self.boxes.at(point).map(|part| &self.parts[part]);
        near.filter(move |part| part.holds(point)).map(|part| part.piece)
    }
}

/// Points of a closed contour as it bounds its part: the cloth of a notch that is cut as a slit, or not at all, stays with the
/// part.
fn ring<'a>(contour: &Contour, piece: &Piece, marker: &'a Marker, style: Notches) -> Cow<'a, [Point]> {
    let points = marker.list.points(contour.range);
    if style.style == NotchStyle::AsDrawn || piece.outline_notches.is_empty() {
        return points;
    }
    let mut segments: Vec<Segment> = marker.list.walk(contour.range).map(|(_, segment)| segment).collect();
    notches::straighten(&mut segments, piece, style);
    let last = segments.last().map(|segment| segment.to);
    Cow::Owned(segments.iter().map(|segment| segment.from).chain(last).collect())
}

impl<'a> Part<'a> {
    /// Index of a piece; `None` when it bounds nothing.
    fn new(index: usize, marker: &'a Marker, notches: Notches) -> Option<Self> {
        let piece = &marker.pieces[index];
        let closed = piece.contours.iter().filter(|contour| contour.closed);
        let rings: Box<[Cow<[Point]>]> = closed.map(|contour| ring(contour, piece, marker, notches)).collect();
        let mut extent = Extent::EMPTY;
        rings.iter().flat_map(|ring| ring.iter()).for_each(|&point| extent.add(point));
        let count: usize = rings.iter().map(|ring| ring.len() - 1).sum();
        if count == 0 {
            return None;
        }
        let bands = (count / EDGES_A_BAND).max(1);
        let rise = |ring: &Cow<[Point]>| ring.windows(2).map(|ends| (ends[1].y - ends[0].y).abs()).sum::<f64>();
        let least = rings.iter().map(rise).sum::<f64>() / (BANDS_AN_EDGE * count as f64);
        let height = (extent.size().1 / bands as f64).max(least).max(f64::MIN_POSITIVE);
        let before = |sum: &mut u32, ring: &Cow<[Point]>| Some(std::mem::replace(sum, *sum + ring.len() as u32));
        let firsts = rings.iter().scan(0, before).collect();
        let mut part = Self { piece: index, rings, firsts, extent, height, bands, edges: Slots::default() };
        part.edges = Slots::new(bands, |see| part.each(see));
        Some(part)
    }

    /// Calls `see` for each edge with each band that it reaches into.
    fn each(&self, see: &mut dyn FnMut(usize, u32)) {
        for (ring, &first) in self.rings.iter().zip(&self.firsts) {
            let mut before = self.band(ring[0].y);
            for (edge, end) in (first..).zip(&ring[1..]) {
                let band = self.band(end.y);
                (before.min(band)..=before.max(band)).for_each(|band| see(band, edge));
                before = band;
            }
        }
    }

    fn band(&self, y: f64) -> usize {
        (((y - self.extent.min.y) / self.height).max(0.0) as usize).min(self.bands - 1)
    }

    /// The ends of an edge.
    fn ends(&self, edge: u32) -> [Point; 2] {
        let ring = if self.rings.len() == 1 { 0 } else { self.firsts.partition_point(|&first| first <= edge) - 1 };
        let place = (edge - self.firsts[ring]) as usize;
        let [from, to] = self.rings[ring][place..place + 2] else { unreachable!("an edge has two ends") };
        [from, to]
    }

    /// Adds the crossings of a straight segment with its edges, as fractions of the segment.
    fn crossings(&self, [from, to]: [Point; 2], shares: &mut Vec<f64>) {
        let along = to - from;
        let bands = self.band(from.y.min(to.y))..=self.band(from.y.max(to.y));
        for [a, b] in bands.flat_map(|band| self.edges.of(band)).map(|&edge| self.ends(edge)) {
            let edge = b - a;
            let across = cross(along, edge);
            let share = cross(a - from, edge) / across;
            // A parallel edge has no crossing: the segment lies wholly on one side of it.
            if across != 0.0 && (0.0..=1.0).contains(&share) && (0.0..=1.0).contains(&(cross(a - from, along) / across))
            {
                shares.push(share);
            }
        }
    }

    /// True if most of its edges, by length, end in another part or at most `merge` mm from its edges. Each end stands for half
    /// of its edge.
    fn lies_in(&self, other: &Self, merge: f64) -> bool {
        if !other.extent.grown(merge).covers(&self.extent) {
            return false;
        }
        let (mut whole, mut within) = (0.0, 0.0);
        for ring in &self.rings {
            let is_within = |&end: &Point| other.holds(end) || other.distance(end, merge) <= merge;
            let ends: Vec<f64> = ring.iter().map(|end| if is_within(end) { 0.5 } else { 0.0 }).collect();
            for (edge, shares) in ring.windows(2).zip(ends.windows(2)) {
                let length = (edge[1] - edge[0]).norm();
                whole += length;
                within += length * (shares[0] + shares[1]);
            }
        }
        2.0 * within > whole
    }

    /// Distance of a point from its edges in the bands within `reach`, mm.
    fn distance(&self, point: Point, reach: f64) -> f64 {
        let bands = self.band(point.y - reach)..=self.band(point.y + reach);
        let ends = bands.flat_map(|band| self.edges.of(band)).map(|&edge| self.ends(edge));
        ends.map(|[from, to]| polyline::distance_to_segment(point, from, to)).fold(f64::INFINITY, f64::min)
    }

    /// True if a ray to the right of a point crosses the edges an odd number of times.
    fn holds(&self, point: Point) -> bool {
        let is_crossed = |[from, to]: &[Point; 2]| {
            (from.y > point.y) != (to.y > point.y)
                && from.x + (to.x - from.x) * (point.y - from.y) / (to.y - from.y) > point.x
        };
        let edges = self.edges.of(self.band(point.y)).iter();
        let crossed = match &*self.rings {
            // Nearly all parts have one ring.
            [ring] => edges.map(|&edge| [ring[edge as usize], ring[edge as usize + 1]]).filter(is_crossed).count(),
            _ => edges.map(|&edge| self.ends(edge)).filter(is_crossed).count(),
        };
        crossed % 2 == 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::testing;

    /// Part of each of some pieces, given as the corners of their outlines.
    fn parts(outlines: &[Vec<[f64; 2]>]) -> Vec<usize> {
        let marker = testing::marker(outlines.iter().map(Vec::as_slice));
        Inside::new(&marker, Notches::default(), 0.2).part_of
    }

    fn square(low: f64, high: f64) -> Vec<[f64; 2]> {
        vec![[low, low], [high, low], [high, high], [low, high]]
    }

    #[test]
    fn a_piece_in_another_one_is_a_cut_out_of_it_however_it_is_rounded() {
        assert_eq!(parts(&[square(0.0, 100.0), square(20.0, 80.0)]), [0, 0]);
        assert_eq!(parts(&[square(0.0, 100.0), square(-0.1, 80.0)]), [0, 0]);
    }

    #[test]
    fn a_piece_that_merely_overlaps_a_part_is_no_cut_out_of_it_however_its_edges_are_drawn() {
        assert_eq!(parts(&[square(0.0, 100.0), square(20.0, 120.0)]), [0, 1]);
        // A beam like an I, and a square over its web, on which one of its edges has many vertices.
        let half = vec![[0.0, 0.0], [100.0, 0.0], [100.0, 10.0], [55.0, 10.0], [55.0, 90.0], [100.0, 90.0]];
        let beam = [half.clone(), half.iter().map(|[x, y]| [100.0 - x, 100.0 - y]).collect()].concat();
        assert_eq!(parts(&[beam.clone(), square(20.0, 80.0)]), [0, 1]);
        let mut dense = square(20.0, 80.0);
        dense.splice(1..1, (46..55).map(|x| [f64::from(x), 20.0]));
        assert_eq!(parts(&[beam, dense]), [0, 1]);
    }
}
