//! Which closed line lies in which.

use std::borrow::Cow;

use super::line::{Line, SMALL_OUTLINE};
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::nest::Shape;
use crate::geom::region::Regions;
use crate::geom::{Extent, Point};
use crate::ir::drawing::Vertex;

/// Share of a line's box that the box around it holds at least, and of its places that lie in the line around it: hems are
/// drawn past the corners of their parts, and parts that touch overlap by rounding.
const BOX_SHARE: f64 = 0.8;
const SHARE: f64 = 0.75;
/// Places of a line that are looked at.
const SAMPLES: usize = 12;

/// What holds each line.
#[derive(Debug, Default)]
pub(super) struct Nest {
    /// The smallest closed line around it, and the largest, as indices of lines.
    around: Vec<Option<[u32; 2]>>,
    /// Whether the search ended before its time.
    pub(super) is_cut_short: bool,
}

/// Lines that may hold others.
struct Holders<'a> {
    lines: &'a [Line],
    large: Vec<usize>,
    boxes: Boxes,
}

impl Nest {
    /// The smallest closed line around one.
    pub(super) fn parent(&self, line: usize) -> Option<usize> {
        self.around[line].map(|[least, _]| least as usize)
    }

    /// The largest closed line around one.
    pub(super) fn outermost(&self, line: usize) -> Option<usize> {
        self.around[line].map(|[_, most]| most as usize)
    }

    /// Finds what holds each closed line: what is larger and has a place well inside it, and most of its places.
    pub(super) fn of(lines: &[Line], vertices: &[Vertex], work: &mut Budget) -> Self {
        let mut nest = Self { around: vec![None; lines.len()], is_cut_short: true };
        let holders = Holders::of(lines);
        // Few lines hold others: only these are looked at from within.
        let mut holds = vec![false; holders.large.len()];
        let mut held = Vec::new();
        for inner in (0..lines.len()).filter(|&i| lines[i].is_outline()) {
            let middle = middle(&lines[inner].extent);
            if !work.spend(holders.boxes.cost_at(middle)) {
                return nest;
            }
            let before = held.len();
            for outer in holders.boxes.at(middle).filter(|&outer| holders.may_hold(outer, inner)) {
                holds[outer] = true;
                held.truncate(before);
                held.push(inner);
            }
        }
        let owners = holds.iter().zip(0..).filter(|(holds, _)| **holds).map(|(_, outer)| outer);
        let points = |outer: u32| lines[holders.large[outer as usize]].points(vertices);
        let regions = Regions::new(owners, |outer| vec![Cow::Owned(points(outer))]);
        for inner in held {
            let Some(around) = holders.around(inner, (&regions, vertices), work) else { return nest };
            nest.around[inner] = around;
        }
        nest.is_cut_short = false;
        nest
    }
}

impl<'a> Holders<'a> {
    fn of(lines: &'a [Line]) -> Self {
        let is_large = |i: &usize| lines[*i].is_outline() && lines[*i].size() > SMALL_OUTLINE;
        let large: Vec<usize> = (0..lines.len()).filter(is_large).collect();
        let boxes = Boxes::new(large.iter().map(|&i| lines[i].extent).collect());
        Self { lines, large, boxes }
    }

    /// Whether one line is larger than another; of two that are the same the first one is.
    fn is_larger(&self, outer: usize, inner: usize) -> bool {
        let (a, b) = (self.lines[outer].area, self.lines[inner].area);
        a > b || a.to_bits() == b.to_bits() && outer < inner
    }

    fn may_hold(&self, outer: usize, inner: usize) -> bool {
        let (box_around, own) = (&self.boxes.all()[outer], &self.lines[inner].extent);
        let both = Extent { min: own.min.sup(&box_around.min), max: own.max.inf(&box_around.max) };
        let area = |extent: &Extent| extent.size().0 * extent.size().1;
        self.is_larger(self.large[outer], inner) && area(&both) >= BOX_SHARE * area(own)
    }

    /// The smallest and the largest of the lines around one; nothing when the search is ended.
    #[allow(clippy::option_option, reason = "what lies in nothing is found, too")]
    fn around(
        &self,
        inner: usize,
        (regions, vertices): (&Regions, &[Vertex]),
        work: &mut Budget,
    ) -> Option<Option<[u32; 2]>> {
        let points = self.lines[inner].points(vertices);
        let Some(at) = Shape::new(&[&points]).inner() else { return Some(None) };
        if !work.spend(regions.cost_at(at)) {
            return None;
        }
        let around = regions.owners_at(at);
        let mut around: Vec<u32> = around.into_iter().filter(|&outer| self.may_hold(outer as usize, inner)).collect();
        if !around.is_empty() {
            let mut counts = vec![0; around.len()];
            if !work.spend(SAMPLES * regions.cost_at(at)) {
                return None;
            }
            for sample in samples(&points) {
                let owners = regions.owners_at(sample);
                counts
                    .iter_mut()
                    .zip(&around)
                    .for_each(|(n, outer)| *n += usize::from(owners.binary_search(outer).is_ok()));
            }
            let mut counts = counts.into_iter();
            around.retain(|_| counts.next().is_some_and(|n| n as f64 >= SHARE * SAMPLES as f64));
        }
        let around = || around.iter().map(|&outer| self.large[outer as usize]);
        let least = around().reduce(|a, b| if self.is_larger(a, b) { b } else { a });
        let most = around().reduce(|a, b| if self.is_larger(a, b) { a } else { b });
        Some(least.zip(most).map(|(least, most)| [least as u32, most as u32]))
    }
}

/// The middle of a box.
pub(super) fn middle(extent: &Extent) -> Point {
    extent.min + (extent.max - extent.min) / 2.0
}

/// Middles of edges of a ring, evenly among them: edges that lie on those of another ring count either way.
fn samples(ring: &[Point]) -> impl Iterator<Item = Point> {
    let edges = ring.len() - 1;
    (0..SAMPLES).map(move |k| {
        let place = (2 * k + 1) * edges;
        let (edge, share) = (place / (2 * SAMPLES), (place % (2 * SAMPLES)) as f64 / (2 * SAMPLES) as f64);
        ring[edge] + (ring[edge + 1] - ring[edge]) * share
    })
}
