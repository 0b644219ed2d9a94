//! Pass `overlap`: how far the blade goes past the ends of each run.
//!
//! Needs runs split at corners. Leaves every run with its overlaps, each straight on beyond its end: as far as the
//! profile wants where that is waste, by `knife.reflex_front_overlap_mm` and `knife.reflex_heel_overlap_mm` where
//! it is the part itself (a reflex corner, the inner end of a slit), and shortened to the gap less
//! `knife.clearance_mm` where a part lies ahead, but to no less than one tolerance where the end is not bare; slits
//! begin as far before their edge. At a junction it goes on, whatever lies there, until it is
//! through the other's cut. A run that begins on a curve has only as much of its heel overlap as keeps the plunged
//! blade near its start. After Wang, Zhang & Zhao, *Research on Cutter Knife Tangent Following and Compensating
//! Algorithm*, 2013, doi 10.7690/bgzdh.2013.02.026.

use std::collections::BTreeMap;

use super::pass::ToolpathPass;
use super::runs;
use super::scene::Scene;
use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::{heel_share, overlaps};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Extent, bits, polyline};
use crate::ir::marker::Notch;
use crate::ir::toolpath::{End, Run, Shape, Side, Toolpath};
use crate::machine::Knife;
use crate::units::number::fixed;

/// Part of the tolerance by which a plunged blade may pass the start of its run where that must meet another cut: a small one
/// of the widest thread.
const MEETING_SHARE: f64 = 0.02;

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "overlap",
    about: "gives runs their overlaps, as far as there is waste for them",
    run,
    chained: false,
};

fn run(toolpath: &mut Toolpath, scene: &Scene, diagnostics: &mut Diagnostics) {
    let around = scene.around(toolpath);
    let mut met: BTreeMap<[u64; 2], usize> = BTreeMap::new();
    for run in runs::each(toolpath) {
        for end in [run.points[0], run.points[run.points.len() - 1]] {
            *met.entry(bits(end)).or_default() += 1;
        }
    }
    for run in runs::each(toolpath) {
        let [heel, front] = overlaps(run, &around);
        (run.ends[0].side, run.ends[1].side) = (heel.side, front.side);
        let [across, meeting] = [across(run, scene), meeting(run, &met, &around)];
        run.heel = heel.length.max(across[0]).max(meeting[0]);
        run.front = front.length.max(across[1]).max(meeting[1]);
        if run.shape == Shape::Ring {
            warn_if_tight(run, around.knife, diagnostics);
        }
    }
}

/// How far a run must go past its start and its end to be through cuts of other parts that end beside it, mm.
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

/// Least overlaps at the start and the end of an open run, mm: one tolerance where a part lies ahead, its own part at a reflex
/// corner, too, and at the root of a slit. The cut that it must meet there may be off by that. A blade that a curve turns away
/// from its start has less there, and passes it. `met` counts the ends of runs at each place.
fn meeting(run: &Run, met: &BTreeMap<[u64; 2], usize>, around: &Surroundings) -> [f64; 2] {
    let is_slit = run.ends.iter().all(|end| end.bare && !end.corner && end.side != Side::Contour);
    let has_root = is_slit && polyline::length(&run.points) <= Notch::LONGEST;
    let root = usize::from(run.turned);
    let is_meant = |k: usize| {
        let End { side, bare, .. } = run.ends[k];
        let end = run.points[[0, run.points.len() - 1][k]];
        let is_narrow = side == Side::Gap || side == Side::Part && met.get(&bits(end)).is_some_and(|&ends| ends > 1);
        is_narrow && !bare || has_root && k == root
    };
    let tolerance = around.tolerance;
    let shares = || [heel_share(run, tolerance, MEETING_SHARE * tolerance, around.knife.width_mm), 1.0];
    let least = |k: usize| if is_meant(k) { tolerance * shares()[k] } else { 0.0 };
    if run.shape == Shape::Open { [0, 1].map(least) } else { [0.0; 2] }
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
