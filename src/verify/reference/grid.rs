//! Grid over the chords of all lines, for queries near a point.

use std::ops::RangeInclusive;

use super::line::Line;
use super::lines::Reference;
use crate::geom::{Extent, Point};

/// Smallest size of a cell, mm.
const CELL_MIN: f64 = 4.0;
/// Maximum number of cells per chord; then the smallest and the greatest total number of cells.
const CELLS_A_CHORD: f64 = 0.25;
const CELLS: [f64; 2] = [4096.0, 4_194_304.0];

/// Maximum average number of cells that a chord passes.
const CELLS_A_CHORD_PASSES: f64 = 8.0;
/// Greatest shift of a cell edge due to rounding, mm: markers are shorter than a thousand kilometres.
const EDGE: f64 = 1e-6;

/// Runs of chords that pass each cell, in buckets (CSR).
#[derive(Debug)]
pub(in crate::verify) struct Grid {
    origin: Point,
    cell: f64,
    columns: usize,
    rows: usize,
    starts: Vec<u32>,
    runs: Vec<Run>,
}

/// Consecutive chords of a line in a cell; most chords have neighbours there.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::verify) struct Run {
    line: u32,
    first: u32,
    last: u32,
}

impl Run {
    /// Index of the line.
    pub(in crate::verify) fn line(&self) -> usize {
        self.line as usize
    }

    /// Indices of the chords on the line.
    pub(in crate::verify) fn chords(&self) -> RangeInclusive<usize> {
        self.first as usize..=self.last as usize
    }
}

impl Grid {
    /// Grid of all chords of the reference.
    pub(in crate::verify) fn new(reference: &Reference) -> Self {
        let mut extent = Extent::EMPTY;
        for line in &reference.lines {
            line.points().for_each(|point| extent.add(point));
        }
        if extent.is_empty() {
            extent.add(Point::origin());
        }
        let (width, height) = extent.size();
        let chords: usize = reference.lines.iter().map(Line::chords).sum();
        let [least, most] = CELLS;
        let count = (CELLS_A_CHORD * chords as f64).clamp(least, most);
        // A long and narrow marker has cells in proportion to its length.
        let length: f64 = reference.lines.iter().map(Line::length).sum();
        // Long chords pass many cells.
        let by_length = length / (CELLS_A_CHORD_PASSES * chords.max(1) as f64);
        let cell = CELL_MIN.max((width * height / count).sqrt()).max(width.max(height) / count).max(by_length);
        let (columns, rows) = ((width / cell) as usize + 1, (height / cell) as usize + 1);
        let mut grid = Self { origin: extent.min, cell, columns, rows, starts: Vec::new(), runs: Vec::new() };
        // Counting sort: first the counts, then the starts; while filling, the start of each cell advances to that of the next.
        let mut starts = vec![0_u32; columns * rows + 1];
        grid.each(reference, |cell, _, is_led_on| starts[cell] += u32::from(!is_led_on));
        let mut count = 0;
        for start in &mut starts {
            count += std::mem::replace(start, count);
        }
        let mut runs = vec![Run::default(); count as usize];
        grid.each(reference, |cell, (line, chord), is_led_on| {
            if is_led_on {
                runs[starts[cell] as usize - 1].last = chord;
            } else {
                runs[starts[cell] as usize] = Run { line, first: chord, last: chord };
                starts[cell] += 1;
            }
        });
        starts.rotate_right(1);
        starts[0] = 0;
        (grid.starts, grid.runs) = (starts, runs);
        grid
    }

    /// Calls `see` for each chord and each cell that it passes; the flag is true if the previous chord of the line passes the
    /// cell, too. Cells are found column by column, from the range of rows that the chord covers there.
    fn each(&self, reference: &Reference, mut see: impl FnMut(usize, (u32, u32), bool)) {
        // Number of the last chord of each cell, plus one. A number is skipped between the last chord of a line and the first
        // of the next.
        let (mut number, mut passed) = (0, vec![u32::MAX; self.columns * self.rows]);
        for (l, line) in reference.lines.iter().enumerate() {
            for (c, (a, b)) in line.points().zip(line.points().skip(1)).enumerate() {
                let [from, to] = if a.x <= b.x { [a, b] } else { [b, a] };
                let [first, last] = [from.x, to.x].map(|x| self.column(x));
                for column in first..=last {
                    let edge = |column: usize| self.origin.x + self.cell * column as f64;
                    let y_at = |x: f64| from.y + (to.y - from.y) * ((x - from.x) / (to.x - from.x));
                    let enters = if column == first { from.y } else { y_at(edge(column)) };
                    let leaves = if column == last { to.y } else { y_at(edge(column + 1)) };
                    let [low, high] = [enters.min(leaves) - EDGE, enters.max(leaves) + EDGE].map(|y| self.row(y));
                    for cell in (low..=high).map(|row| row * self.columns + column) {
                        let before = std::mem::replace(&mut passed[cell], number + 1);
                        see(cell, (l as u32, c as u32), before == number);
                    }
                }
                number += 1;
            }
            number += 1;
        }
    }

    fn column(&self, x: f64) -> usize {
        (((x - self.origin.x) / self.cell).max(0.0) as usize).min(self.columns - 1)
    }

    fn row(&self, y: f64) -> usize {
        (((y - self.origin.y) / self.cell).max(0.0) as usize).min(self.rows - 1)
    }

    /// Runs with the chords that come within `reach` mm of a point, among others. A run occurs once for each cell that it
    /// passes.
    pub(in crate::verify) fn near(&self, point: Point, reach: f64) -> impl Iterator<Item = &Run> + '_ {
        self.about(Extent::between(point, point).grown(reach))
    }

    /// Runs with the chords that meet a box, among others.
    pub(in crate::verify) fn about(&self, extent: Extent) -> impl Iterator<Item = &Run> + '_ {
        let Extent { min, max } = extent.grown(EDGE);
        let rows = self.row(min.y)..=self.row(max.y);
        let columns = self.column(min.x)..=self.column(max.x);
        rows.flat_map(move |r| columns.clone().map(move |c| r * self.columns + c))
            .flat_map(|cell| &self.runs[self.starts[cell] as usize..self.starts[cell + 1] as usize])
    }
}
