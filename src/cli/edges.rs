//! Table of a head at a distance: one row per edge that it follows.

use std::fmt::Write as _;

use crate::pipeline::{Edge, Piece};
use crate::units::number::fixed;

/// Condition number from which the exponential form is used.
const POWERS_FROM: f64 = 1e5;

/// The table with one row per edge, and the figures of its polynomials if there are any.
pub(super) fn table(edges: &[Edge]) -> String {
    let fits = edges.iter().any(|edge| !edge.pieces.is_empty());
    // Writing into a `String` cannot fail, so the results of `writeln!` are dropped throughout.
    let mut out = String::new();
    let more = if fits { "   pieces   condition" } else { "" };
    let _ = writeln!(out, "\n  edge      length      time   deviation   speed, mm/s, least to most{more}");
    for (number, edge) in (1..).zip(edges) {
        let [least, mean, most] = edge.speed_mm_s.map(|speed| fixed(speed, 1));
        let speeds = format!("{least} to {most}, mean {mean}");
        let _ = write!(
            out,
            "  {number:4} {:>8} mm {:>7} s {:>8} mm   {speeds:27}",
            fixed(edge.length_mm, 1),
            fixed(edge.time_s, 3),
            fixed(edge.deviation_mm, 3),
        );
        if fits {
            let _ = write!(out, " {:>8} {:>11}", edge.pieces.len(), condition(&edge.pieces));
        }
        let kept = out.trim_end().len();
        out.truncate(kept);
        out.push('\n');
    }
    out
}

/// The largest condition number of some polynomials, formatted.
fn condition(pieces: &[Piece]) -> String {
    let worst = pieces.iter().map(|piece| piece.condition).fold(0.0, f64::max);
    if worst >= POWERS_FROM { format!("{worst:.1e}") } else { fixed(worst, 1) }
}
