//! Stretches that a ring has in common with others: what faces it, joined.

use super::facing::{Facing, Near};
use super::ring::Ring;

/// How many distances of two edges what they have in common may be broken: about a corner the feet on the one miss the other.
pub(super) const BREAK: f64 = 2.0;
/// Stretches that were begun last, of which one may go on: few parts lie over each other.
const OPEN: usize = 8;
/// Stretches that are shorter have no length, mm: rounding.
const LEAST: f64 = 1e-6;

/// What is asked of edges that are cut once.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked {
    /// How they must lie.
    pub(super) near: Near,
    /// The shortest, mm: one or several that go on where one ends.
    pub(super) min: f64,
    /// How far an open cut goes beyond what it ends at, mm.
    pub(super) beyond: f64,
    /// Width of the blade, mm.
    pub(super) width: f64,
    /// The least turn at which the blade is lifted, rad.
    pub(super) corner: f64,
}

impl Asked {
    /// Where a stretch goes on from the end of another it may be shorter than `min`, but no shorter than the blade is wide,
    /// mm: what is left beside it would be cut by a plunge longer than it.
    pub(super) fn least(self) -> f64 {
        self.width.max(BREAK * self.near.distance).min(self.min)
    }
}

/// A stretch of a ring that is cut with another.
#[derive(Debug, Clone)]
pub(super) struct Shared {
    /// Its stations; on a ring that may be over its end, mm.
    pub(super) own: [f64; 2],
    /// The other ring, and the stations of that beside its ends.
    pub(super) other: usize,
    pub(super) theirs: [f64; 2],
    /// The straight parts of it, in order.
    pub(super) parts: Vec<Facing>,
}

impl Shared {
    /// Lets it begin at a station at the earliest, mm; `false` when no more than `least` is left.
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

/// The stretches that a ring has in common with others, by what faces it. Where one goes on from the end of another nothing
/// is cut between them: together they are as long as is asked.
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
    // One that goes over the start of the ring was found in two.
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

/// What stretches of a ring of a length cover together, where each begins no farther than `reach` behind another's end.
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
    // The last one may go on over the start of the ring.
    if let [first, .., last] = &mut chains[..]
        && first[0] + length - last[1] <= reach
    {
        (first[0], last[1]) = (last[0] - length, first[1] + length);
    }
    chains
}
