//! A blade that follows a path as a chord of it, and where it can no longer.
//!
//! A blade of width w with its tip and its heel on a path goes on as long as neither end comes to stand: the heel moves
//! by cos(a) / cos(b) of the tip's way, a and b the angles of the blade with the path at tip and heel. While tip and heel
//! stay on a chord each, the blade turns one way only, so that the least cosines are found where one of them passes a
//! vertex: the blade is led from vertex to vertex in closed form.

use std::ops::{Range, RangeInclusive};

use super::plunge::{Plunge, stands_across};
use crate::geom::{Point, Vector, polyline};

/// Least cosine with the path at the tip: below it the heel comes to rest.
const TIP_COSINE_MIN: f64 = 0.05;
/// Part of a blade's width that is rounding.
const WIDTH_EPSILON: f64 = 1e-9;

/// A place on a path.
#[derive(Debug, Clone, Copy)]
struct Foot {
    point: Point,
    /// The chord of the path on which it is.
    chord: usize,
}

/// The vertices under a blade of `width` mm where it first cannot be a chord of a path, its heel being between two of its
/// points; `None` when it can all along.
pub(super) fn first_stop(path: &[Point], heels: Range<usize>, width: f64) -> Option<RangeInclusive<usize>> {
    let direction = |chord: usize| -> Vector {
        polyline::direction(path[chord], path[chord + 1]).expect("no chord of a run has length zero")
    };
    // Where all of the path is nearer than the blade is long, one plunge cuts it.
    let plunge = Plunge::at_start(&path[heels.start..], width);
    let mut heel = Foot { point: plunge.heel, chord: heels.start };
    let mut tip = Foot { point: plunge.tip, chord: plunge.chord + heels.start };
    let reaches = plunge.blade().norm() >= width * (1.0 - WIDTH_EPSILON);
    loop {
        let blade = tip.point - heel.point;
        let is_stopped_at_tip = |blade: Vector, length: f64| blade.dot(&direction(tip.chord)) < TIP_COSINE_MIN * length;
        if stands_across(blade, direction(heel.chord)) || is_stopped_at_tip(blade, blade.norm()) {
            return Some(heel.chord + 1..=tip.chord);
        }
        if !reaches || heel.chord >= heels.end {
            return None;
        }
        // The heel comes to its next vertex, or the tip does.
        let next = heel.chord + 1;
        let ahead = Circle { centre: path[next], radius: width }.exit([tip.point, path[tip.chord + 1]]);
        if let Some(point) = ahead.filter(|_| next <= tip.chord) {
            if stands_across(point - path[next], direction(heel.chord)) {
                return Some(next..=tip.chord);
            }
            (tip.point, heel) = (point, Foot { point: path[next], chord: next });
            continue;
        }
        let end = path[tip.chord + 1];
        let behind = Circle { centre: end, radius: width }.entry([heel.point, path[next]]);
        let Some(point) = behind.filter(|&point| !is_stopped_at_tip(end - point, width)) else {
            return Some(next..=tip.chord);
        };
        if tip.chord + 2 >= path.len() {
            return None;
        }
        (tip, heel.point) = (Foot { point: end, chord: tip.chord + 1 }, point);
    }
}

/// A circle around a point, of a radius in mm.
#[derive(Debug, Clone, Copy)]
struct Circle {
    centre: Point,
    radius: f64,
}

impl Circle {
    /// Where a segment leaves it; `None` when it ends inside.
    fn exit(&self, segment: [Point; 2]) -> Option<Point> {
        if (segment[1] - self.centre).norm() < self.radius { None } else { self.crossing(segment, 1.0) }
    }

    /// Where a segment enters it; `None` when it stays outside.
    fn entry(&self, segment: [Point; 2]) -> Option<Point> {
        self.crossing(segment, -1.0)
    }

    /// The earlier (`sign` -1) or later (+1) of the places in which the line of a segment crosses it, brought onto the
    /// segment; `None` when the line passes by.
    fn crossing(&self, [from, to]: [Point; 2], sign: f64) -> Option<Point> {
        let (a, d) = (from - self.centre, to - from);
        let square = d.norm_squared();
        if square == 0.0 {
            return Some(from);
        }
        let half = a.dot(&d);
        let root = half * half - square * (a.norm_squared() - self.radius * self.radius);
        (root >= 0.0).then(|| from + d * ((-half + sign * root.sqrt()) / square).clamp(0.0, 1.0))
    }
}
