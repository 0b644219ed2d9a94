//! Sequences of several cuts that may be made in any order, each from any of its starts.

use super::Start;
use crate::analysis::air::{Air, Stop};

/// Greatest number of cuts of which every order is tried: the work quadruples with each.
const MOST_EXACT: usize = 5;
/// Least gain that counts, s: rounding.
const LEAST_GAIN: f64 = 1e-9;
/// Least gain for reversing a cut or separating it from its predecessor, s: gaps of a few tenths of a millimetre between common
/// edges must not decide.
const CHANGE: f64 = 1e-2;
/// Additional least gain per cut, as a share, so that no two changes weigh the same.
const STEP: f64 = 1.0 / 16.0;

/// Index of a cut, and of one of its starts.
pub(super) type State = [usize; 2];

/// Sequence of all cuts.
#[derive(Debug, Clone)]
pub(super) struct Way {
    /// Cuts in their order, each with its start.
    pub(super) states: Vec<State>,
    /// Duration of the moves to the first and between them, s, plus the least gains of its changes.
    pub(super) time: f64,
}

/// Cuts that may be made in any order, with the durations between them.
pub(super) struct Group<'a> {
    cuts: &'a [Vec<Start>],
    states: Vec<State>,
    /// Duration from the end of each state to the start of another plus the least gain of the change, s, row by row.
    times: Vec<f64>,
}

/// Least gain for a change of a cut, s.
fn weight([cut, _]: State) -> f64 {
    CHANGE * (1.0 + STEP * cut as f64)
}

/// Least gain for this start of a cut, s.
fn turned(state: State) -> f64 {
    if state[1] == 0 { 0.0 } else { weight(state) }
}

impl<'a> Group<'a> {
    pub(super) fn new(cuts: &'a [Vec<Start>], air: &Air) -> Self {
        let states: Vec<State> = cuts
            .iter()
            .enumerate()
            .flat_map(|(cut, starts)| (0..starts.len()).map(move |start| [cut, start]))
            .collect();
        let mut group = Self { cuts, states, times: Vec::new() };
        // A single cut has no successor.
        if cuts.len() > 1 {
            let pairs = group.states.iter().flat_map(|&from| group.states.iter().map(move |&to| [from, to]));
            let weighed = pairs.map(|[from, to]| {
                let stray = if to[0] == from[0] + 1 { 0.0 } else { weight(to) };
                air.time(&group.stops(from)[1], &group.stops(to)[0]) + turned(to) + stray
            });
            group.times = weighed.collect();
        }
        group
    }

    /// Every cut with each of its starts.
    pub(super) fn states(&self) -> &[State] {
        &self.states
    }

    /// Stops at the plunge and at the lift.
    pub(super) fn stops(&self, [cut, start]: State) -> [Stop; 2] {
        self.cuts[cut][start].stops
    }

    /// Shortest sequence for each possible final state, the shortest of all first. `into` is the duration of the move to the
    /// first cut, s; infinite if it cannot be first. Of many cuts only one short sequence is found. If a sequence can end at
    /// the front, the others are dropped.
    pub(super) fn shortest(&self, into: &dyn Fn(State) -> f64, is_end: &dyn Fn(State) -> bool) -> Vec<Way> {
        let is_one = self.cuts.len() == 1;
        let first = self.states.iter().map(|&state| into(state) + if is_one { 0.0 } else { turned(state) });
        let first: Vec<f64> = first.collect();
        let mut ways = if self.cuts.len() <= MOST_EXACT { self.exact(&first) } else { self.improved(&first, is_end) };
        ways.retain(|way| way.time.is_finite());
        let ends = |way: &Way| is_end(way.states[way.states.len() - 1]);
        if ways.iter().any(ends) {
            ways.retain(ends);
        }
        ways.sort_by(|a, b| a.time.total_cmp(&b.time));
        ways
    }

    fn time(&self, from: usize, to: usize) -> f64 {
        self.times[from * self.states.len() + to]
    }

    fn cut(&self, state: usize) -> usize {
        self.states[state][0]
    }

    fn way(&self, states: impl Iterator<Item = usize>, time: f64) -> Way {
        Way { states: states.map(|state| self.states[state]).collect(), time }
    }

    /// Dynamic programming over the set of finished cuts and the state of the last of them (Held & Karp 1962, *A dynamic
    /// programming approach to sequencing problems*).
    fn exact(&self, first: &[f64]) -> Vec<Way> {
        let count = self.states.len();
        let all = (1 << self.cuts.len()) - 1;
        // For each set of cuts and each state of it: the duration, and the previous state.
        let mut reached = vec![(f64::INFINITY, usize::MAX); (all + 1) * count];
        for (state, &time) in first.iter().enumerate() {
            reached[(1 << self.cut(state)) * count + state].0 = time;
        }
        for made in 1..all {
            for from in (0..count).filter(|&state| reached[made * count + state].0.is_finite()).collect::<Vec<_>>() {
                let spent = reached[made * count + from].0;
                for to in (0..count).filter(|&to| made & (1 << self.cut(to)) == 0) {
                    let then = &mut reached[(made | 1 << self.cut(to)) * count + to];
                    let time = spent + self.time(from, to);
                    if time < then.0 {
                        *then = (time, from);
                    }
                }
            }
        }
        let way = |last: usize| {
            let (mut made, mut at, mut back) = (all, last, Vec::with_capacity(self.cuts.len()));
            while at != usize::MAX {
                back.push(at);
                let before = reached[made * count + at].1;
                made &= !(1 << self.cut(at));
                at = before;
            }
            self.way(back.into_iter().rev(), reached[all * count + last].0)
        };
        (0..count).filter(|last| reached[all * count + last].0.is_finite()).map(way).collect()
    }

    /// Nearest neighbour, then single cuts moved elsewhere, in either direction, as long as that gains. If none ends at the
    /// front, the cut that can and costs least there is moved to the end.
    fn improved(&self, first: &[f64], is_end: &dyn Fn(State) -> bool) -> Vec<Way> {
        let time = |from: Option<usize>, to: usize| from.map_or(first[to], |from| self.time(from, to));
        let mut left: Vec<usize> = (0..self.states.len()).collect();
        let mut order: Vec<usize> = Vec::with_capacity(self.cuts.len());
        while !left.is_empty() {
            let last = order.last().copied();
            let next = left.iter().copied().min_by(|&a, &b| time(last, a).total_cmp(&time(last, b)));
            let next = next.expect("one is the nearest");
            order.push(next);
            left.retain(|&state| self.cut(state) != self.cut(next));
        }
        let whole = |order: &[usize]| {
            let onward: f64 = order.windows(2).map(|pair| self.time(pair[0], pair[1])).sum();
            first[order[0]] + onward
        };
        let mut is_improved = true;
        while std::mem::take(&mut is_improved) {
            for i in 0..order.len() {
                is_improved |= self.put_elsewhere(&mut order, i, &time);
            }
        }
        if !is_end(self.states[order[order.len() - 1]]) {
            let ended = |last: usize| {
                let others = order.iter().copied().filter(|&state| self.cut(state) != self.cut(last));
                others.chain([last]).collect::<Vec<usize>>()
            };
            let ends = (0..self.states.len()).filter(|&state| is_end(self.states[state])).map(ended);
            let times = ends.map(|order| (whole(&order), order)).filter(|(time, _)| time.is_finite());
            order = times.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(order, |(_, ended)| ended);
        }
        let time = whole(&order);
        vec![self.way(order.into_iter(), time)]
    }

    /// Moves the cut at a place of an order to where it gains most; returns true if it gains.
    fn put_elsewhere(&self, order: &mut Vec<usize>, i: usize, time: &dyn Fn(Option<usize>, usize) -> f64) -> bool {
        let mut others = order.clone();
        let state = others.remove(i);
        let inserted = |(place, state): (usize, usize)| {
            let (before, next) = (place.checked_sub(1).map(|before| others[before]), others.get(place).copied());
            let onward = next.map_or(0.0, |next| self.time(state, next) - time(before, next));
            time(before, state) + onward
        };
        let own = (0..self.states.len()).filter(|&other| self.cut(other) == self.cut(state));
        let places = own.flat_map(|state| (0..=others.len()).map(move |place| (place, state)));
        // The first cut may be fixed: then any cut before it has an infinite duration.
        let times = places.map(|at| (inserted(at), at)).filter(|(time, _)| time.is_finite());
        let Some((then, (place, state))) = times.min_by(|a, b| a.0.total_cmp(&b.0)) else { return false };
        let gains = then < inserted((i, order[i])) - LEAST_GAIN;
        if gains {
            others.insert(place, state);
            *order = others;
        }
        gains
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::machine::Job;
    use crate::pass::marker::visit::Begin;
    use fastrand::Rng;

    /// Straight cut that starts at either end.
    fn cut([from, to]: [[f64; 2]; 2], air: &Air) -> Vec<Start> {
        let [from, to] = [from, to].map(|[x, y]| Point::new(x, y));
        let start = |is_reversed, [from, to]: [Point; 2]| Start {
            begin: Begin { segment: 0, is_reversed },
            to,
            stops: [air.down(from, to), air.up(from, to)],
        };
        vec![start(false, [from, to]), start(true, [to, from])]
    }

    fn from(start: [f64; 2], cuts: &[[[f64; 2]; 2]]) -> Vec<Way> {
        let air = Air::new(&Job::default());
        let cuts: Vec<Vec<Start>> = cuts.iter().map(|&ends| cut(ends, &air)).collect();
        let group = Group::new(&cuts, &air);
        let home = Stop::anyhow(Point::new(start[0], start[1]));
        group.shortest(&|state| air.time(&home, &group.stops(state)[0]), &|_| false)
    }

    #[test]
    fn sides_of_a_part_are_cut_one_after_the_other() {
        let sides = [[[0.0, 0.0], [900.0, 0.0]], [[900.0, 500.0], [900.0, 20.0]], [[0.0, 500.0], [0.0, 20.0]]];
        let best = &from([0.0, 600.0], &sides)[0];
        assert_eq!(best.states, [[2, 0], [0, 0], [1, 1]]);
    }

    #[test]
    fn what_was_passed_by_is_taken_on_the_way() {
        let cuts = [[[100.0, 0.0], [200.0, 0.0]], [[-150.0, 0.0], [-60.0, 0.0]], [[300.0, 0.0], [900.0, 0.0]]];
        // In whichever direction it is cut.
        let order: Vec<usize> = from([0.0, 0.0], &cuts)[0].states.iter().map(|state| state[0]).collect();
        assert_eq!(order, [1, 0, 2]);
    }

    #[test]
    fn ways_are_the_shortest_there_are_each_to_another_end_and_hold_every_cut_once() {
        for seed in 0..20 {
            let mut rng = Rng::with_seed(seed);
            let count = rng.usize(1..=6);
            let mut end = || [1000.0 * rng.f64(), 1000.0 * rng.f64()];
            let cuts: Vec<[[f64; 2]; 2]> = (0..count).map(|_| [end(), end()]).collect();
            let ways = from([0.0, 0.0], &cuts);
            assert_eq!(ways.len(), if count <= MOST_EXACT { 2 * count } else { 1 }, "seed {seed}");
            for way in &ways {
                let mut made: Vec<usize> = way.states.iter().map(|state| state[0]).collect();
                made.sort_unstable();
                assert_eq!(made, (0..count).collect::<Vec<_>>(), "seed {seed}");
            }
            // The result is optimal for few cuts, and nearly optimal for more.
            let least = (0..1 << count).map(|turned| least_of(&cuts, turned)).fold(f64::INFINITY, f64::min);
            let most = if count <= MOST_EXACT { least } else { 1.15 * least };
            let changes = 3.0 * CHANGE * count as f64;
            assert!((least - 1e-9..most + changes).contains(&ways[0].time), "seed {seed}: {} {least}", ways[0].time);
        }
    }

    fn shortest(left: &mut Vec<[Stop; 2]>, from: &Stop, air: &Air) -> f64 {
        let mut least = if left.is_empty() { 0.0 } else { f64::INFINITY };
        for i in 0..left.len() {
            let next = left.remove(i);
            least = least.min(air.time(from, &next[0]) + shortest(left, &next[1], air));
            left.insert(i, next);
        }
        least
    }

    /// Duration of the shortest order of cuts, some of them reversed, s; tries every order.
    fn least_of(cuts: &[[[f64; 2]; 2]], turned: usize) -> f64 {
        let air = Air::new(&Job::default());
        let mut stops: Vec<[Stop; 2]> =
            cuts.iter().enumerate().map(|(i, &ends)| cut(ends, &air)[turned >> i & 1].stops).collect();
        shortest(&mut stops, &Stop::anyhow(Point::origin()), &air)
    }
}
