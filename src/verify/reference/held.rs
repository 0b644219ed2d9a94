//! What lies in a part, and must be cut and drilled before the part comes free: a loose part shifts.
//!
//! Judged by the drawing alone: a contour lies in the smallest closed one that holds all of its places, a slit or a hole in the
//! smallest one of its own piece. Where something is asked of the operator in between, the file wants it so.

use std::ops::Range;

use rayon::prelude::*;

use super::lines::Reference;
use crate::geom::region::Regions;
use crate::geom::{Extent, Point, ring};
use crate::ir::Marker;
use crate::ir::marker::Contour;

/// Something that lies in a closed contour, both by the ranks of their cuts.
#[derive(Debug, Clone)]
pub(in crate::verify) struct Held {
    /// What lies there.
    pub(in crate::verify) inner: Range<u32>,
    /// What comes free with the last of these.
    pub(in crate::verify) outline: Range<u32>,
}

/// The contours of a marker.
struct Contours<'a> {
    marker: &'a Marker,
    /// Each with the place of its piece.
    all: Vec<(usize, &'a Contour)>,
    extents: Vec<Extent>,
    /// mm2.
    areas: Vec<f64>,
    /// The insides of the closed ones.
    regions: Regions<'a>,
    /// For each piece in how many before it something is asked, itself among them.
    asked: Vec<usize>,
}

/// What lies in closed contours of a marker.
pub(in crate::verify) fn held(marker: &Marker, reference: &Reference) -> Vec<Held> {
    let contours = Contours::new(marker);
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
    let of_mark = |&(rank, at, piece): &(u32, Point, usize)| {
        let outline = contours.smallest_at(at, |other| contours.all[other].0 == piece)?;
        Some(Held { inner: rank..rank + 1, outline: ranks[outline].clone() })
    };
    let of_contour = |contour: usize| {
        let outline = contours.around(contour)?;
        Some(Held { inner: ranks[contour].clone(), outline: ranks[outline].clone() })
    };
    let mut held: Vec<Held> = marks.par_iter().filter_map(of_mark).collect();
    held.par_extend((0..ranks.len()).into_par_iter().filter_map(of_contour));
    // What is cut with other parts alone is free with these.
    held.retain(|held| !held.inner.is_empty() && !held.outline.is_empty());
    held
}

impl<'a> Contours<'a> {
    fn new(marker: &'a Marker) -> Self {
        let all: Vec<(usize, &Contour)> = marker.contours().collect();
        let measured = all.par_iter().map(|(_, contour)| {
            let points = marker.list.points(contour.range);
            (Extent::of(&points), ring::area(&points).abs())
        });
        let (extents, areas) = measured.unzip();
        let closed = (0..all.len() as u32).filter(|&i| all[i as usize].1.closed);
        let regions = Regions::new(closed, |i| vec![marker.list.points(all[i as usize].1.range)]);
        let asked = marker.pieces.iter().scan(0, |asked, piece| {
            *asked += usize::from(!piece.events.is_empty());
            Some(*asked)
        });
        Self { marker, extents, areas, regions, asked: asked.collect(), all }
    }

    /// The smallest of some closed contours in which a place lies.
    fn smallest_at(&self, place: Point, is_meant: impl Fn(usize) -> bool) -> Option<usize> {
        let around = self.regions.owners_at(place).into_iter().map(|owner| owner as usize).filter(|&i| is_meant(i));
        around.min_by(|&a, &b| self.areas[a].total_cmp(&self.areas[b]).then(a.cmp(&b)))
    }

    /// The smallest closed contour that holds all places of another.
    fn around(&self, contour: usize) -> Option<usize> {
        let (piece, inner) = self.all[contour];
        let points = self.marker.list.points(inner.range);
        let area = if inner.closed { self.areas[contour] } else { 0.0 };
        let is_larger = |other: usize| self.areas[other] > area && self.extents[other].covers(&self.extents[contour]);
        let first = self.regions.owners_at(points[0]).into_iter().map(|owner| owner as usize);
        let mut around: Vec<usize> = first.filter(|&other| other != contour && is_larger(other)).collect();
        for &point in &points[1..] {
            if around.is_empty() {
                return None; // as of nearly all, at their first place
            }
            let here = self.regions.owners_at(point);
            around.retain(|&other| here.binary_search(&(other as u32)).is_ok());
        }
        let smallest = around.into_iter().min_by(|&a, &b| self.areas[a].total_cmp(&self.areas[b]).then(a.cmp(&b)))?;
        // Behind what is asked the file has it.
        (self.asked[self.all[smallest].0] >= self.asked[piece]).then_some(smallest)
    }
}
