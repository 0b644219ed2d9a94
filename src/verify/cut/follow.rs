//! Tracking of a moving point along a line: its station and its deviation.

use crate::geom::{Point, cross};
use crate::verify::reference::line::{Chord, Line};

/// Greatest distance that a point may fall back behind its last station, mm: it wavers by less than the width of the tolerance
/// band.
const BACK: f64 = 0.5;
/// Distance searched ahead, mm, in addition to twice the point's move.
const AHEAD: f64 = 1.0;
/// Longest move from one point to the next that is tracked, mm: no machine moves half as far in a period, and a longer leap
/// must not trigger a search of the whole line.
const LEAP: f64 = 25.0;

/// Foot of a point on a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::verify) struct Foot {
    /// Station of the nearest place; on a ring it keeps counting past a full turn. For a point beyond an end, the station of
    /// that end.
    pub(in crate::verify) station: f64,
    /// Distance from the core of the tolerance band, mm; beyond an end, from the straight extension of the line.
    pub(in crate::verify) deviation: f64,
    /// Distance beyond the end, mm; 0 between the ends.
    pub(in crate::verify) beyond: f64,
    /// Chord of the nearest place.
    pub(in crate::verify) chord: usize,
}

/// Tracker of a point that moves along a line.
#[derive(Debug, Clone)]
pub(in crate::verify) struct Follower<'a> {
    line: &'a Line<'a>,
    /// +1 with the line, -1 against it.
    sign: f64,
    foot: Foot,
    /// Chord that is searched first: usually the chord of the previous place.
    chord: Chord,
    point: Point,
}

impl<'a> Follower<'a> {
    /// Starts at a point near a chord and moves with the line (`sign` +1) or against it (-1).
    pub(in crate::verify) fn new(line: &'a Line<'a>, chord: usize, point: Point, sign: f64) -> Self {
        let chord = line.chord(chord);
        let mut follower = Self { line, sign, foot: chord.foot(line, point), chord, point };
        follower.step(point);
        follower
    }

    /// Foot of the current point.
    pub(in crate::verify) fn foot(&self) -> Foot {
        self.foot
    }

    /// Current point.
    pub(in crate::verify) fn point(&self) -> Point {
        self.point
    }

    /// Tracker at the same place that faces the other way.
    pub(in crate::verify) fn turned(&self) -> Self {
        Self { sign: -self.sign, ..self.clone() }
    }

    /// Moves to the next point and returns its foot: the nearest place within reach of the last one.
    pub(in crate::verify) fn step(&mut self, point: Point) -> Foot {
        let way = (point - self.point).norm();
        self.point = point;
        let line = self.line;
        let length = line.length();
        let reach = |sign: f64| if sign == self.sign { AHEAD + 2.0 * way.min(LEAP) } else { BACK };
        let (low, high) = (self.foot.station - reach(-1.0), self.foot.station + reach(1.0));
        let here = self.chord.index;
        let [from, long] = self.chord.stations();
        if self.foot.chord == here && low > from && high < from + long {
            // Inside a chord, no other chord is within reach.
            self.foot = self.chord.foot(line, point);
            return self.foot;
        }
        let laps = if line.ring { (self.foot.station / length).floor() } else { 0.0 };
        let start = line.chord_near(self.foot.chord, self.foot.station - laps * length);
        if start != self.chord.index {
            self.chord = line.chord(start);
        }
        let on = |chord: &Chord, lap: f64| {
            let foot = chord.foot(line, point);
            Foot { station: foot.station + lap * length, ..foot }
        };
        let mut best = on(&self.chord, laps);
        let mut look = |chord: usize, lap: f64| {
            if !line.may_reach(chord, point, best.deviation) && !line.is_led_on(chord, point) {
                return;
            }
            let foot = on(&line.chord(chord), lap);
            if foot.deviation < best.deviation {
                best = foot;
            }
        };
        let (mut chord, mut lap) = (start, laps);
        while let Some((next, turn)) = following(line, chord) {
            (chord, lap) = (next, lap + turn);
            // After a full turn of a ring every chord was checked.
            if line.station(chord) + lap * length > high || chord == start {
                break;
            }
            look(chord, lap);
        }
        (chord, lap) = (start, laps);
        while let Some((before, turn)) = preceding(line, chord) {
            (chord, lap) = (before, lap - turn);
            if line.station(chord + 1) + lap * length < low || chord == start {
                break;
            }
            look(chord, lap);
        }
        self.foot = best;
        best
    }
}

/// Chord after another, and the number of laps (0 or 1) that it is ahead.
fn following(line: &Line, chord: usize) -> Option<(usize, f64)> {
    match (chord + 1 < line.chords(), line.ring) {
        (true, _) => Some((chord + 1, 0.0)),
        (false, true) => Some((0, 1.0)),
        (false, false) => None,
    }
}

/// Chord before another, and the number of laps (0 or 1) that it is back.
fn preceding(line: &Line, chord: usize) -> Option<(usize, f64)> {
    match (chord > 0, line.ring) {
        (true, _) => Some((chord - 1, 0.0)),
        (false, true) => Some((line.chords() - 1, 1.0)),
        (false, false) => None,
    }
}

impl Chord {
    /// Foot of a point on the chord; beyond an end of its line, on the straight extension.
    #[inline]
    pub(in crate::verify) fn foot(&self, line: &Line, point: Point) -> Foot {
        let (chord, last) = (self.index, line.chords());
        if !line.ring && (chord == 0 || chord + 1 == last) {
            let ahead = |end: usize, sign: f64| {
                let away = point - line.point(end);
                let beyond = sign * away.dot(&self.along);
                (beyond > 0.0).then(|| Foot {
                    station: line.station(end),
                    deviation: cross(self.along, away).abs(),
                    beyond,
                    chord,
                })
            };
            let before = if chord == 0 { ahead(0, -1.0) } else { None };
            let behind = || if chord + 1 == last { ahead(last, 1.0) } else { None };
            if let Some(foot) = before.or_else(behind) {
                return foot;
            }
        }
        let (deviation, station) = self.deviation(point);
        Foot { station, deviation, beyond: 0.0, chord }
    }
}
