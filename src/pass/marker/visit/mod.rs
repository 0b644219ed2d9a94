//! Visits of pieces: possible sequences and starts of the cuts of a piece, with the durations of the moves.
//!
//! Slits are cut on the way round the outline, from any of them and either way; then the cuts of each contour: a closed line
//! from the corner that is nearest in time, the remains of one with common lines in any order and direction. Codes of the file
//! at the start of a line apply there, so that such a line is left as it is. For steady work only visits that end towards the
//! uncut cloth count, if there are any.

mod starts;
mod ways;

use std::rc::Rc;

pub(super) use self::starts::{Begin, Measures, Start};
use self::ways::{Group, State};
use crate::analysis::air::{Air, Stop};
use crate::geom::{Extent, Point, polyline};
use crate::ir::list::{Segment, SegmentList};
use crate::ir::marker::Piece;

/// Usual limit of the number of visits of a piece.
const MOST_VISITS: usize = 32;
/// Greatest number of comparisons of slits with segments of their outline: with more the sequence of slits stays.
const MOST_LOOKS: usize = 10_000_000;

/// Greatest distance of the end of a piece from its front edge for steady work, as a share of its length along X.
const AT_FRONT: f64 = 1.0 / 3.0;

/// Sequence of the cuts of a piece.
#[derive(Debug, Clone)]
pub(super) struct Visit {
    /// Notches that are drawn as slits, by their indices in the piece.
    pub(super) slits: Vec<usize>,
    /// Other cuts by index, each with its start.
    pub(super) cuts: Vec<(usize, Begin)>,
    /// Stops at the first plunge and the last lift.
    pub(super) ends: [Stop; 2],
    /// Duration of the moves between them, s.
    pub(super) within: f64,
    /// True if it ends at the front of the piece.
    is_at_front: bool,
}

/// Cuts that may be made in any order.
#[derive(Debug)]
struct Unordered {
    /// Index of the first of them; the others follow it.
    first: usize,
    /// Possible starts of each, the drawn one first.
    starts: Vec<Vec<Start>>,
}

/// Cuts of a piece and their possible sequences.
#[derive(Debug, Default)]
pub(super) struct Cuts {
    /// Stops of the cuts that come first, in this order.
    pub(super) fixed: Vec<[Stop; 2]>,
    /// Slits, with their stations on the outline, mm.
    slits: Vec<([Stop; 2], f64)>,
    /// Cuts of contours, one group after the other.
    groups: Vec<Unordered>,
    /// Least X at which the last of them should end, mm.
    front: Option<f64>,
}

/// First cuts of a visit.
struct Begun {
    slits: Rc<[usize]>,
    /// Last link of its cuts, without those of the last group.
    trail: Option<usize>,
    /// Cuts of the last group.
    last: Vec<(usize, Begin)>,
    ends: Option<[Stop; 2]>,
    within: f64,
    is_at_front: bool,
}

/// Cuts of many visits with common beginnings.
#[derive(Default)]
struct Trail(Vec<Link>);

/// Cuts of a group, and the link of the previous group.
struct Link {
    cuts: Vec<(usize, Begin)>,
    before: Option<usize>,
}

impl Trail {
    /// Stores the last cuts of a visit.
    fn keep(&mut self, begun: &mut Begun) {
        self.0.push(Link { cuts: std::mem::take(&mut begun.last), before: begun.trail });
        begun.trail = Some(self.0.len() - 1);
    }

    fn visit(&self, begun: Begun) -> Visit {
        let Begun { slits, trail, last, ends, within, is_at_front } = begun;
        let links = std::iter::successors(trail, |&link| self.0[link].before).map(|link| &self.0[link].cuts);
        let mut groups: Vec<&Vec<(usize, Begin)>> = links.collect();
        groups.reverse();
        let cuts = groups.into_iter().flatten().copied().chain(last).collect();
        let ends = ends.expect("something is cut or drilled");
        Visit { slits: slits.to_vec(), cuts, ends, within, is_at_front }
    }
}

impl Begun {
    /// Appends cuts to those stored in a trail, with the duration of the moves to and between them, s.
    fn with(&self, starts: &[(usize, Start)], time: f64, is_at_front: bool) -> Self {
        let [first, last] = [&starts[0].1, &starts[starts.len() - 1].1];
        Self {
            slits: self.slits.clone(),
            trail: self.trail,
            last: starts.iter().map(|&(cut, Start { begin, .. })| (cut, begin)).collect(),
            ends: Some([self.ends.map_or(first.stops[0], |ends| ends[0]), last.stops[1]]),
            within: self.within + time,
            is_at_front,
        }
    }
}

impl Cuts {
    /// Cuts as drawn: each contour is cut as a whole.
    pub(super) fn drawn(piece: &Piece, list: &SegmentList, measures: &Measures) -> Self {
        let mut drawn = Self::marks(piece, list, measures);
        for (place, contour) in piece.contours.iter().enumerate() {
            drawn.add(place, measures.of_contour(contour, piece, list), false);
        }
        drawn
    }

    /// Holes and slits of a piece.
    pub(super) fn marks(piece: &Piece, list: &SegmentList, measures: &Measures) -> Self {
        let air = &measures.air;
        let is_few = |outline: &Vec<Segment>| outline.len() * piece.notches.len() <= MOST_LOOKS;
        let outline = piece.contours.last().filter(|last| last.closed && !piece.notches.is_empty());
        let outline =
            outline.map(|outline| list.walk(outline.range).map(|(_, segment)| segment).collect()).filter(is_few);
        let slits = piece.notches.iter().map(|notch| {
            let strokes: Vec<_> = notch.strokes().collect();
            let [first, last] = [strokes[0], strokes[strokes.len() - 1]];
            let ends = [air.down(first.from, first.to), air.up(last.from, last.to)];
            (ends, outline.as_ref().map_or(0.0, |outline| station(outline, notch.root)))
        });
        Self { slits: slits.collect(), ..Self::of_drills(piece, list, measures) }
    }

    /// Holes of a piece.
    pub(super) fn of_drills(piece: &Piece, list: &SegmentList, measures: &Measures) -> Self {
        let fixed = piece.drills.iter().map(|drill| [measures.air.drill(drill.at); 2]).collect();
        let outline = piece.contours.last().filter(|last| measures.is_steady && last.closed);
        let front = outline.map(|outline| {
            let extent = Extent::of(&list.points(outline.range));
            extent.max.x - AT_FRONT * extent.size().0
        });
        Self { fixed, slits: Vec::new(), groups: Vec::new(), front }
    }

    /// Adds a cut with its starts as a new group, or to the last group.
    pub(super) fn add(&mut self, place: usize, starts: Vec<Start>, is_of_last: bool) {
        match self.groups.last_mut().filter(|_| is_of_last) {
            Some(group) => group.starts.push(starts),
            None => self.groups.push(Unordered { first: place, starts: vec![starts] }),
        }
    }

    /// True if nothing is cut or drilled.
    pub(super) fn is_empty(&self) -> bool {
        self.fixed.is_empty() && self.slits.is_empty() && self.groups.is_empty()
    }

    /// Possible visits, the one in the order of the file first.
    pub(super) fn visits(&self, air: &Air) -> Vec<Visit> {
        let groups = self.groups.iter().map(|group| Group::new(&group.starts, air)).collect();
        Search { cuts: self, groups, air }.visits()
    }

    /// True if the piece may end where this cut ends.
    fn is_at_front(&self, start: &Start) -> bool {
        self.front.is_some_and(|front| start.to.x >= front)
    }
}

/// Search for the visits of a piece.
struct Search<'a> {
    cuts: &'a Cuts,
    /// Cuts of contours, with the durations between them.
    groups: Vec<Group<'a>>,
    air: &'a Air,
}

impl Search<'_> {
    fn visits(&self) -> Vec<Visit> {
        let mut begun = self.rounds();
        if self.cuts.slits.is_empty() && !self.cuts.fixed.is_empty() {
            begun.push(self.begun(Vec::new()));
        }
        let mut trail = Trail::default();
        let mut from = 0;
        if let (true, Some(first)) = (begun.is_empty(), self.groups.first()) {
            // Nothing precedes them: they begin with each of their states.
            from = 1;
            let nothing = self.begun(Vec::new());
            let step = first.states().len().div_ceil(2 * MOST_VISITS).max(1);
            for &state in first.states().iter().step_by(step) {
                let into = |other: State| if other == state { 0.0 } else { f64::INFINITY };
                begun.extend(self.led_on(0, &nothing, &into));
            }
            for begun in &mut begun {
                trail.keep(begun);
            }
        }
        let most = (2 * MOST_VISITS).div_ceil(begun.len().max(1));
        let mut visits = vec![self.as_is()];
        visits.extend(begun.into_iter().flat_map(|begun| self.ended(from, begun, most, &mut trail)));
        if self.cuts.front.is_some() && visits.iter().any(|visit| visit.is_at_front) {
            visits.retain(|visit| visit.is_at_front);
        }
        visits
    }

    /// Rounds of the slits after the fixed cuts: from several of them on, in both directions.
    fn rounds(&self) -> Vec<Begun> {
        let slits = &self.cuts.slits;
        let count = slits.len();
        let mut round: Vec<usize> = (0..count).collect();
        round.sort_by(|&a, &b| slits[a].1.total_cmp(&slits[b].1));
        let step = (2 * count).div_ceil(MOST_VISITS).max(1);
        let sequences = (0..count).step_by(step).flat_map(|first| {
            let onward: Vec<usize> = (0..count).map(|i| round[(first + i) % count]).collect();
            let back: Vec<usize> = (0..count).map(|i| round[(first + count - i) % count]).collect();
            [onward, back]
        });
        sequences.map(|slits| self.begun(slits)).collect()
    }

    /// Fixed cuts, and slits in a sequence.
    fn begun(&self, slits: Vec<usize>) -> Begun {
        let of_slits = slits.iter().map(|&slit| self.cuts.slits[slit].0);
        let stops: Vec<[Stop; 2]> = self.cuts.fixed.iter().copied().chain(of_slits).collect();
        let within = stops.windows(2).map(|pair| self.air.time(&pair[0][1], &pair[1][0])).sum();
        let ends = stops.first().zip(stops.last()).map(|(first, last)| [first[0], last[1]]);
        Begun { slits: slits.into(), trail: None, last: Vec::new(), ends, within, is_at_front: false }
    }

    /// Extensions of a visit by a group, in each way that may be the best.
    fn led_on(&self, place: usize, begun: &Begun, into: &dyn Fn(State) -> f64) -> Vec<Begun> {
        let Unordered { first, starts } = &self.cuts.groups[place];
        let is_last = place + 1 == self.groups.len();
        let is_at_front = |[cut, start]: State| is_last && self.cuts.is_at_front(&starts[cut][start]);
        let mut ways = self.groups[place].shortest(into, &is_at_front);
        // Another start of a closed line does not change its end: the nearest is the best.
        ways.truncate(if starts.len() == 1 && starts[0].len() > 2 { 4 } else { MOST_VISITS });
        let led = ways.into_iter().map(|way| {
            let states = way.states.iter().map(|&[cut, start]| (first + cut, starts[cut][start]));
            begun.with(&states.collect::<Vec<_>>(), way.time, is_at_front(way.states[way.states.len() - 1]))
        });
        led.collect()
    }

    /// Extensions of a visit through all groups from one on, at most `most`.
    fn ended(&self, from: usize, begun: Begun, most: usize, trail: &mut Trail) -> Vec<Visit> {
        let mut all = vec![begun];
        for (place, group) in self.groups.iter().enumerate().skip(from) {
            let led = |begun: &Begun| {
                let into =
                    |state: State| begun.ends.map_or(0.0, |ends| self.air.time(&ends[1], &group.stops(state)[0]));
                self.led_on(place, begun, &into)
            };
            all = all.iter().flat_map(led).collect();
            all.sort_by(|a, b| a.within.total_cmp(&b.within));
            all.truncate(most);
            for begun in &mut all {
                trail.keep(begun);
            }
        }
        all.into_iter().map(|begun| trail.visit(begun)).collect()
    }

    /// Visit as drawn.
    fn as_is(&self) -> Visit {
        let mut trail = Trail::default();
        let mut begun = self.begun((0..self.cuts.slits.len()).collect());
        for Unordered { first, starts } in &self.cuts.groups {
            for (cut, starts) in (*first..).zip(starts) {
                let time = begun.ends.map_or(0.0, |ends| self.air.time(&ends[1], &starts[0].stops[0]));
                begun = begun.with(&[(cut, starts[0])], time, self.cuts.is_at_front(&starts[0]));
                trail.keep(&mut begun);
            }
        }
        trail.visit(begun)
    }
}

/// Visits of some pieces, one of which is made for each.
pub(in crate::pass::marker) struct Choices<'a> {
    pub(in crate::pass::marker) visits: &'a [Vec<Visit>],
    /// Initial position of the axes.
    pub(in crate::pass::marker) home: Stop,
    pub(in crate::pass::marker) air: Air,
}

impl Choices<'_> {
    /// Visits of the pieces in an order with the least total duration, and that duration, s; exact, by dynamic programming.
    pub(in crate::pass::marker) fn choose(&self, order: &[usize]) -> (Vec<usize>, f64) {
        let Self { visits, home, air } = self;
        // Best visit of the previous piece for each visit of each piece.
        let mut came: Vec<Vec<usize>> = Vec::with_capacity(order.len());
        let mut spent: Vec<f64> = Vec::new();
        for (i, &piece) in order.iter().enumerate() {
            let before = i.checked_sub(1).map(|before| &visits[order[before]]);
            let best = |visit: &Visit| match before {
                None => (0, air.time(home, &visit.ends[0])),
                Some(before) => {
                    let times =
                        before.iter().zip(&spent).map(|(b, spent)| spent + air.time(&b.ends[1], &visit.ends[0]));
                    times.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).expect("each piece has a visit")
                }
            };
            let reached: Vec<(usize, f64)> = visits[piece]
                .iter()
                .map(|visit| (best(visit), visit.within))
                .map(|((from, time), within)| (from, time + within))
                .collect();
            came.push(reached.iter().map(|reached| reached.0).collect());
            spent = reached.into_iter().map(|reached| reached.1).collect();
        }
        let mut chosen = vec![0; visits.len()];
        let (mut at, time) = spent.into_iter().enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default();
        for (i, &piece) in order.iter().enumerate().rev() {
            chosen[piece] = at;
            at = came[i][at];
        }
        (chosen, time)
    }
}

/// Station of the place of an outline that is nearest to a point, mm.
fn station(outline: &[Segment], point: Point) -> f64 {
    let mut start = 0.0;
    let mut best = (f64::INFINITY, 0.0);
    for segment in outline {
        let away = polyline::distance_to_segment(point, segment.from, segment.to);
        if away < best.0 {
            let length = segment.length();
            let along = (point - segment.from).dot(&(segment.to - segment.from)) / length;
            best = (away, start + along.clamp(0.0, length));
        }
        start += segment.length();
    }
    best.1
}
