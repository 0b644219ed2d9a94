//! Limits of the table and of a conveyor's window.

use crate::ir::Finding;
use crate::ir::verdict::Worst;
use crate::machine::{self, MachineProfile};
use crate::verify::program::row::{Rounding, Row};
use crate::verify::rules;

/// Check of the table over the rows.
pub(in crate::verify) struct Table {
    /// Range of X and Y while the knife is down.
    down: [Option<[f64; 2]>; 2],
    /// Range of X and Y while the knife is up: home and park may lie outside the table.
    up: [Option<[f64; 2]>; 2],
    /// Distances of tip and heel from the C axis along the blade, mm.
    blade: [f64; 2],
    /// Length of a conveyor's window, mm; then the least and the greatest X of the blade while it is down, mm.
    window: Option<f64>,
    reached: [f64; 2],
    off: Worst,
}

impl Table {
    pub(in crate::verify) fn new(profile: &MachineProfile, rounding: Rounding) -> Self {
        let down = [profile.table.x_mm, profile.table.y_mm];
        let poses = [Some(profile.home), profile.park];
        let up = std::array::from_fn(|axis| {
            let wider = |[least, most]: [f64; 2], pose: &[f64; 3]| [least.min(pose[axis]), most.max(pose[axis])];
            down[axis].map(|range| poses.iter().flatten().fold(range, wider))
        });
        let blade = [profile.knife.radius(), -profile.knife.back()];
        let limit = machine::Table::EDGE_MM + rounding.place();
        let (window, reached) = (profile.bite.length_mm, [f64::INFINITY, f64::NEG_INFINITY]);
        Self { down, up, blade, window, reached, off: Worst::new(&rules::TABLE, Some(limit)) }
    }

    pub(in crate::verify) fn see(&mut self, row: &Row) {
        if self.down == [None, None] && self.window.is_none() {
            return;
        }
        if !row.knife {
            self.check(row, [row.centre.x, row.centre.y], self.up);
            return;
        }
        let along = row.along();
        for reach in self.blade {
            let place = row.centre + along * reach;
            if let Some(window) = self.window {
                self.reached = [self.reached[0].min(place.x), self.reached[1].max(place.x)];
                self.off.see(self.reached[1] - self.reached[0] - window, || row.sighting());
            }
            self.check(row, [place.x, place.y], self.down);
        }
    }

    fn check(&mut self, row: &Row, place: [f64; 2], reach: [Option<[f64; 2]>; 2]) {
        for (value, range) in place.into_iter().zip(reach) {
            if let Some([least, most]) = range {
                self.off.see((least - value).max(value - most), || row.sighting());
            }
        }
    }

    pub(in crate::verify) fn finding(self) -> Finding {
        self.off.finding()
    }
}
