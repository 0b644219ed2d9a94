//! Tolerance band of the tip around a polyline.
//!
//! A cutter file contains curves flattened by CAD, so its chords cut the corners of the curve. On a chord of a curve the band
//! is therefore wider towards the outside, by the sagitta of the arc estimated from the turns at its ends. Elsewhere the band
//! is the plain neighbourhood of the chord.

use super::lap::Lap;
use crate::analysis::bulge::bulge;
use crate::geom::{Point, Vector, left, polyline, spline};
use crate::machine::MachineProfile;

/// Fraction of the tolerance to use on chords near a junction, and a fallback where that is too tight. Cuts overlap by one
/// tolerance; two tips that each deviate by a quarter use half of that.
pub(in crate::plan) const JUNCTION_SHARES: [f64; 2] = [0.25, 0.5];

/// Limit on the deviation of a tip at an end of its line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plan) struct Near {
    /// Length from the end of the overlap, mm; 0 = no limit.
    pub(in crate::plan) length: f64,
    /// Fraction of the tolerance to use there.
    pub(in crate::plan) share: f64,
}

impl Default for Near {
    fn default() -> Self {
        Self { length: 0.0, share: 1.0 }
    }
}

/// Neighbourhood of a polyline in which the tip must stay.
#[derive(Debug, Clone)]
pub(in crate::plan) struct ToleranceBand {
    /// Vertices of the polyline; consecutive ones differ.
    pub(super) points: Vec<Point>,
    /// Chord length from the first point to each point, mm.
    pub(super) stations: Vec<f64>,
    /// Turn at each point, rad; 0 at the ends.
    pub(super) turns: Vec<f64>,
    /// Chord sagitta of each chord: the outward normal times the height at its middle, mm.
    sagittas: Vec<Vector>,
    /// Fraction of the tolerance that each chord may use.
    shares: Vec<f64>,
    /// Limits on the deviation at its start and at its end.
    near: [Near; 2],
    /// Permitted deviation, mm.
    pub(super) tolerance: f64,
    /// Lap of a ring, whose curve closes.
    pub(super) lap: Option<Lap>,
}

/// A cross-section of the band: the segment of points that count as on the path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Section {
    /// Point on the chord.
    pub(super) base: Point,
    /// Vector from `base` to the far end of the sagitta, mm.
    pub(super) sagitta: Vector,
    /// Fraction of the tolerance that may be used here.
    pub(super) share: f64,
}

impl ToleranceBand {
    /// The plain neighbourhood of a polyline.
    pub(in crate::plan) fn plain(points: Vec<Point>, tolerance: f64) -> Self {
        let stations = polyline::stations(&points);
        let inner = points.windows(3).map(|w| polyline::turn_at(w[0], w[1], w[2]));
        let turns = std::iter::once(0.0).chain(inner).chain([0.0]).collect();
        let sagittas = vec![Vector::zeros(); points.len() - 1];
        let shares = vec![1.0; points.len() - 1];
        Self { points, stations, turns, sagittas, shares, near: [Near::default(); 2], tolerance, lap: None }
    }

    /// Reduces the tolerance to a fraction, without sagitta, on the flagged chords.
    pub(in crate::plan) fn with_junctions(mut self, junctions: &[bool], share: f64) -> Self {
        for chord in (0..junctions.len()).filter(|&chord| junctions[chord]) {
            (self.sagittas[chord], self.shares[chord]) = (Vector::zeros(), share.min(self.shares[chord]));
        }
        self
    }

    /// Limits the deviation at the start and the end.
    pub(in crate::plan) fn with_ends(mut self, near: [Near; 2]) -> Self {
        self.near = near;
        self
    }

    /// Sets the lap of a ring.
    pub(in crate::plan) fn with_lap(mut self, lap: Option<Lap>) -> Self {
        self.lap = lap;
        self
    }

    /// The band of a polyline, with sagittas.
    pub(in crate::plan) fn new(points: Vec<Point>, tolerance: f64, profile: &MachineProfile) -> Self {
        let mut band = Self::plain(points, tolerance);
        let ends = band.points.windows(2).zip(band.turns.windows(2));
        let sagitta = |(p, turns): (&[Point], &[f64])| {
            let length = (p[1] - p[0]).norm();
            left((p[1] - p[0]) / length) * bulge(length, [turns[0], turns[1]], profile)
        };
        band.sagittas = ends.map(sagitta).collect();
        band
    }

    /// Angle between a chord and its curve at the ends of the chord, estimated from the sagitta, rad: 4 h / L for a parabola.
    pub(in crate::plan) fn bow_at(&self, station: f64) -> f64 {
        let chord = spline::span(&self.stations, station);
        4.0 * self.sagittas[chord].norm() / (self.stations[chord + 1] - self.stations[chord])
    }

    /// Length of the polyline, mm.
    pub(super) fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// Index of the chord at station `u`.
    #[cfg(test)]
    pub(super) fn chord(&self, u: f64) -> usize {
        spline::span(&self.stations, u)
    }

    /// The cross-section at station `u`. At the fraction x of the chord, the arc is 4 x (1 - x) of the sagitta above it.
    pub(super) fn section(&self, chord: usize, u: f64) -> Section {
        let (start, end) = (self.stations[chord], self.stations[chord + 1]);
        let x = ((u - start) / (end - start)).clamp(0.0, 1.0);
        let base = self.points[chord] + (self.points[chord + 1] - self.points[chord]) * x;
        let [start, end] = self.near;
        let mut share = self.shares[chord];
        if u < start.length {
            share = share.min(start.share);
        }
        if u > self.length() - end.length {
            share = share.min(end.share);
        }
        Section { base, sagitta: self.sagittas[chord] * (4.0 * x * (1.0 - x)), share }
    }
}

impl Section {
    /// Middle of the points that count as on the path.
    pub(super) fn middle(&self) -> Point {
        self.base + self.sagitta * 0.5
    }

    /// The deviation of a point as a vector, and the sagitta that it uses, mm.
    pub(super) fn deviation(&self, point: Point) -> (Vector, f64) {
        let away = point - self.base;
        let height = self.sagitta.norm();
        if height == 0.0 {
            return (away, 0.0);
        }
        let outward = self.sagitta / height;
        let used = away.dot(&outward).clamp(0.0, height);
        (away - outward * used, used)
    }

    /// The outward unit normal, if the point lies beside the sagitta, where moving along it does not change the deviation.
    pub(super) fn free_direction(&self, point: Point) -> Option<Vector> {
        let height = self.sagitta.norm();
        let outward = self.sagitta.try_normalize(0.0)?;
        let used = (point - self.base).dot(&outward);
        (used > 0.0 && used < height).then_some(outward)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Fit;

    fn circle(radius: f64, n: usize) -> Vec<Point> {
        (0..=n)
            .map(|i| (i as f64 / n as f64).mul_add(std::f64::consts::TAU, 0.0))
            .map(|a| Point::new(radius * a.cos(), radius * a.sin()))
            .collect()
    }

    #[test]
    fn the_circle_that_was_flattened_lies_inside_the_band() {
        let profile = MachineProfile::default();
        let band = ToleranceBand::new(circle(6.4, 15), 0.05, &profile);
        for i in 1..14 {
            let u = f64::midpoint(band.stations[i], band.stations[i + 1]);
            let section = band.section(i, u);
            let on_circle = Point::from(section.base.coords.normalize() * 6.4);
            let (away, used) = section.deviation(on_circle);
            assert!(away.norm() < 0.01 && used > 0.12, "{} {used}", away.norm());
            let inward = Point::from(section.base.coords.normalize() * 6.0);
            assert!(section.deviation(inward).0.norm() > 0.2);
        }
    }

    #[test]
    fn end_chords_and_polygons_are_plain() {
        let mut profile = MachineProfile::default();
        let band = ToleranceBand::new(circle(6.4, 15), 0.05, &profile);
        assert_eq!(band.sagittas[0], Vector::zeros());
        assert_eq!(band.sagittas[14], Vector::zeros());
        profile.path.fit = Fit::Polygon;
        let band = ToleranceBand::new(circle(6.4, 15), 0.05, &profile);
        assert!(band.sagittas.iter().all(|b| *b == Vector::zeros()));
    }
}
