//! Reference for programs of heads: the cuts of the marker, and the machine.

use crate::ir::Marker;
use crate::machine::MachineProfile;

/// Reference for the verification.
#[derive(Clone, Copy)]
pub struct Ground<'a> {
    /// Marker with the required cuts.
    pub marker: &'a Marker,
    /// Profile of the machine.
    pub profile: &'a MachineProfile,
}

impl Ground<'_> {
    /// Greatest distance of the blade's leading end from its line, mm: tolerance, bulge of a curve, and rounding.
    pub(super) fn tolerance(&self) -> f64 {
        self.profile.tolerance(self.marker.unit) + self.profile.path.chord_sag_max_mm + ROUNDING
    }

    /// Required station of a row of heads, numbered from 1, mm from the origin of the marker.
    pub(super) fn station(&self, row: u64) -> f64 {
        let flow = &self.profile.flow;
        self.marker.extent().max.x + flow.first_row_mm + (row as f64 - 1.0) * flow.row_pitch_mm
    }
}

/// Rounding of a blade position, mm: it is computed from three numbers of six decimals.
pub(super) const ROUNDING: f64 = 1e-5;
