//! Drafting: the rule, the fineness and the limit of the curves of a file.

use super::leg::Stretch;
use super::rule::{Rule, rule_of};
use crate::geom::Point;
use crate::machine::patterns::Curves;

/// Largest distance of chords from a curve that is laid, mm.
const CHORDS_OFF: f64 = 0.02;
/// Largest distance of chords from the curve of a trial, mm: a fifth of the distance within which a vertex is passed.
const TRIED_OFF: f64 = 0.002;
/// Rounds of a ring through which a curve is laid: the ends no longer bend the one in the middle, which is taken.
const ROUNDS: usize = 3;
/// Largest number of places of all curves of a file: more come from damaged coordinates.
const MOST_PLACES: usize = 4_000_000;

/// Rule, fineness and limit of the curves of a file, and the number of their places so far.
#[derive(Debug)]
pub(in crate::front::pattern) struct Drafting {
    /// Whether curves are asked for.
    pub(super) is_on: bool,
    pub(super) rule: Rule,
    /// Name of the CAD system with this rule, if the file tells it.
    pub(in crate::front::pattern) system: Option<&'static str>,
    /// Largest distance of chords from their curve, mm.
    sagitta: f64,
    places: usize,
}

impl Drafting {
    /// Drafting for a file by an author, with the largest distance of chords from their curves, mm.
    pub(in crate::front::pattern) fn of(author: &str, asked: Curves, sagitta: f64) -> Self {
        let (rule, system) = rule_of(author);
        Self { is_on: asked == Curves::Auto, rule, system, sagitta: sagitta.min(CHORDS_OFF), places: 0 }
    }

    /// Whether the limit of places is exceeded: some lines have no curves then.
    pub(in crate::front::pattern) fn is_overfull(&self) -> bool {
        self.places > MOST_PLACES
    }

    /// Curve through knots, from each to the next, and through a ring of them from the last to the first; `None` beyond the
    /// limit of places.
    pub(super) fn spans(&self, knots: &[Point], is_ring: bool) -> Option<Vec<Stretch>> {
        self.curve(knots, is_ring, self.sagitta)
    }

    /// Curve through knots in finer chords, with which vertices are compared. Its places do not count.
    pub(super) fn trial(&self, knots: &[Point], is_ring: bool) -> Option<Vec<Stretch>> {
        self.curve(knots, is_ring, self.sagitta.min(TRIED_OFF)).filter(is_finite)
    }

    fn curve(&self, knots: &[Point], is_ring: bool, sagitta: f64) -> Option<Vec<Stretch>> {
        let most = MOST_PLACES.saturating_sub(self.places);
        let (count, rounds) = (knots.len(), if is_ring { ROUNDS } else { 1 });
        let mut spans = self.rule.spans(&knots.repeat(rounds), sagitta, most.saturating_mul(rounds))?;
        if is_ring {
            spans = spans.drain(count..2 * count).collect();
        }
        Some(spans)
    }

    /// Counts the places of a curve that is kept.
    pub(super) fn kept(&mut self, spans: Option<Vec<Stretch>>) -> Option<Vec<Stretch>> {
        self.places += spans.as_ref().map_or(MOST_PLACES + 1, |spans| spans.iter().map(Vec::len).sum());
        spans.filter(is_finite)
    }
}

#[expect(clippy::ptr_arg, reason = "a filter of vectors")]
fn is_finite(spans: &Vec<Stretch>) -> bool {
    spans.iter().flatten().all(|at| at.x.is_finite() && at.y.is_finite())
}
