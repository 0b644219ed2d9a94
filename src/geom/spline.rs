//! B-splines: basis functions, and curves as piecewise polynomials for fast evaluation.
//!
//! Basis functions after Piegl & Tiller, *The NURBS Book*, 2nd ed., algorithm A2.3. `K` is the order: degree + 1.

/// The knot vector of a spline of order `K` whose ends are interpolated: the first and last break `K` times.
pub fn clamped_knots<const K: usize>(breaks: &[f64]) -> Vec<f64> {
    let (first, last) = (breaks[0], breaks[breaks.len() - 1]);
    let mut knots = vec![first; K - 1];
    knots.extend_from_slice(breaks);
    knots.extend(std::iter::repeat_n(last, K - 1));
    knots
}

/// Length below which a span at the end of a slice is dropped: rounding of the cut.
pub const SLICE_EPSILON: f64 = 1e-9;

/// Number of control values of a spline of order `K` over `breaks`.
pub fn control_count<const K: usize>(breaks: &[f64]) -> usize {
    breaks.len() + K - 2
}

/// The span of `u`: the index of the last break that is not greater than `u`, without the last break of all.
pub fn span(breaks: &[f64], u: f64) -> usize {
    breaks.partition_point(|&b| b <= u).clamp(1, breaks.len() - 1) - 1
}

/// The `K` basis functions that do not vanish on span `span`, and their derivatives up to order `D - 1`, at `u`.
///
/// Row `d` holds the `d`-th derivatives; column `j` belongs to control value `span + j`.
#[allow(clippy::needless_range_loop, reason = "the indices are those of the source's algorithm")]
pub fn basis<const K: usize, const D: usize>(knots: &[f64], span: usize, u: f64) -> [[f64; K]; D] {
    let i = span + K - 1;
    // ndu: basis functions in the upper triangle, knot differences in the lower one.
    let mut ndu = [[0.0; K]; K];
    let (mut left, mut right) = ([0.0; K], [0.0; K]);
    ndu[0][0] = 1.0;
    for j in 1..K {
        left[j] = u - knots[i + 1 - j];
        right[j] = knots[i + j] - u;
        let mut saved = 0.0;
        for r in 0..j {
            ndu[j][r] = right[r + 1] + left[j - r];
            let share = ndu[r][j - 1] / ndu[j][r];
            ndu[r][j] = saved + right[r + 1] * share;
            saved = left[j - r] * share;
        }
        ndu[j][j] = saved;
    }
    let mut ders = [[0.0; K]; D];
    for j in 0..K {
        ders[0][j] = ndu[j][K - 1];
    }
    for r in 0..K {
        let mut a = [[0.0; K]; 2];
        let (mut s1, mut s2) = (0, 1);
        a[0][0] = 1.0;
        for k in 1..D.min(K) {
            let mut d = 0.0;
            let low = K - 1 - k;
            if r >= k {
                a[s2][0] = a[s1][0] / ndu[low + 1][r - k];
                d = a[s2][0] * ndu[r - k][low];
            }
            let j1 = if r + 1 >= k { 1 } else { k - r };
            let j2 = if r <= low + 1 { k - 1 } else { K - 1 - r };
            for j in j1..=j2 {
                a[s2][j] = (a[s1][j] - a[s1][j - 1]) / ndu[low + 1][r + j - k];
                d += a[s2][j] * ndu[r + j - k][low];
            }
            if r <= low {
                a[s2][k] = -a[s1][k - 1] / ndu[low + 1][r];
                d += a[s2][k] * ndu[r][low];
            }
            ders[k][r] = d;
            std::mem::swap(&mut s1, &mut s2);
        }
    }
    let mut factor = 1.0;
    for k in 1..D.min(K) {
        factor *= (K - k) as f64;
        for j in 0..K {
            ders[k][j] *= factor;
        }
    }
    ders
}

/// A curve in `N` dimensions made of polynomials of order `K`, one per span, in powers of the distance from the span's start.
#[derive(Debug, Clone, PartialEq)]
pub struct Piecewise<const K: usize, const N: usize> {
    breaks: Vec<f64>,
    pieces: Vec<[[f64; N]; K]>,
}

impl<const K: usize, const N: usize> Piecewise<K, N> {
    /// The B-spline over `breaks` with the given control values.
    pub fn from_control(breaks: Vec<f64>, control: &[[f64; N]]) -> Self {
        debug_assert_eq!(control.len(), control_count::<K>(&breaks));
        let knots = clamped_knots::<K>(&breaks);
        let mut pieces = Vec::with_capacity(breaks.len() - 1);
        for span in 0..breaks.len() - 1 {
            let ders = basis::<K, K>(&knots, span, breaks[span]);
            let mut piece = [[0.0; N]; K];
            let mut factorial = 1.0;
            for (k, row) in ders.iter().enumerate() {
                factorial *= k.max(1) as f64;
                for (weight, value) in row.iter().zip(&control[span..span + K]) {
                    for (sum, v) in piece[k].iter_mut().zip(value) {
                        *sum += weight * v / factorial;
                    }
                }
            }
            pieces.push(piece);
        }
        Self { breaks, pieces }
    }

    /// The straight line between two values over the parameter interval `ends`.
    pub fn line(ends: [f64; 2], [from, to]: [[f64; N]; 2]) -> Self {
        const { assert!(K > 1, "a line needs a slope") };
        let mut piece = [[0.0; N]; K];
        piece[0] = from;
        piece[1] = std::array::from_fn(|i| (to[i] - from[i]) / (ends[1] - ends[0]));
        Self { breaks: ends.to_vec(), pieces: vec![piece] }
    }

    /// The curve over a parameter interval, shifted to start at 0. Spans shorter than [`SLICE_EPSILON`] at its ends join their
    /// neighbours.
    #[must_use]
    pub fn slice(&self, [from, to]: [f64; 2]) -> Self {
        let inner = |at: &f64| *at > from + SLICE_EPSILON && *at < to - SLICE_EPSILON;
        let first = self.breaks.partition_point(|&at| at <= from + SLICE_EPSILON).clamp(1, self.pieces.len()) - 1;
        let breaks: Vec<f64> = std::iter::once(from)
            .chain(self.breaks.iter().copied().filter(inner))
            .chain([to])
            .map(|at| at - from)
            .collect();
        let mut pieces = self.pieces[first..first + breaks.len() - 1].to_vec();
        // Taylor series about the new start of the first piece.
        let mut factorial = 1.0;
        for (k, row) in self.derivatives_on::<K>(first, from).into_iter().enumerate() {
            factorial *= k.max(1) as f64;
            pieces[0][k] = row.map(|v| v / factorial);
        }
        Self { breaks, pieces }
    }

    /// Breaks between the polynomials, ends included.
    pub fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    /// Value and derivatives up to order `D - 1` at `u`.
    pub fn derivatives<const D: usize>(&self, u: f64) -> [[f64; N]; D] {
        self.derivatives_on(span(&self.breaks, u), u)
    }

    /// Value and derivatives up to order `D - 1` at `u`, for a known span of `u`.
    pub fn derivatives_on<const D: usize>(&self, span: usize, u: f64) -> [[f64; N]; D] {
        let piece = &self.pieces[span];
        let x = u - self.breaks[span];
        // Horner's scheme for a polynomial and its derivatives; row d collects p^(d) / d!.
        let mut out = [[0.0; N]; D];
        for coefficient in piece.iter().rev() {
            for d in (1..D).rev() {
                let lower = out[d - 1];
                for (value, below) in out[d].iter_mut().zip(lower) {
                    *value = *value * x + below;
                }
            }
            for (value, c) in out[0].iter_mut().zip(coefficient) {
                *value = *value * x + c;
            }
        }
        let mut factorial = 1.0;
        for (d, row) in out.iter_mut().enumerate().skip(1) {
            factorial *= d as f64;
            for value in row {
                *value *= factorial;
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BREAKS: [f64; 6] = [0.0, 0.1, 0.5, 0.6, 1.9, 2.0];

    #[test]
    fn basis_functions_sum_to_one_and_their_derivatives_to_zero() {
        let knots = clamped_knots::<6>(&BREAKS);
        for u in [0.0, 0.05, 0.1, 0.55, 1.7, 2.0] {
            let ders = basis::<6, 5>(&knots, span(&BREAKS, u), u);
            assert!((ders[0].iter().sum::<f64>() - 1.0).abs() < 1e-12);
            for (k, row) in ders.iter().enumerate().skip(1) {
                let scale: f64 = row.iter().map(|v| v.abs()).sum();
                assert!(row.iter().sum::<f64>().abs() <= 1e-12 * scale, "derivative {k} at {u}");
            }
        }
    }

    #[test]
    fn a_piecewise_curve_is_its_b_spline_and_stays_smooth_at_breaks() {
        let knots = clamped_knots::<6>(&BREAKS);
        let control: Vec<[f64; 1]> = (0..control_count::<6>(&BREAKS)).map(|i| [(i as f64 * 1.7).sin()]).collect();
        let curve = Piecewise::<6, 1>::from_control(BREAKS.to_vec(), &control);
        for u in [0.0, 0.3, 0.57, 1.2, 2.0] {
            let s = span(&BREAKS, u);
            let ders = basis::<6, 5>(&knots, s, u);
            let got = curve.derivatives::<5>(u);
            for (row, value) in ders.iter().zip(got) {
                let expected: f64 = row.iter().zip(&control[s..]).map(|(w, c)| w * c[0]).sum();
                assert!((value[0] - expected).abs() <= 1e-9 * (1.0 + expected.abs()), "{u}");
            }
        }
        for (s, &meet) in BREAKS.iter().enumerate().take(BREAKS.len() - 1).skip(1) {
            let before = curve.derivatives_on::<5>(s - 1, meet);
            let after = curve.derivatives_on::<5>(s, meet);
            for (b, a) in before.iter().zip(after) {
                assert!((b[0] - a[0]).abs() < 1e-7 * (1.0 + a[0].abs()));
            }
        }
    }

    #[test]
    fn a_slice_is_the_curve_between_two_places() {
        let control: Vec<[f64; 1]> = (0..control_count::<6>(&BREAKS)).map(|i| [(i as f64 * 1.7).sin()]).collect();
        let curve = Piecewise::<6, 1>::from_control(BREAKS.to_vec(), &control);
        for [from, to] in [[0.0, 2.0], [0.05, 0.07], [0.05, 1.0], [0.1, 0.6], [0.1 - 1e-12, 0.6 + 1e-12], [1.95, 2.0]] {
            let slice = curve.slice([from, to]);
            assert!((slice.breaks()[slice.breaks().len() - 1] - (to - from)).abs() < 1e-15);
            assert!(slice.breaks().windows(2).all(|w| w[1] - w[0] > SLICE_EPSILON), "{:?}", slice.breaks());
            for k in 0..=20 {
                let x = (to - from) * f64::from(k) / 20.0;
                let (there, here) = (curve.derivatives::<4>(from + x), slice.derivatives::<4>(x));
                for (a, b) in there.iter().zip(here) {
                    assert!((a[0] - b[0]).abs() < 1e-7 * (1.0 + a[0].abs()), "{from} {to} {x}");
                }
            }
        }
    }
}
