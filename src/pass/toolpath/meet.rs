//! Pass `meet`: keeps the tip nearer to its line where cuts of several parts cross.
//!
//! Needs runs with all their points. Marks the chords that pass a junction of the marker: both cuts may be off their lines
//! there, and must cross all the same.

use super::pass::ToolpathPass;
use super::runs;
use super::scene::Scene;
use crate::diagnostic::Diagnostics;
use crate::ir::toolpath::Toolpath;

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "meet",
    about: "keeps the tip near its line where cuts of several parts cross each other",
    run,
    chained: false,
};

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    for run in runs::each(toolpath) {
        run.junctions = Vec::new();
        if scene.junctions.may_be_by(&run.points) {
            let by: Vec<bool> = run.points.windows(2).map(|ends| scene.junctions.is_by(ends[0], ends[1])).collect();
            run.junctions = if by.contains(&true) { by } else { Vec::new() };
        }
    }
}
