//! Pass `stab`: runs on which the blade has nowhere to go between plunge and lift become one plunge cut, without motion.
//!
//! Needs runs with their overlaps. Leaves no run that the blade covers where it plunges: L + F + H <= w on a straight one, no
//! point of the path at the distance w from its start on a curved one. What the blade is longer by goes into the waste as far
//! as there is room, and never into another part that can be spared. What cuts into a part by more than the tolerance is
//! warned of.

use super::pass::ToolpathPass;
use super::scene::Scene;
use super::worst::Worst;
use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::PlungeCut;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::polyline;
use crate::ir::toolpath::{End, Harm, Pose, Run, Shape, Side, Stab, Step, Toolpath};
use crate::units::number::fixed;

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "stab",
    about: "makes stabs of short runs, what the blade is longer by in the waste",
    run,
    chained: false,
};

fn run(toolpath: &mut Toolpath, scene: &Scene, diagnostics: &mut Diagnostics) {
    let around = scene.around(toolpath);
    for step in &mut toolpath.steps {
        match step {
            Step::Run(run) if run.shape == Shape::Open => {
                if let Some(cut) = PlungeCut::of(run, [run.heel, run.front], &around) {
                    *step = Step::Stab(stab(run, &cut, &around));
                }
            }
            Step::Run(_) | Step::Stab(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {}
        }
    }
    let stabs = toolpath.steps.iter().filter_map(|step| match step {
        Step::Stab(stab) => Some(stab),
        Step::Run(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => None,
    });
    let mut overcuts = Worst::default();
    for stab in stabs.filter(|stab| total(stab) > around.tolerance) {
        // What cuts into another part is worse than any cut into its own.
        overcuts.see(stab, |stab| [other(stab), total(stab)]);
    }
    if let Some(warning) = overcut_warning(&overcuts, &around) {
        diagnostics.push(warning);
    }
}

/// The step of a run that is cut by one plunge.
fn stab(run: &Run, cut: &PlungeCut, around: &Surroundings) -> Stab {
    let end = |i: usize| {
        let is_in_part = cut.overcut[i].total() > 0.0;
        End { side: if is_in_part { Side::Part } else { run.ends[i].side }, ..run.ends[i] }
    };
    Stab {
        points: run.points.clone(),
        spans: run.spans.clone(),
        along: cut.along,
        front: cut.beyond[1],
        heel: cut.beyond[0],
        ends: [end(0), end(1)],
        turned: run.turned,
        edge: run.edge,
        harm: cut.overcut,
        pose: Pose { centre: cut.tip - cut.along * around.knife.radius(), ..Pose::default() },
    }
}

/// How far a plunge cut goes into parts beyond its ends, both together, mm.
fn total(stab: &Stab) -> f64 {
    stab.harm.into_iter().map(Harm::total).sum()
}

/// How far into others than its own, mm.
fn other(stab: &Stab) -> f64 {
    stab.harm.into_iter().map(|overcut| overcut.other).sum()
}

/// Where it does, in words.
fn beyond(stab: &Stab) -> String {
    // As it is drawn.
    let ends = if stab.turned { ["past its end", "before its start"] } else { ["before its start", "past its end"] };
    let overcuts = stab.harm.into_iter().zip(ends);
    let overcuts = overcuts.filter(|(overcut, _)| overcut.total() > 0.0);
    let overcuts: Vec<String> =
        overcuts.map(|(overcut, end)| format!("{} mm {end}", fixed(overcut.total(), 2))).collect();
    let overcuts = overcuts.join(" and ");
    if other(stab) > 0.0 {
        format!("{overcuts}, {} mm of that into another part", fixed(other(stab), 2))
    } else {
        format!("{overcuts}, into its own part")
    }
}

/// Warns of the worst overcut of a toolpath; `None` when there is none.
fn overcut_warning(overcuts: &Worst<&Stab>, around: &Surroundings) -> Option<Diagnostic> {
    let stab = overcuts.place()?;
    let (length, width) = (fixed(polyline::length(&stab.points), 2), fixed(around.knife.width_mm, 2));
    let (beyond, more) = (beyond(stab), overcuts.and_more());
    let message = format!("the blade of {width} mm is longer than this cut of {length} mm: it cuts {beyond}{more}");
    Some(
        Diagnostic::new(&code::PATH_OVERCUT, message)
            .at(stab.spans[stab.spans.len() - 1])
            .by(stab.harm.into_iter().map(Harm::total).fold(0.0, f64::max))
            .hint("a narrower blade cuts less far"),
    )
}
