//! Recognises what cutc does not read, so that the message can say what a file is and what to do.

use super::sewn;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::Source;

/// Reports an empty file, or one of another format, be it another dialect of ours than that of the name; `true` when it is
/// one.
pub(super) fn refuse(source: &Source, dialect: &str, out: &mut Diagnostics) -> bool {
    if refuse_unread(source, out) {
        return true;
    }
    let other = OURS.iter().find(|ours| ours.name != dialect && (ours.is)(source.bytes()));
    if let Some(Ours { name, what, .. }) = other {
        let message = format!("this is {what}, not a cutter file");
        let hint = format!("leave out `--from`, or give `--from {name}`");
        out.push(Diagnostic::new(&code::SOURCE_UNKNOWN, message).hint(hint));
    }
    other.is_some()
}

/// A dialect of ours that is known for certain.
struct Ours {
    name: &'static str,
    /// What its files are.
    what: &'static str,
    is: fn(&[u8]) -> bool,
}

const OURS: &[Ours] = &[
    Ours { name: "dxf", what: "a DXF drawing", is: is_dxf },
    Ours { name: "hpgl", what: "an HPGL plot", is: is_hpgl },
];

/// Reports an empty file, or one of a format that no dialect reads; `true` when it is one.
pub(super) fn refuse_unread(source: &Source, out: &mut Diagnostics) -> bool {
    let bytes = source.bytes();
    if bytes.iter().all(|&byte| byte.is_ascii_whitespace() || byte == 0 || byte == 0x1a) {
        let finding = Diagnostic::new(&code::SOURCE_EMPTY, "the file is empty");
        out.push(finding.hint("export it again, and check that the copy finished"));
        return true;
    }
    match FORMATS.iter().find(|format| (format.is)(bytes)) {
        None => false,
        Some(format) => {
            let message = format!("this is {}, not a cutter file", format.what);
            out.push(Diagnostic::new(&code::SOURCE_UNKNOWN, message).hint(hint(source, format.hint)));
            true
        }
    }
}

/// What to do about a source: what its name tells, else what is given.
pub(super) fn hint(source: &Source, hint: &'static str) -> &'static str {
    if sewn::is_stitch_file(source.name()) { SEW } else { hint }
}

struct Format {
    what: &'static str,
    hint: &'static str,
    is: fn(&[u8]) -> bool,
}

const EXPORT_CUT: &str = "let the CAD export an ISO cut file for a knife cutter";

const SEW: &str = "`cutc sew` reads stitch files, patterns and stitch queues of sewing machines";

/// What is recognised, the surest signs first.
const FORMATS: &[Format] = &[
    Format { what: "a stitch file of a sewing machine (DST)", hint: SEW, is: sewn::is_dst },
    Format { what: "a pattern for a sewing machine", hint: SEW, is: sewn::is_pattern },
    Format { what: "a stitch queue of a sewing machine", hint: SEW, is: sewn::is_queue },
    Format { what: "a zip archive", hint: "unpack it and give cutc the files inside", is: |b| b.starts_with(b"PK") },
    Format { what: "a PDF document", hint: EXPORT_CUT, is: |b| b.starts_with(b"%PDF") },
    Format { what: "a PNG picture", hint: EXPORT_CUT, is: |b| b.starts_with(b"\x89PNG") },
    Format { what: "text in UTF-16", hint: "save it as plain text: one byte a character", is: is_utf16 },
    Format {
        what: "a binary DXF drawing",
        hint: "save it as text (ASCII DXF)",
        is: |b| b.starts_with(b"AutoCAD Binary DXF"),
    },
    Format { what: "binary data", hint: EXPORT_CUT, is: is_binary },
    Format {
        what: "a Gerber file for circuit boards (RS-274X)",
        hint: "the name is the same, the format is not; garment CAD writes ISO cut files with M14 and M15",
        is: is_circuit_board,
    },
    Format {
        what: "G-code for a machine tool",
        hint: "its blocks end with the line; cutter files end them with `*`",
        is: is_g_code,
    },
];

/// Bytes that are looked at.
const SNIFFED: usize = 4096;

fn head(bytes: &[u8]) -> &[u8] {
    &bytes[..bytes.len().min(SNIFFED)]
}

fn is_utf16(bytes: &[u8]) -> bool {
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return true;
    }
    // Without a mark: every other byte of western text is NUL.
    let zeros = |parity: usize| {
        let (pairs, _) = head(bytes).as_chunks::<2>();
        pairs.len() >= 4 && pairs.iter().all(|pair| pair[parity] == 0 && pair[1 - parity] != 0)
    };
    zeros(0) || zeros(1)
}

/// More than one byte in ten that no text has.
fn is_binary(bytes: &[u8]) -> bool {
    let head = head(bytes);
    let control =
        |&&byte: &&u8| (byte < b' ' && !byte.is_ascii_whitespace() && byte != 0x1a && byte != 0) || byte == 0x7f;
    let zeros = memchr::memchr_iter(0, head).count();
    let asterisks = memchr::memchr_iter(b'*', head).count();
    10 * head.iter().filter(control).count() > head.len() || (zeros > asterisks && 4 * zeros > head.len())
}

/// Parameters between per cent signs, and no knife.
fn is_circuit_board(bytes: &[u8]) -> bool {
    if memchr::memmem::find(head(bytes), b"M15*").is_some() {
        return false;
    }
    let starts =
        |text: &[u8]| [b"%FS", b"%MO", b"%AD", b"%AM", b"%LP", b"%TF", b"%IP"].iter().any(|p| text.starts_with(*p));
    head(bytes).split(|&byte| byte == b'*' || byte == b'\n').take(20).any(|block| starts(block.trim_ascii()))
}

/// A section begins, or remarks stand before it.
pub(super) fn is_dxf(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut lines = head(bytes).split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii);
    let is_section = |line: &[u8]| line.eq_ignore_ascii_case(b"SECTION");
    match (lines.next(), lines.next()) {
        (Some(b"0"), Some(line)) => is_section(line),
        (Some(b"999"), Some(_)) => lines.any(is_section),
        _ => false,
    }
}

/// Two letters and numbers, between semicolons.
fn is_hpgl(bytes: &[u8]) -> bool {
    let head = head(bytes);
    if memchr::memchr(b'*', head).is_some() && !head.starts_with(b"\x1b") {
        return false;
    }
    let known = [b"IN", b"SP", b"PU", b"PD", b"PA", b"PR", b"DF", b"IP", b"SC", b"LT", b"VS"];
    let commands = head.split(|&byte| byte == b';').map(<[u8]>::trim_ascii).filter(|command| !command.is_empty());
    let (mut all, mut sound) = (0, 0);
    for command in commands.take(50) {
        all += 1;
        sound += usize::from(known.iter().any(|name| command.starts_with(*name)));
    }
    memchr::memchr(b';', head).is_some() && 2 * sound > all
}

/// Lines of words that begin with G, M, N and the like, and no asterisks to end them.
fn is_g_code(bytes: &[u8]) -> bool {
    let head = head(bytes);
    let (mut all, mut sound, mut g) = (0, 0, false);
    for line in head.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii).filter(|line| !line.is_empty()) {
        all += 1;
        let comment = matches!(line[0], b'(' | b';' | b'%');
        let word =
            line[0].is_ascii_alphabetic() && line.get(1).is_some_and(|b| b.is_ascii_digit() || b"-. ".contains(b));
        sound += usize::from(comment || word);
        g |= line.split(u8::is_ascii_whitespace).any(|w| matches!(w, [b'G' | b'g', b'0'..=b'9', ..]));
    }
    // Some senders add a checksum behind an asterisk, one a line at most, and never behind each word.
    let asterisks = memchr::memchr_iter(b'*', head).count();
    g && 2 * sound > all && all >= 2 && asterisks == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(bytes: &[u8], what: Option<&str>) {
        let found = FORMATS.iter().find(|format| (format.is)(bytes)).map(|format| format.what);
        assert_eq!(found, what, "{}", String::from_utf8_lossy(bytes));
    }

    #[test]
    fn a_foreign_file_is_called_by_its_name() {
        check(b"x_mm,y_mm,element\n0,0,\n", Some("a pattern for a sewing machine"));
        check(b"op,dx_mm,dy_mm,value\nEND,,,\n", Some("a stitch queue of a sewing machine"));
        check(b"PK\x03\x04\x14\0", Some("a zip archive"));
        check(b"G04 comment*\n%FSLAX24Y24*%\n%MOIN*%\nX0Y0D02*", Some("a Gerber file for circuit boards (RS-274X)"));
        check(b"%\nG21\nG0 X1 Y2\nM30\n", Some("G-code for a machine tool"));
        check(b"AutoCAD Binary DXF\r\n\x1a\0\0\0SECTION", Some("a binary DXF drawing"));
        check(b"H\x001\0*\0M\x001\x005\0*\0", Some("text in UTF-16"));
        check(b"\x01\x02\x7f\x03abc\x04\x05", Some("binary data"));
    }

    #[test]
    fn a_plot_is_foreign_to_other_dialects_only() {
        let source = Source::new("a.cut", b"IN;SP1;PU0,0;PD400,0;".to_vec()).expect("small");
        let mut found = Diagnostics::default();
        assert!(!refuse_unread(&source, &mut found) && !found.has_errors());
        assert!(!refuse(&source, "hpgl", &mut found) && !found.has_errors());
        assert!(refuse(&source, "iso", &mut found) && found.has_errors());
    }

    #[test]
    fn a_cutter_file_is_not_foreign() {
        check(b"H1*G71*M15*N1*X0Y0*M14*X100Y0*M15*M0*", None);
        check(b"H1*\nG71*\nM15*\nX0Y0*\nM14*\n", None);
        check(b"x_mm,y_mm\n1,2\n", None);
        check(b"  0\r\nSECTION\r\n  2\r\nHEADER\r\n", None);
        check(b"H1*M15*M20*%FS;PU;PD*M0*", None);
    }
}
