//! Strokes of the knife that have lost places: without any motion, and from the end of another contour.

use super::draft::look::Stroke;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::Span;

/// Strokes of a file.
#[derive(Debug, Default)]
pub(super) struct Strokes {
    /// Strokes without a motion: the piece and the block of the knife-down of each.
    empty: Vec<(Option<u32>, Span)>,
    /// Block of the last knife-down.
    down: Span,
    /// True if the last knife-down stands where a finished cut has ended, without a move between.
    is_new: bool,
    /// True if the knife has cut before.
    has_cut: bool,
}

impl Strokes {
    /// Records a knife-down. `stays` tells that the knife has not moved since it was lifted, `continues` that it goes on with
    /// an open line.
    pub(super) fn down(&mut self, stays: bool, continues: bool, span: Span) {
        // A second knife-down at one place makes good an empty one.
        self.empty.pop_if(|(_, empty)| stays && *empty == self.down);
        (self.down, self.is_new) = (span, stays && self.has_cut && !continues);
    }

    /// Records a lift at the end of a stroke. Returns the finding on a line that starts where the contour before it has ended.
    pub(super) fn up(&mut self, stroke: Stroke, piece: Option<u32>) -> Option<Diagnostic> {
        self.has_cut = true;
        match stroke {
            Stroke::Empty => self.empty.push((piece, self.down)),
            Stroke::Open if self.is_new => {
                let message = "an open line starts where the contour before it has ended";
                let finding = Diagnostic::new(&code::ISO_START_AT_END, message).at(self.down);
                return Some(finding.hint("the place where it starts may be lost: see it in the picture (-t svg)"));
            }
            Stroke::Open | Stroke::Other => {}
        }
        None
    }

    /// Reports the strokes without a motion.
    pub(super) fn report(&self, out: &mut Diagnostics) {
        let Some(&(_, first)) = self.empty.first() else { return };
        let times = if self.empty.len() == 1 { "once".to_owned() } else { format!("{} times", self.empty.len()) };
        let message = format!("the knife goes down and up without a move, and cuts nothing: {times}");
        let mut pieces: Vec<u32> = self.empty.iter().filter_map(|&(piece, _)| piece).collect();
        pieces.dedup();
        let finding = Diagnostic::new(&code::ISO_EMPTY_STROKE, message).at(first).about(pieces);
        out.push(finding.hint("the places between M14 and M15 may be lost, and with them a notch or a piece"));
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Diagnostics;
    use crate::machine::Job;
    use crate::source::Source;

    /// Checks the findings on an outline with blocks behind it.
    fn check(behind: &str, expected: &[&str]) {
        let file = format!("G71*N1*X0Y0*M14*X1000Y0*X1000Y1000*X0Y0*M15*{behind}M0*");
        let source = Source::new("a", file.clone().into_bytes()).expect("small");
        let mut out = Diagnostics::default();
        crate::front::iso::lower::lower(&source, &Job::default(), &mut out);
        let found: Vec<&str> = out.iter().map(|finding| finding.code.name).collect();
        assert_eq!(found, expected, "{file}");
    }

    #[test]
    fn a_stroke_without_a_motion_is_told_unless_it_is_cut_behind_it() {
        check("X500Y0*M14*M15*", &["iso/empty-stroke"]);
        check("M14*M15*", &["iso/empty-stroke"]);
        check("X500Y0*M14*M15*M14*X500Y60*M15*", &[]);
        check("X500Y0*M14*X500Y60*M15*", &[]);
    }

    #[test]
    fn an_open_line_from_the_end_of_an_outline_is_told() {
        check("M14*X500Y300*M15*", &["iso/start-at-end"]);
        check("M14*X0Y60*M15*", &[]);
        check("M14*X-900Y0*X0Y-900*X0Y0*M15*", &[]);
        // An open line that goes on is one line.
        check("X5000Y0*M14*X6000Y0*M15*M14*X7000Y500*M15*", &[]);
        check("N2*X5000Y0*M14*X6000Y0*M15*", &[]);
    }
}
