//! Extension of a slit past its root, so that it meets the cut of the edge where it begins.
//!
//! Slit and edge may be cut off their lines to opposite sides: each by the tolerance, the edge also by the sagitta of its chord
//! where that stands for a curve, and by as much as the curve bows away from a blade that plunges at a corner beside the root.

use super::bow::Edge;
use super::scene::Scene;
use crate::analysis::bulge::bulge;
use crate::geom::{Point, Vector, cross, polyline};
use crate::ir::marker::CutKind;
use crate::machine::Fit;

/// Least sine of the angle between a slit and its edge: at flatter angles the extension would have no bound.
const LEAST_SINE: f64 = 0.4;

/// True if a slit of a part begins or ends at a place.
pub(super) fn is_of_slit(root: Point, part: u32, scene: &Scene) -> bool {
    let mut slits = scene.marker.cuts_of(part).iter().filter(|cut| cut.kind == CutKind::Slit);
    slits.any(|cut| scene.marker.list.ends_of(cut.range).contains(&root))
}

/// Length by which a slit of a part extends past its root along a unit vector, mm: at most the longest overlap plus the
/// tolerance. A root that is on no edge of its own part lies on a neighbour's edge, for which the greatest sagitta is assumed.
pub(super) fn reach(root: Point, along: Vector, part: u32, tolerance: f64, scene: &Scene) -> f64 {
    let profile = &scene.job.profile;
    let edges = scene.marker.cuts_of(part).iter().filter(|cut| cut.kind != CutKind::Slit);
    let beside = |points: &[Point]| {
        let away = |i: usize| polyline::distance_to_segment(root, points[i], points[i + 1]);
        let chords = (0..points.len() - 1).filter(|&i| away(i) <= profile.verify.max_uncut_mm);
        let sine = |i: usize| polyline::direction(points[i], points[i + 1]).map_or(0.0, |way| cross(way, along).abs());
        let reach = |i: usize| {
            let bow = Edge { points, scene }.bow(i, root, along);
            bow + (away(i) + sagitta(points, i, scene) + tolerance) / sine(i).max(LEAST_SINE)
        };
        chords.map(reach).reduce(f64::max)
    };
    let reaches = edges.filter_map(|cut| beside(&scene.marker.list.points(cut.range)));
    let longest = profile.knife.most_overlaps().into_iter().fold(0.0, f64::max) + tolerance;
    reaches.reduce(f64::max).unwrap_or(tolerance + most(scene)).min(longest)
}

/// Sagitta of a chord, mm; the greatest one at the ends of an open cut, whose turn there belongs to another cut.
fn sagitta(points: &[Point], chord: usize, scene: &Scene) -> f64 {
    let chords = points.len() - 1;
    let is_closed = points[0] == points[chords];
    // A closed polyline ends with its first point.
    let turn = |vertex: usize| {
        let inner = if vertex == 0 || vertex == chords { is_closed.then_some(0)? } else { vertex };
        let before = points[if inner == 0 { chords - 1 } else { inner - 1 }];
        Some(polyline::turn_at(before, points[inner], points[inner + 1]))
    };
    let (Some(before), Some(behind)) = (turn(chord), turn(chord + 1)) else { return most(scene) };
    bulge((points[chord + 1] - points[chord]).norm(), [before, behind], &scene.job.profile).abs()
}

/// Greatest sagitta of a chord, mm.
fn most(scene: &Scene) -> f64 {
    let path = &scene.job.profile.path;
    if path.fit == Fit::Curve { path.chord_sag_max_mm } else { 0.0 }
}
