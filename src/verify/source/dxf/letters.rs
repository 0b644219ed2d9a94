//! Second decoding of texts: the encoding is the one in which the most texts are meaningful.

use encoding_rs::{
    BIG5, EUC_KR, Encoding, GBK, IBM866, ISO_8859_2, KOI8_U, MACINTOSH, SHIFT_JIS, UTF_8, WINDOWS_1250, WINDOWS_1251,
    WINDOWS_1252, WINDOWS_1254, X_MAC_CYRILLIC,
};

use crate::machine::labels::Labels;

/// Encoding of texts that are not UTF-8.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Letters(&'static Encoding);

/// Encodings of CAD systems, the usual ones first.
const PAGES: [&Encoding; 13] = [
    GBK,
    WINDOWS_1252,
    MACINTOSH,
    WINDOWS_1250,
    WINDOWS_1251,
    WINDOWS_1254,
    ISO_8859_2,
    IBM866,
    KOI8_U,
    X_MAC_CYRILLIC,
    BIG5,
    SHIFT_JIS,
    EUC_KR,
];

impl Letters {
    /// Encoding in which `said` finds the most. The encoding of the profile or of the header's code page is kept unless another
    /// finds more; among several others with the same number, all must find the same.
    pub(super) fn of<T: PartialEq>(header: &[u8], labels: &Labels, said: impl Fn(Self) -> Vec<T>) -> Self {
        let own = Encoding::for_label(labels.encoding.as_bytes()).filter(|own| *own != UTF_8);
        let first = Self(own.or_else(|| page(header)).unwrap_or(UTF_8));
        let all: Vec<(Self, Vec<T>)> = PAGES.iter().map(|page| (Self(page), said(Self(page)))).collect();
        let most = all.iter().map(|(_, said)| said.len()).max().unwrap_or_default();
        if most <= said(first).len() {
            return first;
        }
        let mut best = all.into_iter().filter(|(_, said)| said.len() == most);
        let (letters, said) = best.next().unwrap_or((first, Vec::new()));
        if best.all(|(_, other)| other == said) { letters } else { first }
    }

    /// Decodes a text.
    pub(super) fn read(self, bytes: &[u8]) -> String {
        let Self(page) = self;
        let utf_8 = String::from_utf8(bytes.to_vec()).ok();
        // A text of byte pairs only may be UTF-8 or a double-byte encoding; prefer the latter in such a code page.
        let is_pairs = |text: &String| !text.is_ascii() && text.chars().all(|c| c.len_utf8() < 3);
        let is_of_pairs = !page.is_single_byte() && page != UTF_8;
        let text = utf_8.filter(|text| !(is_of_pairs && is_pairs(text)));
        plain(&text.unwrap_or_else(|| page.decode_without_bom_handling(bytes).0.into_owned()), page)
    }
}

/// Encoding of a Windows code page, by the number at the end of its name, or of an encoding's name.
fn page(name: &[u8]) -> Option<&'static Encoding> {
    let digits = name.iter().rev().take_while(|byte| byte.is_ascii_digit()).count();
    let (name, number) = name.split_at(name.len() - digits);
    if !name.eq_ignore_ascii_case(b"ANSI_") {
        let whole = [name, number].concat();
        return Encoding::for_label_no_replacement(&whole).filter(|page| page.is_ascii_compatible());
    }
    match number {
        b"936" => Some(GBK),
        b"950" => Some(BIG5),
        b"932" => Some(SHIFT_JIS),
        b"949" => Some(EUC_KR),
        number => {
            Encoding::for_label(&[b"cp", number].concat()).or(Encoding::for_label(&[b"windows-", number].concat()))
        }
    }
}

/// Text with its codes replaced: each denotes a letter by its number, or a sign.
fn plain(text: &str, page: &'static Encoding) -> String {
    let mut parts = Vec::new();
    let mut letters = text.chars();
    while let Some(letter) = letters.next() {
        let rest = letters.as_str();
        let hex = |from: usize| rest.get(from..from + 4).and_then(|hex| u16::from_str_radix(hex, 16).ok());
        let (part, skipped) = match (letter, rest.as_bytes()) {
            ('\\', [b'U' | b'u', b'+', ..]) => (hex(2).and_then(|code| String::from_utf16(&[code]).ok()), 6),
            ('\\', [b'M', b'+', of, ..]) => {
                let page = [(b'1', SHIFT_JIS), (b'2', BIG5), (b'3', EUC_KR), (b'5', GBK)];
                let page = page.iter().find(|(number, _)| number == of).map(|(_, page)| *page);
                (page.zip(hex(3)).and_then(|(page, pair)| exactly(page, &pair.to_be_bytes())), 7)
            }
            ('%', [b'%', b'u' | b'U' | b'o' | b'O' | b'k' | b'K', ..]) => (Some(String::new()), 2),
            ('%', [b'%', b'd' | b'D', ..]) => (Some("°".to_owned()), 2),
            ('%', [b'%', b'p' | b'P', ..]) => (Some("±".to_owned()), 2),
            ('%', [b'%', b'c' | b'C', ..]) => (Some("Ø".to_owned()), 2),
            ('%', [b'%', b'%', ..]) => (Some("%".to_owned()), 2),
            ('%', [b'%', digits @ ..]) => {
                let digits = digits.get(..3).and_then(|digits| std::str::from_utf8(digits).ok());
                (digits.and_then(|digits| digits.parse().ok()).and_then(|byte: u8| exactly(page, &[byte])), 4)
            }
            _ => (None, 0),
        };
        if part.is_some() {
            letters = rest[skipped..].chars();
        }
        parts.push(part.unwrap_or_else(|| letter.to_string()));
    }
    parts.concat()
}

fn exactly(page: &'static Encoding, bytes: &[u8]) -> Option<String> {
    page.decode_without_bom_handling_and_without_replacement(bytes).map(Into::into)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(header: &str, bytes: &[u8], expected: &str) {
        let letters = Letters::of(header.as_bytes(), &Labels::default(), |_| Vec::<()>::new());
        assert_eq!(letters.read(bytes), expected, "{header} {}", bytes.escape_ascii());
    }

    #[test]
    fn texts_are_read_by_the_code_page_of_the_header() {
        check("ANSI_936", b"\xb3\xdf\xc2\xeb", "尺码");
        check("ANSI_936", "尺码".as_bytes(), "尺码");
        check("ansi_1251", b"\xcf\xc5\xd0\xc5\xc4", "ПЕРЕД");
        check("ANSI_874", b"\xcb\xb9\xe9\xd2", "หน้า");
        check("ANSI_932", b"\x91\x4f", "前");
        check("iso8859-1", b"R\xfccken", "Rücken");
        check("ANSI_7", b"R\xfccken", "R\u{fffd}cken");
    }

    #[test]
    fn codes_stand_for_letters() {
        check("", br"Gr\U+00F6\U+00DFe \M+5B3DF\M+5C2EB", "Größe 尺码");
        check("ANSI_1252", b"%%uSIZE%%U 5%%d %%246 %%%", "SIZE 5° ö %");
        check("", br"\U+D800 \U+1 %%999 100% \", r"\U+D800 \U+1 %%999 100% \");
    }

    #[test]
    fn the_encoding_in_which_the_most_is_said_is_that_of_the_file() {
        let said = |letters: Letters| {
            Some("尺码").into_iter().filter(|size| letters.read(b"\xb3\xdf\xc2\xeb") == *size).collect::<Vec<_>>()
        };
        let of = |encoding: &str, header: &[u8]| Letters::of(header, &Labels { encoding: encoding.to_owned() }, said);
        assert_eq!([of("utf-8", b""), of("utf-8", b"ANSI_1252"), of("cp1251", b"")], [Letters(GBK); 3]);
        let unsaid =
            |encoding: &str| Letters::of(b"ANSI_1252", &Labels { encoding: encoding.to_owned() }, |_| Vec::<()>::new());
        assert_eq!([unsaid("utf-8").0.name(), unsaid("cp1251").0.name()], ["windows-1252", "windows-1251"]);
    }
}
