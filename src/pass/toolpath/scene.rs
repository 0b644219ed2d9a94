//! What passes look at beside a toolpath: the job, and the cloth around it.

use std::borrow::Cow;
use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::geom::Point;
use crate::geom::nest::{self, Shape};
use crate::geom::region::{Ray, Regions, Room};
use crate::ir::{Marker, Toolpath};
use crate::machine::{Job, Knife};

/// Part of the tolerance by which a straight extension may lie in a part: then it runs along an edge that is cut anyway.
/// The rest is for how far the tip may leave its path.
const SLACK_SHARE: f64 = 0.9;

/// The job, and the parts that lie on the cloth.
#[derive(Debug)]
pub struct Scene<'a> {
    /// The job.
    pub job: &'a Job,
    /// The parts: inside their outlines, not inside their cut-outs, whichever way round these are drawn.
    parts: Regions<'a>,
    /// The part to which each piece belongs: one that lies in another is a cut-out of that.
    part_of: Vec<u32>,
}

impl<'a> Scene<'a> {
    /// The scene of a marker. Contours that do not close bound nothing.
    pub fn new(marker: &'a Marker, job: &'a Job) -> Self {
        let rings = |piece: u32| -> Vec<Cow<'a, [Point]>> {
            let closed = marker.pieces[piece as usize].contours.iter().filter(|contour| contour.closed);
            closed.map(|contour| marker.list.points(contour.range)).collect()
        };
        let count = marker.pieces.len() as u32;
        let pieces = Regions::new(0..count, rings);
        let shapes: Vec<Shape> = (0..count).into_par_iter().map(|piece| Shape::new(&rings(piece))).collect();
        let part_of = nest::regions(&shapes, |point| pieces.owners_at(point));
        let parts = if part_of.iter().copied().eq(0..count) { pieces } else { whole_parts(&part_of, rings) };
        Self { job, parts, part_of }
    }

    /// The scene as the cuts of a toolpath see it.
    pub(super) fn around(&self, toolpath: &Toolpath) -> Around<'_> {
        let part = self.part_of.get(toolpath.part as usize).copied().unwrap_or(toolpath.part);
        Around { scene: self, part, tolerance: toolpath.tolerance }
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

/// The scene as the cuts of one piece see it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Around<'a> {
    scene: &'a Scene<'a>,
    part: u32,
    tolerance: f64,
}

impl<'a> Around<'a> {
    pub(super) fn knife(&self) -> &'a Knife {
        &self.scene.job.profile.knife
    }

    /// Permitted deviation of the tip, mm.
    pub(super) fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// How far a straight way goes before it enters a part.
    pub(super) fn room(&self, ray: &Ray) -> Room {
        self.scene.parts.room(ray, self.part, SLACK_SHARE * self.tolerance)
    }
}
