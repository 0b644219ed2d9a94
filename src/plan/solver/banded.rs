//! Symmetric positive definite band matrices, where the spline and the timing spend most of their time.
//!
//! The factorisation is Cholesky's, row by row (Golub & Van Loan, *Matrix Computations*, 4th ed., section 4.3.5), after scaling
//! to a unit diagonal, because spline bases over graded knots differ by many orders of magnitude.

/// A symmetric matrix of half bandwidth `W - 1`: its lower triangle, row by row.
///
/// `rows[i][W - 1 - k]` is the entry in row `i`, column `i - k`.
#[derive(Debug, Clone)]
pub(in crate::plan) struct BandMatrix<const W: usize> {
    rows: Vec<[f64; W]>,
}

/// The matrix is not positive definite in floating point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::plan) struct Indefinite;

/// Added to the unit diagonal: far above the rounding of a factorisation, far too small to affect a Newton step.
const DIAGONAL_EPSILON: f64 = 1e-13;

impl<const W: usize> BandMatrix<W> {
    /// The zero matrix of `n` rows.
    pub(in crate::plan) fn zero(n: usize) -> Self {
        Self { rows: vec![[0.0; W]; n] }
    }

    /// Adds `weight * v v^T` at the rows from `first` on.
    pub(in crate::plan) fn add_square<const K: usize>(&mut self, first: usize, v: &[f64; K], weight: f64) {
        for (i, &vi) in v.iter().enumerate() {
            let scaled = weight * vi;
            let row = &mut self.rows[first + i];
            for (entry, vj) in row[W - 1 - i..].iter_mut().zip(v) {
                *entry += scaled * vj;
            }
        }
    }

    /// Adds the lower triangle of a symmetric block at the rows from `first` on.
    pub(in crate::plan) fn add_block<const K: usize>(&mut self, first: usize, block: &[[f64; K]; K]) {
        let rows = self.rows[first..].first_chunk_mut::<K>().expect("the block lies inside the matrix");
        for (i, (row, add)) in rows.iter_mut().zip(block).enumerate() {
            for (entry, value) in row[W - 1 - i..].iter_mut().zip(add) {
                *entry += value;
            }
        }
    }

    /// Adds `weight` times the entries of `other`.
    pub(in crate::plan) fn add(&mut self, other: &Self, weight: f64) {
        for (row, add) in self.rows.iter_mut().zip(&other.rows) {
            for (entry, value) in row.iter_mut().zip(add) {
                *entry += weight * value;
            }
        }
    }

    /// Adds to one entry at `row`, `column <= row`.
    pub(in crate::plan) fn add_entry(&mut self, row: usize, column: usize, value: f64) {
        self.rows[row][W - 1 - (row - column)] += value;
    }

    /// The entry at `row`, `column <= row`, inside the band.
    pub(in crate::plan) fn entry(&self, row: usize, column: usize) -> f64 {
        self.rows[row][W - 1 - (row - column)]
    }

    /// Number of rows.
    pub(in crate::plan) fn len(&self) -> usize {
        self.rows.len()
    }

    /// Replaces row and column `i` by those of the unit matrix, so that unknown `i` keeps its value. Each coupling is passed to
    /// `dropped(row, entry)` first.
    pub(in crate::plan) fn fix(&mut self, i: usize, mut dropped: impl FnMut(usize, f64)) {
        for k in 1..W.min(i + 1) {
            dropped(i - k, self.rows[i][W - 1 - k]);
        }
        for k in 1..W.min(self.rows.len() - i) {
            dropped(i + k, self.rows[i + k][W - 1 - k]);
            self.rows[i + k][W - 1 - k] = 0.0;
        }
        self.rows[i] = [0.0; W];
        self.rows[i][W - 1] = 1.0;
    }

    /// The product with a vector of points.
    pub(in crate::plan) fn times<const N: usize>(&self, x: &[[f64; N]]) -> Vec<[f64; N]> {
        let mut out = vec![[0.0; N]; x.len()];
        for (i, row) in self.rows.iter().enumerate() {
            for k in 0..W.min(i + 1) {
                let entry = row[W - 1 - k];
                let mut add = |row: usize, column: usize| {
                    for (sum, value) in out[row].iter_mut().zip(&x[column]) {
                        *sum += entry * value;
                    }
                };
                add(i, i - k);
                if k > 0 {
                    add(i - k, i);
                }
            }
        }
        out
    }

    /// Scales the matrix to a unit diagonal and factors it, consuming the matrix.
    pub(in crate::plan) fn factor(mut self) -> Result<Factor<W>, Indefinite> {
        let scale: Vec<f64> = self.rows.iter().map(|row| 1.0 / row[W - 1].sqrt()).collect();
        if scale.iter().any(|s| !s.is_finite()) {
            return Err(Indefinite);
        }
        for i in 0..self.rows.len() {
            let (before, behind) = self.rows.split_at_mut(i);
            let row = &mut behind[0];
            for (entry, other) in row.iter_mut().rev().zip(scale[..=i].iter().rev()) {
                *entry *= scale[i] * other;
            }
            row[W - 1] = 1.0 + DIAGONAL_EPSILON;
            *row = if let Some(before) = before.last_chunk::<W>() {
                eliminate(row, before)?
            } else {
                // Rows before the first are those of the unit matrix.
                let mut unit = [0.0; W];
                unit[W - 1] = 1.0;
                let mut padded = [unit; W];
                padded[W - i..].copy_from_slice(before);
                eliminate(row, &padded)?
            };
        }
        Ok(Factor { rows: self.rows, scale })
    }
}

/// A row of the factor, from the row of the matrix and the factor's rows `before` it. Column `k` of the row corresponds to
/// `before[k + 1]`. The diagonal is stored as its inverse.
fn eliminate<const W: usize>(row: &[f64; W], before: &[[f64; W]; W]) -> Result<[f64; W], Indefinite> {
    let mut row = *row;
    for column in 0..W - 1 {
        let other = &before[column + 1];
        // Columns to the left that lie in both bands.
        let mut dot = 0.0;
        for k in 0..column {
            dot += row[k] * other[W - 1 - column + k];
        }
        row[column] = (row[column] - dot) * other[W - 1];
    }
    let square = row[W - 1] - row[..W - 1].iter().map(|v| v * v).sum::<f64>();
    if square.is_nan() || square <= 0.0 {
        return Err(Indefinite);
    }
    row[W - 1] = 1.0 / square.sqrt();
    Ok(row)
}

/// The Cholesky factor of a scaled band matrix.
#[derive(Debug)]
pub(in crate::plan) struct Factor<const W: usize> {
    rows: Vec<[f64; W]>,
    scale: Vec<f64>,
}

impl<const W: usize> Factor<W> {
    /// Solves for a right-hand side in place, separately for each coordinate of the points.
    pub(in crate::plan) fn solve<const N: usize>(&self, x: &mut [[f64; N]]) {
        for i in 0..x.len() {
            let mut value = x[i].map(|v| v * self.scale[i]);
            let row = &self.rows[i];
            for k in 1..W.min(i + 1) {
                for n in 0..N {
                    value[n] -= row[W - 1 - k] * x[i - k][n];
                }
            }
            x[i] = value.map(|v| v * row[W - 1]);
        }
        for i in (0..x.len()).rev() {
            let row = &self.rows[i];
            let value = x[i].map(|v| v * row[W - 1]);
            for k in 1..W.min(i + 1) {
                for n in 0..N {
                    x[i - k][n] -= row[W - 1 - k] * value[n];
                }
            }
            x[i] = value.map(|v| v * self.scale[i]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_factor_solves_what_the_matrix_multiplies() {
        let n = 20;
        let mut matrix = BandMatrix::<4>::zero(n);
        for first in 0..n - 3 {
            let v: [f64; 4] = std::array::from_fn(|j| ((first * 7 + j * j * 3) as f64).sin());
            matrix.add_square(first, &v, 1.0 + first as f64 * 1e3);
        }
        for i in 0..n {
            matrix.add_entry(i, i, 1e-3);
        }
        let x: Vec<[f64; 2]> = (0..n).map(|i| [i as f64, 1.0 - i as f64]).collect();
        let mut rhs = matrix.times(&x);
        matrix.factor().expect("positive definite").solve(&mut rhs);
        for (got, expected) in rhs.iter().zip(&x) {
            assert!((got[0] - expected[0]).abs() < 1e-4 && (got[1] - expected[1]).abs() < 1e-4, "{got:?} {expected:?}");
        }
    }

    #[test]
    fn an_indefinite_matrix_is_refused() {
        let mut matrix = BandMatrix::<4>::zero(2);
        matrix.add_entry(0, 0, 1.0);
        matrix.add_entry(1, 1, 1.0);
        matrix.add_entry(1, 0, 2.0);
        assert!(matrix.factor().is_err());
    }
}
