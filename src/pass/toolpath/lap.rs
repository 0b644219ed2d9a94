//! How far C turns along a run, and once round a ring.

use super::stretch::Way;
use crate::geom::{Heading, polyline};
use crate::ir::toolpath::{OrientationMode, Run};
use crate::machine::Knife;

/// How far C stays away from the ends of its range on a ring that is cut in one, at the least, rad (4 degrees).
pub(super) const SLIM_MARGIN: f64 = 0.069_813_170_079_773_18;
/// Rounding of an angle, rad.
const ANGLE_EPSILON: f64 = 1e-9;
/// Turns that differ by less are alike where a ring begins, rad (2 degrees).
const TURN_STEP: f64 = 0.034_906_585_039_886_59;
/// Chords of a ring amid which it is tried to begin, at the most, evenly among all.
const STARTS: usize = 360;

/// Once round a ring.
pub(super) struct Lap<'a> {
    pub(super) way: &'a Way<'a>,
    pub(super) winding: &'a Winding,
    pub(super) knife: &'a Knife,
    pub(super) orientation: OrientationMode,
}

impl Lap<'_> {
    /// Whether it can be cut in one from a station on, its overlap included, with C inside a range.
    pub(super) fn fits(&self, at: f64, [least, greatest]: [f64; 2]) -> bool {
        let [low, high] = self.reach(at);
        let turns = |angle: f64| angle / self.winding.period;
        (turns(least - low) - ANGLE_EPSILON).ceil() <= (turns(greatest - high) + ANGLE_EPSILON).floor()
    }

    /// The least and the greatest direction of the blade from a station on all round and over the overlap, unwrapped, rad.
    pub(super) fn reach(&self, at: f64) -> [f64; 2] {
        let Self { way, winding, knife, orientation } = self;
        // The blade plunges along the ring, or as a chord of what lies behind its tip.
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

    /// The direction at a station, unwrapped: that of a chord in its middle, turning on from one to the next.
    pub(super) fn heading(&self, station: f64) -> f64 {
        let Self { way, winding, .. } = self;
        let here = way.chord_at(station);
        let before = if station < self.middle(here) { here - 1 } else { here };
        let [a, b] = [before, before + 1].map(|chord| (self.middle(chord), winding.at(chord)));
        a.1 + (b.1 - a.1) * ((station - a.0) / (b.0 - a.0))
    }

    /// The station amid a chord.
    fn middle(&self, chord: isize) -> f64 {
        f64::midpoint(self.way.station(chord), self.way.station(chord + 1))
    }

    /// The station, amid a chord, from which on the ring can be cut in one, its overlap included, with C inside a
    /// range: where it turns least, and of such places the nearest to where it starts.
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

/// How far a curve turns on from the direction of its last chord to its end, by its turn at the vertex before, rad.
pub(super) fn half_turn(turn: f64) -> f64 {
    turn / 2.0
}

/// The directions of the chords of a run, unwrapped.
pub(super) struct Winding {
    /// Of one lap, rad.
    headings: Vec<f64>,
    /// By how much a lap turns, rad.
    lap: f64,
    /// After which turn the blade cuts the same again, rad.
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

    /// The direction of a chord, which may be of another lap.
    pub(super) fn at(&self, chord: isize) -> f64 {
        let chords = self.headings.len().cast_signed();
        self.headings[chord.rem_euclid(chords) as usize] + self.lap * chord.div_euclid(chords) as f64
    }

    /// The chord along which C is nearest to the middle of a range.
    pub(super) fn amid(&self, [least, greatest]: [f64; 2]) -> isize {
        let away = |chord: isize| {
            let turns = (self.at(chord) - f64::midpoint(least, greatest)) / self.period;
            (turns - turns.round()).abs()
        };
        let chords = 0..self.headings.len().cast_signed();
        chords.min_by(|&a, &b| away(a).total_cmp(&away(b))).unwrap_or(0)
    }

    /// The chord, up to `end`, before which C leaves its range, from the equivalent of chord `first` that goes on longest;
    /// `None` when not even that is in the range.
    pub(super) fn reach(&self, first: isize, end: isize, [least, greatest]: [f64; 2]) -> Option<isize> {
        let heading = self.at(first);
        let low = ((least - heading) / self.period - ANGLE_EPSILON).ceil();
        let high = ((greatest - heading) / self.period + ANGLE_EPSILON).floor();
        let is_in = |c: f64| (least - ANGLE_EPSILON..=greatest + ANGLE_EPSILON).contains(&c);
        // Of all equivalents the first or the last goes on longest, unless the way swings both ways; few are legal at all.
        let turns = (0..=(high - low).max(-1.0) as isize).map(|k| (low + k as f64) * self.period);
        let reached = |turns: f64| {
            let stop = (first..end).find(|&chord| !is_in(self.at(chord) + turns))?;
            // Lifted amid a curve the blade has turned on by half as much as at the vertex before.
            let is_left = |stop: isize| {
                let [last, before] = [1, 2].map(|back| self.at(stop - back));
                is_in(last + half_turn(last - before) + turns)
            };
            Some((first + 2..=stop).rev().find(|&stop| is_left(stop)).unwrap_or(stop.min(first + 1)))
        };
        turns.map(|turns| reached(turns).unwrap_or(end)).max()
    }
}
