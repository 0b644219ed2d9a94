//! Spurs: lines that stand off an outline. One end of a spur meets the outline and the others meet nothing, so it is a slit:
//! the outline follows it out and back, branch by branch.

use super::chain::{Chain, REACH, chains};
use super::retrace::{Retraced, once};
use super::tree::{End, Graph, Tour};
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline};
use crate::ir::drawing::Vertex;

/// Joins the lines of a layer. Each outline follows its spurs, and stretches that retrace it are dropped.
pub(super) fn chains_with_spurs(lines: &[Chain], retraced: &mut Vec<Retraced>) -> Vec<Chain> {
    let graph = Graph::of(lines);
    let of =
        |wanted: &dyn Fn(usize) -> bool| (0..lines.len()).filter(|&k| wanted(k)).map(|k| lines[k].clone()).collect();
    let mut tours = graph.tours_off_rings();
    if graph.meetings().next().is_some() {
        let rings = chains(of(&|k| lines[k].is_closed || graph.leads_round(k)));
        tours.extend(tours_from_edges(&graph, &Edges::of(rings.iter().filter(|chain| chain.is_closed))));
    }
    let mut is_apart = vec![false; lines.len()];
    for &line in tours.iter().flat_map(|tour| &tour.lines) {
        is_apart[line] = true;
    }
    let mut trees = graph.trees();
    trees.retain(|tree| !tree.iter().any(|&line| is_apart[line]));
    for &line in trees.iter().flatten() {
        is_apart[line] = true;
    }
    let mut joined = once(chains(of(&|k| !is_apart[k])), retraced);
    let edges = Edges::of(joined.iter().filter(|chain| chain.is_closed));
    let mut is_trunk = vec![false; lines.len()];
    for tree in &trees {
        let standing: Vec<usize> =
            graph.tips(tree).into_iter().filter(|&tip| edges.standing(graph.place(tip)).is_some()).collect();
        if let [root] = standing[..] {
            tours.push(graph.tour(root));
            continue;
        }
        let trunk = graph.trunk(tree);
        for &line in &trunk {
            is_trunk[line] = true;
        }
        tours.extend(graph.tours_off(&trunk));
    }
    joined.extend(once(chains(of(&|k| is_trunk[k])), retraced));
    attached(joined, tours, lines)
}

/// Tours along lines that meet at a point of a ring and touch the ring only there.
fn tours_from_edges(graph: &Graph, edges: &Edges) -> Vec<Tour> {
    let stands = |end: End| edges.standing(graph.place(end)).is_some();
    let are_spurs = |ends: &&[End]| {
        let stand_off = || ends.iter().all(|&end| !graph.ends_from(end).into_iter().any(stands));
        ends.first().is_some_and(|&end| stands(end)) && stand_off()
    };
    graph.meetings().filter(are_spurs).flatten().map(|&end| graph.tour(end)).collect()
}

/// Attachment point of a spur on an outline.
#[derive(Debug, Clone, Copy)]
struct Foot {
    ring: usize,
    vertex: usize,
    /// Position on the edge after that vertex, as a fraction of its length; 0 at the vertex.
    share: f64,
}

/// Index of the edges of outlines: closed ones, and halves that end at a fold.
struct Edges {
    /// Ring, vertex and ends of each edge.
    all: Vec<(usize, usize, [Point; 2])>,
    /// Number of vertices of each ring.
    counts: Vec<usize>,
    boxes: Boxes,
}

impl Edges {
    /// Indexes the edges of chains.
    fn of<'a>(rings: impl Iterator<Item = &'a Chain>) -> Self {
        let (mut all, mut counts) = (Vec::new(), Vec::new());
        for (ring, chain) in rings.enumerate() {
            counts.push(chain.vertices.len());
            let points = chain.points();
            all.extend(points.windows(2).enumerate().map(|(k, ends)| (ring, k, [ends[0], ends[1]])));
        }
        let boxes = Boxes::new(all.iter().map(|(_, _, [a, b])| Extent::between(*a, *b).grown(REACH)).collect());
        Self { all, counts, boxes }
    }

    /// Attachment point on the nearest outline within [`REACH`].
    fn standing(&self, at: Point) -> Option<Foot> {
        let distance = |k: &usize| polyline::distance_to_segment(at, self.all[*k].2[0], self.all[*k].2[1]);
        let near = self.boxes.at(at).filter(|k| distance(k) <= REACH);
        let edge = near.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let (ring, vertex, [a, b]) = self.all[edge];
        let is_at = |end: Point| (end - at).norm() <= REACH;
        Some(match (is_at(a), is_at(b)) {
            (true, _) => Foot { ring, vertex, share: 0.0 },
            (false, true) => Foot { ring, vertex: (vertex + 1) % self.counts[ring], share: 0.0 },
            (false, false) => Foot { ring, vertex, share: polyline::foot(at, a, b) },
        })
    }
}

/// Attaches spurs, and open lines with one end on an edge, to their outlines; other lines stay as they are. Without a closed
/// outline the longest line counts as one, as it may be half an outline that ends at a fold.
fn attached(chains: Vec<Chain>, tours: Vec<Tour>, lines: &[Chain]) -> Vec<Chain> {
    let (mut rings, mut open): (Vec<Chain>, Vec<Chain>) = chains.into_iter().partition(|chain| chain.is_closed);
    if rings.is_empty() {
        let length = |k: &usize| polyline::length(&open[*k].points());
        let longest = (0..open.len()).max_by(|a, b| length(a).total_cmp(&length(b)).then(b.cmp(a)));
        rings.extend(longest.map(|longest| open.remove(longest)));
    }
    let edges = Edges::of(rings.iter());
    let (mut left, mut standing): (Vec<Chain>, Vec<(Foot, Tour)>) = Default::default();
    for mut line in open {
        let ends = [line.vertices[0].at, line.vertices[line.vertices.len() - 1].at];
        match ends.map(|end| edges.standing(end)) {
            [Some(foot), None] => standing.push((foot, Tour::along(&line.vertices))),
            [None, Some(foot)] => {
                line.vertices.reverse();
                standing.push((foot, Tour::along(&line.vertices)));
            }
            [None, None] | [Some(_), Some(_)] => left.push(line),
        }
    }
    for tour in tours {
        let foot = edges.standing(tour.root.at).filter(|_| tour.tips.iter().all(|tip| edges.standing(*tip).is_none()));
        match foot {
            Some(foot) => standing.push((foot, tour)),
            None => left.extend(tour.lines.iter().map(|&line| lines[line].clone())),
        }
    }
    let order = |foot: &Foot| (foot.ring, foot.vertex);
    standing.sort_by(|(a, _), (b, _)| order(a).cmp(&order(b)).then(a.share.total_cmp(&b.share)));
    let mut standing = standing.into_iter().peekable();
    let mut whole = Vec::with_capacity(rings.len() + left.len());
    for (ring, chain) in rings.into_iter().enumerate() {
        let mut vertices = Vec::with_capacity(chain.vertices.len());
        for (k, &vertex) in chain.vertices.iter().enumerate() {
            vertices.push(vertex);
            while let Some((foot, tour)) = standing.next_if(|(foot, _)| order(foot) == (ring, k)) {
                go_along(&mut vertices, if foot.share > 0.0 { tour.root } else { vertex }, tour);
            }
        }
        whole.push(Chain { vertices, is_closed: chain.is_closed });
    }
    whole.into_iter().chain(left).collect()
}

/// Extends an outline along a spur and back to its root.
fn go_along(vertices: &mut Vec<Vertex>, root: Vertex, tour: Tour) {
    if vertices.last().is_none_or(|last| last.at != root.at) {
        vertices.push(root);
    }
    vertices.extend(tour.way);
    if let Some(last) = vertices.last_mut() {
        last.at = root.at;
    }
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
        let found = chains_with_spurs(&lines.iter().map(|places| line(places)).collect::<Vec<_>>(), &mut Vec::new());
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
    fn branches_are_gone_along_one_after_the_other() {
        let there = [[0.0, 9.0], [0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [4.0, 9.0]];
        let (last, stem) = ([[4.0, 9.0], [0.0, 9.0]], [[4.0, 7.0], [4.0, 9.0]]);
        let branches = [[[4.0, 7.0], [3.0, 5.0]], [[5.0, 5.0], [4.0, 7.0]]];
        let way = [[4.0, 7.0], [3.0, 5.0], [4.0, 7.0], [5.0, 5.0], [4.0, 7.0], [4.0, 9.0]];
        let ring = [&there[..], &way].concat();
        check(&[&there, &last, &branches[0], &stem, &branches[1]], &[&ring]);
        let back = [[0.0, 9.0], [0.0, 0.0], [9.0, 0.0], [9.0, 9.0]];
        let ring = [&[[4.0, 9.0]], &way[..], &back].concat();
        check(&[&branches[0], &branches[1], &stem, &last, &there], &[&ring]);
    }

    #[test]
    fn spurs_stand_on_their_vertices_the_first_one_too() {
        let ring = [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0], [0.0, 0.0]];
        let spurs = [[[0.0, 0.0], [2.0, 2.0]], [[9.0, 9.0], [7.0, 7.0]], [[4.0, 2.0], [4.0, 0.0]]];
        let way = [[0.0, 0.0], [2.0, 2.0], [0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [4.0, 0.0], [9.0, 0.0], [9.0, 9.0]];
        let rest = [[7.0, 7.0], [9.0, 9.0], [0.0, 9.0]];
        check(&[&ring, &spurs[0], &spurs[1], &spurs[2]], &[&[&way[..], &rest].concat()]);
    }

    #[test]
    fn lines_that_meet_at_one_place_of_a_ring_are_a_spur_each() {
        let square = [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0], [0.0, 0.0]];
        let [a, b, c] = [[3.0, 2.0], [4.0, 3.0], [5.0, 2.0]];
        // On an edge, for each direction of both lines.
        let foot = [4.0, 0.0];
        let way = [square[0], foot, a, foot, c];
        let rest = [foot, square[1], square[2], square[3]];
        check(&[&square, &[foot, a], &[c, foot]], &[&[&way[..], &rest].concat()]);
        let way = [square[0], foot, a, foot, b, foot, c];
        check(&[&square, &[foot, a], &[b, foot], &[foot, c]], &[&[&way[..], &rest].concat()]);
        // At a vertex of a ring in two lines, one of them with a branch.
        let [first, second] = [[[0.0, 9.0], [0.0, 0.0], [9.0, 0.0]], [[9.0, 0.0], [9.0, 9.0], [0.0, 9.0]]];
        let foot = [0.0, 0.0];
        let way = [[0.0, 9.0], foot, [2.0, 2.0], a, [2.0, 2.0], b, [2.0, 2.0], foot, c, foot];
        let spurs = [[foot, [2.0, 2.0]], [[2.0, 2.0], a], [[2.0, 2.0], b], [foot, c]];
        let whole = [&way[..], &[[9.0, 0.0], [9.0, 9.0]]].concat();
        check(&[&first, &second, &spurs[0], &spurs[1], &spurs[2], &spurs[3]], &[&whole]);
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
