//! Overlaps that leave the table while the lines lie on it, reported before anything is planned.
//!
//! The verifier judges every instant of the program. This check covers only the two ends of each open cut and each plunge,
//! where overlaps reach farthest, so that a marker that must be moved is refused at once.

use super::toolpaths::Toolpaths;
use super::{off_table, place};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Point, Vector};
use crate::ir::Marker;
use crate::ir::toolpath::{Shape, Step, Toolpath};
use crate::machine::{Job, Table};
use crate::source::{Source, Span};
use crate::units::number::up;

/// Decimals of distances in messages, mm.
const DECIMALS: u32 = 1;

/// Hint on a marker that lies too near to an edge of the table.
pub(super) const LAY: &str =
    "have the marker laid as far from the edges as the blade reaches: sheet.origin = \"corner\"";

/// End of a cut that lies farthest off the table.
struct Farthest {
    /// Distance from the table, mm.
    off: f64,
    at: Point,
    span: Span,
}

/// True if a marker may be placed elsewhere on the table.
pub(super) fn may_lay(job: &Job) -> bool {
    job.profile.sheet.origin.is_some() && job.marks.is_none()
}

/// Refuses a marker whose overlaps leave the table by more than the blade may.
pub(super) fn check(marker: &Marker, source: &Source, job: &Job, diagnostics: &mut Diagnostics) {
    let profile = &job.profile;
    if diagnostics.has_errors() || !job.mode.cuts() || !may_leave(marker, job) {
        return;
    }
    let mut toolpaths = Toolpaths::new(marker, job);
    let (mut drawing, mut linking) = toolpaths.stages();
    let mut worst: Option<Farthest> = None;
    let stations = marker.stations();
    while let Some(window) = drawing.next() {
        for toolpath in linking.link(window).toolpaths {
            let station = stations.get(toolpath.part as usize).copied().unwrap_or(0);
            // The planner moves an end by up to the tolerance.
            let least = Table::EDGE_MM + toolpath.tolerance;
            for end in ends(&toolpath, station, &profile.table).filter(|end| end.off > least) {
                if worst.as_ref().is_none_or(|worst| end.off > worst.off) {
                    worst = Some(end);
                }
            }
        }
    }
    let Some(Farthest { off, at, span }) = worst else { return };
    let known = diagnostics.iter().len();
    let by = up(off, DECIMALS);
    let message = format!("the blade leaves the table by {by} mm where it cuts beyond the end of a line");
    let mut finding = Diagnostic::new(&code::MARKER_OFF_TABLE, message).at(span).on_cloth(at).by(off);
    if may_lay(job) {
        finding = finding.hint(LAY);
    }
    diagnostics.push(finding.hint(off_table::advice(marker, job)));
    place::place(diagnostics, known, marker, source, job);
}

/// True if an end of the blade could be off the table anywhere: in most jobs the table ends far from the marker.
fn may_leave(marker: &Marker, job: &Job) -> bool {
    let (table, extent) = (&job.profile.table, marker.extent_on_table());
    let off = table.off(extent.min.into()).max(table.off(extent.max.into()));
    !extent.is_empty() && off + job.profile.knife.reach() > Table::EDGE_MM
}

/// Both ends of the blade's reach in each open cut and each plunge, with their distances from the table; `station` is the
/// advance of the cloth by then, mm.
fn ends<'a>(toolpath: &'a Toolpath, station: u32, table: &'a Table) -> impl Iterator<Item = Farthest> + 'a {
    let moved_on = Vector::new(f64::from(station), 0.0);
    let reached = |step: &Step| -> Option<([Point; 2], [Span; 2])> {
        match step {
            Step::Run(run) if run.shape == Shape::Open => {
                let points = run.extended();
                Some(([points[0], points[points.len() - 1]], [run.spans[0], run.spans[run.spans.len() - 1]]))
            }
            Step::PlungeCut(cut) => {
                let [first, last] = [cut.points[0], cut.points[cut.points.len() - 1]];
                let ends = [first - cut.along * cut.heel, last + cut.along * cut.front];
                Some((ends, [cut.spans[0], cut.spans[cut.spans.len() - 1]]))
            }
            _ => None,
        }
    };
    toolpath.steps.iter().filter_map(reached).flat_map(move |(ends, spans)| {
        ends.into_iter().zip(spans).map(move |(at, span)| Farthest { off: table.off((at - moved_on).into()), at, span })
    })
}
