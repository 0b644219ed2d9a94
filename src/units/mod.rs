//! Units. Internally, lengths are in mm, times in s and angles in rad; all conversion factors are defined here.

pub mod array;
pub mod columns;
pub mod digits;
pub mod number;
pub mod quantity;

/// Millimetres in an inch (exact).
pub const MM_PER_INCH: f64 = 25.4;
/// Milliseconds in a second.
pub const MS_PER_S: f64 = 1000.0;
/// Microseconds in a second.
pub const US_PER_S: f64 = 1e6;
/// Nanoseconds in a second.
pub const NS_PER_S: f64 = 1e9;
/// Seconds in a minute.
pub const S_PER_MIN: f64 = 60.0;
/// Seconds in an hour.
pub const S_PER_HOUR: f64 = 3600.0;
/// Millimetres in a metre.
pub const MM_PER_M: f64 = 1000.0;
/// Tenths of a millimetre, the unit of stitch files, in a millimetre.
pub const TENTHS_PER_MM: f64 = 10.0;
/// Square millimetres in a square metre.
pub const MM2_PER_M2: f64 = MM_PER_M * MM_PER_M;

/// Degrees to radians.
pub fn rad(degrees: f64) -> f64 {
    degrees.to_radians()
}

/// Radians to degrees.
pub fn deg(radians: f64) -> f64 {
    radians.to_degrees()
}
