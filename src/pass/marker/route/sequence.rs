//! Sequence of visits: gain and violated rules when two adjacent stretches are exchanged or reversed.

/// Number of places per block of prefix sums: the cost of a sum over a stretch and of an update stays near its length.
const BLOCK: usize = 64;

/// Parameters of a tour.
pub(super) struct Ways<'a> {
    /// Duration of the move from the end of one visit to the start of another, s; `START` is never the target.
    pub(super) time: &'a dyn Fn(usize, usize) -> f64,
    /// Neighbours of each visit.
    pub(super) near: &'a [Vec<u32>],
    /// Visits that must precede each visit.
    pub(super) before: &'a [Vec<u32>],
    /// Position of each visit along X, mm, and the greatest distance that the tour may go back; `None` = any.
    pub(super) along: &'a [f64],
    pub(super) window: Option<f64>,
}

/// Index of the start of the tour, which is not a visit.
pub(super) const START: usize = usize::MAX;

/// Exchange of two adjacent stretches, each optionally reversed. If the second is empty, only the first is reversed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Change {
    /// Start of the first stretch, start of the second, and end of the second.
    pub(super) places: [usize; 3],
    /// True for each of the two that is reversed.
    pub(super) turned: [bool; 2],
}

impl Change {
    /// Exchange without reversal.
    pub(super) fn swap(places: [usize; 3]) -> Self {
        Self { places, turned: [false; 2] }
    }

    /// Reversal of the stretch between two places.
    pub(super) fn turn([low, high]: [usize; 2]) -> Self {
        Self { places: [low, high, high], turned: [true, false] }
    }

    /// Number of visits moved.
    pub(super) fn count(self) -> usize {
        self.places[2] - self.places[0]
    }

    /// Boundary between the two stretches after the change.
    fn middle_then(self) -> usize {
        let [low, middle, high] = self.places;
        low + high - middle
    }

    /// Inverse change.
    pub(super) fn inverse(self) -> Self {
        let ([low, _, high], [first, second]) = (self.places, self.turned);
        Self { places: [low, self.middle_then(), high], turned: [second, first] }
    }

    /// Places on both sides of each seam after the change, where they exist.
    pub(super) fn seams(self) -> [usize; 6] {
        let [low, _, high] = self.places;
        let middle = self.middle_then();
        [low.wrapping_sub(1), low, middle.wrapping_sub(1), middle, high - 1, high]
    }

    /// Place after the change of the visit at a place.
    fn place_then(self, place: usize) -> usize {
        let ([low, middle, high], [first, second]) = (self.places, self.turned);
        if place < low || high <= place {
            place
        } else if place < middle {
            self.middle_then() + if first { middle - 1 - place } else { place - low }
        } else {
            low + if second { high - 1 - place } else { place - middle }
        }
    }
}

/// Visits in an order, with cached properties.
pub(super) struct Sequence<'a> {
    ways: &'a Ways<'a>,
    has_rules: bool,
    order: Vec<u32>,
    /// Place of each visit in the order.
    place: Vec<u32>,
    /// Greatest position along X before each place, mm; maintained if there is a window.
    front: Vec<f64>,
    /// Duration of the move to each place from the previous one, and of the reverse move, s; 0 after the last.
    onward: Vec<f64>,
    back: Vec<f64>,
    /// Within each block, the prefix sum of the durations of moves minus those of their reverse moves, s.
    saved: Vec<f64>,
}

impl<'a> Sequence<'a> {
    pub(super) fn new(order: &[usize], ways: &'a Ways<'a>) -> Self {
        let count = order.len();
        let mut sequence = Self {
            ways,
            has_rules: ways.window.is_some() || ways.before.iter().any(|before| !before.is_empty()),
            order: order.iter().map(|&visit| visit as u32).collect(),
            place: vec![0; count],
            front: vec![f64::NEG_INFINITY; count],
            onward: vec![0.0; count + 1],
            back: vec![0.0; count + 1],
            saved: vec![0.0; count + 1],
        };
        (0..count).for_each(|place| sequence.join(place));
        sequence.note(0, count);
        sequence
    }

    pub(super) fn order(&self) -> impl Iterator<Item = usize> {
        self.order.iter().map(|&visit| visit as usize)
    }

    pub(super) fn count(&self) -> usize {
        self.order.len()
    }

    pub(super) fn place(&self, visit: usize) -> usize {
        self.place[visit] as usize
    }

    /// Visit at a place.
    pub(super) fn at(&self, place: usize) -> usize {
        self.order[place] as usize
    }

    /// Visit at a place; `None` past the end.
    pub(super) fn get(&self, place: usize) -> Option<usize> {
        self.order.get(place).map(|&visit| visit as usize)
    }

    /// Duration of the move to a place from the previous one, s; 0 after the last.
    pub(super) fn onward(&self, place: usize) -> f64 {
        self.onward[place]
    }

    /// Visit before a place, or `START`.
    fn before(&self, place: usize) -> usize {
        place.checked_sub(1).map_or(START, |before| self.at(before))
    }

    /// Updates the durations of the moves between a place and the previous one.
    fn join(&mut self, place: usize) {
        if let Some(visit) = self.get(place) {
            let before = self.before(place);
            self.onward[place] = (self.ways.time)(before, visit);
            // The start is never part of a reversal.
            self.back[place] = if before == START { 0.0 } else { (self.ways.time)(visit, before) };
        }
    }

    /// Updates the cached properties that depend on the visits in a range of places.
    fn note(&mut self, low: usize, high: usize) {
        for (&visit, place) in self.order[low..high].iter().zip(low as u32..) {
            self.place[visit as usize] = place;
        }
        if self.ways.window.is_some() {
            let along = |place: usize| self.ways.along[self.order[place] as usize];
            let before = low.checked_sub(1).map(|before| self.front[before].max(along(before)));
            let mut front = before.unwrap_or(f64::NEG_INFINITY);
            for place in low..high {
                self.front[place] = front;
                front = front.max(along(place));
            }
        }
        // The move to the place behind them changes as well.
        let end = (high + 1).next_multiple_of(BLOCK).min(self.saved.len());
        let mut saved = if low.is_multiple_of(BLOCK) { 0.0 } else { self.saved[low - 1] };
        for place in low..end {
            if place.is_multiple_of(BLOCK) {
                saved = 0.0;
            }
            saved += self.onward[place] - self.back[place];
            self.saved[place] = saved;
        }
    }

    /// Time saved by reversing the moves between the first and the last of some places, s.
    fn saved(&self, [first, last]: [usize; 2]) -> f64 {
        let blocks = first / BLOCK..last / BLOCK;
        let whole: f64 = blocks.map(|block| self.saved[block * BLOCK + BLOCK - 1]).sum();
        whole + self.saved[last] - self.saved[first]
    }

    /// Time saved by a change, s. May return any value up to `asked` early.
    pub(super) fn gain(&self, change: Change, asked: f64) -> f64 {
        let Change { places: [low, middle, high], turned } = change;
        let time = self.ways.time;
        let mut gain = self.onward[low] + self.onward[high];
        let mut ends = |stretch: [usize; 2], is_turned: bool| {
            let [first, last] = [stretch[0], stretch[1] - 1];
            if is_turned {
                gain += self.saved([first, last]);
                [self.at(last), self.at(first)]
            } else {
                [self.at(first), self.at(last)]
            }
        };
        let mut first = ends([low, middle], turned[0]);
        if middle < high {
            let second = ends([middle, high], turned[1]);
            gain += self.onward[middle];
            if gain > asked {
                gain -= time(second[1], first[0]);
            }
            first[0] = second[0];
        }
        if gain > asked {
            gain -= time(self.before(low), first[0]);
        }
        if gain > asked && high < self.count() {
            gain -= time(first[1], self.at(high));
        }
        gain
    }

    /// True if a change increases the violations of either kind: a window does not justify cutting a part before its contents.
    pub(super) fn breaks(&self, change: Change) -> bool {
        if !self.has_rules {
            return false;
        }
        let Change { places: [low, middle, high], turned } = change;
        let (mut now, mut then) = (0, 0);
        for place in low..high {
            for &other in &self.ways.before[self.at(place)] {
                let other = self.place(other as usize);
                now += usize::from(other > place);
                then += usize::from(change.place_then(other) > change.place_then(place));
            }
        }
        if then > now {
            return true;
        }
        let Some(window) = self.ways.window else { return false };
        let along = |place: usize| self.ways.along[self.at(place)];
        let now = (low..high).filter(|&place| along(place) < self.front[place] - window).count();
        let (mut front, mut then) = (self.front[low], 0);
        for (start, end, is_turned) in [(middle, high, turned[1]), (low, middle, turned[0])] {
            for place in start..end {
                let along = along(if is_turned { start + end - 1 - place } else { place });
                then += usize::from(along < front - window);
                front = front.max(along);
            }
        }
        then > now
    }

    pub(super) fn change(&mut self, change: Change) {
        let Change { places: [low, middle, high], turned } = change;
        let then = change.middle_then();
        self.order[low..high].rotate_left(middle - low);
        self.onward[low..high].rotate_left(middle - low);
        self.back[low..high].rotate_left(middle - low);
        for (start, end, is_turned) in [(low, then, turned[1]), (then, high, turned[0])] {
            if is_turned {
                self.order[start..end].reverse();
                self.onward[start + 1..end].reverse();
                self.back[start + 1..end].reverse();
                self.onward[start + 1..end].swap_with_slice(&mut self.back[start + 1..end]);
            }
        }
        for place in [low, then, high] {
            self.join(place);
        }
        self.note(low, high);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastrand::Rng;

    /// Applies random changes to an order with times, rules and a window, and compares the cached properties with the order.
    fn check(count: usize, changes: usize, seed: u64) {
        let mut rng = Rng::with_seed(seed);
        let times: Vec<f64> = (0..(count + 1) * count).map(|_| rng.f64()).collect();
        let time = |from: usize, to: usize| times[if from == START { count } else { from } * count + to];
        let along: Vec<f64> = (0..count).map(|_| rng.f64()).collect();
        let before: Vec<Vec<u32>> =
            (0..count).map(|i| if i % 3 == 1 { vec![i as u32 - 1] } else { Vec::new() }).collect();
        let ways = Ways { time: &time, near: &[], before: &before, along: &along, window: Some(0.3) };
        let mut order: Vec<usize> = (0..count).collect();
        let mut sequence = Sequence::new(&order, &ways);
        let whole = |order: &[usize]| {
            let from = std::iter::once(START).chain(order.iter().copied());
            from.zip(order).map(|(from, &to)| time(from, to)).sum::<f64>()
        };
        let broken = |order: &[usize]| {
            let place = |visit: usize| order.iter().position(|&other| other == visit).expect("each is in it");
            let early = (0..count).flat_map(|i| before[i].iter().map(move |&other| (i, other as usize)));
            let front = |at: usize| order[..at].iter().map(|&visit| along[visit]).fold(f64::NEG_INFINITY, f64::max);
            [
                early.filter(|&(i, other)| place(other) > place(i)).count(),
                (0..count).filter(|&at| along[order[at]] < front(at) - 0.3).count(),
            ]
        };
        for _ in 0..changes {
            let mut places = [0; 3].map(|_: usize| rng.usize(0..=count));
            places.sort_unstable();
            let [low, middle, high] = places;
            if low == middle {
                continue;
            }
            let turned = [rng.bool(), middle < high && rng.bool()];
            let change = Change { places, turned };
            let mut then = order.clone();
            let turn = |stretch: &[usize], is_turned: bool| {
                let mut stretch = stretch.to_vec();
                if is_turned {
                    stretch.reverse();
                }
                stretch
            };
            let [first, second] = [turn(&order[low..middle], turned[0]), turn(&order[middle..high], turned[1])];
            then.splice(low..high, second.into_iter().chain(first));
            let gain = whole(&order) - whole(&then);
            assert!((sequence.gain(change, f64::NEG_INFINITY) - gain).abs() < 1e-9, "{change:?}");
            let more = broken(&then).into_iter().zip(broken(&order)).any(|(then, now)| then > now);
            assert_eq!(sequence.breaks(change), more, "{change:?}");
            sequence.change(change);
            assert!(sequence.order().eq(then.iter().copied()), "{change:?}");
            if rng.bool() {
                sequence.change(change.inverse());
                assert!(sequence.order().eq(order.iter().copied()), "{change:?}");
            } else {
                order = then;
            }
            assert!((0..count).all(|place| sequence.place(sequence.at(place)) == place));
        }
    }

    #[test]
    fn a_change_gains_and_breaks_what_the_orders_tell() {
        for seed in 0..10 {
            check(7, 200, seed);
            check(300, 200, seed);
        }
    }
}
