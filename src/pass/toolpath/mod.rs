//! Passes over the toolpath of one contour, notch or drill.
//!
//! [`trace()`] makes it: one run as the file has it. The passes split it at corners, give it overlaps, and place it. They
//! look at the cloth around it, the [`Scene`]: an overlap goes into the waste.

mod bow;
mod chord;
mod corner;
mod down;
mod entry;
mod frame;
mod lap;
mod nibble;
mod overlap;
mod place;
mod scene;
mod slow;
mod stab;
mod stretch;
mod tight;
mod trace;
mod turn;
mod wind;

pub use frame::frame;
pub use scene::Scene;
pub use trace::trace;

use crate::diagnostic::Diagnostics;
use crate::ir::Toolpath;

/// A pass over a toolpath: a row of [`TOOLPATH_PASSES`].
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

/// Every pass over a toolpath, in order.
pub const TOOLPATH_PASSES: &[ToolpathPass] = &[
    corner::PASS,
    down::PASS,
    wind::PASS,
    tight::PASS,
    entry::PASS,
    turn::PASS,
    slow::PASS,
    overlap::PASS,
    stab::PASS,
    place::PASS,
];
