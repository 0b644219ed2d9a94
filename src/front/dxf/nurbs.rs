//! Splines: rational B-splines of any degree as chords.
//!
//! Points are evaluated by de Boor's algorithm in homogeneous coordinates (Piegl & Tiller, *The NURBS Book*, 2nd ed., sections
//! 3.1, 4.2).

use crate::geom::affine::Affine;
use crate::geom::{Point, Vector, polyline};

/// Maximum degree. CAD systems write 2 to 5, and never more than 11.
const HIGHEST_DEGREE: usize = 11;
/// Maximum number of bisections of a knot span, far more than a curve on a table needs.
const MOST_HALVINGS: u32 = 16;
/// Parameters at which a chord is compared with its curve, as fractions of the stretch.
const LOOKED_AT: [f64; 3] = [0.25, 0.5, 0.75];

/// A rational B-spline.
#[derive(Debug, Clone)]
pub(super) struct Nurbs {
    degree: usize,
    knots: Vec<f64>,
    /// Control points times their weights, mm, and the weights.
    control: Vec<(Vector, f64)>,
}

/// Fault of a spline, worded to follow "it has".
pub(super) type Flaw = &'static str;

impl Nurbs {
    /// Checks and creates a spline; empty `weights` means that all are 1.
    pub(super) fn of(degree: usize, knots: Vec<f64>, points: &[Point], weights: &[f64]) -> Result<Self, Flaw> {
        if !(1..=HIGHEST_DEGREE).contains(&degree) {
            return Err("a degree below 1 or above 11");
        }
        if points.len() <= degree {
            return Err("fewer control points than its degree needs");
        }
        if knots.len() != points.len() + degree + 1 {
            return Err("another number of knots than control points and degree need");
        }
        if !weights.is_empty() && weights.len() != points.len() {
            return Err("another number of weights than of control points");
        }
        if weights.iter().any(|weight| *weight <= 0.0) {
            return Err("a weight that is zero or negative");
        }
        if knots.windows(2).any(|pair| pair[1] < pair[0]) || knots[degree] >= knots[points.len()] {
            return Err("knots that do not rise");
        }
        if !(knots[knots.len() - 1] - knots[0]).is_finite() {
            return Err("knots that are too far apart");
        }
        let weight = |k: usize| weights.get(k).copied().unwrap_or(1.0);
        let control = points.iter().enumerate().map(|(k, point)| (point.coords * weight(k), weight(k))).collect();
        Ok(Self { degree, knots, control })
    }

    /// Image of the spline under a map.
    pub(super) fn mapped(&self, map: &Affine) -> Self {
        let place = |&(point, weight): &(Vector, f64)| (map.point(Point::from(point / weight)).coords * weight, weight);
        Self { control: self.control.iter().map(place).collect(), ..self.clone() }
    }

    /// The points of its chords from start to end, each chord within `sagitta` mm of the spline. `None` if there are more than
    /// `most`.
    pub(super) fn flatten(&self, sagitta: f64, most: usize) -> Option<Vec<Point>> {
        let (first, last) = (self.degree, self.control.len());
        let mut places = vec![self.place(self.knots[first])];
        // Spans of zero length, caused by repeated knots, have no part of the curve.
        for span in (first..last).filter(|&span| self.knots[span + 1] > self.knots[span]) {
            let [from, to] = [self.knots[span], self.knots[span + 1]];
            let parts = self.degree.max(2);
            for part in 0..parts {
                let at = |k: usize| from + (to - from) * k as f64 / parts as f64;
                let end = if part + 1 == parts { to } else { at(part + 1) };
                self.halve([at(part), end], sagitta, &mut places);
                if places.len() > most {
                    return None;
                }
            }
        }
        Some(places)
    }

    /// Adds the points after the start of a stretch, which is bisected until its chords are within `sagitta`.
    fn halve(&self, stretch: [f64; 2], sagitta: f64, places: &mut Vec<Point>) {
        let mut waiting = vec![(stretch, 0)];
        while let Some(([from, to], depth)) = waiting.pop() {
            let ends = [places[places.len() - 1], self.place(to)];
            let is_off = |share: &f64| {
                let at = self.place(from + (to - from) * share);
                polyline::distance_to_segment(at, ends[0], ends[1]) > sagitta
            };
            if depth < MOST_HALVINGS && LOOKED_AT.iter().any(is_off) {
                let middle = f64::midpoint(from, to);
                waiting.push(([middle, to], depth + 1));
                waiting.push(([from, middle], depth + 1));
            } else {
                places.push(ends[1]);
            }
        }
    }

    /// The point at a parameter of the domain.
    fn place(&self, at: f64) -> Point {
        let (p, last) = (self.degree, self.control.len() - 1);
        let span = self.knots.partition_point(|&knot| knot <= at).saturating_sub(1).clamp(p, last);
        let mut points: [(Vector, f64); HIGHEST_DEGREE + 1] = [(Vector::zeros(), 0.0); HIGHEST_DEGREE + 1];
        points[..=p].copy_from_slice(&self.control[span - p..=span]);
        for round in 1..=p {
            for j in (round..=p).rev() {
                let [low, high] = [self.knots[span - p + j], self.knots[span + 1 + j - round]];
                let share = if high > low { (at - low) / (high - low) } else { 0.0 };
                let [before, own] = [points[j - 1], points[j]];
                points[j] = (before.0 * (1.0 - share) + own.0 * share, before.1 * (1.0 - share) + own.1 * share);
            }
        }
        Point::from(points[p].0 / points[p].1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quarter() -> Nurbs {
        let root = std::f64::consts::FRAC_1_SQRT_2;
        let points = [Point::new(100.0, 0.0), Point::new(100.0, 100.0), Point::new(0.0, 100.0)];
        Nurbs::of(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], &points, &[1.0, root, 1.0]).expect("a spline")
    }

    #[test]
    fn a_rational_spline_of_degree_two_is_a_quarter_of_a_circle() {
        let places = quarter().flatten(0.01, 1000).expect("few");
        assert!(places.iter().all(|place| (place.coords.norm() - 100.0).abs() < 1e-9));
        for pair in places.windows(2) {
            assert!(100.0 - (pair[0] + (pair[1] - pair[0]) / 2.0).coords.norm() <= 0.01);
        }
        assert_eq!((places[0], places[places.len() - 1]), (Point::new(100.0, 0.0), Point::new(0.0, 100.0)));
    }

    #[test]
    fn repeated_knots_and_straight_splines_have_few_chords() {
        let points: Vec<Point> = (0..5).map(|k| Point::new(f64::from(k) * 30.0, 0.0)).collect();
        let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0, 2.0];
        let line = Nurbs::of(3, knots, &points, &[]).expect("a spline");
        let places = line.flatten(0.01, 1000).expect("few");
        assert!(places.len() <= 8 && places.iter().all(|place| place.y == 0.0));
        assert!(line.flatten(0.01, 3).is_none());
    }

    #[test]
    fn numbers_that_make_no_spline_are_refused() {
        let points: Vec<Point> = (0..4).map(|k| Point::new(f64::from(k), 0.0)).collect();
        let knots = || vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
        assert!(Nurbs::of(3, knots(), &points, &[]).is_ok());
        assert!(Nurbs::of(0, knots(), &points, &[]).is_err());
        assert!(Nurbs::of(3, knots(), &points[..3], &[]).is_err());
        assert!(Nurbs::of(3, knots()[1..].to_vec(), &points, &[]).is_err());
        assert!(Nurbs::of(3, knots(), &points, &[1.0, 0.0, 1.0, 1.0]).is_err());
        assert!(Nurbs::of(3, vec![0.0; 8], &points, &[]).is_err());
    }
}
