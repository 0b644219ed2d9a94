//! How the blade lies along the curve of its tip: as its tangent or as a chord of it.
//!
//! Receives a curve and an orientation mode, promises the positions of the axes x, y, c and their derivatives up to the
//! third at any parameter ([`Way`]), or the place where the blade is too wide for its mode. Never knows time.

mod axes;
mod chord;
mod fade;
mod way;

pub(super) use axes::{Axes, Blade};
pub(super) use chord::TooTight;
pub(super) use way::{Course, Entry, WAY_EPSILON, Walk, Way};
