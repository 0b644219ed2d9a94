//! Curves that are tighter than the blade: stretches where the blade cannot be a chord of a run.

use std::ops::RangeInclusive;

use super::chord::first_stop;
use super::cloth::Surroundings;
use super::plunge::overlaps;
use crate::geom::{Point, polyline};
use crate::ir::toolpath::{Run, Shape};

/// Turn of a run up to which the blade never stands across it, rad: a little less than the angle whose cosine is 0.4.
const TURN_MIN: f64 = 1.15;
/// Radius of the tightest arc that a blade can follow, in blade widths: the blade reaches its greatest angle at the heel there.
const ARC_SHARE: f64 = 0.55;

/// Stretch of a run that is too tight for a blade.
#[derive(Debug, Clone, PartialEq)]
pub struct TightCurve {
    /// Vertices where the run turns too sharply for the blade. On a ring their numbers continue past its end.
    pub vertices: RangeInclusive<usize>,
    /// Least radius, mm.
    pub radius: f64,
    /// Vertex with the least radius of its own.
    pub at: usize,
}

/// Stretches of a run, with the overlaps that there is room for, of which the blade cannot be a chord; adjoining ones are
/// joined. A smooth contour narrower than the blade is one such stretch as a whole.
pub fn tight_curves(run: &Run, around: &Surroundings) -> Vec<TightCurve> {
    if run.shape == Shape::Open && polyline::turns_by_less(&run.points, TURN_MIN) {
        return Vec::new();
    }
    let [heel, front] = overlaps(run, around).map(|overlap| overlap.length);
    joined(found(run, [heel, front], around.knife.width_mm))
}

/// Joins adjoining curves in a sorted list.
pub fn joined(curves: Vec<TightCurve>) -> Vec<TightCurve> {
    let mut joined: Vec<TightCurve> = Vec::new();
    for next in curves {
        match joined.last_mut() {
            Some(last) if next.vertices.start() <= last.vertices.end() => {
                let end = *last.vertices.end().max(next.vertices.end());
                let tighter = if next.radius < last.radius { &next } else { &*last };
                *last = TightCurve { vertices: *last.vertices.start()..=end, radius: tighter.radius, at: tighter.at };
            }
            _ => joined.push(next),
        }
    }
    joined
}

/// Stretches of a run with overlaps of these lengths at its start and its end, mm, of which a blade of `width` mm cannot be a
/// chord; some may adjoin.
fn found(run: &Run, overlaps: [f64; 2], width: f64) -> Vec<TightCurve> {
    let chords = run.points.len() - 1;
    let is_ring = run.shape == Shape::Ring;
    // The heel follows an open run with its overlaps, or a ring twice round. The run begins behind the heel overlap.
    let path = match run.shape {
        Shape::Open => run.extended_by(overlaps),
        Shape::Ring => run.points.iter().chain(&run.points[1..]).copied().collect(),
    };
    let skipped = usize::from(!is_ring && overlaps[0] > 0.0);
    let last = if is_ring { chords } else { path.len() - 1 };
    let mut found: Vec<TightCurve> = Vec::new();
    let mut from = 0;
    while from < last {
        let is_narrow = is_ring && polyline::first_at_distance(&path[from..], width).is_none();
        let under = if is_narrow { Some(from + 1..=from + 1 + chords) } else { first_stop(&path, from..last, width) };
        let Some(under) = under else { break };
        let inner = *under.start().max(&(skipped + 1))..=(*under.end()).min(path.len() - 2);
        let mut next = (*inner.end()).max(from + 1);
        if let Some(curve) = curve_at(&path, inner, width) {
            next = next.max(*curve.vertices.end());
            let vertices = curve.vertices.start() - skipped..=curve.vertices.end() - skipped;
            if is_ring || *vertices.end() < chords {
                found.push(TightCurve { vertices, at: curve.at - skipped, ..curve });
            }
        }
        from = next;
    }
    found
}

/// Radius at an inner vertex of a path, mm: that of the arc with its shorter chord and its turn.
pub fn radius(path: &[Point], vertex: usize) -> f64 {
    let [a, b, c] = [path[vertex - 1], path[vertex], path[vertex + 1]];
    (b - a).norm().min((c - b).norm()) / (2.0 * (polyline::turn_at(a, b, c).abs() / 2.0).sin())
}

/// Length of a curve over which its radius is taken, in blade widths: over a shorter one the radius would be that of the
/// rounding.
const RADIUS_SHARE: f64 = 0.3;
/// Share of the length of the curve over which its radius is taken: a curve is gentler at its ends.
const LENGTH_SHARE: f64 = 0.33;

/// Radius far beyond any curve that matters to a blade, mm.
const STRAIGHT: f64 = 1e4;

/// Least radius of a curve between two inner vertices of a path, for a blade of `width`, mm: that of the arc with the same
/// length and turn of its chords, c = 2 R sin(a/2), where the turns at both ends count by half.
pub fn least_radius(path: &[Point], vertices: RangeInclusive<usize>, width: f64) -> f64 {
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
    let least = (0..count - 1).filter_map(of).fold(f64::INFINITY, f64::min);
    // Bends to opposite sides cancel; the tightest vertex then gives the radius.
    if least < STRAIGHT { least } else { (first..=last).map(|vertex| radius(path, vertex)).fold(least, f64::min) }
}

/// Curve from the first to the last of some vertices with a radius below the width of the blade, or over all of them if none
/// has; `None` if there are no vertices.
fn curve_at(path: &[Point], vertices: RangeInclusive<usize>, width: f64) -> Option<TightCurve> {
    let radius = |vertex: usize| radius(path, vertex);
    let at = vertices.clone().min_by(|&a, &b| radius(a).total_cmp(&radius(b)))?;
    let (first, last) = (*vertices.start(), *vertices.end());
    // Adjacent vertices that are as tight belong to the same curve, whether or not the blade could be a chord of its end. A
    // chord as long as the blade separates two curves.
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
    Some(TightCurve { radius: least_radius(path, ends.clone(), width), vertices: ends, at })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Heading;
    use crate::ir::list::Joint;
    use crate::ir::toolpath::{Edge, End, OrientationMode, Pose};

    const WIDTH: f64 = 6.6;

    fn run(points: Vec<Point>, shape: Shape) -> Run {
        let chords = points.len() - 1;
        Run {
            spans: std::iter::repeat_with(Default::default).take(chords).collect(),
            joints: vec![Joint::default(); points.len()],
            points,
            shape,
            orientation: OrientationMode::Chord,
            front: 0.0,
            heel: 0.0,
            feeds: vec![1.0; chords],
            junctions: Vec::new(),
            ends: [End::default(); 2],
            turned: false,
            edge: Edge::Front,
            start: Pose::default(),
            end: Pose::default(),
        }
    }

    fn found_on(run: &Run, width: f64) -> Vec<TightCurve> {
        found(run, [0.0; 2], width)
    }

    /// Two straights of 30 mm joined by an arc with this radius and angle.
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
        // The heel enters the arc of a right angle with the cosine R / w.
        assert!(found_on(&run(bend(0.43 * WIDTH, right), Shape::Open), WIDTH).is_empty());
        let found = found_on(&run(bend(0.37 * WIDTH, right), Shape::Open), WIDTH);
        assert_eq!(found.len(), 1);
        assert!((found[0].radius - 0.37 * WIDTH).abs() < 0.01, "{found:?}");
        assert_eq!(found[0].vertices, 1..=25);
        assert!(found_on(&run(bend(0.1, 0.6), Shape::Open), WIDTH).is_empty(), "a kink is not tight, only sharp");
    }

    #[test]
    fn an_arc_is_tight_below_0_55_widths() {
        let circle = |share: f64| {
            let around = (0..=90).map(|i| std::f64::consts::TAU * f64::from(i % 90) / 90.0);
            let points = around.map(|a| Point::new(share * WIDTH * a.cos(), share * WIDTH * a.sin())).collect();
            found_on(&run(points, Shape::Ring), WIDTH)
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
        let found = found_on(&run(points, Shape::Open), WIDTH);
        assert!(!found.is_empty() && found.iter().all(|tight| *tight.vertices.end() <= 25), "{found:?}");
    }
}
