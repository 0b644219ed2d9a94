//! Recognition of foreign formats, so that the message names the format of a file and the remedy.

use super::formats::{self, Format, head};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::{Source, line_end};

/// Number of bytes searched for the first element of XML.
const SNIFFED_XML: usize = 65_536;

/// Reports an empty file or one of another format, including that of another dialect than `dialect`; true if it is one.
pub(super) fn refuse(source: &Source, dialect: &str, out: &mut Diagnostics) -> bool {
    if refuse_unread(source, out) {
        return true;
    }
    let other = OURS.iter().find(|ours| !ours.names.contains(&dialect) && (ours.is)(source.bytes()));
    if let Some(Ours { names: [name, ..], what, .. }) = other {
        let message = format!("this is {what}, not a cutter file");
        let hint = format!("leave out `--from`, or give `--from {name}`");
        out.push(Diagnostic::new(&code::SOURCE_UNKNOWN, message).hint(hint));
    }
    other.is_some()
}

/// A dialect whose files are recognised for certain.
struct Ours {
    /// Names of the dialects that read the format, the most likely first.
    names: &'static [&'static str],
    /// Description of its files.
    what: &'static str,
    is: fn(&[u8]) -> bool,
}

const OURS: &[Ours] = &[
    Ours { names: &["dxf", "pattern"], what: "a DXF drawing", is: is_dxf },
    Ours { names: &["hpgl"], what: "an HPGL plot", is: is_hpgl },
    Ours { names: &["svg"], what: "an SVG drawing", is: is_svg },
];

/// Reports an empty file, or one of a format that no dialect reads; true if it is one.
pub(super) fn refuse_unread(source: &Source, out: &mut Diagnostics) -> bool {
    let bytes = source.bytes();
    if bytes.iter().all(|&byte| byte.is_ascii_whitespace() || byte == 0 || byte == 0x1a) {
        let is_nul = !bytes.is_empty() && bytes.iter().all(|&byte| byte == 0);
        let message = if is_nul {
            format!("the file holds {} NUL bytes and nothing else: a broken copy", bytes.len())
        } else {
            "the file is empty".to_owned()
        };
        let finding = Diagnostic::new(&code::SOURCE_EMPTY, message);
        out.push(finding.hint("export it again, and check that the copy finished"));
        return true;
    }
    match formats::of_content(bytes).filter(|_| !is_svg(bytes)) {
        None => false,
        Some(format) => {
            say(formats::of_name(source.name()).filter(|_| format.is_vague).unwrap_or(format), out);
            true
        }
    }
}

/// Reports a file of no known dialect by the extension of its name; true if the name identifies a format.
pub(super) fn refuse_by_name(source: &Source, out: &mut Diagnostics) -> bool {
    let named = formats::of_name(source.name());
    if let Some(format) = named {
        say(format, out);
    }
    named.is_some()
}

fn say(format: &Format, out: &mut Diagnostics) {
    let message = format!("this is {}, not a cutter file", format.what);
    out.push(Diagnostic::new(&code::SOURCE_UNKNOWN, message).hint(format.hint));
}

/// True if the file begins with a section of DXF, optionally after remarks.
pub(super) fn is_dxf(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let end = line_end(head(bytes));
    let mut lines = head(bytes).split(|&byte| byte == end).map(<[u8]>::trim_ascii);
    let is_section = |line: &[u8]| line.eq_ignore_ascii_case(b"SECTION");
    match (lines.next(), lines.next()) {
        (Some(b"0"), Some(line)) => is_section(line),
        (Some(b"999"), Some(_)) => lines.any(is_section),
        _ => false,
    }
}

/// True for XML with an `svg` element, unless it is an HTML page.
pub(super) fn is_svg(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(SNIFFED_XML)];
    let marked = [b"\xef\xbb\xbf".as_slice(), b"\xff\xfe", b"\xfe\xff"];
    let head = marked.iter().find_map(|mark| head.strip_prefix(*mark)).unwrap_or(head);
    if !matches!(head.trim_ascii_start(), [b'<', ..] | [0, b'<', ..]) {
        return false;
    }
    // In UTF-16 every other byte of the element is zero.
    let text: Vec<u8> = head.iter().copied().filter(|&byte| byte != 0).collect();
    let begins = |with: &[u8]| text.trim_ascii_start().get(..with.len()).is_some_and(|s| s.eq_ignore_ascii_case(with));
    let is_end = |byte: Option<&u8>| byte.is_none_or(|byte| byte.is_ascii_whitespace() || b">/".contains(byte));
    let is_element = |at: usize| {
        let name = text[..at].rsplit(|byte| !byte.is_ascii_alphanumeric() && *byte != b':').next().unwrap_or_default();
        text[..at - name.len()].ends_with(b"<") && (name.is_empty() || name.ends_with(b":"))
    };
    let mut places = memchr::memmem::find_iter(&text, b"svg").filter(|&at| is_end(text.get(at + 3)));
    places.any(is_element) && !begins(b"<!DOCTYPE html") && !begins(b"<html")
}

/// True for two-letter instructions with numbers, separated by semicolons.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_is_foreign_to_other_dialects_only() {
        let source = Source::new("a.cut", b"IN;SP1;PU0,0;PD400,0;".to_vec()).expect("small");
        let mut found = Diagnostics::default();
        assert!(!refuse_unread(&source, &mut found) && !found.has_errors());
        assert!(!refuse(&source, "hpgl", &mut found) && !found.has_errors());
        assert!(refuse(&source, "iso", &mut found) && found.has_errors());
    }
}
