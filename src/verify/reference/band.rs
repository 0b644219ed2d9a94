//! The band: edges of different parts that are nearer to each other than it are one edge.

use crate::machine::MachineProfile;

/// Least width of the band, mm: what shears and knives do not tell apart.
const LEAST: f64 = 0.2;

/// How deep a place may lie in a part and still be at its edge, mm: a diagonal of the unit of the file (mm; 0 = none), since
/// each outline was rounded by itself, or what the profile says.
pub(in crate::verify) fn band(unit: f64, profile: &MachineProfile) -> f64 {
    profile.nest.band_mm.unwrap_or((unit * std::f64::consts::SQRT_2).max(LEAST))
}
