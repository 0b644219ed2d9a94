//! Edges that are cut once for two parts, each with the piece that is cut and the piece that is spared.

use std::fmt::Write;

use super::markup::PathData;
use crate::back::target::Context;
use crate::units::MM_PER_M;
use crate::units::number::fixed;

/// Style class of these edges.
pub(super) const COMMON: &str = "common";

/// Text of the legend; `None` where there are none.
pub(super) fn meaning(context: &Context) -> Option<String> {
    let (edges, length) = (context.marker.common.len(), context.marker.common_length());
    (edges > 0).then(|| format!("common edges: {edges}, {} m", fixed(length / MM_PER_M, 1)))
}

/// The layer of common edges.
pub(super) fn layer(context: &Context) -> String {
    let marker = context.marker;
    if marker.common.is_empty() {
        return String::new();
    }
    let name = "inkscape:groupmode=\"layer\" inkscape:label=\"common edges\"";
    let mut text = format!("<g id=\"common\" {name} transform=\"scale(1,-1)\">\n");
    for edge in &marker.common {
        let [cut, spared] = edge.pieces.map(|piece| marker.pieces[piece as usize].name());
        let mut data = PathData::default();
        data.line(marker.list.points(edge.range).iter().copied());
        let shift = fixed(edge.shift, 2);
        let title = format!("cut with piece {cut}, spared piece {spared}, whose edge is {shift} mm off");
        let _infallible = write!(text, "{}", data.titled(COMMON, &title));
    }
    text.push_str("</g>\n");
    text
}
