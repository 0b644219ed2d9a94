//! Crossings of polylines. Each polyline is divided into chains that are monotone in x and in y. A chain does not cross itself,
//! and the box of any part of it is that of its two ends, so bisection finds the crossings of two chains fast. (Monotone
//! chains: Park & Shin, "Self-intersection elimination by monotone chains", CAD 34, 2002.)

use super::budget::Budget;
use super::{Extent, Point, Vector, cross};

/// A stretch of a polyline that is monotone in x and in y: indices of its first and last point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Chain {
    /// Index of its first point.
    pub first: u32,
    /// Index of its last point.
    pub last: u32,
}

/// A crossing of two segments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Indices of the start points of the two segments.
    pub segments: [usize; 2],
    /// Point of intersection.
    pub at: Point,
}

impl Chain {
    /// Bounding box of the chain.
    pub fn extent(self, points: &[Point]) -> Extent {
        Extent::between(points[self.first as usize], points[self.last as usize])
    }

    /// Number of segments.
    pub fn segments(self) -> usize {
        (self.last - self.first) as usize
    }

    /// The chain after `by` points have been inserted before those of its polyline.
    #[must_use]
    pub fn moved(self, by: u32) -> Self {
        Self { first: self.first + by, last: self.last + by }
    }

    fn halves(self) -> [Self; 2] {
        let middle = self.first.midpoint(self.last);
        [Self { last: middle, ..self }, Self { first: middle, ..self }]
    }
}

/// The chains of a polyline in order, computed lazily; none for a polyline without segments.
pub fn chains(points: &[Point]) -> impl Iterator<Item = Chain> {
    let mut first = 0;
    std::iter::from_fn(move || {
        let rest = points.get(first..).filter(|rest| rest.len() > 1)?;
        let chain = Chain { first: first as u32, last: (first + turning(rest)) as u32 };
        first = chain.last as usize;
        Some(chain)
    })
}

/// Index of the last point of the first chain. The polyline must have a segment.
fn turning(points: &[Point]) -> usize {
    // Only the signs of dx and dy so far count; 0 means none yet.
    let mut so_far = Vector::zeros();
    for (i, (from, to)) in points.iter().zip(&points[1..]).enumerate() {
        let way = to - from;
        if way.x * so_far.x < 0.0 || way.y * so_far.y < 0.0 {
            return i;
        }
        // A sum of numbers of one sign keeps that sign.
        so_far += way;
    }
    points.len() - 1
}

/// The first crossing of two chains, of one polyline or two, that `wanted` accepts. Segments that merely touch or are collinear
/// do not cross. Also `None` once the budget is spent.
pub fn crossing(
    points: [&[Point]; 2],
    [a, b]: [Chain; 2],
    work: &mut Budget,
    wanted: &mut impl FnMut(&Crossing) -> bool,
) -> Option<Crossing> {
    let boxes = [a.extent(points[0]), b.extent(points[1])];
    let may_cross = work.spend(1) && boxes[0].overlaps(&boxes[1]);
    if may_cross { crossing_in(points, [(a, boxes[0]), (b, boxes[1])], work, wanted) } else { None }
}

/// Finds a crossing as [`crossing`] does, for chains with known, overlapping boxes.
fn crossing_in(
    points: [&[Point]; 2],
    [(mut a, mut box_a), (mut b, mut box_b)]: [(Chain, Extent); 2],
    work: &mut Budget,
    wanted: &mut impl FnMut(&Crossing) -> bool,
) -> Option<Crossing> {
    while a.segments() != 1 || b.segments() != 1 {
        let is_a = a.segments() >= b.segments();
        let (halves, of_longer, other) =
            if is_a { (a.halves(), points[0], box_b) } else { (b.halves(), points[1], box_a) };
        let [first, second] = halves.map(|half| (half, half.extent(of_longer)));
        if work.spend(1) && first.1.overlaps(&other) {
            let pair = if is_a { [first, (b, box_b)] } else { [(a, box_a), first] };
            let found = crossing_in(points, pair, work, wanted);
            if found.is_some() {
                return found;
            }
        }
        if !work.spend(1) || !second.1.overlaps(&other) {
            return None;
        }
        if is_a {
            (a, box_a) = second;
        } else {
            (b, box_b) = second;
        }
    }
    let segments = [a.first as usize, b.first as usize];
    let ends = |k: usize| [points[k][segments[k]], points[k][segments[k] + 1]];
    cross_at(ends(0), ends(1)).map(|at| Crossing { segments, at }).filter(wanted)
}

/// True if two chains may come within `slack` mm of each other: the boxes of two of their segments do. Also true once the
/// budget is spent.
pub fn come_near(points: [&[Point]; 2], [a, b]: [Chain; 2], slack: f64, work: &mut Budget) -> bool {
    if !work.spend(1) {
        return true;
    }
    if !a.extent(points[0]).grown(slack).meets(&b.extent(points[1])) {
        return false;
    }
    if a.segments() == 1 && b.segments() == 1 {
        return true;
    }
    let halves = if a.segments() >= b.segments() { a.halves().map(|a| [a, b]) } else { b.halves().map(|b| [a, b]) };
    halves.into_iter().any(|pair| come_near(points, pair, slack, work))
}

/// Distance below which a point counts as on a line, mm: rounding of coordinates of some metres.
const ON_LINE_EPSILON: f64 = 1e-9;

/// Intersection of two segments; `None` when an end of one lies on the other.
fn cross_at(a: [Point; 2], b: [Point; 2]) -> Option<Point> {
    let (along_a, along_b) = (a[1] - a[0], b[1] - b[0]);
    let is_split = |sides: [f64; 2], length: f64| {
        sides[0] * sides[1] < 0.0 && sides.iter().all(|side| side.abs() > ON_LINE_EPSILON * length)
    };
    let of_b = b.map(|end| cross(along_a, end - a[0]));
    let of_a = a.map(|end| cross(along_b, end - b[0]));
    let split = is_split(of_b, along_a.norm()) && is_split(of_a, along_b.norm());
    split.then(|| a[0] + along_a * (of_a[0] / (of_a[0] - of_a[1])))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64)]) -> Vec<Point> {
        list.iter().map(|&(x, y)| Point::new(x, y)).collect()
    }

    fn first(a: &[Point], b: &[Point]) -> Option<Crossing> {
        chains(a)
            .find_map(|k| chains(b).find_map(|l| crossing([a, b], [k, l], &mut Budget::of_a_marker(), &mut |_| true)))
    }

    #[test]
    fn a_chain_ends_where_x_or_y_turns_back() {
        let ring = points(&[(0.0, 0.0), (1.0, 0.0), (2.0, 1.0), (2.0, 2.0), (1.0, 3.0), (0.0, 0.0)]);
        let ends: Vec<_> = chains(&ring).map(|c| (c.first, c.last)).collect();
        assert_eq!(ends, [(0, 3), (3, 4), (4, 5)]);
        assert_eq!(chains(&ring[..1]).next(), None);
    }

    #[test]
    fn lines_side_by_side_are_near_within_the_slack() {
        let wave = |lift: f64| -> Vec<Point> {
            (0..=500).map(|i| Point::new(f64::from(i), 20.0 * (f64::from(i) / 50.0).sin() + lift)).collect()
        };
        let near = |a: &[Point], b: &[Point], slack: f64| {
            let mut work = Budget::of_a_marker();
            chains(a).any(|k| chains(b).any(|l| come_near([a, b], [k, l], slack, &mut work)))
        };
        let line = points(&[(0.0, 25.0), (500.0, 25.0)]);
        assert!(near(&wave(0.0), &wave(0.0), 0.0) && near(&wave(0.0), &wave(1.0), 1.0) && near(&wave(0.0), &line, 5.1));
        assert!(!near(&wave(0.0), &line, 4.9) && !near(&wave(0.0), &wave(40.0), 1.0));
    }

    #[test]
    fn curves_that_cross_are_found_and_those_that_touch_are_not() {
        let arc = |lift: f64| -> Vec<Point> {
            let angle = |i: u32| f64::from(i) * std::f64::consts::PI / 1000.0;
            (0..=1000).map(|i| Point::new(100.0 * angle(i).cos(), 100.0 * angle(i).sin() + lift)).collect()
        };
        let line = points(&[(-50.0, 99.0), (80.0, 99.0)]);
        let found = first(&arc(0.0), &line).expect("a crossing");
        assert!((found.at.y - 99.0).abs() < 1e-9 && (found.at.x - 199_f64.sqrt()).abs() < 0.01, "{found:?}");
        assert_eq!(first(&arc(-1.0), &line), None);
        assert_eq!(first(&arc(0.0), &arc(0.0)), None);
        assert_eq!(first(&line, &points(&[(0.0, 99.0), (0.0, 0.0)])), None);
        assert_eq!(first(&line, &points(&[(0.0, 99.0), (60.0, 99.0)])), None);
    }
}
