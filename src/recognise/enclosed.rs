//! Parts inside outlines that do not close: pockets, boxes of labels, cut-outs. The outline is drawn in dashes, in sides that
//! do not meet or with a wide gap, so that the line in it is the outermost closed one. Unlike a seam line it does not run
//! beside the outline, so it is found by the view from its middle: open lines all around.

use std::f64::consts::{PI, TAU};

use super::line::is_straight;
use super::nest::middle;
use super::remains::{Drawn, LETTER, Remains};
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, Vector, angle, cross, polyline, ring};

/// Tangent of the greatest angle (65 degrees) between the square from the middle to a line and the view of a place on it: what
/// runs away from the middle does not enclose it. Marks for splicing run past a part on both sides like that.
const ASIDE: f64 = 2.14;
/// Widest gap between the lines around a part, rad (50 degrees).
const WIDEST: f64 = 0.87;
/// Widest gap of a single line around a part, rad (130 degrees): three sides of four in one stroke are an outline, while three
/// strokes may be marks.
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
    /// Distance of the line through the edge, mm, and its direction.
    square: f64,
    along: Vector,
    line: usize,
}

/// Finds the parts that open lines enclose, other than the known ones that they run beside. A part that the budget leaves
/// unsearched counts as enclosed by all of them.
pub(super) fn find(all: Drawn, known: &[Remains], work: &mut Budget) -> Vec<Remains> {
    if all.of(|line| !line.is_closed && line.is_open_question()).is_empty() {
        return Vec::new(); // as in most
    }
    let parts = all.parts();
    let open = open_lines(all, &parts, work);
    let cloth = box_around(all, &open);
    let is_known = |part: usize| known.iter().any(|remains| remains.inner == part);
    let inside = parts.iter().copied().filter(|&part| cloth.covers(&all.lines[part].extent) && !is_known(part));
    let views = inside.filter_map(|part| Some((part, view(all, part, &open, work)?)));
    let views: Vec<(usize, Vec<Arc>)> = views.collect();
    // Cut-outs of one outline hide nothing of it from each other.
    let is_enclosed = |part: &usize| views.binary_search_by_key(part, |view| view.0).is_ok();
    let walls: Vec<usize> = parts.iter().copied().filter(|part| !is_enclosed(part)).collect();
    let mut found = Vec::new();
    for (part, view) in views {
        let lines = if work.is_spent() { Some(open.clone()) } else { around(all, part, view, &walls, work) };
        if let Some(lines) = lines.filter(|lines| !is_cloth(all, lines, &parts)) {
            found.push(Remains { lines, inner: part, is_sure: false });
        }
    }
    found
}

/// Open lines that may be of an outline: no letters, and none that lie in a part.
fn open_lines(all: Drawn, parts: &[usize], work: &mut Budget) -> Vec<usize> {
    let boxes = Boxes::new(parts.iter().map(|&part| all.lines[part].extent).collect());
    let mut is_in_part = |line: usize| {
        let (extent, at) = (all.lines[line].extent, all.lines[line].vertices(all.vertices)[0].at);
        boxes.near(extent).filter(|&k| boxes.all()[k].covers(&extent)).any(|k| {
            let outline = all.lines[parts[k]].vertices(all.vertices);
            work.spend(outline.len());
            ring::contains(&all.points(parts[k]), at)
        })
    };
    let may_be = |&i: &usize| all.lines[i].size() > LETTER || is_straight(all.lines[i].vertices(all.vertices));
    let open = all.of(|line| !line.is_closed && line.is_open_question());
    open.into_iter().filter(may_be).filter(|&line| !is_in_part(line)).collect()
}

fn box_around(all: Drawn, lines: &[usize]) -> Extent {
    let mut around = Extent::EMPTY;
    for &line in lines {
        around.join(&all.lines[line].extent);
    }
    around
}

/// View of the open lines from the middle of a part; `None` if they do not enclose it.
fn view(all: Drawn, part: usize, open: &[usize], work: &mut Budget) -> Option<Vec<Arc>> {
    let from = middle(&all.lines[part].extent);
    let may_be = |line: &&usize| !all.is_named_knife(part, **line) && !is_beside(all, **line, from);
    let edges = open.iter().map(|&line| all.lines[line].end - all.lines[line].first).sum::<u32>();
    if !work.spend(edges as usize) {
        return Some(Vec::new());
    }
    let arcs: Vec<Arc> = open.iter().filter(may_be).flat_map(|&line| arcs(all, line, from)).collect();
    enclosing(&arcs).is_some().then_some(arcs)
}

/// Open lines of a view that enclose its part where walls do not hide them.
fn around(all: Drawn, part: usize, view: Vec<Arc>, walls: &[usize], work: &mut Budget) -> Option<Vec<usize>> {
    let hidden = hidden(all, walls, middle(&all.lines[part].extent), work);
    let seen = view.into_iter().flat_map(|arc| {
        let count = (arc.width / TAU * DIRECTIONS as f64).ceil().max(1.0) as u32;
        let width = arc.width / f64::from(count);
        let piece = move |k: u32| Arc { from: arc.from + f64::from(k) * width, width, ..arc };
        (0..count).map(piece).filter(|piece| {
            let at = piece.from + piece.width / 2.0;
            let (y, x) = at.sin_cos();
            piece.square / cross(Vector::new(x, y), piece.along).abs() < hidden[direction(at)]
        })
    });
    enclosing(&seen.collect::<Vec<Arc>>())
}

/// True if lines are the edge of the cloth: several parts fill much of the box around them.
fn is_cloth(all: Drawn, lines: &[usize], parts: &[usize]) -> bool {
    let cloth = box_around(all, lines);
    let (width, height) = cloth.size();
    let held = || parts.iter().filter(|&&part| cloth.covers(&all.lines[part].extent));
    held().count() > 1 && held().map(|&part| all.lines[part].area).sum::<f64>() > CLOTH * width * height
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
            Arc { from: first.y.atan2(first.x), width: turn.abs(), square, along, line }
        })
    })
}

/// Lines that enclose the place from which they are seen: several together, or one by itself. The arcs of a line follow each
/// other.
fn enclosing(arcs: &[Arc]) -> Option<Vec<usize>> {
    if encloses(arcs.to_vec(), WIDEST) {
        let mut lines: Vec<usize> = arcs.iter().map(|arc| arc.line).collect();
        lines.dedup();
        return Some(lines);
    }
    let mut by_line = arcs.chunk_by(|a, b| a.line == b.line);
    by_line.find(|arcs| encloses(arcs.to_vec(), WIDEST_OF_ONE)).map(|arcs| vec![arcs[0].line])
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

/// Distance of the nearest wall in each direction from a place, mm; infinite without one.
fn hidden(all: Drawn, walls: &[usize], from: Point, work: &mut Budget) -> [f64; DIRECTIONS] {
    let mut hidden = [f64::INFINITY; DIRECTIONS];
    for &wall in walls {
        let vertices = all.lines[wall].vertices(all.vertices);
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
