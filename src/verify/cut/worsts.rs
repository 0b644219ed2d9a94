//! Worst values of strokes, rule by rule.

use super::coverage::Coverage;
use super::naming::Naming;
use super::nibbles::{self, Nibble};
use crate::ir::Finding;
use crate::ir::verdict::{Sighting, Worst};
use crate::machine::MachineProfile;
use crate::verify::axes::crawl;
use crate::verify::program::row::Rounding;
use crate::verify::rules;

/// Worst value of each rule on strokes.
#[derive(Debug, Clone)]
pub(in crate::verify) struct Worsts {
    pub(in crate::verify) on_path: Worst,
    pub(in crate::verify) stray: Worst,
    pub(in crate::verify) once: Worst,
    pub(in crate::verify) heading: Worst,
    pub(in crate::verify) down: Worst,
    pub(in crate::verify) body: Worst,
    pub(in crate::verify) swing: Worst,
    pub(in crate::verify) feed: Worst,
    pub(in crate::verify) crawl: Worst,
    pub(in crate::verify) block: Worst,
    pub(in crate::verify) overcuts: Overcuts,
    pub(in crate::verify) overlap: Worst,
    pub(in crate::verify) declared: Worst,
    /// Overlaps that some strokes lack and other strokes may provide.
    pub(in crate::verify) lacking: Vec<Lacking>,
    /// Plunges inside lines; each needs a declaration.
    pub(super) nibbles: Vec<Nibble>,
}

/// Overlap that a plunge cut lacks at an end of its line; another stroke of the line may provide it.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Lacking {
    pub(in crate::verify) line: usize,
    /// Start (0) or end (1) of the line.
    pub(in crate::verify) end: usize,
    /// Overlap that the profile asks for, mm.
    pub(in crate::verify) asked: f64,
    /// Shortfall of this stroke, mm.
    pub(in crate::verify) missing: f64,
    pub(in crate::verify) place: Sighting,
}

impl Worsts {
    /// Initial state; the tip may leave its line by `tolerance` mm, and rows are rounded.
    pub(in crate::verify) fn new(profile: &MachineProfile, tolerance: f64, rounding: Rounding) -> Self {
        let (knife, verify, place) = (&profile.knife, &profile.verify, rounding.place());
        // A part of a long or winding run overlaps with the previous part and, on a closed contour, also with the next.
        let joints = if knife.max_down_mm.is_some() || profile.c.range_deg.is_some() { 2.0 } else { 1.0 };
        let feed = knife.feed_mm_s.map(|feed| feed + 4.0 * place / profile.time.period());
        Self {
            on_path: Worst::new(&rules::ON_PATH, Some(tolerance + place)),
            stray: Worst::new(&rules::STRAY, Some(0.0)),
            once: Worst::new(&rules::ONCE, Some(joints * knife.overlaps() + 2.0 * tolerance)),
            heading: Worst::new(&rules::HEADING, Some(verify.max_heading_deg)),
            down: Worst::new(&rules::DOWN, knife.max_down_mm.map(|longest| longest + tolerance)),
            body: Worst::new(&rules::BODY, verify.max_body_mm),
            swing: Worst::new(&rules::SWING, None),
            feed: Worst::new(&rules::FEED, feed),
            crawl: crawl::worst(),
            block: Naming::new(tolerance).worst(),
            overcuts: Overcuts::new(profile, tolerance),
            overlap: Worst::new(&rules::OVERLAP, Some(tolerance + place)),
            declared: Worst::new(&rules::DECLARED, Some(0.0)),
            lacking: Vec::new(),
            nibbles: Vec::new(),
        }
    }

    /// Merges the worst values of later strokes.
    pub(in crate::verify) fn add(&mut self, mut later: Self) {
        self.lacking.append(&mut later.lacking);
        self.nibbles.append(&mut later.nibbles);
        for (worst, later) in self.all_mut().into_iter().zip(later.all()) {
            worst.add(&later);
        }
    }

    /// Copy without the lists of overlaps and plunges; these are set aside meanwhile instead of being copied.
    pub(in crate::verify) fn without_lists(&mut self) -> Self {
        let lists = (std::mem::take(&mut self.lacking), std::mem::take(&mut self.nibbles));
        let known = self.clone();
        (self.lacking, self.nibbles) = lists;
        known
    }

    /// Reports each overlap that every stroke of its line lacks by more than `allowed` mm, and plunges without a declaration.
    pub(in crate::verify) fn settle(&mut self, coverage: &Coverage, allowed: f64) {
        for Lacking { line, end, asked, missing, place } in std::mem::take(&mut self.lacking) {
            if asked - coverage.beyond(line, end) > allowed {
                self.overlap.see(missing, || place);
            }
        }
        nibbles::settle(&std::mem::take(&mut self.nibbles), &mut self.declared);
    }

    /// Finding of each rule.
    pub(in crate::verify) fn findings(self) -> impl Iterator<Item = Finding> {
        self.all().into_iter().map(Worst::finding)
    }

    fn all(mut self) -> [Worst; 15] {
        self.all_mut().map(|worst| worst.clone())
    }

    fn all_mut(&mut self) -> [&mut Worst; 15] {
        let Self {
            on_path,
            stray,
            once,
            heading,
            down,
            body,
            swing,
            feed,
            crawl,
            block,
            overcuts,
            overlap,
            declared,
            lacking: _,
            nibbles: _,
        } = self;
        let Overcuts { part, neighbour, waste } = overcuts;
        [
            on_path, stray, once, heading, down, body, swing, feed, crawl, block, part, neighbour, waste, overlap,
            declared,
        ]
    }
}

/// Worst overcuts by what they enter.
#[derive(Debug, Clone)]
pub(in crate::verify) struct Overcuts {
    pub(in crate::verify) part: Worst,
    pub(in crate::verify) neighbour: Worst,
    pub(in crate::verify) waste: Worst,
}

impl Overcuts {
    /// Initial state; the tip may leave its line by `tolerance` mm.
    pub(in crate::verify) fn new(profile: &MachineProfile, tolerance: f64) -> Self {
        let verify = &profile.verify;
        let cap = |most: Option<f64>| most.map(|most| most + tolerance);
        Self {
            part: Worst::new(&rules::OVERCUT_PART, cap(verify.max_overcut_part_mm)),
            neighbour: Worst::new(&rules::OVERCUT_NEIGHBOUR, cap(verify.max_overcut_neighbour_mm)),
            waste: Worst::new(&rules::OVERCUT_WASTE, verify.max_overcut_waste_mm),
        }
    }
}
