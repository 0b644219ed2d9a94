//! Spike: spurs of an outline, out and straight back, and boxes too narrow for anything else become slits.
//!
//! Needs: welded contours. From the tip of such a spur, or its narrow bottom, both sides lead back to the mouth:
//!
//! - Sides within rounding of each other are one line that is drawn twice. A length of 1 to 25 mm is a slit. If the sides meet
//!   at the root to the bit, a shorter spur is the jitter of a digitiser and is dropped, and a longer one is a line from the
//!   edge on, which is cut once and reported. Everything else stays as drawn.
//! - Sides up to `notch.box_max_mm` apart and 1.5 to 15 mm long are a box or a needle, which is a slit along its middle.
//!
//! Where the sides do not meet at the root to the bit, the outline must turn away from the mouth on both sides: sides that go
//! on belong to a strap, or to a corner. A bent spur is cut in straight stretches. Leaves true: each outline has at least three
//! segments and runs straight over the mouths, and each slit starts on the edge at the middle of its mouth.

use std::collections::BTreeSet;

use rayon::prelude::*;

use super::pass::MarkerPass;
use super::retrace::Found;
use crate::diagnostic::Diagnostics;
use crate::geom::monotone::Chain;
use crate::geom::{Point, Vector, bits, polyline};
use crate::ir::list::{Joint, Range, Segment, SegmentList};
use crate::ir::marker::{Contour, Marker, Notch, NotchKind};
use crate::machine::Job;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "spike", about: "makes slits of narrow boxes and of ways out and back in an outline", run };

/// Lengths of a slit that is drawn out and back, mm: shorter ones are jitter, longer ones are no notches.
const SHORTEST: f64 = 1.0;
const LONGEST: f64 = 25.0;
/// Depths of boxes, mm.
const BOX_DEPTH: [f64; 2] = [1.5, 15.0];
/// Distance by which rounding to a grid may move two points against each other, in units of the grid: its diagonal.
const ROUNDING: f64 = std::f64::consts::SQRT_2;
/// Distance by which rounding may move two points in a file without a grid, mm: such files have two or three decimals.
const LEAST_SLACK: f64 = 0.01;
/// Cosine of the least angle between a slit and the outline beside its mouth: 25 degrees.
const LEAVING: f64 = 0.906;
/// Length of outline beside a mouth that gives its direction, mm: shorter segments may have that of the grid.
const BESIDE: f64 = 1.0;
/// Greatest number of vertices of one side, and beside a mouth: a guard against tangles.
const MOST_STEPS: usize = 256;
/// Greatest number of searches of an outline, since a spur may have spurs of its own.
const MOST_ROUNDS: usize = 8;
/// Least number of segments that an outline keeps.
const LEAST_LEFT: usize = 3;

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    let Marker { pieces, list, unit, .. } = marker;
    let measure = Measure::new(*unit, job);
    let outlines: Vec<([usize; 2], Vec<usize>)> = pieces
        .par_iter()
        .enumerate()
        .flat_map_iter(|(i, piece)| {
            let closed = piece.contours.iter().enumerate().filter(|(_, contour)| contour.closed);
            let tips = closed.map(|(k, contour)| {
                ([i, k], measure.tips(&list.points(contour.range), &list.chains(contour.range).all))
            });
            tips.filter(|(_, tips)| !tips.is_empty()).collect::<Vec<_>>()
        })
        .collect();
    let mut long = Found::default();
    for ([i, k], tips) in outlines {
        let Pruned { slits, lines } = prune(list, &mut pieces[i].contours[k].range, tips, measure);
        let piece = &mut pieces[i];
        for line in lines {
            long.add(piece.number, line.iter().map(|segment| (segment.to - segment.from).norm()).sum(), line[0].span);
            piece.contours.extend(list.append(line).map(|range| Contour { range, closed: false }));
        }
        if !slits.is_empty() {
            piece.notches.extend(slits);
            piece.notches.sort_by_key(|notch| notch.span); // stable: notches without a block keep their order
        }
    }
    long.say_out_and_back(diagnostics);
}

/// Cuts that replace the spurs of an outline.
struct Pruned {
    slits: Vec<Notch>,
    lines: Vec<Vec<Segment>>,
}

/// Removes the spurs of an outline, repeatedly until there are none; the first search is at `tips`.
fn prune(list: &mut SegmentList, range: &mut Range, mut tips: Vec<usize>, measure: Measure) -> Pruned {
    let mut segments: Vec<Segment> = list.walk(*range).map(|(_, segment)| segment).collect();
    let (mut slits, mut lines) = (Vec::new(), Vec::new());
    let mut is_changed = false;
    for _ in 0..MOST_ROUNDS {
        let ways = ways(&segments, &tips, measure);
        if ways.is_empty() {
            break;
        }
        slits.extend(ways.iter().flat_map(|way| way.slits.iter().copied()));
        lines.extend(ways.iter().map(|way| way.line.clone()).filter(|line| !line.is_empty()));
        (segments, tips) = without(&segments, &ways, &tips);
        is_changed = true;
    }
    if is_changed && let Some(rest) = list.append(segments) {
        *range = rest;
    }
    Pruned { slits, lines }
}

/// Limits for spurs, mm.
#[derive(Debug, Clone, Copy)]
struct Measure {
    /// Distance that rounding may cause.
    slack: f64,
    /// Greatest distance between two sides.
    width: f64,
}

/// A spur of an outline.
#[derive(Debug)]
struct Way {
    /// Its first segment and the number of its segments.
    first: usize,
    count: usize,
    /// The point where the outline goes on.
    root: Point,
    /// Its cuts: slits, or a line that is too long for one.
    slits: Vec<Notch>,
    line: Vec<Segment>,
}

impl Measure {
    fn new(unit: f64, job: &Job) -> Self {
        let slack = if unit > 0.0 { ROUNDING * unit } else { LEAST_SLACK };
        Self { slack, width: job.profile.notch.box_max_mm + slack }
    }

    /// True if two sides that start at a tip, or side by side at a narrow bottom, stay side by side at first.
    fn may_follow(self, one: [Point; 2], other: [Point; 2]) -> bool {
        let off = |[_, end]: [Point; 2], [from, to]: [Point; 2]| polyline::distance_to_segment(end, from, to);
        off(one, other).min(off(other, one)) <= self.width
    }

    /// Candidate tips of a closed line, in order: segments at whose start, or over which, it turns back. Its last point is the
    /// first again. A line does not turn back within a chain, so each is the first or the last segment of a chain.
    fn tips(self, points: &[Point], chains: &[Chain]) -> Vec<usize> {
        let count = points.len().saturating_sub(1);
        if count <= LEAST_LEFT {
            return Vec::new();
        }
        let most = self.width * self.width;
        let way = |i: usize| points[i + 1] - points[i];
        let is_at = |i: usize| {
            let before = if i > 0 { i - 1 } else { count - 1 };
            let next = if i + 1 < count { i + 1 } else { 0 };
            is_tip([before, i, next].map(way), most) && self.is_narrow(points, i)
        };
        let ends = chains.iter().flat_map(|chain| {
            let [first, last] = [chain.first, chain.last - 1].map(|i| i as usize);
            [Some(first), Some(last).filter(|&last| last > first)]
        });
        ends.flatten().filter(|&i| is_at(i)).collect()
    }

    /// True if the sides beside a segment of a closed line stay side by side at first, or the previous segment and the segment
    /// itself do.
    fn is_narrow(self, points: &[Point], i: usize) -> bool {
        let count = points.len() - 1;
        let [a, b] = [points[if i == 0 { count - 1 } else { i - 1 }], points[i]];
        let [c, d] = [points[i + 1], points[if i + 2 <= count { i + 2 } else { 1 }]];
        self.may_follow([b, a], [b, c]) || self.may_follow([b, a], [c, d])
    }
}

/// True if a line turns back at the end of the first of three segments, or over the second one if that is short; `most` is the
/// square of its greatest length.
fn is_tip([before, bottom, next]: [Vector; 3], most: f64) -> bool {
    before.dot(&bottom) < 0.0 || before.dot(&next) < 0.0 && bottom.norm_squared() <= most
}

/// Spurs of an outline with these tips; no two share a segment.
fn ways(segments: &[Segment], tips: &[usize], measure: Measure) -> Vec<Way> {
    let count = segments.len();
    let mut found: Vec<Way> = Vec::new();
    if count <= LEAST_LEFT {
        return found;
    }
    let way = |i: usize| segments[i % count].to - segments[i % count].from;
    let most = measure.width * measure.width;
    let (mut is_taken, mut left) = (vec![false; count], count);
    for &i in tips {
        if is_taken[i] {
            continue;
        }
        let [before, bottom, next] = [i + count - 1, i, i + 1].map(way);
        // The bottom of a box is tried first: a way back that starts at an angle may look like a tip of its own.
        let bottoms = [bottom.norm_squared() <= most && before.dot(&next) < 0.0, before.dot(&bottom) < 0.0];
        let tips = [[i, i + 1], [i, i]].into_iter().zip(bottoms).filter(|(_, may_be)| *may_be);
        let best = tips.filter_map(|(tip, _)| Sides::new(segments, tip).way(measure)).max_by_key(|way| way.count);
        let Some(way) = best else { continue };
        let mut of_way = (way.first..way.first + way.count).map(|k| k % count);
        if way.count + LEAST_LEFT > left || of_way.clone().any(|k| is_taken[k]) {
            continue;
        }
        left -= way.count;
        of_way.by_ref().for_each(|k| is_taken[k] = true);
        found.push(way);
    }
    found
}

/// The two sides of a spur, from its tip on.
struct Sides<'a> {
    segments: &'a [Segment],
    /// The vertices at the ends of the bottom; equal at a tip.
    tip: [usize; 2],
    /// Number of vertices passed on each side, back and ahead.
    steps: [usize; 2],
    /// Greatest distance between the sides so far.
    apart: f64,
}

impl<'a> Sides<'a> {
    fn new(segments: &'a [Segment], tip: [usize; 2]) -> Self {
        let mut sides = Self { segments, tip, steps: [0; 2], apart: 0.0 };
        sides.apart = (sides.ahead(0) - sides.back(0)).norm();
        sides
    }

    /// The vertex `steps` steps before the tip.
    fn back(&self, steps: usize) -> Point {
        let count = self.segments.len();
        self.segments[(self.tip[0] + count - steps % count) % count].from
    }

    /// The vertex `steps` steps after the tip.
    fn ahead(&self, steps: usize) -> Point {
        self.segments[(self.tip[1] + steps) % self.segments.len()].from
    }

    /// Follows both sides while they stay side by side, and returns the longest spur that ends at a mouth.
    fn way(mut self, measure: Measure) -> Option<Way> {
        let most = self.segments.len().saturating_sub(LEAST_LEFT).min(MOST_STEPS);
        let mut longest = None;
        let mut reached = 0.0;
        let may_go_on = |sides: &Self, reached: f64| reached <= LONGEST + measure.width || sides.apart <= measure.slack;
        while self.steps[0] + self.steps[1] < most && may_go_on(&self, reached) {
            let [back, ahead] = self.steps;
            let (here, next) = ([self.back(back), self.ahead(ahead)], [self.back(back + 1), self.ahead(ahead + 1)]);
            let both = (next[1] - next[0]).norm();
            let one = polyline::distance_to_segment(next[0], here[1], next[1]);
            let other = polyline::distance_to_segment(next[1], here[0], next[0]);
            if both <= measure.width {
                self.steps = [back + 1, ahead + 1];
                self.apart = self.apart.max(both);
                longest = self.judged(measure).or(longest);
            } else if one <= measure.width && one <= other {
                (self.steps[0], self.apart) = (back + 1, self.apart.max(one));
            } else if other <= measure.width {
                (self.steps[1], self.apart) = (ahead + 1, self.apart.max(other));
            } else {
                break;
            }
            if self.steps[0] != self.steps[1] && self.gap() <= measure.width {
                longest = self.judged(measure).or(longest);
            }
            reached = (self.back(self.steps[0]) - self.back(0)).norm();
        }
        longest
    }

    /// Distance of the sides at their present ends.
    fn gap(&self) -> f64 {
        (self.ahead(self.steps[1]) - self.back(self.steps[0])).norm()
    }

    /// The spur up to here, if it is one.
    fn judged(&self, measure: Measure) -> Option<Way> {
        let [back, ahead] = self.steps;
        if back == 0 || ahead == 0 {
            return None;
        }
        let mouth = [self.back(back), self.ahead(ahead)];
        let is_exact = bits(mouth[0]) == bits(mouth[1]);
        let middle = |[a, b]: [Point; 2]| a + (b - a) / 2.0;
        let (root, tip) = (middle(mouth), middle([self.back(0), self.ahead(0)]));
        let depth = (tip - root).norm();
        let is_line = self.apart <= measure.slack;
        let outwards: Vec<Point> = (0..=back).rev().map(|k| self.back(k)).collect();
        let line = [&[root], &outwards[1..back], &[tip]].concat();
        let length = polyline::length(&line);
        if is_exact && is_line && length < SHORTEST {
            return Some(self.taken(root, Vec::new()));
        }
        let [least, most] = if is_line {
            [SHORTEST - measure.slack, LONGEST]
        } else {
            [BOX_DEPTH[0] - measure.slack, BOX_DEPTH[1] + measure.slack]
        };
        let off = self.gap().max(self.apart) / 2.0 + measure.slack;
        let sides = || (0..=back).map(|k| self.back(k)).chain((0..=ahead).map(|k| self.ahead(k)));
        if is_line && is_exact && length > LONGEST {
            return Some(Way { line: self.outwards(), ..self.taken(root, Vec::new()) });
        }
        if is_line && is_exact {
            let ends = stretches(&line, measure.slack);
            return Some(self.taken(root, ends.into_iter().map(|[from, to]| [line[from], line[to]]).collect()));
        }
        let is_slit = (least..=most).contains(&depth)
            && sides().all(|point| polyline::distance_to_segment(point, root, tip) <= off)
            && self.leaves((tip - root) / depth, measure);
        is_slit.then(|| self.taken(root, vec![[root, tip]]))
    }

    /// True if the outline turns away from the mouth on both sides of a spur in that direction.
    fn leaves(&self, along: Vector, measure: Measure) -> bool {
        let [back, ahead] = self.steps;
        let least = BESIDE.max(2.0 * measure.slack);
        let beside = |point: &dyn Fn(usize) -> Point, from: usize| {
            let far = (1..MOST_STEPS.min(self.segments.len())).map(|k| point(from + k) - point(from));
            let mut last = None;
            far.map_while(|way| {
                let is_short = last.is_none_or(|last: Vector| last.norm() < least);
                is_short.then(|| *last.insert(way))
            })
            .last()
        };
        let sides = [beside(&|k| self.back(k), back), beside(&|k| self.ahead(k), ahead)];
        sides.into_iter().flatten().all(|way| way.dot(&along).abs() < LEAVING * way.norm())
    }

    /// The line from the mouth to the tip.
    fn outwards(&self) -> Vec<Segment> {
        let (total, back) = (self.segments.len(), self.steps[0]);
        let first = self.tip[0] + total - back;
        (first..first + back).map(|k| Segment { joint: Joint::default(), ..self.segments[k % total] }).collect()
    }

    /// The spur, with a slit between each pair of ends.
    fn taken(&self, root: Point, cuts: Vec<[Point; 2]>) -> Way {
        let total = self.segments.len();
        let [back, ahead] = self.steps;
        let first = (self.tip[0] + total - back) % total;
        let count = back + ahead + (self.tip[1] - self.tip[0]);
        let percent = (first..first + count).map(|k| self.segments[k % total].percent).min().unwrap_or_default();
        let span = self.segments[(self.tip[0] + total - 1) % total].span;
        // Each stretch of a bent spur has the block that leads to its end.
        let span_of = |to: Point| {
            let leads = (first..first + back).map(|k| &self.segments[k % total]).find(|segment| segment.to == to);
            leads.map_or(span, |segment| segment.span)
        };
        let slit = |[root, tip]: [Point; 2]| Notch { kind: NotchKind::Slit, root, tip, percent, span: span_of(tip) };
        Way { first, count, root, slits: cuts.into_iter().map(slit).collect(), line: Vec::new() }
    }
}

/// Straight stretches of a line, by their ends: all places between are within `slack` mm of them.
fn stretches(line: &[Point], slack: f64) -> Vec<[usize; 2]> {
    let mut stretches = Vec::new();
    let mut first = 0;
    while first + 1 < line.len() {
        let is_straight = |&last: &usize| {
            let between = &line[first + 1..last];
            between.iter().all(|&at| polyline::distance_to_segment(at, line[first], line[last]) <= slack)
        };
        let last = (first + 1..line.len()).take_while(is_straight).last().unwrap_or(first + 1);
        stretches.push([first, last]);
        first = last;
    }
    stretches
}

/// Outline without its spurs, straight over their mouths, and its candidate tips: those left from before, and segments about a
/// mouth.
fn without(segments: &[Segment], ways: &[Way], tips: &[usize]) -> (Vec<Segment>, Vec<usize>) {
    let count = segments.len();
    // The entry after the last segment is the first segment again, and the one before the first is the last.
    let mut way_of: Vec<Option<&Way>> = vec![None; count + 2];
    for way in ways {
        (way.first..way.first + way.count).for_each(|k| way_of[k % count + 1] = Some(way));
    }
    (way_of[0], way_of[count + 1]) = (way_of[count], way_of[1]);
    // Segments of spurs and beside them; all others stay as they are.
    let about: BTreeSet<usize> = ways
        .iter()
        .flat_map(|way| (way.first + count - 1..=way.first + count + way.count).map(|k| k % count))
        .collect();
    let mut rest =
        Rest { left: Vec::with_capacity(count), asked: Joint::default(), tips: BTreeSet::new(), moved: Vec::new() };
    let mut passed = 0;
    for i in about {
        rest.keep(&segments[passed..i], passed, tips);
        rest.take(&segments[i], i, [way_of[i], way_of[i + 1], way_of[i + 2]]);
        passed = i + 1;
    }
    rest.keep(&segments[passed..], passed, tips);
    let Rest { mut left, asked, mut tips, moved } = rest;
    if let Some(first) = left.first_mut() {
        first.joint = merged(first.joint, Joint { lift: asked.lift, ..Joint::default() });
    }
    let rest = left.len();
    if rest > 0 {
        tips.extend(moved.into_iter().flat_map(|at| [at + rest - 1, at, at + 1]).map(|at| at % rest));
    }
    (left, tips.into_iter().collect())
}

/// The part of an outline that is left without its spurs, so far.
struct Rest {
    left: Vec<Segment>,
    /// Requests at a mouth, which move to the next segment; at the start of the contour they hold for all of it.
    asked: Joint,
    /// Tips of before that are left.
    tips: BTreeSet<usize>,
    /// Segments with another end or another neighbour than before; they and those beside them may be tips.
    moved: Vec<usize>,
}

impl Rest {
    /// Keeps adjacent segments as they are; the first has index `from` in the outline with its `tips`.
    fn keep(&mut self, segments: &[Segment], from: usize, tips: &[usize]) {
        let first = self.left.len();
        self.left.extend_from_slice(segments);
        if let Some(next) = self.left.get_mut(first) {
            next.joint = merged(std::mem::take(&mut self.asked), next.joint);
        }
        let [start, end] = [from, from + segments.len()].map(|at| tips.partition_point(|&tip| tip < at));
        self.tips.extend(tips[start..end].iter().map(|tip| tip - from + first));
    }

    /// Takes segment `i` of the outline, which is in a spur or beside one; `ways` are the spurs of the segment before it, of
    /// itself and of the one behind.
    fn take(&mut self, segment: &Segment, i: usize, [before, own, after]: [Option<&Way>; 3]) {
        if let Some(way) = own {
            if i == way.first || i == 0 {
                self.asked = merged(self.asked, segment.joint);
            }
            // Adjacent spurs may have different mouths: between these the outline goes straight on.
            if let Some(other) = before.filter(|other| other.first != way.first && other.root != way.root) {
                self.push(Segment { from: other.root, to: way.root, joint: Joint::default(), ..*segment });
            }
            return;
        }
        let from = before.map_or(segment.from, |way| way.root);
        let to = after.map_or(segment.to, |way| way.root);
        if from == to {
            self.asked = merged(self.asked, segment.joint);
            self.moved.push(self.left.len());
            return;
        }
        let joint = merged(std::mem::take(&mut self.asked), segment.joint);
        self.push(Segment { from, to, joint, ..*segment });
    }

    fn push(&mut self, segment: Segment) {
        self.moved.push(self.left.len());
        self.left.push(segment);
    }
}

fn merged(one: Joint, other: Joint) -> Joint {
    Joint {
        lift: one.lift | other.lift,
        full_advance: one.full_advance | other.full_advance,
        no_overcut: one.no_overcut | other.no_overcut,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::list::FULL_SPEED;
    use crate::source::Span;

    /// Fixture: an outline with two adjacent teeth, from each of its points on.
    #[test]
    fn an_outline_goes_on_from_mouth_to_mouth_of_ways_that_touch() {
        let points = [(0, 0), (400, 0), (400, 50), (402, 1), (404, 50), (406, 0), (800, 0), (800, 800), (0, 800)];
        let points = points.map(|(x, y)| Point::new(f64::from(x) / 10.0, f64::from(y) / 10.0));
        let count = points.len();
        for start in 0..count {
            let at = |i: usize| points[(start + i) % count];
            let segment = |i: usize| {
                let (joint, span) = (Joint::default(), Span::default());
                Segment { from: at(i), to: at(i + 1), span, joint, percent: FULL_SPEED }
            };
            let segments: Vec<Segment> = (0..count).map(segment).collect();
            let way = |first: usize| {
                let first = (first + count - start) % count;
                Way {
                    first,
                    count: 2,
                    root: at(first) + (at(first + 2) - at(first)) / 2.0,
                    slits: Vec::new(),
                    line: Vec::new(),
                }
            };
            let (left, _) = without(&segments, &[way(1), way(3)], &[]);
            assert_eq!(left.len(), 6, "from {start}");
            let next = left.iter().cycle().skip(1);
            assert!(left.iter().zip(next).all(|(one, next)| one.to == next.from), "from {start}: {left:?}");
        }
    }
}
