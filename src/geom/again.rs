//! The course of a line that goes along itself again and encloses nothing, as one there and back.
//!
//! Each edge of such a line is meant once. The edges make a tree; the course is the paths that draw the tree once.

use std::collections::BTreeMap;

use crate::geom::{Point, bits, polyline};

/// Most places of a line that has a course: those of longer lines are drawings.
const MOST_PLACES: usize = 64;
/// Places of a line every one of which is looked at.
const FEW_PLACES: usize = 8;
/// Farthest that a place of a straight path lies off it, mm: the rounding of sums of decimals.
const ON_LINE: f64 = 1e-6;

/// Decomposition of a line that retraces itself: paths that draw each edge once, and the stretches that repeat edges.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Course {
    /// Paths that draw every edge once.
    pub paths: Vec<Vec<Step>>,
    /// Stretches that draw edges again, in order.
    pub again: Vec<Vec<Step>>,
}

impl Course {
    /// The length, mm, of the one straight path that the line draws; `None` when it draws anything else.
    pub fn straight(&self, places: &[Point]) -> Option<f64> {
        let [path] = &self.paths[..] else { return None };
        let path: Vec<Point> = path.iter().map(|step| places[step.place]).collect();
        polyline::is_straight(&path, ON_LINE).then(|| polyline::length(&path))
    }
}

/// A place of a row of steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// The place of the line, by its number.
    pub place: usize,
    /// The later end, in the line, of the edge that leads here; at the start of a row the place itself.
    pub led: usize,
}

/// An edge that the line draws for the first time, by the numbers of its places.
#[derive(Debug, Clone, Copy)]
struct Edge {
    ends: [usize; 2],
    /// The later of them in the line.
    led: usize,
}

/// Course of a line that goes along itself again and encloses nothing; `None` for every other line. Two edges are one
/// when their ends are equal to the bit.
pub fn course(places: &[Point]) -> Option<Course> {
    if !turns_back(places.len(), |k| places[k]) {
        return None;
    }
    let mut known = BTreeMap::new();
    let nodes: Vec<usize> =
        places.iter().enumerate().map(|(k, &place)| *known.entry(bits(place)).or_insert(k)).collect();
    let mut edges: Vec<Edge> = Vec::new();
    let mut again: Vec<Vec<Step>> = Vec::new();
    let mut goes_on = false;
    for (k, ends) in nodes.windows(2).enumerate().filter(|(_, ends)| ends[0] != ends[1]) {
        let is_known = edges.iter().any(|edge| edge.ends == *ends || edge.ends == [ends[1], ends[0]]);
        let [from, to] = [k, k + 1].map(|place| Step { place, led: place });
        match again.last_mut().filter(|_| is_known && goes_on) {
            Some(stretch) => stretch.push(to),
            None if is_known => again.push(vec![from, to]),
            None => edges.push(Edge { ends: [ends[0], ends[1]], led: k + 1 }),
        }
        goes_on = is_known;
    }
    // Edges that hang together and are one fewer than their places make no ring.
    (!again.is_empty() && edges.len() + 1 == known.len()).then(|| Course { paths: paths(places, &edges), again })
}

/// Whether a line of `count` places turns back where one that has a course does: at either end, or half way, or anywhere when
/// it has few places. Nearly every line does not, and costs a few comparisons.
pub fn turns_back(count: usize, at: impl Fn(usize) -> Point) -> bool {
    (3..=MOST_PLACES).contains(&count)
        && (at(0) == at(2)
            || at(1) == at(count - 2)
            || at(count - 3) == at(count - 1)
            || count <= FEW_PLACES && (1..count - 1).any(|k| at(k - 1) == at(k + 1)))
}

/// The paths of a tree of edges. At each place the two edges that go on straightest are of one path.
fn paths(places: &[Point], edges: &[Edge]) -> Vec<Vec<Step>> {
    let mut next: Vec<[Option<usize>; 2]> = vec![[None; 2]; edges.len()];
    for (node, at) in places.iter().enumerate() {
        let mut ends: Vec<(usize, usize)> = Vec::new();
        for (k, edge) in edges.iter().enumerate() {
            ends.extend(edge.ends.iter().position(|&end| end == node).map(|side| (k, side)));
        }
        while let Some([one, other]) = straightest(places, edges, (*at, &ends)) {
            let [a, b] = [ends[one], ends[other]];
            next[a.0][a.1] = Some(b.0);
            next[b.0][b.1] = Some(a.0);
            ends.retain(|end| *end != a && *end != b);
        }
    }
    let mut is_taken = vec![false; edges.len()];
    let mut paths = Vec::new();
    for first in 0..edges.len() {
        if is_taken[first] {
            continue;
        }
        // Back to where the path begins, then along it.
        let (mut k, mut side) = (first, 0);
        while let Some(before) = next[k][side] {
            side = usize::from(edges[before].ends[0] == edges[k].ends[side]);
            k = before;
        }
        let place = edges[k].ends[side];
        let mut path = vec![Step { place, led: place }];
        loop {
            is_taken[k] = true;
            let place = edges[k].ends[1 - side];
            path.push(Step { place, led: edges[k].led });
            let Some(behind) = next[k][1 - side] else { break };
            side = usize::from(edges[behind].ends[1] == place);
            k = behind;
        }
        paths.push(path);
    }
    paths
}

/// The two of some edges that go on straightest through the place where they meet.
fn straightest(places: &[Point], edges: &[Edge], (at, ends): (Point, &[(usize, usize)])) -> Option<[usize; 2]> {
    let away = |(edge, side): (usize, usize)| (places[edges[edge].ends[1 - side]] - at).normalize();
    let pairs = (0..ends.len()).flat_map(|one| (one + 1..ends.len()).map(move |other| [one, other]));
    pairs.min_by(|a, b| {
        let bend = |&[one, other]: &[usize; 2]| away(ends[one]).dot(&away(ends[other]));
        bend(a).total_cmp(&bend(b))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of places, each place with the one that its edge leads to where that is another.
    type Rows<'a> = &'a [&'a [(usize, usize)]];

    fn check(places: &[[f64; 2]], expected: Option<(Rows, Rows)>) {
        let found = course(&places.iter().map(|&place| place.into()).collect::<Vec<Point>>());
        let row = |row: &&[(usize, usize)]| row.iter().map(|&(place, led)| Step { place, led }).collect();
        let rows = |rows: Rows| rows.iter().map(row).collect::<Vec<_>>();
        let expected = expected.map(|(paths, again)| Course { paths: rows(paths), again: rows(again) });
        assert_eq!(found, expected, "{places:?}");
    }

    const L: [f64; 2] = [0.0, 0.0];
    const R: [f64; 2] = [4.0, 0.0];
    const TIP: [f64; 2] = [2.0, 6.0];

    #[test]
    fn a_line_there_and_back_is_one_path() {
        check(&[L, TIP, L], Some((&[&[(0, 0), (1, 1)]], &[&[(1, 1), (2, 2)]])));
        let v: Rows = &[&[(0, 0), (1, 1), (2, 2)]];
        check(&[L, TIP, R, TIP, L], Some((v, &[&[(2, 2), (3, 3), (4, 4)]])));
        check(&[L, TIP, R, TIP, R], Some((v, &[&[(2, 2), (3, 3), (4, 4)]])));
        // From its tip the first leg is gone back.
        let again: Rows = &[&[(1, 1), (2, 2)], &[(3, 3), (4, 4)]];
        check(&[TIP, L, TIP, R, TIP], Some((&[&[(3, 3), (0, 3), (1, 1)]], again)));
        check(&[L, TIP, TIP, L], Some((&[&[(0, 0), (1, 1)]], &[&[(2, 2), (3, 3)]])));
    }

    #[test]
    fn a_t_in_one_stroke_is_a_stem_and_a_bar() {
        let [stem, left, right] = [[2.0, 0.0], [0.0, 6.0], [4.0, 6.0]];
        let paths: Rows = &[&[(0, 0), (1, 1)], &[(4, 4), (1, 4), (2, 2)]];
        let again: Rows = &[&[(2, 2), (3, 3)], &[(4, 4), (5, 5), (6, 6)]];
        check(&[stem, TIP, left, TIP, right, TIP, stem], Some((paths, again)));
    }

    #[test]
    fn every_other_line_has_no_course() {
        check(&[L, TIP, R], None);
        check(&[L, TIP, R, L], None);
        check(&[L, TIP, R, L, TIP, R, L], None);
        check(&[L, TIP, R, L, [-5.0, 0.0], L], None);
    }
}
