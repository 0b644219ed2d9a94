//! Check of the block that rows name as being cut; a program is resumed by it.

use crate::ir::verdict::Worst;
use crate::verify::program::row::Row;
use crate::verify::reference::line::Line;
use crate::verify::rules;

/// Distance from its chord, along the line, at which a block may still be named, mm, in addition to the tolerance: a tip that
/// cuts a bend inside its tolerance band passes the vertex early or late by less.
const ASIDE: f64 = 0.5;

/// Check of the column `block`.
pub(in crate::verify) struct Naming {
    /// Greatest permitted distance of a block from its chord, mm.
    reach: f64,
}

impl Naming {
    /// Check for a path tolerance, mm.
    pub(in crate::verify) fn new(tolerance: f64) -> Self {
        Self { reach: tolerance + ASIDE }
    }

    /// Initial state of the rule.
    pub(in crate::verify) fn worst(&self) -> Worst {
        Worst::new(&rules::BLOCK, Some(self.reach))
    }

    /// Error of a row in the air, where no block is cut: infinite if it names one, otherwise 0.
    pub(in crate::verify) fn in_air(row: &Row) -> f64 {
        if !row.knife && row.block != 0 { f64::INFINITY } else { 0.0 }
    }

    /// Distance from the station of a row to the chord with its block, mm; infinite beyond reach.
    pub(in crate::verify) fn away(&self, block: u32, line: &Line, station: f64) -> f64 {
        let length = line.length();
        let station = if line.ring { station.rem_euclid(length) } else { station };
        let here = line.chord_at(station);
        if line.block(here) == block {
            return 0.0;
        }
        let count = line.chords();
        let mut nearest = f64::INFINITY;
        // Search ahead, then back, among the chords that begin within reach.
        for i in 1..count {
            let (at, over) = ((here + i) % count, here + i >= count);
            let gap = line.station(at) + if over { length } else { 0.0 } - station;
            if gap > self.reach || over && !line.ring {
                break;
            }
            if line.block(at) == block {
                nearest = nearest.min(gap);
                break;
            }
        }
        for i in 1..count {
            let (at, over) = ((here + count - i) % count, i > here);
            let gap = station - line.station(at + 1) + if over { length } else { 0.0 };
            if gap > self.reach || over && !line.ring {
                break;
            }
            if line.block(at) == block {
                nearest = nearest.min(gap);
                break;
            }
        }
        nearest
    }
}
