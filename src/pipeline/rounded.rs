//! Rounding of figures for output: far below the resolution of a machine, without stray decimals.

use serde::{Serialize, Serializer};

/// Rounding of lengths and times, steps per unit: micrometres of a metre, microseconds of a second.
const MILLIONTHS: f64 = 1e6;
/// Greatest number of decimals that [`significant`] keeps: smaller digits are noise of the computation.
const MOST_DECIMALS: i32 = 12;

/// Value rounded to a number of significant digits, for output: the nearest number that prints that short.
pub fn significant(value: f64, digits: i32) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let decimals = (digits - 1 - value.abs().log10().floor() as i32).min(MOST_DECIMALS);
    let scale = 10_f64.powi(decimals.abs());
    // A quotient or product with an exact power of ten is rounded once, so that no stray decimals follow.
    if decimals < 0 { (value / scale).round() * scale } else { (value * scale).round() / scale }
}

/// Value rounded to millionths. Zero is positive: the sum of no lengths would be -0.
pub(super) fn to_millionths(value: f64) -> f64 {
    (value * MILLIONTHS).round() / MILLIONTHS + 0.0
}

/// Serializes a value rounded to millionths.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde hands fields over by reference")]
pub(super) fn micro<S: Serializer>(value: &f64, out: S) -> Result<S::Ok, S::Error> {
    to_millionths(*value).serialize(out)
}

/// Serializes an optional value rounded to millionths.
#[allow(clippy::ref_option, reason = "serde hands fields over by reference")]
pub(super) fn micro_known<S: Serializer>(value: &Option<f64>, out: S) -> Result<S::Ok, S::Error> {
    value.map(to_millionths).serialize(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_that_mean_nothing_are_cut_off() {
        let check = |value, digits, expected| assert_eq!(significant(value, digits), expected);
        check(1_199.954_212_454_599_7, 6, 1199.95);
        check(1_200.000_000_000_045_5, 6, 1200.0);
        check(1_004_000.9, 6, 1_004_000.0);
        check(-0.061_234_567, 3, -0.0612);
        check(0.0, 6, 0.0);
        check(1e-300, 6, 0.0);
        check(f64::INFINITY, 6, f64::INFINITY);
    }

    #[test]
    fn a_sum_of_no_lengths_has_no_sign() {
        assert_eq!(to_millionths(-0.0).to_string(), "0");
    }
}
