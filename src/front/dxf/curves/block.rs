//! The curves of a block: fine lines, and nodes through which curves are laid.

use super::curved::{Curved, Origin};
use super::drafting::Drafting;
use super::fine::Fine;
use super::leg::Leg;
use super::nodes::{Node, Nodes};
use super::run::{Run, is_curve, lay};
use super::spikes;
use crate::front::dxf::chain::Chain;
use crate::front::dxf::fold::Fold;
use crate::front::dxf::layer::{Layer, Named};
use crate::geom::budget::Budget;

/// Vertices of the least ring.
const LEAST_RING: usize = 3;

/// Signs of where the lines of a block have curves.
#[derive(Debug, Default)]
pub(in crate::front::dxf) struct Curves {
    fine: Vec<Fine>,
    nodes: Nodes,
}

impl Curves {
    /// For a block: its lines as they are drawn, its points, and its lines once they are joined.
    pub(in crate::front::dxf) fn of(nodes: Nodes, joined: &[(Named, Chain)], fold: Option<&Fold>) -> Self {
        let fine = joined.iter().filter(|(layer, _)| layer.is_fine());
        let both = |(layer, line): &(Named, Chain)| {
            let lines = fold.map_or_else(|| vec![line.clone()], |fold| fold.unfold(line));
            lines.into_iter().map(|line| Fine::of(layer.number, line)).collect::<Vec<_>>()
        };
        let nodes = match fold {
            Some(fold) => nodes.unfolded(fold),
            None => nodes,
        };
        Self { fine: fine.flat_map(both).collect(), nodes }
    }

    /// A line of a layer with its curves.
    pub(in crate::front::dxf) fn curved(
        &self,
        line: &Chain,
        layer: &Layer,
        drafting: &mut Drafting,
        work: &mut Budget,
    ) -> Curved {
        if !drafting.is_on || self.fine.is_empty() && !self.nodes.has_curves || line.vertices.len() < 2 {
            return Curved::drawn(line);
        }
        let coarse = spikes::without(line);
        // The usual pair first; of several lines the first in the file.
        let usual = layer.fine();
        let (own, others): (Vec<&Fine>, Vec<&Fine>) = self.fine.iter().partition(|fine| Some(fine.layer) == usual);
        if let Some(legs) = own.iter().chain(&others).find_map(|fine| fine.legs(&coarse.line, work)) {
            return Curved::of(&coarse, legs, Origin::Fine);
        }
        // Fine lines that a few vertices are on are the control polygon of a line that is fine itself.
        let vertices = &coarse.line.vertices;
        let held = vertices.iter().filter(|vertex| own.iter().any(|fine| fine.holds(vertex.at, work))).count();
        let is_fine_itself = held > 0 && 2 * held <= vertices.len();
        let about = own.iter().find(|fine| fine.lies_about(&coarse.line)).filter(|_| !is_fine_itself);
        let missed = about.map(|fine| fine.span());
        let mut curved = match self.laid(&coarse.line, drafting).filter(|_| !is_fine_itself) {
            Some(legs) => Curved::of(&coarse, legs, Origin::Laid),
            None => Curved::drawn(line),
        };
        curved.missed = missed;
        curved
    }

    /// What a curve by the rule has from each vertex of a line on; `None` when it has none.
    fn laid(&self, line: &Chain, drafting: &mut Drafting) -> Option<Vec<Leg>> {
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
            // Round and round: what is far along the line no longer bends a part of it.
            let thrice: Vec<usize> = (0..3 * count).map(|k| k % count).collect();
            let is_ring = count >= LEAST_RING && nodes.iter().any(|node| is_curve(*node));
            return is_ring
                .then(|| lay(&Run { line, nodes: &nodes, places: &thrice }, count..2 * count, drafting, &mut legs))?
                .then_some(legs);
        };
        let ends = corners.iter().copied().skip(1).chain(line.is_closed.then_some(first + count));
        for (start, end) in corners.iter().copied().zip(ends) {
            let places: Vec<usize> = (start..=end).map(|k| k % count).collect();
            let inner = &places[1..places.len() - 1];
            if inner.iter().any(|&k| is_curve(nodes[k])) {
                let edges = 0..places.len() - 1;
                is_curved |= lay(&Run { line, nodes: &nodes, places: &places }, edges, drafting, &mut legs);
            }
        }
        is_curved.then_some(legs)
    }
}
