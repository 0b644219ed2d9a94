//! A grid over the chords of all lines, to find those near a point.

use super::line::Line;
use super::reference::Reference;
use crate::geom::{Extent, Point};

/// Least size of a cell, mm.
const CELL_MIN: f64 = 4.0;
/// Cells for each chord, at the most; and the least and greatest number of all.
const CELLS_A_CHORD: f64 = 1.0;
const CELLS: [f64; 2] = [4096.0, 4_194_304.0];

/// Cells that a chord passes on average, at the most.
const CELLS_A_CHORD_PASSES: f64 = 8.0;
/// By how much rounding may shift an edge of a cell, mm: markers are shorter than a thousand kilometres.
const EDGE: f64 = 1e-6;

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
            line.points().for_each(|point| extent.add(point));
        }
        if extent.is_empty() {
            extent.add(Point::origin());
        }
        let (width, height) = extent.size();
        let chords: usize = reference.lines.iter().map(Line::chords).sum();
        let [least, most] = CELLS;
        let count = (CELLS_A_CHORD * chords as f64).clamp(least, most);
        // What is long and narrow has as many cells as it is long.
        let length: f64 = reference.lines.iter().map(Line::length).sum();
        // Long chords pass many cells.
        let by_length = length / (CELLS_A_CHORD_PASSES * chords.max(1) as f64);
        let cell = CELL_MIN.max((width * height / count).sqrt()).max(width.max(height) / count).max(by_length);
        let (columns, rows) = ((width / cell) as usize + 1, (height / cell) as usize + 1);
        let mut grid = Self { origin: extent.min, cell, columns, rows, starts: Vec::new(), chords: Vec::new() };
        // Counting sort: first how many, then where; what is then the end of a cell is the start of the next.
        let mut starts = vec![0_u32; columns * rows + 1];
        grid.each(reference, |cell, _| starts[cell] += 1);
        let mut count = 0;
        for start in &mut starts {
            count += std::mem::replace(start, count);
        }
        let mut chords = vec![(0, 0); count as usize];
        grid.each(reference, |cell, chord| {
            chords[starts[cell] as usize] = chord;
            starts[cell] += 1;
        });
        starts.rotate_right(1);
        starts[0] = 0;
        (grid.starts, grid.chords) = (starts, chords);
        grid
    }

    /// Calls `see` for each cell that a chord passes, of each chord: column by column, the rows between which it lies there.
    fn each(&self, reference: &Reference, mut see: impl FnMut(usize, (u32, u32))) {
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
                    (low..=high).for_each(|row| see(row * self.columns + column, (l as u32, c as u32)));
                }
            }
        }
    }

    fn column(&self, x: f64) -> usize {
        (((x - self.origin.x) / self.cell).max(0.0) as usize).min(self.columns - 1)
    }

    fn row(&self, y: f64) -> usize {
        (((y - self.origin.y) / self.cell).max(0.0) as usize).min(self.rows - 1)
    }

    /// The chords that come nearer to a point than `reach` mm, and others; one that passes several cells comes several
    /// times.
    pub(super) fn near(&self, point: Point, reach: f64) -> impl Iterator<Item = (u32, u32)> + '_ {
        let reach = reach + EDGE;
        let rows = self.row(point.y - reach)..=self.row(point.y + reach);
        let columns = self.column(point.x - reach)..=self.column(point.x + reach);
        rows.flat_map(move |r| columns.clone().map(move |c| r * self.columns + c))
            .flat_map(|cell| &self.chords[self.starts[cell] as usize..self.starts[cell + 1] as usize])
            .copied()
    }
}
