//! Curves between the vertices of a line: layer 1 has the corners of an outline and a few points of its curves, as layers 8,
//! 11 and 14 have of other lines.
//!
//! Receives the lines of a block, joined and unfolded, with its points. Promises each line as the CAD system draws it: along
//! the [`fine`] line of layers 84 to 87 that goes through all of its vertices, else along a curve by the [`rule`] of the
//! system from turn point to turn point, straight where no curve point stands between, as its [`nodes`] say; else as it is.
//! Never leaves a vertex, but for a point that [`gerber`] adds for the sake of a notch, within a hundredth of a millimetre.

mod count;
mod curved;
mod fine;
mod gerber;
mod hermite;
mod lend;
mod nodes;
mod rule;
mod run;
mod spikes;
mod spline;

pub(super) use count::{CurvedFrom, CurvedPieces};
pub(super) use curved::{Curved, Origin};
use fine::Fine;
pub(super) use lend::{Size, lend};
use nodes::Node;
pub(super) use nodes::Nodes;
use rule::{Rule, rule_of};
use run::{Run, is_curve, lay};

use super::chain::Chain;
use super::fold::Fold;
use super::layer::{Layer, Named};
use crate::geom::Point;
use crate::geom::budget::Budget;
use crate::ir::drawing::Vertex;
use crate::machine::patterns::Curves as Asked;

/// Places of a curve between two vertices.
type Stretch = Vec<Point>;
/// Vertices of a line from one vertex of the coarse line on, before the next.
type Leg = Vec<Vertex>;

/// Farthest that chords lie off a curve that is laid, mm.
const CHORDS_OFF: f64 = 0.02;
/// Places of all curves of a file: more come from damaged coordinates.
const MOST_PLACES: usize = 4_000_000;
/// Vertices of the least ring.
const LEAST_RING: usize = 3;

/// How the lines of a file get their curves, and how many places these have so far.
#[derive(Debug)]
pub(super) struct Drafting {
    is_on: bool,
    rule: Rule,
    /// The CAD system whose rule it is, if the file tells.
    pub(super) system: Option<&'static str>,
    /// Farthest that chords lie off, mm.
    sagitta: f64,
    places: usize,
}

impl Drafting {
    /// For a file by an author, whose chords lie so far off their curves at the most, mm.
    pub(super) fn of(author: &str, asked: Asked, sagitta: f64) -> Self {
        let (rule, system) = rule_of(author);
        Self { is_on: asked == Asked::Auto, rule, system, sagitta: sagitta.min(CHORDS_OFF), places: 0 }
    }

    /// Whether curves have more places than a file can need: then some lines have none.
    pub(super) fn is_overfull(&self) -> bool {
        self.places > MOST_PLACES
    }

    /// The curve through knots, in parts.
    fn spans(&mut self, knots: &[Point]) -> Option<Vec<Stretch>> {
        let spans = self.rule.spans(knots, self.sagitta, MOST_PLACES.saturating_sub(self.places));
        self.places += spans.as_ref().map_or(MOST_PLACES + 1, |spans| spans.iter().map(Vec::len).sum());
        spans.filter(|spans| spans.iter().flatten().all(|at| at.x.is_finite() && at.y.is_finite()))
    }
}

/// What says where the lines of a block have curves.
#[derive(Debug, Default)]
pub(super) struct Curves {
    fine: Vec<Fine>,
    nodes: Nodes,
}

impl Curves {
    /// For a block: its lines as they are drawn, its points, and its lines once they are joined.
    pub(super) fn of(nodes: Nodes, joined: &[(Named, Chain)], fold: Option<&Fold>) -> Self {
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
    pub(super) fn curved(&self, line: &Chain, layer: &Layer, drafting: &mut Drafting, work: &mut Budget) -> Curved {
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
        match self.laid(&coarse.line, drafting).filter(|_| !is_fine_itself) {
            Some(legs) => Curved::of(&coarse, legs, Origin::Laid),
            None => Curved::drawn(line),
        }
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
