//! Drafting: how the lines of a file get their curves.

use super::leg::Stretch;
use super::rule::{Rule, rule_of};
use crate::geom::Point;
use crate::machine::patterns::Curves;

/// Farthest that chords lie off a curve that is laid, mm.
const CHORDS_OFF: f64 = 0.02;
/// Places of all curves of a file: more come from damaged coordinates.
const MOST_PLACES: usize = 4_000_000;
/// How the lines of a file get their curves, and how many places these have so far.
#[derive(Debug)]
pub(in crate::front::dxf) struct Drafting {
    /// Whether curves are asked for.
    pub(super) is_on: bool,
    pub(super) rule: Rule,
    /// The CAD system whose rule it is, if the file tells.
    pub(in crate::front::dxf) system: Option<&'static str>,
    /// Farthest that chords lie off, mm.
    sagitta: f64,
    places: usize,
}

impl Drafting {
    /// For a file by an author, whose chords lie so far off their curves at the most, mm.
    pub(in crate::front::dxf) fn of(author: &str, asked: Curves, sagitta: f64) -> Self {
        let (rule, system) = rule_of(author);
        Self { is_on: asked == Curves::Auto, rule, system, sagitta: sagitta.min(CHORDS_OFF), places: 0 }
    }

    /// Whether curves have more places than a file can need: then some lines have none.
    pub(in crate::front::dxf) fn is_overfull(&self) -> bool {
        self.places > MOST_PLACES
    }

    /// The curve through knots, in parts.
    pub(super) fn spans(&mut self, knots: &[Point]) -> Option<Vec<Stretch>> {
        let spans = self.rule.spans(knots, self.sagitta, MOST_PLACES.saturating_sub(self.places));
        self.places += spans.as_ref().map_or(MOST_PLACES + 1, |spans| spans.iter().map(Vec::len).sum());
        spans.filter(|spans| spans.iter().flatten().all(|at| at.x.is_finite() && at.y.is_finite()))
    }
}
