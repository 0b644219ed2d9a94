//! Signs of lost knife codes and places: points that are passed in the air without any action, slits without an end or a tip,
//! and a piece that begins during a cut.

use super::chain::Chain;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::Span;

/// Number of consecutive points without an action that look like a cut; the shortest cut has two.
const LEAST_PLACES: usize = 2;

/// Sequences of points that the knife passes in the air without an action.
#[derive(Debug, Default)]
pub(super) struct Uncut {
    /// The current sequence: its number of points, and the block of the first.
    places: usize,
    start: Span,
    /// Number of such sequences, and the start of the first.
    rows: usize,
    first: Option<Span>,
    /// Numbers of the pieces that they are in.
    pieces: Vec<u32>,
}

impl Uncut {
    /// Records a move in the air to a point.
    pub(super) fn pass(&mut self, span: Span) {
        if self.places == 0 {
            self.start = span;
        }
        self.places += 1;
    }

    /// Ends the current sequence with an action: a plunge, a hole or a label.
    pub(super) fn settle(&mut self) {
        self.places = 0;
    }

    /// Ends the current sequence, which is in a piece, without an action, by a lift or a new piece.
    pub(super) fn end(&mut self, piece: Option<u32>) {
        if self.places >= LEAST_PLACES {
            self.rows += 1;
            self.first.get_or_insert(self.start);
            self.pieces.extend(piece.filter(|piece| !self.pieces.contains(piece)));
        }
        self.places = 0;
    }

    /// Reports the sequences.
    pub(super) fn report(&self, out: &mut Diagnostics) {
        let Some(first) = self.first else { return };
        let times = if self.rows == 1 { "once".to_owned() } else { format!("{} times", self.rows) };
        let message = format!("places in a row are passed with the knife up, and nothing is cut: this happens {times}");
        let finding = Diagnostic::new(&code::ISO_UNCUT_PLACES, message).at(first).about(self.pieces.clone());
        out.push(finding.hint("an M14 may be missing behind the first of them: then a piece or a cut-out is lost"));
    }
}

/// The finding on a full circle with the knife up.
pub(super) fn circle_in_air(span: Span) -> Diagnostic {
    let message = "a full circle is passed with the knife up, and nothing is cut";
    let finding = Diagnostic::new(&code::ISO_UNCUT_PLACES, message).at(span);
    finding.hint("an M14 may be missing before it: then a piece or a cut-out is lost")
}

/// The error for a file without cuts that draws with D1 and D2, as photoplots do.
pub(super) fn photoplot(bytes: &[u8]) -> Option<Diagnostic> {
    let has = |codes: [&[u8]; 2]| codes.iter().any(|code| memchr::memmem::find(bytes, code).is_some());
    if !has([b"D1*", b"D01*"]) || !has([b"D2*", b"D02*"]) {
        return None;
    }
    let message = "lines are drawn with D1 and D2 (RS-274D), and nothing is cut";
    let finding = Diagnostic::new(&code::ISO_NOTHING_TO_CUT, message);
    Some(finding.hint("let the CAD write a cut file, with M14 and M15 for the knife, or a plot in HPGL"))
}

/// The fault of a slit that begins at `begun` and has no end before something at `at`.
pub(super) fn open_slit(begun: Span, before: &str, at: Span) -> Diagnostic {
    let message = format!("the slit that begins in block {} has no M15 before {before}", begun.block);
    let finding = Diagnostic::new(&code::ISO_OPEN_SLIT, message).at(at);
    finding.hint("an M15 belongs behind the tip of a slit; one may be lost")
}

/// The finding on a slit of a number of places, its root among them, if it has no other.
pub(super) fn empty_slit(places: usize, begun: Span) -> Option<Diagnostic> {
    let message = "a slit ends where it begins, and nothing is cut";
    let finding = (places < 2).then(|| Diagnostic::new(&code::ISO_EMPTY_SLIT, message).at(begun))?;
    Some(finding.hint("its tip is missing between M19 and M15; transfer the file again"))
}

/// A piece that begins at the next lift of the knife.
#[derive(Debug)]
pub(super) struct Deferred {
    pub(super) number: Option<u32>,
    pub(super) span: Span,
    /// Number of vertices of the current chain at its N, if the chain was closed by then.
    pub(super) closed_at: Option<usize>,
}

impl Deferred {
    /// A piece whose N was read while `chain` is cut.
    pub(super) fn new(number: Option<u32>, span: Span, chain: Option<&Chain>) -> Self {
        let closed = chain.filter(|chain| chain.ends().0 == chain.ends().1 && !chain.is_point());
        Self { number, span, closed_at: closed.map(|chain| chain.points().len()) }
    }

    /// True if the knife has continued from a closed outline. Some controllers insert an N inside an outline that is not closed
    /// yet; that is permitted.
    pub(super) fn leads_on(&self, chain: &Chain) -> bool {
        let behind = self.closed_at.and_then(|length| chain.points().get(length..)).unwrap_or_default();
        behind.iter().any(|&at| at != chain.points()[0])
    }

    /// Reports the piece as an error.
    pub(super) fn refuse(&self, out: &mut Diagnostics) {
        let message = "a piece begins while the knife is down: the cut leads on into it";
        let finding = Diagnostic::new(&code::ISO_PIECE_KNIFE_DOWN, message).at(self.span);
        out.push(finding.hint("an M15 is missing before this N; transfer the file again"));
    }
}
