//! Pass `overlap`: sets the overlaps of the blade past the ends of each run.
//!
//! Needs runs split at corners. Leaves every run with its overlaps, each straight beyond its end. An overlap has the length of
//! the profile in waste, and `knife.reflex_front_overlap_mm` or `knife.reflex_heel_overlap_mm` in the part itself (at a reflex
//! corner or the inner end of a slit). Where a part lies ahead it is shortened to the gap less `knife.clearance_mm`, but to no
//! less than one tolerance unless the end is bare; slits begin as far before their edge. At a junction it goes on until it is
//! through the other's cut, whatever lies there. A run that begins on a curve has only as much heel overlap as keeps the
//! plunged blade near its start, and across the cuts that it meets there. After Wang, Zhang & Zhao, *Research on Cutter Knife
//! Tangent Following and Compensating Algorithm*, 2013, doi 10.7690/bgzdh.2013.02.026.

use super::ends::Ends;
use super::pass::ToolpathPass;
use super::root;
use super::runs;
use super::scene::Scene;
use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::{heel_share, overlaps};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Extent, polyline};
use crate::ir::toolpath::{End, Run, Shape, Side, Toolpath};
use crate::machine::Knife;
use crate::units::number::fixed;

/// Share of the tolerance by which a plunged blade may miss the start of its run where that must meet another cut: a small
/// share of the widest thread.
const MEETING_SHARE: f64 = 0.02;

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "overlap",
    about: "gives runs their overlaps, as far as there is waste for them",
    run,
    chained: false,
};

fn run(toolpath: &mut Toolpath, scene: &Scene, diagnostics: &mut Diagnostics) {
    let around = scene.around(toolpath);
    let part = toolpath.part;
    let ends = Ends::new(toolpath.runs());
    for run in runs::each(toolpath) {
        let [heel, front] = overlaps(run, &around);
        (run.ends[0].side, run.ends[1].side) = (heel.side, front.side);
        let given = [heel.length, front.length];
        let least = [across(run, scene), meeting(run, &ends, &around), at_root(run, part, scene, &around)];
        [run.heel, run.front] = least.into_iter().fold(given, |given, least| [0, 1].map(|k| given[k].max(least[k])));
        if run.shape == Shape::Ring {
            warn_if_tight(run, around.knife, diagnostics);
        }
    }
    let heels = shortened(&toolpath.runs().collect::<Vec<&Run>>(), &ends, &around);
    for (run, heel) in runs::each(toolpath).zip(heels) {
        run.heel = heel;
    }
}

/// Heel overlaps of the runs, mm: shorter where the plunged blade would pass beside another cut at the start of its run. Where
/// two cuts hardly turn from one to the next, a curve behind the start moves the whole blade to one side of the other cut.
fn shortened(runs: &[&Run], ends: &Ends, around: &Surroundings) -> Vec<f64> {
    let (allowed, width) = (MEETING_SHARE * around.tolerance, around.knife.width_mm);
    let heel = |(i, run): (usize, &&Run)| {
        let share = if run.shape == Shape::Open { heel_share(run, run.heel, allowed, width) } else { 1.0 };
        if share < 1.0 && ends.has_miss(runs, i, allowed, width) { run.heel * share } else { run.heel }
    };
    runs.iter().enumerate().map(heel).collect()
}

/// Lengths by which a run must go past its start and its end to cross cuts of other parts that end beside it, mm.
fn across(run: &Run, scene: &Scene) -> [f64; 2] {
    let n = run.points.len();
    let beyond = |end: usize, before: usize| {
        let along = polyline::direction(run.points[before], run.points[end])?;
        Some(scene.junctions.beyond(run.points[end], along))
    };
    match run.shape {
        Shape::Open => [beyond(0, 1), beyond(n - 1, n - 2)].map(Option::unwrap_or_default),
        Shape::Ring => [0.0; 2],
    }
}

/// Least overlaps at the start and the end of an open run, mm: one tolerance where a part lies ahead, including its own part at
/// a reflex corner, because the cut that it must meet there may be off by that. The start has less on a curve that would turn
/// the blade away from it. `ends` are those of all runs.
fn meeting(run: &Run, ends: &Ends, around: &Surroundings) -> [f64; 2] {
    let is_meant = |k: usize| {
        let End { side, bare, .. } = run.ends[k];
        let end = run.points[[0, run.points.len() - 1][k]];
        let is_narrow = side == Side::Gap || side == Side::Part && ends.are_several(end);
        is_narrow && !bare
    };
    let least = |k: usize| if is_meant(k) { around.tolerance * share(run, k, around.tolerance, around) } else { 0.0 };
    if run.shape == Shape::Open { [0, 1].map(least) } else { [0.0; 2] }
}

/// Least overlap at the root of a slit, mm; 0 at all other ends.
fn at_root(run: &Run, part: u32, scene: &Scene, around: &Surroundings) -> [f64; 2] {
    let is_slit = run.ends.iter().all(|end| end.bare && !end.corner && end.side != Side::Contour);
    let k = usize::from(run.turned);
    let mut least = [0.0; 2];
    let n = run.points.len();
    let [root, before] = [[0, 1], [n - 1, n - 2]][k].map(|i| run.points[i]);
    if run.shape == Shape::Open && is_slit && root::is_of_slit(root, part, scene) {
        let along = (root - before).normalize();
        let reach = root::reach(root, along, part, around.tolerance, scene);
        least[k] = reach * share(run, k, reach, around);
    }
    least
}

/// Share of an overlap of `length` mm that a blade can have at an end of a run, given that a curve turns it away from the
/// start.
fn share(run: &Run, end: usize, length: f64, around: &Surroundings) -> f64 {
    let allowed = MEETING_SHARE * around.tolerance;
    if end == 0 { heel_share(run, length, allowed, around.knife.width_mm) } else { 1.0 }
}

fn warn_if_tight(run: &Run, knife: &Knife, diagnostics: &mut Diagnostics) {
    let (width, height) = Extent::of(&run.points).size();
    if width.max(height) < knife.width_mm {
        let size = format!("{} x {} mm", fixed(width, 2), fixed(height, 2));
        diagnostics.push(
            Diagnostic::new(
                &code::PATH_TIGHT,
                format!("a smooth contour of {size} is narrower than the blade of {} mm", fixed(knife.width_mm, 2)),
            )
            .at(run.spans[0])
            .hint("a hole of this size is better drilled; of a plot, `hpgl.drill_max_mm` in the profile asks for that"),
        );
    }
}
