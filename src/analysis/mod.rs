//! Analyses of the drawing and the blade that several stages share.
//!
//! Receives forms of [`ir`](crate::ir) and a machine. Answers questions: nesting of lines, depth of overlaps of parts, free way
//! of a blade before it enters a part, position of the plunged blade, deviation of a curve from its chords, duration of moves
//! with the knife up, estimated duration of cuts, dependencies of a piece. Never edits, and is never used by `verify`, which
//! measures for itself.

pub mod air;
mod area;
pub mod bulge;
mod chord;
pub mod cloth;
pub mod declare;
pub mod depth;
pub mod duration;
pub mod mouths;
pub mod nesting;
pub mod outlines;
pub mod plunge;
pub mod swing;
pub mod tight;
pub mod waits;

pub use area::area;
