//! Division of cuts into chains. A chain is a stretch of a cut that one head makes, with x falling overall because the cloth
//! moves towards +X.
//!
//! A cut is parted at the local extrema of x. An edge across the feed at such an extremum belongs to the chain that goes on
//! behind it along the line, so that each of the two chains of a rectangle has one. A turn back up to the permitted length does
//! not part the cut: a head with some travel along the feed makes it by itself.

use super::bound;
use super::join::Join;
use crate::geom::Point;
use crate::geom::corner::Corners;
use crate::ir::list::Joint;
use crate::ir::toolpath::{Run, Shape, Step, Toolpath};

/// A traced cut of the marker: one run.
#[derive(Debug, Clone)]
pub(super) struct Line {
    /// Index of the cut in the marker.
    pub(super) cut: u32,
    /// Toolpath of the cut, without its run.
    pub(super) toolpath: Toolpath,
    /// The whole run.
    pub(super) run: Run,
}

/// Parameters of the division of a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Parting {
    /// Maximum turn back within a chain, mm.
    pub(super) back: f64,
    /// Distance by which a chain continues along the line beyond an end at which another chain takes over, mm.
    pub(super) overlap: f64,
    /// Width of the blade, mm.
    pub(super) blade: f64,
    /// Maximum turn that is no corner, rad.
    pub(super) corner: f64,
    /// Rounding unit of the coordinates, mm; 0 if they are not rounded.
    pub(super) unit: f64,
}

/// A stretch of a cut that one head makes.
#[derive(Debug, Clone)]
pub(super) struct Chain {
    /// Index of the cut in the marker.
    pub(super) cut: u32,
    /// Toolpath with one open run, before the passes.
    pub(super) toolpath: Toolpath,
    /// True if x falls all along it, except where an overlap leads back.
    pub(super) falls: bool,
}

/// Difference of x that counts as equal, mm: rounding of coordinates of some metres.
const LEVEL: f64 = 1e-9;

impl Line {
    /// The line of a traced toolpath; `None` if its last step is not a run.
    pub(super) fn new(cut: u32, mut toolpath: Toolpath) -> Option<Self> {
        match toolpath.steps.pop() {
            Some(Step::Run(run)) => Some(Self { cut, toolpath, run }),
            Some(Step::PlungeCut(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_)) | None => None,
        }
    }

    /// The chains of the line.
    pub(super) fn chains(&self, parting: Parting) -> Vec<Chain> {
        let ends = if self.is_closed() {
            round(&self.run.points, parting.back)
        } else {
            along(&self.run.points, parting.back)
        };
        let joins: Vec<f64> = (0..ends.len()).map(|i| self.join(&ends, i, parting)).collect();
        let chain = |(ends, joins): (&[usize], &[f64])| self.chain([ends[0], ends[1]], [joins[0], joins[1]], parting);
        ends.windows(2).zip(joins.windows(2)).map(chain).collect()
    }

    /// Distance along the line from the end of a chain to the place where the next chain takes over, mm; negative before the
    /// end.
    fn join(&self, ends: &[usize], i: usize, parting: Parting) -> f64 {
        let vertex = ends[i];
        let x = |end: usize| self.point(end).x;
        // Blades plunge at the start of chains: at the greatest x.
        let is_top = [i.checked_sub(1), Some(i + 1)]
            .into_iter()
            .flatten()
            .filter_map(|i| ends.get(i))
            .all(|&end| x(end) <= x(vertex));
        if !is_top || !self.goes_on(vertex) || self.is_corner(vertex, parting) {
            return 0.0;
        }
        let before = if vertex == 0 { self.segments() - 1 } else { vertex - 1 };
        let about = [before, vertex, vertex + 1].map(|vertex| self.point(vertex));
        let Parting { overlap, blade, .. } = parting;
        Join { about, overlap, blade, tolerance: self.toolpath.tolerance }.place()
    }

    fn is_closed(&self) -> bool {
        self.run.shape == Shape::Ring
    }

    /// Number of segments.
    fn segments(&self) -> usize {
        self.run.spans.len()
    }

    /// Position of a vertex. The index wraps around on a closed line.
    fn point(&self, vertex: usize) -> Point {
        let count = if self.is_closed() { self.segments() } else { self.run.points.len() };
        self.run.points[vertex % count]
    }

    /// True if the line continues at a vertex, as it does everywhere but at the ends of an open line.
    fn goes_on(&self, vertex: usize) -> bool {
        self.is_closed() || (vertex > 0 && vertex < self.segments())
    }

    /// True if the knife is lifted at a vertex, with or without a chain that starts there.
    fn is_corner(&self, vertex: usize, parting: Parting) -> bool {
        let n = self.segments();
        if self.run.joints[vertex % n].lift {
            return true;
        }
        let (is_ring, Parting { corner: limit, unit, .. }) = (self.is_closed(), parting);
        let count = if is_ring { n } else { n + 1 };
        Corners { point: |i| self.point(i), count, is_ring, limit, unit }.is_at(vertex % count)
    }

    /// The chain between two vertices, reversed if x rises. `joins` are the distances along the line from each vertex to the
    /// place where one chain takes over from the other, mm.
    fn chain(&self, [from, to]: [usize; 2], joins: [f64; 2], parting: Parting) -> Chain {
        let n = self.segments();
        let mut run = Run { shape: Shape::Open, points: vec![self.point(from)], ..self.empty() };
        run.joints.push(self.run.joints[from % n]);
        for segment in from..to {
            self.push(&mut run, segment, self.point(segment + 1));
        }
        let mut farthest = 0.0_f64;
        for is_end in [true, false] {
            let (vertex, join) = if is_end { (to, joins[1]) } else { (from, -joins[0]) };
            if self.goes_on(vertex) && !self.is_corner(vertex, parting) {
                let lead = parting.overlap + join;
                if lead < 0.0 {
                    shorten(&mut run, is_end, -lead);
                } else {
                    self.lead_on(&mut run, (vertex, is_end), Parting { overlap: lead, ..parting });
                }
                farthest = farthest.max(lead);
            }
        }
        if run.points[0].x < run.points[run.points.len() - 1].x {
            run.points.reverse();
            run.spans.reverse();
            run.joints.reverse();
            run.feeds.reverse();
            run.turned = !run.turned;
            run.joints.iter_mut().for_each(turn);
        }
        let mut least = f64::INFINITY;
        let falls = run.points.iter().all(|point| {
            least = least.min(point.x);
            point.x <= least + farthest
        });
        let steps = vec![Step::Run(run)];
        Chain { cut: self.cut, toolpath: Toolpath { steps, ..self.toolpath.clone() }, falls }
    }

    fn empty(&self) -> Run {
        Run { points: Vec::new(), spans: Vec::new(), joints: Vec::new(), feeds: Vec::new(), ..self.run.clone() }
    }

    /// Appends a segment that ends at a point.
    fn push(&self, run: &mut Run, segment: usize, to: Point) {
        let n = self.segments();
        run.points.push(to);
        run.spans.push(self.run.spans[segment % n]);
        run.feeds.push(self.run.feeds[segment % n]);
        let closed = self.is_closed();
        run.joints.push(self.run.joints[if closed { (segment + 1) % n } else { segment + 1 }]);
    }

    /// Extends a run along the line beyond its end or start by `parting.overlap`, but not beyond the next corner. Other
    /// overlaps are disabled at that end.
    fn lead_on(&self, run: &mut Run, (vertex, is_end): (usize, bool), parting: Parting) {
        let n = self.segments();
        let (mut rest, mut at) = (parting.overlap, vertex);
        let mut added = Vec::new();
        while rest > 0.0 && added.len() < n && self.goes_on(at) && (at == vertex || !self.is_corner(at, parting)) {
            let next = if is_end { at + 1 } else { (at + n - 1) % n };
            let segment = if is_end { at } else { next };
            let (from, to) = (self.point(at), self.point(next));
            let length = (to - from).norm();
            added.push((if length > rest { from + (to - from) * (rest / length) } else { to }, segment % n));
            rest -= length;
            at = next;
        }
        if is_end {
            let last = run.joints.len() - 1;
            run.joints[last] = Joint::default();
            for &(to, segment) in &added {
                self.push(run, segment, to);
            }
            let last = run.joints.len() - 1;
            run.joints[last].no_overcut = true;
        } else {
            run.joints[0] = Joint::default();
            for &(from, segment) in &added {
                run.points.insert(0, from);
                run.spans.insert(0, self.run.spans[segment]);
                run.feeds.insert(0, self.run.feeds[segment]);
                run.joints.insert(0, Joint::default());
            }
            run.joints[0].full_advance = true;
        }
    }
}

/// Shortens a run at its end or start by a distance, mm, which must be less than the length of its segment there.
fn shorten(run: &mut Run, is_end: bool, way: f64) {
    let last = run.points.len() - 1;
    let (end, next) = if is_end { (last, last - 1) } else { (0, 1) };
    let along = (run.points[next] - run.points[end]).normalize();
    run.points[end] += along * way;
    run.joints[end] = Joint { no_overcut: is_end, full_advance: !is_end, lift: false };
}

/// Adapts a joint to a run in reverse: conditions of the plunge become conditions of the lift.
fn turn(joint: &mut Joint) {
    std::mem::swap(&mut joint.full_advance, &mut joint.no_overcut);
}

/// Indices of the points at which x turns back along an open line, with both ends.
fn along(points: &[Point], back: f64) -> Vec<usize> {
    let last = points.len() - 1;
    let [mut low, mut high] = [0; 2];
    let mut ends = vec![0];
    for (i, point) in points.iter().enumerate() {
        if point.x < points[low].x - LEVEL {
            low = i;
        }
        if point.x > points[high].x + LEVEL {
            high = i;
        }
        if low == i && points[high].x - point.x > back || high == i && point.x - points[low].x > back {
            let is_down = low == i;
            turns(i..=last, |i| points[i].x, back, is_down, &mut ends);
            break;
        }
    }
    ends.push(last);
    ends
}

/// Indices of the points at which x turns back around a closed line. They run from the maximum of x to the same point one turn
/// later, counted beyond the end.
fn round(points: &[Point], back: f64) -> Vec<usize> {
    let n = points.len() - 1;
    let x = |i: usize| points[i % n].x;
    let most = points.iter().map(|point| point.x).fold(f64::NEG_INFINITY, f64::max);
    let is_top = |i: usize| x(i) > most - LEVEL;
    let first = (0..n).find(|&i| is_top(i) && !is_top(i + n - 1)).unwrap_or(0);
    let mut ends = vec![first];
    turns(first..=first + n, x, back, true, &mut ends);
    if ends.len() % 2 == 1 && ends.len() > 1 {
        // The last turn is at the top, and x falls behind it by no more than allowed.
        ends.pop();
    }
    ends.push(first + n);
    ends
}

/// Adds the points at which x turns back by more than allowed; of points with equal x, the first. `is_down` tells if x falls at
/// the start.
fn turns(
    places: std::ops::RangeInclusive<usize>,
    x: impl Fn(usize) -> f64,
    back: f64,
    mut is_down: bool,
    found: &mut Vec<usize>,
) {
    let mut best = *places.start();
    for i in places {
        let ahead = if is_down { x(best) - x(i) } else { x(i) - x(best) };
        if ahead > LEVEL {
            best = i;
        } else if -ahead > back.max(LEVEL) {
            found.push(best);
            (is_down, best) = (!is_down, i);
        }
    }
}

impl Chain {
    /// Points of the run, without the overlaps of the blade.
    pub(super) fn points(&self) -> &[Point] {
        match &self.toolpath.steps[..] {
            [Step::Run(run), ..] => &run.points,
            _ => &[],
        }
    }

    /// The path along the chain as drawn.
    pub(super) fn way(&self, parting: Parting) -> Vec<bound::Step> {
        let [Step::Run(run), ..] = &self.toolpath.steps[..] else { return Vec::new() };
        let (limit, unit) = (parting.corner, parting.unit);
        let corners = Corners { point: |i: usize| run.points[i], count: run.points.len(), is_ring: false, limit, unit };
        bound::drawn(&run.points, |at| run.joints[at].lift || corners.is_at(at))
    }

    /// Maximum and minimum x, mm.
    pub(super) fn span(&self) -> [f64; 2] {
        let x = self.points().iter().map(|point| point.x);
        [x.clone().fold(f64::NEG_INFINITY, f64::max), x.fold(f64::INFINITY, f64::min)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64)]) -> Vec<Point> {
        list.iter().map(|&(x, y)| Point::new(x, y)).collect()
    }

    #[test]
    fn a_rectangle_has_two_chains_with_one_edge_across_the_feed_each() {
        let ring = points(&[(0.0, 0.0), (300.0, 0.0), (300.0, 200.0), (0.0, 200.0), (0.0, 0.0)]);
        assert_eq!(round(&ring, 0.0), [1, 3, 5]);
    }

    #[test]
    fn a_turn_back_parts_a_line_only_when_it_is_long_enough() {
        let w = points(&[(0.0, 0.0), (50.0, 10.0), (45.0, 20.0), (100.0, 30.0), (0.0, 40.0), (0.0, 0.0)]);
        assert_eq!(round(&w, 1.0), [3, 4, 6, 7, 8]);
        assert_eq!(round(&w, 6.0), [3, 4, 8]);
        assert_eq!(round(&w, 200.0), [3, 8]);
        let open = points(&[(0.0, 0.0), (2.0, 0.0), (1.0, 1.0), (60.0, 1.0), (20.0, 1.0)]);
        assert_eq!(along(&open, 5.0), [0, 3, 4]);
        assert_eq!(along(&open, 0.5), [0, 1, 2, 3, 4]);
        assert_eq!(along(&open, 100.0), [0, 4]);
    }
}
