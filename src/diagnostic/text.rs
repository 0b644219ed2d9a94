//! The text rendering: place, message, a window of the source with a caret, hints.
//!
//! A cut file is often one line of 59 kB, so never a whole line is shown, only a window around the place.

use std::fmt::Write as _;

use super::{Diagnostic, Diagnostics, Severity};
use crate::source::{Source, Span};

/// Bytes of source shown before and after the place.
const WINDOW_BEFORE: usize = 28;
const WINDOW_AFTER: usize = 40;

/// Renders all findings, errors and warnings in the order found, then what was counted only.
pub fn render(diagnostics: &Diagnostics, source: &Source) -> String {
    let mut out = String::new();
    for diagnostic in diagnostics {
        render_one(&mut out, diagnostic, source);
    }
    for (code, count) in diagnostics.surplus() {
        let _ = writeln!(out, "{}[{}]: {count} more like the ones above", word(code.severity), code.name);
    }
    out
}

fn word(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    }
}

// Writing into a `String` cannot fail, so the results of `writeln!` are dropped throughout.
fn render_one(out: &mut String, diagnostic: &Diagnostic, source: &Source) {
    let _ = writeln!(out, "{}[{}]: {}", word(diagnostic.code.severity), diagnostic.code.name, diagnostic.message);
    match diagnostic.span {
        None => {
            let _ = writeln!(out, "  --> {}", source.name());
        }
        Some(span) => {
            let place = source.place(span);
            let _ = write!(out, "  --> {}: line {}, ", source.name(), place.line);
            if place.block > 0 {
                let _ = write!(out, "block {}, ", place.block);
            }
            let _ = writeln!(out, "byte {}", place.byte);
            window(out, source.bytes(), span);
        }
    }
    for hint in &diagnostic.hints {
        let _ = writeln!(out, "  = hint: {hint}");
    }
}

/// Two lines: the bytes around the span, and carets under the span.
fn window(out: &mut String, bytes: &[u8], span: Span) {
    let start = (span.start as usize).min(bytes.len());
    let end = (span.end as usize).clamp(start, bytes.len());
    let from = start.saturating_sub(WINDOW_BEFORE);
    let until = (start + WINDOW_AFTER).min(bytes.len());
    let shown: String = bytes[from..until].iter().map(|&b| visible(b)).collect();
    let lead = if from > 0 { "..." } else { "" };
    let trail = if until < bytes.len() { "..." } else { "" };
    let carets = (end.min(until) - start).max(1);
    let _ = writeln!(out, "   | {lead}{shown}{trail}");
    let _ = writeln!(out, "   | {}{}", " ".repeat(lead.len() + start - from), "^".repeat(carets));
}

/// One column a byte, so that the carets stand under what they mean.
fn visible(byte: u8) -> char {
    match byte {
        b' '..=b'~' => byte as char,
        b'\r' | b'\n' => '\u{23ce}',
        _ => '\u{b7}',
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::code;

    #[test]
    fn a_long_line_is_shown_as_a_window() {
        let mut bytes = b"X1Y1*".repeat(10_000);
        bytes[25_000..25_005].copy_from_slice(b"X*Y1*");
        let source = Source::new("long.cut", bytes).expect("small");
        let mut found = Diagnostics::default();
        let span = Span { start: 25_000, end: 25_001, block: 5001 };
        found.push(Diagnostic::new(&code::ISO_NO_VALUE, "X has no value").at(span).hint("write a number"));
        let text = render(&found, &source);
        assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
        insta::assert_snapshot!(text, @r"
        error[iso/no-value]: X has no value
          --> long.cut: line 1, block 5001, byte 25000
           | ...Y1*X1Y1*X1Y1*X1Y1*X1Y1*X1Y1*X*Y1*X1Y1*X1Y1*X1Y1*X1Y1*X1Y1*X1Y1*X1Y1*...
           |                                ^
          = hint: write a number
        ");
    }
}
