//! Cuts of the blade: strokes, followed along the lines of the reference and judged by them.
//!
//! Receives strokes and the reference. Finds the stretches that each stroke cuts, the headings of the blade, the speed of its
//! tip, and cuts in wrong places. Never judges the limits of the axes.

pub(super) mod body;
pub(super) mod borders;
pub(super) mod chord;
pub(super) mod coverage;
mod covered;
pub(super) mod done;
mod drift;
pub(super) mod follow;
mod found;
pub(super) mod heading;
pub(super) mod heel;
mod joints;
pub(super) mod meetings;
pub(super) mod naming;
mod nibbles;
pub(super) mod overcut;
mod overlap;
pub(super) mod passing;
mod plunge_cut;
pub(super) mod plunged;
pub(super) mod stroke;
pub(super) mod strokes;
mod swing;
pub(super) mod trial;
mod vicinity;
pub(super) mod worsts;
