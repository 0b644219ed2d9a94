//! What is said when no line of a plot is cut: which pens it has, and what left them out.

use super::drawing::{Drawing, NO_PEN};
use crate::diagnostic::{Diagnostic, code};
use crate::machine::Job;
use crate::machine::plot::LineKind;

/// Most pens that a message names.
const SHOWN_PENS: usize = 8;

/// The pens that draw, in the order of their numbers, each once.
pub(super) fn pens(drawing: &Drawing) -> Vec<u16> {
    let mut pens: Vec<u16> = drawing.strokes.iter().map(|stroke| stroke.pen).collect();
    pens.sort_unstable();
    pens.dedup();
    pens
}

/// The finding, for a plot of some pens.
pub(super) fn finding(pens: &[u16], job: &Job) -> Diagnostic {
    if pens.is_empty() {
        let finding = Diagnostic::new(&code::HPGL_NOTHING_TO_CUT, "the plot draws no line");
        return finding.hint("check that the export finished, and that it was not told to leave out the outlines");
    }
    let finding = Diagnostic::new(&code::HPGL_NOTHING_TO_CUT, "no line of the plot is taken for something to cut");
    let held: Vec<u16> = pens.iter().copied().filter(|pen| *pen != NO_PEN).collect();
    let Some(&first) = held.first() else {
        return finding.hint("every line is drawn while no pen is taken (SP0); let the CAD take pen 1 for outlines");
    };
    let drawn = format!("the file draws with {}", named(&held));
    if let Some(only) = &job.lines.pens
        && !held.iter().any(|&pen| only.has(pen.into()))
    {
        return finding.hint(format!("`--cut-pens {only}` leaves all lines out: {drawn}"));
    }
    match job.lines.kind {
        Some(LineKind::Closed) => finding.hint(format!("`--cut closed` leaves out every open line; {drawn}")),
        Some(LineKind::Open) => finding.hint(format!("`--cut open` leaves out every closed line; {drawn}")),
        Some(LineKind::All) | None if held.iter().all(|&pen| job.profile.hpgl.pen(pen).is_some()) => {
            let all = listed(&held);
            finding.hint(format!("`hpgl.pens` of the profile leaves them out; {drawn}; `--cut-pens {all}` cuts them"))
        }
        Some(LineKind::All) | None => {
            finding.hint(format!("{drawn}; `--cut all` cuts every line, `--cut-pens {first}` those of a pen"))
        }
    }
}

/// `pen 1`, `pens 1,4`.
fn named(pens: &[u16]) -> String {
    match pens {
        [one] => format!("pen {one}"),
        pens => format!("pens {}{}", listed(pens), if pens.len() > SHOWN_PENS { " and others" } else { "" }),
    }
}

/// As `--cut-pens` takes them.
fn listed(pens: &[u16]) -> String {
    let numbers: Vec<String> = pens.iter().take(SHOWN_PENS).map(u16::to_string).collect();
    numbers.join(",")
}
