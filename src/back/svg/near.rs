//! Near lines: stretches where cuts of two parts run side by side with a thin strip between them.

use std::fmt::Write;

use super::markup::PathData;
use crate::back::target::Context;
use crate::ir::marker::NearEdge;
use crate::units::MM_PER_M;
use crate::units::number::fixed;

/// Style class of these lines.
pub(super) const NEAR: &str = "near";

/// Text of the legend; `None` where there are none.
pub(super) fn meaning(context: &Context) -> Option<String> {
    let length = fixed(context.marker.near_length() / MM_PER_M, 1);
    (!context.marker.near.is_empty()).then(|| format!("near line, both cut: {length} m"))
}

/// The layer of near lines: one path per group of consecutive stretches of a piece.
pub(super) fn layer(context: &Context) -> String {
    let marker = context.marker;
    if marker.near.is_empty() {
        return String::new();
    }
    let name = "inkscape:groupmode=\"layer\" inkscape:label=\"near lines\"";
    let mut text = format!("<g id=\"near\" {name} transform=\"scale(1,-1)\">\n");
    for edges in marker.near.chunk_by(|a, b| a.piece == b.piece) {
        let mut data = PathData::default();
        for NearEdge { ends, .. } in edges {
            data.line(*ends);
        }
        let piece = marker.pieces[edges[0].piece as usize].name();
        let title = format!("near lines of piece {piece}: a cut of another part runs beside them");
        let _infallible = write!(text, "{}", data.titled(NEAR, &title));
    }
    text.push_str("</g>\n");
    text
}
