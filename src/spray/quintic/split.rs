//! Splitting: a stretch is halved until a polynomial keeps each part of it.

use super::polynomial::Polynomial;
use crate::machine::Basis;
use crate::spray::clock::Timed;

/// The fewest samples that a polynomial is fitted to: twice as many as it has coefficients.
const LEAST: usize = 12;

/// How far a motion may be from the course at its time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::spray) struct Allowed {
    /// The head, mm.
    pub(in crate::spray) distance: f64,
    /// Its direction, rad.
    pub(in crate::spray) turn: f64,
}

/// A polynomial that was fitted to samples.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::spray) struct Fit {
    /// X, Y and C.
    pub(in crate::spray) polynomial: Polynomial,
    /// The condition of its normal matrix.
    pub(in crate::spray) condition: f64,
    /// How far it is from the samples at their times, mm and rad.
    pub(in crate::spray) worst: [f64; 2],
}

impl Fit {
    /// The least squares.
    pub(super) fn of(samples: &[Timed], basis: Basis) -> Option<Self> {
        let (polynomial, condition) = Polynomial::fitted(samples, basis)?;
        let worst = samples.iter().fold([0.0; 2], |worst, sample| {
            let off = off(polynomial.at(sample.time), sample);
            [f64::max(worst[0], off[0]), f64::max(worst[1], off[1])]
        });
        Some(Self { polynomial, condition, worst })
    }
}

/// How far a state is from a sample, mm and rad.
pub(super) fn off([x, y, aim]: super::polynomial::State, sample: &Timed) -> [f64; 2] {
    let node = sample.node;
    [(x[0] - node.at.x).hypot(y[0] - node.at.y), (aim[0] - node.aim).abs()]
}

/// As few halves of halves as keep what is allowed; where samples are too few to halve them, the best there is.
pub(super) fn split(samples: &[Timed], basis: Basis, within: Allowed) -> Option<Vec<Fit>> {
    let whole = Fit::of(samples, basis)?;
    let keeps = whole.worst[0] <= within.distance && whole.worst[1] <= within.turn;
    let middle = samples.len() / 2;
    if keeps || middle < LEAST {
        return Some(vec![whole]);
    }
    // Both have the sample in the middle.
    let mut fits = split(&samples[..=middle], basis, within)?;
    fits.extend(split(&samples[middle..], basis, within)?);
    Some(fits)
}
