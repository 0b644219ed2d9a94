//! Blade that follows a path as a chord of it, and the places where it no longer can.
//!
//! A blade of width w with its tip and its heel on a path goes on as long as neither end comes to rest: the heel moves by
//! cos(a) / cos(b) of the tip's motion, where a and b are the angles of the blade with the path at tip and heel. While tip and
//! heel stay on one chord each, the blade turns one way only, so that the cosines are least where one of them passes a vertex.
//! The blade is therefore moved from vertex to vertex in closed form.

use std::ops::{Range, RangeInclusive};

use super::plunge::{Plunge, stands_across};
use crate::geom::{Point, Vector, polyline};

/// Least cosine of the blade with the path at the tip: below it the heel comes to rest.
const TIP_COSINE_MIN: f64 = 0.05;
/// Share of a blade's width that is rounding.
const WIDTH_EPSILON: f64 = 1e-9;

/// Place on a path.
#[derive(Debug, Clone, Copy)]
struct Foot {
    point: Point,
    /// Chord of the path on which the place is.
    chord: usize,
}

/// Vertices under a blade of `width` mm where it first cannot be a chord of a path, with its heel on the chords `heels`; `None`
/// if it can be one throughout.
pub(super) fn first_stop(path: &[Point], heels: Range<usize>, width: f64) -> Option<RangeInclusive<usize>> {
    let direction = |chord: usize| -> Vector {
        polyline::direction(path[chord], path[chord + 1]).expect("no chord of a run has length zero")
    };
    // If the rest of the path is within one blade width, one plunge cuts it.
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
        // Either the heel or the tip comes to its next vertex.
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

/// Circle with a radius in mm.
#[derive(Debug, Clone, Copy)]
struct Circle {
    centre: Point,
    radius: f64,
}

impl Circle {
    /// Point where a segment leaves the circle; `None` if it ends inside.
    fn exit(&self, segment: [Point; 2]) -> Option<Point> {
        if (segment[1] - self.centre).norm() < self.radius { None } else { self.crossing(segment, 1.0) }
    }

    /// Point where a segment enters the circle; `None` if it stays outside.
    fn entry(&self, segment: [Point; 2]) -> Option<Point> {
        self.crossing(segment, -1.0)
    }

    /// Earlier (`sign` -1) or later (+1) intersection of the line of a segment with the circle, clamped to the segment; `None`
    /// if the line misses the circle.
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
