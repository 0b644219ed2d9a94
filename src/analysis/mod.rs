//! Questions about the drawing and the blade, asked by several stages and answered once.
//!
//! Receives forms of [`ir`](crate::ir) and a machine, answers questions: which line lies in which, how deep two parts
//! overlap, how far a blade may go before it enters a part, where it lies when it is plunged, how far a curve lies beside its
//! chords, how long moves with the knife up take and about how long cuts do, what a piece waits for. Never edits, and is never
//! asked by `verify`, which measures for itself.

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
