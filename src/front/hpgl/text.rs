//! Letters drawn as lines: a small closed line with an open one of its size beside it is an O or a B, no hole.

use std::collections::BTreeMap;

use super::shape::{Class, Shape, Wanted};

/// Largest letter, mm: a larger closed line is a part, whatever stands beside it.
const LARGEST: f64 = 15.0;
/// How many times larger than another a letter of the same text may be.
const RATIO: f64 = 4.0;
/// Two shapes whose middles are nearer than this share of their size stand for one symbol, such as a circle with a cross.
const CONCENTRIC: f64 = 0.1;
/// Pairs of shapes that are compared at the most: a guard against drawings that are made to be slow.
const MOST_WORK: usize = 50_000_000;

/// How the search for letters went.
#[derive(Debug)]
pub(super) struct Letters {
    /// Whether it ended before its time.
    pub(super) is_cut_short: bool,
}

/// Marks the letters among the shapes that are not taken for anything yet.
pub(super) fn mark_letters(shapes: &mut [Shape]) -> Letters {
    let is_small =
        |shape: &Shape| shape.size() <= LARGEST && shape.wanted == Wanted::Guess && shape.class == Class::Other;
    // Closed ones by the cell of their middle, and open ones to begin with.
    let mut cells: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
    let mut pending: Vec<usize> = Vec::new();
    for (i, shape) in shapes.iter().enumerate().filter(|(_, shape)| is_small(shape)) {
        if shape.is_closed {
            cells.entry(cell(shape)).or_default().push(i);
        } else {
            pending.push(i);
        }
    }
    let mut work = 0;
    let mut next = 0;
    while next < pending.len() && work < MOST_WORK && !cells.is_empty() {
        let letter = pending[next];
        next += 1;
        let (column, row) = cell(&shapes[letter]);
        for near in (column - 2..=column + 2).flat_map(|c| (row - 2..=row + 2).map(move |r| (c, r))) {
            let Some(closed) = cells.get_mut(&near) else { continue };
            work += closed.len();
            let found = closed.extract_if(.., |&mut i| are_beside(&shapes[letter], &shapes[i]));
            pending.extend(found);
        }
    }
    let mut letters = 0;
    for &i in &pending {
        // An open line by itself is a letter only beside another shape of its size.
        if shapes[i].is_closed {
            shapes[i].class = Class::Text;
            letters += 1;
        }
    }
    let mut is_cut_short = next < pending.len() && !cells.is_empty();
    if letters > 0 {
        is_cut_short |= open_letters(shapes, &pending).is_cut_short;
    }
    Letters { is_cut_short }
}

/// Marks the open lines beside closed letters.
fn open_letters(shapes: &mut [Shape], pending: &[usize]) -> Letters {
    let mut cells: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
    for &i in pending.iter().filter(|&&i| !shapes[i].is_closed) {
        cells.entry(cell(&shapes[i])).or_default().push(i);
    }
    let mut work = 0;
    for &letter in pending {
        if !shapes[letter].is_closed {
            continue;
        }
        let (column, row) = cell(&shapes[letter]);
        for near in (column - 2..=column + 2).flat_map(|c| (row - 2..=row + 2).map(move |r| (c, r))) {
            let Some(open) = cells.get_mut(&near) else { continue };
            work += open.len();
            if work > MOST_WORK {
                return Letters { is_cut_short: true };
            }
            let found: Vec<usize> = open.extract_if(.., |&mut i| are_beside(&shapes[letter], &shapes[i])).collect();
            for i in found {
                shapes[i].class = Class::Text;
            }
        }
    }
    Letters { is_cut_short: false }
}

fn middle(shape: &Shape) -> [f64; 2] {
    let extent = shape.extent();
    [f64::midpoint(extent.min.x, extent.max.x), f64::midpoint(extent.min.y, extent.max.y)]
}

fn cell(shape: &Shape) -> (i64, i64) {
    let [x, y] = middle(shape);
    ((x / LARGEST).floor() as i64, (y / LARGEST).floor() as i64)
}

/// Whether two shapes stand as letters of a text do.
fn are_beside(a: &Shape, b: &Shape) -> bool {
    let (greater, less) = (a.size().max(b.size()), a.size().min(b.size()));
    let ([ax, ay], [bx, by]) = (middle(a), middle(b));
    if greater > RATIO * less || (ax - bx).abs().max((ay - by).abs()) < CONCENTRIC * greater {
        return false;
    }
    let (a, b) = (a.extent(), b.extent());
    a.min.x - greater <= b.max.x
        && b.min.x - greater <= a.max.x
        && a.min.y - greater <= b.max.y
        && b.min.y - greater <= a.max.y
}
