//! Pass `down`: no run is longer than the knife may stay down.
//!
//! Needs runs split at corners. Leaves none that with its overlaps is longer than `knife.max_down_mm`, when that is set: a
//! longer one is lifted after equal parts and rejoined with the overlaps of a corner, which here lie along the contour.

use super::ToolpathPass;
use super::scene::Scene;
use super::stretch::{REJOINED, Way};
use crate::diagnostic::Diagnostics;
use crate::ir::toolpath::{Run, Step, Toolpath};
use crate::machine::Knife;

pub(super) const PASS: ToolpathPass =
    ToolpathPass { name: "down", about: "lifts runs that are longer than knife.max_down_mm", run, chained: false };

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    let job = scene.job;
    let Some(longest) = job.profile.knife.longest_cut() else { return };
    let steps = std::mem::take(&mut toolpath.steps);
    for step in steps {
        match step {
            Step::Run(run) => toolpath.steps.extend(split(run, longest, &job.profile.knife).into_iter().map(Step::Run)),
            Step::Stab(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {
                toolpath.steps.push(step);
            }
        }
    }
}

/// Equal parts of a run, as few as keep below `longest`, each led on along the contour by the overlaps of a corner.
fn split(run: Run, longest: f64, knife: &Knife) -> Vec<Run> {
    let way = Way::new(&run);
    let length = way.length();
    let parts = (length / longest).ceil() as usize;
    if parts <= 1 {
        return vec![run];
    }
    let (heel, front) = (knife.corner_heel_overlap_mm, knife.corner_front_overlap_mm);
    let cut = |i: usize| length * i as f64 / parts as f64;
    (0..parts)
        .map(|i| {
            let (first, last) = (i == 0 && !way.is_ring(), i + 1 == parts && !way.is_ring());
            let from = if first { 0.0 } else { cut(i) - heel };
            let to = if last { length } else { cut(i + 1) + front };
            way.part(from, to, [if first { run.ends[0] } else { REJOINED }, if last { run.ends[1] } else { REJOINED }])
        })
        .collect()
}
