//! Registration marks: places of the drawing that were found on the table, and the map that fits them; the keys `map.*`.

use std::fmt;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::key::{Key, Takes, from};
use crate::source::Source;
use crate::units::number::{fixed, up};

/// The keys `map.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "map.max_mm", takes: Takes::Number(from(0.01, 100.0)), about: "Greatest distance of a mark of `--map` from where the map of the others has it. Beyond it nothing\nis cut: a mark was read wrongly, or the cloth is not stretched evenly." },
];

/// Least width of the marks, as a share of their length: if they are nearly on a line, the map across it is a guess.
const LEAST_WIDTH: f64 = 0.01;

/// Decimals of distances, mm.
const DECIMALS: u32 = 2;

/// Least share of a misreading of a mark that shows in its distance from the map: below it the others lie on a line.
const LEAST_CHECKED: f64 = 1e-4;

/// Limits of maps by marks.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Map {
    /// Greatest distance of a mark from its place by the map of the others.
    pub max_mm: f64,
}

impl Default for Map {
    fn default() -> Self {
        Self { max_mm: 1.0 }
    }
}

/// Registration mark: its place in the drawing and its measured place on the table, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mark {
    /// X and Y in the drawing.
    pub drawn: [f64; 2],
    /// X and Y on the table.
    pub found: [f64; 2],
}

/// Marks of a file, with the map that fits them best.
#[derive(Debug)]
pub struct Marks {
    all: Vec<Mark>,
    map: AffineMap,
    spread: Spread,
    source: Arc<Source>,
}

/// Spread of marks in the drawing.
#[derive(Debug, Clone, Copy)]
struct Spread {
    count: f64,
    /// Mean place, mm.
    middle: [f64; 2],
    /// Inverse of the sum of d d^T, where d is the vector from the mean place to a mark, 1/mm^2.
    inverse: [[f64; 2]; 2],
}

impl Spread {
    /// Spread of marks; `None` if they are nearly on a line.
    fn of(marks: &[Mark]) -> Option<Self> {
        let count = marks.len() as f64;
        let middle = mean(marks, |mark| mark.drawn);
        let mut s = [[0.0; 2]; 2];
        for mark in marks {
            let d = less(mark.drawn, middle);
            for (row, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                s[row][column] += d[row] * d[column];
            }
        }
        let (trace, determinant) = (s[0][0] + s[1][1], s[0][0] * s[1][1] - s[0][1] * s[1][0]);
        // The eigenvalues of S are the squared length and width of the marks: their ratio is about det S / trace^2 for a long
        // strip.
        if determinant.is_nan() || determinant <= (LEAST_WIDTH * trace).powi(2) {
            return None;
        }
        let inverse = [[s[1][1], -s[0][1]], [-s[1][0], s[0][0]]].map(|row| row.map(|value| value / determinant));
        Some(Self { count, middle, inverse })
    }

    /// Leverage of a place: 1/n + d^T S^-1 d (linear regression). Its root is the standard error of the map there, in units of
    /// the standard error of a mark.
    fn leverage(&self, place: [f64; 2]) -> f64 {
        let d = less(place, self.middle);
        let [a, b] = self.inverse.map(|row| row[0] * d[0] + row[1] * d[1]);
        1.0 / self.count + d[0] * a + d[1] * b
    }
}

/// Mean of places of marks.
fn mean(marks: &[Mark], of: fn(&Mark) -> [f64; 2]) -> [f64; 2] {
    [0, 1].map(|k| marks.iter().map(|mark| of(mark)[k]).sum::<f64>() / marks.len() as f64)
}

/// Vector from a place to another.
fn less(to: [f64; 2], from: [f64; 2]) -> [f64; 2] {
    [to[0] - from[0], to[1] - from[1]]
}

/// Affine map of the plane: A p + b.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AffineMap {
    /// Images of the unit vectors along X and Y: the columns of A.
    pub axes: [[f64; 2]; 2],
    /// Image of the origin, mm: b.
    pub by: [f64; 2],
}

impl AffineMap {
    /// Map with the least sum of squared distances between marks and their mapped places; `None` if the marks are nearly on a
    /// line.
    ///
    /// With both places relative to their means, A = T S^-1, where S is the sum of d d^T and T that of f d^T over all marks
    /// (normal equations of linear regression).
    pub fn fit(marks: &[Mark]) -> Option<Self> {
        let Spread { middle: drawn, inverse, .. } = Spread::of(marks)?;
        let found = mean(marks, |mark| mark.found);
        let mut t = [[0.0; 2]; 2];
        for mark in marks {
            let (d, f) = (less(mark.drawn, drawn), less(mark.found, found));
            for (row, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                t[row][column] += f[row] * d[column];
            }
        }
        let axes =
            [0, 1].map(|column| [0, 1].map(|row| t[row][0] * inverse[0][column] + t[row][1] * inverse[1][column]));
        let by = [0, 1].map(|k| found[k] - axes[0][k] * drawn[0] - axes[1][k] * drawn[1]);
        Some(Self { axes, by })
    }

    /// Image of a place, mm.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let Self { axes: [along, across], by } = self;
        [0, 1].map(|k| along[k] * x + across[k] * y + by[k])
    }

    /// Distance of a mark from its mapped place, mm.
    pub fn off(&self, mark: &Mark) -> f64 {
        let [x, y] = self.place(mark.drawn);
        (x - mark.found[0]).hypot(y - mark.found[1])
    }

    fn determinant(&self) -> f64 {
        let [[a, b], [c, d]] = self.axes;
        a * d - b * c
    }

    /// True if the map mirrors.
    pub fn is_mirrored(&self) -> bool {
        self.determinant() < 0.0
    }

    /// Scale factors along X and along Y of the drawing.
    pub fn stretch(&self) -> [f64; 2] {
        self.axes.map(|[x, y]| x.hypot(y))
    }

    /// Greater scale factor.
    pub fn growth(&self) -> f64 {
        let [along, across] = self.stretch();
        along.max(across)
    }

    /// Rotation of X of the drawing, deg, counter-clockwise.
    pub fn turned_deg(&self) -> f64 {
        self.axes[0][1].atan2(self.axes[0][0]).to_degrees()
    }

    /// Angle between the mapped axes, less 90 deg.
    pub fn skewed_deg(&self) -> f64 {
        let [[a, b], [c, d]] = self.axes;
        self.determinant().atan2(a * c + b * d).to_degrees() - 90.0
    }
}

impl Marks {
    /// Marks of a file; `None` if they are nearly on a line.
    pub fn new(all: Vec<Mark>, source: Arc<Source>) -> Option<Self> {
        let (map, spread) = (AffineMap::fit(&all)?, Spread::of(&all)?);
        Some(Self { all, map, spread, source })
    }

    /// Number of marks.
    pub fn count(&self) -> usize {
        self.all.len()
    }

    /// Map that fits the marks.
    pub fn map(&self) -> &AffineMap {
        &self.map
    }

    /// File of the marks.
    pub fn source(&self) -> &Arc<Source> {
        &self.source
    }

    /// Index of the mark farthest from its place by the map of the others, and that distance, mm; infinite if the others give
    /// no map.
    ///
    /// The distance is e / (1 - h), where e is the distance from the map of all marks and h the leverage (deleted residual of
    /// linear regression). For four marks at corners it is 4 e.
    pub fn farthest(&self) -> (usize, f64) {
        let off = self.all.iter().map(|mark| {
            let rest = 1.0 - self.spread.leverage(mark.drawn);
            if rest < LEAST_CHECKED { f64::INFINITY } else { self.map.off(mark) / rest }
        });
        off.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default()
    }

    /// Error of the map at a place of the drawing, relative to the greatest one at a mark.
    pub fn error(&self, place: [f64; 2]) -> f64 {
        let at_marks = self.all.iter().map(|mark| self.spread.leverage(mark.drawn));
        (self.spread.leverage(place) / at_marks.fold(0.0, f64::max)).sqrt()
    }
}

/// Text of the summary.
impl fmt::Display for Marks {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [along, across] = self.map.stretch().map(|stretch| fixed(stretch, 4));
        let [turned, skewed] = [self.map.turned_deg(), self.map.skewed_deg()].map(|angle| fixed(angle, 3));
        write!(
            f,
            "{} marks, at most {} mm off; turned by {turned} deg, skewed by {skewed}, stretched by {along} x {across}",
            self.count(),
            up(self.farthest().1, DECIMALS)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Marks at corners of a cloth, with their places by a map.
    fn marks(map: &AffineMap, drawn: &[[f64; 2]]) -> Vec<Mark> {
        drawn.iter().map(|&drawn| Mark { drawn, found: map.place(drawn) }).collect()
    }

    const CORNERS: [[f64; 2]; 4] = [[10.0, 20.0], [6000.0, 20.0], [6000.0, 1480.0], [10.0, 1480.0]];
    const MAP: AffineMap = AffineMap { axes: [[1.003, 0.002], [-0.0025, 0.998]], by: [104.5, -3.25] };

    #[test]
    fn marks_that_a_map_has_moved_give_that_map() {
        let fit = AffineMap::fit(&marks(&MAP, &CORNERS)).expect("they lie on no line");
        for [x, y] in [[0.0, 0.0], [3000.0, 700.0], [9000.0, 1600.0]] {
            let (is, should) = (fit.place([x, y]), MAP.place([x, y]));
            assert!((is[0] - should[0]).hypot(is[1] - should[1]) < 1e-9, "{is:?} {should:?}");
        }
        assert!(!fit.is_mirrored() && fit.skewed_deg() > 0.02 && fit.skewed_deg() < 0.03);
    }

    #[test]
    fn no_other_map_has_a_smaller_sum_of_squares() {
        let mut marks = marks(&MAP, &[&CORNERS[..], &[[3000.0, 750.0], [1500.0, 300.0]]].concat());
        for (k, mark) in marks.iter_mut().enumerate() {
            mark.found[0] += [0.3, -0.2, 0.1, 0.4, -0.5, 0.2][k];
            mark.found[1] += [-0.1, 0.2, 0.3, -0.4, 0.1, 0.5][k];
        }
        let sum = |map: &AffineMap| marks.iter().map(|mark| map.off(mark).powi(2)).sum::<f64>();
        let fit = AffineMap::fit(&marks).expect("they lie on no line");
        for step in [-1.0, 1.0] {
            for (axis, k) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let mut other = fit;
                other.axes[axis][k] += step * 1e-6;
                assert!(sum(&other) > sum(&fit));
            }
            for k in 0..2 {
                let mut other = fit;
                other.by[k] += step * 1e-4;
                assert!(sum(&other) > sum(&fit));
            }
        }
    }

    #[test]
    fn marks_on_a_line_give_none() {
        let on_a_line: Vec<[f64; 2]> = (0..6).map(f64::from).map(|k| [1000.0 * k, 500.0 * k]).collect();
        assert_eq!(AffineMap::fit(&marks(&MAP, &on_a_line)), None);
        assert_eq!(AffineMap::fit(&marks(&MAP, &[[5.0, 5.0]; 4])), None);
        assert_eq!(AffineMap::fit(&[]), None);
        let strip = [[0.0, 0.0], [9000.0, 20.0], [9000.0, 0.0], [0.0, 20.0]];
        assert_eq!(AffineMap::fit(&marks(&MAP, &strip)), None);
    }

    #[test]
    fn a_mirrored_map_is_told() {
        let mirrored = AffineMap { axes: [[1.0, 0.0], [0.0, -1.0]], by: [0.0, 1500.0] };
        assert!(AffineMap::fit(&marks(&mirrored, &CORNERS)).expect("they lie on no line").is_mirrored());
    }
}
