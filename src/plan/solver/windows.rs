//! Long problems solved window by window: one end of a run has no influence far away.
//!
//! The method is one sweep of block coordinate descent with overlapping blocks (Bertsekas, *Nonlinear Programming*, 2nd ed.,
//! section 2.7; the overlap as in the multiplicative Schwarz method, Toselli & Widlund, *Domain Decomposition Methods*, 2005,
//! chapter 1). Each window is solved to its optimum while everything outside is fixed: the part before it is final, the part
//! after it still has its start values. Those start values affect the last part of the window, which is solved again in the
//! next one. Every iterate is feasible for the whole. Steps, and the work of each, are bounded by the window size, so the cost
//! per unknown does not depend on their number. The tables of a window are made when it is solved.

use std::ops::Range;

use super::barrier::{self, Schedule};

/// Length beyond which proportional quantities stop growing, mm: longer runs are treated like one of this length.
pub(in crate::plan) const LENGTH_FELT: f64 = 10_000.0;

/// A problem in which each constraint and each term of the objective involves only a few consecutive unknowns.
pub(in crate::plan) trait Chain<const N: usize> {
    /// The problem of some unknowns, with the others fixed.
    type Part<'a>: barrier::Problem<N>
    where
        Self: 'a;

    /// Indices of the unknowns that are not fixed.
    fn free(&self) -> Range<usize>;

    /// The problem of `free`, and the range of unknowns that it reads: `free` and its neighbours.
    fn part(&self, free: Range<usize>) -> (Self::Part<'_>, Range<usize>);
}

/// Division of a chain into windows.
#[derive(Debug, Clone, Copy)]
pub(in crate::plan) struct Windows {
    /// Schedule for the optimum of each window.
    pub(in crate::plan) schedule: Schedule,
    /// Maximum number of unknowns of a window.
    pub(in crate::plan) size: usize,
    /// Number of unknowns at its end that are solved again in the next window. The influence of the end reaches no farther.
    pub(in crate::plan) overlap: usize,
}

/// Goes from a strictly feasible `x` to the optimum, within the gap of the schedule; `None` when `x` is not feasible.
pub(in crate::plan) fn minimise<const N: usize>(
    chain: &impl Chain<N>,
    mut x: Vec<[f64; N]>,
    windows: Windows,
) -> Option<Vec<[f64; N]>> {
    let free = chain.free();
    let mut start = free.start;
    loop {
        // Split so that the last window is never a short remainder.
        let left = free.end - start;
        let end = if left <= windows.size {
            free.end
        } else {
            start + windows.size.min(usize::midpoint(left, windows.overlap) + 1)
        };
        if start > free.start {
            // The solved part presses against its limits up to its final unknowns. A small window, as large as the influence of
            // the end, leaves those limits in steps that cost next to nothing.
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
