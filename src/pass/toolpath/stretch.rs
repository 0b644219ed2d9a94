//! A stretch of a run: what lies between two stations of it, as a run of its own.
//!
//! The passes that lift the knife amid a run part it so that each part leads on along the contour by the overlaps of a
//! corner.

use crate::geom::{Point, polyline, spline};
use crate::ir::list::Joint;
use crate::ir::toolpath::{End, Run, Shape, Side};

/// Where a run is lifted on its way: its overlap already lies along the contour.
pub(super) const REJOINED: End = End { corner: true, bare: true, side: Side::Waste };

/// The chords of a run by their stations; on a ring they go round and round.
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

    /// The station at which a chord begins; on a ring chords are counted on over the laps, forwards and backwards.
    pub(super) fn station(&self, chord: isize) -> f64 {
        let chords = self.chords().cast_signed();
        self.stations[chord.rem_euclid(chords) as usize] + self.length() * chord.div_euclid(chords) as f64
    }

    /// The place of a vertex, counted like that.
    pub(super) fn vertex(&self, vertex: usize) -> Point {
        let chords = self.chords();
        self.run.points[if vertex == chords { chords } else { vertex % chords }]
    }

    /// The chord that goes on from a station, counted like that.
    pub(super) fn chord_at(&self, station: f64) -> isize {
        let lap = if self.is_ring() { (station / self.length()).floor() } else { 0.0 };
        spline::span(&self.stations, station - lap * self.length()).cast_signed()
            + lap as isize * self.chords().cast_signed()
    }

    /// The stretch from one station to another; what an open run has not is not in it.
    pub(super) fn part(&self, from: f64, to: f64, ends: [End; 2]) -> Run {
        let (run, chords) = (self.run, self.chords());
        let from = if self.is_ring() { from } else { from.max(0.0) };
        let first = self.chord_at(from);
        let at = |chord: isize, station: f64| {
            let i = chord.rem_euclid(chords.cast_signed()) as usize;
            let (a, b) = (run.points[i], run.points[i + 1]);
            a + (b - a) * ((station - self.station(chord)) / (self.stations[i + 1] - self.stations[i]))
        };
        let mut part = Run {
            points: vec![at(first, from)],
            spans: Vec::new(),
            joints: vec![Joint::default()],
            feeds: Vec::new(),
            shape: Shape::Open,
            ends,
            ..*run
        };
        for chord in first.. {
            let i = chord.rem_euclid(chords.cast_signed()) as usize;
            let end = self.station(chord + 1);
            let (point, joint) =
                if to < end { (at(chord, to), Joint::default()) } else { (run.points[i + 1], run.joints[i + 1]) };
            if part.points.last() != Some(&point) {
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
