//! Curves of a block: its fine lines, and the nodes through which curves are laid.

use super::curve::{Curve, Origin};
use super::drafting::Drafting;
use super::fine::FineLine;
use super::leg::Leg;
use super::nodes::{Node, Nodes};
use super::run::{Run, is_curve};
use super::spikes;
use super::split::lay;
use crate::front::pattern::chain::Chain;
use crate::front::pattern::fold::Fold;
use crate::front::pattern::layer::{Layer, Named};
use crate::geom::budget::Budget;
use crate::geom::polyline;

/// Minimum number of vertices of a ring.
const LEAST_RING: usize = 3;
/// Height of a round curve above the chords at a vertex, mm. A line with smaller heights has fine chords.
const HIGH: f64 = 0.2;

/// Curves of a block: its fine lines and its nodes.
#[derive(Debug, Default)]
pub(in crate::front::pattern) struct Curves {
    fine: Vec<FineLine>,
    nodes: Nodes,
}

impl Curves {
    /// Curves of a block from its nodes and joined lines, on both sides of its fold.
    pub(in crate::front::pattern) fn of(nodes: Nodes, joined: &[(Named, Chain)], fold: Option<&Fold>) -> Self {
        let fine = joined.iter().filter(|(layer, _)| layer.is_fine());
        let both = |(layer, line): &(Named, Chain)| {
            let lines = fold.map_or_else(|| vec![line.clone()], |fold| fold.unfold(line));
            lines.into_iter().map(|line| FineLine::of(layer.number, line)).collect::<Vec<_>>()
        };
        let nodes = match fold {
            Some(fold) => nodes.unfolded(fold),
            None => nodes,
        };
        Self { fine: fine.flat_map(both).collect(), nodes }
    }

    /// The curve of a line on a layer.
    pub(in crate::front::pattern) fn curved(
        &self,
        line: &Chain,
        layer: &Layer,
        drafting: &mut Drafting,
        work: &mut Budget,
    ) -> Curve {
        if !drafting.is_on || self.fine.is_empty() && !self.nodes.has_curves || line.vertices.len() < 2 {
            return Curve::drawn(line);
        }
        let coarse = spikes::without(line);
        // Lines of the usual pair of layers come first, then the others in file order.
        let usual = layer.fine();
        let (own, others): (Vec<&FineLine>, Vec<&FineLine>) =
            self.fine.iter().partition(|fine| Some(fine.layer) == usual);
        if let Some(legs) = own.iter().chain(&others).find_map(|fine| fine.legs(&coarse.line, work)) {
            return Curve::of(&coarse, legs, Origin::Fine);
        }
        // Most vertices of a control polygon are not on the line. If few vertices are shared, the line itself is the fine one.
        let vertices = &coarse.line.vertices;
        let shared = vertices.iter().filter(|vertex| own.iter().any(|fine| fine.turns_at(vertex.at, work))).count();
        let is_fine_itself = shared > 0 && 2 * shared <= vertices.len() && self.has_small_chords(&coarse.line);
        let about = own.iter().find(|fine| fine.lies_about(&coarse.line)).filter(|_| !is_fine_itself);
        let missed = about.map(|fine| fine.span());
        let mut curved = match self.laid(&coarse.line, drafting, work).filter(|_| !is_fine_itself) {
            Some(legs) => Curve::of(&coarse, legs, Origin::Laid),
            None => Curve::drawn(line),
        };
        (curved.missed, curved.stray) = (missed, self.nodes.stray);
        curved
    }

    /// True if at least half of the curve points of a line have chords within [`HIGH`] of a round curve.
    fn has_small_chords(&self, line: &Chain) -> bool {
        let count = line.vertices.len();
        let inner = if line.is_closed { 0..count } else { 1..count - 1 };
        let place = |k: usize| line.vertices[k % count].at;
        let (mut points, mut high) = (0, 0);
        for k in inner.filter(|&k| self.nodes.at(place(k)) == Node::Smooth) {
            let [before, at, behind] = [place(k + count - 1), place(k), place(k + 1)];
            let length = (at - before).norm().min((behind - at).norm());
            // A curve rises above each chord by an eighth of its turn, relative to the chord length.
            points += 1;
            high += usize::from(polyline::turn_at(before, at, behind).abs() * length / 8.0 >= HIGH);
        }
        2 * high <= points
    }

    /// The curve by the rule of the CAD system, one leg per vertex; `None` for a line without curve points.
    fn laid(&self, line: &Chain, drafting: &mut Drafting, work: &mut Budget) -> Option<Vec<Leg>> {
        if !self.nodes.has_curves {
            return None;
        }
        let count = line.vertices.len();
        let mut nodes: Vec<Node> = line.vertices.iter().map(|vertex| self.nodes.at(vertex.at)).collect();
        if !line.is_closed {
            (nodes[0], nodes[count - 1]) = (Node::Corner, Node::Corner);
        }
        let mut legs: Vec<Leg> = line.vertices.iter().map(|&vertex| vec![vertex]).collect();
        let corners: Vec<usize> = (0..count).filter(|&k| nodes[k] == Node::Corner).collect();
        let mut is_curved = false;
        let Some(&first) = corners.first() else {
            let places: Vec<usize> = (0..count).collect();
            let is_ring = count >= LEAST_RING && nodes.iter().any(|node| is_curve(*node));
            let run = Run { line, nodes: &nodes, places: &places, is_ring };
            return (is_ring && lay(&run, drafting, work, &mut legs)).then_some(legs);
        };
        let ends = corners.iter().copied().skip(1).chain(line.is_closed.then_some(first + count));
        for (start, end) in corners.iter().copied().zip(ends) {
            let places: Vec<usize> = (start..=end).map(|k| k % count).collect();
            let inner = &places[1..places.len() - 1];
            if inner.iter().any(|&k| is_curve(nodes[k])) {
                let run = Run { line, nodes: &nodes, places: &places, is_ring: false };
                is_curved |= lay(&run, drafting, work, &mut legs);
            }
        }
        is_curved.then_some(legs)
    }
}
