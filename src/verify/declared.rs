//! Declarations of a program: what it says that it does beside its lines, cut by cut, and whether it does.

use std::sync::atomic::{AtomicU64, Ordering};

use super::reference::line::Line;
use super::reference::lines::Reference;
use crate::geom::Point;
use crate::ir::declaration::{Declaration, Kind, Which};
use crate::ir::verdict::{Sighting, Worst};

/// How far from where it is declared a deviation may be met, mm: places of the blade are looked at in steps, and smoothing
/// moves the ends of a cut.
const ASIDE: f64 = 1.0;
/// Tolerances by which the measured deviation may fall short of its declaration: smoothing moves the two ends of the blade and
/// the line at each of them, by one each.
const LESS: f64 = 4.0;
/// Further shortfall allowed, mm: blade and line are looked at in steps.
const STEPS: f64 = 0.2;
/// Least declared length of a plunge as a share of its declared stretch: two measures of a noisy line differ by as much.
const NIBBLE_SHARE: f64 = 0.75;
/// Least excess of a declaration of which nothing is found at its place, mm: some declare 0.
const NOWHERE: f64 = 1.0;
/// Excess of a measurement over the one that is needed, mm: rounding.
const SURELY: f64 = 1e-9;

/// The declarations of a program.
#[derive(Debug, Clone, Default)]
pub struct Declared {
    /// In the order of their cuts.
    entries: Vec<Declaration>,
}

/// A stretch of a line between two stations, mm, and the end of the stroke there if that matters.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stretch<'a> {
    pub(super) line: &'a Line<'a>,
    pub(super) stations: [f64; 2],
    pub(super) end: Option<Which>,
}

impl Declared {
    /// These, in any order.
    pub fn new(mut entries: Vec<Declaration>) -> Self {
        entries.sort_by_key(|entry| entry.cut);
        Self { entries }
    }

    /// The greatest magnitude that is declared of a kind about a stretch, mm; none where nothing is.
    pub(super) fn most(&self, kind: Kind, stretch: Stretch) -> f64 {
        self.find(kind, stretch).map(|entry| entry.magnitude_mm).fold(0.0, f64::max)
    }

    /// Whether a kind is declared there.
    pub(super) fn has(&self, kind: Kind, stretch: Stretch) -> bool {
        self.find(kind, stretch).next().is_some()
    }

    /// Indices of the nibble declarations that may belong to a plunge over a stretch: the shorter of the declared and the given
    /// stretch lies in the other by half at least, and the declared length is at least [`NIBBLE_SHARE`] of the declared stretch.
    pub(super) fn nibbles(&self, stretch: Stretch) -> Vec<usize> {
        let cut = stretch.line.cut;
        let reach = stretch.stations.map(|station| station + cut.offset);
        let reach = [reach[0].min(reach[1]), reach[0].max(reach[1])];
        let is_of_it = |&place: &usize| {
            let entry = &self.entries[place];
            let over = [entry.from_mm, entry.to_mm];
            let least = cut.length_of(over).min(reach[1] - reach[0]) / 2.0;
            cut.common(reach, over) >= least && entry.magnitude_mm >= NIBBLE_SHARE * cut.length_of(over)
        };
        self.places(Kind::Nibbled, stretch).filter(is_of_it).collect()
    }

    /// What is declared of a kind there.
    pub(super) fn find(&self, kind: Kind, stretch: Stretch) -> impl Iterator<Item = &Declaration> {
        self.places(kind, stretch).map(|place| &self.entries[place])
    }

    /// Indices of the declarations of a kind about a stretch.
    fn places(&self, kind: Kind, Stretch { line, stations: [a, b], end }: Stretch) -> impl Iterator<Item = usize> {
        let first = self.entries.partition_point(|entry| entry.cut < line.cut.index);
        let of_cut = self.entries[first..].iter().take_while(|entry| entry.cut == line.cut.index);
        let (low, high) = (a.min(b) - ASIDE + line.cut.offset, a.max(b) + ASIDE + line.cut.offset);
        let is_at_end = move |entry: &Declaration| end.is_none() || entry.end.is_none() || entry.end == end;
        let is_there = move |entry: &Declaration| line.cut.meets([low, high], [entry.from_mm, entry.to_mm]);
        let those = (first..).zip(of_cut);
        those.filter(move |(_, entry)| entry.kind == kind && is_at_end(entry) && is_there(entry)).map(|(i, _)| i)
    }
}

/// The declarations of a program with what was found of each: what is declared must happen.
#[derive(Debug)]
pub(super) struct Account<'a> {
    declared: &'a Declared,
    /// By how much a measurement may fall short of its declaration, mm, beside steps; and how much depth in parts is none.
    shortfall: f64,
    band: f64,
    /// Bits of one plus the most that was found of each, mm; `NOTHING` = nothing was found. Bits of positive floats have their
    /// order, and strokes are judged on all cores.
    found: Vec<AtomicU64>,
}

/// Mark of a declaration of which nothing was found: less than the bits of any stored value.
const NOTHING: u64 = 0;

impl<'a> Account<'a> {
    /// Nothing is found yet.
    pub(super) fn new(declared: &'a Declared, reference: &Reference) -> Self {
        let found = declared.entries.iter().map(|_| AtomicU64::new(NOTHING)).collect();
        Self { declared, shortfall: LESS * reference.tolerance, band: reference.band, found }
    }

    /// Whether nothing is declared of the cut of a line.
    pub(super) fn is_silent(&self, line: &Line) -> bool {
        self.declared.entries.binary_search_by_key(&line.cut.index, |entry| entry.cut).is_err()
    }

    /// Least deviation of a kind about a stretch, mm, beside which the declarations there are no longer too much; `None` where
    /// none is by what was found so far.
    pub(super) fn lacks(&self, kind: Kind, stretch: Stretch) -> Option<f64> {
        self.lacks_where(kind, stretch, |_| true)
    }

    /// Least deviation beside which some declarations of a kind about a stretch are no longer too much, mm.
    pub(super) fn lacks_where(
        &self,
        kind: Kind,
        stretch: Stretch,
        is_meant: impl Fn(&Declaration) -> bool,
    ) -> Option<f64> {
        let meant = self.declared.places(kind, stretch).filter(|&place| is_meant(&self.declared.entries[place]));
        let enough = |place: usize| self.beyond(&self.declared.entries[place], 0.0) + SURELY;
        meant.filter(|&place| self.excess(place) > 0.0).map(enough).reduce(f64::max)
    }

    /// By how much a declaration says more than was found, with the tolerance of the lines, mm.
    fn excess(&self, place: usize) -> f64 {
        let entry = &self.declared.entries[place];
        match self.found[place].load(Ordering::Relaxed) {
            NOTHING => entry.magnitude_mm.max(NOWHERE),
            found => self.beyond(entry, f64::from_bits(found) - 1.0),
        }
    }

    /// The same of a measurement, mm.
    fn beyond(&self, entry: &Declaration, found: f64) -> f64 {
        // Less than the band is no depth.
        let band = if entry.kind == Kind::Surplus { self.band } else { 0.0 };
        entry.magnitude_mm - found - self.shortfall - STEPS - band
    }

    /// Sees a deviation of a kind about a stretch, mm.
    pub(super) fn see(&self, kind: Kind, stretch: Stretch, found: f64) {
        self.see_where(kind, stretch, |_| true, found);
    }

    /// Sees the same of some declarations alone.
    pub(super) fn see_where(&self, kind: Kind, stretch: Stretch, is_meant: impl Fn(&Declaration) -> bool, found: f64) {
        for place in self.declared.places(kind, stretch).filter(|&place| is_meant(&self.declared.entries[place])) {
            // One more than it is: the bits of floats above 0 are in their order.
            self.found[place].fetch_max((found.max(0.0) + 1.0).to_bits(), Ordering::Relaxed);
        }
    }

    /// Sees by how much each declaration says more than was found.
    pub(super) fn settle(&self, reference: &Reference, undeclared: &mut Worst) {
        for (i, entry) in self.declared.entries.iter().enumerate() {
            let excess = self.excess(i);
            if excess > 0.0 {
                undeclared.see(excess, || place(entry, reference));
            }
        }
    }
}

/// Where a declaration is, as far as the drawing has its cut.
fn place(entry: &Declaration, reference: &Reference) -> Sighting {
    let of_cut = reference.lines.iter().filter(|line| line.cut.index == entry.cut);
    let Some(line) = of_cut.min_by(|a, b| away(a, entry).total_cmp(&away(b, entry))) else {
        return Sighting::missing(Point::origin(), 0);
    };
    let station = (entry.from_mm - line.cut.offset).clamp(0.0, line.length());
    Sighting::missing(line.place(station), line.block(line.chord_at(station)))
}

/// How far from a line of its cut a declaration begins, mm.
fn away(line: &Line, entry: &Declaration) -> f64 {
    let station = entry.from_mm - line.cut.offset;
    (-station).max(station - line.length()).max(0.0)
}
