//! What rows say beside poses and outputs: the block that is being cut, by which a program is resumed.

use crate::ir::verdict::Worst;
use crate::verify::program::row::Row;
use crate::verify::reference::line::Line;
use crate::verify::rules;

/// How far from its chord, along the line, a block may be named, mm, beside the tolerance: a tip that takes a bend inside
/// its tolerance band passes the vertex early or late by less.
const ASIDE: f64 = 0.5;

/// Judges the column `block`.
pub(in crate::verify) struct Naming {
    /// How far a block may be named from its chord, mm.
    reach: f64,
}

impl Naming {
    /// For a tolerance band of this tolerance, mm.
    pub(in crate::verify) fn new(tolerance: f64) -> Self {
        Self { reach: tolerance + ASIDE }
    }

    /// The worst of nothing.
    pub(in crate::verify) fn worst(&self) -> Worst {
        Worst::new(&rules::BLOCK, Some(self.reach))
    }

    /// How far a row in the air is from what it should name: there no block is cut.
    pub(in crate::verify) fn in_air(row: &Row) -> f64 {
        if !row.knife && row.block != 0 { f64::INFINITY } else { 0.0 }
    }

    /// How far a row that cuts a line at a station is from the chord that has its block, mm.
    pub(in crate::verify) fn away(&self, block: u32, line: &Line, station: f64) -> f64 {
        let length = line.length();
        let station = if line.ring { station.rem_euclid(length) } else { station };
        let here = line.chord_at(station);
        if line.block(here) == block {
            return 0.0;
        }
        let count = line.chords();
        let mut nearest = f64::INFINITY;
        // Behind and before, as far as the chords begin within reach.
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
