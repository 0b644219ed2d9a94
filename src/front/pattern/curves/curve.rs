//! The curve of a line, and the projection of points beside its chords onto the curve.

use super::fine::FineLayers;
use super::leg::Leg;
use super::nodes::ON;
use super::spikes::Base;
use crate::front::pattern::chain::Chain;
use crate::geom::budget::Budget;
use crate::geom::{Point, polyline};
use crate::machine::patterns::Dxf;
use crate::source::Span;

/// Origin of the curve over an edge of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Origin {
    /// The edge as drawn.
    Drawn,
    /// A line on layers 84 to 87.
    Fine,
    /// The rule of a CAD system.
    Laid,
}

/// Curve of a line.
#[derive(Debug)]
pub(in crate::front::pattern) struct Curve {
    pub(in crate::front::pattern) line: Chain,
    /// Largest distance of its fine lines from the chords of the coarse line, mm; `None` without fine lines.
    pub(super) fine: Option<f64>,
    /// Layers of its fine lines.
    pub(super) layers: FineLayers,
    /// Largest distance of the curves by a rule from the chords, mm; `None` without such curves.
    pub(super) laid: Option<f64>,
    /// Start and layer of a nearby fine line that misses some vertices of the line.
    pub(super) missed: Option<(Span, FineLayers)>,
    /// Curve point of the block that marks no vertex.
    pub(super) stray: Option<Span>,
    /// The coarse line, and the curve over each of its edges; empty for a line as drawn.
    coarse: Vec<Point>,
    legs: Vec<Vec<Point>>,
}

impl Curve {
    /// The line itself, for a line without curves.
    pub(super) fn drawn(line: &Chain) -> Self {
        let line = line.clone();
        let layers = FineLayers::default();
        Self { line, fine: None, layers, laid: None, missed: None, stray: None, coarse: Vec::new(), legs: Vec::new() }
    }

    /// Curve over the edges of a coarse line, one leg and its origin per vertex; its spikes are restored.
    pub(super) fn of(coarse: &Base, mut legs: Vec<Leg>, origins: &[Origin]) -> Self {
        let base = &coarse.line;
        let round: Vec<Point> = base.points();
        let way = |k: usize| {
            let is_apart = legs[k].first().is_none_or(|first| (first.at - round[k]).norm() > ON);
            let head = is_apart.then_some(round[k]);
            let next = round[k + 1];
            head.into_iter().chain(legs[k].iter().map(|vertex| vertex.at)).chain([next]).collect()
        };
        let ways: Vec<Vec<Point>> = (0..round.len() - 1).map(way).collect();
        let off_edge = |(way, edge): (&Vec<Point>, &[Point])| {
            way.iter().map(|&at| polyline::distance_to_segment(at, edge[0], edge[1])).fold(0.0, f64::max)
        };
        let off: Vec<f64> = ways.iter().zip(round.windows(2)).map(off_edge).collect();
        let off_of = |wanted: Origin| {
            let of_origin = off.iter().zip(origins).filter(|(_, origin)| **origin == wanted);
            of_origin.map(|(off, _)| *off).reduce(f64::max)
        };
        let (fine, laid) = (off_of(Origin::Fine), off_of(Origin::Laid));
        coarse.put_back(&mut legs);
        let line = Chain { vertices: legs.concat(), is_closed: base.is_closed };
        let layers = FineLayers::default();
        Self { line, fine, layers, laid, missed: None, stray: None, coarse: round, legs: ways }
    }

    /// Projects a point beside a chord of the coarse line perpendicularly onto the curve. Points elsewhere, and points already
    /// near the curve, stay.
    pub(in crate::front::pattern) fn lifted(&self, at: Point, work: &mut Budget) -> Point {
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
