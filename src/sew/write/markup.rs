//! Helpers for SVG: formatting of numbers, and colours of speeds.

use crate::geom::{Extent, Point};
use crate::machine::Job;
use crate::sew::program::Program;
use crate::units::number;

/// Decimals of coordinates, mm.
const DECIMALS: u32 = 2;
/// Hues of the minimum and maximum speed, degrees: blue is slow, red is fast.
const HUES: [f64; 2] = [240.0, 0.0];

/// Formats a coordinate or length in mm.
pub(super) fn mm(value: f64) -> String {
    number::fixed(value, DECIMALS)
}

/// Path data of a polyline.
pub(super) fn path(points: impl IntoIterator<Item = Point>) -> String {
    let mut data = String::new();
    for point in points {
        data.push(if data.is_empty() { 'M' } else { ' ' });
        data.extend([&mm(point.x), ",", &mm(point.y)]);
    }
    data
}

/// Colour of a speed between the minimum and maximum of a program.
pub(super) fn color(rpm: f64, [least, most]: [f64; 2]) -> String {
    let share = if most > least { (rpm - least) / (most - least) } else { 1.0 };
    let hue = HUES[0] + (HUES[1] - HUES[0]) * share.clamp(0.0, 1.0);
    format!("hsl({},85%,42%)", number::fixed(hue, 0))
}

/// Minimum and maximum sewing speed of a program, stitches per minute; zeros if it sews nothing.
pub(super) fn speeds(program: &Program, job: &Job) -> [f64; 2] {
    let rpm = program.moves(job).map(|entry| entry.rpm).filter(|&rpm| rpm > 0.0);
    let [least, most] = rpm.fold([f64::INFINITY, 0.0], |[least, most], rpm| [least.min(rpm), f64::max(most, rpm)]);
    if least <= most { [least, most] } else { [0.0; 2] }
}

/// Bounding box of all needle points.
pub(super) fn extent(program: &Program) -> Extent {
    let mut extent = Extent::EMPTY;
    program.stitches.steps.iter().for_each(|step| extent.add(step.to));
    extent
}
