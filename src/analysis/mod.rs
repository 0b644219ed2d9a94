//! What stages ask of the cloth: which line lies in which.
//!
//! Receives a marker, or lines of a drawing; promises one answer to all who ask: what recognises parts, passes, the planner
//! and the writers. Never edits anything, and is never asked by the verifier, which measures for itself.

mod area;
pub mod cloth;
pub mod nesting;

pub use area::area;
