//! Spurs: lines that stand off an outline. One end of a spur meets the outline and the other one nothing, so it is a slit: the
//! outline goes along it and back.

use std::collections::BTreeMap;

use super::chain::{Chain, REACH, chains};
use super::retrace::{Retraced, once};
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline};
use crate::ir::drawing::Vertex;

/// Ends that meet in a node of an outline that goes on: more meet where something stands off it.
const PASSING: usize = 2;

/// The lines of a layer joined, each with the spurs that stand off it and without what goes along it again.
pub(super) fn chains_with_spurs(lines: Vec<Chain>, retraced: &mut Vec<Retraced>) -> Vec<Chain> {
    let nodes = Nodes::of(&lines);
    let (mut is_spur, mut spurs) = (vec![false; lines.len()], Vec::new());
    for (tip, path) in nodes.paths(&lines) {
        for &line in &path {
            is_spur[line] = true;
        }
        spurs.push(from_root(&lines, tip, &path));
    }
    let mut left = is_spur.iter();
    let rest = lines.into_iter().filter(|_| left.next() == Some(&false)).collect();
    attached(once(chains(rest), retraced), spurs)
}

/// The end of a line: twice its place among the lines, and one more for its last vertex.
type End = usize;

/// The places where ends of open lines meet.
struct Nodes {
    /// The node of each end of an open line.
    of_end: BTreeMap<End, usize>,
    /// The ends in each node.
    ends: Vec<Vec<End>>,
}

fn place(lines: &[Chain], end: End) -> Point {
    let vertices = &lines[end / 2].vertices;
    vertices[if end.is_multiple_of(2) { 0 } else { vertices.len() - 1 }].at
}

impl Nodes {
    fn of(lines: &[Chain]) -> Self {
        let cell = |at: Point| [at.x, at.y].map(|value| (value / REACH).floor() as i64);
        let mut nodes = Self { of_end: BTreeMap::new(), ends: Vec::new() };
        let mut cells: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
        let mut places: Vec<Point> = Vec::new();
        for end in (0..2 * lines.len()).filter(|end| !lines[end / 2].is_closed) {
            let at = place(lines, end);
            let [x, y] = cell(at);
            let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y]));
            let near =
                around.filter_map(|cell| cells.get(&cell)).flatten().find(|&&node| (places[node] - at).norm() <= REACH);
            let node = near.copied().unwrap_or_else(|| {
                places.push(at);
                nodes.ends.push(Vec::new());
                cells.entry([x, y]).or_default().push(places.len() - 1);
                places.len() - 1
            });
            nodes.ends[node].push(end);
            nodes.of_end.insert(end, node);
        }
        nodes
    }

    /// Ways from a free end to a node where two more lines meet: the free end, and the lines from there on.
    fn paths(&self, lines: &[Chain]) -> Vec<(End, Vec<usize>)> {
        let mut counts: Vec<usize> = self.ends.iter().map(Vec::len).collect();
        let mut paths = Vec::new();
        for tip in
            (0..2 * lines.len()).filter(|tip| self.of_end.get(tip).is_some_and(|&node| self.ends[node].len() == 1))
        {
            let mut path = vec![tip / 2];
            let mut at = tip ^ 1;
            while let Some(&node) = self.of_end.get(&at) {
                if counts[node] > PASSING {
                    counts[node] -= 1;
                    paths.push((tip, path));
                    break;
                }
                let Some(&next) = self.ends[node].iter().find(|&&next| next != at).filter(|_| counts[node] == PASSING)
                else {
                    break;
                };
                if path.contains(&(next / 2)) {
                    break;
                }
                path.push(next / 2);
                at = next ^ 1;
            }
        }
        paths
    }
}

/// The vertices of a spur from where it stands to its tip.
fn from_root(lines: &[Chain], tip: End, path: &[usize]) -> Vec<Vertex> {
    let mut vertices: Vec<Vertex> = Vec::new();
    let mut begins = tip;
    for &line in path {
        let mut more = lines[line].vertices.clone();
        let joins = vertices.last().map(|last| last.at);
        let is_turned = match joins {
            None => !begins.is_multiple_of(2),
            Some(at) => (more[more.len() - 1].at - at).norm() < (more[0].at - at).norm(),
        };
        if is_turned {
            more.reverse();
        }
        vertices.extend(more.drain(usize::from(joins.is_some())..));
        begins = 2 * line;
    }
    vertices.reverse();
    vertices
}

/// Outlines with spurs, and with open lines that stand on an edge of theirs; what stands nowhere stays.
fn attached(chains: Vec<Chain>, spurs: Vec<Vec<Vertex>>) -> Vec<Chain> {
    let (mut rings, open): (Vec<Chain>, Vec<Chain>) = chains.into_iter().partition(|chain| chain.is_closed);
    if spurs.is_empty() && open.is_empty() || rings.is_empty() {
        return rings
            .into_iter()
            .chain(open)
            .chain(spurs.into_iter().filter_map(|spur| Chain::of(spur, false)))
            .collect();
    }
    let edges: Vec<(usize, usize, [Point; 2])> = rings
        .iter()
        .enumerate()
        .flat_map(|(ring, chain)| {
            let points = chain.points();
            (0..points.len() - 1).map(move |k| (ring, k, [points[k], points[k + 1]])).collect::<Vec<_>>()
        })
        .collect();
    let boxes = Boxes::new(edges.iter().map(|(_, _, [a, b])| Extent::between(*a, *b).grown(REACH)).collect());
    let standing = |at: Point| {
        let distance = |k: &usize| polyline::distance_to_segment(at, edges[*k].2[0], edges[*k].2[1]);
        boxes.at(at).filter(|k| distance(k) <= REACH).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    let mut left = Vec::new();
    let mut whiskers: Vec<(usize, Vec<Vertex>)> = Vec::new();
    for mut line in open.into_iter().map(|chain| chain.vertices).chain(spurs) {
        let [first, last] = [line[0].at, line[line.len() - 1].at].map(standing);
        match (first, last) {
            (Some(edge), None) => whiskers.push((edge, line)),
            (None, Some(edge)) => {
                line.reverse();
                whiskers.push((edge, line));
            }
            (None, None) | (Some(_), Some(_)) => left.extend(Chain::of(line, false)),
        }
    }
    // From the last edge to the first, and along each from its end, so that places stay what they are.
    let station =
        |(edge, line): &(usize, Vec<Vertex>)| (*edge, polyline::foot(line[0].at, edges[*edge].2[0], edges[*edge].2[1]));
    whiskers.sort_by(|a, b| {
        let [(a, at_a), (b, at_b)] = [station(a), station(b)];
        b.cmp(&a).then(at_b.total_cmp(&at_a))
    });
    for (edge, line) in whiskers {
        let (ring, k, ends) = edges[edge];
        put(&mut rings[ring], k, ends, &line);
    }
    rings.into_iter().chain(left).collect()
}

/// Lets an outline go along a spur that stands on its edge behind vertex `k`, and back.
fn put(ring: &mut Chain, k: usize, ends: [Point; 2], spur: &[Vertex]) {
    let root = spur[0];
    let count = ring.vertices.len();
    let near = |at: Point| (at - root.at).norm() <= REACH;
    let (behind, at) = match ends.map(near) {
        [true, _] => (k + 1, Some(ring.vertices[k])),
        [false, true] => (k + 2, Some(ring.vertices[(k + 1) % count])),
        [false, false] => (k + 1, None),
    };
    let way = spur[1..].iter().chain(spur[1..spur.len() - 1].iter().rev()).copied();
    let back = Vertex { at: at.unwrap_or(root).at, span: spur[1].span };
    let way = at.is_none().then_some(root).into_iter().chain(way).chain([back]).collect::<Vec<_>>();
    // Behind the last vertex of a ring comes its first.
    let behind = if behind > count { 1 } else { behind };
    ring.vertices.splice(behind..behind, way);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Span;

    fn line(places: &[[f64; 2]]) -> Chain {
        let vertex = |&[x, y]: &[f64; 2]| Vertex { at: Point::new(x, y), span: Span::default() };
        Chain::of(places.iter().map(vertex).collect(), false).expect("it has a length")
    }

    fn check(lines: &[&[[f64; 2]]], expected: &[&[[f64; 2]]]) {
        let found = chains_with_spurs(lines.iter().map(|places| line(places)).collect(), &mut Vec::new());
        let places = |chain: &Chain| chain.vertices.iter().map(|v| [v.at.x, v.at.y]).collect::<Vec<_>>();
        assert_eq!(found.iter().map(places).collect::<Vec<_>>(), expected, "{lines:?}");
    }

    #[test]
    fn a_line_that_stands_off_an_outline_is_gone_along_and_back() {
        let there = [[0.0, 9.0], [0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [4.0, 9.0]];
        let last = [[4.0, 9.0], [0.0, 9.0]];
        let spur = [[4.0, 9.0], [4.0, 5.0]];
        let ring = [[0.0, 9.0], [0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [4.0, 9.0], [4.0, 5.0], [4.0, 9.0]];
        check(&[&there, &spur, &last], &[&ring]);
        check(&[&spur, &there, &last], &[&ring]);
        let bent = [[4.0, 7.0], [5.0, 5.0]];
        let both = [&ring[..5], &[[4.0, 7.0], [5.0, 5.0], [4.0, 7.0], [4.0, 9.0]]].concat();
        check(&[&there, &[[4.0, 7.0], [4.0, 9.0]], &last, &bent], &[&both]);
    }

    #[test]
    fn a_line_that_stands_on_an_edge_is_a_spur_and_one_from_edge_to_edge_is_none() {
        let square = [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0], [0.0, 0.0]];
        let ring = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [4.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]];
        check(&[&square, &[[4.0, 3.0], [4.0, 0.0]]], &[&ring]);
        check(&[&square, &[[4.0, 9.0], [4.0, 0.0]]], &[&square[..4], &[[4.0, 9.0], [4.0, 0.0]]]);
        check(&[&square, &[[4.0, 5.0], [4.0, 3.0]]], &[&square[..4], &[[4.0, 5.0], [4.0, 3.0]]]);
    }
}
