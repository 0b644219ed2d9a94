//! Text encodings by name.

use encoding_rs::Encoding;

/// Names suggested for an unknown one: the encodings of CAD systems by their WHATWG names, and common aliases. All names of the
/// standard are understood.
pub(super) const NAMES: [&str; 46] = [
    "utf-8",
    "ascii",
    "latin1",
    "cp1250",
    "cp1251",
    "cp1252",
    "cp1253",
    "cp1254",
    "cp1255",
    "cp1256",
    "cp1257",
    "cp1258",
    "cp866",
    "windows-874",
    "windows-1250",
    "windows-1251",
    "windows-1252",
    "windows-1253",
    "windows-1254",
    "windows-1255",
    "windows-1256",
    "windows-1257",
    "windows-1258",
    "iso-8859-1",
    "iso-8859-2",
    "iso-8859-3",
    "iso-8859-4",
    "iso-8859-5",
    "iso-8859-6",
    "iso-8859-7",
    "iso-8859-8",
    "iso-8859-9",
    "iso-8859-13",
    "iso-8859-15",
    "ibm866",
    "koi8-r",
    "koi8-u",
    "macintosh",
    "x-mac-cyrillic",
    "gbk",
    "gb2312",
    "gb18030",
    "big5",
    "shift_jis",
    "euc-jp",
    "euc-kr",
];

/// Number of similar names in a message.
const OFFERED: usize = 3;

/// Encoding of that name. Returns `None` for encodings in which the bytes of letters, digits and asterisks may mean something
/// else, above all UTF-16: the codes of cut files are ASCII.
pub(super) fn find(name: &str) -> Option<&'static Encoding> {
    Encoding::for_label_no_replacement(name.as_bytes()).filter(|encoding| encoding.is_ascii_compatible())
}

/// Names of the table most similar to an unknown one, the nearest first.
pub(super) fn nearest(name: &str) -> Vec<&'static str> {
    let name = name.to_lowercase();
    let mut names = NAMES;
    let likeness = |other: &str| strsim::jaro_winkler(&name, other);
    // The stable sort keeps equally similar names in the order of the table.
    names.sort_by(|a, b| likeness(b).total_cmp(&likeness(a)));
    names[..OFFERED].to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_that_is_offered_is_known() {
        for name in NAMES {
            assert!(find(name).is_some(), "{name}");
        }
    }

    #[test]
    fn an_unknown_name_has_near_ones() {
        assert_eq!(nearest("windows1251")[0], "windows-1251");
        assert_eq!(nearest("CP-1251")[0], "cp1251");
        assert_eq!(nearest("latin-1")[0], "latin1");
        assert_eq!(nearest("gbk2")[0], "gbk");
        assert!(find("utf-16").is_none() && find("iso-2022-jp").is_none() && find("replacement").is_none());
    }
}
