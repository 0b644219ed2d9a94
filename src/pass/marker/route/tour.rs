//! The order of visits in which the moves between them take the least time: a travelling salesman's tour with an open end.
//!
//! Moves of up to three visits to another place (Or, 1976) and reversals (2-opt) among near ones, from a tour of strips;
//! then two neighbouring stretches are swapped at places that are spread evenly, the tour is improved there, and what is no
//! better is taken back (Lourenço, Martin & Stützle 2003, *Iterated local search*). No clock and no dice: the same on every
//! machine.

use std::ops::Range;

/// Visits that are moved together, at the most.
const MOST_MOVED: usize = 3;
/// Stretches that are reversed have as many visits at the most: the moves between them take other times then.
const MOST_REVERSED: usize = 1000;
/// Swapped stretches a visit, and in all.
const KICKS_A_VISIT: usize = 15;
const MOST_KICKS: usize = 3_000;
/// Visits of a stretch that is swapped, at the most.
const MOST_SWAPPED: usize = 30;
/// Gains that are less are none, s: rounding.
const LEAST_GAIN: f64 = 1e-9;
/// Fractions whose multiples spread evenly in three dimensions: powers of the inverse root of x^4 = x + 1 (Roberts 2018, *The
/// unreasonable effectiveness of quasirandom sequences*).
const SPREAD: [f64; 3] = [0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_969_9];

/// What a tour goes by.
pub(super) struct Ways<'a> {
    /// Time of the move from the end of one visit to the start of another, s; none ends where the tour starts, as `START`.
    pub(super) time: &'a dyn Fn(usize, usize) -> f64,
    /// Those near each visit.
    pub(super) near: &'a [Vec<u32>],
    /// Those that come before each visit.
    pub(super) before: &'a [Vec<u32>],
    /// Where each lies along X, mm, and how far the tour may go back there; `None` = as far as it likes.
    pub(super) along: &'a [f64],
    pub(super) window: Option<f64>,
}

/// Where the tour starts: no visit.
pub(super) const START: usize = usize::MAX;

/// Improves the order of visits, with swaps or without; rules that it keeps are kept.
pub(super) fn improve(order: &mut Vec<usize>, ways: &Ways, is_last: bool) {
    if order.len() < 2 {
        return;
    }
    let mut tour = Tour::new(std::mem::take(order), ways);
    let all = tour.order.clone();
    tour.settle(all);
    let count = tour.order.len();
    let kicks = if is_last { (KICKS_A_VISIT * count).min(MOST_KICKS) } else { 0 };
    for kick in 1..=kicks {
        let [place, first, second] = SPREAD.map(|step| (kick as f64 * step).fract());
        let length = |share: f64| 1 + (share * (MOST_SWAPPED.min(count / 2)) as f64) as usize;
        let low = (place * count as f64) as usize;
        let (middle, high) = (low + length(first), low + length(first) + length(second));
        if high <= count {
            tour.kick([low, middle, high]);
        }
    }
    *order = tour.order;
}

/// A change of the order that can be taken back.
#[derive(Clone, Copy)]
enum Change {
    /// What lies from the second place on comes before what lies from the first.
    Swap([usize; 3]),
    Reverse([usize; 2]),
}

impl Change {
    /// The places that it is about, the last of them behind it.
    fn places(self) -> [usize; 3] {
        match self {
            Self::Swap(places) => places,
            Self::Reverse([low, high]) => [low, high, high],
        }
    }

    /// The places before which others stand then.
    fn seams(self) -> [usize; 3] {
        let [low, middle, high] = self.places();
        [low, low + high - middle, high]
    }
}

struct Tour<'a> {
    ways: &'a Ways<'a>,
    order: Vec<usize>,
    /// The place of each visit in the order.
    place: Vec<usize>,
    /// The farthest along X before each place, mm.
    front: Vec<f64>,
    /// Time of the move to each place from the one before, and of that back, s.
    onward: Vec<f64>,
    back: Vec<f64>,
    /// The changes since the last kick.
    done: Vec<Change>,
}

impl<'a> Tour<'a> {
    fn new(order: Vec<usize>, ways: &'a Ways<'a>) -> Self {
        let count = order.len();
        let (place, front) = (vec![0; count], vec![f64::NEG_INFINITY; count]);
        let (onward, back) = (vec![0.0; count], vec![0.0; count]);
        let mut tour = Self { ways, order, place, front, onward, back, done: Vec::new() };
        tour.note(0..count);
        (0..count).for_each(|place| tour.join(place));
        tour
    }

    /// The visit at a place; the start before the first, `None` behind the last.
    fn at(&self, place: Option<usize>) -> Option<usize> {
        place.map_or(Some(START), |place| self.order.get(place).copied())
    }

    /// Time from one visit to the next, s; nothing behind the last.
    fn time(&self, from: Option<usize>, to: Option<usize>) -> f64 {
        match (from, to) {
            (Some(from), Some(to)) => (self.ways.time)(from, to),
            _ => 0.0,
        }
    }

    /// Notes where visits stand.
    fn note(&mut self, places: Range<usize>) {
        for at in places {
            let visit = self.order[at];
            self.place[visit] = at;
            let before = at
                .checked_sub(1)
                .map_or(f64::NEG_INFINITY, |before| f64::max(self.front[before], self.ways.along[self.order[before]]));
            self.front[at] = before;
        }
    }

    /// How many rules the visits at some places break.
    fn broken(&self, places: Range<usize>) -> usize {
        let is_early = |at: usize| {
            let before = &self.ways.before[self.order[at]];
            before.iter().filter(|&&other| self.place[other as usize] > at).count()
        };
        let is_behind = |at: usize| {
            self.ways.window.is_some_and(|window| self.ways.along[self.order[at]] < self.front[at] - window)
        };
        places.map(|at| is_early(at) + usize::from(is_behind(at))).sum()
    }

    /// Notes how long the moves between a place and the one before take.
    fn join(&mut self, place: usize) {
        let Some(&visit) = self.order.get(place) else { return };
        let before = self.at(place.checked_sub(1));
        self.onward[place] = self.time(before, Some(visit));
        self.back[place] = if place > 0 { self.time(Some(visit), before) } else { 0.0 };
    }

    fn change(&mut self, change: Change) {
        let [low, middle, high] = change.places();
        match change {
            Change::Swap(_) => {
                self.order[low..high].rotate_left(middle - low);
                self.onward[low..high].rotate_left(middle - low);
                self.back[low..high].rotate_left(middle - low);
            }
            Change::Reverse(_) => {
                self.order[low..high].reverse();
                self.onward[low + 1..high].reverse();
                self.back[low + 1..high].reverse();
                self.onward[low + 1..high].swap_with_slice(&mut self.back[low + 1..high]);
            }
        }
        self.note(low..high);
        change.seams().into_iter().for_each(|place| self.join(place));
    }

    fn take_back(&mut self, change: Change) {
        self.change(match change {
            Change::Swap([low, middle, high]) => Change::Swap([low, low + high - middle, high]),
            Change::Reverse(_) => change,
        });
    }

    /// Changes the order unless more rules are broken then.
    fn try_change(&mut self, change: Change) -> bool {
        let [low, _, high] = change.places();
        let before = self.broken(low..high);
        self.change(change);
        if self.broken(low..high) > before {
            self.take_back(change);
            return false;
        }
        self.done.push(change);
        true
    }

    /// Swaps two neighbouring stretches and improves the tour there, unless that is worse in the end.
    fn kick(&mut self, places: [usize; 3]) {
        let change = Change::Swap(places);
        let gain = self.gain(change);
        self.done.clear();
        if !self.try_change(change) {
            return;
        }
        let moved = self.about(change.seams());
        if gain + self.settle(moved) < LEAST_GAIN {
            for change in std::mem::take(&mut self.done).into_iter().rev() {
                self.take_back(change);
            }
        }
    }

    /// Improves the tour about some visits until nothing more is gained; what was gained, s.
    fn settle(&mut self, mut open: Vec<usize>) -> f64 {
        let mut gained = 0.0;
        while let Some(visit) = open.pop() {
            while let Some((gain, changed)) = self.improve_at(visit) {
                gained += gain;
                open.extend(changed);
            }
        }
        gained
    }

    /// The first change about a visit that gains: how much, s, and the visits whose neighbours are others now.
    fn improve_at(&mut self, visit: usize) -> Option<(f64, Vec<usize>)> {
        for k in 0..self.ways.near[visit].len() {
            let other = self.ways.near[visit][k] as usize;
            for [from, to] in [[visit, other], [other, visit]] {
                let [i, j] = [from, to].map(|visit| self.place[visit]);
                let time = (self.ways.time)(from, to);
                // One of the two moves that it takes the place of must take longer.
                if time >= self.onward.get(i + 1).copied().unwrap_or(0.0) && time >= self.onward[j] {
                    continue;
                }
                for change in joining(i, j).into_iter().flatten() {
                    if change.places()[2] > self.order.len() {
                        continue;
                    }
                    let gain = self.gain(change);
                    if gain > LEAST_GAIN && self.try_change(change) {
                        return Some((gain, self.about(change.seams())));
                    }
                }
            }
        }
        None
    }

    /// The visits on either side of some places.
    fn about(&self, places: [usize; 3]) -> Vec<usize> {
        let sides = places.into_iter().flat_map(|place| [place.checked_sub(1), Some(place)]);
        sides.flatten().filter_map(|place| self.order.get(place).copied()).collect()
    }

    /// What a change gains, s.
    fn gain(&self, change: Change) -> f64 {
        match change {
            Change::Swap(places) => self.swap_gain(places),
            Change::Reverse(places) => self.reverse_gain(places),
        }
    }

    /// What is gained when what lies from the second place on comes before what lies from the first, s.
    fn swap_gain(&self, [low, middle, high]: [usize; 3]) -> f64 {
        let before = self.at(low.checked_sub(1));
        let [first, second, behind] = [low, middle, high].map(|place| self.at(Some(place)));
        let [first_end, second_end] = [middle - 1, high - 1].map(|place| self.at(Some(place)));
        let now = self.time(before, first) + self.time(first_end, second) + self.time(second_end, behind);
        now - self.time(before, second) - self.time(second_end, first) - self.time(first_end, behind)
    }

    /// What is gained when what lies between two places is reversed, s.
    fn reverse_gain(&self, [low, high]: [usize; 2]) -> f64 {
        if high - low < 2 || high - low > MOST_REVERSED {
            return 0.0;
        }
        let before = self.at(low.checked_sub(1));
        let [first, last, behind] = [low, high - 1, high].map(|place| self.at(Some(place)));
        let ends = self.time(before, first) + self.time(last, behind);
        let turned = self.time(before, last) + self.time(first, behind);
        let within: f64 = self.onward[low + 1..high].iter().sum();
        let back: f64 = self.back[low + 1..high].iter().sum();
        ends + within - turned - back
    }
}

/// The changes that bring what stands at one place right before what stands at another, with up to some of its neighbours.
fn joining(i: usize, j: usize) -> [Option<Change>; 2 * MOST_MOVED + 2] {
    let mut changes = [None; 2 * MOST_MOVED + 2];
    for length in 1..=MOST_MOVED {
        let swaps = if j > i + 1 {
            [Some([i + 1, j, j + length]), (i + 1 > length - 1).then(|| [i + 1 - length, i + 1, j])]
        } else if j < i {
            [
                (j + length <= i).then(|| [j, j + length, i + 1]),
                (i + 1 > j + length).then(|| [j, i + 1 - length, i + 1]),
            ]
        } else {
            [None; 2]
        };
        changes[2 * length - 2] = swaps[0].map(Change::Swap);
        changes[2 * length - 1] = swaps[1].map(Change::Swap);
    }
    if j > i + 1 {
        changes[2 * MOST_MOVED] = Some(Change::Reverse([i + 1, j + 1]));
        changes[2 * MOST_MOVED + 1] = Some(Change::Reverse([i, j]));
    }
    changes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use fastrand::Rng;

    fn points(rng: &mut Rng, count: usize) -> Vec<Point> {
        (0..count).map(|_| Point::new(rng.f64() * 1000.0, rng.f64() * 1000.0)).collect()
    }

    /// Distance between points; from the corner of the table to the first.
    fn distance(points: &[Point]) -> impl Fn(usize, usize) -> f64 {
        |from, to| (points[to] - if from == START { Point::origin() } else { points[from] }).norm()
    }

    fn length(order: &[usize], time: &dyn Fn(usize, usize) -> f64) -> f64 {
        let from = std::iter::once(START).chain(order.iter().copied());
        from.zip(order).map(|(from, &to)| time(from, to)).sum()
    }

    /// The tour over points from the order in which they are given.
    fn toured(points: &[Point], before: &[Vec<u32>], window: Option<f64>) -> Vec<usize> {
        let count = points.len();
        let near: Vec<Vec<u32>> = (0..count)
            .map(|i| {
                let mut others: Vec<usize> = (0..count).filter(|&k| k != i).collect();
                others.sort_by(|&a, &b| (points[a] - points[i]).norm().total_cmp(&(points[b] - points[i]).norm()));
                others.into_iter().take(10).map(|k| k as u32).collect()
            })
            .collect();
        let along: Vec<f64> = points.iter().map(|point| point.x).collect();
        let mut order: Vec<usize> = (0..count).collect();
        if window.is_some() {
            order.sort_by(|&a, &b| along[a].total_cmp(&along[b]));
        }
        let time = distance(points);
        improve(&mut order, &Ways { time: &time, near: &near, before, along: &along, window }, true);
        order
    }

    fn shortest(left: &mut Vec<usize>, from: usize, time: &dyn Fn(usize, usize) -> f64) -> f64 {
        if left.is_empty() {
            return 0.0;
        }
        let mut least = f64::INFINITY;
        for i in 0..left.len() {
            let next = left.remove(i);
            least = least.min(time(from, next) + shortest(left, next, time));
            left.insert(i, next);
        }
        least
    }

    #[test]
    fn tours_of_a_few_points_are_the_shortest_there_are() {
        for seed in 0..15 {
            let points = points(&mut Rng::with_seed(seed), 8);
            let time = distance(&points);
            let order = toured(&points, &vec![Vec::new(); 8], None);
            let least = shortest(&mut (0..8).collect(), START, &time);
            assert!(length(&order, &time) <= 1.001 * least, "seed {seed}: {} {least}", length(&order, &time));
        }
    }

    #[test]
    fn every_visit_is_made_once_and_no_rule_is_broken() {
        for seed in 0..4 {
            let mut rng = Rng::with_seed(seed);
            let points = points(&mut rng, 120);
            // Each third one waits for the one in front of it.
            let before: Vec<Vec<u32>> = (0..120).map(|i| if i % 3 == 2 { vec![i - 1] } else { Vec::new() }).collect();
            let order = toured(&points, &before, None);
            let place = |visit: usize| order.iter().position(|&other| other == visit).expect("it is made");
            assert!((0..120).all(|i| before[i].iter().all(|&other| place(other as usize) < place(i))), "seed {seed}");
            let order = toured(&points, &vec![Vec::new(); 120], Some(150.0));
            let mut front = f64::NEG_INFINITY;
            for &visit in &order {
                assert!(points[visit].x >= front - 150.0, "seed {seed}");
                front = front.max(points[visit].x);
            }
            let mut sorted = order;
            sorted.sort_unstable();
            assert_eq!(sorted, (0..120).collect::<Vec<_>>());
        }
    }
}
