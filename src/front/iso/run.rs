//! Runs of plain blocks, gathered before conversion: processing many at once takes fewer steps per block.

use crate::source::Span;

/// Maximum number of blocks in a run.
const MOST: usize = 64;

/// Points of consecutive blocks, in units of the file, and their spans.
#[derive(Debug)]
pub(super) struct Run {
    places: [[i32; 2]; MOST],
    spans: [Span; MOST],
    count: usize,
}

impl Default for Run {
    fn default() -> Self {
        Self { places: [[0; 2]; MOST], spans: [Span::default(); MOST], count: 0 }
    }
}

impl Run {
    /// Refills the run from `next`, until it returns `None` or the run is full. Returns the number of points.
    #[inline] // most of a file passes here
    pub(super) fn fill(&mut self, mut next: impl FnMut(usize) -> Option<([i32; 2], Span)>) -> usize {
        let mut count = 0;
        while count < MOST
            && let Some((place, span)) = next(count)
        {
            (self.places[count], self.spans[count]) = (place, span);
            count += 1;
        }
        self.count = count;
        count
    }

    /// The points.
    pub(super) fn places(&self) -> impl DoubleEndedIterator<Item = [f64; 2]> + ExactSizeIterator {
        self.places[..self.count].iter().map(|place| place.map(f64::from))
    }

    /// The spans of the points.
    pub(super) fn spans(&self) -> &[Span] {
        &self.spans[..self.count]
    }

    /// An upper bound on the absolute values of all coordinates.
    pub(super) fn bound(&self) -> f64 {
        // Combining the bits of all coordinates takes fewer steps than finding the maximum.
        let bits = self.places[..self.count].iter().fold(0, |bits, place| bits | place[0] | place[1]);
        f64::from(bits.cast_unsigned())
    }
}
