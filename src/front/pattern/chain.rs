//! Chains: lines whose ends meet are joined.

use std::collections::BTreeMap;

use crate::geom::Point;
use crate::ir::drawing::Vertex;
use crate::machine::patterns::Dxf;

/// Maximum distance of ends that meet, mm.
pub(super) const REACH: f64 = Dxf::ENDS_MEET;
/// Maximum number of ends that are compared in a cell; larger numbers result from lines drawn over each other.
const MOST_AROUND: usize = 16;
/// Minimum number of vertices of a line with an interior.
const LEAST_RING: usize = 3;

/// A line. In a closed line the last vertex leads to the first, which is not repeated.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Chain {
    pub(super) vertices: Vec<Vertex>,
    pub(super) is_closed: bool,
}

impl Chain {
    /// Creates a line without repeated consecutive points, closed if it ends at its start point. `None` if it has no length.
    pub(super) fn of(mut vertices: Vec<Vertex>, is_closed: bool) -> Option<Self> {
        vertices.dedup_by(|next, before| next.at == before.at);
        let gap = |vertices: &[Vertex]| (vertices[0].at - vertices[vertices.len() - 1].at).norm();
        let most = if is_closed { 0.0 } else { REACH };
        let meets = vertices.len() > 2 && gap(&vertices) <= most;
        if meets && let Some(last) = vertices.pop() {
            // The edge to the removed vertex now leads to the first one.
            vertices[0].span = last.span;
        }
        let is_closed = (is_closed || meets) && vertices.len() >= LEAST_RING;
        (vertices.len() > 1).then_some(Self { vertices, is_closed })
    }

    /// The vertices; those of a closed line end with the first one again.
    pub(super) fn round(&self) -> impl Iterator<Item = Vertex> + '_ {
        let again = if self.is_closed { self.vertices.first() } else { None };
        self.vertices.iter().chain(again).copied()
    }

    /// The points; those of a closed line end with the first one again.
    pub(super) fn points(&self) -> Vec<Point> {
        self.round().map(|vertex| vertex.at).collect()
    }
}

/// An end of a line: twice the index of the line, plus one for its last vertex.
type End = usize;

/// Joins open lines whose ends meet, nearest ends first. The lines keep the order of their starts.
pub(super) fn chains(lines: Vec<Chain>) -> Vec<Chain> {
    let partner = partners(&lines);
    let mut left: Vec<Option<Chain>> = lines.into_iter().map(Some).collect();
    let mut joined = Vec::new();
    for first in 0..left.len() {
        let Some(line) = left[first].take() else { continue };
        if line.is_closed {
            joined.push(line);
            continue;
        }
        let mut vertices = line.vertices;
        // Extends the line from its end, then, unless it has closed, from its start.
        for end in [2 * first + 1, 2 * first] {
            let mut at = end;
            while let Some(next) = partner[at]
                && let Some(Chain { vertices: mut more, .. }) = left[next / 2].take()
            {
                if next % 2 == 1 {
                    more.reverse();
                }
                vertices.extend(more.drain(1..));
                at = next ^ 1;
            }
            vertices.reverse();
        }
        joined.extend(Chain::of(vertices, false));
    }
    joined
}

/// The partner of each end.
fn partners(lines: &[Chain]) -> Vec<Option<End>> {
    let place = |end: End| {
        let vertices = &lines[end / 2].vertices;
        vertices[if end.is_multiple_of(2) { 0 } else { vertices.len() - 1 }].at
    };
    let open = (0..2 * lines.len()).filter(|end| !lines[end / 2].is_closed);
    let cell = |at: Point| [at.x, at.y].map(|value| (value / REACH).floor() as i64);
    let mut cells: BTreeMap<[i64; 2], Vec<End>> = BTreeMap::new();
    open.clone().for_each(|end| cells.entry(cell(place(end))).or_default().push(end));
    let mut pairs = Vec::new();
    for end in open {
        let [x, y] = cell(place(end));
        let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y]));
        let near = around.filter_map(|cell| cells.get(&cell)).flat_map(|ends| ends.iter().take(MOST_AROUND));
        for &other in near.filter(|&&other| other > end && other / 2 != end / 2) {
            let distance = (place(other) - place(end)).norm();
            if distance <= REACH {
                pairs.push((distance, end, other));
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut partner = vec![None; 2 * lines.len()];
    for (_, a, b) in pairs {
        if partner[a].is_none() && partner[b].is_none() {
            (partner[a], partner[b]) = (Some(b), Some(a));
        }
    }
    partner
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Span;

    fn line(places: &[[f64; 2]]) -> Chain {
        let vertex = |&[x, y]: &[f64; 2]| Vertex { at: Point::new(x, y), span: Span::default() };
        Chain::of(places.iter().map(vertex).collect(), false).expect("it has a length")
    }

    fn check(lines: &[&[[f64; 2]]], expected: &[(usize, bool)]) {
        let found = chains(lines.iter().map(|places| line(places)).collect());
        let found: Vec<_> = found.iter().map(|chain| (chain.vertices.len(), chain.is_closed)).collect();
        assert_eq!(found, expected, "{lines:?}");
    }

    #[test]
    fn lines_become_rings_whichever_way_they_are_drawn() {
        check(&[&[[0.0, 0.0], [9.0, 0.0], [9.0, 9.0]], &[[0.0, 0.0], [0.0, 9.0], [9.0, 9.0]]], &[(4, true)]);
        check(&[&[[0.0, 0.0], [9.0, 0.0]], &[[9.0, 9.0], [9.0, 0.0]], &[[9.0, 9.0], [0.0, 0.0]]], &[(3, true)]);
        check(&[&[[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 0.1]]], &[(3, true)]);
    }

    #[test]
    fn lines_that_miss_each_other_stay_open() {
        check(&[&[[0.0, 0.0], [9.0, 0.0]], &[[9.0, 0.3], [9.0, 9.0]]], &[(2, false), (2, false)]);
        check(&[&[[5.0, 0.0], [9.0, 0.0]], &[[0.0, 0.0], [5.0, 0.1]]], &[(3, false)]);
        check(&[&[[0.0, 0.0], [9.0, 0.0]], &[[0.0, 0.0], [9.0, 0.0]]], &[(2, false)]);
    }
}
