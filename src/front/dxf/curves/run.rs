//! Runs: the vertices through which one curve goes.

use super::drafting::Drafting;
use super::leg::Leg;
use super::nodes::{Node, ON};
use crate::front::dxf::chain::Chain;
use crate::geom::{Point, polyline};
use crate::ir::drawing::Vertex;

/// Whether a vertex is a curve point.
pub(super) fn is_curve(node: Node) -> bool {
    matches!(node, Node::Smooth | Node::Notched)
}

/// A run of vertices through which one curve goes.
pub(super) struct Run<'a> {
    pub(super) line: &'a Chain,
    pub(super) nodes: &'a [Node],
    /// Its vertices in the line, in order.
    pub(super) places: &'a [usize],
}

/// Lays a curve through a run, and gives some of its edges what lies on it; whether that could be done.
pub(super) fn lay(run: &Run, edges: std::ops::Range<usize>, drafting: &mut Drafting, legs: &mut [Leg]) -> bool {
    let Run { line, nodes, places } = run;
    let at = |i: usize| line.vertices[places[i]].at;
    let mut knots: Vec<usize> = (0..places.len()).collect();
    if drafting.rule.may_pass_notches() {
        for i in 1..places.len() - 1 {
            if nodes[places[i]] != Node::Notched || knots.len() <= 2 {
                continue;
            }
            let others: Vec<usize> = knots.iter().copied().filter(|&k| k != i).collect();
            let points: Vec<Point> = others.iter().map(|&k| at(k)).collect();
            let is_beside = drafting.spans(&points).is_some_and(|spans| {
                let way: Vec<Point> =
                    points.iter().zip(spans).flat_map(|(&at, span)| [vec![at], span].concat()).collect();
                polyline::distance(at(i), &way) <= ON
            });
            if is_beside {
                knots = others;
            }
        }
    }
    let points: Vec<Point> = knots.iter().map(|&k| at(k)).collect();
    let Some(spans) = drafting.spans(&points) else { return false };
    for (pair, span) in knots.windows(2).zip(spans) {
        let inner: Vec<usize> = (pair[0] + 1..pair[1]).collect();
        // Vertices that the curve passes part its stretch where it comes nearest.
        let nearest = |i: usize| {
            let distance = |k: &usize| (span[*k] - at(i)).norm();
            (0..span.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
        };
        let mut cuts: Vec<usize> = inner.iter().map(|&i| nearest(i)).collect();
        cuts.sort_unstable();
        let bounds: Vec<usize> = std::iter::once(0).chain(cuts).chain([span.len()]).collect();
        for (edge, part) in (pair[0]..pair[1]).zip(bounds.windows(2)) {
            if !edges.contains(&edge) {
                continue;
            }
            let part = &span[part[0]..part[1]];
            let next = line.vertices[places[edge + 1]].span;
            let leg = &mut legs[places[edge]];
            if edge > pair[0] {
                leg.clear();
            }
            leg.extend(part.iter().map(|&at| Vertex { at, span: next }));
        }
    }
    true
}
