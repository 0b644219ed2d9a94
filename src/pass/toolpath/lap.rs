//! Rotation of C along a run, and over one lap of a ring.

use super::stretch::Way;
use crate::geom::{Heading, polyline};
use crate::ir::toolpath::{OrientationMode, Run};
use crate::machine::Knife;

/// Least margin of C from the ends of its range on a ring that is cut without a lift, rad (4 degrees).
pub(super) const SLIM_MARGIN: f64 = 0.069_813_170_079_773_18;
/// Rounding of an angle, rad.
const ANGLE_EPSILON: f64 = 1e-9;
/// Step to which turns are rounded before starts of a ring are compared, rad (2 degrees).
const TURN_STEP: f64 = 0.034_906_585_039_886_59;
/// Greatest number of chords, evenly spaced, whose midpoints are tried as the start of a ring.
const STARTS: usize = 360;

/// One lap of a ring.
pub(super) struct Lap<'a> {
    pub(super) way: &'a Way<'a>,
    pub(super) winding: &'a Winding,
    pub(super) knife: &'a Knife,
    pub(super) orientation: OrientationMode,
}

impl Lap<'_> {
    /// True if the ring, overlap included, can be cut without a lift from a station on, with C inside a range.
    pub(super) fn fits(&self, at: f64, [least, greatest]: [f64; 2]) -> bool {
        let [low, high] = self.reach(at);
        let turns = |angle: f64| angle / self.winding.period;
        (turns(least - low) - ANGLE_EPSILON).ceil() <= (turns(greatest - high) + ANGLE_EPSILON).floor()
    }

    /// Least and greatest heading of the blade over a lap from a station on, overlap included, unwrapped, rad.
    pub(super) fn reach(&self, at: f64) -> [f64; 2] {
        let Self { way, winding, knife, orientation } = self;
        // The blade plunges along the tangent, or as a chord that ends at its tip.
        let from = match orientation {
            OrientationMode::Tangent => at,
            OrientationMode::Chord => at - knife.width_mm,
        };
        let to = at + way.length() + knife.front_overlap_mm;
        let inner = (way.chord_at(from) + 1..way.chord_at(to)).map(|chord| winding.at(chord));
        let ends = [from, to].map(|station| self.heading(station));
        inner
            .chain(ends)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], heading| [low.min(heading), high.max(heading)])
    }

    /// Heading at a station, unwrapped, rad: that of the chord at its midpoint, interpolated between midpoints.
    pub(super) fn heading(&self, station: f64) -> f64 {
        let Self { way, winding, .. } = self;
        let here = way.chord_at(station);
        let before = if station < self.middle(here) { here - 1 } else { here };
        let [a, b] = [before, before + 1].map(|chord| (self.middle(chord), winding.at(chord)));
        a.1 + (b.1 - a.1) * ((station - a.0) / (b.0 - a.0))
    }

    /// Station of the midpoint of a chord, mm.
    fn middle(&self, chord: isize) -> f64 {
        f64::midpoint(self.way.station(chord), self.way.station(chord + 1))
    }

    /// Station, at the midpoint of a chord, from which the ring, overlap included, can be cut without a lift with C inside a
    /// range. It is the one where the ring turns least, and the nearest to the start of the ring among equals; `None` if there
    /// is none.
    pub(super) fn start(&self, range: [f64; 2]) -> Option<f64> {
        let Self { way, knife, .. } = self;
        let chords = way.chords();
        let turned = |at: f64| {
            let turned = way.turned([at - knife.width_mm, at + knife.width_mm]);
            (turned / TURN_STEP).round()
        };
        let away = |at: f64| at.min(way.length() - at);
        let starts = (0..chords).step_by(chords.div_ceil(STARTS)).map(|chord| self.middle(chord.cast_signed()));
        let fit = starts.filter(|&at| self.fits(at, range)).map(|at| (at, turned(at)));
        let best = fit.min_by(|a, b| a.1.total_cmp(&b.1).then(away(a.0).total_cmp(&away(b.0))));
        best.map(|(at, _)| at)
    }
}

/// Turn of a curve from its last chord to its tangent at the end, rad, estimated from its turn at the vertex before.
pub(super) fn half_turn(turn: f64) -> f64 {
    turn / 2.0
}

/// Headings of the chords of a run, unwrapped.
pub(super) struct Winding {
    /// Headings of one lap, rad.
    headings: Vec<f64>,
    /// Turn over one lap, rad.
    lap: f64,
    /// Rotation after which the blade cuts the same line again, rad.
    period: f64,
}

impl Winding {
    pub(super) fn new(run: &Run, way: &Way, knife: &Knife) -> Self {
        let mut heading = Heading::of(run.points[1] - run.points[0]).radians();
        let mut headings = vec![heading];
        headings.extend(run.points.windows(3).map(|w| {
            heading += polyline::turn_at(w[0], w[1], w[2]);
            heading
        }));
        let closing = polyline::turn_at(run.points[way.chords() - 1], run.points[0], run.points[1]);
        Self { lap: heading + closing - headings[0], headings, period: knife.period() }
    }

    /// Heading of a chord, rad. Chord numbers continue over the laps.
    pub(super) fn at(&self, chord: isize) -> f64 {
        let chords = self.headings.len().cast_signed();
        self.headings[chord.rem_euclid(chords) as usize] + self.lap * chord.div_euclid(chords) as f64
    }

    /// Chord whose heading is nearest to the middle of a range.
    pub(super) fn amid(&self, [least, greatest]: [f64; 2]) -> isize {
        let away = |chord: isize| {
            let turns = (self.at(chord) - f64::midpoint(least, greatest)) / self.period;
            (turns - turns.round()).abs()
        };
        let chords = 0..self.headings.len().cast_signed();
        chords.min_by(|&a, &b| away(a).total_cmp(&away(b))).unwrap_or(0)
    }

    /// Chord, at most `end`, before which C leaves its range, starting from the equivalent heading of chord `first` that lasts
    /// longest; `None` if no equivalent is in the range.
    pub(super) fn reach(&self, first: isize, end: isize, [least, greatest]: [f64; 2]) -> Option<isize> {
        let heading = self.at(first);
        let low = ((least - heading) / self.period - ANGLE_EPSILON).ceil();
        let high = ((greatest - heading) / self.period + ANGLE_EPSILON).floor();
        let is_in = |c: f64| (least - ANGLE_EPSILON..=greatest + ANGLE_EPSILON).contains(&c);
        // Of all equivalents the first or the last lasts longest, unless the run turns both ways; only a few are legal.
        let turns = (0..=(high - low).max(-1.0) as isize).map(|k| (low + k as f64) * self.period);
        let reached = |turns: f64| {
            let stop = (first..end).find(|&chord| !is_in(self.at(chord) + turns))?;
            // When the knife is lifted on a curve, the blade has turned further by half of the turn at the vertex before.
            let is_left = |stop: isize| {
                let [last, before] = [1, 2].map(|back| self.at(stop - back));
                is_in(last + half_turn(last - before) + turns)
            };
            Some((first + 2..=stop).rev().find(|&stop| is_left(stop)).unwrap_or(stop.min(first + 1)))
        };
        turns.map(|turns| reached(turns).unwrap_or(end)).max()
    }
}
