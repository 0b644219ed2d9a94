//! The worst that is seen under each rule.

use super::rules::{RULES, Row, Rule};
use crate::geom::Point;
use crate::ir::Finding;
use crate::ir::finding::Sighting;

/// Where something is seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    /// The head, from 1; 0 = none.
    pub(super) head: usize,
    /// The row or record, from 0.
    pub(super) row: usize,
    /// Its time, s.
    pub(super) time: f64,
    /// On the cloth, mm.
    pub(super) point: Point,
}

/// What was seen under a rule, and whose program it was in.
#[derive(Debug, Clone, PartialEq)]
pub struct Seen {
    /// The worst value.
    pub finding: Finding,
    /// The head, from 1, if it is one's.
    pub head: Option<usize>,
}

/// The worst that was seen so far: in excess of what is allowed there, with the value and what is allowed.
#[derive(Debug)]
pub(super) struct Worst(Vec<Option<Sight>>);

/// A value, what is allowed, and where it was seen.
type Sight = ([f64; 2], Option<Place>);

impl Worst {
    pub(super) fn new() -> Self {
        Self(vec![None; RULES.len()])
    }

    /// Sees a value under a rule, and what is allowed. A value that is not a number is the worst.
    pub(super) fn see(&mut self, rule: Rule, value: f64, allowed: f64, place: Option<Place>) {
        let value = if value.is_nan() { f64::INFINITY } else { value };
        let worst = &mut self.0[rule as usize];
        if worst.is_none_or(|([worst, limit], _)| value - allowed > worst - limit) {
            *worst = Some(([value, allowed], place));
        }
    }

    /// Sees all that was seen elsewhere, after what was seen here.
    pub(super) fn merge(&mut self, other: Self) {
        for (rule, sight) in RULES.iter().zip(other.0) {
            if let Some(([value, allowed], place)) = sight {
                self.see(rule.rule, value, allowed, place);
            }
        }
    }

    /// Counts what must not be.
    pub(super) fn count(&mut self, rule: Rule, number: usize, place: Option<Place>) {
        let so_far = self.0[rule as usize].map_or(0.0, |([count, _], _)| count);
        self.see(rule, so_far + number as f64, 0.0, place);
    }

    /// A finding for each rule of which anything was seen.
    pub(super) fn findings(self) -> Vec<Seen> {
        let seen = |(seen, row): (Option<Sight>, &Row)| {
            let ([worst, limit], place) = seen?;
            let sighting = |place: Place| Sighting {
                time: Some(place.time),
                line: (place.head > 0).then_some(place.row as u64 + 1),
                point: place.point,
                block: 0,
            };
            let finding = Finding {
                rule: row.name,
                worst: worst.max(0.0),
                limit: Some(limit),
                unit: row.unit,
                place: place.map(sighting),
            };
            Some(Seen { finding, head: place.map(|place| place.head).filter(|&head| head > 0) })
        };
        self.0.into_iter().zip(RULES).filter_map(seen).collect()
    }
}
