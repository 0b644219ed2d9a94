//! Stretches that a ring shares with others, joined from facing edges.

use super::facing::{Facing, Near};
use super::ring::Ring;

/// Greatest gap within a common stretch, in multiples of the merge tolerance: at a corner the feet on one ring miss the other.
pub(super) const BREAK: f64 = 2.0;
/// Number of recently begun stretches that may be continued: few parts lie over each other.
const OPEN: usize = 8;
/// Length below which a stretch counts as empty, mm: rounding.
const LEAST: f64 = 1e-6;

/// Criteria for edges that are cut once.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked {
    /// Criteria for facing edges.
    pub(super) near: Near,
    /// Least length, mm, of one stretch or of consecutive ones together.
    pub(super) min: f64,
    /// Length by which an open cut continues beyond the cut at which it ends, mm.
    pub(super) beyond: f64,
    /// Width of the blade, mm.
    pub(super) width: f64,
    /// Least turn at which the blade is lifted, rad.
    pub(super) corner: f64,
}

impl Asked {
    /// Least length of a stretch that continues another one, mm: it may be shorter than `min`, but not shorter than the blade,
    /// because the rest beside it would be cut by a plunge longer than that.
    pub(super) fn least(self) -> f64 {
        self.width.max(BREAK * self.near.distance).min(self.min)
    }
}

/// Stretch of a ring that is cut with another.
#[derive(Debug, Clone)]
pub(super) struct Shared {
    /// Stations on its own ring, mm; they may extend past its end.
    pub(super) own: [f64; 2],
    /// Index of the other ring, and its stations beside the ends.
    pub(super) other: usize,
    pub(super) theirs: [f64; 2],
    /// Straight parts, in order.
    pub(super) parts: Vec<Facing>,
}

impl Shared {
    /// Moves its start to a station at the earliest, mm; returns `false` if at most `least` is left.
    pub(super) fn begin_at(&mut self, from: f64, least: f64) -> bool {
        if self.own[0] >= from {
            return true;
        }
        self.parts.retain(|part| part.own[1] > from + LEAST);
        if let Some(first) = self.parts.first_mut().filter(|part| part.own[0] < from) {
            *first = first.part([(from - first.own[0]) / first.length(), 1.0]);
        }
        let Some(first) = self.parts.first() else { return false };
        (self.own[0], self.theirs[0]) = (first.own[0], first.theirs[0]);
        self.own[1] - self.own[0] > least
    }
}

/// Stretches that a ring shares with others, from its facing edges. Consecutive ones have no cut between them: together they
/// satisfy the least length.
pub(super) fn stretches(rings: &[Ring], own: &Ring, facing: &[Facing], asked: Asked) -> Vec<Shared> {
    let reach = BREAK * asked.near.distance;
    let mut found: Vec<Shared> = Vec::new();
    let meets = |before: &Shared, next: &Facing| {
        let length = rings[before.other].length();
        let across = (next.theirs[0] - before.theirs[1]).rem_euclid(length);
        before.other == next.other && next.own[0] - before.own[1] <= reach && across.min(length - across) <= reach
    };
    for part in facing {
        match found.iter_mut().rev().take(OPEN).find(|before| meets(before, part)) {
            Some(before) => {
                if part.own[1] > before.own[1] {
                    (before.own[1], before.theirs[1]) = (part.own[1], part.theirs[1]);
                    before.parts.push(*part);
                }
            }
            None => {
                found.push(Shared { own: part.own, other: part.other, theirs: part.theirs, parts: vec![*part] });
            }
        }
    }
    // A stretch over the start of the ring was found in two parts.
    let length = own.length();
    let over = |part: &Facing| Facing { own: part.own.map(|station| station + length), ..*part };
    let begins_late = (1..found.len()).find(|&i| found[i].own[0] > reach).unwrap_or(found.len());
    let joined = |first: usize| {
        let mut later = (first + 1..found.len()).rev();
        later.find(|&last| meets(&found[last], &over(&found[first].parts[0]))).map(|last| [first, last])
    };
    if let Some([first, last]) = (0..begins_late).find_map(joined) {
        let first = found.remove(first);
        let last = &mut found[last - 1];
        last.parts.extend(first.parts.iter().map(over));
        (last.own[1], last.theirs[1]) = (first.own[1] + length, first.theirs[1]);
    }
    found.retain(|shared| shared.own[1] - shared.own[0] > asked.least());
    let chains = chains(&found, length, reach);
    let is_long =
        |station: f64| chains.iter().any(|&[from, to]| from <= station && station <= to && to - from >= asked.min);
    found.retain(|shared| is_long(shared.own[0]));
    found
}

/// Unions of the stretches of a ring of `length`, joined across gaps of at most `reach`.
fn chains(stretches: &[Shared], length: f64, reach: f64) -> Vec<[f64; 2]> {
    let mut ends: Vec<[f64; 2]> = stretches.iter().map(|shared| shared.own).collect();
    ends.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut chains: Vec<[f64; 2]> = Vec::new();
    for [from, to] in ends {
        match chains.last_mut() {
            Some(last) if from - last[1] <= reach => last[1] = last[1].max(to),
            _ => chains.push([from, to]),
        }
    }
    // The last one may continue past the start of the ring.
    if let [first, .., last] = &mut chains[..]
        && first[0] + length - last[1] <= reach
    {
        (first[0], last[1]) = (last[0] - length, first[1] + length);
    }
    chains
}
