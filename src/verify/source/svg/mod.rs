//! Second, minimal reading of an SVG drawing by other means than the reader's.
//!
//! [`mod@numbers`] reads numbers and lengths, [`map`] has the transforms, [`rules`] the style sheets, [`page`] the size;
//! [`walk`] traverses the elements, [`outline`] follows shapes and [`path`] path data; [`trace`] passes their lines and curves
//! to the [`pen`], which computes statistics and divides curves into more chords than the reader.

mod map;
mod numbers;
mod outline;
mod page;
mod path;
mod pen;
mod rules;
mod trace;
mod walk;

use encoding_rs::{Encoding, WINDOWS_1252};
use roxmltree::{Document, ParsingOptions};

use self::pen::Pen;
use self::walk::Walk;
use crate::geom::Point;
use crate::machine::MachineProfile;
use crate::verify::source::census::{ARC_SAGITTA, Census, Slack};
use crate::verify::source::drawing::drawn::Drawn;

/// Greatest distance of a chord of the reader from its curve, mm.
const SAGITTA: f64 = 0.02;
/// Bytes in which a file names its encoding.
const HEAD: usize = 200;

/// Statistics of a drawing.
pub(super) fn scan(bytes: &[u8], profile: &MachineProfile) -> (Census, Slack) {
    let pen = followed(bytes, profile, None);
    (pen.census, pen.slack)
}

/// Strokes of a drawing.
pub(super) fn drawn(bytes: &[u8], profile: &MachineProfile) -> Drawn {
    let Pen { strokes, layers, .. } = followed(bytes, profile, Some(Vec::new()));
    Drawn { strokes: strokes.unwrap_or_default(), unit: 0.0, layers }
}

/// Pen after drawing a whole file; unused if the file is not XML.
fn followed(bytes: &[u8], profile: &MachineProfile, strokes: Option<Vec<Vec<Point>>>) -> Pen {
    let sagitta = (profile.tolerance(0.0) * ARC_SAGITTA).min(SAGITTA);
    let mut pen = Pen::new(sagitta, strokes);
    let text = text(bytes);
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    if let Ok(document) = Document::parse_with_options(&text, options)
        && let Some(page) = page::page(&document)
    {
        Walk::new(&document, &mut pen).run(page);
    }
    pen
}

/// Text of a file: UTF-8, UTF-16 by its mark or its zeros, otherwise one byte per letter.
fn text(bytes: &[u8]) -> String {
    let wide = |bytes: &[u8], pair: fn([u8; 2]) -> u16| {
        let (pairs, _) = bytes.as_chunks::<2>();
        let letters = char::decode_utf16(pairs.iter().map(|&bytes| pair(bytes)));
        letters.map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
    };
    match bytes {
        [0xff, 0xfe, rest @ ..] => wide(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => wide(rest, u16::from_be_bytes),
        [b'<', 0, ..] => wide(bytes, u16::from_le_bytes),
        [0, b'<', ..] => wide(bytes, u16::from_be_bytes),
        _ => std::str::from_utf8(bytes).map_or_else(|_| narrow(bytes), str::to_owned),
    }
}

/// Text with one byte per letter, in the encoding named in quotes behind `encoding`.
fn narrow(bytes: &[u8]) -> String {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD)]).into_owned();
    let quoted = head.split_once("encoding").and_then(|(_, rest)| rest.split(['"', '\'']).nth(1));
    let encoding = quoted.and_then(|name| Encoding::for_label(name.as_bytes())).unwrap_or(WINDOWS_1252);
    encoding.decode_without_bom_handling(bytes).0.into_owned()
}
