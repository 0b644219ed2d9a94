//! Counts of elements that are not cut, reported once per kind.

use super::style;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, code};
use crate::source::Span;

/// Maximum number of selectors named in a message.
const MOST_NAMED: usize = 3;

/// Properties that hide a part of what is drawn.
const HIDING: [&str; 2] = [style::PROPERTIES[style::CLIP_PATH], style::PROPERTIES[style::MASK]];

/// Counts, each with the location of the first element.
#[derive(Debug, Default)]
pub(super) struct Tally {
    hidden: Option<(usize, Span)>,
    without_line: Option<(usize, Span)>,
    /// Unsupported kinds, in the order of their first use.
    kinds: Vec<(String, usize, Span)>,
}

fn count(counted: &mut Option<(usize, Span)>, span: Span) {
    counted.get_or_insert((0, span)).0 += 1;
}

/// A count with its noun.
fn many(count: usize, one: &str, several: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {several}") }
}

impl Tally {
    /// Counts shapes that are not seen.
    pub(super) fn hide(&mut self, shapes: usize, span: Span) {
        if shapes > 0 {
            self.hidden.get_or_insert((0, span)).0 += shapes;
        }
    }

    /// Counts a shape without a stroke or a fill that is seen.
    pub(super) fn lack_line(&mut self, span: Span) {
        count(&mut self.without_line, span);
    }

    /// Counts an unsupported element that draws something.
    pub(super) fn leave_out(&mut self, kind: &str, span: Span) {
        match self.kinds.iter_mut().find(|(known, _, _)| known == kind) {
            Some((_, count, _)) => *count += 1,
            None => self.kinds.push((kind.to_owned(), 1, span)),
        }
    }

    /// Reports all counts.
    pub(super) fn tell(self, strange: &[&str], out: &mut Diagnostics) {
        let mut say = |code: &'static Code, span: Option<Span>, message: String, hint: &str| {
            let finding = Diagnostic::new(code, message).hint(hint);
            out.push(match span {
                Some(span) => finding.at(span),
                None => finding,
            });
        };
        if let Some((count, span)) = self.hidden {
            let what = many(count, "shape or text is", "shapes and texts are");
            let message = format!("{what} hidden or transparent, and so not cut");
            say(&code::SVG_HIDDEN, Some(span), message, "if it must be cut, show its layer and save the drawing again");
        }
        if let Some((count, span)) = self.without_line {
            let what = many(count, "shape without stroke and fill is", "shapes without stroke and fill are");
            let message = format!("{what} not seen, and so not cut");
            say(&code::SVG_NO_LINE, Some(span), message, "if it must be cut, give it a stroke");
        }
        for (kind, count, span) in self.kinds {
            let hides = HIDING.contains(&kind.as_str());
            let does = if hides { "hides is cut" } else { "draws is not cut" };
            let message = format!("`{kind}` is not read, and what it {does}: {count} of them");
            let hint = match kind.as_str() {
                "text" => "if letters must be cut, turn them into paths",
                _ if hides => "apply it in the program that drew it, or look in the picture (`-t svg`) what is cut",
                _ => "if it must be cut, turn it into paths in the program that drew it",
            };
            say(&code::SVG_LEFT_OUT, Some(span), message, hint);
        }
        if !strange.is_empty() {
            let listed: Vec<String> =
                strange.iter().take(MOST_NAMED).map(|name| format!("`{}`", shown(name))).collect();
            let more = if strange.len() > MOST_NAMED { " and others" } else { "" };
            let message = format!("rules of a style sheet are not obeyed: {}{more}", listed.join(", "));
            say(&code::SVG_STYLE, None, message, "look in the picture (`-t svg`) whether hidden lines are cut");
        }
    }
}

/// A selector, shortened for a message.
fn shown(text: &str) -> String {
    text.chars().take(40).map(|c| if c.is_control() { ' ' } else { c }).collect()
}
