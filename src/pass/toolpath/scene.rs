//! What passes look at beside a toolpath: the job, and the cloth around it.

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
    parts: Regions,
}

impl<'a> Scene<'a> {
    /// The scene of a marker. Contours that do not close bound nothing.
    pub fn new(marker: &Marker, job: &'a Job) -> Self {
        let closed = marker.contours().filter(|(_, contour)| contour.closed);
        Self { job, parts: Regions::new(closed.map(|(piece, contour)| (piece as u32, marker.points(contour)))) }
    }

    /// A scene without parts.
    pub(super) fn bare(job: &'a Job) -> Self {
        Self { job, parts: Regions::default() }
    }

    /// The scene as the cuts of a toolpath see it.
    pub(super) fn around(&self, toolpath: &Toolpath) -> Around<'_> {
        Around { scene: self, part: toolpath.part, tolerance: toolpath.tolerance }
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
