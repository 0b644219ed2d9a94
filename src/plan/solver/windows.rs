//! Long problems, window by window: what one end of a run does is not felt far away, so nobody need look at all of it at
//! once.
//!
//! One sweep of block coordinate descent with overlapping blocks (Bertsekas, *Nonlinear Programming*, 2nd ed., section
//! 2.7; the overlap as in the multiplicative Schwarz method, Toselli & Widlund, *Domain Decomposition Methods*, 2005,
//! chapter 1). Each window is brought to its optimum while all outside it stands still: what is before it is final, what
//! is behind it still as it started. Its last part, which feels that, is solved again in the next window. Every iterate is
//! feasible for the whole. Steps, and what each of them touches, are bounded by the window, so the cost of an unknown does
//! not depend on how many there are, and a window's tables are made when it is looked at.

use std::ops::Range;

use super::barrier::{self, Schedule};

/// A longer run is as one of this length, mm: what is a part of the length stays as fine as there.
pub(in crate::plan) const LENGTH_FELT: f64 = 10_000.0;

/// A problem in which each constraint and each term of the objective joins but a few unknowns in a row.
pub(in crate::plan) trait Chain<const N: usize> {
    /// The problem of some unknowns, the others standing still.
    type Part<'a>: barrier::Problem<N>
    where
        Self: 'a;

    /// The unknowns that are not fixed.
    fn free(&self) -> Range<usize>;

    /// The problem of `free`, and the unknowns that it needs to know: `free` and those next to it.
    fn part(&self, free: Range<usize>) -> (Self::Part<'_>, Range<usize>);
}

/// How a chain is divided.
#[derive(Debug, Clone, Copy)]
pub(in crate::plan) struct Windows {
    /// How each window is brought to its optimum.
    pub(in crate::plan) schedule: Schedule,
    /// Most unknowns of a window.
    pub(in crate::plan) size: usize,
    /// Unknowns at its end that are solved again in the next one: an end is not felt farther.
    pub(in crate::plan) overlap: usize,
}

/// From a strictly feasible `x` to the optimum, as near as the schedule says; `None` when `x` is not feasible.
pub(in crate::plan) fn minimise<const N: usize>(
    chain: &impl Chain<N>,
    mut x: Vec<[f64; N]>,
    windows: Windows,
) -> Option<Vec<[f64; N]>> {
    let free = chain.free();
    let mut start = free.start;
    loop {
        // Of what is left, no window is a short rest.
        let left = free.end - start;
        let end = if left <= windows.size {
            free.end
        } else {
            start + windows.size.min(usize::midpoint(left, windows.overlap) + 1)
        };
        if start > free.start {
            // What was solved presses against its limits up to where it is final. In a window as small as what feels that,
            // it comes off them in steps that cost next to nothing.
            let (part, near) = chain.part(start..(start + 2 * windows.overlap).min(end));
            let centred = barrier::centre(&part, x[near.clone()].to_vec(), windows.schedule)?;
            x[near].copy_from_slice(&centred);
        }
        let (part, near) = chain.part(start..end);
        let solved = barrier::minimise(&part, x[near.clone()].to_vec(), windows.schedule)?;
        x[near].copy_from_slice(&solved);
        if end == free.end {
            return Some(x);
        }
        start = end - windows.overlap;
    }
}
