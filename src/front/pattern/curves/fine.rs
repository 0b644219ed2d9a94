//! Fine lines: layers 84 to 87 contain the curves of layers 1, 8, 11 and 14 in small chords. Lines are paired by their
//! geometry, because CAD systems pair the layers differently.

use super::leg::Leg;
use super::nodes::ON;
use crate::front::pattern::chain::Chain;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, polyline};
use crate::source::Span;

/// Maximum number of start stations tried at one vertex. A fine line passes a vertex once, or twice at a seam.
const MOST_STARTS: usize = 4;

/// A fine line with an index of its edges.
#[derive(Debug, Clone)]
pub(super) struct FineLine {
    pub(super) layer: u16,
    chain: Chain,
    /// Points of the line, with the first repeated at the end; an open line is closed by a chord.
    points: Vec<Point>,
    stations: Vec<f64>,
    edges: Boxes,
    extent: Extent,
}

/// Start of a coarse line on a fine one, and its direction there.
#[derive(Debug, Clone, Copy)]
struct Start {
    station: f64,
    is_forward: bool,
}

impl FineLine {
    pub(super) fn of(layer: u16, chain: Chain) -> Self {
        let mut points: Vec<Point> = chain.vertices.iter().map(|vertex| vertex.at).collect();
        points.push(points[0]);
        let edges = points.windows(2).map(|edge| Extent::between(edge[0], edge[1]).grown(ON)).collect();
        let (stations, extent) = (polyline::stations(&points), Extent::of(&points).grown(ON));
        Self { layer, chain, stations, edges: Boxes::new(edges), extent, points }
    }

    /// Location of its start in the file.
    pub(super) fn span(&self) -> Span {
        self.chain.vertices[0].span
    }

    /// True if its bounding box overlaps that of a line.
    pub(super) fn lies_about(&self, line: &Chain) -> bool {
        self.extent.overlaps(&Extent::of(&line.points()))
    }

    fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// Stations at which the line passes a point, mm.
    fn stations_of(&self, at: Point, work: &mut Budget) -> Vec<f64> {
        if !self.extent.holds(at) || !work.spend(self.edges.cost_at(at)) {
            return Vec::new();
        }
        let on = |k: usize| {
            let [a, b] = [self.points[k], self.points[k + 1]];
            let is_on = polyline::distance_to_segment(at, a, b) <= ON;
            is_on.then(|| self.stations[k] + polyline::foot(at, a, b) * (b - a).norm())
        };
        let mut stations: Vec<f64> = self.edges.at(at).filter_map(on).collect();
        stations.sort_by(f64::total_cmp);
        stations.dedup_by(|next, before| *next - *before <= ON);
        stations
    }

    /// True if one of its vertices lies at a point.
    pub(super) fn turns_at(&self, at: Point, work: &mut Budget) -> bool {
        if !self.extent.holds(at) || !work.spend(self.edges.cost_at(at)) {
            return false;
        }
        self.edges.at(at).any(|k| self.points[k..=k + 1].iter().any(|end| (end - at).norm() <= ON))
    }

    /// Legs from each vertex of a coarse line to the next. `None` unless the fine line passes all of them in order, exactly
    /// once.
    pub(super) fn legs(&self, coarse: &Chain, work: &mut Budget) -> Option<Vec<Leg>> {
        let Chain { vertices, is_closed } = coarse;
        if self.chain.vertices.len() <= vertices.len() {
            return None;
        }
        let [first, last] = [vertices[0].at, vertices[vertices.len() - 1].at];
        if *is_closed {
            let starts = self.stations_of(first, work).into_iter().take(MOST_STARTS);
            let starts = starts.flat_map(|station| [true, false].map(|is_forward| Start { station, is_forward }));
            return starts.into_iter().find_map(|start| Some(self.parted(start, &self.ways(coarse, start, work)?)));
        }
        let ends = [self.points[0], self.points[self.points.len() - 2]];
        let meets = |[a, b]: [Point; 2]| (a - first).norm() <= ON && (b - last).norm() <= ON;
        let is_forward = meets(ends);
        if self.chain.is_closed || !is_forward && !meets([ends[1], ends[0]]) {
            return None;
        }
        let start =
            Start { station: if is_forward { 0.0 } else { self.stations[self.stations.len() - 2] }, is_forward };
        let ways = self.ways(coarse, start, work)?;
        Some(self.parted(start, &ways))
    }

    /// Lengths along the fine line from the first vertex of a coarse line to each vertex, mm. `None` if a vertex lies off the
    /// fine line or the order differs.
    fn ways(&self, coarse: &Chain, start: Start, work: &mut Budget) -> Option<Vec<f64>> {
        let length = self.length();
        let (mut at, mut way, mut ways) = (start.station, 0.0, vec![0.0]);
        let ahead = |from: f64, to: f64| {
            let way = (if start.is_forward { to - from } else { from - to }).rem_euclid(length);
            // A step back results from rounding and has no length.
            if way > length - ON { 0.0 } else { way }
        };
        for vertex in &coarse.vertices[1..] {
            let stations = self.stations_of(vertex.at, work).into_iter();
            let (step, next) = stations.map(|next| (ahead(at, next), next)).min_by(|a, b| a.0.total_cmp(&b.0))?;
            (at, way) = (next, way + step);
            if way > length {
                return None;
            }
            ways.push(way);
        }
        let is_round = !coarse.is_closed || (way + ahead(at, start.station) - length).abs() <= ON;
        is_round.then_some(ways)
    }

    /// The vertices in the direction of the coarse line, split at its vertices.
    fn parted(&self, start: Start, ways: &[f64]) -> Vec<Leg> {
        let length = self.length();
        let way = |k: usize| {
            let way =
                if start.is_forward { self.stations[k] - start.station } else { start.station - self.stations[k] };
            (way + ON).rem_euclid(length) - ON
        };
        let mut order: Vec<(f64, usize)> = (0..self.chain.vertices.len()).map(|k| (way(k), k)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut legs: Vec<Leg> = ways.iter().map(|_| Leg::new()).collect();
        let mut leg = 0;
        for (way, k) in order {
            while ways.get(leg + 1).is_some_and(|next| next - ON <= way) {
                leg += 1;
            }
            legs[leg].push(self.chain.vertices[k]);
        }
        legs
    }
}
