//! Warnings of swings: bends behind which the heel of the blade leaves its line visibly.

use crate::analysis::swing::Swing;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::ir::Toolpath;
use crate::ir::toolpath::Run;
use crate::machine::Knife;
use crate::units::number::up;

/// Greatest swing without a warning, mm: it is not noticed on any seam allowance.
const WORTH: f64 = 3.0;

/// Warns of the worst swing of the runs of a toolpath, unless a curve tighter than the blade is reported already.
pub(super) fn warn(toolpath: &Toolpath, swings: &[Option<Swing>], knife: &Knife, found: &mut Diagnostics) {
    let swings = toolpath.runs().zip(swings).filter_map(|(run, swing)| Some((run, (*swing)?)));
    let swings: Vec<(&Run, Swing)> = swings.filter(|(_, swing)| swing.off > WORTH).collect();
    let Some((run, worst)) = swings.iter().copied().reduce(|a, b| if b.1.off > a.1.off { b } else { a }) else {
        return;
    };
    if found.iter().any(|finding| finding.code == &code::PATH_TIGHT_CURVE) {
        return;
    }
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
