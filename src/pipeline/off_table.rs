//! Advice about a blade that leaves the table.

use crate::ir::Marker;
use crate::machine::Job;
use crate::units::number::{exact, fixed, up};

/// Resolution of a position in messages, steps per mm.
const STEPS_PER_MM: f64 = 10.0;

/// Axis along which the marker has too little room beside its lines.
struct Tight {
    name: &'static str,
    /// Distance by which to move the marker, mm.
    by: f64,
    /// Total room that the table leaves beside the marker, mm, and true if the blade needs more.
    left: f64,
    is_short: bool,
}

/// Advice on moving the marker away from the edges of the table by the reach of the blade beyond its lines; for both axes at
/// once, so that it need not be repeated.
pub(super) fn advice(marker: &Marker, job: &Job) -> String {
    let (reach, table, extent) = (job.profile.knife.reach(), &job.profile.table, marker.extent_on_table());
    let axes = [("X", table.x_mm, [extent.min.x, extent.max.x]), ("Y", table.y_mm, [extent.min.y, extent.max.y])];
    let tight = axes.map(|(name, ends, lies)| {
        let [before, behind] = ends.map(|[least, most]| [lies[0] - least, most - lies[1]])?;
        let spare = reach.min(f64::midpoint(before, behind));
        let by = if before < spare { spare - before } else { (behind - spare).min(0.0) };
        let is_tight = before.min(behind) < reach;
        is_tight.then_some(Tight { name, by, left: before + behind, is_short: before + behind < 2.0 * reach })
    });
    let short: Vec<String> =
        tight.iter().flatten().filter(|axis| axis.is_short).map(|axis| short(axis, reach)).collect();
    if !short.is_empty() {
        return format!("{}; choose a wider table, smaller overlaps or another turn of the marker", short.join(", "));
    }
    let ways: Vec<String> = tight.iter().flatten().map(way).collect();
    let way = if ways.is_empty() { "away from that edge".to_owned() } else { format!("by {}", ways.join(" and ")) };
    let by = tight.map(|axis| axis.map_or(0.0, |axis| axis.by));
    if job.marks.is_some() {
        return format!(
            "move the cloth {way}, and find its marks again: so far the blade may reach beyond its lines there"
        );
    }
    let key = match job.profile.sheet.origin {
        Some([x, y]) => format!("sheet.origin = [{}, {}]", place(x, by[0]), place(y, by[1])),
        None => "`sheet.origin`".to_owned(),
    };
    format!("move the marker {way}: {key}; so far the blade may reach beyond its lines there")
}

/// Message about too little room on the table.
fn short(axis: &Tight, reach: f64) -> String {
    let [left, needed] = [axis.left, 2.0 * reach].map(|room| fixed(room, 1));
    format!("along {} the table leaves {left} mm beside the marker, and the blade may need {needed} mm", axis.name)
}

/// Displacement along an axis, rounded up.
fn way(axis: &Tight) -> String {
    let sign = if axis.by < 0.0 { '-' } else { '+' };
    format!("{} {sign}{} mm", axis.name, up(axis.by.abs(), 1))
}

/// Coordinate of the origin after a displacement.
fn place(from: f64, by: f64) -> String {
    let steps = (by.abs() * STEPS_PER_MM).ceil().copysign(by);
    exact(((from + steps / STEPS_PER_MM) * 1e3).round() / 1e3)
}
