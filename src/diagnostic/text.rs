//! Text rendering: message, place, a window of the source where the text is at fault, hints.
//!
//! A marker of hundreds of pieces has hundreds of findings of one kind. Therefore findings are grouped by code, the worst code
//! first, and a tally follows at the end. Errors must be mended, and are reported individually. Warnings about the drawing
//! differ only in place and magnitude: they are summed up, and the worst is reported. Warnings about the text differ in
//! content: a few of each code are reported, and hints that they share are written once.
//!
//! A cut file is often one line of 59 kB, so only a window around the place is shown, never a whole line.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::code::Telling;
use super::{Code, Diagnostic, Diagnostics, Fault, Severity};
use crate::source::{Lines, Source, Span};
use crate::units::number::fixed;

/// Number of source bytes shown before and after the place.
const WINDOW_BEFORE: usize = 28;
const WINDOW_AFTER: usize = 40;
/// Greatest number of errors reported per code: a user who has mended that many runs it again.
const MOST_ERRORS: usize = 20;
/// Greatest number of warnings reported per code that is not summed up.
const MOST_TOLD: usize = 3;
/// Total number of reported findings above which only one per code is reported.
const ROOM: usize = 4;
/// Decimals of a place on the cloth, mm.
const PLACE_DECIMALS: u32 = 1;
/// Difference of magnitudes that count as equal, mm; such findings keep the order of the file.
const ALIKE: f64 = 0.01;
/// Width of the tally, columns.
const COLUMNS: usize = 100;

/// Extent of a report.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Detail {
    /// A few findings of each code.
    #[default]
    Short,
    /// All findings.
    All,
    /// A few errors of each code, no warnings.
    Errors,
    /// Only the number for each code: the findings are reported elsewhere.
    Counts,
}

/// Renders a short report.
pub fn render(diagnostics: &Diagnostics, source: &Source) -> String {
    render_with(diagnostics, source, Detail::Short)
}

/// Renders findings, the worst code first, then the tally if some are omitted.
pub fn render_with(diagnostics: &Diagnostics, source: &Source, detail: Detail) -> String {
    let mut groups: Vec<Group> =
        diagnostics.tally().into_iter().map(|(code, count)| Group { code, count, findings: Vec::new() }).collect();
    if detail == Detail::Errors {
        groups.retain(|group| group.code.severity == Severity::Error);
    }
    for finding in diagnostics {
        if let Some(group) = groups.iter_mut().find(|group| std::ptr::eq(group.code, finding.code)) {
            group.findings.push(finding);
        }
    }
    let mut out = String::new();
    let few = (ROOM / groups.len().max(1)).clamp(1, MOST_TOLD);
    let most = |code: &Code| match detail {
        Detail::Short | Detail::Errors => match code.telling() {
            Telling::Each => MOST_ERRORS,
            Telling::Few => few,
            Telling::Worst => 1,
        },
        Detail::All => usize::MAX,
        Detail::Counts => 0,
    };
    let mut lines = source.lines();
    for group in &mut groups {
        group.render(&mut out, source, &mut lines, most(group.code));
    }
    let is_untold = |group: &Group| group.count > most(group.code);
    if groups.iter().any(is_untold) {
        tally(&mut out, &groups, |group| detail != Detail::Counts && is_untold(group));
    }
    out
}

/// Findings of one code.
struct Group<'a> {
    code: &'static Code,
    /// Number of findings, kept or not.
    count: usize,
    findings: Vec<&'a Diagnostic>,
}

// Writing into a `String` cannot fail, so the results of `writeln!` are dropped throughout.
impl Group<'_> {
    fn render(&mut self, out: &mut String, source: &Source, lines: &mut Lines, most: usize) {
        // Measurable findings are sorted by magnitude, the others by their order in the file.
        self.findings.sort_by(|a, b| {
            let bad = |finding: &Diagnostic| (finding.by.unwrap_or(0.0) / ALIKE).round();
            bad(b).total_cmp(&bad(a)).then_with(|| a.span.cmp(&b.span))
        });
        let is_summed = most > 0 && self.count > most && self.code.telling() == Telling::Worst;
        let lead = if is_summed { self.sum() } else { String::new() };
        let told = &self.findings[..self.findings.len().min(most)];
        for (i, finding) in told.iter().enumerate() {
            render_one(out, &lead, finding, source, &mut *lines);
            // Hints that the next finding shares are written after that.
            if told.get(i + 1).is_none_or(|next| next.hints != finding.hints) {
                for hint in &finding.hints {
                    let _ = writeln!(out, "  = hint: {hint}");
                }
            }
        }
        match self.count - told.len() {
            0 => {}
            _ if most == 0 || is_summed => {}
            more if self.findings.len() > told.len() => {
                let _ = writeln!(out, "  ... and {more} more");
            }
            more => {
                let _ = writeln!(out, "  ... and {more} more like these");
            }
        }
    }

    /// Number of findings and of pieces, as a lead to the first finding, which is the worst one if they can be measured.
    fn sum(&self) -> String {
        let pieces: BTreeSet<_> = self.findings.iter().filter_map(|finding| finding.piece.as_deref()).collect();
        let on = match pieces.len() {
            0 => String::new(),
            1 => " on one piece".to_owned(),
            many => format!(" on {many} pieces"),
        };
        let is_measured = self.findings.first().is_some_and(|finding| finding.by.is_some());
        format!("{} findings{on}, the {}: ", self.count, if is_measured { "worst" } else { "first" })
    }
}

/// Number of findings of each code, the worst first, with the option that reports each, if that is done nowhere.
fn tally(out: &mut String, groups: &[Group], is_untold: impl Fn(&Group) -> bool) {
    for severity in [Severity::Error, Severity::Warning] {
        let of_severity = || groups.iter().filter(|group| group.code.severity == severity);
        let count: usize = of_severity().map(|group| group.count).sum();
        if count == 0 {
            continue;
        }
        let more = if of_severity().any(&is_untold) { " (`--all` tells each)" } else { "" };
        let mut line = format!("{count} {}{}{more}:", word(severity), if count == 1 { "" } else { "s" });
        let mut words = of_severity().map(|group| format!(" {} {}", group.count, group.code.name)).peekable();
        while let Some(mut next) = words.next() {
            if words.peek().is_some() {
                next.push(',');
            }
            if line.len() + next.len() > COLUMNS {
                let _ = writeln!(out, "{line}");
                " ".clone_into(&mut line);
            }
            line += &next;
        }
        let _ = writeln!(out, "{line}");
    }
}

fn word(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    }
}

fn render_one(out: &mut String, lead: &str, diagnostic: &Diagnostic, source: &Source, lines: &mut Lines) {
    let Diagnostic { code, message, .. } = diagnostic;
    let _ = writeln!(out, "{}[{}]: {lead}{message}", word(code.severity), code.name);
    let mut place = on_cloth(diagnostic);
    if let Some(span) = diagnostic.span {
        let in_text = in_text(span, lines, place.is_empty());
        place = if place.is_empty() { in_text } else { format!("{place} ({in_text})") };
    }
    let colon = if place.is_empty() { "" } else { ": " };
    let _ = writeln!(out, "  --> {}{colon}{place}", source.name());
    if let (Some(span), Fault::Text) = (diagnostic.span, diagnostic.code.fault) {
        window(out, source.bytes(), span);
    }
}

/// Piece and place on the cloth, if known: people find these in the picture and on the table.
fn on_cloth(diagnostic: &Diagnostic) -> String {
    let mut place = String::new();
    if let Some(piece) = &diagnostic.piece {
        let _ = write!(place, "{piece}");
    }
    if let Some([x, y]) = diagnostic.at.as_ref().map(|at| at.map(|value| fixed(value, PLACE_DECIMALS))) {
        let space = if place.is_empty() { "" } else { " " };
        let _ = write!(place, "{space}at {x}, {y} mm");
    }
    place
}

/// Block and byte; also the line if there are several lines or nothing else is shown.
fn in_text(span: Span, lines: &mut Lines, alone: bool) -> String {
    let place = lines.place(span);
    let line = if alone || place.line > 1 { format!("line {}, ", place.line) } else { String::new() };
    let block = if place.block > 0 { format!("block {}, ", place.block) } else { String::new() };
    format!("{line}{block}byte {}", place.byte)
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

/// Printable character of a byte: one column per byte, so that the carets are aligned.
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
    use crate::diagnostic::{PieceName, code};

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

    #[test]
    fn warnings_on_what_is_drawn_are_one_a_code_the_worst_and_errors_are_told_each() {
        let source = Source::new("nest.cut", b"X1Y1*".to_vec()).expect("small");
        let mut found = Diagnostics::default();
        for (number, by) in [(1, 0.2), (2, 0.9), (2, 0.4)] {
            let piece = PieceName { number, copy: 0, label: None };
            let warning = Diagnostic::new(&code::PATH_OVERCUT, format!("it cuts {by} mm into another part")).by(by);
            let warning = warning.on_cloth([by, 7.0]).hint("a narrower blade cuts less deep");
            found.push(Diagnostic { piece: Some(Box::new(piece)), ..warning });
            found.push(Diagnostic::new(&code::PATH_OVERCUT_REFUSED, format!("it would cut {by} mm into its part")));
        }
        insta::assert_snapshot!(render(&found, &source), @r"
        error[path/overcut-refused]: it would cut 0.2 mm into its part
          --> nest.cut
        error[path/overcut-refused]: it would cut 0.9 mm into its part
          --> nest.cut
        error[path/overcut-refused]: it would cut 0.4 mm into its part
          --> nest.cut
        warning[path/overcut]: 3 findings on 2 pieces, the worst: it cuts 0.9 mm into another part
          --> nest.cut: piece 2 at 0.9, 7.0 mm
          = hint: a narrower blade cuts less deep
        3 errors: 3 path/overcut-refused
        3 warnings (`--all` tells each): 3 path/overcut
        ");
        let all = render_with(&found, &source, Detail::All);
        assert_eq!(all.matches("warning[path/overcut]: it cuts").count(), 3, "{all}");
    }
}
