//! The worst that is seen under each rule.

use super::rows::Row;
use super::rules::{RULES, Rule};
use crate::geom::Point;
use crate::ir::Finding;
use crate::ir::finding::Sighting;

/// The worst that was seen so far: value, limit, place.
#[derive(Debug, Default)]
pub(super) struct Worst(Vec<(Rule, f64, Option<f64>, Option<Sighting>)>);

impl Worst {
    /// Sees a value under a rule, of which so much is allowed; `None` = it is only reported. A value that is not a number is
    /// the worst.
    pub(super) fn see(&mut self, rule: Rule, value: f64, limit: Option<f64>, place: Option<Sighting>) {
        let value = if value.is_nan() { f64::INFINITY } else { value };
        // Of limits that change on the way a value is the worse the farther it is beyond.
        let beyond = |value: f64, limit: Option<f64>| limit.map_or(value, |limit| value - limit);
        match self.0.iter_mut().find(|(known, ..)| *known == rule) {
            Some(worst) if beyond(value, limit) > beyond(worst.1, worst.2) => *worst = (rule, value, limit, place),
            Some(_) => {}
            None => self.0.push((rule, value, limit, place)),
        }
    }

    /// A finding for each rule of which anything was seen, in the order of [`RULES`].
    pub(super) fn findings(self) -> Vec<Finding> {
        let of = |row: &super::rules::Row| {
            let (_, worst, limit, place) = self.0.iter().find(|(rule, ..)| *rule == row.rule)?;
            Some(Finding { rule: row.name, worst: *worst, limit: *limit, unit: row.unit, place: *place })
        };
        RULES.iter().filter_map(of).collect()
    }
}

/// Where and when a row is.
pub(super) fn at(row: &Row) -> Sighting {
    Sighting { time: Some(row.time), line: Some(row.line), point: row.head, block: row.block }
}

/// A place of an edge that no row is about.
pub(super) fn missing(point: Point, block: u32) -> Sighting {
    Sighting { time: None, line: None, point, block }
}
