//! Passes: they edit the marker (what is cut, in which order), then make and edit the toolpath (what the knife does).
//!
//! Each pass is one function in one file, does one thing, says what it needs and what it leaves true. The tables give
//! the order.

pub mod marker;
pub mod toolpath;
