//! The band: edges of different parts that are nearer to each other than it are one edge.

/// Least width of the band, mm: what shears and knives do not tell apart.
const LEAST: f64 = 0.2;

/// How deep a place may lie in a part and still be at its edge, mm: a diagonal of the unit of the file (mm; 0 = none), since
/// each outline was rounded by itself.
pub(in crate::verify) fn band(unit: f64) -> f64 {
    (unit * std::f64::consts::SQRT_2).max(LEAST)
}
