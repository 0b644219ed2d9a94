//! Passes over the toolpath of one contour, notch or drill.

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
pub const TOOLPATH_PASSES: &[ToolpathPass] = &[];
