//! Texts of labels: bytes in the encoding of some CAD system, shown to people. The keys `labels.*`.
//!
//! Only [`Letters`] decodes them, so that reports and pictures show the same text.

use serde::{Deserialize, Serialize};

use super::key::{Key, Takes};
use super::letters::Letters;

/// The keys `labels.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "labels.encoding", takes: Takes::Encoding, about: "Encoding of label texts that are no UTF-8: \"windows-1251\" (Cyrillic), \"latin1\", \"gbk\" (Chinese),\n\"big5\", \"shift_jis\", \"euc-kr\" and more. What is no text in it is shown as \u{fffd}." },
];

/// Texts of labels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Labels {
    /// Name of the encoding that [`Letters::text`] decodes.
    pub encoding: String,
}

impl Default for Labels {
    fn default() -> Self {
        Self { encoding: "utf-8".to_owned() }
    }
}

impl Labels {
    /// Text of the bytes of a label: UTF-8 if valid, else in the profile's encoding, with U+FFFD for bytes invalid in it. One
    /// line of visible characters.
    pub fn text(&self, bytes: &[u8]) -> String {
        self.letters().text(bytes)
    }

    /// Encoding of the texts.
    pub fn letters(&self) -> Letters {
        Letters::named(&self.encoding).unwrap_or(Letters::utf_8())
    }

    /// Encoding if one has been set; `None` for UTF-8, which is read in any case.
    pub fn set(&self) -> Option<Letters> {
        Some(self.letters()).filter(|letters| *letters != Letters::utf_8())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::encoding;

    fn check(encoding: &str, bytes: &[u8], expected: &str) {
        let labels = Labels { encoding: encoding.to_owned() };
        assert_eq!(labels.text(bytes), expected, "{encoding} {}", bytes.escape_ascii());
    }

    #[test]
    fn utf_8_wins_then_the_encoding_of_the_profile_then_what_is_left() {
        check("utf-8", "ПЕРЕД".as_bytes(), "ПЕРЕД");
        check("windows-1251", "ПЕРЕД".as_bytes(), "ПЕРЕД");
        check("windows-1251", b"\xcf\xc5\xd0\xc5\xc4", "ПЕРЕД");
        check("latin1", b"R\xfccken", "Rücken");
        check("utf-8", b"R\xfccken", "R\u{fffd}cken");
        check("gbk", b"A\xff", "A\u{fffd}");
    }

    #[test]
    fn two_bytes_of_gbk_are_not_taken_for_utf_8() {
        check("gbk", b"\xc7\xb0\xc6\xac A", "前片 A");
        check("gbk", "前片 A".as_bytes(), "前片 A");
        check("gbk", b"BK R X1", "BK R X1");
    }

    #[test]
    fn nothing_in_a_text_is_unseen_or_breaks_its_line() {
        check("utf-8", b"A\r\nB\tC\0\x1b[31m\x7f", "A␍␊B␉C␀␛[31m␡");
        check("utf-8", "A\u{202e}B\u{2028}C\u{85}\u{feff}".as_bytes(), r"A\u{202e}B\u{2028}C\u{85}\u{feff}");
        check("utf-8", b"", "");
    }

    #[test]
    fn any_bytes_have_a_text_in_every_encoding() {
        let bytes: Vec<u8> = (0..=255).chain((0..=255).rev()).collect();
        for name in encoding::NAMES {
            let labels = Labels { encoding: name.to_owned() };
            assert!(!labels.text(&bytes).chars().any(char::is_control), "{name}");
        }
    }
}
