//! Letters drawn as lines: rows of small strokes. A text may be so near to an edge that its strokes have the shape of notches:
//! unlike notches they begin off the edge, and form a row or have a bar from stroke to stroke.

use std::collections::{BTreeMap, BTreeSet};

use super::line::{Class, Line, is_straight};
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, polyline};
use crate::ir::drawing::Vertex;

/// Largest letter, mm: a larger line is a part or an inner line, whatever is beside it.
const LARGEST: f64 = 15.0;
/// Greatest ratio of the heights of two letters of a text: a capital beside a small letter.
const RATIO: f64 = 2.0;
/// Least overlap of two adjacent letters across the text, as a share of the height, and greatest overlap along it, as a share
/// of the width.
const BESIDE: f64 = 0.5;
/// Greatest gaps between letters, in multiples of their height: of any text, and of narrow letters in wide columns.
const CLOSE: f64 = 0.5;
const WIDE: f64 = 1.3;
/// Difference of lines with the same shape, as a share of their size.
const ALIKE: f64 = 0.1;
/// Least number of strokes in a row.
const ROW: usize = 3;

/// Marks the letters among the lines that are not classified yet.
pub(super) fn mark(lines: &mut [Line], vertices: &[Vertex], work: &mut Budget) {
    let is_small = |line: &Line| line.is_open_question() && line.size() <= LARGEST;
    let mut cells: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
    let small: Vec<usize> = (0..lines.len()).filter(|&i| is_small(&lines[i])).collect();
    if small.len() < ROW || !small.iter().any(|&i| lines[i].is_closed) {
        return; // only closed letters may be taken for something that is cut
    }
    for &i in &small {
        cells.entry(cell(&lines[i])).or_default().push(i);
    }
    for first in small {
        if work.is_spent() {
            return;
        }
        let row = row(first, lines, (&mut cells, 1.0), work);
        let is_shaped = |&i: &usize| !is_straight(lines[i].vertices(vertices));
        let is_text = row.len() >= ROW && row.iter().any(|&i| !lines[i].is_closed) && row.iter().any(is_shaped);
        row.into_iter().filter(|_| is_text).for_each(|i| lines[i].class = Class::Letter);
    }
}

/// Small lines, by the cells of their middles.
type Cells = BTreeMap<[i64; 2], Vec<usize>>;

/// Row of lines around one of them, with gaps of at most `gap` times their height; removes its lines from the cells.
fn row(first: usize, lines: &[Line], (cells, gap): (&mut Cells, f64), work: &mut Budget) -> Vec<usize> {
    if !take(first, lines, cells) {
        return Vec::new();
    }
    let mut row = vec![first];
    let mut next = 0;
    while let Some(&letter) = row.get(next) {
        next += 1;
        let [column, line] = cell(&lines[letter]);
        for near in (column - 2..=column + 2).flat_map(|c| (line - 2..=line + 2).map(move |r| [c, r])) {
            let Some(there) = cells.get_mut(&near) else { continue };
            if !work.spend(there.len()) {
                return row;
            }
            let beside: Vec<usize> = there.extract_if(.., |k| are_beside(&lines[letter], &lines[*k], gap)).collect();
            row.extend(beside);
        }
    }
    row
}

/// Letters among strokes with the shape of notches that begin off their edge, in order: those in a row of small strokes, and
/// those that a bar joins amid their length.
pub(super) fn among(
    off: &[usize],
    lines: &[Line],
    vertices: &[Vertex],
    touch: f64,
    work: &mut Budget,
) -> BTreeSet<usize> {
    let mut letters = BTreeSet::new();
    let mut cells = Cells::new();
    let is_off = |i: &usize| off.binary_search(i).is_ok();
    let may_be = |i: &usize| lines[*i].size() <= LARGEST && (lines[*i].is_open_question() || is_off(i));
    for i in (0..lines.len()).filter(may_be) {
        cells.entry(cell(&lines[i])).or_default().push(i);
    }
    let bars = (0..lines.len()).filter(|&i| is_bar(&lines[i], vertices));
    let boxes = Boxes::new(off.iter().map(|&i| lines[i].extent.grown(touch)).collect());
    for bar in bars {
        let ends = [0, 1].map(|k| lines[bar].vertices(vertices)[k].at);
        let mut joined = Vec::new();
        for end in ends {
            if !work.spend(boxes.cost_at(end)) {
                return letters;
            }
            let is_joined = |&i: &usize| {
                work.spend(lines[i].vertices(vertices).len()) && is_amid(end, &lines[i].points(vertices), touch)
            };
            joined.extend(boxes.at(end).map(|k| off[k]).find(is_joined));
        }
        if joined.len() == ends.len() {
            letters.extend(joined);
        }
    }
    // Notches in a row are alike, and farther apart than letters; words of many letters contain several shapes.
    for gap in [CLOSE, WIDE] {
        let mut cells = cells.clone();
        for &first in off {
            let row = row(first, lines, (&mut cells, gap), work);
            let has_letter = || row.iter().any(|i| letters.contains(i));
            let is_word = || row.iter().any(|&i| !are_alike([&lines[row[0]], &lines[i]]));
            if row.len() >= ROW && (gap == CLOSE || is_word() || has_letter()) {
                letters.extend(row.into_iter().filter(is_off));
            }
        }
    }
    letters
}

/// True if a line may be the bar of a letter.
fn is_bar(line: &Line, vertices: &[Vertex]) -> bool {
    !line.is_closed && line.is_open_question() && line.size() <= LARGEST && line.vertices(vertices).len() == 2
}

/// True if a place lies on a stroke, but not on one of its vertices.
fn is_amid(at: Point, stroke: &[Point], touch: f64) -> bool {
    polyline::distance(at, stroke) <= touch && stroke.iter().all(|vertex| (vertex - at).norm() > touch)
}

fn take(i: usize, lines: &[Line], cells: &mut BTreeMap<[i64; 2], Vec<usize>>) -> bool {
    let Some(there) = cells.get_mut(&cell(&lines[i])) else { return false };
    let Some(place) = there.iter().position(|&k| k == i) else { return false };
    there.swap_remove(place);
    true
}

fn cell(line: &Line) -> [i64; 2] {
    let Extent { min, max } = line.extent;
    [f64::midpoint(min.x, max.x), f64::midpoint(min.y, max.y)].map(|mm| (mm / LARGEST).floor() as i64)
}

/// True if two lines have the same number of vertices and boxes of the same size, like the notches of one part.
fn are_alike([a, b]: [&Line; 2]) -> bool {
    let [(width, height), (other_width, other_height)] = [a, b].map(|line| line.extent.size());
    a.end - a.first == b.end - b.first
        && (width - other_width).abs().max((height - other_height).abs()) <= ALIKE * width.max(height)
}

/// True if two lines are placed like letters of a text along X or along Y.
fn are_beside(a: &Line, b: &Line, gap: f64) -> bool {
    let spans = |line: &Line| {
        let Extent { min, max } = line.extent;
        [[min.x, max.x], [min.y, max.y]]
    };
    let ([ax, ay], [bx, by]) = (spans(a), spans(b));
    along([ax, ay], [bx, by], gap) || along([ay, ax], [by, bx], gap)
}

/// True if lines are placed like letters of a text in one direction, by their spans along it and across it.
fn along([a, a_across]: [[f64; 2]; 2], [b, b_across]: [[f64; 2]; 2], gap: f64) -> bool {
    let size = |span: [f64; 2]| span[1] - span[0];
    let common = |a: [f64; 2], b: [f64; 2]| a[1].min(b[1]) - a[0].max(b[0]);
    let (less, greater) = (size(a_across).min(size(b_across)), size(a_across).max(size(b_across)));
    less > 0.0
        && greater <= RATIO * less
        && common(a_across, b_across) >= BESIDE * less
        && common(a, b) >= -gap * greater
        && common(a, b) <= BESIDE * size(a).min(size(b))
}
