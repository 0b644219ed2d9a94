//! Splitting: a stretch is halved until a polynomial keeps each part of it.

use super::polynomial::{Polynomial, State};
use crate::machine::Basis;
use crate::spray::clock::Timed;

/// The fewest samples that a polynomial is fitted to: twice as many as it has coefficients.
const LEAST: usize = 12;

/// How far a motion may be from the course at its time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Allowed {
    /// The head, mm.
    pub(super) distance: f64,
    /// Its direction, rad.
    pub(super) turn: f64,
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
        let worst = worst(|time| polynomial.at(time), samples);
        Some(Self { polynomial, condition, worst })
    }
}

/// How far a motion is from samples at their times, mm and rad. What is no number is the worst.
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
