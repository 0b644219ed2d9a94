//! The path of the tip: the polyline of a run, with its overlaps, becomes a smooth curve inside the tolerance band.
//!
//! Receives a run, promises a spline of degree 5 that stays in its [`ToleranceBand`] everywhere, or the least deviation
//! that it found. Never asks how fast anything moves, or how the blade lies.

mod band;
mod extended;
mod knots;
mod lap;
mod smooth;

pub(super) use band::{JUNCTION_SHARES, Near, ToleranceBand};
pub(super) use extended::{Blocks, Extended, LEAD};
pub(super) use smooth::{Curve, Smooth, TooTight, has_room, smooth};
