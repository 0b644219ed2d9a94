//! Curves of a block: its fine lines, and the nodes through which curves are laid.

use super::curve::{Curve, Origin};
use super::drafting::Drafting;
use super::fine::{FineLayers, FineLine, Stretch};
use super::leg::Leg;
use super::nodes::{Node, Nodes};
use super::run::{Run, is_curve};
use super::spikes::{self, Base};
use super::split::lay;
use crate::front::pattern::chain::Chain;
use crate::front::pattern::fold::Fold;
use crate::front::pattern::layer::{Layer, Named};
use crate::geom::budget::Budget;
use crate::geom::{Point, polyline};

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
        let count = coarse.line.vertices.len();
        let finer = own.iter().chain(&others).filter(|fine| fine.is_finer_than(count));
        let legs_of = |fine: &&FineLine| Some((fine.layer, fine.legs(&coarse.line, work)?));
        if let Some((layer, legs)) = finer.into_iter().find_map(legs_of) {
            let layers = FineLayers::of(layer);
            let mut curved = Curve::of(&coarse, legs, &vec![Origin::Fine; count]);
            curved.layers = layers;
            return curved;
        }
        let stretches = stretches(&own, &coarse.line, work);
        // Most vertices of a control polygon are not on the line. If few vertices are shared, the line itself is the fine one.
        let vertices = &coarse.line.vertices;
        let is_shared = |at: Point, work: &mut Budget| own.iter().any(|fine| fine.turns_at(at, work));
        let shared = vertices.iter().filter(|vertex| is_shared(vertex.at, work)).count();
        let is_fine_itself =
            stretches.is_empty() && shared > 0 && 2 * shared <= count && self.has_small_chords(&coarse.line);
        let is_used = |k: usize| stretches.iter().any(|(fine, _)| *fine == k);
        let misses = |(k, fine): &(usize, &&FineLine)| {
            // Without curve points an open line is no control polygon: those of a line that is fine itself go round it.
            let may_miss = !is_fine_itself || !self.nodes.has_curves && fine.is_open();
            may_miss && !is_used(*k) && fine.lies_about(&coarse.line) && !fine.goes_along(&coarse.line, work)
        };
        let about = own.iter().enumerate().find(misses);
        let missed = about.map(|(_, fine)| (fine.span(), FineLayers::of(fine.layer)));
        let laid = self.laid(&coarse.line, drafting, work).filter(|_| !is_fine_itself);
        let mut curved = drawn_in_part(&coarse, laid, stretches).unwrap_or_else(|| Curve::drawn(line));
        curved.layers = own.first().map_or(FineLayers::default(), |fine| FineLayers::of(fine.layer));
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

/// The parts of a line that fine lines draw anew, with the indices of these fine lines. Where two of them draw one edge, neither
/// is taken.
fn stretches(fine: &[&FineLine], line: &Chain, work: &mut Budget) -> Vec<(usize, Stretch)> {
    let count = line.vertices.len();
    let all = fine.iter().enumerate().filter_map(|(k, fine)| Some((k, fine.stretch(line, work)?)));
    let mut all: Vec<(usize, Stretch)> = all.collect();
    let edges = |stretch: &Stretch| (stretch.first..stretch.first + stretch.legs.len()).map(|k| k % count);
    let mut times = vec![0; if all.is_empty() { 0 } else { count }];
    all.iter().flat_map(|(_, stretch)| edges(stretch)).for_each(|k| times[k] += 1);
    all.retain(|(_, stretch)| edges(stretch).all(|k| times[k] == 1));
    all
}

/// The curve of a line with stretches, laid by a rule elsewhere. `None` for a line without any curve.
fn drawn_in_part(coarse: &Base, laid: Option<Vec<Leg>>, stretches: Vec<(usize, Stretch)>) -> Option<Curve> {
    if laid.is_none() && stretches.is_empty() {
        return None;
    }
    let vertices = &coarse.line.vertices;
    let mut legs = laid.unwrap_or_else(|| vertices.iter().map(|&vertex| vec![vertex]).collect());
    let origin_of = |leg: &Leg| if leg.len() == 1 { Origin::Drawn } else { Origin::Laid };
    let mut origins: Vec<Origin> = legs.iter().map(origin_of).collect();
    for (_, Stretch { first, legs: of_stretch }) in stretches {
        for (k, leg) in of_stretch.into_iter().enumerate() {
            let k = (first + k) % vertices.len();
            (legs[k], origins[k]) = (leg, Origin::Fine);
        }
    }
    Some(Curve::of(coarse, legs, &origins))
}
