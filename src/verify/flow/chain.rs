//! What strokes cut of a line, and the chains that they make: what a head cuts without leaving the line.

use crate::ir::verdict::Sighting;

/// How far smoothing and rounding may draw the end of a stroke back from where it should be, mm.
pub(super) const END: f64 = 0.3;

/// What a stroke cuts of a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cover {
    /// From where to where, mm along the line; round a closed one it goes on.
    pub(super) ends: [f64; 2],
    /// Which stroke of its head it is, from 0.
    pub(super) number: usize,
    /// Whether the blade only plunges.
    pub(super) plunge: bool,
    /// Where it starts in the program.
    pub(super) place: Sighting,
}

impl Cover {
    /// The least and the greatest place along the line, mm.
    pub(super) fn span(&self) -> [f64; 2] {
        let [a, b] = self.ends;
        [a.min(b), a.max(b)]
    }

    /// The same as it is counted elsewhere along a closed line.
    pub(super) fn moved(self, by: f64) -> Self {
        Self { ends: self.ends.map(|station| station + by), ..self }
    }

    /// Whether it goes the other way along the line than another one.
    fn is_against(&self, other: &Self) -> bool {
        let way = |cover: &Self| if cover.plunge { 0.0 } else { cover.ends[1] - cover.ends[0] };
        way(self) * way(other) < 0.0
    }
}

/// A stroke in its chain: those that a head makes behind each other without leaving a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chained {
    /// What it cuts.
    pub(super) cover: Cover,
    /// The number of the first stroke of the chain.
    first: usize,
    /// The least and the greatest place of the chain, mm along the line as the stroke's own.
    pub(super) whole: [f64; 2],
}

impl Chained {
    /// The least and the greatest place of the stroke along the line, mm.
    pub(super) fn span(&self) -> [f64; 2] {
        self.cover.span()
    }

    /// The same as it is counted elsewhere along a closed line.
    pub(super) fn moved(self, by: f64) -> Self {
        Self { cover: self.cover.moved(by), whole: self.whole.map(|station| station + by), ..self }
    }

    /// Whether both are of one chain.
    pub(super) fn is_of(&self, other: &Self) -> bool {
        (self.cover.place.head, self.first) == (other.cover.place.head, other.first)
    }

    /// The same, and neither is counted a turn farther round a closed line.
    pub(super) fn is_beside(&self, other: &Self) -> bool {
        self.is_of(other) && (self.whole[0] - other.whole[0]).abs() < END
    }
}

/// Finds the chains of the strokes along a line, which has a length when it is closed; they come head by head, in the order of
/// their numbers. Each stroke of a chain begins no more than `uncut` mm from what the one before has cut, and goes the same way.
pub(super) fn chained(covers: &[Cover], round: Option<f64>, uncut: f64) -> Vec<Chained> {
    let mut strokes: Vec<Chained> = Vec::new();
    for &cover in covers {
        let alone = Chained { cover, first: cover.number, whole: cover.span() };
        let before = strokes
            .last()
            .filter(|last| (last.cover.place.head, last.cover.number + 1) == (cover.place.head, cover.number));
        let Some(before) = before else {
            strokes.push(alone);
            continue;
        };
        // Round a closed line it is counted on from where the stroke before it ends.
        let turn = round.map_or(0.0, |length| ((before.cover.ends[1] - cover.ends[0]) / length).round() * length);
        let next = alone.moved(turn);
        let ([low, high], [from, to]) = (before.span(), next.span());
        let goes_on = from <= high + uncut && to >= low - uncut && !cover.is_against(&before.cover);
        strokes.push(if goes_on { Chained { first: before.first, ..next } } else { alone });
    }
    for one in strokes.chunk_by_mut(Chained::is_of) {
        let spans = one.iter().map(Chained::span);
        let whole = spans.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or_default();
        for stroke in one {
            stroke.whole = whole;
        }
    }
    strokes
}
