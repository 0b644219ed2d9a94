//! Reading: bytes of a dialect become a [`Marker`](crate::ir::Marker), or a [`Drawing`](crate::ir::Drawing) if the dialect does
//! not state the cut lines.
//!
//! Receives a [`Source`]. Promises a form in mm that is independent of the dialect: its units, line breaks, codes and layouts.
//! Every element keeps the span of its origin. All faults are reported in one run; a marker with an error among the diagnostics
//! is never compiled. Never guesses silently, never does I/O.

mod csv;
mod decimals;
mod dialect;
mod dxf;
mod foreign;
mod formats;
mod hpgl;
mod iso;
pub mod marks;
mod pattern;
pub mod sewn;
mod svg;

pub use dialect::{Dialect, Likeness, Read, Word};

use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::Source;

/// All dialects, the more common ones first.
pub const DIALECTS: &[Dialect] =
    &[iso::DIALECT, hpgl::DIALECT, pattern::DIALECT, dxf::DIALECT, svg::DIALECT, csv::DIALECT];

/// The dialect with a name.
pub fn by_name(name: &str) -> Option<&'static Dialect> {
    DIALECTS.iter().find(|dialect| dialect.name == name)
}

/// The dialect to read a file as: `from` if it is given and the content is not plainly another one, otherwise the one that
/// the content matches best.
pub fn choose<'d>(
    source: &Source,
    from: Option<&'d Dialect>,
    name_extension: Option<&str>,
    diagnostics: &mut Diagnostics,
) -> Option<&'d Dialect> {
    match from {
        Some(dialect) => (!foreign::refuse(source, dialect.name, diagnostics)).then_some(dialect),
        None => detect(source, name_extension, diagnostics),
    }
}

/// The dialect that the content matches best. The extension of the name, without its dot, only breaks ties. Content of no
/// dialect is an error, with a diagnostic that names the likely format.
fn detect(source: &Source, name_extension: Option<&str>, diagnostics: &mut Diagnostics) -> Option<&'static Dialect> {
    if foreign::refuse_unread(source, diagnostics) {
        return None;
    }
    let named = |dialect: &Dialect| {
        name_extension.is_some_and(|name| dialect.extensions.iter().any(|known| known.eq_ignore_ascii_case(name)))
    };
    // `max_by_key` returns the last of equals. The more common dialects come first, hence the reversal.
    let sniffed = DIALECTS.iter().rev().map(|dialect| (dialect, (dialect.sniff)(source.bytes())));
    let best = sniffed.max_by_key(|(dialect, likeness)| (*likeness, named(dialect)));
    let found = best.filter(|(_, likeness)| *likeness != Likeness::No).map(|(dialect, _)| dialect);
    if found.is_none() && !foreign::refuse_by_name(source, diagnostics) {
        let known: Vec<&str> = DIALECTS.iter().map(|dialect| dialect.name).collect();
        let message = format!("the content is none of the dialects that cutc reads: {}", known.join(", "));
        let finding = Diagnostic::new(&code::SOURCE_UNKNOWN, message);
        diagnostics.push(finding.hint("if it is one of them all the same, name it with `--from`"));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(bytes: &[u8], extension: Option<&str>, dialect: Option<&str>) {
        let source = Source::new("a", bytes.to_vec()).expect("small");
        let mut found = Diagnostics::default();
        let detected = detect(&source, extension, &mut found).map(|dialect| dialect.name);
        assert_eq!(detected, dialect, "{}", String::from_utf8_lossy(bytes));
        assert_eq!(found.has_errors(), dialect.is_none());
    }

    #[test]
    fn content_decides_and_the_extension_breaks_ties() {
        check(b"H1*G71*M15*N1*M0*", Some("csv"), Some("iso"));
        check(b"x_mm,y_mm\n1,2\n", Some("cut"), Some("csv"));
        check(b"x,y*\n", None, Some("iso"));
        check(b"x,y*\n", Some("CSV"), Some("csv"));
        check(b"1.5,2.5\n", None, Some("csv"));
        check(b"IN;SP1;PU0,0;PD400,0;", Some("cut"), Some("hpgl"));
        check(b";PU7,4\r\n;PD8,4,9,9\r\n;PU\r\n", Some("gbr"), Some("hpgl"));
        check(b"\x1b%0BIN;LBa*b*c*d*\x03PU1,1;PD2,2;", Some("nc"), Some("hpgl"));
        check(b"H1*G71*M15*N1*M20*IN;PU;PD*M0*", Some("plt"), Some("iso"));
        check(b"hello world\n", Some("cut"), None);
        check(b" \r\n\x1a", Some("cut"), None);
    }
}
