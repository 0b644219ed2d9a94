//! The path of the tip: the polyline of a run with its overlaps becomes a smooth curve inside the tolerance band.
//!
//! The input is a run. The output is a spline of degree 5 that stays in its [`ToleranceBand`] everywhere, or the least
//! deviation found. Speeds and the orientation of the blade play no role here.

mod band;
mod extended;
mod knots;
mod lap;
mod smooth;

pub(super) use band::{JUNCTION_SHARES, Near, ToleranceBand};
pub(super) use extended::{Blocks, Extended, LEAD};
pub(super) use smooth::{Curve, Smooth, TooTight, has_room, smooth};
