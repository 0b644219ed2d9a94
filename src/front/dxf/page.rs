//! Code pages of texts, by their names in the header.

use crate::machine::letters::Letters;

/// Prefix of a numbered code page in the header.
const NUMBERED: &[u8] = b"ANSI_";
/// Numbers of code pages without a `windows-` encoding, and the names of their encodings.
const PAGES: [(&str, &str); 4] = [("932", "shift_jis"), ("936", "gbk"), ("949", "euc-kr"), ("950", "big5")];

/// The encoding of a code page, by its name in the header.
pub(in crate::front) fn page(name: &[u8]) -> Option<Letters> {
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
