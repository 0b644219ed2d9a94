//! Splitting of a stretch: it is halved until a polynomial fits each part within the tolerance.

use super::polynomial::{Polynomial, State};
use crate::machine::Basis;
use crate::spray::clock::Timed;

/// Minimum number of samples of a polynomial: twice the number of its coefficients.
const LEAST: usize = 12;

/// Permitted deviation of a motion from the course at its time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Allowed {
    /// Deviation of the position, mm.
    pub(super) distance: f64,
    /// Deviation of the direction, rad.
    pub(super) turn: f64,
}

/// A polynomial fitted to samples.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::spray) struct Fit {
    /// Polynomial of X, Y and C.
    pub(in crate::spray) polynomial: Polynomial,
    /// Condition number of the normal matrix.
    pub(in crate::spray) condition: f64,
    /// Maximum deviation from the samples at their times, mm and rad.
    pub(in crate::spray) worst: [f64; 2],
}

impl Fit {
    /// Fits samples by least squares; `None` if that cannot be solved.
    pub(super) fn of(samples: &[Timed], basis: Basis) -> Option<Self> {
        let (polynomial, condition) = Polynomial::fitted(samples, basis)?;
        let worst = worst(|time| polynomial.at(time), samples);
        Some(Self { polynomial, condition, worst })
    }
}

/// Maximum deviation of a motion from samples at their times, mm and rad. NaN counts as infinite.
pub(super) fn worst<'a>(motion: impl Fn(f64) -> State, samples: impl IntoIterator<Item = &'a Timed>) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    for Timed { time, node, .. } in samples {
        let [x, y, aim] = motion(*time);
        let off = [(x[0] - node.at.x).hypot(y[0] - node.at.y), (aim[0] - node.aim).abs()];
        for (worst, off) in worst.iter_mut().zip(off) {
            *worst = if off.is_nan() { f64::INFINITY } else { worst.max(off) };
        }
    }
    worst
}

/// Fits samples with as few repeated halvings as the tolerance allows. Where the samples are too few to be halved, the best fit
/// stays.
pub(super) fn split(samples: &[Timed], basis: Basis, within: Allowed) -> Option<Vec<Fit>> {
    let whole = Fit::of(samples, basis)?;
    let keeps = whole.worst[0] <= within.distance && whole.worst[1] <= within.turn;
    let middle = samples.len() / 2;
    if keeps || middle < LEAST {
        return Some(vec![whole]);
    }
    // Both halves contain the middle sample.
    let mut fits = split(&samples[..=middle], basis, within)?;
    fits.extend(split(&samples[middle..], basis, within)?);
    Some(fits)
}
