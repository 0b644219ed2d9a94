//! Context of the toolpath passes: the job, and the cloth around a toolpath.

use super::junctions::Junctions;
use super::near::NearLines;
use crate::analysis::cloth::{Cloth, Surroundings};
use crate::ir::{Marker, Toolpath};
use crate::machine::Job;

/// Context of a toolpath: the job, and the parts on the cloth.
#[derive(Debug)]
pub struct Scene<'a> {
    /// The job.
    pub job: &'a Job,
    /// The parts.
    pub cloth: Cloth<'a>,
    /// The marker, which holds the cuts as they are drawn.
    pub(super) marker: &'a Marker,
    /// Edges beside which another part's edge runs.
    pub(super) near: NearLines<'a>,
    /// Crossings of the cuts of several parts.
    pub(super) junctions: Junctions<'a>,
    /// Grid of the numbers in the file, mm; 0 if they are not rounded.
    pub unit: f64,
}

impl<'a> Scene<'a> {
    /// The scene of a marker.
    pub fn new(marker: &'a Marker, job: &'a Job) -> Self {
        let (near, junctions) = (NearLines::new(marker), Junctions::new(marker, &job.profile));
        Self { job, cloth: Cloth::new(marker, &job.profile), marker, near, junctions, unit: marker.unit }
    }

    /// Cloth and blade around the cuts of a toolpath.
    pub(super) fn around(&self, toolpath: &Toolpath) -> Surroundings<'_> {
        self.cloth.around(toolpath, &self.job.profile.knife)
    }
}
