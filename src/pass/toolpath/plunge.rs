//! Pass `plunge`: runs on which the blade has nowhere to go between plunge and lift become one plunge cut, without motion.
//!
//! Needs runs with their overlaps. Leaves no run that the blade covers where it plunges: L + F + H <= w on a straight
//! one, no point of the path at the distance w from its start on a curved one. What the blade is longer by goes into
//! the waste as far as there is room, and never into another part that can be spared. What cuts into a part by more
//! than the tolerance is warned of.

use super::pass::ToolpathPass;
use super::scene::Scene;
use super::worst::Worst;
use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::BladePlacement;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::polyline;
use crate::ir::toolpath::{End, Overcut, PlungeCut, Pose, Run, Shape, Side, Step, Toolpath};
use crate::units::number::fixed;

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "plunge",
    about: "makes plunge cuts of short runs, what the blade is longer by in the waste",
    run,
    chained: false,
};

fn run(toolpath: &mut Toolpath, scene: &Scene, diagnostics: &mut Diagnostics) {
    let around = scene.around(toolpath);
    for step in &mut toolpath.steps {
        match step {
            Step::Run(run) if run.shape == Shape::Open => {
                if let Some(cut) = BladePlacement::of(run, [run.heel, run.front], &around) {
                    *step = Step::PlungeCut(plunge_cut(run, &cut, &around));
                }
            }
            Step::Run(_) | Step::PlungeCut(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {}
        }
    }
    let plunge_cuts = toolpath.steps.iter().filter_map(|step| match step {
        Step::PlungeCut(plunge_cut) => Some(plunge_cut),
        Step::Run(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => None,
    });
    let mut overcuts = Worst::default();
    for plunge_cut in plunge_cuts.filter(|plunge_cut| total(plunge_cut) > around.tolerance) {
        // What cuts into another part is worse than any cut into its own.
        overcuts.see(plunge_cut, |plunge_cut| [other(plunge_cut), total(plunge_cut)]);
    }
    if let Some(warning) = overcut_warning(&overcuts, &around) {
        diagnostics.push(warning);
    }
}

/// The step of a run that is cut by one plunge.
fn plunge_cut(run: &Run, cut: &BladePlacement, around: &Surroundings) -> PlungeCut {
    let end = |i: usize| {
        let is_in_part = cut.overcut[i].total() > 0.0;
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

/// How far a plunge cut goes into parts beyond its ends, both together, mm.
fn total(plunge_cut: &PlungeCut) -> f64 {
    plunge_cut.overcut.into_iter().map(Overcut::total).sum()
}

/// How far into others than its own, mm.
fn other(plunge_cut: &PlungeCut) -> f64 {
    plunge_cut.overcut.into_iter().map(|overcut| overcut.other).sum()
}

/// Where it does, in words.
fn beyond(plunge_cut: &PlungeCut) -> String {
    // As it is drawn.
    let ends =
        if plunge_cut.turned { ["past its end", "before its start"] } else { ["before its start", "past its end"] };
    let overcuts = plunge_cut.overcut.into_iter().zip(ends);
    let overcuts = overcuts.filter(|(overcut, _)| overcut.total() > 0.0);
    let overcuts: Vec<String> =
        overcuts.map(|(overcut, end)| format!("{} mm {end}", fixed(overcut.total(), 2))).collect();
    let overcuts = overcuts.join(" and ");
    if other(plunge_cut) > 0.0 {
        format!("{overcuts}, {} mm of that into another part", fixed(other(plunge_cut), 2))
    } else {
        format!("{overcuts}, into its own part")
    }
}

/// Warns of the worst overcut of a toolpath; `None` when there is none.
fn overcut_warning(overcuts: &Worst<&PlungeCut>, around: &Surroundings) -> Option<Diagnostic> {
    let plunge_cut = overcuts.place()?;
    let (length, width) = (fixed(polyline::length(&plunge_cut.points), 2), fixed(around.knife.width_mm, 2));
    let (beyond, more) = (beyond(plunge_cut), overcuts.and_more());
    let message = format!("the blade of {width} mm is longer than this cut of {length} mm: it cuts {beyond}{more}");
    Some(
        Diagnostic::new(&code::PATH_OVERCUT, message)
            .at(plunge_cut.spans[plunge_cut.spans.len() - 1])
            .by(plunge_cut.overcut.into_iter().map(Overcut::total).fold(0.0, f64::max))
            .hint("a narrower blade cuts less far"),
    )
}
