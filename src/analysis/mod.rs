//! Questions about the drawing and the blade, asked by several stages and answered once.
//!
//! Receives forms of [`ir`](crate::ir) and a machine, answers questions, never edits. Never asked by `verify`, which measures
//! for itself.

mod chord;
pub mod cloth;
pub mod plunge;
pub mod tight;
