//! Position of the tip over time: the near time-optimal motion within limits of speed, acceleration and jerk.
//!
//! The input is the path of the axes and the limits. The output is the parameter as a function of time from rest to rest
//! ([`profile()`]), and the limit that binds each tick ([`Cutting`]). The path itself is never changed.

mod bound;
mod clock;
mod feed;
mod grid;
mod place;
mod profile;

pub(super) use bound::Cutting;
pub(super) use feed::Feed;
pub(super) use profile::{Bounds, profile};
