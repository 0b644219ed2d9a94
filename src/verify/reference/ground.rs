//! The ground that programs are judged by: the lines of a marker, and the parts on the cloth.

use super::common::Common;
use super::grid::Grid;
use super::held::{Held, held};
use super::inside::Inside;
use super::lines::Reference;
use super::tees::tees;
use crate::ir::Marker;
use crate::machine::MachineProfile;

/// Reference of the verifier: the lines that must be cut of a marker, and the parts on the cloth.
#[derive(Debug)]
pub struct Ground<'a> {
    pub(in crate::verify) reference: Reference<'a>,
    /// The chords of all lines.
    pub(in crate::verify) grid: Grid,
    /// The parts.
    pub(in crate::verify) inside: Inside<'a>,
    /// The edges that are cut with other parts.
    pub(in crate::verify) common: Common,
    /// Contents of parts, each with the outline that must be cut later.
    pub(in crate::verify) held: Vec<Held>,
}

impl<'a> Ground<'a> {
    /// The ground of a marker.
    pub fn new(marker: &'a Marker, profile: &MachineProfile) -> Self {
        let reference = Reference::new(marker, profile);
        let (grid, (inside, held)) = rayon::join(
            || Grid::new(&reference),
            || rayon::join(|| Inside::new(marker, profile.notch, reference.band), || held(marker, &reference)),
        );
        // Even without common edges, the sections of a part stand for its edges.
        let distance = if reference.common > 0.0 { reference.common } else { reference.tolerance };
        let mut common = Common::new(&reference.shared, &reference, &grid, distance);
        let sizes = [profile.knife.width_mm, profile.verify.max_uncut_mm];
        common.joints.extend(tees(&reference, &grid, &inside, sizes));
        Self { reference, grid, inside, common, held }
    }
}
