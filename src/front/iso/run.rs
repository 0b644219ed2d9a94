//! Runs of plain blocks, gathered before they are converted: what is done for many at once takes few steps for each.

use crate::source::Span;

/// Blocks that a run holds at the most.
const MOST: usize = 64;

/// Places of blocks that stand behind one another, in units of the file, and their spans.
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
    /// Takes what `next` gives for each place in place of what is here, until there is no more or no room: how many.
    #[inline] // most of a file comes here
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

    /// The places.
    pub(super) fn places(&self) -> impl DoubleEndedIterator<Item = [f64; 2]> + ExactSizeIterator {
        self.places[..self.count].iter().map(|place| place.map(f64::from))
    }

    /// Their spans.
    pub(super) fn spans(&self) -> &[Span] {
        &self.spans[..self.count]
    }

    /// A number that none of the places has a greater one than, whatever its sign.
    pub(super) fn bound(&self) -> f64 {
        // The bits of all together take fewer steps than the greatest of all.
        let bits = self.places[..self.count].iter().fold(0, |bits, place| bits | place[0] | place[1]);
        f64::from(bits.cast_unsigned())
    }
}
