//! Pass `overlap`: how far the blade goes past the ends of each run, and which runs are one plunge without motion.
//!
//! Needs runs split at corners. Leaves every run with its overlaps; a run on which the blade has nowhere to go between
//! plunge and lift has become a stab. After Wang, Zhang & Zhao, *Research on Cutter Knife Tangent Following and
//! Compensating Algorithm*, 2013, doi 10.7690/bgzdh.2013.02.026.

use super::ToolpathPass;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Extent, polyline};
use crate::ir::toolpath::{Pose, Run, Shape, Stab, Step, Toolpath};
use crate::machine::{Job, Knife};
use crate::units::number::fixed;

pub(super) const PASS: ToolpathPass =
    ToolpathPass { name: "overlap", about: "gives runs their overlaps and makes stabs of the short ones", run };

fn run(toolpath: &mut Toolpath, job: &Job, diagnostics: &mut Diagnostics) {
    let knife = &job.profile.knife;
    for step in &mut toolpath.steps {
        match step {
            Step::Run(run) => {
                give(run, knife);
                match run.shape {
                    Shape::Ring => warn_if_tight(run, knife, diagnostics),
                    Shape::Open => {
                        if let Some(stab) = stab(run, knife) {
                            *step = Step::Stab(stab);
                        }
                    }
                }
            }
            Step::Stab(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {}
        }
    }
}

/// Gives a run the overlaps that the profile has for its ends.
pub(super) fn give(run: &mut Run, knife: &Knife) {
    let [start, end] = run.ends;
    let heel = if start.corner { knife.corner_heel_overlap_mm } else { knife.heel_overlap_mm };
    let front = if end.corner { knife.corner_front_overlap_mm } else { knife.front_overlap_mm };
    run.heel = if start.bare || run.shape == Shape::Ring { 0.0 } else { heel };
    run.front = match run.shape {
        Shape::Open => front,
        // Once more round would cut nothing new.
        Shape::Ring => front.min(polyline::length(&run.points)),
    };
    if end.bare {
        run.front = 0.0;
    }
}

/// The stab that a run is, when the blade reaches from the heel overlap to the end or beyond: L + F + H <= w on a straight
/// run, no path point at the distance w on a curved one. The surplus lies behind the start, unless only there nothing may
/// be cut.
fn stab(run: &Run, knife: &Knife) -> Option<Stab> {
    let extended = run.extended();
    let reached = polyline::first_at_distance(&extended, knife.width_mm);
    let (first, last) = (extended[0], extended[extended.len() - 1]);
    // Exactly as long as the blade is a stab, too.
    if reached.is_some_and(|(point, _)| point != last) || knife.width_mm == 0.0 {
        return None;
    }
    let along = polyline::direction(first, last)?;
    let surplus = (knife.width_mm - (last - first).norm()).max(0.0);
    let [start, end] = run.ends;
    let ahead = start.bare && !end.bare;
    let tip = last + along * if ahead { surplus } else { 0.0 };
    Some(Stab {
        points: run.points.clone(),
        spans: run.spans.clone(),
        along,
        front: run.front + if ahead { surplus } else { 0.0 },
        heel: run.heel + if ahead { 0.0 } else { surplus },
        ends: run.ends,
        pose: Pose { centre: tip - along * knife.radius(), ..Pose::default() },
    })
}

fn warn_if_tight(run: &Run, knife: &Knife, diagnostics: &mut Diagnostics) {
    let mut extent = Extent::EMPTY;
    for &point in &run.points {
        extent.add(point);
    }
    let (width, height) = extent.size();
    if width.hypot(height) < knife.width_mm {
        let size = format!("{} x {} mm", fixed(width, 2), fixed(height, 2));
        diagnostics.push(
            Diagnostic::new(
                &code::PATH_TIGHT,
                format!("a smooth contour of {size} is narrower than the blade of {} mm", fixed(knife.width_mm, 2)),
            )
            .at(run.spans[0])
            .hint("a hole of this size is better drilled"),
        );
    }
}
