//! Where the tip may run beside a polyline: within a part of the tolerance, and on chords of a flattened curve also
//! outside of them, by the sagitta that the turns at their ends suggest.

use crate::analysis::bulge::bulge;
use crate::geom::{Point, Vector, left, polyline};
use crate::machine::MachineProfile;

/// Turns of a curve differ by less than this factor from one vertex to the next.
const ALIKE: f64 = 2.0;
/// Shorter ways beside a chord are none, mm: an end of an arc that lies at a vertex.
const LENGTH_EPSILON: f64 = 1e-9;

/// A polyline and what counts as on it.
#[derive(Debug, Clone)]
pub(super) struct ToleranceBand {
    /// Its points, no two in a row equal.
    pub(super) points: Vec<Point>,
    /// Chord length from the first point to each point, mm.
    pub(super) stations: Vec<f64>,
    /// Turn at each point, rad; 0 at the ends.
    pub(super) turns: Vec<f64>,
    /// Outward chord sagitta in the middle of each chord.
    pub(super) sagittas: Vec<Vector>,
    /// The same as heights, to the left of the chord, mm.
    heights: Vec<f64>,
    /// The part of the tolerance that each chord may use.
    shares: Vec<f64>,
    /// Permitted deviation, mm.
    pub(super) tolerance: f64,
    /// Greatest chord sagitta, mm.
    sagitta_max: f64,
}

impl ToleranceBand {
    /// The band of a polyline that turns by `seam` (rad) before its first and behind its last chord: at the seam of a
    /// smooth closed contour; else 0.
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

    /// The same, with a share of the tolerance by the chords about which it crosses cuts of other parts.
    pub(super) fn with_junctions(mut self, junctions: impl Iterator<Item = bool>, share: f64) -> Self {
        for (chord, _) in junctions.enumerate().filter(|(_, is_junction)| *is_junction) {
            (self.sagittas[chord], self.heights[chord], self.shares[chord]) = (Vector::zeros(), 0.0, share);
        }
        self
    }

    /// Permitted deviation at a point between two chords, mm.
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

    /// Unit vector along the way from so far before a station to as far behind it.
    pub(super) fn around(&self, station: f64, reach: f64) -> Vector {
        let at = |station: f64| {
            let chord = self.chord_at(station);
            self.points[chord] + self.direction(chord) * (station - self.stations[chord])
        };
        let reach = reach.min(station).min(self.stations[self.chords()] - station);
        let here = self.direction(self.chord_at(station));
        (at(station + reach) - at(station - reach)).try_normalize(0.0).unwrap_or(here)
    }

    /// From the middle of a chord to where the curve is likely to run: by the smaller of the turns at its ends, because the
    /// greater one may be a bend of its own.
    pub(super) fn middle(&self, chord: usize) -> Vector {
        let [before, after] = [self.turns[chord].abs(), self.turns[chord + 1].abs()];
        let mean = f64::midpoint(before, after);
        if self.heights[chord] == 0.0 { Vector::zeros() } else { self.sagittas[chord] * (before.min(after) / mean) }
    }

    /// The chord at a station.
    pub(super) fn chord_at(&self, station: f64) -> usize {
        self.stations.partition_point(|&s| s <= station).clamp(1, self.chords()) - 1
    }

    /// Whether a vertex at an end of a chord is a bend of its own: on a curve neighbouring turns are alike, and no chord is
    /// so long that its sagitta would be more than it may.
    pub(super) fn is_bend(&self, chord: usize, vertex: usize) -> bool {
        let [before, after] = [self.turns[chord].abs(), self.turns[chord + 1].abs()];
        let sagitta = (self.stations[chord + 1] - self.stations[chord]) * f64::midpoint(before, after) / 8.0;
        self.is_plain(chord) || sagitta > self.sagitta_max || self.turns[vertex].abs() > ALIKE * before.min(after)
    }

    /// Whether only the chord itself counts as on the path.
    fn is_plain(&self, chord: usize) -> bool {
        self.heights[chord] == 0.0
    }

    /// Whether an arc of that curvature (left positive, per mm) stays beside a chord within an allowed distance of what
    /// counts as on the path, mm. Between its ends and its middle it is taken for a parabola, as the arc over the chord
    /// is.
    pub(super) fn holds(&self, stretch: &Stretch, curvature: f64, allowed: f64) -> bool {
        let Stretch { chord, stations: [from, to], ends } = *stretch;
        let (start, length) = (self.stations[chord], self.stations[chord + 1] - self.stations[chord]);
        let (way, aside) = (to - from, ends[1] - ends[0]);
        let square = way * way + aside * aside;
        // Of half the arc's turn.
        let sine = 0.5 * curvature * square.sqrt();
        if sine.abs() >= 1.0 {
            return false;
        }
        // An arc rises by R (1 - cos) from the line between its ends, which lies askew to the chord.
        let rise = -curvature * square / (4.0 * (1.0 + (1.0 - sine * sine).sqrt()));
        let rise = if way > LENGTH_EPSILON { rise * (square.sqrt() / way) } else { 0.0 };
        let height = self.heights[chord];
        let sagitta = |station: f64| {
            let x = (station - start) / length;
            4.0 * height * x * (1.0 - x)
        };
        // The sagitta counts on its own side only: the other one is measured from the chord.
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

/// A way beside a part of a chord.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stretch {
    /// The chord.
    pub(super) chord: usize,
    /// From where to where, mm along the polyline.
    pub(super) stations: [f64; 2],
    /// How far left of the chord it runs there, mm.
    pub(super) ends: [f64; 2],
}

/// The greatest value on [0, 1] of the parabola with these ends that is `rise` above the straight line in the middle.
fn highest([a, b]: [f64; 2], rise: f64) -> f64 {
    // Its top lies at 1/2 + (b - a) / (8 rise).
    if rise > 0.0 && (b - a).abs() < 4.0 * rise {
        let x = 0.5 + (b - a) / (8.0 * rise);
        a + (b - a) * x + 4.0 * rise * x * (1.0 - x)
    } else {
        a.max(b)
    }
}
