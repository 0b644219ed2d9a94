//! The audit of the source: its bytes, read by other means than the reader's, hold what the marker holds, no pass
//! loses any of it, and all of it lies where the sheet and the cloth have it.
//!
//! Receives the bytes, and the marker as it was read and as it is cut; promises a finding under each rule `source/`. Never
//! uses a reader of `front`.

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
