//! Decoding of the bytes of texts in a file into readable text.

use std::fmt::Write as _;

use encoding_rs::{Encoding, UTF_8};

use super::drafting_codes;
use super::encoding;

/// Encoding of the texts of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Letters {
    encoding: &'static Encoding,
    /// True if `\U+00F6`, `%%d` and similar codes stand for letters, as in DXF.
    has_codes: bool,
}

/// First character with three bytes in UTF-8.
const THREE_BYTES_FROM: char = '\u{800}';

impl Letters {
    /// Encoding by its name in the WHATWG standard; `None` for an unknown name, and for encodings without ASCII.
    pub fn named(name: &str) -> Option<Self> {
        encoding::find(name).map(|encoding| Self { encoding, has_codes: false })
    }

    /// UTF-8 only.
    pub const fn utf_8() -> Self {
        Self { encoding: UTF_8, has_codes: false }
    }

    /// Copy that also decodes the codes for letters in DXF.
    #[must_use]
    pub const fn with_codes(self) -> Self {
        Self { has_codes: true, ..self }
    }

    /// Text of some bytes: UTF-8 if valid, else in the encoding, with U+FFFD for bytes invalid in it. One line of visible
    /// characters.
    pub fn text(&self, bytes: &[u8]) -> String {
        let Self { encoding, has_codes } = self;
        // Two bytes of GBK and similar encodings are often valid UTF-8 too: 前片, the most common label of all, would be shown as
        // ǰƬ. With such an encoding, text in UTF-8 contains ideographs, of three bytes.
        let is_utf_8 =
            |text: &&str| encoding.is_single_byte() || text.is_ascii() || text.chars().any(|c| c >= THREE_BYTES_FROM);
        let text = match std::str::from_utf8(bytes).ok().filter(is_utf_8) {
            Some(text) => text.into(),
            None => encoding.decode_without_bom_handling(bytes).0,
        };
        if *has_codes { visible(&drafting_codes::replaced(&text, encoding)) } else { visible(&text) }
    }

    /// Text of a name that must stay unique: bytes that are not text are escaped.
    pub fn name(&self, bytes: &[u8]) -> String {
        let text = self.text(bytes);
        if text.contains(char::REPLACEMENT_CHARACTER) { bytes.escape_ascii().to_string() } else { text }
    }
}

/// Code points of the Unicode pictures for control characters from 0 on, and for the last one, 127.
const CONTROL_PICTURES: u32 = 0x2400;
const DELETE_PICTURE: char = '\u{2421}';

/// Text with pictures for control characters. Other characters that would break the line or change the order of the text around
/// them are escaped by number.
fn visible(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\0'..='\u{1f}' => shown.extend(char::from_u32(CONTROL_PICTURES + c as u32)),
            '\u{7f}' => shown.push(DELETE_PICTURE),
            // Line and paragraph separators, direction marks, byte-order marks, and characters that are invalid in XML.
            '\u{80}'..='\u{9f}'
            | '\u{61c}'
            | '\u{200b}'..='\u{200f}'
            | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{feff}'
            | '\u{fffe}'
            | '\u{ffff}' => {
                // Writing into a `String` cannot fail.
                let _ = write!(shown, "{}", c.escape_unicode());
            }
            c => shown.push(c),
        }
    }
    shown
}
