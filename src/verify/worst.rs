//! The worst value under a rule, and where it was seen.

use crate::geom::Point;
use crate::ir::Finding;
use crate::ir::finding::Sighting;

/// Collects values and keeps the worst.
#[derive(Debug, Clone)]
pub(super) struct Worst {
    rule: &'static str,
    unit: &'static str,
    limit: Option<f64>,
    value: f64,
    place: Option<Sighting>,
}

impl Worst {
    /// Nothing seen yet under `rule`.
    pub(super) fn new(rule: &'static str, unit: &'static str, limit: Option<f64>) -> Self {
        Self { rule, unit, limit, value: 0.0, place: None }
    }

    /// Sees a value. One that is not a number is worse than any.
    pub(super) fn see(&mut self, value: f64, place: impl FnOnce() -> Sighting) {
        let value = if value.is_nan() { f64::INFINITY } else { value };
        if value > self.value {
            self.value = value;
            self.place = Some(place());
        }
    }

    /// Sees a value that has a limit of its own; infinite = none. The worst is the one that comes nearest to its limit, or
    /// is farthest beyond it.
    pub(super) fn see_under(&mut self, value: f64, limit: f64, place: impl FnOnce() -> Sighting) {
        let value = if value.is_nan() { f64::INFINITY } else { value };
        let is_worse = match (self.limit, limit.is_finite()) {
            // As a product, because nothing may have been seen yet.
            (Some(own), true) => value * own > self.value * limit,
            (Some(_), false) => false,
            (None, true) => value > 0.0,
            (None, false) => value > self.value,
        };
        if is_worse {
            (self.value, self.limit) = (value, Some(limit).filter(|limit| limit.is_finite()));
            self.place = Some(place());
        }
    }

    /// What was seen.
    pub(super) fn finding(self) -> Finding {
        Finding { rule: self.rule, worst: self.value, limit: self.limit, unit: self.unit, place: self.place }
    }
}

/// A sighting in a program.
pub(super) fn at(time: f64, point: Point, block: u32) -> Sighting {
    Sighting { time: Some(time), point, block }
}
