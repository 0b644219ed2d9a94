//! What a program says that it does beside its lines, cut by cut.

use super::reference::line::Line;
use crate::ir::declaration::{Declaration, Kind};

/// How far from where it is declared a deviation may be met, mm: places of the blade are looked at in steps, and smoothing
/// moves the ends of a cut.
const ASIDE: f64 = 1.0;

/// The declarations of a program.
#[derive(Debug, Clone, Default)]
pub struct Declared {
    /// In the order of their cuts.
    entries: Vec<Declaration>,
}

impl Declared {
    /// These, in any order.
    pub fn new(mut entries: Vec<Declaration>) -> Self {
        entries.sort_by_key(|entry| entry.cut);
        Self { entries }
    }

    /// The greatest magnitude that is declared of a kind about a stretch of a line, given by two stations of it, mm; none
    /// where nothing is.
    pub(super) fn most(&self, kind: Kind, line: &Line, stations: [f64; 2]) -> f64 {
        self.find(kind, line, stations).map(|entry| entry.magnitude_mm).fold(0.0, f64::max)
    }

    /// Whether a kind is declared there.
    pub(super) fn has(&self, kind: Kind, line: &Line, stations: [f64; 2]) -> bool {
        self.find(kind, line, stations).next().is_some()
    }

    fn find(&self, kind: Kind, line: &Line, [a, b]: [f64; 2]) -> impl Iterator<Item = &Declaration> {
        let first = self.entries.partition_point(|entry| entry.cut < line.cut.index);
        let of_cut = self.entries[first..].iter().take_while(|entry| entry.cut == line.cut.index);
        let (low, high) = (a.min(b) - ASIDE + line.cut.offset, a.max(b) + ASIDE + line.cut.offset);
        of_cut.filter(move |entry| entry.kind == kind && line.cut.meets([low, high], [entry.from_mm, entry.to_mm]))
    }
}
