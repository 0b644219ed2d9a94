//! Parts inside outlines that do not close: pockets, boxes of labels, cut-outs. The outline is drawn in dashes, in sides that do
//! not meet or with a wide gap, so that the line in it is the outermost closed one. Unlike a seam line it does not run beside
//! the outline, so it is found by the view from its middle: open lines all around.

use std::f64::consts::{PI, TAU};

use super::line::is_straight;
use super::nest::middle;
use super::remains::{Drawn, LETTER, Remains};
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, Vector, angle, cross, polyline, ring};

/// Greatest distance of a place of a line from the foot of the square from the middle to the line, in lengths of that square
/// (65 degrees): what runs away from the middle does not enclose it. Marks for splicing run past a part on both sides like that.
const ASIDE: f64 = 2.14;
/// Widest gap in the lines around a part, rad (50 degrees), and in a single one (130 degrees): three sides of four in one stroke
/// are an outline, three strokes may be marks.
const WIDEST: f64 = 0.87;
const WIDEST_OF_ONE: f64 = 2.27;
/// Least share of the view that the lines take up: dashes as long as the gaps between them.
const LEAST_SEEN: f64 = 0.45;
/// Least share of the box around the lines that several parts in it fill if the lines are the edge of the cloth.
const CLOTH: f64 = 0.4;
/// Distance between the ends of a line that goes around something, as a share of its length: that of an angle is 0.7.
const ROUND: f64 = 0.5;
/// Number of directions in which other parts hide what is behind them.
const DIRECTIONS: usize = 72;

/// Part of the view that an edge of an open line takes up.
#[derive(Debug, Clone, Copy)]
struct Arc {
    /// Angle at which it begins, rad, and its width.
    from: f64,
    width: f64,
    /// Least distance of the edge, mm.
    distance: f64,
    line: usize,
}

/// Finds the parts that open lines enclose, other than the known ones that they run beside.
pub(super) fn find(all: Drawn, known: &[Remains], work: &mut Budget) -> Vec<Remains> {
    let parts = all.parts();
    let boxes = Boxes::new(parts.iter().map(|&part| all.lines[part].extent).collect());
    let is_in_part = |extent: &Extent| boxes.at(middle(extent)).any(|k| boxes.all()[k].covers(extent));
    let open = all.of(|line| !line.is_closed && line.is_open_question() && !is_in_part(&line.extent));
    let may_be = |&i: &usize| all.lines[i].size() > LETTER || is_straight(all.lines[i].vertices(all.vertices));
    let open: Vec<usize> = open.into_iter().filter(may_be).collect();
    let cloth = open.iter().fold(Extent::EMPTY, |mut cloth, &i| {
        cloth.join(&all.lines[i].extent);
        cloth
    });
    let is_known = |part: usize| known.iter().any(|remains| remains.inner == part);
    let inside = parts.iter().copied().filter(|&part| cloth.covers(&all.lines[part].extent) && !is_known(part));
    let around =
        |part: usize| Some(Remains { lines: around(all, part, [&open, &parts], work)?, inner: part, is_sure: false });
    inside.filter_map(around).collect()
}

/// Open lines that enclose a part.
fn around(all: Drawn, part: usize, [open, parts]: [&[usize]; 2], work: &mut Budget) -> Option<Vec<usize>> {
    let from = middle(&all.lines[part].extent);
    let may_be = |line: &&usize| !all.is_named_knife(part, **line) && !is_beside(all, **line, from);
    let mut arcs: Vec<Arc> = open.iter().filter(may_be).flat_map(|&line| arcs(all, line, from)).collect();
    if !work.spend(arcs.len()) || enclosing(&arcs).is_none() {
        return None;
    }
    let hidden = hidden(all, parts.iter().filter(|&&other| other != part), from, work);
    arcs.retain(|arc| arc.distance < hidden[direction(arc.from + arc.width / 2.0)]);
    let lines = enclosing(&arcs)?;
    let mut cloth = Extent::EMPTY;
    for &line in &lines {
        cloth.join(&all.lines[line].extent);
    }
    let held: Vec<usize> = parts.iter().copied().filter(|&part| cloth.covers(&all.lines[part].extent)).collect();
    let (width, height) = cloth.size();
    let is_cloth = held.len() > 1 && held.iter().map(|&i| all.lines[i].area).sum::<f64>() > CLOTH * width * height;
    (!is_cloth).then_some(lines)
}

/// True if a line is the open outline of a neighbour: it goes around something else.
fn is_beside(all: Drawn, line: usize, from: Point) -> bool {
    let vertices = all.lines[line].vertices(all.vertices);
    let gap = (vertices[vertices.len() - 1].at - vertices[0].at).norm();
    gap < ROUND * all.lines[line].length && !ring::contains(&all.points(line), from)
}

/// View of a line from a place.
fn arcs(all: Drawn, line: usize, from: Point) -> impl Iterator<Item = Arc> {
    let edges = all.lines[line].vertices(all.vertices).windows(2);
    edges.filter_map(move |ends| {
        let [a, b] = [ends[0].at - from, ends[1].at - from];
        let along = (b - a).try_normalize(0.0)?;
        let (square, foot) = (cross(a, along).abs(), a.dot(&along));
        let [low, high] = [foot.max(-ASIDE * square), (foot + (b - a).norm()).min(ASIDE * square)];
        let at = |way: f64| a + along * (way - foot);
        (low < high).then(|| {
            let turn = angle::turn(at(low), at(high));
            let first: Vector = if turn > 0.0 { at(low) } else { at(high) };
            let distance =
                polyline::distance_to_segment(Point::origin(), Point::origin() + at(low), Point::origin() + at(high));
            Arc { from: first.y.atan2(first.x), width: turn.abs(), distance, line }
        })
    })
}

/// Lines that enclose the place from which they are seen: several together, or one by itself.
fn enclosing(arcs: &[Arc]) -> Option<Vec<usize>> {
    let mut lines: Vec<usize> = arcs.iter().map(|arc| arc.line).collect();
    lines.sort_unstable();
    lines.dedup();
    if encloses(arcs.to_vec(), WIDEST) {
        return Some(lines);
    }
    let of = |line: usize| arcs.iter().copied().filter(|arc| arc.line == line).collect();
    lines.into_iter().find(|&line| encloses(of(line), WIDEST_OF_ONE)).map(|line| vec![line])
}

/// True if arcs leave no gap wider than `widest` rad, and take up enough of the view.
fn encloses(mut arcs: Vec<Arc>, widest: f64) -> bool {
    arcs.sort_by(|a, b| a.from.total_cmp(&b.from));
    // The last one may end behind the begin of the first.
    let last = arcs.iter().map(|arc| arc.from + arc.width).fold(f64::NEG_INFINITY, f64::max);
    let (mut seen, mut end, mut gap) = (0.0, last - TAU, 0.0_f64);
    for Arc { from, width, .. } in arcs {
        gap = gap.max(from - end);
        seen += (from + width - end.max(from)).max(0.0);
        end = end.max(from + width);
    }
    gap <= widest && seen >= LEAST_SEEN * TAU
}

/// Distance of the nearest of some parts in each direction from a place, mm; infinite where there is none.
fn hidden<'a>(all: Drawn, parts: impl Iterator<Item = &'a usize>, from: Point, work: &mut Budget) -> [f64; DIRECTIONS] {
    let mut hidden = [f64::INFINITY; DIRECTIONS];
    for &part in parts {
        let vertices = all.lines[part].vertices(all.vertices);
        work.spend(vertices.len());
        for ends in vertices.windows(2) {
            let [a, b] = [ends[0].at - from, ends[1].at - from];
            let turn = angle::turn(a, b);
            let begin = if turn > 0.0 { a } else { b };
            let first = direction(begin.y.atan2(begin.x));
            let count = (turn.abs() / TAU * DIRECTIONS as f64).ceil() as usize;
            let nearest = polyline::distance_to_segment(from, ends[0].at, ends[1].at);
            let farthest = a.norm().max(b.norm());
            for k in (first..=first + count).map(|k| k % DIRECTIONS) {
                let (y, x) = ((k as f64 + 0.5) / DIRECTIONS as f64 * TAU - PI).sin_cos();
                // Distance of the edge in that direction; the first and the last direction may pass its ends.
                let ahead = cross(a, b - a) / cross(Vector::new(x, y), b - a);
                let way = if ahead > 0.0 { ahead.clamp(nearest, farthest) } else { nearest };
                hidden[k] = hidden[k].min(way);
            }
        }
    }
    hidden
}

/// Number of a direction, from its angle, rad.
fn direction(angle: f64) -> usize {
    (((angle + PI) / TAU).rem_euclid(1.0) * DIRECTIONS as f64) as usize % DIRECTIONS
}
