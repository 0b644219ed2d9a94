//! Table of the windows of a conveyor.

use std::fmt::Write as _;

use super::options::counted;
use crate::pipeline::Bite;
use crate::units::number::fixed;

/// The table with one row per window.
pub(super) fn table(bites: &[Bite]) -> String {
    // Writing into a `String` cannot fail, so the results of `writeln!` are dropped throughout.
    let mut out = String::new();
    let is_timed = bites.iter().any(|bite| bite.time_s.is_some());
    let _ = writeln!(out, "\n  bite    at mm  pieces    cut m{}", if is_timed { "   time s" } else { "" });
    for (bite, number) in bites.iter().zip(1..) {
        let _ = write!(out, "  {number:4} {:>8}  {:>6} {:>8}", bite.advance_mm, bite.pieces, fixed(bite.cut_m, 3));
        if let Some(time) = bite.time_s {
            let _ = write!(out, " {:>8}", fixed(time, 2));
        }
        out.push('\n');
    }
    out
}

/// The windows in one line; `None` if there are none.
pub(super) fn line(bites: &[Bite]) -> Option<String> {
    let [first, last] = [bites.first()?, bites.last()?];
    let windows = counted(bites.len(), "window");
    let way = last.advance_mm - first.advance_mm;
    let ways = if way > 0 { format!(", {way} mm from the first to the last") } else { String::new() };
    Some(format!("{windows} of a conveyor{ways}"))
}
