//! Passes over the toolpath of one contour, notch or drill.
//!
//! [`trace()`] makes it: one run as the file has it. The passes split it at corners, give it overlaps, and place it.

mod corner;
mod down;
mod entry;
mod frame;
mod overlap;
mod place;
mod slow;
mod table;
mod trace;

pub use frame::frame;
pub use trace::trace;

use crate::diagnostic::Diagnostics;
use crate::ir::Toolpath;
use crate::machine::Job;

/// A pass over a toolpath: a row of [`TOOLPATH_PASSES`].
#[derive(Debug)]
pub struct ToolpathPass {
    /// Name, as `--dump-after` takes it.
    pub name: &'static str,
    /// What it does, in a line.
    pub about: &'static str,
    /// Does it.
    pub run: fn(&mut Toolpath, &Job, &mut Diagnostics),
}

/// Every pass over a toolpath, in order.
pub const TOOLPATH_PASSES: &[ToolpathPass] =
    &[corner::PASS, down::PASS, entry::PASS, slow::PASS, overlap::PASS, place::PASS, table::PASS];
