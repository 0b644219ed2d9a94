//! Reference: the lines of the marker, the parts that they enclose, and the layout of the cloth.
//!
//! Input: the final marker and the profile. Output: lines with their corners, caps and exceptions, derived independently of the
//! compiler. The program itself is not used.

pub(super) mod band;
pub(super) mod caps;
pub(super) mod common;
pub(super) mod grid;
pub(super) mod ground;
pub(super) mod held;
pub(super) mod inside;
pub(super) mod line;
pub(super) mod lines;
mod near;
pub(super) mod notches;
pub(super) mod order;
pub(super) mod outline;
pub(super) mod parts;
pub(super) mod required;
pub(super) mod shared;
mod tees;
pub(super) mod tight;
pub(super) mod vertex;
