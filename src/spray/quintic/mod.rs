//! The planner `quintic`: least-squares polynomials of order 5 for X, Y and C, edge by edge, joined by transitions.
//!
//! The method is that of Cink and Kosucki (control of a two-axis mechanism on a planar trajectory): the places of the head
//! have times by the speed that the edge asks for; between singular points (corners) each coordinate is the polynomial of
//! order 5 with the least squares; transitions join neighbouring edges; the controller gets position and velocity at equal
//! periods. C is a third coordinate here. Unless `quintic.split` is false edges are split in halves until the whole motion,
//! transitions included, keeps the tolerance at its time; corners are then fitted like edges.

mod pass;
mod polynomial;
mod solve;
mod split;
mod timeline;

pub(super) use solve::{Solved, solve};
pub(super) use split::Fit;
