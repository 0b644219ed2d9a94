//! Letters: in which encoding the texts of a file are written.

use super::entity::Sections;
use super::text::names;
use crate::machine::labels::Labels;
use crate::machine::letters::Letters;
use crate::source::Source;

/// Prefix of a numbered code page in the header.
const NUMBERED: &[u8] = b"ANSI_";
/// Numbers of code pages that are no `windows-` encoding, each with the name of its encoding.
const PAGES: [(&str, &str); 4] = [("932", "shift_jis"), ("936", "gbk"), ("949", "euc-kr"), ("950", "big5")];
/// Encodings in which a key that is not ASCII can be written, beside UTF-8.
const OF_KEYS: [&str; 3] = ["gbk", "windows-1252", "macintosh"];

/// The encoding that somebody has set, else that of the header's code page. Many programs write a code page whatever they do, so
/// where no key can be read in it and one can in another encoding, it is that.
pub(super) fn letters(sections: &Sections, source: &Source, labels: &Labels) -> Letters {
    let of_header = || sections.page.and_then(|span| page(source.slice(span)));
    let first = labels.set().or_else(of_header).unwrap_or(Letters::utf_8()).with_codes();
    let others = OF_KEYS.iter().filter_map(|name| Letters::named(name)).map(Letters::with_codes);
    let texts = || sections.blocks.iter().flat_map(|block| &block.entities).chain(&sections.entities);
    let is_read_in = |letters: &Letters| texts().any(|text| names(text, source, letters).any(|name| !name.is_ascii()));
    [first].into_iter().chain(others).find(is_read_in).unwrap_or(first)
}

/// The encoding of a code page by its name in the header.
fn page(name: &[u8]) -> Option<Letters> {
    let name = std::str::from_utf8(name).ok()?;
    let number = name.get(..NUMBERED.len()).filter(|start| start.as_bytes().eq_ignore_ascii_case(NUMBERED));
    let Some(number) = number.map(|start| &name[start.len()..]) else { return Letters::named(name) };
    let named = PAGES.iter().find(|(known, _)| *known == number).map(|(_, name)| Letters::named(name));
    named.unwrap_or_else(|| Letters::named(&format!("windows-{number}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_pages_are_known_by_their_numbers_or_names() {
        let check = |name: &str, bytes: &[u8], expected: &str| {
            assert_eq!(page(name.as_bytes()).map(|page| page.text(bytes)).as_deref(), Some(expected), "{name}");
        };
        check("ANSI_936", b"\xb3\xdf\xc2\xeb", "尺码");
        check("ansi_1252", b"Gr\xf6\xdfe", "Größe");
        check("ANSI_1251", b"\xcf\xc5\xd0\xc5\xc4", "ПЕРЕД");
        check("ANSI_1250", b"P\xf8edn\xed", "Přední");
        check("ANSI_932", b"\x91\x4f", "前");
        check("ANSI_949", b"\xbe\xd5", "앞");
        check("ANSI_950", b"\xab\x65", "前");
        check("ANSI_874", b"\xcb\xb9\xe9\xd2", "หน้า");
        check("iso8859-1", b"R\xfccken", "Rücken");
        assert_eq!([page(b"ANSI_"), page(b"dos850"), page(b"\xff"), page(b"")], [None; 4]);
    }
}
