//! What passes look at beside a toolpath: the job, and the cloth around it.

use rayon::prelude::*;

use crate::geom::Point;
use crate::geom::nest::{self, Shape};
use crate::geom::region::{Ray, Regions, Room};
use crate::ir::marker::Piece;
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
    parts: Regions,
    /// The part to which each piece belongs: one that lies in another is a cut-out of that.
    part_of: Vec<u32>,
}

impl<'a> Scene<'a> {
    /// The scene of a marker. Contours that do not close bound nothing.
    pub fn new(marker: &Marker, job: &'a Job) -> Self {
        let rings = |piece: &Piece| -> Vec<Vec<Point>> {
            let closed = piece.contours.iter().filter(|contour| contour.closed);
            closed.map(|contour| marker.points(contour)).collect()
        };
        let rings: Vec<Vec<Vec<Point>>> = marker.pieces.par_iter().map(rings).collect();
        let regions = |part_of: &dyn Fn(u32) -> u32| {
            let rings = rings.iter().zip(0..).flat_map(|(rings, piece)| rings.iter().map(move |ring| (piece, ring)));
            Regions::new(rings.map(|(piece, ring)| (part_of(piece), &ring[..])))
        };
        let pieces = regions(&|piece| piece);
        let shapes: Vec<Shape> = rings.par_iter().map(|rings| Shape::new(rings)).collect();
        let part_of = nest::regions(&shapes, |point| pieces.owners_at(point));
        let parts = if part_of.iter().copied().eq(0..) { pieces } else { regions(&|piece| part_of[piece as usize]) };
        Self { job, parts, part_of }
    }

    /// Whether a place lies in the part to which a piece belongs.
    pub(super) fn is_in_part(&self, piece: usize, place: Point) -> bool {
        self.parts.owners_at(place).contains(&self.part_of[piece])
    }

    /// A scene without parts.
    pub(super) fn bare(job: &'a Job) -> Self {
        Self { job, parts: Regions::default(), part_of: Vec::new() }
    }

    /// The scene as the cuts of a toolpath see it.
    pub(super) fn around(&self, toolpath: &Toolpath) -> Around<'_> {
        let part = self.part_of.get(toolpath.part as usize).copied().unwrap_or(toolpath.part);
        Around { scene: self, part, tolerance: toolpath.tolerance }
    }
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
