//! Open strokes that continue each other become one: plots lift the pen inside an outline, and some write every line by
//! itself, in any direction.

use std::collections::BTreeMap;

use super::drawing::{Drawing, Stroke, Vertex};
use crate::geom::{Extent, Point};

/// Places of the shortest line that goes around something and comes back: a triangle's.
const LEAST_RING: usize = 4;

/// An end of a stroke.
#[derive(Debug, Clone, Copy)]
struct End {
    stroke: u32,
    /// Whether it is the last place, not the first.
    is_last: bool,
}

/// Joins strokes of one pen where the ends of exactly two meet to the bit. Where three or more meet nobody can tell
/// which belong together, unless all others are `spurs`: short marks whose far end is free.
pub(super) fn join(drawing: &mut Drawing, is_spur: impl Fn(&Drawing, &Stroke) -> bool) {
    let meetings = meetings(drawing, is_spur);
    if meetings.is_empty() {
        return;
    }
    // Both ends of each stroke: the end that it meets.
    let mut links: Vec<[Option<End>; 2]> = vec![[None; 2]; drawing.strokes.len()];
    for [a, b] in meetings {
        links[a.stroke as usize][usize::from(a.is_last)] = Some(b);
        links[b.stroke as usize][usize::from(b.is_last)] = Some(a);
    }
    let strokes = std::mem::take(&mut drawing.strokes);
    let mut taken = vec![false; strokes.len()];
    for (i, stroke) in strokes.iter().enumerate() {
        if taken[i] {
            continue;
        }
        taken[i] = true;
        if links[i] == [None; 2] {
            drawing.strokes.push(*stroke);
            continue;
        }
        let (start, is_turned) = start(i, &links);
        let joined = begin(drawing, stroke.pen);
        let mut at = End { stroke: start as u32, is_last: is_turned };
        loop {
            let k = at.stroke as usize;
            taken[k] = true;
            append(drawing, joined, &strokes[k], at.is_last);
            let Some(next) = links[k][usize::from(!at.is_last)] else { break };
            if next.stroke as usize == start {
                break;
            }
            at = next;
        }
    }
}

/// Moves ends of strokes together that miss each other by no more than `reach` in each coordinate, mm, where exactly two
/// are so near: one place that was rounded twice. The two ends of one stroke count when it may go around something.
pub(super) fn snap(drawing: &mut Drawing, reach: f64) {
    for [kept, moved] in near_pairs(&drawing.vertices, &drawing.strokes, reach) {
        let stroke = drawing.strokes[moved.stroke as usize];
        if kept.stroke == moved.stroke && stroke.range().len() < LEAST_RING {
            continue;
        }
        let to = drawing.vertices[kept.vertex(&drawing.strokes)].at;
        let at = moved.vertex(&drawing.strokes);
        let neighbour = drawing.vertices[if moved.is_last { at - 1 } else { at + 1 }].at;
        if neighbour == to {
            continue;
        }
        let from = std::mem::replace(&mut drawing.vertices[at].at, to);
        drawing.moved.length += (neighbour - from).norm() - (neighbour - to).norm();
        drawing.moved.bounds.add(from);
        drawing.strokes[moved.stroke as usize].extent.add(to);
    }
}

/// Rings of several strokes whose ends nearly meet, as their indices: outlines that do not close.
pub(super) fn near_rings(vertices: &[Vertex], strokes: &[Stroke], reach: f64) -> Vec<Vec<u32>> {
    let mut links: BTreeMap<u32, [Option<End>; 2]> = BTreeMap::new();
    for [a, b] in near_pairs(vertices, strokes, reach).into_iter().filter(|[a, b]| a.stroke != b.stroke) {
        links.entry(a.stroke).or_default()[usize::from(a.is_last)] = Some(b);
        links.entry(b.stroke).or_default()[usize::from(b.is_last)] = Some(a);
    }
    let mut rings = Vec::new();
    while let Some((&first, _)) = links.first_key_value() {
        let mut ring = Vec::new();
        let mut at = End { stroke: first, is_last: false };
        while let Some(ends) = links.remove(&at.stroke) {
            ring.push(at.stroke);
            let Some(next) = ends[usize::from(!at.is_last)] else { break };
            if next.stroke == first && !next.is_last {
                rings.push(std::mem::take(&mut ring));
                break;
            }
            at = next;
        }
    }
    rings
}

/// Pairs of ends that are near each other and no third one.
fn near_pairs(vertices: &[Vertex], strokes: &[Stroke], reach: f64) -> Vec<[End; 2]> {
    let mut ends: Vec<(Cell, End)> = Vec::new();
    for (i, stroke) in strokes.iter().enumerate() {
        let [first, last] = [stroke.first, stroke.end - 1].map(|k| vertices[k as usize].at);
        if first == last {
            continue;
        }
        for (at, is_last) in [(first, false), (last, true)] {
            let cell = [at.x, at.y].map(|mm| (mm / reach).floor() as i64);
            ends.push(((stroke.pen, cell), End { stroke: i as u32, is_last }));
        }
    }
    ends.sort_unstable_by_key(|(cell, end)| (*cell, end.stroke, end.is_last));
    let place = |end: &End| vertices[end.vertex(strokes)].at;
    // The only end near one, as an index; nothing when there are more.
    let only = |k: usize| -> Option<usize> {
        let ((pen, [x, y]), end) = ends[k];
        let column = |x: i64, from: i64, to: i64| {
            let start = ends.partition_point(|(cell, _)| *cell < (pen, [x, from]));
            start..start + ends[start..].partition_point(|(cell, _)| *cell <= (pen, [x, to]))
        };
        // Its own cell first: where many meet, the search ends there.
        let own = column(x, y, y);
        if own.len() > 2 {
            return None;
        }
        let columns = [column(x - 1, y - 1, y + 1), column(x, y - 1, y + 1), column(x + 1, y - 1, y + 1)];
        let at = place(&end);
        let is_near = |other: &usize| *other != k && (place(&ends[*other].1) - at).amax() <= reach;
        let mut near = columns.into_iter().flatten().filter(is_near);
        near.next().filter(|_| near.next().is_none())
    };
    let pair =
        |k: usize| only(k).filter(|&other| k < other && only(other) == Some(k)).map(|other| [ends[k].1, ends[other].1]);
    (0..ends.len()).filter_map(pair).collect()
}

/// The pen, and the cell of a grid.
type Cell = (u16, [i64; 2]);

impl End {
    /// The index of its place.
    fn vertex(self, strokes: &[Stroke]) -> usize {
        let stroke = &strokes[self.stroke as usize];
        (if self.is_last { stroke.end - 1 } else { stroke.first }) as usize
    }
}

impl PartialEq for End {
    fn eq(&self, other: &Self) -> bool {
        (self.stroke, self.is_last) == (other.stroke, other.is_last)
    }
}

/// Where a chain that holds stroke `i` starts: the stroke, and whether it is walked from its last place. A chain that
/// closes starts with `i` itself.
fn start(i: usize, links: &[[Option<End>; 2]]) -> (usize, bool) {
    let mut at = End { stroke: i as u32, is_last: false };
    while let Some(before) = links[at.stroke as usize][usize::from(at.is_last)] {
        if before.stroke as usize == i {
            return (i, false);
        }
        at = End { stroke: before.stroke, is_last: !before.is_last };
    }
    (at.stroke as usize, at.is_last)
}

/// The pairs of ends that meet, each pair once.
fn meetings(drawing: &Drawing, is_spur: impl Fn(&Drawing, &Stroke) -> bool) -> Vec<[End; 2]> {
    type Key = (u16, u64, u64);
    let mut ends: Vec<(Key, End)> = Vec::new();
    for (i, stroke) in drawing.strokes.iter().enumerate() {
        let [first, last] = ends_of(drawing, stroke);
        if first == last {
            continue;
        }
        for (at, is_last) in [(first, false), (last, true)] {
            // Zero has one sign among coordinates, so equal places have equal bits.
            let key = (stroke.pen, (at.x + 0.0).to_bits(), (at.y + 0.0).to_bits());
            ends.push((key, End { stroke: i as u32, is_last }));
        }
    }
    ends.sort_unstable_by_key(|(key, end)| (*key, end.stroke, end.is_last));
    let is_alone: Vec<bool> = {
        let mut alone = vec![false; drawing.strokes.len()];
        for group in ends.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() == 1) {
            alone[group[0].1.stroke as usize] = true;
        }
        alone
    };
    let mut meetings = Vec::new();
    for group in ends.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1) {
        let through = |end: &End| {
            let stroke = end.stroke as usize;
            group.len() == 2 || !(is_alone[stroke] && is_spur(drawing, &drawing.strokes[stroke]))
        };
        let mut kept = group.iter().map(|(_, end)| *end).filter(through);
        if let (Some(a), Some(b), None) = (kept.next(), kept.next(), kept.next())
            && a.stroke != b.stroke
        {
            meetings.push([a, b]);
        }
    }
    meetings
}

fn ends_of(drawing: &Drawing, stroke: &Stroke) -> [Point; 2] {
    [drawing.vertices[stroke.first as usize].at, drawing.vertices[stroke.end as usize - 1].at]
}

/// A new stroke without places; its index.
fn begin(drawing: &mut Drawing, pen: u16) -> usize {
    let first = drawing.vertices.len() as u32;
    drawing.strokes.push(Stroke { first, end: first, pen, points: 0, extent: Extent::EMPTY });
    drawing.strokes.len() - 1
}

/// Adds the places of a stroke to another one that is the last of all; turned round, each line keeps what drew it.
fn append(drawing: &mut Drawing, to: usize, stroke: &Stroke, is_turned: bool) {
    let vertices = &mut drawing.vertices;
    let joined = &mut drawing.strokes[to];
    let count = stroke.range().len();
    for k in 0..count {
        // Where two strokes meet the place is there already.
        if k == 0 && joined.end > joined.first {
            continue;
        }
        let vertex = if is_turned {
            let at = stroke.end as usize - 1 - k;
            let span = vertices[(at + 1).min(stroke.end as usize - 1)].span;
            Vertex { at: vertices[at].at, span }
        } else {
            vertices[stroke.first as usize + k]
        };
        vertices.push(vertex);
        joined.end += 1;
    }
    joined.points += stroke.points;
    joined.extent.add(stroke.extent.min);
    joined.extent.add(stroke.extent.max);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Span;

    fn drawing(strokes: &[&[(f64, f64)]]) -> Drawing {
        let mut drawing = Drawing::default();
        for (i, points) in strokes.iter().enumerate() {
            let span = |k: usize| Span { start: k as u32, end: k as u32, block: i as u32 + 1 };
            drawing.begin(Point::new(points[0].0, points[0].1), span(0), 1);
            for (k, &(x, y)) in points.iter().enumerate().skip(1) {
                drawing.line(Point::new(x, y), span(k));
            }
            drawing.lift();
        }
        drawing
    }

    /// The strokes after joining, as their x coordinates.
    fn check(strokes: &[&[(f64, f64)]], expected: &[&[f64]]) -> Drawing {
        let mut drawing = drawing(strokes);
        let points: u32 = drawing.strokes.iter().map(|stroke| stroke.points).sum();
        join(&mut drawing, |_, stroke| stroke.points == 1);
        let found: Vec<Vec<f64>> =
            drawing.strokes.iter().map(|s| drawing.vertices[s.range()].iter().map(|v| v.at.x).collect()).collect();
        assert_eq!(found, expected);
        assert_eq!(points, drawing.strokes.iter().map(|stroke| stroke.points).sum::<u32>());
        drawing
    }

    #[test]
    fn strokes_that_meet_are_joined_whichever_way_they_run() {
        let drawing = check(&[&[(0., 0.), (1., 0.)], &[(3., 0.), (2., 0.), (1., 0.)]], &[&[0., 1., 2., 3.]]);
        let spans: Vec<_> = drawing.vertices[drawing.strokes[0].range()].iter().map(|v| v.span.start).collect();
        assert_eq!(spans, [0, 1, 2, 1]);
        check(&[&[(1., 0.), (2., 0.)], &[(0., 0.), (1., 0.)]], &[&[0., 1., 2.]]);
        check(&[&[(0., 0.), (1., 0.)], &[(5., 0.), (6., 0.)]], &[&[0., 1.], &[5., 6.]]);
    }

    #[test]
    fn a_ring_of_strokes_closes() {
        check(&[&[(0., 0.), (1., 0.)], &[(1., 1.), (1., 0.)], &[(1., 1.), (0., 0.)]], &[&[0., 1., 1., 0.]]);
        check(&[&[(0., 0.), (1., 0.)], &[(1., 0.), (1., 1.), (0., 0.)]], &[&[0., 1., 1., 0.]]);
    }

    #[test]
    fn ends_that_miss_each_other_by_rounding_are_moved_together() {
        let strokes: [&[(f64, f64)]; 2] = [&[(0., 0.), (50., 0.), (50., 50.)], &[(50.01, 50.), (0., 50.), (0., 0.01)]];
        let mut moved = drawing(&strokes);
        snap(&mut moved, 0.02);
        join(&mut moved, |_, _| false);
        assert_eq!(moved.strokes.len(), 1);
        let [first, last] = ends_of(&moved, &moved.strokes[0]);
        assert_eq!(first, last);
        assert!((moved.moved.length - 0.0).abs() < 1e-9, "{}", moved.moved.length);
        assert!(moved.moved.bounds.max.x == 50.01 && moved.moved.bounds.min.y == 0.01);
        let mut apart = drawing(&strokes);
        snap(&mut apart, 0.005);
        join(&mut apart, |_, _| false);
        assert_eq!(apart.strokes.len(), 2);
        assert_eq!(near_rings(&apart.vertices, &apart.strokes, 1.0), [[0, 1]]);
        assert!(near_rings(&apart.vertices, &apart.strokes[..1], 1.0).is_empty());
    }

    #[test]
    fn where_three_meet_nothing_is_joined_unless_one_is_a_mark() {
        let long: &[(f64, f64)] = &[(0., 0.), (1., 0.), (2., 0.)];
        let on: &[(f64, f64)] = &[(2., 0.), (3., 0.), (4., 0.)];
        check(&[long, on, &[(2., 0.), (2., 1.), (2., 2.)]], &[&[0., 1., 2.], &[2., 3., 4.], &[2., 2., 2.]]);
        check(&[long, on, &[(2., 0.), (2.5, 1.)]], &[&[0., 1., 2., 3., 4.], &[2., 2.5]]);
    }
}
