//! Cache of durations of moves: the same ones are needed repeatedly, and each takes roots and an arc cosine.

use std::cell::Cell;

use super::sequence::START;

/// Greatest number of cached durations; a power of two.
const MOST_KEPT: usize = 1 << 20;
/// Distance between rows if they do not all fit: 2^32 over the golden ratio, which spreads them (Knuth, *The art of computer
/// programming* 6.4).
const APART: usize = 0x9e37_79b1;

#[derive(Clone, Copy)]
struct Kept {
    between: [u32; 2],
    time: f64,
}

/// Empty entry: no visits have these numbers.
const NONE: Kept = Kept { between: [u32::MAX; 2], time: 0.0 };

/// Durations of moves between visits, s: all of few visits, or the most recent of many.
pub(super) struct Times<'a> {
    time: &'a dyn Fn(usize, usize) -> f64,
    /// Number of visits; the start has the index after them.
    count: usize,
    /// Distance between the entries of one visit and those of the next.
    row: usize,
    kept: Vec<Cell<Kept>>,
}

impl<'a> Times<'a> {
    pub(super) fn new(count: usize, time: &'a dyn Fn(usize, usize) -> f64) -> Self {
        let row = (count + 1).next_power_of_two();
        let (row, places) = if row <= MOST_KEPT / row { (row, row * row) } else { (APART, MOST_KEPT) };
        Self { time, count, row, kept: vec![Cell::new(NONE); places] }
    }

    pub(super) fn time(&self, from: usize, to: usize) -> f64 {
        let row = if from == START { self.count } else { from };
        let between = [row as u32, to as u32];
        let place = &self.kept[row.wrapping_mul(self.row).wrapping_add(to) & (self.kept.len() - 1)];
        let kept = place.get();
        if kept.between == between {
            return kept.time;
        }
        let time = (self.time)(from, to);
        place.set(Kept { between, time });
        time
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_time_is_that_of_its_move_however_many_there_are() {
        for count in [1, 7, 1023, 1024, 3000] {
            let asked = Cell::new(0);
            let time = |from: usize, to: usize| {
                asked.set(asked.get() + 1);
                if from == START { to as f64 } else { (from * 10_000 + to) as f64 }
            };
            let times = Times::new(count, &time);
            let moves =
                || (0..count).step_by(count.div_ceil(300)).flat_map(|from| (0..count).map(move |to| (from, to)));
            for _ in 0..2 {
                for (from, to) in moves().chain((0..count).map(|to| (START, to))) {
                    assert_eq!(times.time(from, to), time(from, to));
                }
            }
            let all = moves().count() + count;
            // Here, too, each is requested.
            assert!(count > 1023 || asked.get() == 3 * all, "{count}: {} {all}", asked.get());
        }
    }
}
