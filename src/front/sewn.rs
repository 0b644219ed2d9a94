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
/// Number of records of a stitch file that are looked at.
const RECORDS_SNIFFED: usize = 100;
/// Length of the header of a JEF file before its tables.
const JEF_HEADER_BYTES: u64 = 0x74;

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
    bytes.len() >= DST_HEADER_BYTES && bytes.starts_with(DST) && !is_dsb(bytes)
}

/// True if a file is a DSB file of Barudan machines: the header of DST, then records that begin with a command.
pub fn is_dsb(bytes: &[u8]) -> bool {
    let Some(body) = bytes.get(DST_HEADER_BYTES..).filter(|_| bytes.starts_with(DST)) else { return false };
    let (records, _) = body.as_chunks::<3>();
    // The first byte has its highest bit set; the last is a way, where DST has its two lowest bits set.
    let is_command = |record: &[u8; 3]| record[0] & 0x80 != 0 && matches!(record[0] & 0x1f, 0 | 1 | 7..=0x18);
    !records.is_empty()
        && records.iter().take(RECORDS_SNIFFED).all(is_command)
        && records.iter().take(RECORDS_SNIFFED).any(|record| record[2] & 3 != 3)
}

/// True if a file is a PES file of Brother machines.
pub fn is_pes(bytes: &[u8]) -> bool {
    bytes.starts_with(b"#PES")
}

/// True if a file is a PEC file of Brother machines.
pub fn is_pec(bytes: &[u8]) -> bool {
    bytes.starts_with(b"#PEC")
}

/// True if a file is a VP3 file of Husqvarna and Pfaff machines.
pub fn is_vp3(bytes: &[u8]) -> bool {
    bytes.starts_with(b"%vsm%")
}

/// True if a file is a JEF file of Janome machines: its stitches begin behind two tables with a row a thread.
pub fn is_jef(bytes: &[u8]) -> bool {
    let number = |at: usize| bytes.get(at..at + 4).map(|four| u32::from_le_bytes([four[0], four[1], four[2], four[3]]));
    let (Some(start), Some(0x14), Some(threads @ 1..)) = (number(0), number(4), number(24)) else { return false };
    u64::from(start) == JEF_HEADER_BYTES + 8 * u64::from(threads)
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
        let dst = |records: &[u8]| [b"LA:".as_slice(), &[b' '; 509], records].concat();
        assert!(is_dst(&dst(&[0x80, 0, 0x03])) && !is_dsb(&dst(&[0x80, 0, 0x03])));
        assert!(is_dsb(&dst(&[0x80, 5, 4, 0xf8, 0, 0])) && !is_dst(&dst(&[0x80, 5, 4, 0xf8, 0, 0])));
        let jef = [&[0x7c, 0, 0, 0, 0x14, 0, 0, 0][..], &[b'0'; 16], &[1, 0, 0, 0]].concat();
        assert!(is_jef(&jef) && !is_jef(&jef[..27]) && !is_jef(b"SP1;PU;"));
        assert!(is_dst(&[b"LA:".as_slice(), &[b' '; 509]].concat()) && !is_dst(b"LA:"));
    }
}
