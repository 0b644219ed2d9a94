//! Where a blade cannot be a chord of a polyline.
//!
//! A blade of width w with its tip and its tail on a path goes on as long as neither end comes to stand: the tail moves
//! by cos(a) / cos(b) of the tip's way, a and b the angles of the blade with the path at tip and tail. While tip and tail
//! stay on a chord each, the blade turns one way only, so that the least cosines are found where one of them passes a
//! vertex: the blade is led from vertex to vertex in closed form.

use std::ops::RangeInclusive;

use crate::geom::{Point, Vector, polyline};
use crate::ir::toolpath::{Run, Shape};

/// Least cosine of the blade with the path at its tail: below it the tail darts along the path, and the blade swings.
/// An arc of 0.55 blade widths has this.
const TAIL_COSINE_MIN: f64 = 0.4;
/// Least cosine with the path at its tip: below it the tail comes to rest.
const TIP_COSINE_MIN: f64 = 0.05;

/// Radius of the tightest arc that a blade can follow, in widths of it: there the cosine is that.
const ARC_SHARE: f64 = 0.55;

/// A stretch of a path that is too tight for a blade.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tight {
    /// Its vertices: where a run turns so sharply that the blade cannot follow. On a ring they go on past its end.
    pub(super) vertices: RangeInclusive<usize>,
    /// Its least radius, mm.
    pub(super) radius: f64,
    /// The vertex that is the tightest by itself.
    pub(super) at: usize,
}

/// Whether a blade, from its tail to its tip, stands across a path that has a direction at its tail.
pub(super) fn stands_across(blade: Vector, direction: Vector) -> bool {
    blade.dot(&direction) < TAIL_COSINE_MIN * blade.norm()
}

/// The path that the tail of a run follows, and which of its points is the first of the run: an open one with its overlaps,
/// a ring twice round.
fn path_of(run: &Run) -> (Vec<Point>, usize) {
    match run.shape {
        Shape::Open => (run.extended(), usize::from(run.heel > 0.0)),
        Shape::Ring => (run.points.iter().chain(&run.points[1..]).copied().collect(), 0),
    }
}

/// The stretches of a run, its overlaps given, of which a blade of `width` cannot be a chord.
pub(super) fn tight(run: &Run, width: f64) -> Vec<Tight> {
    let (path, skipped) = path_of(run);
    let chords = run.points.len() - 1;
    let last = match run.shape {
        Shape::Open => path.len() - 1,
        Shape::Ring => chords,
    };
    let mut found: Vec<Tight> = Vec::new();
    let mut from = 0;
    while from < last {
        let is_narrow = run.shape == Shape::Ring && polyline::first_at_distance(&path[from..], width).is_none();
        let under = if is_narrow { Some(from + 1..=from + 1 + chords) } else { first(&path, from..last, width) };
        let Some(under) = under else { break };
        let inner = *under.start().max(&(skipped + 1))..=(*under.end()).min(path.len() - 2);
        let mut next = (*inner.end()).max(from + 1);
        if let Some(tight) = stretch(&path, inner, width) {
            next = next.max(*tight.vertices.end());
            let vertices = tight.vertices.start() - skipped..=tight.vertices.end() - skipped;
            let is_in_run = run.shape == Shape::Ring || *vertices.end() < chords;
            if is_in_run {
                found.push(Tight { vertices, at: tight.at - skipped, ..tight });
            }
        }
        from = next;
    }
    found
}

/// The vertices under the blade where it first cannot be a chord of the path, its tail being on the path from one point to
/// another; `None` when it can all along.
fn first(path: &[Point], tails: std::ops::Range<usize>, width: f64) -> Option<RangeInclusive<usize>> {
    let direction = |chord: usize| -> Vector {
        polyline::direction(path[chord], path[chord + 1]).expect("no chord of a run has length zero")
    };
    let mut tail = (path[tails.start], tails.start);
    let (mut tip, mut chord) = match polyline::first_at_distance(&path[tails.start..], width) {
        Some((tip, chord)) => (tip, chord + tails.start),
        // What is nearer all along is one plunge.
        None => (path[path.len() - 1], path.len() - 2),
    };
    let reaches = (tip - tail.0).norm() >= width * (1.0 - WIDTH_EPSILON);
    loop {
        let blade = tip - tail.0;
        if stands_across(blade, direction(tail.1)) || blade.dot(&direction(chord)) < TIP_COSINE_MIN * blade.norm() {
            return Some(tail.1 + 1..=chord);
        }
        if !reaches || tail.1 >= tails.end {
            return None;
        }
        // The tail comes to its next vertex, or the tip does.
        let next = tail.1 + 1;
        match ahead([tip, path[chord + 1]], path[next], width) {
            Some(place) if next <= chord => {
                if stands_across(place - path[next], direction(tail.1)) {
                    return Some(next..=chord);
                }
                (tip, tail) = (place, (path[next], next));
            }
            _ => {
                tip = path[chord + 1];
                let Some(place) = behind([tail.0, path[next]], tip, width) else { return Some(next..=chord) };
                tail.0 = place;
                if (tip - place).dot(&direction(chord)) < TIP_COSINE_MIN * width {
                    return Some(next..=chord);
                }
                if chord + 2 >= path.len() {
                    return None;
                }
                chord += 1;
            }
        }
    }
}

/// Part of a blade's width that is rounding.
const WIDTH_EPSILON: f64 = 1e-9;

/// Where a segment leaves the circle of radius `width` around a centre; `None` when it ends inside.
fn ahead([from, to]: [Point; 2], centre: Point, width: f64) -> Option<Point> {
    if (to - centre).norm() < width {
        return None;
    }
    crossing([from, to], centre, width, 1.0)
}

/// Where a segment enters the circle of radius `width` around a centre; `None` when it stays outside.
fn behind([from, to]: [Point; 2], centre: Point, width: f64) -> Option<Point> {
    crossing([from, to], centre, width, -1.0)
}

/// The earlier (`sign` -1) or later (+1) of the places in which the line of a segment crosses a circle, brought onto the
/// segment; `None` when it passes by.
fn crossing([from, to]: [Point; 2], centre: Point, width: f64, sign: f64) -> Option<Point> {
    let (a, d) = (from - centre, to - from);
    let square = d.norm_squared();
    if square == 0.0 {
        return Some(from);
    }
    let half = a.dot(&d);
    let root = half * half - square * (a.norm_squared() - width * width);
    (root >= 0.0).then(|| from + d * ((-half + sign * root.sqrt()) / square).clamp(0.0, 1.0))
}

/// Radius at an inner vertex of a path, mm: that of the arc with its shorter chord and its turn.
pub(super) fn radius(path: &[Point], vertex: usize) -> f64 {
    let [a, b, c] = [path[vertex - 1], path[vertex], path[vertex + 1]];
    (b - a).norm().min((c - b).norm()) / (2.0 * (polyline::turn_at(a, b, c).abs() / 2.0).sin())
}

/// Length of a curve, in widths of the blade, over which its radius is taken: over less it would be that of its rounding.
const RADIUS_SHARE: f64 = 0.3;
/// The same in lengths of the curve, which is gentler at its ends.
const LENGTH_SHARE: f64 = 0.33;

/// Least radius of a curve from one inner vertex of a path to another, for a blade of `width`, mm: that of the arc whose chords
/// are as long and turn as much, c = 2 R sin(a/2), at either end by one half.
pub(super) fn least_radius(path: &[Point], vertices: RangeInclusive<usize>, width: f64) -> f64 {
    let (first, last) = vertices.into_inner();
    if first == last {
        return radius(path, first);
    }
    let bend = |vertex: usize| {
        let turn = polyline::turn_at(path[vertex - 1], path[vertex], path[vertex + 1]);
        2.0 * (turn / 2.0).sin()
    };
    let stations = polyline::stations(&path[first..=last]);
    let count = stations.len();
    let reach = (RADIUS_SHARE * width).min(LENGTH_SHARE * stations[count - 1]);
    let of = |from: usize| {
        let to = stations.partition_point(|&station| station < stations[from] + reach);
        (to < count).then(|| {
            let ends = f64::midpoint(bend(first + from), bend(first + to));
            let bends = ends + (from + 1..to).map(|vertex| bend(first + vertex)).sum::<f64>();
            (stations[to] - stations[from]) / bends.abs()
        })
    };
    (0..count - 1).filter_map(of).fold(f64::INFINITY, f64::min)
}

/// From the first to the last of some vertices that belong to curves tighter than the blade is wide, or of all when none
/// does; `None` when there are none at all.
fn stretch(path: &[Point], vertices: RangeInclusive<usize>, width: f64) -> Option<Tight> {
    let radius = |vertex: usize| radius(path, vertex);
    let at = vertices.clone().min_by(|&a, &b| radius(a).total_cmp(&radius(b)))?;
    let (first, last) = (*vertices.start(), *vertices.end());
    // What goes on as tight as that belongs to the same curve, whether or not the blade could be a chord of its end. A chord
    // on which the blade has a way to go parts two curves.
    let is_tight = |vertex: usize, chord: usize| {
        radius(vertex) < ARC_SHARE * width && (path[chord + 1] - path[chord]).norm() < width
    };
    let first = (1..first).rev().take_while(|&v| is_tight(v, v)).last().unwrap_or(first);
    let last = (last + 1..path.len() - 1).take_while(|&v| is_tight(v, v - 1)).last().unwrap_or(last);
    let mut tight = (first..=last).filter(|&vertex| radius(vertex) < width);
    let ends = match (tight.next(), tight.next_back()) {
        (Some(first), Some(last)) => first..=last,
        (Some(only), None) => only..=only,
        (None, _) => vertices,
    };
    Some(Tight { radius: least_radius(path, ends.clone(), width), vertices: ends, at })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Heading;
    use crate::ir::list::Joint;
    use crate::ir::toolpath::{Edge, End, Law, Pose};
    use crate::source::Span;

    const WIDTH: f64 = 6.6;

    fn run(points: Vec<Point>, shape: Shape) -> Run {
        let chords = points.len() - 1;
        Run {
            spans: vec![Span::default(); chords],
            joints: vec![Joint::default(); points.len()],
            points,
            shape,
            law: Law::Chord,
            front: 0.0,
            heel: 0.0,
            feeds: vec![1.0; chords],
            ends: [End::default(); 2],
            turned: false,
            edge: Edge::Front,
            start: Pose::default(),
            end: Pose::default(),
        }
    }

    /// Two straights of 30 mm joined by an arc of a radius through an angle.
    fn bend(radius: f64, angle: f64) -> Vec<Point> {
        let steps = 24;
        let arc = (0..=steps).map(|i| angle * f64::from(i) / f64::from(steps));
        let arc = arc.map(|a| Point::new(radius * a.sin(), radius * (1.0 - a.cos())));
        let mut points = vec![Point::new(-30.0, 0.0)];
        points.extend(arc);
        points.push(points[points.len() - 1] + Heading::new(angle).unit() * 30.0);
        points
    }

    #[test]
    fn a_bend_is_tight_when_the_blade_would_stand_across_it() {
        let right = std::f64::consts::FRAC_PI_2;
        // The tail enters the arc of a right angle with the cosine R / w.
        assert!(tight(&run(bend(0.43 * WIDTH, right), Shape::Open), WIDTH).is_empty());
        let found = tight(&run(bend(0.37 * WIDTH, right), Shape::Open), WIDTH);
        assert_eq!(found.len(), 1);
        assert!((found[0].radius - 0.37 * WIDTH).abs() < 0.01, "{found:?}");
        assert_eq!(found[0].vertices, 1..=25);
        assert!(tight(&run(bend(0.1, 0.6), Shape::Open), WIDTH).is_empty(), "a kink is not tight, only sharp");
    }

    #[test]
    fn an_arc_is_tight_below_0_55_widths() {
        let circle = |share: f64| {
            let around = (0..=90).map(|i| std::f64::consts::TAU * f64::from(i % 90) / 90.0);
            let points = around.map(|a| Point::new(share * WIDTH * a.cos(), share * WIDTH * a.sin())).collect();
            tight(&run(points, Shape::Ring), WIDTH)
        };
        assert!(circle(0.57).is_empty());
        assert!(!circle(0.53).is_empty());
        assert!(!circle(0.3).is_empty(), "the blade is longer than the circle is wide");
    }

    #[test]
    fn a_hairpin_is_tight_as_a_whole_and_what_comes_behind_it_is_not() {
        let mut points = bend(1.0, 3.0);
        let last = points[points.len() - 1];
        points.extend((1..30).map(|i| {
            let a = f64::from(i) * 0.05;
            last + Heading::new(3.0 + a / 2.0).unit() * (40.0 * a)
        }));
        let found = tight(&run(points, Shape::Open), WIDTH);
        assert!(!found.is_empty() && found.iter().all(|tight| *tight.vertices.end() <= 25), "{found:?}");
    }
}
