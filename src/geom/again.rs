//! Decomposition of a line that retraces itself and encloses nothing.
//!
//! Each edge of such a line is meant once. The edges form a tree; the course is a set of paths that draw the tree once.

use std::collections::BTreeMap;

use crate::geom::{Point, bits, polyline};

/// Maximum number of places of a line that is decomposed; longer lines are drawings.
const MOST_PLACES: usize = 64;
/// Number of places up to which every place of a line is tested for a turn back.
const FEW_PLACES: usize = 8;
/// Maximum distance of a place of a straight path from its chord, mm: the rounding of sums of decimals.
const ON_LINE: f64 = 1e-6;

/// Decomposition of a line that retraces itself: paths that draw each edge once, and the stretches that repeat edges.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Course {
    /// Paths that together draw every edge once.
    pub paths: Vec<Vec<Step>>,
    /// Stretches that repeat edges, in the order in which they are drawn.
    pub again: Vec<Vec<Step>>,
}

impl Course {
    /// Length of the path, mm, when the line draws a single straight one; otherwise `None`.
    pub fn straight(&self, places: &[Point]) -> Option<f64> {
        let [path] = &self.paths[..] else { return None };
        let path: Vec<Point> = path.iter().map(|step| places[step.place]).collect();
        polyline::is_straight(&path, ON_LINE).then(|| polyline::length(&path))
    }
}

/// One place of a path or of a stretch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// Index of the place in the line.
    pub place: usize,
    /// Index of the later end, in the line, of the edge that leads here; at the start of a path `place` itself.
    pub led: usize,
}

/// An edge at its first drawing, by the indices of its places.
#[derive(Debug, Clone, Copy)]
struct Edge {
    ends: [usize; 2],
    /// Index of its later end in the line.
    led: usize,
}

/// Course of a line that retraces itself and encloses nothing; `None` for every other line. Two edges are equal when their ends
/// are bitwise equal.
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
    // A connected graph with one edge fewer than nodes is a tree: it has no ring.
    (!again.is_empty() && edges.len() + 1 == known.len()).then(|| Course { paths: paths(places, &edges), again })
}

/// True if a line of `count` places may retrace itself: it turns back at either end or half way, or, with few places, anywhere.
/// This quick test rejects nearly every line after a few comparisons.
pub fn turns_back(count: usize, at: impl Fn(usize) -> Point) -> bool {
    (3..=MOST_PLACES).contains(&count)
        && (at(0) == at(2)
            || at(1) == at(count - 2)
            || at(count - 3) == at(count - 1)
            || count <= FEW_PLACES && (1..count - 1).any(|k| at(k - 1) == at(k + 1)))
}

/// Decomposes a tree of edges into paths. At each place, the pair of edges that continues straightest belongs to one path.
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
        // Go back to the start of the path, then follow it.
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

/// The pair of edge ends at a place that continues straightest through it; `None` for fewer than two ends.
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

    /// Expected paths: pairs of a place and the end of the edge that leads to it.
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
        // The line starts at its tip and goes back along the first leg.
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
