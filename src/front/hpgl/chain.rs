//! Open strokes that continue each other become one: plots lift the pen inside an outline, and some write every line by
//! itself, in any direction.

use std::collections::{BTreeMap, BTreeSet};

use super::drawing::{Drawing, Stroke, Vertex};
use super::joint::{self, End, Links};
use crate::geom::Point;
use crate::geom::moments::Moments;

/// Places of the shortest line that goes around something and comes back: a triangle's.
const LEAST_RING: usize = 4;

/// Joins strokes of one pen where their ends meet to the bit, as [`joint`] pairs them, and gives the places where three or
/// more lines meet. Marks with a free end, for which `is_spur` holds, stay by themselves there.
pub(super) fn join(drawing: &mut Drawing, is_spur: impl Fn(&Drawing, &Stroke) -> bool) -> BTreeSet<[u64; 2]> {
    let links = joint::links(drawing, is_spur);
    if links.is_empty() {
        return links.joints;
    }
    let strokes = std::mem::take(&mut drawing.strokes);
    let mut taken = vec![false; strokes.len()];
    for (i, stroke) in strokes.iter().enumerate() {
        if taken[i] {
            continue;
        }
        if [End::first(i), End::last(i)].iter().all(|end| links.at(*end).is_none()) {
            drawing.strokes.push(*stroke);
            continue;
        }
        let start = start(i, &links);
        drawing.open(stroke.pen);
        let mut at = start;
        loop {
            let k = at.stroke as usize;
            taken[k] = true;
            if at.is_last {
                drawing.append_turned(&strokes[k]);
            } else {
                drawing.append(&strokes[k]);
            }
            let Some(next) = links.at(at.other()) else { break };
            if next.stroke == start.stroke {
                break;
            }
            at = next;
        }
    }
    links.joints
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
        drawing.moved.moments += Moments::line(neighbour, from) - Moments::line(neighbour, to);
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
    let only = only_near(&ends, |end| vertices[end.vertex(strokes)].at, reach);
    let pair = |k: usize| only[k].filter(|&other| k < other && only[other] == Some(k)).map(|other| [k, other]);
    (0..ends.len()).filter_map(pair).map(|pair| pair.map(|k| ends[k].1)).collect()
}

/// Of each of some ends, sorted by their cells, the only other one near it, as an index; nothing when there are more.
fn only_near(ends: &[(Cell, End)], place: impl Fn(End) -> Point, reach: f64) -> Vec<Option<usize>> {
    let cell = |k: usize| ends.get(k).map(|(cell, _)| *cell);
    // Where the cells below and beside an end begin, in the three columns around it: they go on as the ends do.
    let mut starts = [0; 3];
    let mut only = Vec::with_capacity(ends.len());
    for (k, &((pen, [x, y]), end)) in ends.iter().enumerate() {
        for (start, column) in starts.iter_mut().zip(x - 1..) {
            while cell(*start).is_some_and(|cell| cell < (pen, [column, y - 1])) {
                *start += 1;
            }
        }
        // Where many meet in one cell, nothing is searched.
        let own = (k.saturating_sub(2)..=k + 2).filter(|&other| cell(other) == cell(k)).count();
        if own > 2 {
            only.push(None);
            continue;
        }
        let at = place(end);
        let columns = starts.iter().zip(x - 1..).flat_map(|(&start, column)| {
            (start..).take_while(move |&other| cell(other).is_some_and(|cell| cell <= (pen, [column, y + 1])))
        });
        let mut near = columns.filter(|&other| other != k && (place(ends[other].1) - at).amax() <= reach);
        only.push(near.next().filter(|_| near.next().is_none()));
    }
    only
}

/// The pen, and the cell of a grid.
type Cell = (u16, [i64; 2]);

/// Where a chain that holds a stroke starts. One that closes starts with that stroke itself.
fn start(stroke: usize, links: &Links) -> End {
    let mut at = End::first(stroke);
    while let Some(before) = links.at(at) {
        at = before.other();
        if at.stroke as usize == stroke {
            return End::first(stroke);
        }
    }
    at
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
        let joined = &moved.vertices[moved.strokes[0].range()];
        assert_eq!(joined[0].at, joined[joined.len() - 1].at);
        assert!((moved.moved.moments.length()).abs() < 1e-9, "{:?}", moved.moved);
        assert!(moved.moved.bounds.max.x == 50.01 && moved.moved.bounds.min.y == 0.01);
        let mut apart = drawing(&strokes);
        snap(&mut apart, 0.005);
        join(&mut apart, |_, _| false);
        assert_eq!(apart.strokes.len(), 2);
        assert_eq!(near_rings(&apart.vertices, &apart.strokes, 1.0), [[0, 1]]);
        assert!(near_rings(&apart.vertices, &apart.strokes[..1], 1.0).is_empty());
    }

    /// The closed strokes after joining, each as its sorted places; every line is still there, whatever the order of the
    /// strokes and the way that they run.
    fn check_rings(strokes: &[&[(f64, f64)]], expected: &[&[(f64, f64)]]) {
        let mut random = fastrand::Rng::with_seed(4);
        for _ in 0..50 {
            let mut mixed: Vec<Vec<(f64, f64)>> = strokes.iter().map(|stroke| stroke.to_vec()).collect();
            random.shuffle(&mut mixed);
            for stroke in &mut mixed {
                if random.bool() {
                    stroke.reverse();
                }
            }
            let mixed: Vec<&[(f64, f64)]> = mixed.iter().map(Vec::as_slice).collect();
            let mut joined = drawing(&mixed);
            let moments = |drawing: &Drawing| {
                let of = |stroke: &Stroke| Moments::of(drawing.vertices[stroke.range()].iter().map(|v| v.at)).length();
                drawing.strokes.iter().map(of).sum::<f64>()
            };
            let before = moments(&joined);
            let joints = join(&mut joined, |_, stroke| stroke.points == 1 && stroke.extent.size().0 < 10.0);
            assert!((moments(&joined) - before).abs() < 1e-9);
            assert!(!joints.is_empty());
            let mut rings = Vec::new();
            for stroke in &joined.strokes {
                let places: Vec<(f64, f64)> =
                    joined.vertices[stroke.range()].iter().map(|v| (v.at.x, v.at.y)).collect();
                if places[0] == places[places.len() - 1] {
                    let mut ring = places[1..].to_vec();
                    ring.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
                    rings.push(ring);
                }
            }
            rings.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
            assert_eq!(rings, expected);
        }
    }

    #[test]
    fn of_many_ends_those_that_are_near_one_other_alone_are_paired() {
        const REACH: f64 = 0.5;
        let mut random = fastrand::Rng::with_seed(6);
        for _ in 0..50 {
            let mut place = || (f64::from(random.u8(0..80)) * 0.3, f64::from(random.u8(0..80)) * 0.3);
            let strokes: Vec<[(f64, f64); 2]> = (0..80).map(|_| [place(), place()]).collect();
            let strokes: Vec<&[(f64, f64)]> = strokes.iter().map(<[_; 2]>::as_slice).collect();
            let drawing = drawing(&strokes);
            let places: Vec<Point> = drawing.vertices.iter().map(|vertex| vertex.at).collect();
            let near = |i: usize| -> Vec<usize> {
                (0..places.len()).filter(|&k| k != i && (places[k] - places[i]).amax() <= REACH).collect()
            };
            let mut expected: Vec<[usize; 2]> = (0..places.len())
                .filter_map(|i| match near(i)[..] {
                    [k] if i < k && near(k).len() == 1 => Some([i, k]),
                    _ => None,
                })
                .collect();
            let pairs = near_pairs(&drawing.vertices, &drawing.strokes, REACH);
            let mut found: Vec<[usize; 2]> =
                pairs.into_iter().map(|pair| pair.map(|end| end.vertex(&drawing.strokes))).collect();
            for pair in &mut found {
                pair.sort_unstable();
            }
            expected.sort_unstable();
            found.sort_unstable();
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn a_mark_where_three_meet_stays_by_itself() {
        let (long, on): (&[_], &[_]) = (&[(0., 0.), (1., 0.), (2., 0.)], &[(2., 0.), (3., 0.), (4., 0.)]);
        check(&[long, on, &[(2., 0.), (2.5, 1.)]], &[&[0., 1., 2., 3., 4.], &[2., 2.5]]);
    }

    #[test]
    fn where_three_meet_a_line_goes_straight_on() {
        let (long, on): (&[_], &[_]) = (&[(0., 0.), (1., 0.), (2., 0.)], &[(2., 0.), (3., 0.), (4., 0.)]);
        let side: &[_] = &[(2., 0.), (2., 1.), (2., 2.)];
        check(&[long, on, side], &[&[0., 1., 2., 3., 4.], &[2., 2., 2.]]);
        check(&[side, long, on], &[&[2., 2., 2.], &[0., 1., 2., 3., 4.]]);
        // None of those turns back.
        let back: &[_] = &[(2., 0.), (1., 0.5), (0., 0.5)];
        check(&[long, back, &[(2., 0.), (1., -0.5), (0., -0.5)]], &[&[0., 1., 2.], &[2., 1., 0.], &[2., 1., 0.]]);
    }

    #[test]
    fn where_three_meet_an_outline_closes_before_a_line_goes_straight_on() {
        // A line that runs on from an edge leads nowhere, though it is the straighter one.
        let outline: [&[_]; 2] = [&[(0., 0.), (50., 0.)], &[(50., 0.), (50., 50.), (0., 50.), (0., 0.)]];
        let ring: &[_] = &[(0., 0.), (0., 50.), (50., 0.), (50., 50.)];
        check_rings(&[outline[0], outline[1], &[(50., 0.), (70., 0.), (90., 30.)]], &[ring]);
        // A line from edge to edge divides the part; the outline goes straight on past it.
        let halves: [&[_]; 2] =
            [&[(25., 0.), (50., 0.), (50., 50.), (25., 50.)], &[(25., 50.), (0., 50.), (0., 0.), (25., 0.)]];
        let whole: &[_] = &[(0., 0.), (0., 50.), (25., 0.), (25., 50.), (50., 0.), (50., 50.)];
        check_rings(&[halves[0], halves[1], &[(25., 0.), (25., 50.)]], &[whole]);
        // Two parts that touch at a corner, each in two strokes.
        let corner: [&[_]; 4] = [
            &[(0., 0.), (50., 0.), (50., 50.)],
            &[(50., 50.), (0., 50.), (0., 0.)],
            &[(50., 50.), (100., 50.), (100., 100.)],
            &[(100., 100.), (50., 100.), (50., 50.)],
        ];
        let other: &[_] = &[(50., 50.), (50., 100.), (100., 50.), (100., 100.)];
        check_rings(&corner, &[ring, other]);
    }

    #[test]
    fn an_outline_passes_the_mouth_of_a_mark_and_does_not_go_round_it() {
        let strokes: [&[_]; 4] = [
            &[(0., 0.), (20., 0.)],
            &[(20., 0.), (24., 0.)],
            &[(24., 0.), (50., 0.), (50., 50.), (0., 50.), (0., 0.)],
            &[(20., 0.), (22., 5.), (24., 0.)],
        ];
        check_rings(&strokes, &[&[(0., 0.), (0., 50.), (20., 0.), (24., 0.), (50., 0.), (50., 50.)]]);
        // The head of an arrow closes by itself, and the shaft does not go into it.
        let arrow: [&[_]; 4] =
            [&[(0., 0.), (80., 0.)], &[(80., 0.), (70., 5.)], &[(70., 5.), (70., -5.)], &[(70., -5.), (80., 0.)]];
        check_rings(&arrow, &[&[(70., -5.), (70., 5.), (80., 0.)]]);
    }

    #[test]
    fn four_parts_that_share_their_edges_have_their_common_outline() {
        let places = |x: f64, y: f64| [(x, y), (x + 50., y), (x + 50., y + 50.), (x, y + 50.), (x, y)];
        let mut edges: Vec<[(f64, f64); 2]> = Vec::new();
        for square in [places(0., 0.), places(50., 0.), places(0., 50.), places(50., 50.)] {
            for pair in square.windows(2) {
                if !edges.iter().any(|edge| *edge == [pair[0], pair[1]] || *edge == [pair[1], pair[0]]) {
                    edges.push([pair[0], pair[1]]);
                }
            }
        }
        let edges: Vec<&[(f64, f64)]> = edges.iter().map(<[_; 2]>::as_slice).collect();
        let ring: &[_] =
            &[(0., 0.), (0., 50.), (0., 100.), (50., 0.), (50., 100.), (100., 0.), (100., 50.), (100., 100.)];
        check_rings(&edges, &[ring]);
    }
}
