//! Registration marks, read again from the bytes of their file; their map is solved by another method than the compiler's.

use crate::machine::Job;

/// Smallest number of marks with which a wrong one can be detected.
const LEAST: usize = 4;
/// Least squared width of the marks, relative to their squared length: for a narrower strip the map is uncertain.
const LEAST_WIDTH: f64 = 1e-4;

/// Least visible share of a wrong reading: below it the other marks are collinear.
const LEAST_SHOWN: f64 = 1e-4;

/// Affine map of the marks of a job, and its greatest residual.
#[derive(Debug, Clone, Copy)]
pub(super) struct ByMarks {
    /// Images of steps of 1 mm along X and Y.
    pub(super) axes: [[f64; 2]; 2],
    /// Image of the origin, mm.
    pub(super) by: [f64; 2],
    /// Greatest deleted residual, mm: distance of a mark from its place by the map of the others; infinite without a map.
    pub(super) off: f64,
}

impl ByMarks {
    /// Map of the marks of a job; `None` without marks. A file that cannot be read has no map: `off` is infinite.
    pub(super) fn of(job: &Job) -> Option<Self> {
        let marks = job.marks.as_ref()?;
        let text = String::from_utf8_lossy(marks.source().bytes());
        let row = |line: &str| -> Option<[f64; 4]> {
            let numbers: Option<Vec<f64>> = line.split(',').map(|field| field.trim().parse().ok()).collect();
            numbers?.try_into().ok()
        };
        let rows = text.lines().filter(|line| !line.trim().is_empty()).skip(1);
        Some(Self::through(&rows.map(row).collect::<Option<Vec<_>>>().unwrap_or_default()))
    }

    /// Least-squares map through rows of X and Y as drawn and as found, mm.
    ///
    /// The columns 1, x and y are made orthogonal (Gram-Schmidt), and the found coordinates are projected on each of them.
    fn through(rows: &[[f64; 4]]) -> Self {
        let count = rows.len() as f64;
        let means = [0, 1, 2, 3].map(|k| rows.iter().map(|row| row[k]).sum::<f64>() / count);
        let column = |k: usize| rows.iter().map(|row| row[k] - means[k]).collect::<Vec<f64>>();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let (x, y) = (column(0), column(1));
        let lean = dot(&x, &y) / dot(&x, &x);
        let upright: Vec<f64> = x.iter().zip(&y).map(|(x, y)| y - lean * x).collect();
        let part = |k: usize| {
            let found = column(k);
            let across = dot(&found, &upright) / dot(&upright, &upright);
            [dot(&found, &x) / dot(&x, &x) - across * lean, across]
        };
        let [of_x, of_y] = [part(2), part(3)];
        let axes = [[of_x[0], of_y[0]], [of_x[1], of_y[1]]];
        let by = [0, 1].map(|k| means[2 + k] - axes[0][k] * means[0] - axes[1][k] * means[1]);
        // Leverage of a mark; one minus it is the share of a wrong reading that its residual shows.
        let own =
            |k: usize| 1.0 / count + x[k] * x[k] / dot(&x, &x) + upright[k] * upright[k] / dot(&upright, &upright);
        let off = |(k, row): (usize, &[f64; 4])| {
            let away = [0, 1].map(|k| axes[0][k] * row[0] + axes[1][k] * row[1] + by[k] - row[2 + k]);
            let shown = 1.0 - own(k);
            if shown < LEAST_SHOWN { f64::INFINITY } else { away[0].hypot(away[1]) / shown }
        };
        let is_wide = dot(&upright, &upright) > LEAST_WIDTH * dot(&x, &x).min(dot(&y, &y));
        let is_sound = rows.len() >= LEAST && is_wide && axes[0][0] * axes[1][1] > axes[0][1] * axes[1][0];
        let worst = rows.iter().enumerate().map(off).fold(0.0, |worst, off| if off <= worst { worst } else { off });
        Self { axes, by, off: if is_sound && worst.is_finite() { worst } else { f64::INFINITY } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{AffineMap, Mark};

    #[test]
    fn both_solutions_agree() {
        let mut rng = fastrand::Rng::with_seed(48);
        for count in 4..40 {
            let mark = |_| {
                let drawn = [rng.f64() * 20_000.0 - 5_000.0, rng.f64() * 1_800.0];
                let found = [1.01 * drawn[0] - 0.02 * drawn[1] + 90.0, 0.03 * drawn[0] + 0.99 * drawn[1] - 40.0];
                Mark { drawn, found: found.map(|place| place + 30.0 * rng.f64()) }
            };
            let marks: Vec<Mark> = (0..count).map(mark).collect();
            let rows: Vec<[f64; 4]> =
                marks.iter().map(|Mark { drawn, found }| [drawn[0], drawn[1], found[0], found[1]]).collect();
            let (one, other) = (AffineMap::fit(&marks).expect("on no line"), ByMarks::through(&rows));
            for (k, axis) in [0, 1].into_iter().flat_map(|k| [(k, 0), (k, 1)]) {
                assert!((one.axes[k][axis] - other.axes[k][axis]).abs() < 1e-11);
            }
            assert!((0..2).all(|k| (one.by[k] - other.by[k]).abs() < 1e-7));
            let without = |k: usize| {
                let rest = [&marks[..k], &marks[k + 1..]].concat();
                AffineMap::fit(&rest).map_or(0.0, |map| map.off(&marks[k]))
            };
            let worst = (0..marks.len()).map(without).fold(0.0, f64::max);
            assert!((worst - other.off).abs() < 1e-6 * worst, "{worst} {}", other.off);
        }
    }
    #[test]
    fn rows_that_give_no_map_are_infinitely_far_off() {
        let sound =
            [[0.0, 0.0, 5.0, 5.0], [900.0, 0.0, 905.0, 5.0], [900.0, 500.0, 905.0, 505.0], [0.0, 500.0, 5.0, 505.0]];
        assert!(ByMarks::through(&sound).off < 1e-9);
        let mirrored = sound.map(|[x, y, found_x, found_y]| [x, y, found_x, -found_y]);
        let on_a_line = sound.map(|[x, _, found_x, _]| [x, x, found_x, found_x]);
        for rows in [&sound[..3], &mirrored, &on_a_line, &[]] {
            assert_eq!(ByMarks::through(rows).off, f64::INFINITY);
        }
    }
}
