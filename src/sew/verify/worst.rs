//! The worst that is seen under each rule.

use super::rules::{RULES, Rule};
use crate::geom::Point;
use crate::ir::Finding;
use crate::ir::finding::Sighting;
use crate::machine::Sewing;

/// Where something is seen: the entry, from 1, and its place.
pub(super) type Place = (u32, Point);

/// The worst that was seen so far.
#[derive(Debug)]
pub(super) struct Worst(Vec<Option<(f64, Option<Place>)>>);

impl Worst {
    pub(super) fn new() -> Self {
        Self(vec![None; RULES.len()])
    }

    /// Sees a value under a rule. A value that is not a number is the worst.
    pub(super) fn see(&mut self, rule: Rule, value: f64, place: Option<Place>) {
        let value = if value.is_nan() { f64::INFINITY } else { value };
        let worst = &mut self.0[rule as usize];
        if worst.is_none_or(|(worst, _)| value > worst) {
            *worst = Some((value, place));
        }
    }

    /// Adds to a count.
    pub(super) fn count(&mut self, rule: Rule, number: f64, place: Option<Place>) {
        let so_far = self.0[rule as usize].map_or(0.0, |(count, _)| count);
        self.see(rule, so_far + number, place);
    }

    /// A finding for each rule of which anything was seen.
    pub(super) fn findings(self, sewing: &Sewing) -> Vec<Finding> {
        let finding = |(seen, row): (Option<(f64, Option<Place>)>, &super::rules::Row)| {
            let (worst, place) = seen?;
            let sighting = |(entry, point): Place| Sighting { time: None, line: Some(entry.into()), point, block: 0 };
            Some(Finding {
                rule: row.name,
                worst: worst.max(0.0),
                limit: Some(row.rule.limit(sewing)),
                unit: row.unit,
                place: place.map(sighting),
            })
        };
        self.0.into_iter().zip(RULES).filter_map(finding).collect()
    }
}
