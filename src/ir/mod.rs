//! The intermediate forms: [`marker`] (the content of the file), [`toolpath`] (the steps of the knife, untimed), and made from
//! it either [`motion`] (the poses of the axes over time) or [`arcs`] (a path of arcs and lines, for controllers that plan for
//! themselves). A plot is read as a [`drawing`] (the strokes of its pens) before it becomes a marker.
//!
//! Invariants, checked by [`check`] after every pass in tests and debug builds:
//!
//! - every number is finite; every contour has at least one segment; no segment has length zero
//! - the segments of a contour join: each starts where the one before it ends, to the bit (the list keeps no starts)
//! - a closed contour ends where it starts, to the bit; an open one does not
//! - links of the list agree in both directions; no segment belongs to two contours
//! - steps of a toolpath come in an order that a machine can run: the knife is down only in runs and plunge cuts
//! - every run has one span per chord, overlaps of at least zero and a positive speed cap
//! - every run and plunge cut has one path of arcs; each piece has the length of its path, and a positive speed cap
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
