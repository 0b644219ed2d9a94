//! Passes: they edit the marker (what is cut, in which order), then make and edit the toolpath (what the knife does).
//!
//! Each pass is one function in one file and does one thing. Its docs tell its requirements and its guarantees. The tables give
//! the order.

pub mod marker;
pub mod toolpath;
