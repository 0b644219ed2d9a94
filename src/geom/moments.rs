//! Moments of lines: sums over everything that is drawn. They do not depend on the order of drawing or on the division of
//! straight lines, and they change when a part moves, turns or is mirrored.

use std::ops::{AddAssign, Mul, Sub, SubAssign};

use super::Point;

/// The integrals of `x^i y^j` along lines up to the third degree: length, mm, then those of first, second and third degree, mm2
/// to mm4. The third degree is needed because a half turn of a part about its middle keeps all moments of even degree.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Moments([f64; TERMS]);

/// Number of integrals, and the degree of each.
const TERMS: usize = 10;
const DEGREES: [i32; TERMS] = [0, 1, 1, 2, 2, 2, 3, 3, 3, 3];

/// A comparison of moments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// Difference of the worst moment, as a distance, mm.
    pub distance: f64,
    /// Allowed difference of that moment, mm.
    pub limit: f64,
}

/// Tolerance for a comparison of moments.
#[derive(Debug, Clone, Copy)]
pub struct Allowance<'a> {
    /// Greatest coordinate, mm.
    pub reach: f64,
    /// Relative rounding error of the sums.
    pub epsilon: f64,
    /// Additional tolerance of each moment; never negative.
    pub slack: &'a Moments,
}

impl Moments {
    /// Moments of a straight line.
    pub fn line(from: Point, to: Point) -> Self {
        let way = to - from;
        let length = way.norm();
        // The line is its middle plus or minus the half: odd powers of the half cancel, its square has the mean 1/3.
        let (x, y) = (f64::midpoint(from.x, to.x), f64::midpoint(from.y, to.y));
        let (xx, xy, yy) = (way.x * way.x / 12.0, way.x * way.y / 12.0, way.y * way.y / 12.0);
        let means = [
            1.0,
            x,
            y,
            x * x + xx,
            x * y + xy,
            y * y + yy,
            x * (x * x + 3.0 * xx),
            y * (x * x + xx) + 2.0 * x * xy,
            x * (y * y + yy) + 2.0 * y * xy,
            y * (y * y + 3.0 * yy),
        ];
        Self(means.map(|mean| length * mean))
    }

    /// Moments of a polyline.
    pub fn of(points: impl IntoIterator<Item = Point>) -> Self {
        let mut points = points.into_iter();
        let mut sum = Self::default();
        let Some(mut from) = points.next() else { return sum };
        for to in points {
            sum += Self::line(from, to);
            from = to;
        }
        sum
    }

    /// Upper bound on the change of the moments when a line is displaced sideways by up to `off` and shortened by up to `lack`,
    /// mm. The line is `length` mm long and no coordinate exceeds `reach`. The bound of degree `d` is the following:
    ///
    /// `length d reach^(d-1) off + reach^d lack`
    pub fn beside(length: f64, reach: f64, [off, lack]: [f64; 2]) -> Self {
        let of = |degree: i32| {
            let turned = if degree > 0 { length * f64::from(degree) * reach.powi(degree - 1) * off } else { 0.0 };
            turned + reach.powi(degree) * lack
        };
        Self(DEGREES.map(of))
    }

    /// Length of the lines, mm.
    pub fn length(&self) -> f64 {
        self.0[0]
    }

    /// Absolute values.
    #[must_use]
    pub fn magnitudes(self) -> Self {
        Self(self.0.map(f64::abs))
    }

    /// Compares moments and returns the worst one, relative to its tolerance.
    pub fn compare(&self, other: &Self, Allowance { reach, epsilon, slack }: Allowance) -> Difference {
        let length = self.length().abs().max(other.length().abs());
        let of = |i: usize| {
            let scale = length * reach.powi(DEGREES[i] - 1);
            let slack = slack.0[i] / scale + epsilon * reach;
            Difference { distance: (self.0[i] - other.0[i]).abs() / scale, limit: slack }
        };
        let all = (0..TERMS).map(of).filter(|_| length > 0.0 && reach > 0.0);
        let worst = all.max_by(|a, b| (a.distance / a.limit).total_cmp(&(b.distance / b.limit)));
        worst.unwrap_or(Difference { distance: 0.0, limit: 0.0 })
    }
}

impl AddAssign for Moments {
    fn add_assign(&mut self, other: Self) {
        for (sum, term) in self.0.iter_mut().zip(other.0) {
            *sum += term;
        }
    }
}

impl SubAssign for Moments {
    fn sub_assign(&mut self, other: Self) {
        *self += other * -1.0;
    }
}

impl Sub for Moments {
    type Output = Self;

    fn sub(mut self, other: Self) -> Self {
        self -= other;
        self
    }
}

impl Mul<f64> for Moments {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self(self.0.map(|term| term * factor))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXACT: Allowance = Allowance { reach: 100.0, epsilon: 1e-12, slack: &Moments([0.0; TERMS]) };

    fn random_points(random: &mut fastrand::Rng) -> Vec<Point> {
        (0..20).map(|_| Point::new(100.0 * random.f64(), 100.0 * random.f64())).collect()
    }

    fn differ(a: &[Point], b: &[Point]) -> bool {
        let Difference { distance, limit } =
            Moments::of(a.iter().copied()).compare(&Moments::of(b.iter().copied()), EXACT);
        distance > limit
    }

    #[test]
    fn they_are_the_integrals_along_the_line() {
        let (from, to) = (Point::new(3.0, -2.0), Point::new(-5.0, 7.0));
        let found = Moments::line(from, to).0;
        let way = to - from;
        let powers = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2), (3, 0), (2, 1), (1, 2), (0, 3)];
        for (found, (i, j)) in found.into_iter().zip(powers) {
            // Midpoint rule with many steps.
            const STEPS: u32 = 10_000;
            let at = |k: u32| from + way * ((f64::from(k) + 0.5) / f64::from(STEPS));
            let mean = (0..STEPS).map(|k| at(k).x.powi(i) * at(k).y.powi(j)).sum::<f64>() / f64::from(STEPS);
            assert!((found - way.norm() * mean).abs() < 1e-4, "{i} {j}: {found} {}", way.norm() * mean);
        }
    }

    #[test]
    fn neither_order_nor_division_changes_them() {
        let points = random_points(&mut fastrand::Rng::with_seed(1));
        let mut turned = points.clone();
        turned.reverse();
        assert!(!differ(&points, &turned));
        let divided = points.windows(2).flat_map(|w| [w[0], w[0] + (w[1] - w[0]) * 0.3]);
        let divided: Vec<Point> = divided.chain(points.last().copied()).collect();
        assert!(!differ(&points, &divided));
    }

    #[test]
    fn what_moves_turns_or_is_mirrored_within_its_box_changes_them() {
        let mut random = fastrand::Rng::with_seed(2);
        for _ in 0..1000 {
            let points = random_points(&mut random);
            let check = |what: &str, change: &dyn Fn(Point) -> Point| {
                let changed: Vec<Point> = points.iter().map(|&point| change(point)).collect();
                assert!(differ(&points, &changed), "{what}");
            };
            let box_of = points.iter().fold(crate::geom::Extent::EMPTY, |mut extent, &point| {
                extent.add(point);
                extent
            });
            let sum = box_of.min + box_of.max.coords;
            check("mirrored", &|p| Point::new(sum.x - p.x, p.y));
            check("turned by half", &|p| Point::new(sum.x - p.x, sum.y - p.y));
            check("shifted", &|p| Point::new(p.x + 1e-6, p.y));
            let swapped = random.usize(0..points.len());
            check("swapped", &|p| if p == points[swapped] { Point::new(p.y, p.x) } else { p });
            // A half turn of lines about their own middle keeps every moment of even degree.
            let moments = Moments::of(points.iter().copied()).0;
            let middle = [moments[1] / moments[0], moments[2] / moments[0]];
            check("turned about its middle", &|p| Point::new(2.0 * middle[0] - p.x, 2.0 * middle[1] - p.y));
        }
    }

    #[test]
    fn nothing_is_like_nothing() {
        let none = Moments::default();
        assert_eq!(none.compare(&none, EXACT), Difference { distance: 0.0, limit: 0.0 });
        let some = Moments::line(Point::origin(), Point::new(1.0, 1.0));
        let Difference { distance, limit } = some.compare(&none, EXACT);
        assert!(distance > limit);
    }
}
