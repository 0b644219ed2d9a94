//! The text form of marker and toolpath: one line a segment, prints and reads.
use super::{Marker, Toolpath};
/// x
pub fn print_marker(_: &Marker) -> String {
    String::new()
}
/// x
pub fn print_toolpath(_: &Toolpath) -> String {
    String::new()
}
