//! Description of a pass over the marker.

use crate::diagnostic::Diagnostics;
use crate::ir::Marker;
use crate::machine::Job;

/// A pass over the marker: a row of [`MARKER_PASSES`](super::MARKER_PASSES).
#[derive(Debug)]
pub struct MarkerPass {
    /// Name, as `--dump-after` takes it.
    pub name: &'static str,
    /// Effect, in a line.
    pub about: &'static str,
    /// Function that runs it.
    pub run: fn(&mut Marker, &Job, &mut Diagnostics),
}
