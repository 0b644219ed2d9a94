//! Parts of a line that strokes cut, and chains of strokes: consecutive strokes of a head that stay on the line.

use crate::ir::verdict::Sighting;

/// Greatest distance by which smoothing and rounding may draw back the end of a stroke, mm.
pub(super) const END: f64 = 0.3;

/// Part of a line that a stroke cuts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cover {
    /// Start and end, mm along the line; on a closed line, stations continue past its length.
    pub(super) ends: [f64; 2],
    /// Index of the stroke among those of its head, from 0.
    pub(super) number: usize,
    /// True if the blade only plunges.
    pub(super) plunge: bool,
    /// Start of the stroke in the program.
    pub(super) place: Sighting,
}

impl Cover {
    /// Least and greatest station, mm.
    pub(super) fn span(&self) -> [f64; 2] {
        let [a, b] = self.ends;
        [a.min(b), a.max(b)]
    }

    /// Cover with all stations shifted by `by` mm, for another turn of a closed line.
    pub(super) fn moved(self, by: f64) -> Self {
        Self { ends: self.ends.map(|station| station + by), ..self }
    }

    /// True if it runs along the line in the opposite direction of another one.
    fn is_against(&self, other: &Self) -> bool {
        let way = |cover: &Self| if cover.plunge { 0.0 } else { cover.ends[1] - cover.ends[0] };
        way(self) * way(other) < 0.0
    }
}

/// Stroke in its chain; a chain is a sequence of consecutive strokes of a head that stay on the line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chained {
    /// Part of the line that the stroke cuts.
    pub(super) cover: Cover,
    /// Index of the first stroke of the chain.
    first: usize,
    /// Least and greatest station of the chain, mm, counted like those of the stroke.
    pub(super) whole: [f64; 2],
}

impl Chained {
    /// Least and greatest station of the stroke, mm.
    pub(super) fn span(&self) -> [f64; 2] {
        self.cover.span()
    }

    /// Stroke with all stations shifted by `by` mm, for another turn of a closed line.
    pub(super) fn moved(self, by: f64) -> Self {
        Self { cover: self.cover.moved(by), whole: self.whole.map(|station| station + by), ..self }
    }

    /// True if both belong to the same chain.
    pub(super) fn is_of(&self, other: &Self) -> bool {
        (self.cover.place.head, self.first) == (other.cover.place.head, other.first)
    }

    /// True if both belong to the same chain and are counted on the same turn of a closed line.
    pub(super) fn is_beside(&self, other: &Self) -> bool {
        self.is_of(other) && (self.whole[0] - other.whole[0]).abs() < END
    }
}

/// Groups the strokes along a line into chains. `covers` come head by head in the order of their indices; `round` is the length
/// of a closed line. Each stroke of a chain begins within `uncut` mm of the part that the previous one has cut, and runs in the
/// same direction.
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
        // On a closed line, stations continue from the end of the previous stroke.
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
