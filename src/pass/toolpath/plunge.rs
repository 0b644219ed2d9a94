//! Pass `plunge`: replaces runs on which the blade has no room to move by one plunge cut, without motion.
//!
//! Needs runs with their overlaps. Leaves no run that the plunged blade covers: L + F + H <= w on a straight run, no point of
//! the path at the distance w from its start on a curved one. The surplus length of the blade lies first along its own line
//! where that goes on straight, then in the waste as far as there is room, then where it reaches least deep into any part.
//! Plunges of a nibbled curve that cut nothing new are omitted. A surplus in a part gives a warning, or an error where the
//! profile does not allow it.

use super::continuation::continuations;
use super::pass::ToolpathPass;
use super::scene::Scene;
use super::spare;
use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::BladePlacement;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::polyline;
use crate::ir::toolpath::{End, Overcut, PlungeCut, Pose, Run, Shape, Side, Step, Toolpath};
use crate::machine::Knife;
use crate::units::number::fixed;

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "plunge",
    about: "makes plunge cuts of short runs, what the blade is longer by in the waste",
    run,
    chained: false,
};

/// Share of `verify.max_uncut_mm` within which two blades meet; the rest allows for rounding.
const THREAD_SHARE: f64 = 0.9;

fn run(toolpath: &mut Toolpath, scene: &Scene, diagnostics: &mut Diagnostics) {
    let around = scene.around(toolpath);
    for i in 0..toolpath.steps.len() {
        let Step::Run(run) = &toolpath.steps[i] else { continue };
        if run.shape == Shape::Open {
            let beyond = continuations(&toolpath.steps, i, run, &around);
            if let Some(cut) = BladePlacement::along_line(run, [run.heel, run.front], beyond, &around) {
                toolpath.steps[i] = Step::PlungeCut(plunge_cut(run, &cut, &around));
            }
        }
    }
    let verify = &scene.job.profile.verify;
    spare::leave_out(&mut toolpath.steps, &around, THREAD_SHARE * verify.max_uncut_mm);
    let plunge_cuts = toolpath.steps.iter().filter_map(|step| match step {
        Step::PlungeCut(plunge_cut) => Some(plunge_cut),
        Step::Run(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => None,
    });
    let exceeds = |depth: f64, cap: Option<f64>| cap.is_some_and(|cap| depth > cap);
    for plunge_cut in plunge_cuts.filter(|plunge_cut| depth(plunge_cut).deepest() > 0.0) {
        let Overcut { own, other } = depth(plunge_cut);
        let is_refused = exceeds(own, verify.max_overcut_part_mm) || exceeds(other, verify.max_overcut_neighbour_mm);
        diagnostics.push(said(plunge_cut, is_refused, around.knife));
    }
}

/// Plunge cut that replaces a run.
fn plunge_cut(run: &Run, cut: &BladePlacement, around: &Surroundings) -> PlungeCut {
    let end = |i: usize| {
        let is_in_part = cut.overcut[i].deepest() > 0.0 && run.ends[i].side != Side::Contour;
        End { side: if is_in_part { Side::Part } else { run.ends[i].side }, ..run.ends[i] }
    };
    PlungeCut {
        points: run.points.clone(),
        spans: run.spans.clone(),
        along: cut.along,
        front: cut.beyond[1],
        heel: cut.beyond[0],
        ends: [end(0), end(1)],
        turned: run.turned,
        edge: run.edge,
        overcut: cut.overcut,
        pose: Pose { centre: cut.tip - cut.along * around.knife.radius(), ..Pose::default() },
    }
}

/// Depth of a plunge cut in parts, mm; the greater one of both ends.
fn depth(plunge_cut: &PlungeCut) -> Overcut {
    plunge_cut.overcut[0].max(plunge_cut.overcut[1])
}

/// Depths of a plunge cut in parts and the ends where they occur, in words.
fn beyond(plunge_cut: &PlungeCut) -> String {
    // Ends in the direction of the drawing.
    let ends =
        if plunge_cut.turned { ["past its end", "before its start"] } else { ["before its start", "past its end"] };
    let overcuts = plunge_cut.overcut.into_iter().zip(ends).filter(|(overcut, _)| overcut.deepest() > 0.0);
    let said = |(Overcut { own, other }, end): (Overcut, &str)| {
        let said = [(own, "its own part"), (other, "another part")].into_iter().filter(|(depth, _)| *depth > 0.0);
        let said: Vec<String> = said.map(|(depth, part)| format!("{} mm into {part}", fixed(depth, 2))).collect();
        format!("{} {end}", said.join(" and "))
    };
    overcuts.map(said).collect::<Vec<String>>().join(", ")
}

/// Warning or error of a plunge cut into a part.
fn said(plunge_cut: &PlungeCut, is_refused: bool, knife: &Knife) -> Diagnostic {
    let (code, hint) = if is_refused {
        let keys = "`verify.max_overcut_part_mm` and `verify.max_overcut_neighbour_mm` allow more";
        (&code::PATH_OVERCUT_REFUSED, format!("a narrower blade cuts less deep; {keys}"))
    } else {
        (&code::PATH_OVERCUT, "a narrower blade cuts less deep".to_owned())
    };
    let (length, width) = (fixed(polyline::length(&plunge_cut.points), 2), fixed(knife.width_mm, 2));
    let beyond = beyond(plunge_cut);
    let message = format!("the blade of {width} mm is longer than this cut of {length} mm: it cuts {beyond}");
    let span = plunge_cut.spans[plunge_cut.spans.len() - 1];
    Diagnostic::new(code, message).at(span).by(depth(plunge_cut).deepest()).hint(hint)
}
