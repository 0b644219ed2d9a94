//! Letters drawn as lines: small closed lines that stand in a row with open ones of their height are an O or an 8, no
//! holes.

use std::collections::BTreeMap;

use super::shape::{Class, Shape, Wanted};
use crate::geom::Extent;

/// Largest letter, mm: a larger closed line is a part, whatever stands beside it.
const LARGEST: f64 = 15.0;
/// How many times higher than another a letter of the same text may be: a capital beside a small letter.
const RATIO: f64 = 2.0;
/// Share of its height that a letter stands beside another, at least, and of its width that it stands over it, at the most.
const BESIDE: f64 = 0.5;
/// Shapes that make a row of letters; fewer do when they stand on one line and are of one height but for this share, as
/// the digits of a size do.
const ROW: usize = 3;
const ALIKE: f64 = 0.05;
/// Pairs of shapes that are compared at the most: a guard against drawings that are made to be slow.
const MOST_WORK: usize = 50_000_000;

/// How the search for letters went.
#[derive(Debug, Default)]
pub(super) struct Letters {
    /// The closed lines among them, as indices of shapes in their order.
    pub(super) closed: Vec<usize>,
    /// Whether it ended before its time.
    pub(super) is_cut_short: bool,
}

/// Small shapes by the cell of their middle.
struct Search<'a> {
    shapes: &'a [Shape],
    cells: BTreeMap<[i64; 2], Vec<usize>>,
    work: usize,
}

/// Marks the letters among the shapes that are not taken for anything yet.
pub(super) fn mark_letters(shapes: &mut [Shape]) -> Letters {
    let is_small =
        |shape: &Shape| shape.size() <= LARGEST && shape.wanted == Wanted::Guess && shape.class == Class::Other;
    let small: Vec<usize> = (0..shapes.len()).filter(|&i| is_small(&shapes[i])).collect();
    let mut letters = Letters::default();
    if small.iter().all(|&i| shapes[i].is_closed) || !small.iter().any(|&i| shapes[i].is_closed) {
        return letters;
    }
    let mut search = Search { shapes, cells: BTreeMap::new(), work: MOST_WORK };
    for &i in &small {
        search.cells.entry(cell(&shapes[i])).or_default().push(i);
    }
    // A closed line around an open one is a part with its grain line or marks.
    let may_be: Vec<usize> = small.iter().copied().filter(|&i| shapes[i].is_closed && !search.holds_open(i)).collect();
    // Those are no letters of a row that others make, either.
    let holders: Vec<usize> =
        small.iter().copied().filter(|i| shapes[*i].is_closed && may_be.binary_search(i).is_err()).collect();
    for i in holders {
        search.take(i);
    }
    let mut rows = Vec::new();
    for &first in &may_be {
        rows.extend(search.row(first));
    }
    letters.is_cut_short = search.work == 0;
    for i in rows {
        shapes[i].class = Class::Text;
        if shapes[i].is_closed {
            letters.closed.push(i);
        }
    }
    letters.closed.sort_unstable();
    letters
}

impl Search<'_> {
    /// The shapes around one that `is` holds for.
    fn around(&mut self, i: usize, is: impl Fn(&Shape, &Shape) -> bool) -> Vec<usize> {
        let [column, row] = cell(&self.shapes[i]);
        let mut found = Vec::new();
        for near in (column - 2..=column + 2).flat_map(|c| (row - 2..=row + 2).map(move |r| [c, r])) {
            let Some(there) = self.cells.get(&near) else { continue };
            let Some(left) = self.work.checked_sub(there.len()) else {
                self.work = 0;
                return found;
            };
            self.work = left;
            found.extend(there.iter().copied().filter(|&k| k != i && is(&self.shapes[i], &self.shapes[k])));
        }
        found
    }

    /// Takes a shape out, so that it is found no more; whether it was still there. The guard ends that, too.
    fn take(&mut self, i: usize) -> bool {
        let Some(there) = self.cells.get_mut(&cell(&self.shapes[i])) else { return false };
        let Some(left) = self.work.checked_sub(there.len()) else {
            self.work = 0;
            return false;
        };
        self.work = left;
        let before = there.len();
        there.retain(|&k| k != i);
        there.len() < before
    }

    fn holds_open(&mut self, i: usize) -> bool {
        let is_inside = |outer: &Shape, inner: &Shape| {
            let (outer, inner) = (outer.extent(), inner.extent());
            outer.holds(inner.min) && outer.holds(inner.max)
        };
        !self.around(i, |outer, inner| !inner.is_closed && is_inside(outer, inner)).is_empty()
    }

    /// The text that a closed line stands in; empty when it is none.
    fn row(&mut self, first: usize) -> Vec<usize> {
        if !self.take(first) {
            return Vec::new();
        }
        let mut row = vec![first];
        let mut next = 0;
        while let Some(&letter) = row.get(next) {
            next += 1;
            for found in self.around(letter, |a, b| are_beside(a, b).is_some()) {
                self.take(found);
                row.push(found);
            }
        }
        let has_open = row.iter().any(|&i| !self.shapes[i].is_closed);
        let are_alike = || match row[..] {
            [a, b] => are_beside(&self.shapes[a], &self.shapes[b]) == Some(Row::OneLine),
            _ => false,
        };
        if has_open && (row.len() >= ROW || are_alike()) { row } else { Vec::new() }
    }
}

/// How two letters stand beside each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Row {
    /// In a row.
    Rough,
    /// On one line, and of one height.
    OneLine,
}

fn cell(shape: &Shape) -> [i64; 2] {
    let Extent { min, max } = *shape.extent();
    [f64::midpoint(min.x, max.x), f64::midpoint(min.y, max.y)].map(|mm| (mm / LARGEST).floor() as i64)
}

/// Whether two shapes stand as letters of a text do that runs along X or along Y.
fn are_beside(a: &Shape, b: &Shape) -> Option<Row> {
    let spans = |shape: &Shape| {
        let Extent { min, max } = *shape.extent();
        [[min.x, max.x], [min.y, max.y]]
    };
    let ([ax, ay], [bx, by]) = (spans(a), spans(b));
    along([ax, ay], [bx, by]).max(along([ay, ax], [by, bx]))
}

/// The same for a text in one direction: the spans of each shape along it and across it.
fn along([a, a_across]: [[f64; 2]; 2], [b, b_across]: [[f64; 2]; 2]) -> Option<Row> {
    let size = |span: [f64; 2]| span[1] - span[0];
    let common = |a: [f64; 2], b: [f64; 2]| a[1].min(b[1]) - a[0].max(b[0]);
    let (less, greater) = (size(a_across).min(size(b_across)), size(a_across).max(size(b_across)));
    let is_row = less > 0.0
        && greater <= RATIO * less
        && common(a_across, b_across) >= BESIDE * less
        && common(a, b) >= -greater
        && common(a, b) <= BESIDE * size(a).min(size(b));
    let is_one_line = common(a_across, b_across) >= (1.0 - ALIKE) * greater;
    is_row.then_some(if is_one_line { Row::OneLine } else { Row::Rough })
}
