//! Polynomials of order 5 for X, Y and C, found by least squares or from the states at both ends.

use nalgebra::{SMatrix, SVector};

use crate::machine::Basis;
use crate::spray::clock::Timed;

/// Number of coefficients of a polynomial of order 5.
pub(super) const TERMS: usize = 6;

/// Position, speed and acceleration of X, Y (mm) and C (rad).
pub(super) type State = [[f64; 3]; 3];

/// X, Y and C over a time interval, each a polynomial of order 5.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::spray) struct Polynomial {
    basis: Basis,
    /// Time interval of the fit, s.
    pub(in crate::spray) ends: [f64; 2],
    /// Coefficients of X, Y and C, term by term.
    pub(in crate::spray) coefficients: [[f64; 3]; TERMS],
}

/// Values of the terms at a time, each with its first and second derivative.
fn terms(basis: Basis, [from, to]: [f64; 2], time: f64) -> [[f64; 3]; TERMS] {
    let (u, rate) = match basis {
        Basis::Monomial => (time, 1.0),
        Basis::Chebyshev => ((2.0 * time - from - to) / (to - from), 2.0 / (to - from)),
    };
    let mut terms = [[1.0, 0.0, 0.0], [u, 1.0, 0.0], [0.0; 3], [0.0; 3], [0.0; 3], [0.0; 3]];
    // Powers by u^n = u u^(n-1), Chebyshev polynomials by T_n = 2 u T_(n-1) - T_(n-2), derivatives by the product rule.
    let (factor, back) = match basis {
        Basis::Monomial => (1.0, 0.0),
        Basis::Chebyshev => (2.0, 1.0),
    };
    for n in 2..TERMS {
        let ([value, first, second], last) = (terms[n - 1], terms[n - 2]);
        terms[n] = [
            factor * u * value - back * last[0],
            factor * (value + u * first) - back * last[1],
            factor * (2.0 * first + u * second) - back * last[2],
        ];
    }
    terms.map(|[value, first, second]| [value, first * rate, second * rate * rate])
}

impl Polynomial {
    /// The polynomial of least squares through timed positions, and the condition number of its normal matrix; `None` if that
    /// cannot be solved. (Cink, Kosucki: T a = b with `T_st = sum t_i^(s+t)`, `b_s = sum x_i t_i^s`.)
    pub(super) fn fitted(samples: &[Timed], basis: Basis) -> Option<(Self, f64)> {
        let ends = [samples[0].time, samples[samples.len() - 1].time];
        let mut normal = SMatrix::<f64, TERMS, TERMS>::zeros();
        let mut right = SMatrix::<f64, TERMS, 3>::zeros();
        for Timed { time, node, .. } in samples {
            let row = SVector::<f64, TERMS>::from(terms(basis, ends, *time).map(|[value, ..]| value));
            normal += row * row.transpose();
            right += row * SVector::from([node.at.x, node.at.y, node.aim]).transpose();
        }
        let values = normal.symmetric_eigenvalues().map(f64::abs);
        let solved = normal.lu().solve(&right)?;
        let coefficients = std::array::from_fn(|i| std::array::from_fn(|j| solved[(i, j)]));
        Some((Self { basis, ends, coefficients }, values.max() / values.min()))
    }

    /// The polynomial of order 5 that leads from one state to another.
    pub(super) fn between(ends: [f64; 2], states: [State; 2]) -> Option<Self> {
        let basis = Basis::Chebyshev;
        let mut rows = SMatrix::<f64, TERMS, TERMS>::zeros();
        let mut right = SMatrix::<f64, TERMS, 3>::zeros();
        for (i, (time, state)) in ends.into_iter().zip(states).enumerate() {
            let terms = terms(basis, ends, time);
            for order in 0..3 {
                for (term, derivatives) in terms.iter().enumerate() {
                    rows[(3 * i + order, term)] = derivatives[order];
                }
                for axis in 0..3 {
                    right[(3 * i + order, axis)] = state[axis][order];
                }
            }
        }
        let solved = rows.lu().solve(&right)?;
        Some(Self { basis, ends, coefficients: std::array::from_fn(|i| std::array::from_fn(|j| solved[(i, j)])) })
    }

    /// Position, speed and acceleration at a time.
    pub(super) fn at(&self, time: f64) -> State {
        let terms = terms(self.basis, self.ends, time);
        std::array::from_fn(|axis| {
            std::array::from_fn(|order| terms.iter().zip(&self.coefficients).map(|(t, c)| t[order] * c[axis]).sum())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::spray::course::Node;

    fn samples(of: impl Fn(f64) -> [f64; 3], ends: [f64; 2], count: usize) -> Vec<Timed> {
        let at = |i: usize| {
            let time = ends[0] + (ends[1] - ends[0]) * i as f64 / (count - 1) as f64;
            let [x, y, aim] = of(time);
            Timed { time, node: Node { at: Point::new(x, y), aim }, leg: 0 }
        };
        (0..count).map(at).collect()
    }

    fn quintic(t: f64) -> [f64; 3] {
        [300.0 * t - 7.0 * t.powi(5), 2.0 + t.powi(2) - 4.0 * t.powi(3), 0.3 * t.powi(4)]
    }

    fn residual(polynomial: &Polynomial, samples: &[Timed]) -> f64 {
        let off = |sample: &Timed| {
            let [x, y, c] = polynomial.at(sample.time).map(|axis| axis[0]);
            (x - sample.node.at.x).powi(2) + (y - sample.node.at.y).powi(2) + (c - sample.node.aim).powi(2)
        };
        samples.iter().map(off).sum()
    }

    #[test]
    fn a_quintic_is_reproduced_in_either_basis() {
        let samples = samples(quintic, [0.5, 2.0], 200);
        for basis in [Basis::Chebyshev, Basis::Monomial] {
            let (fitted, _) = Polynomial::fitted(&samples, basis).expect("solvable");
            assert!(residual(&fitted, &samples).sqrt() < 1e-6, "{basis:?}");
            let [x, ..] = fitted.at(1.0);
            assert!((x[1] - 265.0).abs() < 1e-5 && (x[2] + 140.0).abs() < 1e-4, "{basis:?} {x:?}");
        }
    }

    #[test]
    fn the_orthogonal_basis_is_well_conditioned_and_powers_of_time_are_not() {
        let samples = samples(quintic, [10.0, 14.0], 400);
        let condition = |basis| Polynomial::fitted(&samples, basis).expect("solvable").1;
        assert!(condition(Basis::Chebyshev) < 10.0 && condition(Basis::Monomial) > 1e12);
    }

    #[test]
    fn a_motion_backwards_is_fitted_as_the_same_curve() {
        let wave = |t: f64| [100.0 * (3.0 * t).sin(), 50.0 * (2.0 * t).cos(), t];
        let forth = samples(wave, [0.0, 2.0], 101);
        let back = samples(|t| wave(2.0 - t), [0.0, 2.0], 101);
        let [forth, back] = [forth, back].map(|s| Polynomial::fitted(&s, Basis::Chebyshev).expect("solvable").0);
        for i in 0..=20 {
            let t = 0.1 * f64::from(i);
            let [a, b] = [forth.at(t), back.at(2.0 - t)];
            assert!((a[0][0] - b[0][0]).abs() < 1e-9 && (a[0][1] + b[0][1]).abs() < 1e-8);
        }
    }

    #[test]
    fn two_pieces_never_fit_worse_than_one() {
        let wave = |t: f64| [100.0 * (5.0 * t).sin(), 80.0 * (3.0 * t).cos(), t * t];
        let all = samples(wave, [0.0, 2.0], 201);
        let rest =
            |samples: &[Timed]| residual(&Polynomial::fitted(samples, Basis::Chebyshev).expect("solvable").0, samples);
        for at in [20, 77, 100, 150] {
            assert!(rest(&all[..at]) + rest(&all[at..]) <= rest(&all) * (1.0 + 1e-9), "{at}");
        }
    }

    #[test]
    fn a_transition_keeps_the_states_at_its_ends() {
        let states = [
            [[0.0, 300.0, 0.0], [5.0, 0.0, 9.0], [0.1, 0.0, 0.0]],
            [[90.0, 0.0, -3.0], [95.0, 300.0, 0.0], [1.7, 1.0, 0.0]],
        ];
        let between = Polynomial::between([2.0, 2.7], states).expect("solvable");
        for (time, state) in [2.0, 2.7].into_iter().zip(states) {
            let at = between.at(time);
            assert!(at.iter().flatten().zip(state.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-6), "{at:?}");
        }
    }
}
