//! Joins of strokes along a line, and their overlaps.
//!
//! A chain is verified as one: where its head lifts the blade at a bend, the strokes before and behind count as one for the
//! head that takes over from it, and for its own start when it comes around.

use super::chain::{Chained, END};
use super::ground::Ground;
use super::lines::Line;
use super::rules;
use crate::ir::verdict::{Sighting, WorstByRule};

/// Relative amount by which the turn of a corner may fall short of the corner angle: rounding.
const CORNER_EPSILON: f64 = 1e-6;

/// Join of two strokes on a line.
pub(super) struct Join<'a> {
    pub(super) line: &'a Line,
    /// Stroke that ends at the join, and stroke that continues.
    pub(super) strokes: [Chained; 2],
    /// Length that both cut, mm.
    pub(super) overlap: f64,
}

impl<'a> Join<'a> {
    /// Join of two consecutive strokes of a chain.
    pub(super) fn within(line: &'a Line, strokes: [Chained; 2]) -> Self {
        let [a, b] = strokes.map(|stroke| stroke.span());
        Self { line, strokes, overlap: a[1].min(b[1]) - a[0].max(b[0]) }
    }

    /// Checks that the length cut twice is not greater than the overlaps need.
    pub(super) fn judge_twice(&self, ground: &Ground, worst: &mut WorstByRule) {
        let knife = &ground.profile.knife;
        let [a, b] = self.strokes.map(|stroke| stroke.cover);
        let rejoined = knife.corner_heel_overlap_mm + knife.corner_front_overlap_mm;
        let blade = if a.plunge || b.plunge { knife.width_mm } else { 0.0 };
        worst.see_under(&rules::TWICE, self.overlap, due(ground).max(rejoined).max(blade) + 2.0 * END, b.place);
    }

    /// Checks the overlap of both; at a corner each continues straight instead.
    pub(super) fn judge_overlap(&self, ground: &Ground, worst: &mut WorstByRule) {
        let [a, b] = self.strokes.map(|stroke| stroke.span());
        let (at, reach) = (f64::midpoint(a[1].min(b[1]), a[0].max(b[0])), due(ground) + END);
        if self.line.corner_near(at) > reach && !self.is_tight([at - reach, at + reach], ground) {
            let place = Sighting { point: self.line.place(at), ..self.strokes[1].cover.place };
            worst.see_under(&rules::OVERLAP, due(ground) - self.of_chains(), END, place);
        }
    }

    /// True if a head passes a bend there that is too tight for its blade: it lifts the blade, or plunges before or behind the
    /// bend, and the blade is longer than the chords of the curve.
    fn is_tight(&self, about: [f64; 2], ground: &Ground) -> bool {
        let [a, b] = self.strokes.map(|stroke| stroke.cover);
        let corner = ground.profile.corner_angle() * (1.0 - CORNER_EPSILON);
        // A plunged blade is off the line at a sharper bend.
        let bend = ground.tolerance() / ground.profile.knife.width_mm;
        let limit = if a.plunge || b.plunge { corner.min(bend) } else { corner };
        a.place.head == b.place.head && self.line.turns_between(about) >= limit
    }

    /// Common length, mm: of the two strokes within one chain, otherwise of both whole chains.
    fn of_chains(&self) -> f64 {
        let [a, b] = &self.strokes;
        if a.is_beside(b) { self.overlap } else { a.whole[1].min(b.whole[1]) - a.whole[0].max(b.whole[0]) }
    }
}

/// Required overlap of two chains, mm.
fn due(ground: &Ground) -> f64 {
    2.0 * ground.profile.flow.overlap_mm
}
