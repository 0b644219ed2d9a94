//! Encoding of the texts of a file.

use super::key::Key;
use super::text::{has_unread_key, is_text, keys};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::dxf::entity::{Entity, NAME, Sections, TEXT};
use crate::front::dxf::page::page;
use crate::machine::labels::Labels;
use crate::machine::letters::Letters;
use crate::source::{Source, Span};

/// Encodings that can write non-ASCII keys, in addition to UTF-8. Of encodings that read the same keys, the first is used.
const OF_KEYS: [&str; 13] = [
    "gbk",
    "windows-1252",
    "macintosh",
    "windows-1250",
    "windows-1251",
    "windows-1254",
    "iso-8859-2",
    "ibm866",
    "koi8-u",
    "x-mac-cyrillic",
    "big5",
    "shift_jis",
    "euc-kr",
];

/// The encoding of the texts of a file, and its origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lettered {
    pub(super) letters: Letters,
    /// Name of the encoding if it was found by its keys: more keys are readable in it than in the one of the profile or header.
    found: Option<&'static str>,
    /// Number of texts whose keys have undecodable bytes, and the location of the first.
    unread: (usize, Option<Span>),
}

/// Indices of non-ASCII texts, each with a key readable in an encoding.
type Readings = Vec<(usize, Key)>;

/// The encoding set by the profile, otherwise that of the header's code page. Many programs write a fixed code page, so another
/// encoding is used if it makes more keys readable.
pub(super) fn letters(sections: &Sections, source: &Source, labels: &Labels) -> Lettered {
    let of_header = || sections.page.and_then(|span| page(source.slice(span)));
    let first = labels.set().or_else(of_header).unwrap_or(Letters::utf_8()).with_codes();
    let texts = sections.blocks.iter().flat_map(|block| &block.entities).chain(&sections.entities);
    let foreign: Vec<&Entity> = texts.filter(|text| is_foreign(text)).collect();
    let readings = |letters: &Letters| -> Readings {
        let all = foreign.iter().enumerate();
        all.flat_map(|(place, text)| keys(text, source, letters).into_iter().map(move |key| (place, key))).collect()
    };
    let (mut best, mut found, mut is_doubtful) = (readings(&first), None, false);
    let others = OF_KEYS.iter().filter_map(|name| Some((*name, Letters::named(name)?.with_codes())));
    for other in if foreign.is_empty() { Vec::new() } else { others.collect() } {
        let read = readings(&other.1);
        if read.len() > best.len() {
            (best, found, is_doubtful) = (read, Some(other), false);
        } else if found.is_some() && read.len() == best.len() {
            is_doubtful |= read != best;
        }
    }
    let found = found.filter(|_| !is_doubtful);
    let letters = found.map_or(first, |(_, letters)| letters);
    let is_unread = |text: &&&Entity| has_unread_key(text, &letters);
    let unread: Vec<&&Entity> = foreign.iter().filter(is_unread).collect();
    let unread = (unread.len(), unread.first().and_then(|text| text.value(TEXT)));
    Lettered { letters, found: found.map(|(name, _)| name), unread }
}

/// True if an entity is a text with non-ASCII bytes.
fn is_foreign(entity: &Entity) -> bool {
    is_text(entity) && !(entity.bytes(TEXT).is_ascii() && entity.bytes(NAME).is_ascii())
}

impl Lettered {
    /// Reports an encoding that was found by its keys, and unreadable keys.
    pub(super) fn say(&self, out: &mut Diagnostics) {
        let say = "another encoding can be said: `--set labels.encoding=windows-1251`, `gbk`, `big5` ...";
        if let Some(name) = self.found {
            let message = format!("texts are read as {name}: their keys are found in it");
            out.push(Diagnostic::new(&code::DXF_LETTERS, message).hint(say));
        }
        if let (count, Some(first)) = self.unread {
            let texts =
                if count == 1 { "the key of a text has".to_owned() } else { format!("keys of {count} texts have") };
            let message = format!("{texts} unreadable bytes: a size or a quantity may be lost");
            out.push(Diagnostic::new(&code::DXF_LETTERS_LOST, message).at(first).hint(say));
        }
    }
}
