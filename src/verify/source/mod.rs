//! Audit of the source. Its bytes, read by other means than the reader's, must contain the same as the marker; no pass may lose
//! any of it; and all of it must be at its place by sheet and cloth.
//!
//! Input: the bytes, and the marker as read and as cut. Output: a finding for each rule `source/`. It uses no reader of
//! `front`.

pub(super) mod audit;
pub(super) mod census;
mod cloth;
pub(super) mod drawing;
pub(super) mod dxf;
pub(super) mod hpgl;
pub(super) mod kept;
mod marks;
pub(super) mod scan;
pub(super) mod sheet;
pub(super) mod svg;
pub(super) mod words;
