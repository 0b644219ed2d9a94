//! Checks that seams with a number of order are sewn in that order, before all others.

use std::collections::BTreeMap;

use super::ground::{Ground, sighting};
use super::rules;
use crate::ir::verdict::WorstByRule;
use crate::sew::pattern::Pattern;
use crate::sew::stitches::Op;

/// Counts stitches of a seam that belongs before one that has been sewn.
pub(super) fn judge(pattern: &Pattern, ground: &Ground, worst: &mut WorstByRule) {
    let mut turns: BTreeMap<u32, Option<u32>> = BTreeMap::new();
    for seam in &pattern.seams {
        let turn = seam.order.map_or(u32::MAX, u32::from);
        let known = turns.entry(seam.span.block).or_insert(Some(turn));
        // Seams of one block with different numbers cannot be told apart.
        *known = known.filter(|&known| known == turn);
    }
    worst.count(&rules::ORDER, 0, None);
    let mut latest = 0;
    for (step, entry) in ground.stitches.steps.iter().zip(1..).filter(|(step, _)| step.op == Op::Stitch) {
        if let Some(&Some(turn)) = turns.get(&step.record) {
            worst.count(&rules::ORDER, usize::from(turn < latest), sighting(entry, step.to));
            latest = latest.max(turn);
        }
    }
}
