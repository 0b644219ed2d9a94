//! Stretch of a run between two stations, as a run of its own.
//!
//! The passes that lift the knife amid a run split it so that each part continues along the contour by the overlaps of a
//! corner.

use crate::geom::{Point, polyline, spline};
use crate::ir::list::Joint;
use crate::ir::toolpath::{End, Run, Shape, Side};
use crate::machine::Knife;

/// Difference of turns that count as equal, rad: rounding does not make a curve gentler.
const TURN_EPSILON: f64 = 0.02;
/// Greatest turn under a blade over which overlaps may continue, rad (11 degrees): up to there the blade lies within its
/// tolerance of the line.
const GENTLE_TURN: f64 = 0.2;

/// Distance within which two points are the same, mm: rounding.
const SAME_EPSILON: f64 = 1e-9;

/// End of a run that is lifted amid a contour: its overlap lies along the contour already.
pub(super) const REJOINED: End = End { corner: true, bare: true, side: Side::Contour };

/// Run between two vertices of another run.
pub(super) fn between(run: &Run, [from, to]: [usize; 2], ends: [End; 2]) -> Run {
    Run {
        points: run.points[from..=to].to_vec(),
        spans: run.spans[from..to].to_vec(),
        joints: run.joints[from..=to].to_vec(),
        feeds: run.feeds[from..to].to_vec(),
        junctions: Vec::new(),
        ends,
        ..*run
    }
}

/// Chords of a run by their stations; on a ring the numbering continues over the laps.
pub(super) struct Way<'a> {
    run: &'a Run,
    stations: Vec<f64>,
}

impl<'a> Way<'a> {
    pub(super) fn new(run: &'a Run) -> Self {
        Self { run, stations: polyline::stations(&run.points) }
    }

    pub(super) fn is_ring(&self) -> bool {
        self.run.shape == Shape::Ring
    }

    /// Length of the run, mm.
    pub(super) fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// Number of chords.
    pub(super) fn chords(&self) -> usize {
        self.stations.len() - 1
    }

    /// Station at which a chord begins, mm; on a ring chord numbers continue over the laps, forwards and backwards.
    pub(super) fn station(&self, chord: isize) -> f64 {
        let chords = self.chords().cast_signed();
        self.stations[chord.rem_euclid(chords) as usize] + self.length() * chord.div_euclid(chords) as f64
    }

    /// Point of a vertex; on a ring vertex numbers continue over the laps.
    pub(super) fn vertex(&self, vertex: usize) -> Point {
        let chords = self.chords();
        self.run.points[if vertex == chords { chords } else { vertex % chords }]
    }

    /// Chord that continues from a station; on a ring its number continues over the laps.
    pub(super) fn chord_at(&self, station: f64) -> isize {
        let lap = if self.is_ring() { (station / self.length()).floor() } else { 0.0 };
        spline::span(&self.stations, station - lap * self.length()).cast_signed()
            + lap as isize * self.chords().cast_signed()
    }

    /// Best station between two others to lift a run and continue it, among those that are good: the last one of least turn
    /// from `before` mm before it to `behind` mm behind it. On a straight stretch the blade plunges along the line, on a curve
    /// beside it.
    pub(super) fn gentlest(
        &self,
        [low, high]: [f64; 2],
        [before, behind]: [f64; 2],
        is_good: impl Fn(f64) -> bool,
    ) -> Option<f64> {
        let turned = |station: f64| self.turned([station - before, station + behind]);
        let middles = (self.chord_at(low)..self.chord_at(high)).rev().map(|chord| {
            let [from, to] = [self.station(chord).max(low), self.station(chord + 1)];
            // On a long chord the end is best, as near to it as lets the next cut begin on the chord.
            f64::midpoint(from, to).max(to - behind).min(to)
        });
        let places = std::iter::once(high).chain(middles.filter(|&place| place >= low));
        let places = places.filter(|&place| is_good(place)).map(|place| (place, turned(place)));
        Some(places.reduce(|a, b| if b.1 < a.1 - TURN_EPSILON { b } else { a })?.0)
    }

    /// True if a run that is lifted at a station can continue with overlaps, from `before` mm before it to `behind` mm behind
    /// it. On a bend the blade would plunge over what is already cut, and leave the line.
    pub(super) fn leads_on(&self, station: f64, [before, behind]: [f64; 2]) -> bool {
        self.turned([station - before, station + behind]) <= GENTLE_TURN
    }

    /// Heel and front overlap of the stretches before and behind a lift amid the run, mm: those of a corner where the run is
    /// straight enough, else 0.
    pub(super) fn lead(&self, station: f64, knife: &Knife) -> [f64; 2] {
        let (heel, front) = (knife.corner_heel_overlap_mm, knife.corner_front_overlap_mm);
        if self.leads_on(station, [heel + front, knife.width_mm]) { [heel, front] } else { [0.0; 2] }
    }

    /// Total absolute turn of the run between two stations, rad.
    pub(super) fn turned(&self, [from, to]: [f64; 2]) -> f64 {
        let vertices = (self.chord_at(from)..=self.chord_at(to)).skip(1);
        vertices.map(|vertex| self.turn(vertex).abs()).sum()
    }

    /// Turn of the run at a vertex, rad; 0 at the ends of an open run.
    fn turn(&self, vertex: isize) -> f64 {
        let chords = self.chords().cast_signed();
        if !self.is_ring() && (vertex <= 0 || vertex >= chords) {
            return 0.0;
        }
        let at = |vertex: isize| self.run.points[vertex.rem_euclid(chords) as usize];
        polyline::turn_at(at(vertex - 1), at(vertex), at(vertex + 1))
    }

    /// Point at a station.
    pub(super) fn place(&self, station: f64) -> Point {
        self.on_chord(self.chord_at(station), station)
    }

    /// Point at a station of a chord.
    fn on_chord(&self, chord: isize, station: f64) -> Point {
        let i = chord.rem_euclid(self.chords().cast_signed()) as usize;
        let (a, b) = (self.run.points[i], self.run.points[i + 1]);
        a + (b - a) * ((station - self.station(chord)) / (self.stations[i + 1] - self.stations[i]))
    }

    /// Ring with its start moved to a station.
    pub(super) fn ring_from(&self, station: f64) -> Run {
        let open = self.part(station, station + self.length(), self.run.ends);
        let mut ring = Run { shape: Shape::Ring, ..open };
        let last = ring.points.len() - 1;
        ring.points[last] = ring.points[0];
        ring
    }

    /// Stretch from one station to another, clipped to the ends of an open run.
    pub(super) fn part(&self, from: f64, to: f64, ends: [End; 2]) -> Run {
        let (run, chords) = (self.run, self.chords());
        let from = if self.is_ring() { from } else { from.max(0.0) };
        let first = self.chord_at(from);
        let mut part = Run {
            points: vec![self.on_chord(first, from)],
            spans: Vec::new(),
            joints: vec![Joint::default()],
            feeds: Vec::new(),
            junctions: Vec::new(),
            shape: Shape::Open,
            ends,
            ..*run
        };
        for chord in first.. {
            let i = chord.rem_euclid(chords.cast_signed()) as usize;
            let end = self.station(chord + 1);
            let (point, joint) = if to < end {
                (self.on_chord(chord, to), Joint::default())
            } else {
                (run.points[i + 1], run.joints[i + 1])
            };
            // A station counted over laps may lie just before the vertex at which it is.
            if part.points.last().is_none_or(|last| (point - last).norm() > SAME_EPSILON) {
                part.points.push(point);
                part.spans.push(run.spans[i]);
                part.feeds.push(run.feeds[i]);
                part.joints.push(joint);
            }
            if to <= end || i + 1 == chords && !self.is_ring() {
                break;
            }
        }
        part
    }
}
