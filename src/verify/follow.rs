//! Follows a moving point along a line: at which station it is, and how far off.

use super::reference::Line;
use crate::geom::{Point, cross};

/// How far behind its last station a point may be found, mm: it wavers by less than the tube is wide.
const BACK: f64 = 0.5;
/// How far ahead, mm, beside twice its way.
const AHEAD: f64 = 1.0;
/// The longest way from one place to the next that is followed, mm: no machine moves half as far in a period, and what
/// leaps farther must not be looked for on the whole line.
const LEAP: f64 = 25.0;

/// Where a point stands beside a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Foot {
    /// Station of the nearest place; on a ring it goes on counting past a whole turn. Beyond an end it is that of the end.
    pub(super) station: f64,
    /// Distance from the tube's core, mm; beyond an end, from the straight extension of the line.
    pub(super) deviation: f64,
    /// How far beyond the end it stands, mm; 0 between the ends.
    pub(super) beyond: f64,
    /// The chord that this place is on.
    pub(super) chord: usize,
}

/// Stands on a line and moves along it.
#[derive(Debug, Clone)]
pub(super) struct Follower<'a> {
    line: &'a Line,
    /// +1 with the line, -1 against it.
    sign: f64,
    foot: Foot,
    point: Point,
}

impl<'a> Follower<'a> {
    /// Starts at a point near a chord, moving with the line (`sign` +1) or against it (-1).
    pub(super) fn new(line: &'a Line, chord: usize, point: Point, sign: f64) -> Self {
        let mut follower = Self { line, sign, foot: on_chord(line, chord, point), point };
        follower.foot = follower.best(point, 0.0);
        follower
    }

    /// Where it stands.
    pub(super) fn foot(&self) -> Foot {
        self.foot
    }

    /// The same place, facing the other way.
    pub(super) fn turned(&self) -> Self {
        Self { sign: -self.sign, ..self.clone() }
    }

    /// Moves to the next point and says where that stands.
    pub(super) fn step(&mut self, point: Point) -> Foot {
        let way = (point - self.point).norm();
        self.foot = self.best(point, way);
        self.point = point;
        self.foot
    }

    /// The nearest place within reach of the last one.
    fn best(&self, point: Point, way: f64) -> Foot {
        let line = self.line;
        let length = line.length();
        let reach = |sign: f64| if sign == self.sign { AHEAD + 2.0 * way.min(LEAP) } else { BACK };
        let (low, high) = (self.foot.station - reach(-1.0), self.foot.station + reach(1.0));
        let laps = if line.ring { (self.foot.station / length).floor() } else { 0.0 };
        let start = line.chord_near(self.foot.chord, self.foot.station - laps * length);
        let on = |chord: usize, lap: f64| {
            let foot = on_chord(line, chord, point);
            Foot { station: foot.station + lap * length, ..foot }
        };
        let mut best = on(start, laps);
        let mut look = |chord: usize, lap: f64| {
            let foot = on(chord, lap);
            if foot.deviation < best.deviation {
                best = foot;
            }
        };
        let (mut chord, mut lap) = (start, laps);
        while let Some((next, turn)) = following(line, chord) {
            (chord, lap) = (next, lap + turn);
            // Once round a ring every chord was looked at.
            if line.stations[chord] + lap * length > high || chord == start {
                break;
            }
            look(chord, lap);
        }
        (chord, lap) = (start, laps);
        while let Some((before, turn)) = preceding(line, chord) {
            (chord, lap) = (before, lap - turn);
            if line.stations[chord + 1] + lap * length < low || chord == start {
                break;
            }
            look(chord, lap);
        }
        best
    }
}

/// The chord behind another, and how many laps that begins.
fn following(line: &Line, chord: usize) -> Option<(usize, f64)> {
    match (chord + 1 < line.chords(), line.ring) {
        (true, _) => Some((chord + 1, 0.0)),
        (false, true) => Some((0, 1.0)),
        (false, false) => None,
    }
}

/// The chord before another, and how many laps back that is.
fn preceding(line: &Line, chord: usize) -> Option<(usize, f64)> {
    match (chord > 0, line.ring) {
        (true, _) => Some((chord - 1, 0.0)),
        (false, true) => Some((line.chords() - 1, 1.0)),
        (false, false) => None,
    }
}

/// Where a point stands beside one chord.
pub(super) fn on_chord(line: &Line, chord: usize, point: Point) -> Foot {
    let last = line.points.len() - 1;
    if !line.ring && (chord == 0 || chord + 1 == last) {
        let along = line.direction(chord);
        let ahead = |end: usize, sign: f64| {
            let away = point - line.points[end];
            let beyond = sign * away.dot(&along);
            (beyond > 0.0).then(|| Foot {
                station: line.stations[end],
                deviation: cross(along, away).abs(),
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
    let (deviation, station) = line.deviation(chord, point);
    Foot { station, deviation, beyond: 0.0, chord }
}
