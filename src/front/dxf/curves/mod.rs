//! Curves between the vertices of a line: layer 1 has the corners of an outline and a few points of its curves, as layers 8,
//! 11 and 14 have of other lines.
//!
//! Receives the lines of a block, joined and unfolded, with its points. Promises each line as the CAD system draws it: along
//! the [`fine`] line of layers 84 to 87 that goes through all of its vertices, else along a curve by the [`rule`] of the
//! system from turn point to turn point, straight where no curve point stands between, as its [`nodes`] say; else as it is.
//! Never leaves a vertex, but for a point that [`gerber`] adds for the sake of a notch, within a hundredth of a millimetre.

mod fine;
mod gerber;
mod hermite;
mod lend;
mod nodes;
mod rule;
mod spikes;
mod spline;

use fine::Fine;
pub(super) use lend::{Size, lend};
pub(super) use nodes::Nodes;
use nodes::{Node, ON};
use rule::{Rule, rule_of};

use super::chain::Chain;
use super::fold::Fold;
use super::layer::{Layer, Named};
use crate::geom::budget::Budget;
use crate::geom::{Point, polyline};
use crate::ir::drawing::Vertex;
use crate::machine::patterns::{Curves as Asked, Dxf};
use crate::source::Span;

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
    /// Where a curve would begin that leaves its chords by more than half a circle over them: no CAD system draws that.
    pub(super) wild: Option<Span>,
}

impl Drafting {
    /// For a file by an author, whose chords lie so far off their curves at the most, mm.
    pub(super) fn of(author: &str, asked: Asked, sagitta: f64) -> Self {
        let (rule, system) = rule_of(author);
        Self { is_on: asked == Asked::Auto, rule, system, sagitta: sagitta.min(CHORDS_OFF), places: 0, wild: None }
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

/// Where a line got its curves from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Origin {
    /// It has none, or is fine itself.
    Drawn,
    /// A line on layers 84 to 87.
    Fine,
    /// The rule of a CAD system.
    Laid,
}

/// A line with its curves.
#[derive(Debug)]
pub(super) struct Curved {
    pub(super) line: Chain,
    pub(super) origin: Origin,
    /// How far the curves leave the chords of the coarse line, mm.
    pub(super) off: f64,
    /// The coarse line, and what became of each of its edges; empty where they are as they were.
    coarse: Vec<Point>,
    legs: Vec<Vec<Point>>,
}

impl Curved {
    fn drawn(line: &Chain) -> Self {
        Self { line: line.clone(), origin: Origin::Drawn, off: 0.0, coarse: Vec::new(), legs: Vec::new() }
    }

    fn of(coarse: &spikes::Smoothed, mut legs: Vec<Leg>, origin: Origin) -> Self {
        let base = &coarse.line;
        let round: Vec<Point> = base.points();
        let way = |k: usize| {
            let head = legs[k].first().filter(|first| (first.at - round[k]).norm() <= ON).is_none().then_some(round[k]);
            let next = round[k + 1];
            head.into_iter().chain(legs[k].iter().map(|vertex| vertex.at)).chain([next]).collect()
        };
        let ways: Vec<Vec<Point>> = (0..round.len() - 1).map(way).collect();
        let off_edge = |(way, edge): (&Vec<Point>, &[Point])| {
            way.iter().map(|&at| polyline::distance_to_segment(at, edge[0], edge[1])).fold(0.0, f64::max)
        };
        let off = ways.iter().zip(round.windows(2)).map(off_edge).fold(0.0, f64::max);
        coarse.put_back(&mut legs);
        let line = Chain { vertices: legs.concat(), is_closed: base.is_closed };
        Self { line, origin, off, coarse: round, legs: ways }
    }

    /// Where a place beside a chord of the coarse line is on the curve: straight up from the chord. Places that lie beside
    /// neither chord nor curve stay, and so do those beside the curve.
    pub(super) fn lifted(&self, at: Point, work: &mut Budget) -> Point {
        let vertices: usize = self.legs.iter().map(Vec::len).sum();
        let near = |way: &Vec<Point>| polyline::distance(at, way) <= Dxf::NOTCH_OFF;
        if !work.spend(vertices) || self.legs.iter().any(near) {
            return at;
        }
        let distance = |k: usize| polyline::distance_to_segment(at, self.coarse[k], self.coarse[k + 1]);
        let nearest = (0..self.legs.len()).map(|k| (distance(k), k)).min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, k)) = nearest.filter(|(distance, _)| *distance <= Dxf::NOTCH_OFF) else { return at };
        let [a, b] = [self.coarse[k], self.coarse[k + 1]];
        let along = (b - a) / (b - a).norm();
        let ahead = |place: Point| (place - a).dot(&along) - (at - a).dot(&along);
        let crossing = self.legs[k].windows(2).find(|pair| ahead(pair[0]) <= 0.0 && ahead(pair[1]) > 0.0);
        crossing.map_or(at, |pair| {
            let [before, behind] = [ahead(pair[0]), ahead(pair[1])];
            pair[0] + (pair[1] - pair[0]) * (before / (before - behind))
        })
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
        // A fine line that a few vertices are on is the control polygon of a line that is fine itself.
        let count = coarse.line.vertices.len();
        let is_fine_itself = own.iter().any(|fine| {
            let held = fine.holds(&coarse.line, work);
            held > 0 && 2 * held <= count
        });
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
            return is_ring.then(|| lay(&Run { line, nodes: &nodes, places: &thrice }, count..2 * count, drafting, &mut legs))?.then_some(legs);
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

/// Whether a vertex is a curve point.
fn is_curve(node: Node) -> bool {
    matches!(node, Node::Smooth | Node::Notched)
}

/// A run of vertices through which one curve goes.
struct Run<'a> {
    line: &'a Chain,
    nodes: &'a [Node],
    /// Its vertices in the line, in order.
    places: &'a [usize],
}

/// Lays a curve through a run, and gives some of its edges what lies on it; whether that could be done.
fn lay(run: &Run, edges: std::ops::Range<usize>, drafting: &mut Drafting, legs: &mut [Leg]) -> bool {
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
                let way: Vec<Point> = points.iter().zip(spans).flat_map(|(&at, span)| [vec![at], span].concat()).collect();
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
            let chord = [at(edge), at(edge + 1)];
            let part = &span[part[0]..part[1]];
            let most = Dxf::CURVE_OFF * (chord[1] - chord[0]).norm() + ON;
            if part.iter().any(|&place| polyline::distance_to_segment(place, chord[0], chord[1]) > most) {
                drafting.wild.get_or_insert(line.vertices[places[edge]].span);
            }
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
