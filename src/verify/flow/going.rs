//! Speed of the blade along its line over the cloth: within the caps, and not so slow that the blade stands.

use super::ground::{Ground, ROUNDING};
use super::lines::Line;
use super::rules;
use super::strokes::Stroke;
use super::trail::reach;
use crate::geom::Point;
use crate::ir::verdict::WorstByRule;
use crate::verify::axes::crawl;

/// Greatest error of the station of the blade, mm: caps change at stations.
const ASIDE: f64 = 1.0;

/// Stroke along its line.
pub(super) struct Going<'a> {
    pub(super) stroke: &'a Stroke,
    pub(super) line: &'a Line,
    /// Stations at which the stroke reaches and leaves the line, mm.
    pub(super) stations: [f64; 2],
    /// Speed of the cloth, mm/s.
    pub(super) conveyor: f64,
}

impl Going<'_> {
    /// Verifies both rules.
    pub(super) fn judge(&self, ground: &Ground, worst: &mut WorstByRule) {
        self.feed(ground, worst);
        self.crawl(ground, worst);
    }

    /// Positions of the leading end, row by row.
    fn way(&self) -> &[Point] {
        &self.stroke.trace[1..]
    }

    /// Compares the move from row to row with the greatest cap that holds anywhere on it.
    fn feed(&self, ground: &Ground, worst: &mut WorstByRule) {
        let period = ground.profile.time.period();
        let only = self.line.only_cap();
        let [mut at, to] = self.stations;
        let with = to >= at;
        for (i, ends) in self.way().windows(2).enumerate() {
            let step = (ends[1] - ends[0]).norm();
            let cap = only.unwrap_or_else(|| {
                let before = at;
                let found = self.line.foot_near(ends[1], at, reach(step)).station;
                at = if found.is_nan() { before } else { found };
                let aside = ground.tolerance() + ASIDE;
                self.line.cap([before.min(at) - aside, before.max(at) + aside], with)
            });
            if cap.is_finite() {
                worst.see_under(&rules::FEED, step / period, cap + 2.0 * ROUNDING / period, self.stroke.places[i + 1]);
            }
        }
    }

    /// Checks the time that the blade stays within a millimetre: a waiting head lets the cloth pass at the speed of the
    /// conveyor.
    fn crawl(&self, ground: &Ground, worst: &mut WorstByRule) {
        let times: Vec<f64> = self.stroke.places.iter().filter_map(|place| place.time).collect();
        let passing = crawl::WAY / self.conveyor / crawl::SLOWNESS_MAX;
        let fair = crawl::fair_time(ground.profile, self.line.least_cap()) + passing;
        let (longest, row) = crawl::longest(&times, self.way(), fair);
        worst.see_under(&rules::CRAWL, longest, crawl::SLOWNESS_MAX, self.stroke.places[row]);
    }
}
