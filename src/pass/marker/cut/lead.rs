//! Ends of open cuts at other cuts: they are extended until they cross, so that no thread remains.
//!
//! A cut that reaches an edge at an angle goes straight on. A cut that runs along the edge is led over to it at a small angle
//! where the edge continues to be cut. Both end a little beyond it.

use std::collections::HashMap;

use super::facing::{Facing, Segments, without};
use super::ring::{Mouth, Ring, crossing};
use super::stretch::{Asked, BREAK, Shared};
use crate::geom::{Extent, Point, Vector, left, polyline};
use crate::ir::list::Segment;

/// Sine of the least angle at which a cut goes straight on to another (15 degrees).
pub(super) const LEAST_SINE: f64 = 0.259;
/// Cosine of that angle: smaller turns count as straight.
pub(super) const LEAST_COSINE: f64 = 0.966;
/// Tangent of the greatest angle at which a cut is led over to an edge along which it runs (6 degrees).
const SLOPE: f64 = 0.105;
/// Length by which such a cut passes through the edge, in multiples of the merge tolerance.
const THROUGH: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Greatest depth of its end in a part, in multiples of the merge tolerance: the diagonal of that in X and Y, as for other
/// cuts.
const DEEPEST: f64 = std::f64::consts::SQRT_2;
/// Number of times that the transition to a bent edge is halved.
const HALVINGS: usize = 3;
/// Number of places tested on such a transition.
const PLACES: usize = 4;
/// Radius around a place within which cuts that should meet there do meet, in multiples of the merge tolerance.
const ABOUT: f64 = 3.0;
/// Greatest number of cuts near a place that are tested for connection: no lay has more.
const MOST_CUTS: usize = 200;
/// Length below which a stretch counts as empty, mm: rounding.
const LEAST: f64 = 1e-9;
/// Distance within which a place is on an edge, mm: rounding.
const ON_EDGE_EPSILON: f64 = 1e-9;

/// Arrival of a cut at the place where it should cross another.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arrival {
    /// Place.
    pub(super) at: Point,
    /// Unit vector of its direction there.
    pub(super) along: Vector,
    /// Length of the straight stretch that ends there, mm.
    pub(super) straight: f64,
}

impl Arrival {
    /// Arrival at a station of a ring, in or against its direction.
    pub(super) fn on(ring: &Ring, station: f64, is_along: bool) -> Self {
        let straight = ring.arriving_on(station, is_along).length();
        Self { at: ring.place(station), along: ring.arriving(station, is_along), straight }
    }
}

/// Cut to be crossed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Neighbour {
    /// Index of the ring with which the edge ahead is cut.
    pub(super) ring: usize,
    /// Station of that ring beside the place, mm.
    pub(super) station: f64,
    /// Index of a ring to be ignored.
    pub(super) not: Option<usize>,
}

/// Cuts of the rings so far.
#[derive(Debug)]
pub(super) struct Leads<'a> {
    pub(super) rings: &'a [Ring],
    segments: &'a Segments,
    pub(super) asked: Asked,
    /// Stretches of each ring that are cut with others.
    spared: Vec<Vec<[f64; 2]>>,
    /// Length of the transition to an edge, mm.
    longest: f64,
    /// Extensions of open cuts, in cells of the size of the longest one.
    ways: HashMap<[i64; 2], Vec<[Point; 2]>>,
}

impl<'a> Leads<'a> {
    pub(super) fn new(rings: &'a [Ring], segments: &'a Segments, asked: Asked) -> Self {
        let Asked { near, width, .. } = asked;
        // The length is independent of the distance between both, and leaves no bend under the plunged blade.
        let longest = (2.0 * near.distance / SLOPE).max(width);
        Self { rings, segments, asked, longest, spared: vec![Vec::new(); rings.len()], ways: HashMap::new() }
    }

    /// Records the stretches of a ring that are cut with others, and the extensions of its remaining cuts.
    pub(super) fn spare(&mut self, ring: usize, shared: &[Shared], ways: Vec<[Point; 2]>) {
        let length = self.rings[ring].length();
        for &Shared { own: [from, to], .. } in shared {
            let lap = (from / length).floor() * length;
            let (from, to) = (from - lap, to - lap);
            self.spared[ring].push([from, to.min(length)]);
            if to > length {
                self.spared[ring].push([0.0, to - length]);
            }
        }
        for way in ways {
            self.ways.entry(self.cell(way[0])).or_default().push(way);
        }
    }

    /// Parts of a stretch that face an edge which is cut.
    pub(super) fn kept_of(&self, part: &Facing) -> Vec<Facing> {
        let (from, to) = (part.theirs[0], part.theirs[1]);
        let share = |station: f64| (station - from) / (to - from);
        let spared = self.spared[part.other].iter().map(|ends| ends.map(share));
        let kept = without([0.0, 1.0], spared.map(|[a, b]| [a.min(b), a.max(b)]));
        kept.into_iter().map(|shares| part.part(shares)).collect()
    }

    /// End of a cut of a ring that arrives at a place, extended to cross the other rings' cut there. It is not extended if it
    /// crosses that already; `None` if it finds nothing to cross.
    pub(super) fn lead(&self, ring: usize, arrival: Arrival, to: Neighbour) -> Option<Point> {
        let Arrival { at, along, .. } = arrival;
        // If it passes the neighbour's outline at an angle, as beside a corner, it needs no transition.
        let through = self.straight_on(ring, at, along, |other| other == Some(to.ring));
        if let Some(way) = through.filter(|&way| way <= self.asked.near.distance) {
            return Some(at + along * way.max(0.0));
        }
        let ways = [1.0, -1.0].into_iter().filter_map(|sign| self.way_over(arrival, (to.ring, to.station, sign)));
        let ways = ways.filter(|&(_, end)| !self.enters_another(ring, to.ring, [at, end]));
        if let Some((_, end)) = ways.max_by(|a, b| a.0.total_cmp(&b.0)) {
            return Some(end);
        }
        // A nearer cut may be that of another edge, with a thread between the two. Going on to the neighbour's crosses both.
        let Asked { near, beyond, .. } = self.asked;
        let through = through.filter(|&way| way <= DEEPEST * near.distance + beyond);
        let any = || self.straight_on(ring, at, along, |other| to.not.is_none() || other != to.not);
        let way = through.or_else(any)?;
        Some(if way > LEAST { at + along * way } else { at })
    }

    /// True if a line of a ring along an edge of another passes through the outline of a third part, such as a protruding
    /// notch, or lies in one deeper than the merge tolerance.
    fn enters_another(&self, own: usize, other: usize, [from, to]: [Point; 2]) -> bool {
        let known = [own, other].map(|ring| self.rings[ring].part);
        let Some(along) = polyline::direction(from, to) else { return false };
        let margin = self.asked.near.distance;
        let crosses = |segment: [Point; 2]| {
            crossing(from, along, segment, margin)
                .is_some_and(|(ahead, sine)| sine >= LEAST_SINE && ahead <= (to - from).norm() - margin)
        };
        let near = self.segments.near(self.rings, Extent::between(from, to).grown(DEEPEST * margin));
        let third = near.filter(|([ring, _], _)| !known.contains(&self.rings[*ring].part));
        let (mut rings, segments): (Vec<usize>, Vec<[Point; 2]>) = third.map(|([ring, _], ends)| (ring, ends)).unzip();
        rings.sort_unstable_by_key(|&ring| (self.rings[ring].part, ring));
        rings.dedup();
        let is_clear = |place: Point| {
            let distance = |ends: &[Point; 2]| polyline::distance_to_segment(place, ends[0], ends[1]);
            segments.iter().all(|ends| distance(ends) > DEEPEST * margin)
        };
        let is_in_one = |place: Point| {
            let mut parts = rings.chunk_by(|&a, &b| self.rings[a].part == self.rings[b].part);
            parts.any(|rings| rings.iter().all(|&ring| self.rings[ring].holds(place)))
        };
        let mut places = (1..=PLACES).map(|i| from + (to - from) * (i as f64 / PLACES as f64));
        segments.iter().copied().any(crosses) || places.any(|place| is_clear(place) && is_in_one(place))
    }

    /// Straight cut of a ring through a place where the stretch cut with one neighbour ends and that cut with the next begins,
    /// so that it crosses both: its ends, with the place between them.
    pub(super) fn tie(&self, ring: usize, station: f64, [before, behind]: [Neighbour; 2]) -> Option<[Point; 3]> {
        let own = &self.rings[ring];
        let at = own.place(station);
        let through = |first: Neighbour, second: Neighbour, is_along: bool| {
            let start = self.lead(ring, Arrival::on(own, station, is_along), first)?;
            let along = polyline::direction(start, at)?;
            let straight = (at - start).norm();
            Some([start, self.lead(ring, Arrival { at, along, straight }, second)?])
        };
        let [start, end] = through(before, behind, false)
            .or_else(|| through(behind, before, true).map(|[end, start]| [start, end]))?;
        let tie = [start, at, end];
        [before, behind].iter().all(|to| self.surely_crosses(ring, tie, to.ring)).then_some(tie)
    }

    /// True if a tie of a ring crosses the other's cut even when displaced to either side by half the tolerance: the blade
    /// rounds the bends of both.
    fn surely_crosses(&self, before: usize, tie: [Point; 3], other: usize) -> bool {
        let ([start, at, end], aside) = (tie, self.asked.beyond / 2.0);
        let cuts = self.cut_near(before, Extent::of(&tie).grown(aside));
        let of_other = || cuts.iter().filter(|cut| cut.0 == Some(other));
        let Some(across) = polyline::direction(start, end).map(left) else { return false };
        [aside, -aside].into_iter().all(|aside| {
            let [start, at, end] = [start, at, end].map(|place| place + across * aside);
            [[start, at], [at, end]].into_iter().any(|[from, to]| {
                let Some(along) = polyline::direction(from, to) else { return false };
                let is_on = |ahead: f64| ahead <= (to - from).norm();
                of_other().any(|cut| crossing(from, along, cut.1, 0.0).is_some_and(|(ahead, _)| is_on(ahead)))
            })
        })
    }

    /// Length by which a line goes straight on from a place until it has passed a cut of an earlier ring selected by
    /// `is_meant`, mm.
    fn straight_on(
        &self,
        before: usize,
        at: Point,
        along: Vector,
        is_meant: impl Fn(Option<usize>) -> bool,
    ) -> Option<f64> {
        let Asked { near, beyond, .. } = self.asked;
        let reach = (near.distance + beyond) / LEAST_SINE;
        let ends = [at - along * near.distance, at + along * reach];
        let cuts = self.cut_near(before, Extent::between(ends[0], ends[1]).grown(beyond));
        let others = cuts.iter().filter(|(ring, _)| is_meant(*ring));
        let crossings = others.filter_map(|&(ring, ends)| {
            let (ahead, sine) = crossing(at, along, ends, -near.distance)?;
            let there = at + along * ahead;
            let is_there = |end: &&Point| (**end - there).norm() <= beyond;
            let end = ends.iter().find(is_there).copied();
            (ahead <= reach && sine >= LEAST_SINE).then_some((ahead + beyond / sine, ring, end))
        });
        let (way, ring, grazed) = crossings.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
        // Grazing a corner is not a crossing, and reaching the end of a cut is not a reliable one.
        let end = at + along * way.max(0.0);
        let is_through = |ends: [Point; 2]| polyline::distance_to_segment(end, ends[0], ends[1]) > beyond / 2.0;
        let is_crossed = |corner: Point| {
            let away = cuts.iter().filter_map(|&(_, [from, to])| {
                if (from - corner).norm() <= LEAST {
                    polyline::direction(from, to)
                } else if (to - corner).norm() <= LEAST {
                    polyline::direction(to, from)
                } else {
                    None
                }
            });
            let mut away = away.peekable();
            let first = away.peek().copied().unwrap_or_default();
            let goes_on = away.any(|along| along.dot(&first) < LEAST_COSINE);
            goes_on && cuts.iter().filter(|cut| cut.0 == ring).all(|cut| is_through(cut.1))
        };
        grazed.is_none_or(is_crossed).then_some(way)
    }

    /// End of a gentle transition from a place to an edge, starting at a station of that, with the cosine of the turn.
    fn way_over(&self, arrival: Arrival, (other, from, sign): (usize, f64, f64)) -> Option<(f64, Point)> {
        let Arrival { at, along, straight } = arrival;
        let Asked { near, beyond, width, .. } = self.asked;
        let edge = &self.rings[other];
        // Long enough, since both cuts may be off by the tolerance and cross at a small angle, but not so long that its end is
        // too deep, or that the overlap past it, in the same direction, exceeds the merge tolerance.
        let apart = (edge.place(from) - at).norm();
        let through = (THROUGH * near.distance).min(DEEPEST * near.distance + beyond - apart);
        // The cut ends on the far side of the edge, seen from its start. The side is undefined for a place on the edge, or one
        // within half the merge tolerance that is reached along the edge: there the stretch before it decides.
        let ahead = from + sign * 2.0 * near.distance;
        let aside = (at - edge.place(ahead)).dot(&edge.inwards(ahead));
        let behind = from - sign * 2.0 * near.distance;
        let is_along = edge.arriving(behind, sign > 0.0).dot(&along) >= LEAST_COSINE;
        let is_on = aside.abs() <= ON_EDGE_EPSILON || aside.abs() <= near.distance / 2.0 && is_along;
        let is_inside = if is_on { edge.holds(at - along * (2.0 * near.distance)) } else { aside > 0.0 };
        let through = if is_inside { -through } else { through };
        (0..HALVINGS).map(|halving| self.longest / f64::from(1 << halving)).find_map(|length| {
            let station = |share: f64| from + sign * length * share;
            let end = edge.place(station(1.0)) + edge.inwards(station(1.0)) * through;
            let cosine = polyline::direction(at, end)?.dot(&along);
            let is_beside = (1..=PLACES).map(|i| i as f64 / PLACES as f64).all(|share| {
                (edge.place(station(share)) - (at + (end - at) * share)).norm() <= near.distance + through.abs()
            });
            let is_cut = self.is_cut(other, [from, station(1.0)]);
            // A blade plunged over the bend is a chord of both stretches, `off` mm away from the bend; each of the two may be
            // off by half of that. A stretch shorter than the blade is cut by plunges of its own.
            let off = length * (width - length) / width * (1.0 - cosine * cosine).sqrt();
            let is_straight = length >= width || straight < width - length || off / 2.0 <= beyond;
            (cosine >= LEAST_COSINE && is_beside && is_cut && is_straight).then_some((cosine, end))
        })
    }

    /// True if everything between two stations of a ring is cut with it.
    pub(super) fn is_cut(&self, ring: usize, [a, b]: [f64; 2]) -> bool {
        let length = self.rings[ring].length();
        let (low, high) = (a.min(b), a.max(b));
        let lap = (low / length).floor() * length;
        let (low, high) = (low - lap, high - lap);
        let is_over = |[from, to]: [f64; 2]| from < high - LEAST && to > low + LEAST;
        !self.spared[ring].iter().any(|&[from, to]| is_over([from, to]) || is_over([from + length, to + length]))
    }

    /// Cuts of earlier rings in a box: segments with the index of their ring, and extensions, without one.
    fn cut_near(&self, before: usize, extent: Extent) -> Vec<(Option<usize>, [Point; 2])> {
        let mut found = Vec::new();
        for ([ring, segment], _) in self.segments.near(self.rings, extent).filter(|([ring, _], _)| *ring < before) {
            let own = &self.rings[ring];
            let (from, to) = (own.station(segment), own.station(segment) + own.segments()[segment].length());
            let kept = without([from, to], self.spared[ring].iter().copied());
            let Segment { from: start, to: end, .. } = own.segments()[segment];
            let place = |station: f64| start + (end - start) * ((station - from) / (to - from));
            found.extend(kept.into_iter().map(|stretch| (Some(ring), stretch.map(place))));
        }
        // They are found in no particular order.
        let key = |&(ring, [a, b]): &(Option<usize>, [Point; 2])| (ring, [a.x, a.y, b.x, b.y].map(f64::to_bits));
        found.sort_unstable_by_key(key);
        let [low, high] = [extent.min, extent.max].map(|corner| self.cell(corner));
        let cells = (low[0] - 1..=high[0] + 1).flat_map(|x| (low[1] - 1..=high[1] + 1).map(move |y| [x, y]));
        let ways = cells.filter_map(|cell| self.ways.get(&cell)).flatten();
        found.extend(ways.filter(|ends| Extent::between(ends[0], ends[1]).meets(&extent)).map(|&ends| (None, ends)));
        found
    }

    /// Cell of a place.
    fn cell(&self, at: Point) -> [i64; 2] {
        [at.x, at.y].map(|value| (value / self.longest).floor() as i64)
    }

    /// True if the cut of one edge and the cut of the next cross where the one ends and the other begins.
    pub(super) fn meet(&self, ring: usize, [before, behind]: [&Shared; 2]) -> bool {
        let way = (behind.theirs[0] - before.theirs[1]).rem_euclid(self.rings[behind.other].length());
        let way = way.min(self.rings[behind.other].length() - way);
        if before.other == behind.other && way > BREAK * self.asked.near.distance {
            // A notch of the other ring is there: the cut round it leaves its waste attached to this part.
            return false;
        }
        let at = self.rings[ring].place(before.own[1]);
        let about = Extent::between(at, at).grown(ABOUT * self.asked.near.distance);
        // Cuts that meet elsewhere only leave a strip between the two that is open here.
        let clipped = |(ring, ends)| about.clip(ends).filter(|[from, to]| from != to).map(|ends| (ring, ends));
        let cuts: Vec<(Option<usize>, [Point; 2])> =
            self.cut_near(ring, about).into_iter().filter_map(clipped).collect();
        let meets = |one: &(Option<usize>, [Point; 2]), other: &(Option<usize>, [Point; 2])| {
            let ([a, b], [c, d]) = (one.1, other.1);
            // Two outlines may be off their lines: touching, or crossing at a small angle, is not reliable.
            let is_sure = one.0 == other.0 || one.0.is_none() || other.0.is_none();
            let touches = || [a, b].iter().any(|p| [c, d].iter().any(|q| (p - q).norm() <= LEAST));
            let crosses = || {
                let along = polyline::direction(a, b)?;
                let (ahead, sine) = crossing(a, along, [c, d], -LEAST)?;
                let there = a + along * ahead;
                let margin = [a, b, c, d].iter().map(|end| (end - there).norm()).fold(f64::INFINITY, f64::min);
                let is_clear = is_sure || sine >= LEAST_SINE && margin >= self.asked.near.distance;
                (ahead <= (b - a).norm() + LEAST && is_clear).then_some(())
            };
            is_sure && touches() || crosses().is_some()
        };
        if cuts.len() > MOST_CUTS {
            return false;
        }
        // Cuts connected with the first edge, from there on.
        let (mut reached, mut left): (Vec<usize>, Vec<usize>) =
            (0..cuts.len()).partition(|&i| cuts[i].0 == Some(before.other));
        while let Some(next) = reached.pop() {
            if cuts[next].0 == Some(behind.other) {
                return true;
            }
            let (met, rest): (Vec<usize>, Vec<usize>) = left.into_iter().partition(|&i| meets(&cuts[next], &cuts[i]));
            reached.extend(met);
            left = rest;
        }
        false
    }

    /// Legs of a notch, extended at both ends through the edge that is cut over its mouth: its own, or the one that is cut in
    /// its place.
    pub(super) fn led_legs(&self, ring: usize, Mouth { segment, legs }: &Mouth) -> Vec<Segment> {
        let mut led = legs.clone();
        let [Some(&first), Some(&last)] = [legs.first(), legs.last()] else { return led };
        let own = &self.rings[ring];
        let [start, end] = [own.station(*segment), own.station(*segment) + own.segments()[*segment].length()];
        let on = |from: Point, to: Point, ends: [f64; 2]| {
            let along = polyline::direction(from, to)?;
            let is_own = self.is_cut(ring, ends);
            let way = self.straight_on(ring + 1, to, along, |other| !is_own || other == Some(ring))?;
            (way > LEAST).then(|| to + along * way)
        };
        if let Some(start) = on(first.to, first.from, [start, start + 2.0 * LEAST]) {
            led[0].from = start;
        }
        if let Some(end) = on(last.from, last.to, [end - 2.0 * LEAST, end]) {
            led[legs.len() - 1].to = end;
        }
        led
    }

    /// Station of a ring nearest to a place, within the merge tolerance; `None` if there is none.
    pub(super) fn foot(&self, ring: usize, at: Point) -> Option<f64> {
        let own = &self.rings[ring];
        let around = Extent::between(at, at).grown(self.asked.near.distance);
        let of_ring = self.segments.near(self.rings, around).filter(|([of, _], _)| *of == ring);
        let feet = of_ring.map(|([_, segment], [from, to])| {
            let length = (to - from).norm();
            let along = (at - from).dot(&(to - from)) / length;
            (polyline::distance_to_segment(at, from, to), own.station(segment) + along.clamp(0.0, length))
        });
        let nearest = feet.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        nearest.filter(|&(away, _)| away <= self.asked.near.distance).map(|(_, station)| station)
    }

    /// Start of a slit on an edge of a ring that is cut with another: the place where it has passed that cut, if that is
    /// farther out. Beside such an edge it is the place where it has passed its own.
    pub(super) fn led_root(&self, ring: usize, station: f64, [root, tip]: [Point; 2]) -> Option<Point> {
        let is_cut_within = |reach: f64| self.is_cut(ring, [station - reach, station + reach]);
        let is_own = is_cut_within(2.0 * LEAST);
        if is_own && is_cut_within(2.0 * self.asked.near.distance) {
            return None;
        }
        let along = polyline::direction(tip, root)?;
        let (before, is_meant) = (ring + usize::from(is_own), |other| !is_own || other == Some(ring));
        let way = self.straight_on(before, root, along, is_meant)?;
        (way > LEAST).then(|| root + along * way)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ir::list::Joint;
    use crate::pass::marker::cut::facing::Near;
    use crate::source::Span;

    fn segment(from: [f64; 2], to: [f64; 2]) -> Segment {
        let [from, to] = [from, to].map(|[x, y]| Point::new(x, y));
        Segment { from, to, span: Span::default(), joint: Joint::default(), percent: 100 }
    }

    fn ring(piece: usize, corners: &[[f64; 2]], mouths: Vec<Mouth>) -> Ring {
        let sides = corners.iter().zip(corners.iter().cycle().skip(1));
        Ring::new([piece, piece], true, sides.map(|(&from, &to)| segment(from, to)).collect(), mouths)
    }

    /// Both legs cross the other's edge a little before they end: that suffices only where it is cut in place of their own.
    #[test]
    fn a_notch_ends_at_its_own_edge_where_that_is_cut() {
        let legs = vec![segment([4.0, 0.0], [5.0, 4.0]), segment([5.0, 4.0], [6.0, 0.0])];
        let corners = [[0.0, 0.0], [4.0, 0.0], [6.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
        let own = ring(1, &corners, vec![Mouth { segment: 1, legs: legs.clone() }]);
        let before = ring(0, &[[0.0, -9.0], [10.0, -9.0], [10.0, 0.17], [0.0, 0.17]], Vec::new());
        let rings = [before, own];
        let segments = Segments::new(&rings);
        let near = Near { distance: 0.2, slack: 0.0 };
        let asked = Asked { near, min: 5.0, beyond: 0.01, width: 3.0, corner: 0.8 };
        let mut leads = Leads::new(&rings, &segments, asked);
        let ends = |leads: &Leads| {
            let led = leads.led_legs(1, &rings[1].mouths()[0]);
            [led[0].from.y, led[1].to.y]
        };
        assert!(ends(&leads).iter().all(|y| (-0.02..-0.009).contains(y)), "{:?}", ends(&leads));
        // Where the other's edge is cut in its place, they have crossed that already.
        leads.spared[1].push([0.0, 10.0]);
        assert_eq!(ends(&leads), [0.0; 2]);
    }

    /// At the end of another cut no crossing is reliable; at a corner, where the other goes on, it is.
    #[test]
    fn a_cut_is_led_on_over_a_corner_but_not_over_an_end() {
        let rings = [ring(0, &[[0.0, -9.0], [10.0, -9.0], [10.0, 0.0], [0.0, 0.0]], Vec::new())];
        let segments = Segments::new(&rings);
        let asked = Asked { near: Near { distance: 0.2, slack: 0.0 }, min: 5.0, beyond: 0.01, width: 3.0, corner: 0.8 };
        let mut leads = Leads::new(&rings, &segments, asked);
        let along = Vector::new(-2.0, -1.0).normalize();
        let way = |leads: &Leads| leads.straight_on(1, Point::new(10.1, 0.047), along, |_| true);
        assert!(way(&leads).is_some_and(|way| way > 0.11));
        // The upper side is cut with another part.
        leads.spared[0].push([19.0, 29.0]);
        assert_eq!(way(&leads), None);
    }
}
