//! Table of the lines of a plot by class.

use std::fmt::Write as _;

use crate::pipeline::Report;
use crate::units::number::fixed;

/// Maximum number of layers in the table.
const SHOWN_LAYERS: usize = 40;

/// The table with one row per class, and the length drawn with the pen down; empty for files that state themselves what is cut.
pub(super) fn text(report: &Report) -> String {
    let Some(drawn) = &report.drawn else { return String::new() };
    let mut out = String::from("\n  lines taken for   count      length mm\n");
    // Writing into a `String` cannot fail, so the results of `writeln!` are dropped throughout.
    for lines in &drawn.lines {
        let what = if lines.cut { "" } else { "  not cut" };
        let _ = writeln!(out, "  {:14} {:>8} {:>14}{what}", lines.class, lines.count, fixed(lines.length_mm, 3));
    }
    let _ = writeln!(out, "  {:14} {:>8} {:>14}", "pen down", "", fixed(drawn.pen_down_mm, 3));
    if drawn.texts_outside > 0 {
        let _ = writeln!(out, "  {:14} {:>8}", "texts beside", drawn.texts_outside);
    }
    if !drawn.layers.is_empty() {
        out += "\n  layer             count      length mm\n";
    }
    for layer in drawn.layers.iter().take(SHOWN_LAYERS) {
        let (name, count, length) = (&layer.name, layer.count, fixed(layer.length_mm, 3));
        let _ = writeln!(out, "  {name:14} {count:>8} {length:>14}  {}", layer.used);
    }
    if drawn.layers.len() > SHOWN_LAYERS {
        let _ = writeln!(out, "  and {} more: `--format json` has all", drawn.layers.len() - SHOWN_LAYERS);
    }
    out
}
