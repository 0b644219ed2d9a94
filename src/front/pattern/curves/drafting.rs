//! Drafting: rule, resolution and limit of the curves of a file.

use super::leg::Stretch;
use super::rule::{Rule, rule_of};
use crate::geom::Point;
use crate::machine::patterns::Curves;

/// Maximum distance of chords from a laid curve, mm.
const CHORDS_OFF: f64 = 0.02;
/// Maximum distance of chords from a trial curve, mm: a fifth of the distance within which a vertex counts as passed.
const TRIED_OFF: f64 = 0.002;
/// Number of repetitions of a ring through which its curve is laid. The ends do not affect the middle repetition, which is
/// used.
const ROUNDS: usize = 3;
/// Maximum number of points of all curves of a file; larger numbers result from damaged coordinates.
const MOST_PLACES: usize = 4_000_000;

/// Rule, resolution and limit of the curves of a file, and the number of their points so far.
#[derive(Debug)]
pub(in crate::front::pattern) struct Drafting {
    /// True if curves are enabled.
    pub(super) is_on: bool,
    pub(super) rule: Rule,
    /// Name of the CAD system with this rule, if known.
    pub(in crate::front::pattern) system: Option<&'static str>,
    /// Maximum distance of chords from their curve, mm.
    sagitta: f64,
    places: usize,
}

impl Drafting {
    /// Drafting for a file of an author. `sagitta` is the maximum distance of chords from their curves, mm.
    pub(in crate::front::pattern) fn of(author: &str, asked: Curves, sagitta: f64) -> Self {
        let (rule, system) = rule_of(author);
        Self { is_on: asked == Curves::Auto, rule, system, sagitta: sagitta.min(CHORDS_OFF), places: 0 }
    }

    /// True if the limit of points is exceeded; some lines then have no curves.
    pub(in crate::front::pattern) fn is_overfull(&self) -> bool {
        self.places > MOST_PLACES
    }

    /// The curve through knots, one stretch from each knot to the next; a ring has a stretch from the last to the first. `None`
    /// beyond the limit of points.
    pub(super) fn spans(&self, knots: &[Point], is_ring: bool) -> Option<Vec<Stretch>> {
        self.curve(knots, is_ring, self.sagitta)
    }

    /// The curve through knots in finer chords, for comparison with vertices. Its points are not counted.
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

    /// Counts the points of a curve that is kept.
    pub(super) fn kept(&mut self, spans: Option<Vec<Stretch>>) -> Option<Vec<Stretch>> {
        self.places += spans.as_ref().map_or(MOST_PLACES + 1, |spans| spans.iter().map(Vec::len).sum());
        spans.filter(is_finite)
    }
}

#[expect(clippy::ptr_arg, reason = "a filter of vectors")]
fn is_finite(spans: &Vec<Stretch>) -> bool {
    spans.iter().flatten().all(|at| at.x.is_finite() && at.y.is_finite())
}
