//! Signs that a knife code was lost: places that are passed in the air for nothing, and a piece that begins amid a cut.

use super::chain::Chain;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::Span;

/// Places in a row that nothing is done at before they look like a cut: the shortest one has two.
const LEAST_PLACES: usize = 2;

/// Rows of places that the knife passes in the air, and nothing is done at them.
#[derive(Debug, Default)]
pub(super) struct Uncut {
    /// Of the row that may go on: how many places, and the block of the first.
    places: usize,
    start: Span,
    /// Rows that ended so, and the first of them.
    rows: usize,
    first: Option<Span>,
}

impl Uncut {
    /// The knife comes to a place in the air.
    pub(super) fn pass(&mut self, span: Span) {
        if self.places == 0 {
            self.start = span;
        }
        self.places += 1;
    }

    /// Something is done there: a plunge, a hole, a label.
    pub(super) fn settle(&mut self) {
        self.places = 0;
    }

    /// A lift or a piece comes, and nothing was done.
    pub(super) fn end(&mut self) {
        if self.places >= LEAST_PLACES {
            self.rows += 1;
            self.first.get_or_insert(self.start);
        }
        self.places = 0;
    }

    /// Names them.
    pub(super) fn report(&self, out: &mut Diagnostics) {
        let Some(first) = self.first else { return };
        let times = if self.rows == 1 { "once".to_owned() } else { format!("{} times", self.rows) };
        let message = format!("places in a row are passed with the knife up, and nothing is cut: this happens {times}");
        let finding = Diagnostic::new(&code::ISO_UNCUT_PLACES, message).at(first);
        out.push(finding.hint("an M14 may be missing behind the first of them: then a piece or a cut-out is lost"));
    }
}

/// A piece that begins when the knife is lifted.
#[derive(Debug)]
pub(super) struct Deferred {
    pub(super) number: Option<u32>,
    pub(super) span: Span,
    /// Vertices of the chain that was cut when its N came, if it was closed by then.
    pub(super) closed_at: Option<usize>,
}

impl Deferred {
    /// A piece whose N comes while `chain` is cut.
    pub(super) fn new(number: Option<u32>, span: Span, chain: Option<&Chain>) -> Self {
        let closed = chain.filter(|chain| chain.ends().0 == chain.ends().1 && !chain.is_point());
        Self { number, span, closed_at: closed.map(|chain| chain.points().len()) }
    }

    /// Whether the knife has cut on from an outline that had closed: some controllers insert an N amid an outline, and
    /// that one goes on.
    pub(super) fn leads_on(&self, chain: &Chain) -> bool {
        let behind = self.closed_at.and_then(|length| chain.points().get(length..)).unwrap_or_default();
        behind.iter().any(|&at| at != chain.points()[0])
    }

    /// Refuses it.
    pub(super) fn refuse(&self, out: &mut Diagnostics) {
        let message = "a piece begins while the knife is down: the cut leads on into it";
        let finding = Diagnostic::new(&code::ISO_PIECE_KNIFE_DOWN, message).at(self.span);
        out.push(finding.hint("an M15 is missing before this N; transfer the file again"));
    }
}
