//! Orientation of the blade along the curve of its tip: tangent or chord.
//!
//! The input is a curve and an orientation mode. The output is the positions of the axes x, y, c and their derivatives up to
//! the third at any parameter ([`Way`]), or the place where the blade is too wide for its mode. Time plays no role here.

mod axes;
mod chord;
mod fade;
mod way;

pub(super) use axes::{Axes, Blade};
pub(super) use chord::TooTight;
pub(super) use way::{Course, Entry, WAY_EPSILON, Walk, Way};
