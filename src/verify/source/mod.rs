//! The audit of the source: its bytes, read by other means than the reader's, hold what the marker holds, and no pass
//! loses any of it.

pub(super) mod audit;
pub(super) mod census;
pub(super) mod hpgl;
pub(super) mod kept;
pub(super) mod scan;
