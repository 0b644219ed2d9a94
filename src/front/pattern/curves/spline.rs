//! Cubic splines parametrised by chord length.

use super::hermite::sprung;
use super::leg::Stretch;
use crate::geom::{Point, Vector};

/// Condition at the ends of a spline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ends {
    /// Second derivative of zero.
    Natural,
    /// Second derivative equal to that of the neighbouring knot: the end spans are parabolas.
    Parabolic,
}

/// Points between consecutive knots, in chords within `sagitta` mm; `None` if more than `most` points are needed.
pub(super) fn spans(knots: &[Point], ends: Ends, sagitta: f64, most: usize) -> Option<Vec<Stretch>> {
    let lengths: Vec<f64> = knots.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
    let bends = bends(knots, &lengths, ends);
    let mut spans = Vec::with_capacity(lengths.len());
    let mut count = 0;
    for (k, &length) in lengths.iter().enumerate() {
        let span = sprung([knots[k], knots[k + 1]], [bends[k], bends[k + 1]], length, sagitta);
        count += span.len();
        if count > most {
            return None;
        }
        spans.push(span);
    }
    Some(spans)
}

/// Second derivatives at the knots: the solution of the tridiagonal equations of a cubic spline (de Boor, A Practical Guide to
/// Splines, chapter IV), by forward elimination and back substitution.
fn bends(knots: &[Point], lengths: &[f64], ends: Ends) -> Vec<Vector> {
    let last = lengths.len();
    let mut bends = vec![Vector::zeros(); last + 1];
    if last < 2 {
        return bends;
    }
    let slope = |k: usize| (knots[k + 1] - knots[k]) / lengths[k];
    // For each inner knot, after elimination of the previous one: the factor of the next second derivative, and the right-hand
    // side.
    let mut rows: Vec<(f64, Vector)> = Vec::with_capacity(last - 1);
    for k in 1..last {
        let [before, behind] = [lengths[k - 1], lengths[k]];
        let mut middle = 2.0 * (before + behind);
        if ends == Ends::Parabolic {
            middle += if k == 1 { before } else { 0.0 } + if k + 1 == last { behind } else { 0.0 };
        }
        let mut right = (slope(k) - slope(k - 1)) * 6.0;
        if let Some(&(factor, rest)) = rows.last() {
            middle -= before * factor;
            right -= rest * before;
        }
        rows.push((behind / middle, right / middle));
    }
    for k in (1..last).rev() {
        let (factor, rest) = rows[k - 1];
        // The end condition is already included in the diagonal of the last row.
        let next = if k + 1 == last { Vector::zeros() } else { bends[k + 1] * factor };
        bends[k] = rest - next;
    }
    if ends == Ends::Parabolic {
        bends[0] = bends[1];
        bends[last] = bends[last - 1];
    }
    bends
}

#[cfg(test)]
mod tests {
    use super::*;

    fn knots(places: &[[f64; 2]]) -> Vec<Point> {
        places.iter().map(|&place| place.into()).collect()
    }

    #[test]
    fn bends_are_the_solution_of_their_equations() {
        let knots = knots(&[[0.0, 0.0], [30.0, 10.0], [50.0, 40.0], [90.0, 45.0], [100.0, 80.0]]);
        let h: Vec<f64> = knots.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
        for ends in [Ends::Natural, Ends::Parabolic] {
            let m = bends(&knots, &h, ends);
            for k in 1..4 {
                let left = m[k - 1] * h[k - 1] + m[k] * (2.0 * (h[k - 1] + h[k])) + m[k + 1] * h[k];
                let slope = |k: usize| (knots[k + 1] - knots[k]) / h[k];
                assert!((left - (slope(k) - slope(k - 1)) * 6.0).norm() < 1e-9, "{ends:?} {k}");
            }
            let is_free = m[0].norm() + m[4].norm() == 0.0;
            assert!(if ends == Ends::Natural { is_free } else { m[0] == m[1] && m[4] == m[3] });
        }
    }

    #[test]
    fn chords_keep_to_the_curve_within_the_sagitta() {
        let knots = knots(&[[0.0, 0.0], [100.0, 30.0], [150.0, 120.0], [140.0, 200.0]]);
        let [coarse, fine] = [0.02, 1e-5].map(|sagitta| {
            let spans = spans(&knots, Ends::Natural, sagitta, 1_000_000).expect("few places");
            let spans = spans.into_iter().chain([Vec::new()]);
            knots.iter().zip(spans).flat_map(|(&knot, span)| [vec![knot], span].concat()).collect::<Vec<Point>>()
        });
        let worst = fine.iter().map(|&at| crate::geom::polyline::distance(at, &coarse)).fold(0.0, f64::max);
        assert!((0.001..=0.02).contains(&worst), "{worst}");
    }
}
