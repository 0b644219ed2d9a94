//! Extension of a slit past its root, so that it meets the cut of the edge where it begins.
//!
//! Slit and edge may be cut off their lines to opposite sides: each by the tolerance, the edge also by the sagitta of its chord
//! where that stands for a curve, and by the bow of a curve away from the blade that is plunged at the corner where it begins.

use super::scene::Scene;
use crate::analysis::bulge::bulge;
use crate::analysis::plunge::Plunge;
use crate::geom::{Point, Vector, cross, polyline};
use crate::ir::marker::CutKind;
use crate::machine::Fit;

/// Least sine of the angle between a slit and its edge: at flatter angles the extension would have no bound.
const LEAST_SINE: f64 = 0.4;

/// Length by which a slit of a part extends past its root along a unit vector, mm: at most the longest overlap plus the
/// tolerance. A root that is on no edge of its own part lies on a neighbour's edge, for which the greatest sagitta is assumed.
pub(super) fn reach(root: Point, along: Vector, part: u32, tolerance: f64, scene: &Scene) -> f64 {
    let profile = &scene.job.profile;
    let edges = scene.marker.cuts_of(part).iter().filter(|cut| cut.kind != CutKind::Slit);
    let beside = |points: &[Point]| {
        let away = |i: usize| polyline::distance_to_segment(root, points[i], points[i + 1]);
        let chords = (0..points.len() - 1).filter(|&i| away(i) <= profile.verify.max_uncut_mm);
        let sine = |i: usize| polyline::direction(points[i], points[i + 1]).map_or(0.0, |way| cross(way, along).abs());
        let aside = |i: usize| away(i) + sagitta(points, i, scene).max(bow(points, i, root, scene)) + tolerance;
        chords.map(|i| aside(i) / sine(i).max(LEAST_SINE)).reduce(f64::max)
    };
    let reaches = edges.filter_map(|cut| beside(&scene.marker.list.points(cut.range)));
    let longest = profile.knife.most_overlaps().into_iter().fold(0.0, f64::max) + tolerance;
    reaches.reduce(f64::max).unwrap_or(tolerance + most(scene)).min(longest)
}

/// Distance of a root on a chord from the blade that is plunged at the corner before or behind it, mm; 0 where neither is
/// within its width.
fn bow(points: &[Point], chord: usize, root: Point, scene: &Scene) -> f64 {
    let width = scene.job.profile.knife.width_mm;
    let [behind, ahead] = [side(points, chord, false, scene), side(points, chord + 1, true, scene)];
    let path: Vec<Point> = behind.iter().rev().chain(&ahead).copied().collect();
    let back: Vec<Point> = path.iter().rev().copied().collect();
    let bow = |path: &[Point]| {
        let is_under = (path[0] - root).norm() <= width;
        if is_under { Plunge::at_start(path, width).distance(root) } else { 0.0 }
    };
    bow(&path).max(bow(&back))
}

/// Vertices of a line from one on, ahead or back, up to a corner, the end of the line or two blades from where they start.
fn side(points: &[Point], from: usize, is_ahead: bool, scene: &Scene) -> Vec<Point> {
    let (reach, angle) = (2.0 * scene.job.profile.knife.width_mm, scene.job.profile.corner_angle());
    let last = points.len() - 1;
    // A closed polyline ends with its first point.
    let is_closed = points[0] == points[last];
    let vertex = |place: isize| {
        let place = if is_closed { place.rem_euclid(last as isize) } else { place };
        usize::try_from(place).ok().and_then(|place| points.get(place).copied())
    };
    let step = if is_ahead { 1 } else { -1 };
    let mut side = Vec::new();
    let mut place = from as isize;
    while let Some(point) = vertex(place).filter(|_| side.len() < points.len()) {
        side.push(point);
        let beside = vertex(place - 1).zip(vertex(place + 1));
        if beside.is_none_or(|(before, behind)| polyline::turn_at(before, point, behind).abs() >= angle)
            || (point - side[0]).norm() > reach
        {
            break;
        }
        place += step;
    }
    side
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
