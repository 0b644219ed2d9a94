//! Sizes beyond which a drawing is doubted, whatever its format: a decimal point may be lost, or the unit be another one.

/// Maximum length of a lay, mm: cloth is spread over a few dozen metres.
pub const LONGEST_LAY_MM: f64 = 100_000.0;
/// Maximum side of a part, mm: garments, covers and sails in one piece are smaller.
pub const LONGEST_PART_MM: f64 = 10_000.0;
