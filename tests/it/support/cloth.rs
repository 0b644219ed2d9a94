//! A cloth divided again and again by slanted lines and gentle S curves, into parts that touch.

use cutc::geom::{Point, left, polyline};
use fastrand::Rng;

/// Area of cloth for each part; of the smallest that is divided; of the smallest and largest divided into small ones, mm2.
const AREA: [f64; 4] = [30_000.0, 8_000.0, 3_000.0, 12_000.0];
/// How near to the edge of a part a line that divides it comes between its ends, mm.
const LEAST: f64 = 12.0;

/// A cubic by its control points.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Curve([Point; 4]);

impl Curve {
    fn new(from: Point, to: Point, bows: [f64; 2]) -> Self {
        let (way, aside) = (to - from, left(to - from));
        Self([from, from + way / 3.0 + aside * bows[0], from + way * (2.0 / 3.0) + aside * bows[1], to])
    }

    pub(crate) fn at(&self, t: f64) -> Point {
        let (s, p) = (1.0 - t, self.0.map(|place| place.coords));
        Point::from(p[0] * (s * s * s) + p[1] * (3.0 * s * s * t) + p[2] * (3.0 * s * t * t) + p[3] * (t * t * t))
    }
}

/// A stretch of a curve, in either direction.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Edge {
    pub(crate) curve: usize,
    pub(crate) from: f64,
    pub(crate) to: f64,
}

/// Parts, drawn counter-clockwise.
pub(crate) struct Cloth {
    pub(crate) curves: Vec<Curve>,
    pub(crate) parts: Vec<Vec<Edge>>,
}

impl Cloth {
    /// A cloth of so many parts, and of so many more that are small; all lines are straight, or some are curved.
    pub(crate) fn divided([parts, small]: [usize; 2], is_straight: bool, rng: &mut Rng) -> Self {
        let area = parts as f64 * AREA[0];
        let (width, height) = (1.4 * area.sqrt(), area.sqrt() / 1.4);
        let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)].map(|(x, y)| Point::new(x, y));
        let curves = (0..4).map(|k| Curve::new(corners[k], corners[(k + 1) % 4], [0.0; 2])).collect();
        let whole = (0..4).map(|curve| Edge { curve, from: 0.0, to: 1.0 }).collect();
        let mut cloth = Self { curves, parts: vec![whole] };
        // Whatever cannot be divided well is left; there is always something else.
        for _ in 0..20 * parts {
            let weights: Vec<f64> = cloth.parts.iter().map(|part| cloth.area(part) * (0.4 + rng.f64())).collect();
            let next = (0..weights.len()).max_by(|&a, &b| weights[a].total_cmp(&weights[b])).expect("there is one");
            if cloth.parts.len() < parts && cloth.area(&cloth.parts[next]) > AREA[1] {
                cloth.divide(next, is_straight, rng);
            }
        }
        for _ in 0..20 * small {
            let is_wide = |&part: &usize| (AREA[2]..AREA[3]).contains(&cloth.area(&cloth.parts[part]));
            let wide: Vec<usize> = (0..cloth.parts.len()).filter(is_wide).collect();
            if cloth.parts.len() < parts + small && !wide.is_empty() {
                cloth.divide(wide[rng.usize(..wide.len())], is_straight, rng);
            }
        }
        cloth
    }

    /// Seventeen places of an edge.
    pub(crate) fn points(&self, edge: Edge) -> impl Iterator<Item = Point> + '_ {
        (0..=16).map(move |k| self.curves[edge.curve].at(edge.from + (edge.to - edge.from) * f64::from(k) / 16.0))
    }

    pub(crate) fn length(&self, edge: Edge) -> f64 {
        polyline::length(&self.points(edge).collect::<Vec<_>>())
    }

    fn area(&self, part: &[Edge]) -> f64 {
        let ring: Vec<Point> = part.iter().flat_map(|&edge| self.points(edge)).collect();
        ring.windows(2).map(|ends| ends[0].x * ends[1].y - ends[1].x * ends[0].y).sum::<f64>() / 2.0
    }

    /// Divides a part by a line from its longest edge to the one farthest from that, if the line stays within it.
    fn divide(&mut self, part: usize, is_straight: bool, rng: &mut Rng) {
        let edges = self.parts[part].clone();
        let count = edges.len();
        let middle = |i: usize| self.points(edges[i]).nth(8).expect("seventeen points");
        let length = |&i: &usize| self.length(edges[i]);
        let first = (0..count).max_by(|a, b| length(a).total_cmp(&length(b))).expect("it has edges");
        let is_beside = |i: usize| [1, count - 1].contains(&((i + count - first) % count));
        let others = (0..count).filter(|&i| i != first && (count == 3 || !is_beside(i)));
        let away = |i: usize| (middle(i) - middle(first)).norm();
        let Some(second) = others.max_by(|&a, &b| away(a).total_cmp(&away(b))) else { return };
        let at = |i: usize, share: f64| edges[i].from + (edges[i].to - edges[i].from) * (0.35 + 0.3 * share);
        let [a, b] = [first, second].map(|i| at(i, rng.f64()));
        let [from, to] = [(first, a), (second, b)].map(|(i, t)| self.curves[edges[i].curve].at(t));
        let mut bow = || (rng.f64() - 0.5) * 0.16;
        let bows = [bow(), bow()];
        let curve = Curve::new(from, to, if rng.u8(..3) == 0 || is_straight { [0.0; 2] } else { bows });
        let around: Vec<Vec<Point>> = edges.iter().map(|&edge| self.points(edge).collect()).collect();
        let is_clear = (2..=14).map(|k| curve.at(f64::from(k) / 16.0)).all(|place| {
            let mut sides = around.iter().flat_map(|line| line.windows(2));
            sides.all(|ends| polyline::distance_to_segment(place, ends[0], ends[1]) > LEAST)
        });
        if !is_clear {
            return;
        }
        self.curves.push(curve);
        let curve = self.curves.len() - 1;
        let between = |from: usize, to: usize| {
            (1..count).map(move |k| (from + k) % count).take_while(move |&k| k != to).map(|k| edges[k])
        };
        let one = [Edge { from: a, ..edges[first] }].into_iter().chain(between(first, second));
        let one = one.chain([Edge { to: b, ..edges[second] }, Edge { curve, from: 1.0, to: 0.0 }]).collect();
        let two = [Edge { from: b, ..edges[second] }].into_iter().chain(between(second, first));
        let two = two.chain([Edge { to: a, ..edges[first] }, Edge { curve, from: 0.0, to: 1.0 }]).collect();
        self.parts[part] = one;
        self.parts.push(two);
    }
}
