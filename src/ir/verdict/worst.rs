//! The worst value under a rule and its sighting, for one rule or for all rules of a machine.

use super::{Finding, Rule, Sighting};

/// Relative amount by which a later value must exceed an earlier one to replace it. Among values that differ by rounding only,
/// the first is the most useful.
const TIE_EPSILON: f64 = 1e-6;

/// Tracks the worst value under a rule.
#[derive(Debug, Clone)]
pub struct Worst {
    rule: &'static Rule,
    unit: &'static str,
    limit: Option<f64>,
    value: f64,
    /// First sighting of the worst value, and its weight there: relative to its limit when values have individual limits.
    place: Option<(Sighting, f64)>,
}

impl Worst {
    /// No value under `rule` yet.
    pub fn new(rule: &'static Rule, limit: Option<f64>) -> Self {
        Self { rule, unit: rule.unit, limit, value: 0.0, place: None }
    }

    /// Uses another unit than that of the rule, for counted items with a name of their own.
    #[must_use]
    pub fn in_unit(self, unit: &'static str) -> Self {
        Self { unit, ..self }
    }

    /// Adds a value. NaN is worse than any number.
    pub fn see(&mut self, value: f64, place: impl FnOnce() -> Sighting) {
        let value = or_infinite(value);
        if value > self.value {
            self.value = value;
            self.note(weight(value, self.limit), place);
        }
    }

    /// Records the place if it is worse than the recorded one.
    fn note(&mut self, badness: f64, place: impl FnOnce() -> Sighting) {
        if self.place.is_none_or(|(_, known)| badness > known * (1.0 + TIE_EPSILON)) {
            self.place = Some((place(), badness));
        }
    }

    /// Adds a value with an individual limit; infinite = none. The worst value is the one nearest to its limit, or farthest
    /// beyond it.
    pub fn see_under(&mut self, value: f64, limit: f64, place: impl FnOnce() -> Sighting) {
        let value = or_infinite(value);
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
                // No value so far had a limit, so they do not compare.
                self.place = None;
            }
            if self.value < value && limit == 0.0 {
                // Any value is equally far beyond a limit of 0: record the greatest.
                self.place = None;
            }
            (self.value, self.limit) = (value, Some(limit).filter(|limit| limit.is_finite()));
            self.note(weight(value, self.limit), place);
        }
    }

    /// Adds the values that were seen later by another tracker.
    pub fn add(&mut self, later: &Self) {
        if let Some((place, _)) = later.place {
            self.see_under(later.value, later.limit.unwrap_or(f64::INFINITY), || place);
        }
    }

    /// The worst value so far.
    pub fn value(&self) -> f64 {
        self.value
    }

    /// The finding: the worst value, its limit and its sighting.
    pub fn finding(self) -> Finding {
        Finding {
            rule: self.rule,
            worst: self.value,
            limit: self.limit,
            unit: self.unit,
            place: self.place.map(|known| known.0),
        }
    }
}

/// Fraction of a limit used by a value: 1 = just permitted; infinite for any value beyond a limit of 0.
fn badness(value: f64, limit: f64) -> f64 {
    if value > 0.0 { value / limit } else { 0.0 }
}

/// Measure by which places are compared: the fraction of the limit, or the value where there is no limit or it is 0.
fn weight(value: f64, limit: Option<f64>) -> f64 {
    limit.filter(|&limit| limit > 0.0).map_or(value, |limit| value / limit)
}

/// The value; infinity for NaN.
fn or_infinite(value: f64) -> f64 {
    if value.is_nan() { f64::INFINITY } else { value }
}

/// The worst value under each rule of a machine for which any value was seen. Among values with individual limits it is the one
/// with the greatest excess.
#[derive(Debug, Default)]
pub struct WorstByRule {
    /// Findings by the index of their rule; `None` under a rule without values.
    findings: Vec<Option<Finding>>,
    /// Excess over the limit by the index of the rule: the value itself for a rule without a limit, NaN for a rule without a
    /// finding.
    excess: Vec<f64>,
}

impl WorstByRule {
    /// Adds a value under a rule that only reports, or whose limit is set in its finding.
    #[inline]
    pub fn see(&mut self, rule: &'static Rule, value: f64, place: impl Into<Option<Sighting>>) {
        self.keep(rule, value, None, place);
    }

    /// Adds a value under a rule with its permitted maximum.
    #[inline]
    pub fn see_under(&mut self, rule: &'static Rule, value: f64, limit: f64, place: impl Into<Option<Sighting>>) {
        self.keep(rule, value, Some(limit), place);
    }

    /// Adds to the count under a rule that permits none.
    pub fn count(&mut self, rule: &'static Rule, number: usize, place: impl Into<Option<Sighting>>) {
        let known = self.findings.get(rule.place).and_then(Option::as_ref).map_or(0.0, |known| known.worst);
        self.see_under(rule, known + number as f64, 0.0, place);
    }

    /// Adds the values seen elsewhere, after those seen here.
    pub fn merge(&mut self, later: Self) {
        for Finding { rule, worst, limit, place, .. } in later.findings.into_iter().flatten() {
            self.keep(rule, worst, limit, place);
        }
    }

    /// Keeps a value with a greater excess than the known one; among equal values the first. Nearly all values are rejected
    /// here, before a finding is made.
    #[inline]
    fn keep(&mut self, rule: &'static Rule, value: f64, limit: Option<f64>, place: impl Into<Option<Sighting>>) {
        let worst = or_infinite(value);
        let excess = limit.map_or(worst, |limit| worst - limit);
        if self.excess.get(rule.place).is_none_or(|&known| known.is_nan() || excess > known) {
            self.put(Finding { rule, worst, limit, unit: rule.unit, place: place.into() }, excess);
        }
    }

    /// Stores a finding at the index of its rule.
    #[cold]
    fn put(&mut self, finding: Finding, excess: f64) {
        let place = finding.rule.place;
        if self.findings.len() <= place {
            self.findings.resize(place + 1, None);
            self.excess.resize(place + 1, f64::NAN);
        }
        (self.findings[place], self.excess[place]) = (Some(finding), excess);
    }

    /// The findings of all rules with values, in the order of the table of rules; negative values become 0.
    pub fn findings(self) -> Vec<Finding> {
        let mut findings: Vec<Finding> = self.findings.into_iter().flatten().collect();
        // `max` may return a negative zero.
        findings.iter_mut().filter(|finding| finding.worst <= 0.0).for_each(|finding| finding.worst = 0.0);
        findings
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;

    static ONE: Rule = Rule { name: "verify/one", unit: "mm", ..Rule::PLAIN };
    static OTHER: Rule = Rule { name: "verify/other", unit: "", place: 1, ..Rule::PLAIN };

    fn at(time: f64) -> Sighting {
        Sighting::at(time, Point::origin(), 0)
    }

    fn told(values: &[f64]) -> (f64, Option<f64>) {
        let mut worst = Worst::new(&ONE, Some(0.0));
        for (&value, time) in values.iter().zip(0..) {
            worst.see(value, || at(f64::from(time)));
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
        let mut worst = Worst::new(&ONE, Some(100.0));
        for (value, limit, time) in [(50.0, 100.0, 0.0), (45.0, 50.0, 1.0), (80.0, 100.0, 2.0), (90.0, 100.0, 3.0)] {
            worst.see_under(value, limit, || at(time));
        }
        let finding = worst.finding();
        assert_eq!((finding.worst, finding.limit), (45.0, Some(50.0)));
        assert_eq!(finding.place.and_then(|place| place.time), Some(1.0));
    }

    #[test]
    fn what_goes_on_from_the_worst_so_far_tells_the_same_as_what_saw_all() {
        for limit in [None, Some(0.0), Some(0.07)] {
            let mut all = Worst::new(&ONE, limit);
            let mut so_far = all.clone();
            for part in [[0.02, 0.05], [0.04, 0.9], [0.95, 0.3]] {
                let mut later = so_far.clone();
                for value in part {
                    all.see(value, || at(value));
                    later.see(value, || at(value));
                }
                so_far.add(&later);
            }
            assert_eq!(so_far.finding(), all.finding(), "{limit:?}");
        }
    }

    #[test]
    fn beyond_a_limit_of_nothing_the_greatest_value_is_told() {
        let mut worst = Worst::new(&ONE, Some(0.0));
        for (value, limit, time) in
            [(0.0, 0.0, 0.0), (0.1, 0.0, 1.0), (0.3, 0.0, 2.0), (0.2, 0.0, 3.0), (0.4, 0.5, 4.0)]
        {
            worst.see_under(value, limit, || at(time));
        }
        let finding = worst.finding();
        assert_eq!((finding.worst, finding.limit), (0.3, Some(0.0)));
        assert_eq!(finding.place.and_then(|place| place.time), Some(2.0));
    }

    #[test]
    fn under_each_rule_the_value_that_is_farthest_beyond_its_limit_is_told_in_the_order_of_the_table() {
        let mut worst = WorstByRule::default();
        for (value, limit, time) in [(3.0, 5.0, 0.0), (2.0, 3.0, 1.0), (4.0, 9.0, 2.0), (1.0, 2.0, 3.0)] {
            worst.see_under(&OTHER, value, limit, at(time));
        }
        let mut later = WorstByRule::default();
        later.see(&ONE, -1.0, None);
        worst.merge(later);
        let findings = worst.findings();
        let told = |finding: &Finding| (finding.worst, finding.limit, finding.place.and_then(|place| place.time));
        assert_eq!(findings.iter().map(told).collect::<Vec<_>>(), [(0.0, None, None), (2.0, Some(3.0), Some(1.0))]);
        assert_eq!(findings[1].rule, &OTHER);
    }

    #[test]
    fn what_is_counted_is_seen_where_the_count_grew_last() {
        let mut worst = WorstByRule::default();
        for (number, time) in [(0, 0.0), (2, 1.0), (1, 2.0), (0, 3.0)] {
            worst.count(&ONE, number, at(time));
        }
        worst.see_under(&OTHER, f64::NAN, 0.0, None);
        let findings = worst.findings();
        assert_eq!(findings.iter().map(|finding| finding.worst).collect::<Vec<_>>(), [3.0, f64::INFINITY]);
        assert_eq!(findings[0].place, Some(at(2.0)));
    }
}
