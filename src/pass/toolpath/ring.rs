//! Pass `ring`: begins a smooth closed contour where its plunge does least harm.
//!
//! Needs runs split at corners. Leaves rings at their start in the file, unless the heel of the blade, which plunges along the
//! tangent, would stand in a part there. Such a ring begins where the heel stands least deep, in the waste or on a straight
//! stretch if possible; among equals at the nearest place.

use super::pass::ToolpathPass;
use super::runs;
use super::scene::Scene;
use super::stretch::Way;
use crate::analysis::cloth::Surroundings;
use crate::diagnostic::Diagnostics;
use crate::geom::polyline;
use crate::ir::toolpath::{OrientationMode, Run, Shape, Toolpath};

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "ring",
    about: "begins smooth closed contours where the plunge harms least",
    run,
    chained: false,
};

/// Greatest number of places tried as the start of a ring, evenly spaced.
const STARTS: usize = 360;
/// Distance before and behind a place between which its direction is taken, mm: nearer points show only their rounding.
const LOOK: f64 = 0.5;
/// Difference of depths that count as equal, mm: too small to be noticed.
const SAME_DEPTH: f64 = 0.1;

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    let around = scene.around(toolpath);
    for run in runs::each(toolpath) {
        if let (Shape::Ring, OrientationMode::Tangent) = (run.shape, run.orientation)
            && let Some(begun) = begun(run, &around)
        {
            *run = begun;
        }
    }
}

/// Ring with its start moved; `None` if no place is better than its own.
fn begun(run: &Run, around: &Surroundings) -> Option<Run> {
    let width = around.knife.width_mm;
    let way = Way::new(run);
    let depth = |station: f64| {
        let [from, to] = [way.place(station - LOOK), way.place(station + LOOK)];
        let along = polyline::direction(from, to).unwrap_or_else(|| run.points[1] - run.points[0]);
        around.depths(way.place(station) - along * width, width).deepest()
    };
    let here = depth(0.0);
    if here <= SAME_DEPTH {
        return None;
    }
    let chords = way.chords();
    let middle = |chord: usize| f64::midpoint(way.station(chord.cast_signed()), way.station(chord.cast_signed() + 1));
    let starts = (0..chords).step_by(chords.div_ceil(STARTS)).map(middle);
    let starts: Vec<(f64, f64)> = starts.map(|station| (station, depth(station))).collect();
    let least = starts.iter().map(|start| start.1).fold(f64::INFINITY, f64::min);
    if least > here - SAME_DEPTH {
        return None;
    }
    let away = |station: f64| station.min(way.length() - station);
    let alike = starts.iter().filter(|start| start.1 <= least + SAME_DEPTH).map(|start| start.0);
    let best = alike.min_by(|&a, &b| away(a).total_cmp(&away(b)))?;
    Some(way.ring_from(best))
}
