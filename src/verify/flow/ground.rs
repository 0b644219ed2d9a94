//! What programs of heads are judged against: the cuts of the marker, and the machine.

use crate::ir::Marker;
use crate::machine::MachineProfile;

/// What programs are judged against.
#[derive(Clone, Copy)]
pub struct Ground<'a> {
    /// What is to be cut.
    pub marker: &'a Marker,
    /// The machine.
    pub profile: &'a MachineProfile,
}

impl Ground<'_> {
    /// How far the leading end of the blade may leave its line, mm: the tolerance, and what a curve may bulge.
    pub(super) fn tolerance(&self) -> f64 {
        self.profile.tolerance(self.marker.unit) + self.profile.path.chord_sag_max_mm + ROUNDING
    }

    /// Where the row of heads of a number, from 1, must stand, mm from the origin of the marker.
    pub(super) fn station(&self, row: u64) -> f64 {
        let flow = &self.profile.flow;
        self.marker.extent().max.x + flow.first_row_mm + (row as f64 - 1.0) * flow.row_pitch_mm
    }
}

/// Rounding of rows of six decimals, mm, three of which make a place of the blade.
pub(super) const ROUNDING: f64 = 1e-5;
