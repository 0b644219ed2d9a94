//! Check that the head stays over the table. It needs more space than the marker by its distance on each side.

use super::course::{Leg, Pass};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Extent, Point};
use crate::machine::{Job, Table};
use crate::units::number::fixed;

/// Reports the distance by which the head leaves the table, and how to move the marker. `None` if it leaves the table.
pub(super) fn report(passes: &[Pass], job: &Job, out: &mut Diagnostics) -> Option<()> {
    let table = &job.profile.table;
    let off = |leg: &Leg| table.off(leg.ends[0].at.into());
    let worst = passes.iter().flatten().max_by(|a, b| off(a).total_cmp(&off(b)))?;
    if off(worst) <= Table::EDGE_MM {
        return Some(());
    }
    let places: Vec<Point> = passes.iter().flatten().flat_map(|leg| leg.ends).map(|node| node.at).collect();
    let Extent { min, max } = Extent::of(&places);
    let moves = [([min.x, max.x], table.x_mm), ([min.y, max.y], table.y_mm)].map(|(lies, ends)| way(lies, ends));
    let (distance, beyond) = (fixed(job.profile.tool.distance_mm, 1), fixed(off(worst), 1));
    let message = format!("the head, {distance} mm outside the edges, leaves the table by {beyond} mm");
    let hint = match (moves, job.profile.sheet.origin) {
        ([Some(x), Some(y)], _) if job.marks.is_some() => {
            format!("move the cloth by {} mm in X and {} mm in Y, and find its marks again", fixed(x, 1), fixed(y, 1))
        }
        ([Some(x), Some(y)], None) => format!("move the marker by {} mm in X and {} mm in Y", fixed(x, 1), fixed(y, 1)),
        ([Some(x), Some(y)], Some(origin)) => {
            format!("set `sheet.origin` = [{}, {}]", fixed(origin[0] + x, 1), fixed(origin[1] + y, 1))
        }
        _ => "its way is larger than the table: take a smaller `tool.distance_mm`, or correct `table`".to_owned(),
    };
    out.push(Diagnostic::new(&code::MARKER_OFF_TABLE, message).hint(hint).by(off(worst)).on_cloth(worst.ends[0].at));
    None
}

/// Shortest move along an axis that brings an interval onto the table, mm, rounded up to a tenth; `None` if the interval is
/// longer than the table.
fn way([least, most]: [f64; 2], table: Option<[f64; 2]>) -> Option<f64> {
    /// Reported moves are rounded to a tenth of a millimetre.
    const STEP: f64 = 0.1;
    let Some([from, to]) = table else { return Some(0.0) };
    if most - least > to - from {
        return None;
    }
    let (up, down) = (((from - least) / STEP).ceil() * STEP, ((to - most) / STEP).floor() * STEP);
    Some(if up > 0.0 { up } else { down.min(0.0) })
}
