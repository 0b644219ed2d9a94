//! The forms in which stages meet: [`marker`] (what the file says), [`toolpath`] (what the knife does, untimed), and of
//! that either [`motion`] (when the axes are where) or [`arcs`] (a path of arcs and lines, for controllers that plan for
//! themselves). Before a marker can be made of a plot there is a [`drawing`]: what its pens draw.
//!
//! Invariants, checked by [`check`] after every pass in tests and debug builds:
//!
//! - every number is finite; every contour has a segment at least; no segment has length zero
//! - the segments of a contour join: each starts where the one before it ends, to the bit (the list keeps no starts)
//! - a closed contour ends where it starts, to the bit; an open one does not
//! - links of the list agree in both directions; no segment belongs to two contours
//! - steps of a toolpath come in an order that a machine can run: the knife is down in runs and plunge cuts alone
//! - every run has one span a chord, overlaps that are not negative and a positive speed cap
//! - every run and plunge cut has one path of arcs; a piece has the length of its way, and a positive speed cap
//! - every phase of a motion has ticks, and a pose for each

pub mod arcs;
pub mod check;
pub mod declaration;
pub mod drawing;
pub mod label;
mod lines;
mod links;
pub mod list;
pub mod marker;
pub mod motion;
mod scattered;
mod target;
pub mod text;
pub mod toolpath;
pub mod verdict;

pub use arcs::Arcs;
pub use drawing::Drawing;
pub use lines::Chains;
pub use list::{Range, Segment, SegmentId, SegmentList};
pub use marker::Marker;
pub use motion::Motion;
pub use target::Target;
pub use toolpath::Toolpath;
pub use verdict::Finding;
