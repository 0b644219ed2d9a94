//! Common lines: edges that two parts share, the part with which each is cut, and the rest of the other part's outline.
//!
//! An edge is cut with the part that comes first. The rest of the other's outline becomes open cuts, each extended until it
//! crosses the cut that is already there. If that is impossible, the edge is cut for both.

use super::facing::{Facing, Segments};
use super::lead::{Arrival, LEAST_COSINE, LEAST_SINE, Leads, Neighbour};
use super::ring::{Mouth, Ring};
use super::stretch::{Asked, BREAK, Shared, stretches};
use super::style::Slit;
use crate::geom::budget::Budget;
use crate::geom::{Point, cross, polyline};
use crate::ir::list::{Joint, Segment};

/// Greatest distance of a corner from the end of the other's edge, in multiples of the merge tolerance.
const CORNER: f64 = std::f64::consts::SQRT_2;
/// Length below which a stretch counts as empty, mm: rounding.
const LEAST: f64 = 1e-6;

/// Result for a ring.
#[derive(Debug, Default)]
pub(super) struct Outcome {
    /// Open cuts of the ring, with the legs of notches on its edges first; `None` if it is cut as a whole.
    pub(super) cuts: Option<Vec<Vec<Segment>>>,
    /// Number of legs among the cuts.
    pub(super) legs: usize,
    /// Stretches cut with others: the index of the other ring, the stretch, and its greatest distance from that ring, mm.
    pub(super) shared: Vec<(usize, Vec<Segment>, f64)>,
    /// Short lines at which its cuts cross others.
    pub(super) junctions: Vec<[Point; 2]>,
}

/// Finds the common edges of rings, given in the order in which they are cut; `None` if the budget is spent. Rings with notches
/// on common edges then run straight over their mouths; all others follow their legs. Slits, grouped by piece, that stand on an
/// edge cut with another part begin at that cut.
pub(super) fn share(
    rings: &mut [Ring],
    slits: &mut [&mut [Slit]],
    asked: Asked,
    work: &mut Budget,
) -> Option<Vec<Outcome>> {
    let mut segments = Segments::new(rings);
    let mut facing = segments.facing(rings, asked.near, work)?;
    let wanted: Vec<Vec<bool>> = (0..rings.len()).map(|ring| wanted_mouths(rings, &facing, ring, asked)).collect();
    let mut is_changed = false;
    for (ring, wanted) in rings.iter_mut().zip(&wanted) {
        let mut wanted = wanted.iter();
        is_changed |= ring.keep_mouths(|_| wanted.next().copied().unwrap_or_default());
    }
    if is_changed {
        segments = Segments::new(rings);
        facing = segments.facing(rings, asked.near, work)?;
    }
    let mut sharing = Sharing { rings, asked, leads: Leads::new(rings, &segments, asked) };
    let mut outcomes: Vec<Outcome> = (0..rings.len()).map(|ring| sharing.settle(ring, &facing[ring])).collect();
    for (i, ring) in rings.iter().enumerate() {
        for Slit { stroke, .. } in &mut *slits[ring.piece] {
            let Some(station) = sharing.leads.foot(i, stroke.from) else { continue };
            if let Some(root) = sharing.leads.led_root(i, station, [stroke.from, stroke.to]) {
                outcomes[i].junctions.push([root, stroke.from]);
                stroke.from = root;
            } else if outcomes[i].cuts.is_some() {
                outcomes[i].junctions.push([stroke.from; 2]);
            }
        }
    }
    Some(outcomes)
}

/// True for each mouth of a ring along which another part's edge, and not its mouth, lies.
fn wanted_mouths(rings: &[Ring], facing: &[Vec<Facing>], ring: usize, asked: Asked) -> Vec<bool> {
    let own = &rings[ring];
    let is_over = |mouth: &Mouth, [low, high]: [f64; 2], ring: &Ring| {
        let [from, to] = [mouth.segment, mouth.segment + 1].map(|i| ring.station(i));
        low < to - LEAST && high > from + LEAST
    };
    if own.mouths().is_empty() {
        return Vec::new();
    }
    let common: Vec<Shared> = stretches(rings, own, &facing[ring], asked);
    let least = 2.0 * asked.near.distance;
    let is_wanted = |mouth: &Mouth| {
        if is_shallow(mouth, own) {
            return false;
        }
        let [from, to] = [mouth.segment, mouth.segment + 1].map(|i| own.station(i));
        let first_lap = |part: &Facing| {
            let lap = (part.own[0] / own.length()).floor() * own.length();
            Facing { own: part.own.map(|station| station - lap), ..*part }
        };
        let parts = common.iter().flat_map(|shared| &shared.parts).map(first_lap);
        let beside = parts.filter(|part| is_over(mouth, part.own, own));
        let (mut covered, mut base, mut faces) = (0.0, 0.0, false);
        for part in beside {
            let clip = |station: f64| ((station - part.own[0]) / part.length()).clamp(0.0, 1.0);
            let there = part.part([clip(from), clip(to)]);
            let theirs = [there.theirs[0].min(there.theirs[1]), there.theirs[0].max(there.theirs[1])];
            let other = &rings[part.other];
            covered += there.length();
            let is_by = |[low, high]: [f64; 2]| other.mouths().iter().any(|mouth| is_over(mouth, [low, high], other));
            if !is_by(theirs) {
                base += there.length();
            }
            faces |= is_by([theirs[0] - least, theirs[1] + least]);
        }
        // A base within the band at the ends of two facing mouths does not count. A protrusion of the other part, or a third
        // part, may lie where the other's edge is missing.
        let slack = if faces { least } else { least.min((to - from) / 2.0) };
        base > slack && covered >= to - from - slack
    };
    own.mouths().iter().map(is_wanted).collect()
}

/// True if the legs of a notch leave its edge at so small an angle that they might not cross the cut over its mouth.
fn is_shallow(mouth: &Mouth, own: &Ring) -> bool {
    let over = own.arriving(own.station(mouth.segment + 1), true);
    let ends = [mouth.legs.first(), mouth.legs.last()].into_iter().flatten();
    let mut ways = ends.filter_map(|leg| polyline::direction(leg.from, leg.to));
    ways.any(|way| cross(way, over).abs() < LEAST_SINE)
}

/// Open cuts and their extensions.
#[derive(Debug, Default)]
struct Led {
    cuts: Vec<Vec<Segment>>,
    ways: Vec<[Point; 2]>,
    /// Crossings of cuts without an extension.
    met: Vec<[Point; 2]>,
}

/// Stretch of a ring between two stations, extended to two places; if it is empty, the extensions get the attributes of `like`.
fn led_on(own: &Ring, [from, to]: [f64; 2], [start, end]: [Point; 2], like: Segment) -> Vec<Segment> {
    let mut cut = own.stretch([from, to]);
    let at = own.place(from);
    let ends = [cut.first().map_or(at, |first| first.from), cut.last().map_or(at, |last| last.to)];
    let [first, last] = [cut.first(), cut.last()].map(|segment| segment.copied().unwrap_or(like));
    cut.insert(0, Segment { from: start, to: ends[0], joint: Joint::default(), ..first });
    cut.push(Segment { from: ends[1], to: end, joint: Joint::default(), ..last });
    cut.retain(|segment| segment.length() > LEAST);
    // Close the gaps left by dropped segments.
    let mut at = start;
    for segment in &mut cut {
        segment.from = at;
        at = segment.to;
    }
    if let Some(last) = cut.last_mut() {
        last.to = end;
    }
    cut
}

/// Processing of rings in sequence.
struct Sharing<'a> {
    rings: &'a [Ring],
    asked: Asked,
    leads: Leads<'a>,
}

impl Sharing<'_> {
    /// Result for a ring, after all earlier ones.
    fn settle(&mut self, ring: usize, facing: &[Facing]) -> Outcome {
        let kept: Vec<Facing> =
            facing.iter().filter(|part| part.other < ring).flat_map(|part| self.leads.kept_of(part)).collect();
        let own = &self.rings[ring];
        let mut shared = stretches(self.rings, own, &kept, self.asked);
        shared.sort_by(|a, b| a.own[0].total_cmp(&b.own[0]));
        self.part(&mut shared, own);
        for shared in &mut shared {
            self.reach_corners(shared, own);
        }
        let Led { cuts, ways, met } = loop {
            if shared.is_empty() {
                let (cuts, junctions) = self.legs(ring, None);
                let legs = cuts.as_ref().map_or(0, |_| self.rings[ring].mouths().len());
                return Outcome { cuts, legs, junctions, shared: Vec::new() };
            }
            match self.cuts(ring, &shared) {
                Ok(led) => break led,
                // An end finds nothing to cross: that edge is cut for both.
                Err(failed) => drop(shared.remove(failed)),
            }
        };
        let junctions: Vec<[Point; 2]> = ways.iter().copied().chain(met).collect();
        self.leads.spare(ring, &shared, ways);
        let edges = shared.iter().map(|shared| {
            let shift = shared.parts.iter().flat_map(|part| part.apart).fold(0.0, f64::max);
            (shared.other, own.stretch(shared.own), shift)
        });
        let shared = edges.collect();
        let (cuts, of_legs) = self.legs(ring, Some(cuts));
        Outcome { shared, cuts, legs: own.mouths().len(), junctions: [junctions, of_legs].concat() }
    }

    /// Cuts of a ring, preceded by those of the notches on its edges (`None` if it is cut as a whole), and the stretches where
    /// the legs cross the cuts over their mouths.
    fn legs(&self, ring: usize, cuts: Option<Vec<Vec<Segment>>>) -> (Option<Vec<Vec<Segment>>>, Vec<[Point; 2]>) {
        let own = &self.rings[ring];
        if own.mouths().is_empty() {
            return (cuts, Vec::new());
        }
        let legs: Vec<Vec<Segment>> = own.mouths().iter().map(|mouth| self.leads.led_legs(ring, mouth)).collect();
        let roots = own.mouths().iter().zip(&legs).filter_map(|(mouth, led)| {
            let ends = |legs: &[Segment]| legs.first().zip(legs.last()).map(|(first, last)| [first.from, last.to]);
            ends(&mouth.legs).zip(ends(led)).map(|([a, b], [c, d])| [[a, c], [b, d]])
        });
        let roots = roots.flatten().collect();
        let whole = || vec![own.segments().to_vec()];
        (Some(legs.into_iter().chain(cuts.unwrap_or_else(whole)).collect()), roots)
    }

    /// Assigns the overlap of two stretches to the one that begins first.
    fn part(&self, shared: &mut Vec<Shared>, own: &Ring) {
        let least = self.asked.least();
        let mut i = 1;
        while i < shared.len() {
            let before = shared[i - 1].own[1];
            if shared[i].begin_at(before, least) {
                i += 1;
            } else {
                shared.remove(i);
            }
        }
        // The last stretch may continue past the start of the ring.
        while let [first, .., last] = &mut shared[..]
            && last.own[1] - own.length() > first.own[0]
            && !first.begin_at(last.own[1] - own.length(), least)
        {
            shared.remove(0);
        }
    }

    /// End, 0 or 1, of a cut that must not be made; `None` if the cut is good. A cut within the merge tolerance is too short
    /// for any blade, which would cut into its surroundings. An end of an `is_short` cut is bad if it deviates sideways by a
    /// comparably short stretch, because the blade would only swing, or if it returns along itself, as at the tip of a wedge.
    fn short_end(&self, cut: &[Segment], is_short: bool) -> Option<usize> {
        if !cut.is_empty() && cut.iter().map(Segment::length).sum::<f64>() <= self.asked.near.distance {
            return Some(0);
        }
        let [first, .., last] = cut else { return None };
        if !is_short {
            return None;
        }
        let along = |segment: &Segment| polyline::direction(segment.from, segment.to).unwrap_or_default();
        if along(first).dot(&along(last)) <= -LEAST_COSINE {
            return Some(0);
        }
        let swings = |end: &Segment, next: &Segment| {
            end.length() <= self.asked.near.distance && along(end).dot(&along(next)) < LEAST_COSINE
        };
        let ends = [swings(first, &cut[1]), swings(last, &cut[cut.len() - 2])];
        ends.iter().position(|&swings| swings)
    }

    /// Extends a stretch to the corners of its ring that are near enough to the end of the other's edge.
    fn reach_corners(&self, shared: &mut Shared, own: &Ring) {
        let reach = BREAK * self.asked.near.distance;
        let other = &self.rings[shared.other];
        let [start, end] = shared.own;
        let is_near = |station: f64, theirs: f64| {
            (own.place(station) - other.place(theirs)).norm() <= CORNER * self.asked.near.distance
        };
        if end - start >= own.length() - reach {
            return;
        }
        if let Some(corner) = own.vertices([end, end + reach]).find(|&corner| is_near(corner, shared.theirs[1])) {
            shared.own[1] = corner;
        }
        if let Some(corner) = own.vertices([start - reach, start]).filter(|&c| is_near(c, shared.theirs[0])).last() {
            shared.own[0] = corner;
        }
    }

    /// Open cuts between stretches, extended at both ends; the error is the index of a stretch with an end that nothing
    /// crosses.
    fn cuts(&self, ring: usize, shared: &[Shared]) -> Result<Led, usize> {
        let own = &self.rings[ring];
        let length = own.length();
        let mut led = Led::default();
        for (i, before) in shared.iter().enumerate() {
            let next = (i + 1) % shared.len();
            let behind = &shared[next];
            let from = before.own[1];
            let lap = if next <= i { length } else { 0.0 };
            let to = (behind.own[0] + lap).max(from);
            let bare = behind.parts[0].own[0] + lap - before.parts[before.parts.len() - 1].own[1];
            let is_short = bare <= BREAK * self.asked.near.distance;
            if is_short && (next == i || self.leads.meet(ring, [before, behind])) {
                led.met.push([from, to].map(|station| own.place(station)));
                continue;
            }
            let like = own.stretch([from - LEAST, to + LEAST])[0];
            let neighbours = [(before, 1), (behind, 0)].map(|(shared, end)| (shared.other, shared.theirs[end]));
            let not = |other: usize| Some(other).filter(|_| is_short && before.other != behind.other);
            let neighbour =
                |i: usize| Neighbour { ring: neighbours[i].0, station: neighbours[i].1, not: not(neighbours[1 - i].0) };
            let middle = f64::midpoint(from, to);
            if let Some([start, at, end]) =
                is_short.then(|| self.leads.tie(ring, middle, [neighbour(0), neighbour(1)])).flatten()
            {
                led.ways.extend([[start, at], [at, end]]);
                let ways = [[start, at], [at, end]].into_iter().filter(|[from, to]| from != to);
                let joint = Joint::default();
                led.cuts.push(ways.map(|[from, to]| Segment { from, to, joint, ..like }).collect());
                continue;
            }
            let arrivals = [Arrival::on(own, from, false), Arrival::on(own, to, true)];
            let mut ends = [Point::origin(); 2];
            for (k, arrival) in arrivals.into_iter().enumerate() {
                let past = if is_short { None } else { self.leads.past_corner(arrival, neighbour(k)) };
                ends[k] = match past {
                    Some(past) => past.end,
                    None => self.leads.lead(ring, arrival, neighbour(k)).ok_or([i, next][k])?,
                };
                // If the outlines overlap, it crosses the other before its extension.
                let over = arrival.at - arrival.along * (2.0 * self.asked.near.distance);
                led.ways.extend([[over, arrival.at], [arrival.at, ends[k]]]);
                led.ways.extend(past.map(|past| past.corner));
            }
            let cut = led_on(own, [from, to], ends, like);
            if let Some(end) = self.short_end(&cut, is_short) {
                return Err([i, next][end]);
            }
            if !cut.is_empty() {
                led.cuts.push(cut);
            }
        }
        Ok(led)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Span;

    /// A stretch that begins before a corner by less than the least length of a segment.
    #[test]
    fn a_cut_that_begins_just_before_a_corner_has_no_gap_there() {
        let corners = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]].map(|[x, y]| Point::new(x, y));
        let side = |i: usize| Segment {
            from: corners[i],
            to: corners[(i + 1) % 4],
            span: Span::default(),
            joint: Joint::default(),
            percent: 100,
        };
        let own = Ring::new([0, 0], true, (0..4).map(side).collect(), Vec::new());
        let cut = led_on(&own, [10.0 - 5e-7, 25.0], [Point::new(10.0, -1.0), Point::new(4.0, 10.0)], side(0));
        assert_eq!(cut.len(), 4, "{cut:?}");
        assert!(cut.windows(2).all(|pair| pair[0].to == pair[1].from), "{cut:?}");
    }
}
