//! Readers of emitted bytes, one a format: rows, which the rest judges, or the cutter file as it is.
//!
//! Receives bytes, promises rows, or the findings on a cutter file, or the place from which on they cannot be read. Never
//! judges what the rows cut.

pub(super) mod counts;
pub(super) mod cutter_file;
pub(super) mod gcode;
pub(super) mod hal;
pub(super) mod npy;
pub(crate) mod number;
pub(super) mod row;
pub(super) mod rows;
pub(super) mod spelling;
