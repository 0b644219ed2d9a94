//! Declarations of a program: its deliberate deviations, cut by cut, and the check that they occur.

use std::sync::atomic::{AtomicU64, Ordering};

use super::reference::line::Line;
use super::reference::lines::Reference;
use crate::geom::Point;
use crate::ir::declaration::{Declaration, Kind, Which};
use crate::ir::verdict::{Sighting, Worst};

/// Greatest distance between the declared and the actual place of a deviation, mm: the blade is sampled in steps, and smoothing
/// moves the ends of a cut.
const ASIDE: f64 = 1.0;
/// Permitted shortfall of a measured deviation, in multiples of the tolerance: smoothing moves both ends of the blade and the
/// line at each of them, by one tolerance each.
const LESS: f64 = 4.0;
/// Additional permitted shortfall, mm: blade and line are sampled in steps.
const STEPS: f64 = 0.2;
/// Smallest declared length of a plunge relative to its declared stretch: two measurements of a noisy line may differ that
/// much.
const NIBBLE_SHARE: f64 = 0.75;
/// Least excess of a declaration without any match at its place, mm: some declare 0.
const NOWHERE: f64 = 1.0;
/// Margin of a measurement over the required one, mm: rounding.
const SURELY: f64 = 1e-9;

/// Declarations of a program.
#[derive(Debug, Clone, Default)]
pub struct Declared {
    /// Declarations in the order of their cuts.
    entries: Vec<Declaration>,
}

/// Stretch of a line between two stations, mm, and the end of the stroke there if that matters.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stretch<'a> {
    pub(super) line: &'a Line<'a>,
    pub(super) stations: [f64; 2],
    pub(super) end: Option<Which>,
}

impl Declared {
    /// Collects declarations given in any order.
    pub fn new(mut entries: Vec<Declaration>) -> Self {
        entries.sort_by_key(|entry| entry.cut);
        Self { entries }
    }

    /// Greatest declared magnitude of a kind at a stretch, mm; 0 without a declaration.
    pub(super) fn most(&self, kind: Kind, stretch: Stretch) -> f64 {
        self.find(kind, stretch).map(|entry| entry.magnitude_mm).fold(0.0, f64::max)
    }

    /// True if a kind is declared at a stretch.
    pub(super) fn has(&self, kind: Kind, stretch: Stretch) -> bool {
        self.find(kind, stretch).next().is_some()
    }

    /// Indices of the nibble declarations that may cover a plunge over a stretch: the declared and the given stretch overlap by
    /// at least half of the shorter one, and the declared length is at least [`NIBBLE_SHARE`] of the declared stretch.
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

    /// Declarations of a kind at a stretch.
    pub(super) fn find(&self, kind: Kind, stretch: Stretch) -> impl Iterator<Item = &Declaration> {
        self.places(kind, stretch).map(|place| &self.entries[place])
    }

    /// Indices of the declarations of a kind at a stretch.
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

/// Declarations of a program with the deviations found for each: a declared deviation must occur.
#[derive(Debug)]
pub(super) struct Account<'a> {
    declared: &'a Declared,
    /// Permitted shortfall of a measurement, mm, in addition to `STEPS`; and the depth in parts that does not count.
    shortfall: f64,
    band: f64,
    /// Bits of one plus the greatest deviation found for each declaration, mm; `NOTHING` if none was found. Bits of positive
    /// floats are ordered like the floats, and strokes are verified on all cores.
    found: Vec<AtomicU64>,
}

/// Value for a declaration without a deviation found: less than the bits of any stored value.
const NOTHING: u64 = 0;

impl<'a> Account<'a> {
    /// Account before anything is found.
    pub(super) fn new(declared: &'a Declared, reference: &Reference) -> Self {
        let found = declared.entries.iter().map(|_| AtomicU64::new(NOTHING)).collect();
        Self { declared, shortfall: LESS * reference.tolerance, band: reference.band, found }
    }

    /// True if nothing is declared of the cut of a line.
    pub(super) fn is_silent(&self, line: &Line) -> bool {
        self.declared.entries.binary_search_by_key(&line.cut.index, |entry| entry.cut).is_err()
    }

    /// Least deviation of a kind at a stretch, mm, that would satisfy all its declarations; `None` if the deviations found so
    /// far satisfy them.
    pub(super) fn lacks(&self, kind: Kind, stretch: Stretch) -> Option<f64> {
        self.lacks_where(kind, stretch, |_| true)
    }

    /// Least deviation that would satisfy some of the declarations of a kind at a stretch, mm; `None` if they are satisfied.
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

    /// Excess of a declaration over the deviation found, less the permitted shortfall, mm.
    fn excess(&self, place: usize) -> f64 {
        let entry = &self.declared.entries[place];
        match self.found[place].load(Ordering::Relaxed) {
            NOTHING => entry.magnitude_mm.max(NOWHERE),
            found => self.beyond(entry, f64::from_bits(found) - 1.0),
        }
    }

    /// Excess of a declaration over a measurement, less the permitted shortfall, mm.
    fn beyond(&self, entry: &Declaration, found: f64) -> f64 {
        // Depths below the band do not count.
        let band = if entry.kind == Kind::Surplus { self.band } else { 0.0 };
        entry.magnitude_mm - found - self.shortfall - STEPS - band
    }

    /// Records a deviation of a kind at a stretch, mm.
    pub(super) fn see(&self, kind: Kind, stretch: Stretch, found: f64) {
        self.see_where(kind, stretch, |_| true, found);
    }

    /// Records a deviation for some of the declarations of a kind at a stretch, mm.
    pub(super) fn see_where(&self, kind: Kind, stretch: Stretch, is_meant: impl Fn(&Declaration) -> bool, found: f64) {
        for place in self.declared.places(kind, stretch).filter(|&place| is_meant(&self.declared.entries[place])) {
            // Stored plus one: the bits of positive floats are ordered like the floats.
            self.found[place].fetch_max((found.max(0.0) + 1.0).to_bits(), Ordering::Relaxed);
        }
    }

    /// Reports the excess of each declaration over the deviation found.
    pub(super) fn settle(&self, reference: &Reference, undeclared: &mut Worst) {
        for (i, entry) in self.declared.entries.iter().enumerate() {
            let excess = self.excess(i);
            if excess > 0.0 {
                undeclared.see(excess, || place(entry, reference));
            }
        }
    }
}

/// Place of a declaration, if the drawing has its cut.
fn place(entry: &Declaration, reference: &Reference) -> Sighting {
    let of_cut = reference.lines.iter().filter(|line| line.cut.index == entry.cut);
    let Some(line) = of_cut.min_by(|a, b| away(a, entry).total_cmp(&away(b, entry))) else {
        return Sighting::missing(Point::origin(), 0);
    };
    let station = (entry.from_mm - line.cut.offset).clamp(0.0, line.length());
    Sighting::missing(line.place(station), line.block(line.chord_at(station)))
}

/// Distance of a declaration's start from a line of its cut, mm.
fn away(line: &Line, entry: &Declaration) -> f64 {
    let station = entry.from_mm - line.cut.offset;
    (-station).max(station - line.length()).max(0.0)
}
