//! Where the centre of the cloth is by where the conveyor is.

use std::sync::Arc;

use crate::source::Source;

/// The line that the centre of a moving cloth takes across its conveyor.
#[derive(Debug, Clone, PartialEq)]
pub struct CentreLine {
    /// Place of the conveyor and of the centre, mm.
    rows: Vec<[f64; 2]>,
}

impl CentreLine {
    /// A line through rows: places of the conveyor and of the centre, mm. `None` unless there are two at the least, all
    /// finite, and the conveyor goes forward.
    pub fn new(rows: Vec<[f64; 2]>) -> Option<Self> {
        let is_sound = rows.len() > 1 && rows.iter().flatten().all(|value| value.is_finite());
        let goes_forward = rows.windows(2).all(|pair| pair[0][0] < pair[1][0]);
        (is_sound && goes_forward).then_some(Self { rows })
    }

    /// The rows.
    pub fn rows(&self) -> &[[f64; 2]] {
        &self.rows
    }

    /// Where the conveyor is at the first row and at the last, mm.
    pub fn range(&self) -> [f64; 2] {
        [self.rows[0][0], self.rows[self.rows.len() - 1][0]]
    }

    /// Where the centre is, mm, when the conveyor is at `conveyor`, mm: between two rows on the straight line, beyond the ends
    /// as at the nearer one.
    pub fn at(&self, conveyor: f64) -> f64 {
        let behind = self.rows.partition_point(|[place, _]| *place <= conveyor);
        match (behind.checked_sub(1).map(|before| self.rows[before]), self.rows.get(behind)) {
            (Some([from, start]), Some([to, end])) => start + (end - start) * ((conveyor - from) / (to - from)),
            (Some([_, centre]), None) => centre,
            (None, _) => self.rows[0][1],
        }
    }

    /// The same by places of a cloth that runs towards +X, mm, where rulers at `rulers` mm have found it: those see the front
    /// first.
    #[must_use]
    pub fn on_cloth(&self, rulers: f64) -> Self {
        Self { rows: self.rows.iter().rev().map(|[conveyor, centre]| [rulers - conveyor, *centre]).collect() }
    }

    /// The line through some of its rows that is never farther from it than `within`, mm: from each row on it goes to the last
    /// one that it can.
    #[must_use]
    pub fn simplified(&self, within: f64) -> Self {
        let mut rows = vec![self.rows[0]];
        let mut from = 0;
        while from + 1 < self.rows.len() {
            let [x, y] = self.rows[from];
            // Slopes that pass all rows so far near enough.
            let [mut least, mut most] = [f64::NEG_INFINITY, f64::INFINITY];
            let mut last = from + 1;
            for (i, [next, centre]) in self.rows.iter().enumerate().skip(from + 1) {
                if (least..=most).contains(&((centre - y) / (next - x))) {
                    last = i;
                }
                least = least.max((centre - within - y) / (next - x));
                most = most.min((centre + within - y) / (next - x));
                if least > most {
                    break;
                }
            }
            rows.push(self.rows[last]);
            from = last;
        }
        Self { rows }
    }
}

/// A centre line as a file tells it.
#[derive(Debug)]
pub struct Centre {
    /// The line.
    pub line: CentreLine,
    /// The file.
    pub source: Arc<Source>,
    /// The place of the rulers, mm, where the cloth runs to +X under them, as over the conveyor of `cutc flow`; `None` where
    /// the conveyor counts the X that it brings.
    pub rulers: Option<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(rows: &[[f64; 2]]) -> Option<CentreLine> {
        CentreLine::new(rows.to_vec())
    }

    #[test]
    fn the_centre_is_straight_between_rows_and_stays_beyond_them() {
        let line = line(&[[0.0, 1.0], [10.0, 3.0], [20.0, -1.0]]).expect("a line");
        let places = [-5.0, 0.0, 5.0, 10.0, 15.0, 20.0, 99.0].map(|at| line.at(at));
        assert_eq!((places, line.range()), ([1.0, 1.0, 2.0, 3.0, 1.0, -1.0, -1.0], [0.0, 20.0]));
    }

    #[test]
    fn a_line_goes_forward_and_has_two_ends() {
        assert!(line(&[[0.0, 0.0]]).is_none() && line(&[[0.0, 0.0], [0.0, 1.0]]).is_none());
        assert!(line(&[[1.0, 0.0], [0.0, 1.0]]).is_none() && line(&[[0.0, f64::NAN], [1.0, 0.0]]).is_none());
    }

    #[test]
    fn a_simplified_line_stays_within_and_has_few_rows() {
        let wander = |i: u32| [f64::from(i), 8.0 * (f64::from(i) / 160.0).sin()];
        let all = CentreLine::new((0..2000).map(wander).collect()).expect("a line");
        let few = all.simplified(0.0125);
        assert!(few.rows().len() < 130, "{}", few.rows().len());
        assert!(all.rows().iter().all(|[x, y]| (few.at(*x) - y).abs() <= 0.0125 + 1e-9));
        assert_eq!((few.range(), all.simplified(0.0).rows().len()), (all.range(), 2000));
        let straight = line(&[[0.0, 0.0], [1.0, 0.5], [2.0, 1.0], [4.0, 2.0]]).expect("a line");
        assert_eq!(straight.simplified(0.0).rows(), [[0.0, 0.0], [4.0, 2.0]]);
    }
}
