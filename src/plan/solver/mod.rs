//! Numeric kernels that the spline and the timing share: band matrices, the barrier method, windows over long problems.
//!
//! Receives convex problems as numbers, promises a feasible point at every step and the same result on every machine.
//! Never knows what the numbers stand for.

pub(super) mod banded;
pub(super) mod barrier;
pub(super) mod windows;
