//! Whether C can follow a line in one inside its range.

use super::line::Line;
use crate::machine::{Follow, Knife, MachineProfile};

/// How far from the ends of its range C is kept on a line that turns it, rad (5 degrees): by what smoothing and a
/// plunge as a chord may turn it more.
const CLEAR_OF_ENDS: f64 = 0.087_266_462_599_716_47;
/// The same on a ring where there is less room, rad: half a degree more than what a compile needs (4 degrees), so that what
/// that parts is never taken for one that is to be cut in one.
const CLEAR_ROUND_A_RING: f64 = 0.078_539_816_339_744_83;
/// Chords amid which a ring may begin, at the most, evenly among all.
const STARTS: usize = 360;
/// Smaller turns are none, rad.
const TURN_EPSILON: f64 = 1e-6;

/// The directions of the chords of a line, unwrapped.
pub(in crate::verify) struct Winding<'a> {
    line: &'a Line<'a>,
    knife: &'a Knife,
    /// Of one lap, rad.
    headings: Vec<f64>,
    /// By how much a lap of a ring turns, rad.
    lap: f64,
}

impl<'a> Winding<'a> {
    /// Whether C would leave a range, rad, or come too near to its ends, from wherever it follows a line that turns at its
    /// inner vertices by `turned` rad, whatever the side.
    pub(in crate::verify) fn is_past(
        line: &'a Line<'a>,
        turned: f64,
        range: [f64; 2],
        profile: &'a MachineProfile,
    ) -> bool {
        let [least, greatest] = range;
        // Where there is room for a period more than it turns, one of the equivalents of C fits.
        let is_sure = !line.ring && turned + 2.0 * CLEAR_OF_ENDS + profile.knife.period() <= greatest - least;
        line.chords() > 1 && !is_sure && Self::new(line, profile).leaves(range)
    }

    fn new(line: &'a Line<'a>, profile: &'a MachineProfile) -> Self {
        let first = line.direction(0);
        let mut heading = first.y.atan2(first.x);
        let mut headings = vec![heading];
        headings.extend((1..line.chords()).map(|vertex| {
            heading += line.turn(vertex);
            heading
        }));
        let closing = if line.ring { line.turn(0) } else { 0.0 };
        Self { line, knife: &profile.knife, lap: heading + closing - headings[0], headings }
    }

    fn leaves(&self, range: [f64; 2]) -> bool {
        let chords = self.headings.len();
        if !self.line.ring {
            return !self.fits(span(self.headings.iter().copied()), range, CLEAR_OF_ENDS);
        }
        let mut starts = (0..chords).step_by(chords.div_ceil(STARTS)).map(|chord| self.middle(chord.cast_signed()));
        !starts.any(|at| self.fits(self.round(at), range, CLEAR_ROUND_A_RING))
    }

    /// Whether one of the equivalents of C, which differ by a period, lets it go from the least to the greatest direction.
    fn fits(&self, [low, high]: [f64; 2], [least, greatest]: [f64; 2], clear: f64) -> bool {
        let turns = |angle: f64| angle / self.knife.period();
        (turns(least + clear - low) - TURN_EPSILON).ceil() <= (turns(greatest - clear - high) + TURN_EPSILON).floor()
    }

    /// The least and the greatest direction from a station of a ring on all round and over the overlap, rad.
    fn round(&self, at: f64) -> [f64; 2] {
        let from = match self.knife.follow {
            Follow::Tangent => at,
            Follow::Chord => at - self.knife.width_mm,
        };
        let to = at + self.line.length() + self.knife.front_overlap_mm;
        let inner = (self.chord(from) + 1..self.chord(to)).map(|chord| self.heading(chord));
        span(inner.chain([self.turning(from), self.turning(to)]))
    }

    /// The direction at a station, rad: that of a chord in its middle, turning on from one to the next.
    fn turning(&self, station: f64) -> f64 {
        let here = self.chord(station);
        let before = if station < self.middle(here) { here - 1 } else { here };
        let share = (station - self.middle(before)) / (self.middle(before + 1) - self.middle(before));
        self.heading(before) + (self.heading(before + 1) - self.heading(before)) * share
    }

    /// The chord of a station, both counted on over the laps of a ring.
    fn chord(&self, station: f64) -> isize {
        let lap = (station / self.line.length()).floor();
        let chord = self.line.chord_at(station - lap * self.line.length());
        chord.cast_signed() + lap as isize * self.headings.len().cast_signed()
    }

    /// The station amid a chord.
    fn middle(&self, chord: isize) -> f64 {
        let chords = self.headings.len().cast_signed();
        let (i, lap) = (chord.rem_euclid(chords) as usize, chord.div_euclid(chords) as f64);
        f64::midpoint(self.line.station(i), self.line.station(i + 1)) + lap * self.line.length()
    }

    fn heading(&self, chord: isize) -> f64 {
        let chords = self.headings.len().cast_signed();
        self.headings[chord.rem_euclid(chords) as usize] + self.lap * chord.div_euclid(chords) as f64
    }
}

/// The least and the greatest of some angles.
fn span(angles: impl Iterator<Item = f64>) -> [f64; 2] {
    angles.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], angle| [low.min(angle), high.max(angle)])
}
