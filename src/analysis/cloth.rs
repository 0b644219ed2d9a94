//! The cloth around a cut: which parts lie on it, and how far a blade may go before it enters one.

use std::borrow::Cow;
use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::geom::Point;
use crate::geom::nest::{self, Shape};
use crate::geom::region::{Ray, Regions, Room};
use crate::ir::{Marker, Toolpath};
use crate::machine::Knife;

/// Part of the tolerance by which a straight extension may lie in a part: then it runs along an edge that is cut anyway.
/// The rest is for how far the tip may leave its path.
const SLACK_SHARE: f64 = 0.9;
/// A way that enters the part within this length begins in it, mm: rounding.
pub const INSIDE_EPSILON: f64 = 1e-6;

/// The parts that lie on the cloth.
#[derive(Debug)]
pub struct Cloth<'a> {
    /// Inside their outlines, not inside their cut-outs, whichever way round these are drawn.
    parts: Regions<'a>,
    /// The part to which each piece belongs: one that lies in another is a cut-out of that.
    part_of: Vec<u32>,
}

impl<'a> Cloth<'a> {
    /// The cloth on which a marker lies. Contours that do not close bound nothing.
    pub fn new(marker: &'a Marker) -> Self {
        let rings = |piece: u32| -> Vec<Cow<'a, [Point]>> {
            let closed = marker.pieces[piece as usize].contours.iter().filter(|contour| contour.closed);
            closed.map(|contour| marker.list.points(contour.range)).collect()
        };
        let count = marker.pieces.len() as u32;
        let pieces = Regions::new(0..count, rings);
        let shapes: Vec<Shape> = (0..count).into_par_iter().map(|piece| Shape::new(&rings(piece))).collect();
        let part_of = nest::regions(&shapes, |point| pieces.owners_at(point));
        let parts = if part_of.iter().copied().eq(0..count) { pieces } else { whole_parts(&part_of, rings) };
        Self { parts, part_of }
    }

    /// Whether a place lies in the part to which a piece belongs, by the piece's place in the marker.
    pub fn is_in_part(&self, piece: usize, place: Point) -> bool {
        self.parts.owners_at(place).contains(&self.part_of[piece])
    }

    /// The cloth as the cuts of a toolpath see it.
    pub fn around(&'a self, toolpath: &Toolpath, knife: &'a Knife) -> Surroundings<'a> {
        let part = self.part_of.get(toolpath.part as usize).copied().unwrap_or(toolpath.part);
        Surroundings { knife, tolerance: toolpath.tolerance, cloth: self, part }
    }
}

/// The regions of parts whose cut-outs are pieces; `rings` gives the rings of a piece.
fn whole_parts<'a>(part_of: &[u32], rings: impl Fn(u32) -> Vec<Cow<'a, [Point]>> + Sync) -> Regions<'a> {
    let mut members: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (&part, piece) in part_of.iter().zip(0..) {
        members.entry(part).or_default().push(piece);
    }
    Regions::new(members.keys().copied(), |part| members[&part].iter().flat_map(|&piece| rings(piece)).collect())
}

/// What the cuts of one piece go by: the blade, its tolerance, and the cloth as seen from the part of that piece.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings<'a> {
    /// The blade, and how far it should go past the ends of cuts.
    pub knife: &'a Knife,
    /// Permitted deviation of the tip, mm.
    pub tolerance: f64,
    cloth: &'a Cloth<'a>,
    part: u32,
}

impl Surroundings<'_> {
    /// How far a straight way goes before it enters a part.
    pub fn room(&self, ray: &Ray) -> Room {
        self.cloth.parts.room(ray, self.part, SLACK_SHARE * self.tolerance)
    }

    /// Whether a straight way leads into the part to which the piece belongs from its very start.
    pub fn leads_inside(&self, ray: &Ray) -> bool {
        begins_inside(self.room(ray))
    }
}

/// Whether a way with this room begins in the part to which its piece belongs.
pub fn begins_inside(room: Room) -> bool {
    room.own <= INSIDE_EPSILON
}
