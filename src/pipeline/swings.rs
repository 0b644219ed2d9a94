//! Warnings of swings: bends behind which the heel of the blade leaves its line visibly.

use crate::analysis::swing::{Swing, swing};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::Toolpath;
use crate::ir::declaration::{Declaration, Kind};
use crate::ir::toolpath::{Run, Step};
use crate::machine::Knife;
use crate::units::number::up;

/// Greatest swing without a warning, mm: it is not noticed on any seam allowance.
const WORTH: f64 = 3.0;

/// Warns of the worst swing of a toolpath that declares one, unless a curve tighter than the blade is reported already.
pub(super) fn warn(toolpath: &Toolpath, declared: &[Declaration], knife: &Knife, found: &mut Diagnostics) {
    let is_worth = |entry: &Declaration| entry.kind == Kind::Swing && entry.magnitude_mm > WORTH;
    let is_told = || found.iter().any(|finding| finding.code == &code::PATH_TIGHT_CURVE);
    if !declared.iter().any(is_worth) || is_told() {
        return;
    }
    let runs = toolpath.steps.iter().filter_map(|step| if let Step::Run(run) = step { Some(run) } else { None });
    let swings = runs.filter_map(|run| Some((run, swing(run, knife.width_mm)?)));
    let swings: Vec<(&Run, Swing)> = swings.filter(|(_, swing)| swing.off > WORTH).collect();
    let Some((run, worst)) = swings.iter().copied().reduce(|a, b| if b.1.off > a.1.off { b } else { a }) else {
        return;
    };
    let by = up(worst.off, 2);
    let more = match swings.len() - 1 {
        0 => String::new(),
        n => format!(" ({n} more in this contour)"),
    };
    let message = format!("the heel leaves its line by {by} mm at a bend{more}");
    // Block that leads to the bend in the file.
    let chord = if run.turned { worst.vertex } else { worst.vertex.checked_sub(1).unwrap_or(run.spans.len() - 1) };
    let finding = Diagnostic::new(&code::PATH_SWING, message).at(run.spans[chord]).by(worst.off);
    let finding = finding.on_cloth(run.points[worst.vertex]);
    found.push(finding.hint(match knife.max_swing_mm {
        None => "`knife.max_swing_mm = 3` lifts the knife at such bends as at corners",
        Some(_) => "a lower `knife.max_swing_mm` lifts the knife at this bend, too",
    }));
}
