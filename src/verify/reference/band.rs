//! Band: edges of different parts within this distance count as one edge.

use crate::machine::MachineProfile;

/// Smallest width of the band, mm: below it shears and knives see no difference.
const LEAST: f64 = 0.2;

/// Greatest depth in a part at which a place still counts as on its edge, mm: the profile's value, or a diagonal of the file's
/// unit (mm; 0 = none), since each outline was rounded separately.
pub(in crate::verify) fn band(unit: f64, profile: &MachineProfile) -> f64 {
    profile.nest.band_mm.unwrap_or((unit * std::f64::consts::SQRT_2).max(LEAST))
}
