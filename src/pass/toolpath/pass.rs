//! What a pass over a toolpath is.

use super::scene::Scene;
use crate::diagnostic::Diagnostics;
use crate::ir::Toolpath;

/// A pass over a toolpath: a row of `TOOLPATH_PASSES`.
#[derive(Debug)]
pub struct ToolpathPass {
    /// Name, as `--dump-after` takes it.
    pub name: &'static str,
    /// What it does, in a line.
    pub about: &'static str,
    /// Does it.
    pub run: fn(&mut Toolpath, &Scene, &mut Diagnostics),
    /// Whether it looks at where the toolpath before ends: it and all behind it see one toolpath after the other.
    pub chained: bool,
}
