//! Positions of heads across the feed over time, block by block, to detect heads that come too near to each other.

/// Periods per block.
pub(super) const BLOCK: i64 = 8;

/// Minimum and maximum y of a head in each block of periods, mm. The range is empty while the head is free.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Track {
    first: i64,
    blocks: Vec<[f64; 2]>,
}

/// Empty range: the head is free and may be anywhere.
const FREE: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

impl Track {
    /// Track of a head that is free between two ticks.
    pub(super) fn free([first, last]: [i64; 2]) -> Self {
        Self { first, blocks: vec![FREE; ((last - first) / BLOCK + 1).max(0) as usize] }
    }

    /// Records the position of a head at a tick.
    pub(super) fn put(&mut self, tick: i64, y: f64) {
        let [least, most] = &mut self.blocks[((tick - self.first) / BLOCK) as usize];
        *least = least.min(y);
        *most = most.max(y);
    }

    /// The blocks that contain the ticks from one to another.
    pub(super) fn between(&self, [from, to]: [i64; 2]) -> &[[f64; 2]] {
        let block = |tick: i64| ((tick - self.first) / BLOCK).max(0) as usize;
        let end = (block(to) + 1).min(self.blocks.len());
        &self.blocks[block(from).min(end)..end]
    }

    /// First tick of the block that contains a tick.
    pub(super) fn begin(&self, tick: i64) -> i64 {
        tick - (tick - self.first).rem_euclid(BLOCK)
    }

    /// True if two heads come nearer to each other than `width` mm while neither is free, or pass each other.
    pub(super) fn is_near(&self, other: &Self, width: f64) -> bool {
        let mut side = 0.0;
        self.blocks.iter().zip(&other.blocks).any(|(a, b)| {
            if a[0] > a[1] || b[0] > b[1] {
                return false;
            }
            let here = if a[0] - b[1] >= width {
                1.0
            } else if b[0] - a[1] >= width {
                -1.0
            } else {
                return true;
            };
            let passes = side * here < 0.0;
            side = here;
            passes
        })
    }

    /// Side of another head on which it is while neither is free: 1 above, -1 below, 0 if they never meet.
    pub(super) fn side(&self, other: &Self) -> f64 {
        let pairs = self.blocks.iter().zip(&other.blocks);
        let met = pairs.into_iter().find(|(a, b)| a[0] <= a[1] && b[0] <= b[1]);
        met.map_or(0.0, |(a, b)| (a[0] - b[0]).signum())
    }

    /// Mean y while it is not free, mm.
    pub(super) fn middle(&self) -> f64 {
        let (sum, count) = self
            .blocks
            .iter()
            .filter(|block| block[0] <= block[1])
            .fold((0.0, 0_u32), |(sum, count), block| (sum + f64::midpoint(block[0], block[1]), count + 1));
        sum / f64::from(count.max(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heads_are_near_while_neither_is_free_and_never_pass() {
        let track = |from: i64, ys: &[f64]| {
            let mut track = Track::free([-20, 100]);
            ys.iter().zip(from..).for_each(|(&y, tick)| track.put(tick, y));
            track
        };
        let low = track(0, &[0.0; 20]);
        assert!(low.is_near(&track(10, &[50.0; 20]), 80.0) && !low.is_near(&track(40, &[50.0; 20]), 80.0));
        assert!(!low.is_near(&track(10, &[90.0; 20]), 80.0));
        assert_eq!((low.side(&track(10, &[90.0; 20])), low.side(&track(40, &[9.0]))), (-1.0, 0.0));
        let passing = track(0, &[[100.0; 8], [100.0; 8]].concat());
        let other = track(0, &[[0.0; 8], [200.0; 8]].concat());
        assert!(passing.is_near(&other, 80.0));
    }
}
