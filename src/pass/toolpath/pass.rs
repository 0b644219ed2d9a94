//! Description of a pass over a toolpath.

use super::scene::Scene;
use crate::diagnostic::Diagnostics;
use crate::ir::Toolpath;

/// A pass over a toolpath: a row of `TOOLPATH_PASSES`.
#[derive(Debug)]
pub struct ToolpathPass {
    /// Name, as `--dump-after` takes it.
    pub name: &'static str,
    /// Effect, in a line.
    pub about: &'static str,
    /// Function that runs it.
    pub run: fn(&mut Toolpath, &Scene, &mut Diagnostics),
    /// True if it depends on where the previous toolpath ends. This pass and all later ones take the toolpaths in sequence.
    pub chained: bool,
}
