//! Likeness: what tells a set of patterns from a plain drawing.
//!
//! Patterns have texts with keys of the convention and a line on one of its layers, or blocks with lines on layer 1, or outlines
//! or seam lines outside all blocks where all lines are on layers of the convention. Anything else is a drawing, whose layers are
//! names.

use super::key::key;
use super::layer::{Does, OUTLINE, layer};
use crate::front::{Likeness, foreign};
use crate::machine::letters::Letters;

/// Codes that begin an entity, and of its text, its name and its layer.
const BEGINS: &[u8] = b"0";
const TEXT: &[u8] = b"1";
const LAYER: &[u8] = b"8";

/// Kinds of entities that are texts, that are lines, and that are chains of lines.
const TEXTS: [&[u8]; 4] = [b"TEXT", b"MTEXT", b"ATTRIB", b"ATTDEF"];
const LINES: [&[u8]; 4] = [b"LINE", b"ARC", b"CIRCLE", b"SPLINE"];
const CHAINS: [&[u8]; 2] = [b"POLYLINE", b"LWPOLYLINE"];

/// How much some bytes look like a set of patterns.
pub(super) fn sniff(bytes: &[u8]) -> Likeness {
    if foreign::is_dxf(bytes) && Signs::of(bytes).are_of_patterns() { Likeness::Sure } else { Likeness::No }
}

/// Signs of the convention in a file.
#[derive(Debug, Default)]
struct Signs {
    /// Whether a text has a key of it.
    has_key: bool,
    /// Whether a line is on a layer of it.
    has_line: bool,
    /// Whether a block has a line on the layer of outlines.
    has_block: bool,
    /// Whether a chain of lines stands there in no block, or on that of seam lines.
    has_outline: bool,
    /// Whether a line in no block is on a layer that the convention does not have, or has for points.
    has_other: bool,
}

impl Signs {
    fn of(bytes: &[u8]) -> Self {
        let mut signs = Self::default();
        let (mut kind, mut is_in_block): (&[u8], bool) = (b"", false);
        let mut lines = bytes.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii);
        while let (Some(code), Some(value)) = (lines.next(), lines.next()) {
            match code {
                BEGINS => {
                    kind = value;
                    is_in_block = (is_in_block || kind == b"BLOCK") && kind != b"ENDBLK";
                }
                TEXT if TEXTS.contains(&kind) => signs.see_text(value),
                LAYER if CHAINS.contains(&kind) => signs.see_line(value, is_in_block, true),
                LAYER if LINES.contains(&kind) => signs.see_line(value, is_in_block, false),
                _ => {}
            }
            if signs.has_block || signs.has_key && signs.has_line {
                break;
            }
        }
        signs
    }

    fn see_text(&mut self, text: &[u8]) {
        let end = text.iter().position(|&byte| byte == b':').unwrap_or(text.len());
        self.has_key |= key(&Letters::utf_8().with_codes().text(&text[..end])).is_some();
    }

    fn see_line(&mut self, name: &[u8], is_in_block: bool, is_chain: bool) {
        let number = std::str::from_utf8(name).ok().and_then(|name| name.parse().ok());
        let row = layer(number);
        let is_outline = row.number == OUTLINE.number;
        let is_known = number == Some(row.number);
        self.has_line |= is_known;
        self.has_block |= is_in_block && is_outline;
        if !is_in_block {
            self.has_outline |= is_chain && matches!(row.does, Does::Outline | Does::Seam);
            self.has_other |= !is_known || matches!(row.does, Does::Turn | Does::Curve);
        }
    }

    fn are_of_patterns(&self) -> bool {
        self.has_block || self.has_key && self.has_line || self.has_outline && !self.has_other
    }
}
