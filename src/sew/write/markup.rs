//! The few things that SVG asks of numbers, and the colours of speeds.

use crate::geom::{Extent, Point};
use crate::machine::Job;
use crate::sew::program::Program;
use crate::units::number;

/// Decimals of coordinates, mm.
const DECIMALS: u32 = 2;
/// Least and greatest hue of speeds, degrees: blue is slow, red is fast.
const HUES: [f64; 2] = [240.0, 0.0];

/// A coordinate or length in mm.
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

/// The colour of a speed between the least and the greatest of a program.
pub(super) fn color(rpm: f64, [least, most]: [f64; 2]) -> String {
    let share = if most > least { (rpm - least) / (most - least) } else { 1.0 };
    let hue = HUES[0] + (HUES[1] - HUES[0]) * share.clamp(0.0, 1.0);
    format!("hsl({},85%,42%)", number::fixed(hue, 0))
}

/// The least and the greatest speed at which a program sews; zeros when it sews nothing.
pub(super) fn speeds(program: &Program, job: &Job) -> [f64; 2] {
    let rpm = program.moves(job).map(|entry| entry.rpm).filter(|&rpm| rpm > 0.0);
    let [least, most] = rpm.fold([f64::INFINITY, 0.0], |[least, most], rpm| [least.min(rpm), f64::max(most, rpm)]);
    if least <= most { [least, most] } else { [0.0; 2] }
}

/// The box around all needle points.
pub(super) fn extent(program: &Program) -> Extent {
    let mut extent = Extent::EMPTY;
    program.stitches.steps.iter().for_each(|step| extent.add(step.to));
    extent
}
