//! The few things that pictures ask of numbers, and the colours of heads.

use crate::geom::{Extent, Point};
use crate::ir::Marker;
use crate::units::number;

/// Decimals of coordinates, mm or px.
const DECIMALS: u32 = 2;
/// Hues of heads follow each other by the golden angle, degrees: neighbours differ, however many there are.
const HUE_STEP: f64 = 137.507_764;
/// A whole turn of hues, degrees.
const TURN_DEG: f64 = 360.0;

/// A coordinate or length.
pub(super) fn mm(value: f64) -> String {
    number::fixed(value, DECIMALS)
}

/// A polyline's data.
pub(super) fn path(points: impl IntoIterator<Item = Point>) -> String {
    let mut data = String::new();
    for point in points {
        data.push(if data.is_empty() { 'M' } else { ' ' });
        data.extend([&mm(point.x), ",", &mm(point.y)]);
    }
    data
}

/// The colour of a head, by its place in the plan.
pub(super) fn color(head: usize) -> String {
    format!("hsl({},70%,40%)", number::fixed((head as f64 * HUE_STEP) % TURN_DEG, 0))
}

/// The box around all cuts; a point where there are none.
pub(super) fn extent(marker: &Marker) -> Extent {
    let mut extent = Extent::EMPTY;
    for cut in &marker.cuts {
        marker.list.points(cut.range).iter().for_each(|&point| extent.add(point));
    }
    if extent.is_empty() { Extent::of(&[Point::origin()]) } else { extent }
}
