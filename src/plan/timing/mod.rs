//! When the tip is where on its way: the near time-optimal motion within limits of speed, acceleration and jerk.
//!
//! Receives the way of the axes and the limits, promises the parameter as a function of time from rest to rest
//! ([`profile()`]), and says what bounds it, tick by tick ([`Cutting`]). Never changes the way.

mod bound;
mod clock;
mod feed;
mod grid;
mod place;
mod profile;

pub(super) use bound::Cutting;
pub(super) use feed::Feed;
pub(super) use profile::{Bounds, profile};
