//! Readers of emitted bytes, one per format. They produce rows for the other checks, or verify a cut file directly.
//!
//! Input: bytes. Output: rows, or the findings on a cut file, or the place where reading failed. The cut itself is verified
//! elsewhere.

pub(super) mod counts;
pub(super) mod cutter_file;
pub(super) mod gcode;
pub(super) mod hal;
pub(super) mod npy;
pub(crate) mod number;
pub(super) mod row;
pub(super) mod rows;
pub(super) mod spelling;
