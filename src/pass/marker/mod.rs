//! Passes over the marker.

use crate::diagnostic::Diagnostics;
use crate::ir::Marker;
use crate::machine::Job;

mod inspect;
mod notch;
mod order;
mod sanity;
mod select;
mod slit;
mod weld;

/// A pass over the marker: a row of [`MARKER_PASSES`].
#[derive(Debug)]
pub struct MarkerPass {
    /// Name, as `--dump-after` takes it.
    pub name: &'static str,
    /// What it does, in a line.
    pub about: &'static str,
    /// Does it.
    pub run: fn(&mut Marker, &Job, &mut Diagnostics),
}

/// Every pass over the marker, in order.
pub const MARKER_PASSES: &[MarkerPass] =
    &[weld::PASS, slit::PASS, inspect::PASS, order::PASS, notch::PASS, sanity::PASS, select::PASS];
