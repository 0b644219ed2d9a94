//! Pass `plunge`: replaces runs on which the blade has no room to move by one plunge cut, without motion.
//!
//! Needs runs with their overlaps. Leaves no run that the plunged blade covers: L + F + H <= w on a straight run, no point of
//! the path at the distance w from its start on a curved one. The surplus length of the blade lies first along its own line
//! where that goes on straight, then in the waste as far as there is room, then where it reaches least deep into any part.
//! Plunges of a nibbled curve that cut nothing new are omitted. A surplus in its own part gives a warning, one in other
//! parts another; either is an error where the profile does not allow it.

use super::continuation::continuation;
use super::pass::ToolpathPass;
use super::scene::Scene;
use super::spare;
use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::BladePlacement;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, PieceName, code};
use crate::geom::{Point, polyline};
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
            let continued = continuation(&toolpath.steps, i, run, &around);
            if let Some(cut) = BladePlacement::along_line(run, [run.heel, run.front], continued, &around) {
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
    for cut in plunge_cuts {
        let own = entries(cut, |overcut| overcut.own, |_| ("its own part".to_owned(), None));
        let other = entries(cut, |overcut| overcut.other, |end| neighbour(cut, end, toolpath.part, scene));
        let sides = [
            (own, &code::PATH_OVERCUT, verify.max_overcut_part_mm),
            (other, &code::PATH_OVERCUT_NEIGHBOUR, verify.max_overcut_neighbour_mm),
        ];
        for (entries, code, most) in sides {
            if let Some(found) = said(cut, &entries, (code, most), around.knife) {
                diagnostics.push(found);
            }
        }
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

/// Place at which a plunge cut enters a part.
struct Entry {
    /// Index of the end of the cut beyond which it lies.
    end: usize,
    /// Depth, mm.
    depth: f64,
    /// The part in words, and its number if it is another one.
    part: (String, Option<u32>),
}

/// Entries of a plunge cut into its own part or into others, the deepest first.
fn entries(
    cut: &PlungeCut,
    depth: impl Fn(Overcut) -> f64,
    part: impl Fn(usize) -> (String, Option<u32>),
) -> Vec<Entry> {
    let depths = cut.overcut.map(depth).into_iter().enumerate().filter(|(_, depth)| *depth > 0.0);
    let mut entries: Vec<Entry> = depths.map(|(end, depth)| Entry { end, depth, part: part(end) }).collect();
    entries.sort_by(|a, b| b.depth.total_cmp(&a.depth));
    entries
}

/// Ends of a plunge cut and of the blade, by the index of an end.
fn beyond(cut: &PlungeCut, end: usize) -> [Point; 2] {
    let [start, last] = [cut.points[0], cut.points[cut.points.len() - 1]];
    if end == 0 { [start, start - cut.along * cut.heel] } else { [last, last + cut.along * cut.front] }
}

/// The other part that a plunge cut enters beyond an end, with its number.
fn neighbour(cut: &PlungeCut, end: usize, piece: u32, scene: &Scene) -> (String, Option<u32>) {
    let other = scene.cloth.deepest_other(piece as usize, beyond(cut, end));
    let Some(other) = other.map(|other| &scene.marker.pieces[other as usize]) else {
        return ("another part".to_owned(), None);
    };
    let name = PieceName { number: other.number, copy: other.copy, label: None };
    (name.to_string(), Some(other.number))
}

/// Warning or error of a plunge cut that enters a part; `None` without an entry. `most` is the depth that the profile allows,
/// mm.
fn said(
    cut: &PlungeCut,
    entries: &[Entry],
    (code, most): (&'static Code, Option<f64>),
    knife: &Knife,
) -> Option<Diagnostic> {
    let deepest = entries.first()?;
    let (code, hint) = if most.is_some_and(|most| deepest.depth > most) {
        let keys = "`verify.max_overcut_part_mm` and `verify.max_overcut_neighbour_mm` allow more";
        (&code::PATH_OVERCUT_REFUSED, format!("a narrower blade cuts less deep; {keys}"))
    } else {
        (code, "a narrower blade cuts less deep".to_owned())
    };
    // Ends in the direction of the drawing.
    let ends = if cut.turned { ["past its end", "before its start"] } else { ["before its start", "past its end"] };
    let said = entries.iter().enumerate().map(|(i, Entry { end, depth, part })| {
        let is_known = i > 0 && entries[i - 1].part == *part;
        let into = if is_known { String::new() } else { format!("into {} ", part.0) };
        format!("{} mm {into}{}", fixed(*depth, 2), ends[*end])
    });
    let said = said.collect::<Vec<String>>().join(", ");
    let (length, width) = (fixed(polyline::length(&cut.points), 2), fixed(knife.width_mm, 2));
    let message = format!("the blade of {width} mm is longer than this cut of {length} mm: it cuts {said}");
    let [_, place] = beyond(cut, deepest.end);
    let found = Diagnostic::new(code, message).at(cut.spans[cut.spans.len() - 1]).on_cloth(place);
    let mut others: Vec<u32> = entries.iter().filter_map(|entry| entry.part.1).collect();
    others.dedup();
    Some(found.by(deepest.depth).about(others).hint(hint))
}
