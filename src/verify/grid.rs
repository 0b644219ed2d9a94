//! A grid over the chords of all lines, to find those near a point.

use super::reference::{Line, Reference};
use crate::geom::{Extent, Point};

/// Least size of a cell, mm.
const CELL_MIN: f64 = 4.0;
/// Cells for each chord, at the most; and the least and greatest number of all.
const CELLS_A_CHORD: f64 = 4.0;
const CELLS: [f64; 2] = [4096.0, 4_194_304.0];

/// For each cell the chords that pass it: (line, chord), laid out one cell after the other.
#[derive(Debug)]
pub(super) struct Grid {
    origin: Point,
    cell: f64,
    columns: usize,
    rows: usize,
    starts: Vec<u32>,
    chords: Vec<(u32, u32)>,
}

impl Grid {
    /// The grid of all chords.
    pub(super) fn new(reference: &Reference) -> Self {
        let mut extent = Extent::EMPTY;
        for line in &reference.lines {
            line.points.iter().for_each(|&p| extent.add(p));
        }
        if extent.is_empty() {
            extent.add(Point::origin());
        }
        let (width, height) = extent.size();
        let chords: usize = reference.lines.iter().map(Line::chords).sum();
        let [least, most] = CELLS;
        let count = (CELLS_A_CHORD * chords as f64).clamp(least, most);
        // What is long and narrow has as many cells as it is long.
        let cell = CELL_MIN.max((width * height / count).sqrt()).max(width.max(height) / count);
        let (columns, rows) = ((width / cell) as usize + 1, (height / cell) as usize + 1);
        let mut grid = Self { origin: extent.min, cell, columns, rows, starts: Vec::new(), chords: Vec::new() };
        // Counting sort: first how many, then where.
        let mut counts = vec![0_u32; columns * rows + 1];
        grid.each(reference, |cell, _| counts[cell + 1] += 1);
        for i in 1..counts.len() {
            counts[i] += counts[i - 1];
        }
        let mut next = counts.clone();
        let mut chords = vec![(0, 0); counts[columns * rows] as usize];
        grid.each(reference, |cell, chord| {
            chords[next[cell] as usize] = chord;
            next[cell] += 1;
        });
        (grid.starts, grid.chords) = (counts, chords);
        grid
    }

    /// Calls `see` for each cell of each chord.
    fn each(&self, reference: &Reference, mut see: impl FnMut(usize, (u32, u32))) {
        for (l, line) in reference.lines.iter().enumerate() {
            for (c, ends) in line.points.windows(2).enumerate() {
                // Steps of half a cell: what they miss lies within a cell of what they find.
                let steps = ((ends[1] - ends[0]).norm() / (0.5 * self.cell)).ceil().max(1.0) as usize;
                let mut last = usize::MAX;
                for i in 0..=steps {
                    let here = self.cell_of(ends[0] + (ends[1] - ends[0]) * (i as f64 / steps as f64));
                    if here != last {
                        see(here, (l as u32, c as u32));
                        last = here;
                    }
                }
            }
        }
    }

    fn column_row(&self, point: Point) -> (usize, usize) {
        let place = |value: f64, count: usize| ((value / self.cell).max(0.0) as usize).min(count - 1);
        (place(point.x - self.origin.x, self.columns), place(point.y - self.origin.y, self.rows))
    }

    fn cell_of(&self, point: Point) -> usize {
        let (column, row) = self.column_row(point);
        row * self.columns + column
    }

    /// The chords in the cell of a point and the eight around it: all that come nearer than half a cell, and others.
    pub(super) fn near(&self, point: Point) -> impl Iterator<Item = (u32, u32)> + '_ {
        let (column, row) = self.column_row(point);
        let rows = row.saturating_sub(1)..=(row + 1).min(self.rows - 1);
        let columns = column.saturating_sub(1)..=(column + 1).min(self.columns - 1);
        rows.flat_map(move |r| columns.clone().map(move |c| r * self.columns + c))
            .flat_map(|cell| &self.chords[self.starts[cell] as usize..self.starts[cell + 1] as usize])
            .copied()
    }
}
