//! Parts of each line that have been cut, and how often.

use std::collections::BTreeMap;

use arrayvec::ArrayVec;
use rayon::prelude::*;

use crate::ir::Finding;
use crate::ir::verdict::{Sighting, Worst};
use crate::machine::MachineProfile;
use crate::verify::program::row::PLACE_ROUNDING;
use crate::verify::reference::common::Common;
use crate::verify::reference::line::Line;
use crate::verify::reference::lines::Reference;
use crate::verify::rules;

/// Number of lines per parallel task.
const LINES_AT_A_TIME: usize = 8192;

/// Stretches of each line that were cut.
#[derive(Debug)]
pub(in crate::verify) struct Coverage<'a> {
    reference: &'a Reference<'a>,
    cut: Vec<Stretches>,
    /// Stretches cut by a moving blade, not by a plunge cut.
    ways: Vec<Stretches>,
    /// Stretches that lay on a plunged blade itself, not only within the tolerance beside one.
    cores: Vec<Stretches>,
    /// Greatest distance that a blade has gone past the start and the end of each line, mm.
    beyond: Vec<[f64; 2]>,
}

/// Disjoint stretches of a line, as station ranges in order.
#[derive(Debug, Clone)]
enum Stretches {
    /// Single stretch, the usual case: the line is cut by one stroke.
    One([f64; 2]),
    Many(Vec<[f64; 2]>),
}

impl Stretches {
    const NONE: Self = Self::Many(Vec::new());

    fn all(&self) -> &[[f64; 2]] {
        match self {
            Self::One(stretch) => std::slice::from_ref(stretch),
            Self::Many(stretches) => stretches,
        }
    }

    /// Adds a stretch and joins it with those that it touches.
    fn merge(&mut self, [a, b]: [f64; 2]) {
        if b < a {
            return;
        }
        let cut = self.all();
        let first = cut.partition_point(|s| s[1] < a);
        let last = first + cut[first..].partition_point(|s| s[0] <= b);
        let joined = cut[first..last].iter().fold([a, b], |[a, b], s| [a.min(s[0]), b.max(s[1])]);
        match self {
            Self::Many(cut) if !cut.is_empty() => drop(cut.splice(first..last, [joined])),
            Self::One(cut) if first == last => {
                *self = Self::Many(if first == 0 { vec![joined, *cut] } else { vec![*cut, joined] });
            }
            Self::One(_) | Self::Many(_) => *self = Self::One(joined),
        }
    }
}

impl<'a> Coverage<'a> {
    /// Coverage before anything is cut.
    pub(in crate::verify) fn new(reference: &'a Reference) -> Self {
        let none = vec![Stretches::NONE; reference.lines.len()];
        let beyond = vec![[0.0; 2]; reference.lines.len()];
        Self { reference, cut: none.clone(), ways: none.clone(), cores: none, beyond }
    }

    /// Records that a blade goes past the start (0) or the end (1) of a line by `beyond` mm.
    pub(in crate::verify) fn see_beyond(&mut self, line: usize, end: usize, beyond: f64) {
        self.beyond[line][end] = self.beyond[line][end].max(beyond);
    }

    /// Greatest distance that a blade has gone past the start (0) or the end (1) of a line, mm.
    pub(in crate::verify) fn beyond(&self, line: usize, end: usize) -> f64 {
        self.beyond[line][end]
    }

    /// Length of the stretches that was not cut before, mm.
    pub(in crate::verify) fn fresh(&self, line: usize, stretches: &[[f64; 2]]) -> f64 {
        let parts = stretches.iter().flat_map(|s| self.on_line(line, *s));
        parts.map(|[a, b]| (b - a) - covered(self.cut[line].all(), a, b)).sum()
    }

    /// Length of the stretches that a moving blade had cut before, mm.
    pub(in crate::verify) fn passed(&self, line: usize, stretches: &[[f64; 2]]) -> f64 {
        let parts = stretches.iter().flat_map(|s| self.on_line(line, *s));
        parts.map(|[a, b]| covered(self.ways[line].all(), a, b)).sum()
    }

    /// Length of the stretches that no blade has passed or lain on, mm. Parts where both happened are subtracted twice, which
    /// makes the check stricter.
    pub(in crate::verify) fn untouched(&self, line: usize, stretches: &[[f64; 2]]) -> f64 {
        let covered = |[a, b]: [f64; 2]| covered(self.ways[line].all(), a, b) + covered(self.cores[line].all(), a, b);
        let parts = stretches.iter().flat_map(|stretch| self.on_line(line, *stretch));
        parts.map(|part| (part[1] - part[0]) - covered(part)).sum()
    }

    /// Records stretches that lay on a plunged blade.
    pub(in crate::verify) fn add_cores(&mut self, line: usize, stretches: &[[f64; 2]]) {
        for part in stretches.iter().flat_map(|stretch| self.on_line(line, *stretch)).collect::<Vec<_>>() {
            self.cores[line].merge(part);
        }
    }

    /// Length of a line that was cut, mm.
    pub(in crate::verify) fn length(&self, line: usize) -> f64 {
        self.cut[line].all().iter().map(|[a, b]| b - a).sum()
    }

    /// Records stretches as cut, by a moving blade or by a plunge cut.
    pub(in crate::verify) fn add(&mut self, line: usize, stretches: &[[f64; 2]], is_plunge_cut: bool) {
        for part in stretches.iter().flat_map(|stretch| self.on_line(line, *stretch)).collect::<Vec<_>>() {
            self.cut[line].merge(part);
            if !is_plunge_cut {
                self.ways[line].merge(part);
            }
        }
    }

    /// Part of a stretch inside the line; on a ring, mapped to its first lap.
    fn on_line(&self, line: usize, [a, b]: [f64; 2]) -> ArrayVec<[f64; 2], 2> {
        let line = &self.reference.lines[line];
        let length = line.length();
        if !line.ring {
            return ArrayVec::from_iter([[a.max(0.0), b.min(length)]]);
        }
        if b - a >= length {
            return ArrayVec::from_iter([[0.0, length]]);
        }
        let lap = (a / length).floor() * length;
        let (a, b) = (a - lap, b - lap);
        let over = (b > length).then_some([0.0, b - length]);
        std::iter::once([a, b.min(length)]).chain(over).collect()
    }

    /// Numbers of the pieces of which nothing is cut.
    pub(in crate::verify) fn uncut(&self) -> Vec<u32> {
        let mut pieces: BTreeMap<u32, bool> = BTreeMap::new();
        for (line, cut) in self.reference.lines.iter().zip(&self.cut).filter(|(line, _)| !line.cut.is_edge) {
            *pieces.entry(line.piece).or_default() |= !cut.all().is_empty();
        }
        pieces.into_iter().filter(|(_, is_cut)| !is_cut).map(|(piece, _)| piece).collect()
    }

    /// Finding on the longest stretch that was left uncut.
    pub(in crate::verify) fn finding(self, common: &Common, profile: &MachineProfile) -> Finding {
        let limit = limit(profile);
        let nothing = Worst::new(&rules::COMPLETE, Some(limit));
        let of_lines = |(lines, cuts): (&[Line], &[Stretches])| {
            let mut worst = nothing.clone();
            for (line, cut) in lines.iter().zip(cuts).filter(|(line, _)| !line.cut.is_edge) {
                see_uncut(line, cut.all(), &mut worst);
            }
            worst
        };
        let lines = self.reference.lines.par_chunks(LINES_AT_A_TIME).zip(self.cut.par_chunks(LINES_AT_A_TIME));
        let mut worst = nothing.clone();
        for of_some in lines.map(of_lines).collect::<Vec<Worst>>() {
            worst.add(&of_some);
        }
        for &(length, place) in &common.uncut {
            worst.see(length, || place);
        }
        worst.finding()
    }
}

/// Longest stretch that may be left uncut, mm: rounding may separate two ends that meet.
pub(in crate::verify) fn limit(profile: &MachineProfile) -> f64 {
    profile.verify.max_uncut_mm + 2.0 * PLACE_ROUNDING
}

/// Records the lengths of the stretches of a line that were left uncut.
fn see_uncut(line: &Line, cut: &[[f64; 2]], worst: &mut Worst) {
    let mut from = 0.0;
    for &[a, b] in cut.iter().chain(std::iter::once(&[line.length(), line.length()])) {
        worst.see(a - from, || {
            let middle = f64::midpoint(a, from);
            Sighting::missing(line.place(middle), line.block(line.chord_at(middle)))
        });
        from = from.max(b);
    }
}

/// Length of `[a, b]` that the stretches cover, mm.
fn covered(cut: &[[f64; 2]], a: f64, b: f64) -> f64 {
    let first = cut.partition_point(|s| s[1] < a);
    cut[first..].iter().take_while(|s| s[0] < b).map(|s| (s[1].min(b) - s[0].max(a)).max(0.0)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretches_are_joined_and_measured() {
        let mut cut = Stretches::NONE;
        for (stretch, so_far) in [
            ([5.0, 6.0], &[[5.0, 6.0]][..]),
            ([6.0, 6.5], &[[5.0, 6.5]]),
            ([0.0, 1.0], &[[0.0, 1.0], [5.0, 6.5]]),
            ([8.0, 9.0], &[[0.0, 1.0], [5.0, 6.5], [8.0, 9.0]]),
            ([5.5, 7.0], &[[0.0, 1.0], [5.0, 7.0], [8.0, 9.0]]),
            ([7.0, 8.0], &[[0.0, 1.0], [5.0, 9.0]]),
        ] {
            cut.merge(stretch);
            assert_eq!(cut.all(), so_far);
        }
        assert_eq!(covered(cut.all(), 0.5, 6.0), 1.5);
        assert_eq!(covered(cut.all(), 2.0, 4.0), 0.0);
    }
}
