//! Fine lines: layers 84 to 87 contain the curves of layers 1, 8, 11 and 14 in small chords. Lines are paired by their
//! geometry, because CAD systems pair the layers differently. Some systems write only the curved parts of a line: a [`Stretch`]
//! is such a part, from one vertex of the line to another.

use std::fmt;

use super::leg::Leg;
use super::nodes::ON;
use crate::front::pattern::chain::Chain;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, polyline};
use crate::machine::patterns::Dxf;
use crate::source::Span;

/// Maximum number of start stations tried at one vertex. A fine line passes a vertex once, or twice at a seam.
const MOST_STARTS: usize = 4;

/// Distance from a fine line within which the vertices of a stretch are on it, mm.
const BESIDE: f64 = Dxf::POINT_OFF;

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

/// A part of a coarse line that a fine line draws anew.
#[derive(Debug)]
pub(super) struct Stretch {
    /// Index of its first vertex in the coarse line.
    pub(super) first: usize,
    /// Legs from each of its vertices to the next.
    pub(super) legs: Vec<Leg>,
}

/// A set of the layers of fine lines: a bit for each, from [`FineLayers::FIRST`] upwards.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::front::pattern) struct FineLayers(u8);

impl FineLayers {
    const FIRST: u16 = 84;
    const COUNT: u16 = 4;

    /// The set of one layer.
    pub(super) fn of(layer: u16) -> Self {
        Self(1 << layer.saturating_sub(Self::FIRST).min(Self::COUNT - 1))
    }

    /// Adds the layers of another set.
    pub(super) fn join(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

impl fmt::Display for FineLayers {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let layers = (0..Self::COUNT).filter(|bit| self.0 >> bit & 1 > 0).map(|bit| (Self::FIRST + bit).to_string());
        let layers: Vec<String> = layers.collect();
        write!(f, "layer{} {}", if layers.len() == 1 { "" } else { "s" }, layers.join(", "))
    }
}

impl FineLine {
    pub(super) fn of(layer: u16, chain: Chain) -> Self {
        let mut points: Vec<Point> = chain.vertices.iter().map(|vertex| vertex.at).collect();
        points.push(points[0]);
        let edges = points.windows(2).map(|edge| Extent::between(edge[0], edge[1]).grown(BESIDE)).collect();
        let (stations, extent) = (polyline::stations(&points), Extent::of(&points).grown(BESIDE));
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

    /// Stations at which the line passes within `reach` of a point, mm.
    fn stations_of(&self, at: Point, reach: f64, work: &mut Budget) -> Vec<f64> {
        if !self.extent.holds(at) || !work.spend(self.edges.cost_at(at)) {
            return Vec::new();
        }
        let on = |k: usize| {
            let [a, b] = [self.points[k], self.points[k + 1]];
            let is_on = polyline::distance_to_segment(at, a, b) <= reach;
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

    pub(super) fn is_open(&self) -> bool {
        !self.chain.is_closed
    }

    /// True if it has more vertices than a line.
    pub(super) fn is_finer_than(&self, vertices: usize) -> bool {
        self.chain.vertices.len() > vertices
    }

    /// Legs from each vertex of a coarse line to the next. `None` unless the fine line passes all of them in order, exactly
    /// once.
    pub(super) fn legs(&self, coarse: &Chain, work: &mut Budget) -> Option<Vec<Leg>> {
        let places: Vec<Point> = coarse.vertices.iter().map(|vertex| vertex.at).collect();
        if !coarse.is_closed {
            return self.legs_from_end_to_end(&places, ON, work);
        }
        let starts = self.stations_of(places[0], ON, work).into_iter().take(MOST_STARTS);
        let starts = starts.flat_map(|station| [true, false].map(|is_forward| Start { station, is_forward }));
        let round = |start: Start| {
            let (ways, end) = self.ways(&places, start, ON, work)?;
            let way = ways[ways.len() - 1] + self.ahead(start, [end, start.station], ON);
            ((way - self.length()).abs() <= ON).then(|| self.parted(start, &ways))
        };
        starts.into_iter().find_map(round)
    }

    /// Legs along an open fine line from one of its ends to the other.
    fn legs_from_end_to_end(&self, places: &[Point], reach: f64, work: &mut Budget) -> Option<Vec<Leg>> {
        let [first, last] = self.ends()?;
        let meets =
            |[a, b]: [Point; 2]| (a - places[0]).norm() <= reach && (b - places[places.len() - 1]).norm() <= reach;
        let is_forward = meets([first, last]);
        if !is_forward && !meets([last, first]) {
            return None;
        }
        let station = if is_forward { 0.0 } else { self.stations[self.stations.len() - 2] };
        let start = Start { station, is_forward };
        let (ways, _) = self.ways(places, start, reach, work)?;
        Some(self.parted(start, &ways))
    }

    /// Both ends of an open line.
    fn ends(&self) -> Option<[Point; 2]> {
        (!self.chain.is_closed).then(|| [self.points[0], self.points[self.points.len() - 2]])
    }

    /// The part of a coarse line that an open fine line draws from end to end with more points: the one with the most
    /// vertices, if a closed line has two.
    pub(super) fn stretch(&self, coarse: &Chain, work: &mut Budget) -> Option<Stretch> {
        let ends = self.ends()?;
        let count = coarse.vertices.len();
        if !work.spend(count) {
            return None;
        }
        let vertex = |k: usize| coarse.vertices[k % count];
        let meeting = |end: Point| (0..count).filter(move |&k| (vertex(k).at - end).norm() <= BESIDE).take(MOST_STARTS);
        let pairs = meeting(ends[0]).flat_map(|a| meeting(ends[1]).flat_map(move |b| [[a, b], [b, a]]));
        let ways = pairs.filter(|[first, last]| first < last || coarse.is_closed && first > last);
        let mut best: Option<Stretch> = None;
        for [first, last] in ways {
            let last = if last < first { last + count } else { last };
            let places: Vec<Point> = (first..=last).map(|k| vertex(k).at).collect();
            if !self.is_finer_than(places.len())
                || best.as_ref().is_some_and(|best| best.legs.len() + 1 >= places.len())
            {
                continue;
            }
            let Some(mut legs) = self.legs_from_end_to_end(&places, BESIDE, work) else { continue };
            // The line keeps its own vertices at both ends.
            legs.pop();
            legs[0][0] = vertex(first);
            if legs.len() > 1 || self.bows_from_edge(coarse, first, work) {
                best = Some(Stretch { first, legs });
            }
        }
        best
    }

    /// True if its middle lies nearer to an edge of a coarse line than to all others. The control polygon of a curve may end
    /// at the vertices of a straight edge, but is nearer to the curve.
    fn bows_from_edge(&self, coarse: &Chain, edge: usize, work: &mut Budget) -> bool {
        let points = coarse.points();
        let off = |k: usize, at: Point| polyline::distance_to_segment(at, points[k], points[k + 1]);
        let own = self.chain.vertices.iter().map(|vertex| vertex.at);
        let farthest = own.max_by(|a, b| off(edge, *a).total_cmp(&off(edge, *b)));
        farthest.is_some_and(|at| {
            let is_nearest = |k: usize| k == edge || off(k, at) >= off(edge, at);
            work.spend(points.len()) && (0..points.len() - 1).all(is_nearest)
        })
    }

    /// Length along the line from one station to another, mm.
    fn ahead(&self, start: Start, [from, to]: [f64; 2], reach: f64) -> f64 {
        let way = (if start.is_forward { to - from } else { from - to }).rem_euclid(self.length());
        // A step back results from rounding and has no length.
        if way > self.length() - reach { 0.0 } else { way }
    }

    /// Lengths along the fine line from the first of some places to each, mm, and the station of the last. `None` if a place
    /// lies off the fine line or the order differs.
    fn ways(&self, places: &[Point], start: Start, reach: f64, work: &mut Budget) -> Option<(Vec<f64>, f64)> {
        let (mut at, mut way, mut ways) = (start.station, 0.0, vec![0.0]);
        for &place in &places[1..] {
            let stations = self.stations_of(place, reach, work).into_iter();
            let steps = stations.map(|next| (self.ahead(start, [at, next], reach), next));
            let (step, next) = steps.min_by(|a, b| a.0.total_cmp(&b.0))?;
            (at, way) = (next, way + step);
            if way > self.length() {
                return None;
            }
            ways.push(way);
        }
        Some((ways, at))
    }

    /// True if it lies on a coarse line with all of its vertices.
    pub(super) fn goes_along(&self, coarse: &Chain, work: &mut Budget) -> bool {
        let points = coarse.points();
        let mut own = self.chain.vertices.iter();
        own.all(|vertex| work.spend(points.len()) && polyline::distance(vertex.at, &points) <= BESIDE)
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
