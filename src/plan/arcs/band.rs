//! Tolerance band of the tip around a polyline: a fraction of the tolerance on either side. At chords of a flattened curve the
//! band also extends outwards by the sagitta estimated from the turns at their ends.

use crate::analysis::bulge::bulge;
use crate::geom::{Point, Vector, left, polyline};
use crate::machine::MachineProfile;

/// Maximum ratio of the turns at neighbouring vertices of one curve.
const ALIKE: f64 = 2.0;
/// Length below which a stretch beside a chord is empty, mm: an arc that ends at a vertex.
const LENGTH_EPSILON: f64 = 1e-9;

/// A polyline and its tolerance band.
#[derive(Debug, Clone)]
pub(super) struct ToleranceBand {
    /// Vertices; consecutive ones differ.
    pub(super) points: Vec<Point>,
    /// Chord length from the first point to each point, mm.
    pub(super) stations: Vec<f64>,
    /// Turn at each point, rad; 0 at the ends.
    pub(super) turns: Vec<f64>,
    /// Outward chord sagitta at the middle of each chord, as a vector, mm.
    pub(super) sagittas: Vec<Vector>,
    /// Signed sagitta of each chord, positive to its left, mm.
    heights: Vec<f64>,
    /// Fraction of the tolerance that each chord may use.
    shares: Vec<f64>,
    /// Permitted deviation, mm.
    pub(super) tolerance: f64,
    /// Maximum chord sagitta, mm.
    sagitta_max: f64,
}

impl ToleranceBand {
    /// The band of a polyline. `seam` holds the turns before the first and after the last chord, rad: those at the seam of a
    /// smooth closed contour, otherwise 0.
    pub(super) fn new(points: Vec<Point>, tolerance: f64, seam: [f64; 2], profile: &MachineProfile) -> Self {
        let stations = polyline::stations(&points);
        let mut turns = vec![0.0; points.len()];
        for i in 1..points.len().saturating_sub(1) {
            turns[i] = polyline::turn_at(points[i - 1], points[i], points[i + 1]);
        }
        let [first, last] = seam;
        let end = turns.len() - 1;
        (turns[0], turns[end]) = (first, last);
        let height = |i: usize| bulge(stations[i + 1] - stations[i], [turns[i], turns[i + 1]], profile);
        let heights: Vec<f64> = (0..end).map(height).collect();
        let sagitta = |i: usize| left(points[i + 1] - points[i]) * (heights[i] / (stations[i + 1] - stations[i]));
        let sagittas = (0..end).map(sagitta).collect();
        let (shares, sagitta_max) = (vec![1.0; end], profile.path.chord_sag_max_mm);
        Self { points, stations, turns, sagittas, heights, shares, tolerance, sagitta_max }
    }

    /// Restricts the band to `share` of the tolerance, without sagitta, at the chords flagged in `junctions`, such as those
    /// near crossings with cuts of other parts.
    pub(super) fn with_junctions(mut self, junctions: impl Iterator<Item = bool>, share: f64) -> Self {
        for (chord, _) in junctions.enumerate().filter(|(_, is_junction)| *is_junction) {
            (self.sagittas[chord], self.heights[chord], self.shares[chord]) = (Vector::zeros(), 0.0, share);
        }
        self
    }

    /// Permitted deviation at a vertex, mm: that of the stricter of its two chords.
    pub(super) fn tolerance_at(&self, point: usize) -> f64 {
        let share = |chord: Option<usize>| chord.and_then(|chord| self.shares.get(chord)).copied().unwrap_or(1.0);
        self.tolerance * share(point.checked_sub(1)).min(share(Some(point)))
    }

    /// Number of chords.
    pub(super) fn chords(&self) -> usize {
        self.sagittas.len()
    }

    /// Unit vector along a chord.
    pub(super) fn direction(&self, chord: usize) -> Vector {
        (self.points[chord + 1] - self.points[chord]) / (self.stations[chord + 1] - self.stations[chord])
    }

    /// Unit vector along the secant from `reach` mm before a station to `reach` mm after it, clamped to the ends.
    pub(super) fn around(&self, station: f64, reach: f64) -> Vector {
        let at = |station: f64| {
            let chord = self.chord_at(station);
            self.points[chord] + self.direction(chord) * (station - self.stations[chord])
        };
        let reach = reach.min(station).min(self.stations[self.chords()] - station);
        let here = self.direction(self.chord_at(station));
        (at(station + reach) - at(station - reach)).try_normalize(0.0).unwrap_or(here)
    }

    /// Vector from the middle of a chord to the likely course of the curve. It uses the smaller of the turns at the ends,
    /// because the greater one may be a separate bend.
    pub(super) fn middle(&self, chord: usize) -> Vector {
        let [before, after] = [self.turns[chord].abs(), self.turns[chord + 1].abs()];
        let mean = f64::midpoint(before, after);
        if self.heights[chord] == 0.0 { Vector::zeros() } else { self.sagittas[chord] * (before.min(after) / mean) }
    }

    /// Index of the chord at a station.
    pub(super) fn chord_at(&self, station: f64) -> usize {
        self.stations.partition_point(|&s| s <= station).clamp(1, self.chords()) - 1
    }

    /// True if the vertex at an end of a chord is a separate bend, not part of a curve. On a curve, neighbouring turns are
    /// similar and no chord is so long that its sagitta exceeds the maximum.
    pub(super) fn is_bend(&self, chord: usize, vertex: usize) -> bool {
        let [before, after] = [self.turns[chord].abs(), self.turns[chord + 1].abs()];
        let sagitta = (self.stations[chord + 1] - self.stations[chord]) * f64::midpoint(before, after) / 8.0;
        self.is_plain(chord) || sagitta > self.sagitta_max || self.turns[vertex].abs() > ALIKE * before.min(after)
    }

    /// True if the chord has no sagitta: only the chord itself counts as on the path.
    fn is_plain(&self, chord: usize) -> bool {
        self.heights[chord] == 0.0
    }

    /// True if an arc of a curvature, left positive, per mm, stays within `allowed` mm of the path beside a chord. Between its
    /// ends and its middle the arc is approximated by a parabola, as is the arc over the chord.
    pub(super) fn holds(&self, stretch: &Stretch, curvature: f64, allowed: f64) -> bool {
        let Stretch { chord, stations: [from, to], ends } = *stretch;
        let (start, length) = (self.stations[chord], self.stations[chord + 1] - self.stations[chord]);
        let (way, aside) = (to - from, ends[1] - ends[0]);
        let square = way * way + aside * aside;
        // Sine of half the arc's turn.
        let sine = 0.5 * curvature * square.sqrt();
        if sine.abs() >= 1.0 {
            return false;
        }
        // An arc rises by R (1 - cos) above the line between its ends, which is skewed against the chord.
        let rise = -curvature * square / (4.0 * (1.0 + (1.0 - sine * sine).sqrt()));
        let rise = if way > LENGTH_EPSILON { rise * (square.sqrt() / way) } else { 0.0 };
        let height = self.heights[chord];
        let sagitta = |station: f64| {
            let x = (station - start) / length;
            4.0 * height * x * (1.0 - x)
        };
        // The sagitta counts on its own side only; on the other side distances are measured from the chord.
        let sagittas = [sagitta(from), sagitta(to)];
        let share = way / length;
        let allowed = allowed * self.shares[chord];
        let beside = |side: f64| {
            let counts = if side * height > 0.0 { 1.0 } else { 0.0 };
            let end = |i: usize| side * (ends[i] - counts * sagittas[i]);
            highest([end(0), end(1)], side * (rise - counts * height * share * share))
        };
        beside(1.0) <= allowed && beside(-1.0) <= allowed
    }
}

/// Part of an arc beside one chord.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stretch {
    /// Index of the chord.
    pub(super) chord: usize,
    /// Stations of its start and end, mm along the polyline.
    pub(super) stations: [f64; 2],
    /// Offsets of its ends to the left of the chord, mm.
    pub(super) ends: [f64; 2],
}

/// Maximum on [0, 1] of the parabola with end values `a` and `b` and height `rise` above the straight line in the middle.
fn highest([a, b]: [f64; 2], rise: f64) -> f64 {
    // The vertex lies at 1/2 + (b - a) / (8 rise).
    if rise > 0.0 && (b - a).abs() < 4.0 * rise {
        let x = 0.5 + (b - a) / (8.0 * rise);
        a + (b - a) * x + 4.0 * rise * x * (1.0 - x)
    } else {
        a.max(b)
    }
}
