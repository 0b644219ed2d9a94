//! Recognition of files for sewing machines. `cutc sew` reads these; other commands use this to say so.

/// Mark that some programs write before UTF-8 text.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
/// First row of a pattern, and the possible separators of its fields.
const PATTERN: &[u8] = b"x_mm,y_mm,element";
const SEPARATORS: &[u8] = b",;\t";
/// First row of a stitch queue.
const QUEUE: &[u8] = b"op,dx_mm,dy_mm,value";
/// Start of the header of a DST file, and the length of the header.
const DST: &[u8] = b"LA:";
const DST_HEADER_BYTES: usize = 512;

/// True if a text is a pattern: seams as lists of points.
pub fn is_pattern(bytes: &[u8]) -> bool {
    pattern_separator(bytes).is_some()
}

/// Separator of the fields of a pattern; spreadsheets choose it by the language of the computer. `None` if a text is not a
/// pattern.
pub fn pattern_separator(bytes: &[u8]) -> Option<u8> {
    SEPARATORS.iter().copied().find(|&separator| {
        let header: Vec<u8> = PATTERN.iter().map(|&byte| if byte == b',' { separator } else { byte }).collect();
        begins_with(bytes, &header)
    })
}

/// True if a text is a stitch queue.
pub fn is_queue(bytes: &[u8]) -> bool {
    begins_with(bytes, QUEUE)
}

/// True if a file is a stitch file of Tajima machines.
pub fn is_dst(bytes: &[u8]) -> bool {
    bytes.len() >= DST_HEADER_BYTES && bytes.starts_with(DST)
}

/// True if a text begins with a header, ignoring case, blanks and quotes.
fn begins_with(bytes: &[u8], header: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    let mut found = bytes.iter().filter(|&&byte| byte != b' ' && byte != b'"');
    header.iter().all(|known| found.next().is_some_and(|byte| byte.eq_ignore_ascii_case(known)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_is_known_behind_the_mark_that_spreadsheets_write() {
        let texts =
            [("op,x\n", true), ("\u{feff}OP,X", true), ("op, x\r\n", true), ("op", false), ("\u{feff}xop,x", false)];
        for (text, is_known) in texts {
            assert_eq!(begins_with(text.as_bytes(), b"op,x"), is_known, "{text:?}");
        }
    }

    #[test]
    fn patterns_are_known_whatever_parts_their_fields() {
        let check =
            |text: &str, expected: Option<u8>| assert_eq!(pattern_separator(text.as_bytes()), expected, "{text}");
        check("x_mm,y_mm,element\n", Some(b','));
        check("X_mm; Y_mm; element\r\n", Some(b';'));
        check("x_mm\ty_mm\telement\n", Some(b'\t'));
        check("\"x_mm\",\"y_mm\",\"element\"\n", Some(b','));
        check("x_in,y_in,element\n", None);
        check("0,0,straight\n", None);
    }

    #[test]
    fn stitch_files_are_known_by_their_headers() {
        assert!(is_dst(&[b"LA:".as_slice(), &[b' '; 509]].concat()) && !is_dst(b"LA:"));
    }
}
