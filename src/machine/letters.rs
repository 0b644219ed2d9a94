//! Letters: how the bytes of the texts of one file become text that people can read.

use std::fmt::Write as _;

use encoding_rs::{Encoding, UTF_8};

use super::drafting_codes;
use super::encoding;

/// The encoding of the texts of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Letters {
    encoding: &'static Encoding,
    /// Whether `\U+00F6`, `%%d` and their like stand for letters, as in DXF.
    has_codes: bool,
}

/// From here on UTF-8 has three bytes a character.
const THREE_BYTES_FROM: char = '\u{800}';

impl Letters {
    /// Encoding by its name in the WHATWG standard; `None` for an unknown name, and for encodings without ASCII.
    pub fn named(name: &str) -> Option<Self> {
        encoding::find(name).map(|encoding| Self { encoding, has_codes: false })
    }

    /// UTF-8 and nothing else.
    pub const fn utf_8() -> Self {
        Self { encoding: UTF_8, has_codes: false }
    }

    /// The same encoding, with the codes for letters that DXF has.
    #[must_use]
    pub const fn with_codes(self) -> Self {
        Self { has_codes: true, ..self }
    }

    /// The text that some bytes stand for: UTF-8 when they are that, else what the encoding makes of them, with U+FFFD for
    /// what is no text in it. One line, in which everything can be seen.
    pub fn text(&self, bytes: &[u8]) -> String {
        let Self { encoding, has_codes } = self;
        // Two bytes of GBK and its like are often two bytes of UTF-8 as well: 前片, the most common label of all, would be
        // shown as ǰƬ. What is UTF-8 where such an encoding is in use has ideographs, of three bytes.
        let is_utf_8 =
            |text: &&str| encoding.is_single_byte() || text.is_ascii() || text.chars().any(|c| c >= THREE_BYTES_FROM);
        let text = match std::str::from_utf8(bytes).ok().filter(is_utf_8) {
            Some(text) => text.into(),
            None => encoding.decode_without_bom_handling(bytes).0,
        };
        if *has_codes { visible(&drafting_codes::replaced(&text, encoding)) } else { visible(&text) }
    }

    /// The text of a name, which tells things apart: bytes that are no text stay what they are.
    pub fn name(&self, bytes: &[u8]) -> String {
        let text = self.text(bytes);
        if text.contains(char::REPLACEMENT_CHARACTER) { bytes.escape_ascii().to_string() } else { text }
    }
}

/// Where Unicode has its pictures of the control characters from 0 on, and that of the last one, 127.
const CONTROL_PICTURES: u32 = 0x2400;
const DELETE_PICTURE: char = '\u{2421}';

/// The text with pictures for control characters; others that would break the line, or turn the order of what is shown
/// around them, by their number.
fn visible(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\0'..='\u{1f}' => shown.extend(char::from_u32(CONTROL_PICTURES + c as u32)),
            '\u{7f}' => shown.push(DELETE_PICTURE),
            // Line and paragraph separators, marks of direction, byte-order marks, and what XML does not take at all.
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
