//! Outlines of a block, and the outlines inside others: most blocks have one, a drawing without blocks has all.

use std::cmp::Reverse;

use super::chain::{Chain, REACH};
use crate::geom::budget::Budget;
use crate::geom::shape::Shape;
use crate::geom::{Extent, Point, polyline, ring};

/// Distance from an outline within which its items may lie, mm: notches stand on it.
const BESIDE: f64 = 1.0;

/// An outline with those inside it, which are cut-outs.
#[derive(Debug, Clone)]
pub(super) struct Outline {
    pub(super) edge: Chain,
    pub(super) inner: Vec<Chain>,
    points: Vec<Point>,
    extent: Extent,
}

impl Outline {
    /// An outline without inner ones.
    pub(super) fn of(edge: Chain) -> Self {
        let points = edge.points();
        let extent = Extent::of(&points).grown(BESIDE);
        Self { edge, inner: Vec::new(), points, extent }
    }

    /// Inner outlines that take more than half of it, except for the outline itself drawn again.
    pub(super) fn large_inner(&self) -> impl Iterator<Item = &Chain> {
        let most = ring::area(&self.points).abs() / 2.0;
        let large = self.inner.iter().filter(move |line| ring::area(&line.points()).abs() > most);
        large.filter(|line| !run_along_each_other([&line.points(), &self.points]))
    }

    /// True if it is inside a closed line, and not just beside it.
    pub(super) fn is_in(&self, line: &Chain) -> bool {
        Extent::of(&line.points()).covers(&self.extent)
    }

    /// True if a place is in it or beside it, and the work budget lasts.
    pub(super) fn holds(&self, at: Point, work: &mut Budget) -> bool {
        work.spend(1)
            && self.extent.holds(at)
            && work.spend(2 * self.points.len())
            && (ring::contains(&self.points, at) || polyline::distance(at, &self.points) <= BESIDE)
    }
}

/// True if each of two rings runs along all of the other.
fn run_along_each_other([one, other]: [&[Point]; 2]) -> bool {
    let along = |ring: &[Point], other: &[Point]| ring.iter().all(|&at| polyline::distance(at, other) <= REACH);
    along(one, other) && along(other, one)
}

/// The outlines that are in no other, in the order of the file.
pub(super) fn outlines(edges: Vec<Chain>, work: &mut Budget) -> Vec<Outline> {
    let mut all: Vec<(usize, Outline)> = edges.into_iter().map(Outline::of).enumerate().collect();
    if all.len() == 1 {
        return all.into_iter().map(|(_, outline)| outline).collect();
    }
    // The bits of non-negative numbers are in the order of the numbers.
    all.sort_by_cached_key(|(_, outline)| Reverse(ring::area(&outline.points).abs().to_bits()));
    let mut outer: Vec<(usize, Outline)> = Vec::new();
    for (place, outline) in all {
        // Parts that touch have vertices on each other's edge: an inner outline has its interior inside, and all of itself.
        let inner = Shape::new(&[&outline.points]).inner().filter(|_| outline.edge.is_closed);
        let is_inside = |around: &Outline, work: &mut Budget| {
            work.spend(1)
                && around.extent.covers(&outline.extent.grown(-BESIDE))
                && inner.is_some_and(|inner| work.spend(around.points.len()) && ring::contains(&around.points, inner))
                && outline.points.iter().all(|&at| around.holds(at, work))
        };
        match outer.iter_mut().find(|(_, around)| is_inside(around, work)) {
            Some((_, around)) => around.inner.push(outline.edge),
            None => outer.push((place, outline)),
        }
    }
    outer.sort_by_key(|(place, _)| *place);
    outer.into_iter().map(|(_, outline)| outline).collect()
}
