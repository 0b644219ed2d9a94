//! Formatting of numbers for pictures, and the colours of heads.

use crate::geom::{Extent, Point};
use crate::ir::Marker;
use crate::units::number;

/// Decimals of coordinates, mm or px.
const DECIMALS: u32 = 2;
/// Step between the hues of consecutive heads, degrees: the golden angle, so that neighbours differ for any number of heads.
const HUE_STEP: f64 = 137.507_764;
/// Full turn of hues, degrees.
const TURN_DEG: f64 = 360.0;

/// A formatted coordinate or length.
pub(super) fn mm(value: f64) -> String {
    number::fixed(value, DECIMALS)
}

/// SVG path data of a polyline.
pub(super) fn path(points: impl IntoIterator<Item = Point>) -> String {
    let mut data = String::new();
    for point in points {
        data.push(if data.is_empty() { 'M' } else { ' ' });
        data.extend([&mm(point.x), ",", &mm(point.y)]);
    }
    data
}

/// Colour of a head, by its index in the plan.
pub(super) fn color(head: usize) -> String {
    format!("hsl({},70%,40%)", number::fixed((head as f64 * HUE_STEP) % TURN_DEG, 0))
}

/// Bounding box of all cuts; the origin if there are none.
pub(super) fn extent(marker: &Marker) -> Extent {
    let mut extent = Extent::EMPTY;
    for cut in &marker.cuts {
        marker.list.points(cut.range).iter().for_each(|&point| extent.add(point));
    }
    if extent.is_empty() { Extent::of(&[Point::origin()]) } else { extent }
}
