//! Where strokes take over from each other along a line: how far both cut.
//!
//! A chain is judged as one: where its head lifts the blade at a bend, the strokes before and behind that are as good as one to
//! the head that takes over from it, and to its own start where it comes round to that.

use super::chain::{Chained, END};
use super::ground::Ground;
use super::lines::Line;
use super::rules::Rule;
use super::worst::{Place, Worst};

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

impl Join<'_> {
    /// Judges how far both go on.
    pub(super) fn judge(&self, ground: &Ground, worst: &mut Worst) {
        let knife = &ground.profile.knife;
        let [a, b] = self.strokes.map(|stroke| stroke.cover);
        let due = 2.0 * ground.profile.flow.overlap_mm;
        let rejoined = knife.corner_heel_overlap_mm + knife.corner_front_overlap_mm;
        let blade = if a.plunge || b.plunge { knife.width_mm } else { 0.0 };
        worst.see(Rule::Twice, self.overlap, due.max(rejoined).max(blade) + 2.0 * END, Some(b.place));
        let at = f64::midpoint(a.span()[1].min(b.span()[1]), b.span()[0]);
        let reach = due + END;
        if self.line.corner_near(at) > reach && !self.is_tight([at - reach, at + reach], ground) {
            let place = Place { point: self.line.place(at), ..b.place };
            worst.see(Rule::Overlap, due - self.of_all(), END, Some(place));
        }
    }

    /// Whether a head goes round a bend there that is too tight for its blade: it lifts it, or plunges chord by chord, and the
    /// blade is longer than each.
    fn is_tight(&self, about: [f64; 2], ground: &Ground) -> bool {
        let [a, b] = &self.strokes;
        let limit = ground.profile.corner.angle() * (1.0 - CORNER_EPSILON);
        a.is_beside(b) && (a.cover.plunge || b.cover.plunge || self.line.turns_between(about) >= limit)
    }

    /// How much is cut twice there, mm: by strokes of one head behind each other these two alone, else all that goes with
    /// either.
    fn of_all(&self) -> f64 {
        let [a, b] = &self.strokes;
        if a.is_beside(b) { self.overlap } else { a.whole[1].min(b.whole[1]) - b.whole[0] }
    }
}
