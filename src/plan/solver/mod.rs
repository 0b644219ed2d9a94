//! Numeric kernels shared by the spline and the timing: band matrices, the barrier method, windows over long problems.
//!
//! The input is a convex problem as numbers. The iterate is feasible at every step, and the result is the same on every
//! machine. The kernels do not know the meaning of the numbers.

pub(super) mod banded;
pub(super) mod barrier;
pub(super) mod windows;
