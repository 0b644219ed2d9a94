//! The worst value under a rule, and where it was seen.

use crate::geom::Point;
use crate::ir::Finding;
use crate::ir::finding::Sighting;

/// Part of a value by which a later one must exceed it to be told in its place: of values that only rounding tells
/// apart the first is the one to look at.
const TIE_EPSILON: f64 = 1e-6;

/// Collects values and keeps the worst.
#[derive(Debug, Clone)]
pub(super) struct Worst {
    rule: &'static str,
    unit: &'static str,
    limit: Option<f64>,
    value: f64,
    /// Where the worst was seen first, and how bad it was there: against its limit when values have limits of their own.
    place: Option<(Sighting, f64)>,
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
            self.note(weight(value, self.limit), place);
        }
    }

    /// Notes the place of what is the worst so far, unless that is no worse than at the place that is known.
    fn note(&mut self, badness: f64, place: impl FnOnce() -> Sighting) {
        if self.place.is_none_or(|(_, known)| badness > known * (1.0 + TIE_EPSILON)) {
            self.place = Some((place(), badness));
        }
    }

    /// Sees a value that has a limit of its own; infinite = none. The worst is the one that comes nearest to its limit, or
    /// is farthest beyond it.
    pub(super) fn see_under(&mut self, value: f64, limit: f64, place: impl FnOnce() -> Sighting) {
        let value = if value.is_nan() { f64::INFINITY } else { value };
        let is_worse = match (self.limit, limit.is_finite()) {
            (Some(own), true) if own > 0.0 && limit > 0.0 => value * own > self.value * limit,
            (Some(own), true) => {
                let (bad, known) = (badness(value, limit), badness(self.value, own));
                bad > known || bad.is_infinite() && value > self.value
            }
            (Some(_), false) => false,
            (None, true) => value > 0.0,
            (None, false) => value > self.value,
        };
        if is_worse {
            if self.limit.is_some() != limit.is_finite() {
                // Of the values so far none had a limit: they do not compare.
                self.place = None;
            }
            if self.value < value && limit == 0.0 {
                // Any value is beyond it alike: the greatest has the place.
                self.place = None;
            }
            (self.value, self.limit) = (value, Some(limit).filter(|limit| limit.is_finite()));
            self.note(weight(value, self.limit), place);
        }
    }

    /// Takes what was seen later.
    pub(super) fn add(&mut self, later: &Self) {
        if let Some((place, _)) = later.place {
            self.see_under(later.value, later.limit.unwrap_or(f64::INFINITY), || place);
        }
    }

    /// The worst value so far.
    pub(super) fn value(&self) -> f64 {
        self.value
    }

    /// What was seen.
    pub(super) fn finding(self) -> Finding {
        Finding {
            rule: self.rule,
            worst: self.value,
            limit: self.limit,
            unit: self.unit,
            place: self.place.map(|known| known.0),
        }
    }
}

/// How bad a value is against a limit: 1 = just allowed; any value is infinitely beyond a limit of nothing.
fn badness(value: f64, limit: f64) -> f64 {
    if value > 0.0 { value / limit } else { 0.0 }
}

/// What values at places are compared by: part of the limit, or the value where there is none or any is infinitely beyond.
fn weight(value: f64, limit: Option<f64>) -> f64 {
    limit.filter(|&limit| limit > 0.0).map_or(value, |limit| value / limit)
}

/// A sighting in a program.
pub(super) fn at(time: f64, point: Point, block: u32) -> Sighting {
    Sighting { time: Some(time), line: None, point, block }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(values: &[f64]) -> (f64, Option<f64>) {
        let mut worst = Worst::new("verify/time", "s", Some(0.0));
        for (&value, time) in values.iter().zip(0..) {
            worst.see(value, || at(f64::from(time), Point::origin(), 0));
        }
        let finding = worst.finding();
        (finding.worst, finding.place.and_then(|place| place.time))
    }

    #[test]
    fn of_values_that_rounding_tells_apart_the_first_is_told() {
        assert_eq!(told(&[0.0, 1e-12, 0.001, 0.001 + 1e-15, 0.000_9]), (0.001 + 1e-15, Some(2.0)));
        assert_eq!(told(&[0.001, 0.002, 0.002]), (0.002, Some(1.0)));
        assert_eq!(told(&[f64::NAN, f64::INFINITY]), (f64::INFINITY, Some(0.0)));
        assert_eq!(told(&[0.0, 0.0]), (0.0, None));
    }

    #[test]
    fn a_value_near_its_own_limit_is_worse_than_a_greater_one_far_from_its() {
        let mut worst = Worst::new("verify/feed", "mm/s", Some(100.0));
        for (value, limit, time) in [(50.0, 100.0, 0.0), (45.0, 50.0, 1.0), (80.0, 100.0, 2.0), (90.0, 100.0, 3.0)] {
            worst.see_under(value, limit, || at(time, Point::origin(), 0));
        }
        let finding = worst.finding();
        assert_eq!((finding.worst, finding.limit), (45.0, Some(50.0)));
        assert_eq!(finding.place.and_then(|place| place.time), Some(1.0));
    }

    #[test]
    fn what_goes_on_from_the_worst_so_far_tells_the_same_as_what_saw_all() {
        for limit in [None, Some(0.0), Some(0.07)] {
            let mut all = Worst::new("verify/on-path", "mm", limit);
            let mut so_far = all.clone();
            for part in [[0.02, 0.05], [0.04, 0.9], [0.95, 0.3]] {
                let mut later = so_far.clone();
                for value in part {
                    all.see(value, || at(value, Point::origin(), 0));
                    later.see(value, || at(value, Point::origin(), 0));
                }
                so_far.add(&later);
            }
            assert_eq!(so_far.finding(), all.finding(), "{limit:?}");
        }
    }

    #[test]
    fn beyond_a_limit_of_nothing_the_greatest_value_is_told() {
        let mut worst = Worst::new("verify/overcut-neighbour", "mm", Some(0.0));
        for (value, limit, time) in
            [(0.0, 0.0, 0.0), (0.1, 0.0, 1.0), (0.3, 0.0, 2.0), (0.2, 0.0, 3.0), (0.4, 0.5, 4.0)]
        {
            worst.see_under(value, limit, || at(time, Point::origin(), 0));
        }
        let finding = worst.finding();
        assert_eq!((finding.worst, finding.limit), (0.3, Some(0.0)));
        assert_eq!(finding.place.and_then(|place| place.time), Some(2.0));
    }
}
