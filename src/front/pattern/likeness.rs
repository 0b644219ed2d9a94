//! Distinction of pattern sets from plain drawings.
//!
//! A pattern set has texts with keys of the convention and a line on one of its layers; or blocks with lines on layer 1; or
//! outlines or seam lines outside all blocks while all lines are on layers of the convention. Any other file is a drawing,
//! whose layers are just names.

use std::collections::BTreeSet;

use super::key::key;
use super::layer::{Does, OUTLINE, layer};
use crate::front::{Likeness, foreign};
use crate::machine::letters::Letters;
use crate::source::line_end;

/// Codes of the group that begins an entity, of its text and of its layer.
const BEGINS: &[u8] = b"0";
const TEXT: &[u8] = b"1";
const LAYER: &[u8] = b"8";

/// Kinds of entities that are texts, lines, and chains of lines.
const TEXTS: [&[u8]; 4] = [b"TEXT", b"MTEXT", b"ATTRIB", b"ATTDEF"];
const LINES: [&[u8]; 4] = [b"LINE", b"ARC", b"CIRCLE", b"SPLINE"];
const CHAINS: [&[u8]; 2] = [b"POLYLINE", b"LWPOLYLINE"];

/// Likeness of bytes to a pattern set.
pub(super) fn sniff(bytes: &[u8]) -> Likeness {
    if foreign::is_dxf(bytes) && Signs::of(bytes).are_of_patterns() { Likeness::Sure } else { Likeness::No }
}

/// Evidence for or against a pattern set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Sign {
    /// A text has a key of the convention.
    Key,
    /// A line is on a layer of the convention.
    Line,
    /// A block has a line on the outline layer.
    Block,
    /// A chain of lines on the outline or seam line layer stands outside all blocks.
    Outline,
    /// A line outside all blocks is on a layer that the convention lacks or uses for points.
    Other,
}

/// The evidence in a file.
#[derive(Debug, Default)]
struct Signs(BTreeSet<Sign>);

impl Signs {
    fn of(bytes: &[u8]) -> Self {
        let mut signs = Self::default();
        let (mut kind, mut is_in_block): (&[u8], bool) = (b"", false);
        let mut start = 0;
        let ends = memchr::memchr_iter(line_end(bytes), bytes).chain([bytes.len()]);
        let mut lines = ends.map(|end| bytes[std::mem::replace(&mut start, end + 1)..end].trim_ascii());
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
            if signs.are_sure() {
                break;
            }
        }
        signs
    }

    fn has(&self, sign: Sign) -> bool {
        self.0.contains(&sign)
    }

    fn see_text(&mut self, text: &[u8]) {
        let end = text.iter().position(|&byte| byte == b':').unwrap_or(text.len());
        let is_key = key(&Letters::utf_8().with_codes().text(&text[..end])).is_some();
        self.0.extend(is_key.then_some(Sign::Key));
    }

    fn see_line(&mut self, name: &[u8], is_in_block: bool, is_chain: bool) {
        let number = std::str::from_utf8(name).ok().and_then(|name| name.parse().ok());
        let row = layer(number);
        let is_known = number == Some(row.number);
        let is_outline = is_chain && matches!(row.does, Does::Outline | Does::Seam);
        let is_of_points = matches!(row.does, Does::Turn | Does::Curve);
        self.0.extend(is_known.then_some(Sign::Line));
        self.0.extend((is_in_block && row.number == OUTLINE.number).then_some(Sign::Block));
        self.0.extend((!is_in_block && is_outline).then_some(Sign::Outline));
        self.0.extend((!is_in_block && (!is_known || is_of_points)).then_some(Sign::Other));
    }

    /// True if the rest of the file cannot change the result.
    fn are_sure(&self) -> bool {
        self.has(Sign::Block) || self.has(Sign::Key) && self.has(Sign::Line)
    }

    fn are_of_patterns(&self) -> bool {
        self.are_sure() || self.has(Sign::Outline) && !self.has(Sign::Other)
    }
}
