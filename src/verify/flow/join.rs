//! Where strokes take over from each other along a line: how far both cut.
//!
//! A chain is judged as one: where its head lifts the blade at a bend, the strokes before and behind that are as good as one to
//! the head that takes over from it, and to its own start where it comes round to that.

use super::chain::{Chained, END};
use super::ground::Ground;
use super::lines::Line;
use super::rules;
use crate::ir::verdict::{Sighting, WorstByRule};

/// Part of the angle of a corner by which its turn may be less: rounding.
const CORNER_EPSILON: f64 = 1e-6;

/// Where two strokes meet on a line.
pub(super) struct Join<'a> {
    pub(super) line: &'a Line,
    /// The one that ends there, and the one that goes on.
    pub(super) strokes: [Chained; 2],
    /// How much both cut, mm.
    pub(super) overlap: f64,
}

impl<'a> Join<'a> {
    /// Between two strokes behind each other in their chain.
    pub(super) fn within(line: &'a Line, strokes: [Chained; 2]) -> Self {
        let [a, b] = strokes.map(|stroke| stroke.span());
        Self { line, strokes, overlap: a[1].min(b[1]) - a[0].max(b[0]) }
    }

    /// Judges that no more is cut twice than what overlaps need.
    pub(super) fn judge_twice(&self, ground: &Ground, worst: &mut WorstByRule) {
        let knife = &ground.profile.knife;
        let [a, b] = self.strokes.map(|stroke| stroke.cover);
        let rejoined = knife.corner_heel_overlap_mm + knife.corner_front_overlap_mm;
        let blade = if a.plunge || b.plunge { knife.width_mm } else { 0.0 };
        worst.see_under(&rules::TWICE, self.overlap, due(ground).max(rejoined).max(blade) + 2.0 * END, b.place);
    }

    /// Judges how far both go on; at a corner each goes straight on.
    pub(super) fn judge_overlap(&self, ground: &Ground, worst: &mut WorstByRule) {
        let [a, b] = self.strokes.map(|stroke| stroke.span());
        let (at, reach) = (f64::midpoint(a[1].min(b[1]), a[0].max(b[0])), due(ground) + END);
        if self.line.corner_near(at) > reach && !self.is_tight([at - reach, at + reach], ground) {
            let place = Sighting { point: self.line.place(at), ..self.strokes[1].cover.place };
            worst.see_under(&rules::OVERLAP, due(ground) - self.of_chains(), END, place);
        }
    }

    /// Whether a head goes round a bend there that is too tight for its blade: it lifts it, or plunges before or behind it, and
    /// the blade is longer than each chord of a curve.
    fn is_tight(&self, about: [f64; 2], ground: &Ground) -> bool {
        let [a, b] = self.strokes.map(|stroke| stroke.cover);
        let corner = ground.profile.corner_angle() * (1.0 - CORNER_EPSILON);
        // A plunged blade stands off a bend of more than that.
        let bend = ground.tolerance() / ground.profile.knife.width_mm;
        let limit = if a.plunge || b.plunge { corner.min(bend) } else { corner };
        a.place.head == b.place.head && self.line.turns_between(about) >= limit
    }

    /// How much both cut there, mm: of one chain the two strokes, else all of either chain.
    fn of_chains(&self) -> f64 {
        let [a, b] = &self.strokes;
        if a.is_beside(b) { self.overlap } else { a.whole[1].min(b.whole[1]) - a.whole[0].max(b.whole[0]) }
    }
}

/// How much two chains must overlap, mm.
fn due(ground: &Ground) -> f64 {
    2.0 * ground.profile.flow.overlap_mm
}
