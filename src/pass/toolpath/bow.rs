//! Bow of an edge away from a blade that plunges at a corner and stands there as a chord of a curve.

use super::scene::Scene;
use crate::analysis::plunge::Plunge;
use crate::geom::corner::Corners;
use crate::geom::{Point, Vector, cross, polyline};

/// An edge of a part; a closed one ends with its first point.
pub(super) struct Edge<'a> {
    pub(super) points: &'a [Point],
    pub(super) scene: &'a Scene<'a>,
}

impl Edge<'_> {
    /// Distance from a place on a chord, along a unit vector, to a blade that plunges at a corner on either side of it, mm; 0 if
    /// none lies ahead.
    pub(super) fn bow(&self, chord: usize, from: Point, along: Vector) -> f64 {
        let knife = &self.scene.job.profile.knife;
        let ahead = |path: Vec<Point>| {
            let Some(way) = polyline::direction(path[1], path[0]) else { return 0.0 };
            let overlap = path[0] + way * knife.corner_heel_overlap_mm;
            let extended: Vec<Point> = std::iter::once(overlap).chain(path.iter().copied()).collect();
            let distance = |path: &[Point]| distance(from, along, &Plunge::at_start(path, knife.width_mm));
            distance(&path).max(distance(&extended))
        };
        let ways = [self.way_to_corner(chord, false, from), self.way_to_corner(chord + 1, true, from)];
        ways.into_iter().flatten().map(ahead).fold(0.0, f64::max)
    }

    /// Way of a blade that plunges at the first corner from a vertex on, forwards or backwards, and comes back past a place;
    /// `None` if that corner is farther than the blade is wide.
    fn way_to_corner(&self, vertex: usize, forwards: bool, place: Point) -> Option<Vec<Point>> {
        let width = self.scene.job.profile.knife.width_mm;
        let (mut corner, mut way) = (vertex, (self.points[vertex] - place).norm());
        while !self.is_corner(corner) {
            let next = self.next(corner, forwards)?;
            way += (self.points[next] - self.points[corner]).norm();
            corner = next;
            if way > width {
                return None;
            }
        }
        let (mut path, mut last, mut length) = (vec![self.points[corner]], corner, 0.0);
        while length <= width {
            let Some(next) = self.next(last, !forwards) else { break };
            length += (self.points[next] - self.points[last]).norm();
            path.push(self.points[next]);
            last = next;
            if self.is_corner(last) {
                break;
            }
        }
        (path.len() > 1).then_some(path)
    }

    /// Number of vertices, and true if the last one is joined to the first.
    fn count(&self) -> (usize, bool) {
        let last = self.points.len() - 1;
        if self.points[0] == self.points[last] { (last, true) } else { (last + 1, false) }
    }

    /// The vertex beside another one; `None` past the end of an open edge.
    fn next(&self, vertex: usize, forwards: bool) -> Option<usize> {
        let (count, is_closed) = self.count();
        let next = if forwards { vertex + 1 } else { (vertex + count).checked_sub(1)? };
        let is_past = if forwards { next >= count } else { vertex == 0 };
        (is_closed || !is_past).then_some(next % count)
    }

    /// True at a corner, and at the end of an open edge.
    fn is_corner(&self, vertex: usize) -> bool {
        let (count, is_ring) = self.count();
        let Scene { job, unit, .. } = *self.scene;
        let limit = job.profile.corner_angle();
        let corners = Corners { point: |i: usize| self.points[i], count, is_ring, limit, unit };
        !is_ring && (vertex == 0 || vertex + 1 == count) || corners.is_at(vertex % count)
    }
}

/// Distance from a place along a unit vector to a plunged blade, mm; 0 if it is not ahead.
fn distance(from: Point, along: Vector, plunge: &Plunge) -> f64 {
    let (to_heel, blade) = (plunge.heel - from, plunge.blade());
    let sine = cross(along, blade);
    let share = cross(to_heel, along) / sine;
    if (0.0..=1.0).contains(&share) { (cross(to_heel, blade) / sine).max(0.0) } else { 0.0 }
}
