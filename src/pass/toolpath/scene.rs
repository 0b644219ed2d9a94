//! What passes look at beside a toolpath: the job, and the cloth around it.

use super::junctions::Junctions;
use super::near::NearLines;
use crate::analysis::cloth::{Cloth, Surroundings};
use crate::ir::{Marker, Toolpath};
use crate::machine::Job;

/// The job, and the parts that lie on the cloth.
#[derive(Debug)]
pub struct Scene<'a> {
    /// The job.
    pub job: &'a Job,
    /// The parts.
    pub cloth: Cloth<'a>,
    /// The marker, which holds the cuts as they are drawn.
    pub(super) marker: &'a Marker,
    /// The edges beside which another part's run.
    pub(super) near: NearLines<'a>,
    /// Where cuts of several parts cross each other.
    pub(super) junctions: Junctions<'a>,
    /// What the numbers of the file are multiples of, mm; 0 when they are not rounded to a grid.
    pub unit: f64,
}

impl<'a> Scene<'a> {
    /// The scene of a marker.
    pub fn new(marker: &'a Marker, job: &'a Job) -> Self {
        let (near, junctions) = (NearLines::new(marker), Junctions::new(marker, &job.profile));
        Self { job, cloth: Cloth::new(marker, &job.profile), marker, near, junctions, unit: marker.unit }
    }

    /// The cloth and the blade as the cuts of a toolpath see them.
    pub(super) fn around(&self, toolpath: &Toolpath) -> Surroundings<'_> {
        self.cloth.around(toolpath, &self.job.profile.knife)
    }
}
