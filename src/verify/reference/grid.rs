//! A grid over the chords of all lines, to find those near a point.

use std::ops::RangeInclusive;

use super::line::Line;
use super::lines::Reference;
use crate::geom::{Extent, Point};

/// Least size of a cell, mm.
const CELL_MIN: f64 = 4.0;
/// Cells for each chord, at the most; and the least and greatest number of all.
const CELLS_A_CHORD: f64 = 0.25;
const CELLS: [f64; 2] = [4096.0, 4_194_304.0];

/// Cells that a chord passes on average, at the most.
const CELLS_A_CHORD_PASSES: f64 = 8.0;
/// By how much rounding may shift an edge of a cell, mm: markers are shorter than a thousand kilometres.
const EDGE: f64 = 1e-6;

/// For each cell the chords that pass it, laid out one cell after the other.
#[derive(Debug)]
pub(in crate::verify) struct Grid {
    origin: Point,
    cell: f64,
    columns: usize,
    rows: usize,
    starts: Vec<u32>,
    runs: Vec<Run>,
}

/// Chords of a line that follow each other in a cell, as most of them do.
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

    /// The chords, as places on the line.
    pub(in crate::verify) fn chords(&self) -> RangeInclusive<usize> {
        self.first as usize..=self.last as usize
    }
}

impl Grid {
    /// The grid of all chords.
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
        // What is long and narrow has as many cells as it is long.
        let length: f64 = reference.lines.iter().map(Line::length).sum();
        // Long chords pass many cells.
        let by_length = length / (CELLS_A_CHORD_PASSES * chords.max(1) as f64);
        let cell = CELL_MIN.max((width * height / count).sqrt()).max(width.max(height) / count).max(by_length);
        let (columns, rows) = ((width / cell) as usize + 1, (height / cell) as usize + 1);
        let mut grid = Self { origin: extent.min, cell, columns, rows, starts: Vec::new(), runs: Vec::new() };
        // Counting sort: first how many, then where; what is then the end of a cell is the start of the next.
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

    /// Calls `see` for each cell that a chord passes, of each chord, and tells whether the one before it passes there, too:
    /// column by column, the rows between which it lies there.
    fn each(&self, reference: &Reference, mut see: impl FnMut(usize, (u32, u32), bool)) {
        // The last chord of each cell. Between the last one of a line and the first one of the next a number is left out.
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

    /// The chords that come nearer to a point than `reach` mm, and others: those of a line that follow each other. One that
    /// passes several cells comes several times.
    pub(in crate::verify) fn near(&self, point: Point, reach: f64) -> impl Iterator<Item = &Run> + '_ {
        self.about(Extent::between(point, point).grown(reach))
    }

    /// The same of a box: those that meet it, and others.
    pub(in crate::verify) fn about(&self, extent: Extent) -> impl Iterator<Item = &Run> + '_ {
        let Extent { min, max } = extent.grown(EDGE);
        let rows = self.row(min.y)..=self.row(max.y);
        let columns = self.column(min.x)..=self.column(max.x);
        rows.flat_map(move |r| columns.clone().map(move |c| r * self.columns + c))
            .flat_map(|cell| &self.runs[self.starts[cell] as usize..self.starts[cell + 1] as usize])
    }
}
