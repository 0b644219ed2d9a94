//! The planner `quintic`: least-squares polynomials of order 5 for X, Y and C, edge by edge, joined by transitions.
//!
//! The method is that of Cink and Kosucki (control of a two-axis mechanism on a planar trajectory). Positions of the head get
//! times from the speed that the edge asks for. Between singular points (corners) each coordinate is the polynomial of order 5
//! with the least squares. Transitions join neighbouring edges. The controller gets position and velocity at equal periods.
//! Here C is a third coordinate. Unless `quintic.split` is false, edges are halved until the whole motion with its transitions
//! stays within the tolerance at its times; corners are then fitted like edges.

mod pass;
mod polynomial;
mod solve;
mod split;
mod timeline;

pub(super) use solve::{Solved, solve};
pub(super) use split::Fit;
