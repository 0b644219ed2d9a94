//! Position of the centre of the cloth as a function of the position of the conveyor.

use std::sync::Arc;

use crate::source::Source;

/// Line that the centre of a moving cloth takes across its conveyor.
#[derive(Debug, Clone, PartialEq)]
pub struct CentreLine {
    /// Positions of the conveyor and of the centre, mm.
    rows: Vec<[f64; 2]>,
}

impl CentreLine {
    /// Line through rows of positions of the conveyor and of the centre, mm. `None` unless there are at least two rows, all
    /// finite, with increasing positions of the conveyor.
    pub fn new(rows: Vec<[f64; 2]>) -> Option<Self> {
        let is_sound = rows.len() > 1 && rows.iter().flatten().all(|value| value.is_finite());
        let goes_forward = rows.windows(2).all(|pair| pair[0][0] < pair[1][0]);
        (is_sound && goes_forward).then_some(Self { rows })
    }

    /// Rows: positions of the conveyor and of the centre, mm.
    pub fn rows(&self) -> &[[f64; 2]] {
        &self.rows
    }

    /// Positions of the conveyor at the first and the last row, mm.
    pub fn range(&self) -> [f64; 2] {
        [self.rows[0][0], self.rows[self.rows.len() - 1][0]]
    }

    /// Position of the centre, mm, when the conveyor is at `conveyor`, mm: linear between two rows, constant beyond the ends.
    pub fn at(&self, conveyor: f64) -> f64 {
        let behind = self.rows.partition_point(|[place, _]| *place <= conveyor);
        match (behind.checked_sub(1).map(|before| self.rows[before]), self.rows.get(behind)) {
            (Some([from, start]), Some([to, end])) => start + (end - start) * ((conveyor - from) / (to - from)),
            (Some([_, centre]), None) => centre,
            (None, _) => self.rows[0][1],
        }
    }

    /// Centre line by positions on a cloth that runs towards +X, mm, measured by rulers at `rulers` mm: these see its front
    /// first.
    #[must_use]
    pub fn on_cloth(&self, rulers: f64) -> Self {
        Self { rows: self.rows.iter().rev().map(|[conveyor, centre]| [rulers - conveyor, *centre]).collect() }
    }

    /// Line through some of its rows that stays within `within` mm of it. From each row it goes to the last row that this
    /// allows.
    #[must_use]
    pub fn simplified(&self, within: f64) -> Self {
        let mut rows = vec![self.rows[0]];
        let mut from = 0;
        while from + 1 < self.rows.len() {
            let [x, y] = self.rows[from];
            // Range of slopes that pass all rows so far near enough.
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

/// Centre line read from a file.
#[derive(Debug)]
pub struct Centre {
    /// Line.
    pub line: CentreLine,
    /// File.
    pub source: Arc<Source>,
    /// Position of the rulers, mm, if the cloth runs to +X under them, as over the conveyor of `cutc flow`; `None` if the
    /// conveyor counts the X that it brings.
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
