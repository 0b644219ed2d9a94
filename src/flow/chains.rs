//! Cuts to chains: stretches of a cut that one head makes, with x falling on the whole, since the cloth comes towards +X.
//!
//! A cut is parted at the local extrema of x. An edge across the feed goes to the chain before it where it starts one and
//! behind it where it ends one, so that each of two chains of a rectangle has one. A turn back that is shorter than what a
//! caller allows parts nothing: a head with some travel along the feed makes it by itself.

use super::bound;
use super::join::Join;
use crate::geom::{Point, corner};
use crate::ir::list::Joint;
use crate::ir::toolpath::{Run, Shape, Step, Toolpath};

/// A cut of the marker as it is traced: one run.
#[derive(Debug, Clone)]
pub(super) struct Line {
    /// Its place among the cuts of the marker.
    pub(super) cut: u32,
    /// Its toolpath, of which the run was taken.
    pub(super) toolpath: Toolpath,
    /// The whole of it.
    pub(super) run: Run,
}

/// How a line is parted.
#[derive(Debug, Clone, Copy)]
pub(super) struct Parting {
    /// Turns back that are no longer than that part nothing, mm.
    pub(super) back: f64,
    /// How far a chain goes on along the line beyond an end at which another one goes on, mm.
    pub(super) overlap: f64,
    /// Width of the blade, mm.
    pub(super) blade: f64,
    /// A turn that is more is a corner, rad.
    pub(super) corner: f64,
    /// What the points are rounded to, mm; 0 = nothing.
    pub(super) unit: f64,
}

/// A stretch of a cut that one head makes.
#[derive(Debug, Clone)]
pub(super) struct Chain {
    /// The cut, by its place in the marker.
    pub(super) cut: u32,
    /// One open run, raw.
    pub(super) toolpath: Toolpath,
    /// Whether x falls all along it, but for what an overlap leads back.
    pub(super) falls: bool,
}

/// Equal x, mm: rounding of coordinates of some metres.
const LEVEL: f64 = 1e-9;

impl Line {
    /// The line of a raw toolpath; `None` of what is no cut.
    pub(super) fn new(cut: u32, mut toolpath: Toolpath) -> Option<Self> {
        match toolpath.steps.pop() {
            Some(Step::Run(run)) => Some(Self { cut, toolpath, run }),
            Some(Step::PlungeCut(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_)) | None => None,
        }
    }

    /// Its chains.
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

    /// How far behind the end of a chain, along the line, the next one takes over from it, mm.
    fn join(&self, ends: &[usize], i: usize, parting: Parting) -> f64 {
        let vertex = ends[i];
        let x = |end: usize| self.point(end).x;
        // Blades are plunged where chains begin: at the greatest x.
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

    /// Number of its segments.
    fn segments(&self) -> usize {
        self.run.spans.len()
    }

    /// A vertex, counted round and round.
    fn point(&self, vertex: usize) -> Point {
        let count = if self.is_closed() { self.segments() } else { self.run.points.len() };
        self.run.points[vertex % count]
    }

    /// Whether another stretch goes on at a vertex.
    fn goes_on(&self, vertex: usize) -> bool {
        self.is_closed() || (vertex > 0 && vertex < self.segments())
    }

    /// Whether the knife is lifted at a vertex, whatever comes behind it.
    fn is_corner(&self, vertex: usize, parting: Parting) -> bool {
        let n = self.segments();
        if self.run.joints[vertex % n].lift {
            return true;
        }
        let (count, [back, on]) = if self.is_closed() { (n, [n - 1; 2]) } else { (n + 1, [vertex, n - vertex]) };
        let at = vertex % count;
        let before = (1..=back).map(|i| self.point((at + count - i) % count));
        let behind = (1..=on).map(|i| self.point((at + i) % count));
        corner::is_corner(self.point(vertex), &before, &behind, parting.corner, parting.unit)
    }

    /// The chain between two vertices, so far behind which it takes over and is taken over from, mm; turned round where x rises.
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

    /// Adds a segment that ends at a point.
    fn push(&self, run: &mut Run, segment: usize, to: Point) {
        let n = self.segments();
        run.points.push(to);
        run.spans.push(self.run.spans[segment % n]);
        run.feeds.push(self.run.feeds[segment % n]);
        let closed = self.is_closed();
        run.joints.push(self.run.joints[if closed { (segment + 1) % n } else { segment + 1 }]);
    }

    /// Leads a stretch on along the line beyond its end, or before its start, up to the next corner at the farthest; no other
    /// overlap goes there.
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

/// Takes a way off an end of a run, or off its start, mm: less than its segment there.
fn shorten(run: &mut Run, is_end: bool, way: f64) {
    let last = run.points.len() - 1;
    let (end, next) = if is_end { (last, last - 1) } else { (0, 1) };
    let along = (run.points[next] - run.points[end]).normalize();
    run.points[end] += along * way;
    run.joints[end] = Joint { no_overcut: is_end, full_advance: !is_end, lift: false };
}

/// A joint of a run that is turned round: what held at the plunge holds at the lift.
fn turn(joint: &mut Joint) {
    std::mem::swap(&mut joint.full_advance, &mut joint.no_overcut);
}

/// Where x turns back along an open line, its ends included.
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

/// The same round a closed one, from its greatest x to that again, counted on beyond its end.
fn round(points: &[Point], back: f64) -> Vec<usize> {
    let n = points.len() - 1;
    let x = |i: usize| points[i % n].x;
    let most = points.iter().map(|point| point.x).fold(f64::NEG_INFINITY, f64::max);
    let is_top = |i: usize| x(i) > most - LEVEL;
    let first = (0..n).find(|&i| is_top(i) && !is_top(i + n - 1)).unwrap_or(0);
    let mut ends = vec![first];
    turns(first..=first + n, x, back, true, &mut ends);
    if ends.len() % 2 == 1 && ends.len() > 1 {
        // The last turn was one at the top, and what is behind it falls no farther than what is allowed.
        ends.pop();
    }
    ends.push(first + n);
    ends
}

/// Where x turns back by more than what is allowed, the first of places alike; `is_down` says how it begins.
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
    /// Its run as the line has it, without the overlaps of the blade.
    pub(super) fn points(&self) -> &[Point] {
        match &self.toolpath.steps[..] {
            [Step::Run(run), ..] => &run.points,
            _ => &[],
        }
    }

    /// The way along it, as it is drawn.
    pub(super) fn way(&self, parting: Parting) -> Vec<bound::Step> {
        let [Step::Run(run), ..] = &self.toolpath.steps[..] else { return Vec::new() };
        let is_corner = |at: usize| {
            let (before, behind) = (run.points[..at].iter().rev().copied(), run.points[at + 1..].iter().copied());
            run.joints[at].lift || corner::is_corner(run.points[at], &before, &behind, parting.corner, parting.unit)
        };
        bound::drawn(&run.points, is_corner)
    }

    /// Where it starts and where it ends along the feed, mm.
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
