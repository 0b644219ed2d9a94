//! Contents of a part, which must be cut and drilled before the part comes free: a loose part shifts.
//!
//! Judged by the drawing alone. A contour lies in the smallest closed contour of its own piece that holds all of its places, or
//! else in the smallest one of another piece. A slit or a hole lies in the smallest one of its own piece. Edges of two pieces
//! within the band are one edge: a place so near to an edge of another piece lies in that piece, and if each of two contours
//! lies in the other that way, the cut-out holds the part that fills it. If the operator is asked for something in between, the
//! order of the file stands.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::ops::Range;

use rayon::prelude::*;

use super::lines::Reference;
use crate::geom::boxes::Boxes;
use crate::geom::region::Regions;
use crate::geom::{Extent, Point, polyline, ring};
use crate::ir::Marker;
use crate::ir::marker::Contour;

/// Something inside a closed contour, both by the ranks of their cuts.
#[derive(Debug, Clone)]
pub(in crate::verify) struct Held {
    /// Ranks of the content.
    pub(in crate::verify) inner: Range<u32>,
    /// Ranks of the outline; the content comes free with the last of them.
    pub(in crate::verify) outline: Range<u32>,
}

/// The contours of a marker.
struct Contours<'a> {
    marker: &'a Marker,
    /// Each contour with the index of its piece.
    all: Vec<(usize, &'a Contour)>,
    /// Boxes of the contours.
    extents: Boxes,
    /// Areas of the contours, mm2.
    areas: Vec<f64>,
    /// Interiors of the closed contours in which something may lie.
    regions: Regions<'a>,
    /// Distance within which edges of two pieces are one edge, mm.
    band: f64,
    /// For each piece, the number of pieces up to and including it that ask the operator for something.
    asked: Vec<usize>,
}

/// Contents of the closed contours of a marker.
pub(in crate::verify) fn held(marker: &Marker, reference: &Reference) -> Vec<Held> {
    let mut contours = Contours::new(marker, reference.band);
    let ranks: Vec<&Range<u32>> = reference.of_pieces.iter().flat_map(|piece| &piece.contours).collect();
    let of_slits = |piece: usize| {
        let slits = &reference.lines[reference.of_pieces[piece].slits.clone()];
        slits.iter().map(move |slit| (slit.rank, slit.point(1), piece))
    };
    let slits = (0..marker.pieces.len()).flat_map(of_slits);
    let drills =
        marker.pieces.iter().enumerate().flat_map(|(i, piece)| piece.drills.iter().map(move |drill| (drill, i)));
    let holes = drills.zip(&reference.holes).map(|((drill, piece), &rank)| (rank as u32, drill.at, piece));
    let marks: Vec<(u32, Point, usize)> = slits.chain(holes).collect();
    contours.look_into(marks.iter().map(|(_, _, piece)| reference.owners[*piece]));
    let of_mark = |&(rank, at, piece): &(u32, Point, usize)| {
        let outline = contours.smallest_at(at, |other| contours.all[other].0 == reference.owners[piece])?;
        Some(Held { inner: rank..rank + 1, outline: ranks[outline].clone() })
    };
    let of_contour = |contour: usize| {
        let outline = contours.around(contour)?;
        Some(Held { inner: ranks[contour].clone(), outline: ranks[outline].clone() })
    };
    let mut held: Vec<Held> = marks.par_iter().filter_map(of_mark).collect();
    held.par_extend((0..ranks.len()).into_par_iter().filter_map(of_contour));
    // A content or an outline that is cut with other parts alone comes free with these.
    held.retain(|held| !held.inner.is_empty() && !held.outline.is_empty());
    held
}

impl<'a> Contours<'a> {
    fn new(marker: &'a Marker, band: f64) -> Self {
        let all: Vec<(usize, &Contour)> = marker.contours().collect();
        let measured = all.par_iter().map(|(_, contour)| {
            let points = marker.list.points(contour.range);
            (Extent::of(&points), ring::area(&points).abs())
        });
        let (extents, areas): (Vec<Extent>, Vec<f64>) = measured.unzip();
        let asked = marker.pieces.iter().scan(0, |asked, piece| {
            *asked += usize::from(!piece.events.is_empty());
            Some(*asked)
        });
        let (extents, regions) = (Boxes::new(extents), Regions::default());
        Self { marker, extents, areas, regions, band, asked: asked.collect(), all }
    }

    /// Indexes the interiors of the closed contours that may hold another one, and of those of some pieces.
    fn look_into(&mut self, pieces: impl Iterator<Item = usize>) {
        let mut may_hold = vec![false; self.all.len()];
        for holder in (0..self.all.len()).flat_map(|contour| self.holders(contour)) {
            may_hold[holder] = true;
        }
        let pieces: BTreeSet<usize> = pieces.collect();
        let is_meant = |&i: &u32| {
            let (piece, contour) = self.all[i as usize];
            contour.closed && (may_hold[i as usize] || pieces.contains(&piece))
        };
        let points = |i: u32| vec![self.marker.list.points(self.all[i as usize].1.range)];
        self.regions = Regions::new((0..self.all.len() as u32).filter(is_meant), points);
    }

    /// Closed contours that may hold another, by area and box.
    fn holders(&self, contour: usize) -> impl Iterator<Item = usize> + '_ {
        let extent = self.extents.all()[contour];
        let near = self.extents.at(extent.min + (extent.max - extent.min) / 2.0);
        near.filter(move |&other| self.all[other].1.closed && self.may_hold(other, contour))
    }

    /// Smallest of the accepted closed contours in which a place lies.
    fn smallest_at(&self, place: Point, is_meant: impl Fn(usize) -> bool) -> Option<usize> {
        let around = self.regions.owners_at(place).into_iter().map(|owner| owner as usize).filter(|&i| is_meant(i));
        around.min_by(|&a, &b| self.areas[a].total_cmp(&self.areas[b]).then(a.cmp(&b)))
    }

    /// Smallest closed contour that holds all places of another; contours of its own piece come before those of others, since
    /// where outlines overlap a line belongs to the part that it was drawn for.
    fn around(&self, contour: usize) -> Option<usize> {
        let (piece, inner) = self.all[contour];
        let points = self.marker.list.points(inner.range);
        let mut around: Vec<Around> = self.holders(contour).map(|other| Around::new(self, other)).collect();
        for &point in points.iter() {
            if around.is_empty() {
                return None; // as of nearly all, at once
            }
            let here = self.regions.owners_at(point);
            let is_near = |other: &Around| self.all[other.contour].0 != piece && other.is_at_edge(point, self.band);
            around.retain(|other| here.binary_search(&(other.contour as u32)).is_ok() || is_near(other));
        }
        let is_other = |contour: usize| self.all[contour].0 != piece;
        let around = around.into_iter().map(|around| around.contour);
        let smallest = around.min_by(|&a, &b| {
            is_other(a).cmp(&is_other(b)).then(self.areas[a].total_cmp(&self.areas[b])).then(a.cmp(&b))
        })?;
        // If the operator is asked for something in between, the order of the file stands.
        (self.asked[self.all[smallest].0] >= self.asked[piece]).then_some(smallest)
    }

    /// True if area and box of a closed contour allow that it holds another.
    fn may_hold(&self, outer: usize, inner: usize) -> bool {
        let [around, own] = [outer, inner].map(|contour| self.extents.all()[contour]);
        let same_piece = self.all[outer].0 == self.all[inner].0;
        let band = if same_piece { 0.0 } else { self.band };
        if outer == inner || !around.grown(band).covers(&own) {
            return false;
        }
        if !same_piece && own.grown(band).covers(&around) {
            match [outer, inner].map(|contour| self.is_cut_out(contour)) {
                [true, false] => return true,
                [false, true] => return false,
                [true, true] | [false, false] => {}
            }
        }
        let area = if self.all[inner].1.closed { self.areas[inner] } else { 0.0 };
        self.areas[outer] > area
    }

    /// True if a contour lies, by its box, in a larger closed one of its own piece.
    fn is_cut_out(&self, contour: usize) -> bool {
        let own = self.extents.all()[contour];
        let first = self.all.partition_point(|other| other.0 < self.all[contour].0);
        let group = (first..self.all.len()).take_while(|&other| self.all[other].0 == self.all[contour].0);
        let around = |other: usize| self.extents.all()[other];
        group.filter(|&other| self.all[other].1.closed).any(|other| around(other) != own && around(other).covers(&own))
    }
}

/// A closed contour that may lie around another.
struct Around<'a> {
    contour: usize,
    /// Its points, and the boxes of the edges between them, built at first use.
    points: Cow<'a, [Point]>,
    edges: OnceCell<Boxes>,
}

impl<'a> Around<'a> {
    fn new(contours: &Contours<'a>, contour: usize) -> Self {
        let points = contours.marker.list.points(contours.all[contour].1.range);
        Self { contour, points, edges: OnceCell::new() }
    }

    /// True if a place is within `reach` mm of its edge.
    fn is_at_edge(&self, place: Point, reach: f64) -> bool {
        let extents = || self.points.windows(2).map(|ends| Extent::between(ends[0], ends[1])).collect();
        let edges = self.edges.get_or_init(|| Boxes::new(extents()));
        let mut near = edges.near(Extent::between(place, place).grown(reach));
        near.any(|i| polyline::distance_to_segment(place, self.points[i], self.points[i + 1]) <= reach)
    }
}
