//! Plunge cut: a run that the plunged blade covers, and the place of the blade's surplus length.

use super::blade::Plunge;
use crate::analysis::cloth::Surroundings;
use crate::geom::region::{Ray, Room};
use crate::geom::{Point, Vector, polyline};
use crate::ir::toolpath::{Overcut, Run};
use crate::machine::Spare;

/// Overcut that counts as none, mm: rounding.
const OVERCUT_EPSILON: f64 = 1e-6;
/// Spacing of the tried places of the blade, mm.
const STEP: f64 = 0.1;
/// Accuracy of the depth of the deepest place, mm: a fraction of the least tolerance of a file.
const DEPTH_ACCURACY: f64 = 0.004;
/// Tolerance within which places for a blade count as equally deep in the parts that `knife.spare` names, mm.
const ALIKE: f64 = 0.1;

/// Placement of the blade when one plunge without motion cuts all of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BladePlacement {
    /// Direction of the blade, unit vector from heel to tip: a chord of the run, which its overlaps extend.
    pub along: Vector,
    /// Position of the tip.
    pub tip: Point,
    /// Lengths of the blade beyond the start and the end of the run, mm: overlap plus surplus.
    pub beyond: [f64; 2],
    /// Depth of the surplus in parts, before the start and past the end.
    pub overcut: [Overcut; 2],
}

/// Straight continuation of a line beyond the start and the end of a run: the blade may lie on it, because it is cut anyway.
#[derive(Debug, Clone, Copy, Default)]
pub struct Continuation {
    /// Lengths before the start and behind the end, mm.
    pub straight: [f64; 2],
    /// True if run and continuation together are as long as the blade: all of its surplus lies on the line.
    pub takes_all: bool,
}

impl BladePlacement {
    /// Placement on an open run with overlaps of these lengths at its start and its end, mm; `None` if the blade has room to
    /// move between plunge and lift.
    ///
    /// The surplus length of the blade goes into the waste: behind the start as far as there is room, then past the end; first
    /// past the end if only the start may have no overlap. Surplus that finds no room there is placed where its deepest place
    /// is least deep in any part.
    pub fn of(run: &Run, overlaps: [f64; 2], around: &Surroundings) -> Option<Self> {
        Self::along_line(run, overlaps, Continuation::default(), around)
    }

    /// Placement on a run whose line goes on straight: where that takes all of the surplus, it lies there.
    pub fn along_line(
        run: &Run,
        overlaps: [f64; 2],
        Continuation { straight, takes_all }: Continuation,
        around: &Surroundings,
    ) -> Option<Self> {
        let width = around.knife.width_mm;
        let path = run.extended_by(overlaps);
        if width == 0.0 || Plunge::at_start(&path, width).has_way(&path, around.least_way) {
            return None;
        }
        let (start, end) = (run.points[0], run.points[run.points.len() - 1]);
        let along = polyline::direction(start, end)?;
        let line = [start - along * overlaps[0], end + along * overlaps[1]];
        let length = (line[1] - line[0]).norm();
        let missing = missing((length - width).max(0.0), overlaps);
        let line = [line[0] + along * missing[0], line[1] - along * missing[1]];
        let surplus = (width - length).max(0.0);
        let reach = surplus + around.knife.clearance_mm;
        let rays = [Ray { from: line[0], along: -along, reach }, Ray { from: line[1], along, reach }];
        let rooms = rays.each_ref().map(|ray| around.room(ray));
        let order = if run.ends[0].bare && !run.ends[1].bare { [1, 0] } else { [0, 1] };
        let before = surplus.min(straight[0]);
        let on_line = if takes_all { [before, (surplus - before).min(straight[1])] } else { [0.0; 2] };
        let rest = surplus - on_line[0] - on_line[1];
        let rooms = [0, 1].map(|end| rooms[end].without(on_line[end]));
        let (shared, left) = shared(rest, order.map(|end| rooms[end]), around.knife.clearance_mm);
        let (mut shares, mut overcut) = ([0, 1].map(|end| on_line[end] + shared[order[end]]), [Overcut::default(); 2]);
        let surplus = Surplus { length: surplus, overlaps, straight, rays, around };
        // A line that ends in another part is drawn there: nothing blocks a way further into that part, but it is deep.
        if left > 0.0 || surplus.is_deep(shares) {
            (shares, overcut) = surplus.placed(shares);
        }
        let beyond = [0, 1].map(|end| (overlaps[end] + shares[end] - missing[end]).max(0.0));
        Some(Self { along, tip: line[1] + along * shares[1], beyond, overcut })
    }

    /// Greatest depth of the placement in parts, mm.
    pub fn deepest(&self) -> f64 {
        self.overcut[0].max(self.overcut[1]).deepest()
    }
}

/// Distributes a deficit of length over both ends of a line, evenly as far as they have overlaps, so that a blade as long as the
/// line cuts all of it. All in mm.
fn missing(deficit: f64, overlaps: [f64; 2]) -> [f64; 2] {
    let even = overlaps.map(|overlap| overlap.min(deficit / 2.0));
    let rest = deficit - even[0] - even[1];
    let more = [0, 1].map(|end| rest.min(overlaps[end] - even[end]));
    // One end at most has overlap left.
    let left = (rest - more[0] - more[1]).max(0.0) / 2.0;
    [0, 1].map(|end| even[end] + more[end] + left)
}

/// Distributes a surplus over the waste beyond both ends of a line, the first end preferred, as far as there is room; the rest
/// is split evenly between both. Returns the shares and that rest. All in mm.
fn shared(surplus: f64, rooms: [Room; 2], clearance: f64) -> ([f64; 2], f64) {
    let clear = |gap: f64| (gap - clearance).max(0.0);
    let first = surplus.min(clear(rooms[0].least()));
    let second = (surplus - first).min(clear(rooms[1].least()));
    let left = surplus - first - second;
    if left <= OVERCUT_EPSILON {
        ([first + left, second], 0.0)
    } else {
        ([first + left / 2.0, second + left / 2.0], left)
    }
}

/// Surplus that finds no room in the waste.
struct Surplus<'a> {
    /// Length, mm.
    length: f64,
    /// Overlaps before it at either end, mm.
    overlaps: [f64; 2],
    /// Stretches at either end that are cut anyway, mm.
    straight: [f64; 2],
    /// Rays beyond the two ends of the line.
    rays: [Ray; 2],
    around: &'a Surroundings<'a>,
}

impl Surplus<'_> {
    /// True if either end of the blade lies in a part with these shares beyond the line.
    fn is_deep(&self, shares: [f64; 2]) -> bool {
        (0..2).any(|end| self.depths(end, shares[end]).deepest() > 0.0)
    }

    /// Depth of the blade at a distance beyond an overlap. None on the straight continuation of its line; behind that, at most
    /// the distance from it.
    fn depths(&self, end: usize, way: f64) -> Overcut {
        let Ray { from, along, .. } = self.rays[end];
        let beyond = self.overlaps[end] + way - self.straight[end];
        if beyond <= 0.0 { Overcut::default() } else { self.around.depths(from + along * way, beyond) }
    }

    /// Greatest depth of the blade from an overlap to `way` mm beyond it. Depth is Lipschitz: it changes between two places by
    /// at most their distance. Depths up to the band count as zero, so a place of zero depth may really be as deep as that.
    fn deepest(&self, end: usize, way: f64) -> Overcut {
        let count = (way / STEP).ceil().max(1.0) as usize;
        let places: Vec<(f64, Overcut)> =
            (0..=count).map(|i| way * i as f64 / count as f64).map(|way| (way, self.depths(end, way))).collect();
        let mut deepest = places.iter().fold(Overcut::default(), |deepest, place| deepest.max(place.1));
        let mut open: Vec<[(f64, Overcut); 2]> = places.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        while let Some([a, b]) = open.pop() {
            let band = self.around.band();
            let most = |depth: f64| if depth == 0.0 { band } else { depth };
            let may_be_deeper = |deepest: f64, [x, y]: [f64; 2]| {
                f64::midpoint(most(x) + most(y), b.0 - a.0) > deepest.max(band) + DEPTH_ACCURACY
            };
            if may_be_deeper(deepest.own, [a.1.own, b.1.own]) || may_be_deeper(deepest.other, [a.1.other, b.1.other]) {
                let way = f64::midpoint(a.0, b.0);
                let middle = (way, self.depths(end, way));
                deepest = deepest.max(middle.1);
                open.extend([[a, middle], [middle, b]]);
            }
        }
        deepest
    }

    /// Best distribution of the surplus over the two ends, and the depth at either end. It minimises the depth of its deepest
    /// place in any part, or in the parts that `knife.spare` names. Among equals it minimises the depth in the others, then the
    /// distance to `preferred`.
    fn placed(&self, preferred: [f64; 2]) -> ([f64; 2], [Overcut; 2]) {
        let count = (self.length / STEP).ceil().max(1.0) as usize;
        let way = |i: usize| self.length * i as f64 / count as f64;
        let deepest = [0, 1].map(|end| {
            let mut deepest = vec![self.depths(end, 0.0)];
            for i in 1..=count {
                deepest.push(deepest[i - 1].max(self.depths(end, way(i))));
            }
            deepest
        });
        let at = |i: usize| [deepest[0][i], deepest[1][count - i]];
        let harm = |i: usize| {
            let [before, behind] = at(i);
            let Overcut { own, other } = before.max(behind);
            let [first, then] = self.around.knife.spare.weigh([own, other]);
            [first, then, (way(i) - preferred[0]).abs()]
        };
        let all: Vec<[f64; 3]> = (0..=count).map(harm).collect();
        let least = all.iter().map(|harm| harm[0]).fold(f64::INFINITY, f64::min);
        let slack = if self.around.knife.spare == Spare::Both { 0.0 } else { ALIKE };
        let alike = all.iter().enumerate().filter(|(_, harm)| harm[0] <= least + slack);
        let best = alike.min_by(|(_, a), (_, b)| a[1].total_cmp(&b[1]).then(a[2].total_cmp(&b[2])));
        let i = best.map_or(0, |(i, _)| i);
        let shares = [way(i), self.length - way(i)];
        (shares, [0, 1].map(|end| self.deepest(end, shares[end])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FREE: f64 = f64::INFINITY;

    fn room(own: f64, other: f64) -> Room {
        Room { own, other }
    }

    #[test]
    fn a_deficit_shortens_overlaps_first() {
        assert_eq!(missing(0.0, [1.0, 0.5]), [0.0, 0.0]);
        assert_eq!(missing(0.5, [1.0, 0.5]), [0.25, 0.25]);
        assert_eq!(missing(1.0, [0.0, 2.0]), [0.0, 1.0]);
        assert_eq!(missing(2.0, [1.5, 0.25]), [1.625, 0.375]);
        assert_eq!(missing(2.0, [0.0, 1.0]), [0.5, 1.5]);
    }

    #[test]
    fn a_surplus_goes_behind_the_start_then_past_the_end() {
        assert_eq!(shared(2.0, [room(FREE, FREE); 2], 0.1), ([2.0, 0.0], 0.0));
        assert_eq!(shared(2.0, [room(FREE, 1.6), room(FREE, FREE)], 0.1), ([1.5, 0.5], 0.0));
        assert_eq!(shared(2.0, [room(0.0, FREE); 2], 0.1), ([1.0, 1.0], 2.0));
    }
}
