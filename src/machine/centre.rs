//! Where the centre of the cloth is by where the conveyor is.

use crate::source::Source;

/// The line that the centre of a moving cloth takes across the conveyor, as a file tells it.
#[derive(Debug)]
pub struct Centre {
    source: Source,
    /// Place of the conveyor and of the centre, mm.
    rows: Vec<[f64; 2]>,
}

impl Centre {
    /// A line of the rows that a source holds: places of the conveyor and of the centre, mm. `None` unless there are two at
    /// the least, all finite, and the conveyor goes forward.
    pub fn new(source: Source, rows: Vec<[f64; 2]>) -> Option<Self> {
        let is_sound = rows.len() > 1 && rows.iter().flatten().all(|value| value.is_finite());
        let goes_forward = rows.windows(2).all(|pair| pair[0][0] < pair[1][0]);
        (is_sound && goes_forward).then_some(Self { source, rows })
    }

    /// The rows.
    pub fn rows(&self) -> &[[f64; 2]] {
        &self.rows
    }

    /// The file that tells it.
    pub fn source(&self) -> &Source {
        &self.source
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
}

#[cfg(test)]
mod tests {
    use super::*;

    fn centre(rows: &[[f64; 2]]) -> Option<Centre> {
        Centre::new(Source::new("centre.csv", Vec::new()).expect("small"), rows.to_vec())
    }

    #[test]
    fn the_centre_is_straight_between_rows_and_stays_beyond_them() {
        let line = centre(&[[0.0, 1.0], [10.0, 3.0], [20.0, -1.0]]).expect("a line");
        assert_eq!(
            [-5.0, 0.0, 5.0, 10.0, 15.0, 20.0, 99.0].map(|at| line.at(at)),
            [1.0, 1.0, 2.0, 3.0, 1.0, -1.0, -1.0]
        );
        assert_eq!(line.range(), [0.0, 20.0]);
    }

    #[test]
    fn a_line_goes_forward_and_has_two_ends() {
        assert!(centre(&[[0.0, 0.0]]).is_none() && centre(&[[0.0, 0.0], [0.0, 1.0]]).is_none());
        assert!(centre(&[[1.0, 0.0], [0.0, 1.0]]).is_none() && centre(&[[0.0, f64::NAN], [1.0, 0.0]]).is_none());
    }
}
