//! Stretches: parts of coarse lines that open fine lines draw anew. Coarse lines are not joined: edge after edge is followed
//! from the place where a fine line begins to the place where it ends.

use super::again::walk;
use super::fold::Fold;
use super::lines::{MEETS, Path};
use super::lookup::Lookup;
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline};
use crate::machine::patterns::Dxf;

/// Distance from a fine line within which the vertices of a stretch are on it, mm.
const BESIDE: f64 = Dxf::POINT_OFF;
/// Number of sampled places of a curve.
const SAMPLES: usize = 64;

/// Coarse lines with stretches.
#[derive(Debug, Default)]
pub(super) struct Parted {
    /// Fine lines of the stretches, which begin and end at vertices of the coarse lines.
    pub(super) fine: Vec<Path>,
    /// Runs of other edges.
    pub(super) rest: Vec<Path>,
    /// Coarse edges of the stretches.
    pub(super) chords: Vec<[Point; 2]>,
}

/// A coarse edge: its line, its number there, and its ends.
type Edge = (usize, usize, [Point; 2]);

/// Fine lines in walking order, with the places along them.
struct Walk {
    paths: Vec<Path>,
    points: Vec<Point>,
    stations: Vec<f64>,
    boxes: Boxes,
    has_curves: bool,
}

/// Edges of a stretch, and the vertices at both of its ends.
struct Stretch {
    edges: Vec<usize>,
    ends: [Point; 2],
}

/// Coarse lines, split where groups of fine lines draw stretches of them; `None` without any stretch. Two stretches that share
/// an edge are left out.
pub(super) fn parted<'p>(
    fine: impl Iterator<Item = &'p Vec<Path>>,
    coarse: &[Path],
    fold: Option<Fold>,
) -> Option<Parted> {
    let of_path = |(k, path): (usize, &Path)| -> Vec<Edge> {
        let straight = (0..path.curves.len()).filter(|&edge| path.curves[edge].is_none());
        straight.map(|edge| (k, edge, path.edge(edge))).collect()
    };
    let edges: Vec<Edge> = coarse.iter().enumerate().flat_map(of_path).collect();
    let ends = Lookup::of(edges.iter().flat_map(|edge| edge.2), BESIDE);
    let coarse_edges = Edges { all: edges, ends, fold };
    let found = fine.filter_map(|paths| {
        let walk = Walk::of(paths)?;
        let stretch = coarse_edges.along(&walk)?;
        Some((walk, stretch))
    });
    let found: Vec<(Walk, Stretch)> = found.collect();
    let mut times = vec![0; coarse_edges.all.len()];
    found.iter().flat_map(|(_, stretch)| &stretch.edges).for_each(|&edge| times[edge] += 1);
    let mut parted = Parted::default();
    let mut is_gone: Vec<Vec<bool>> = coarse.iter().map(|path| vec![false; path.curves.len()]).collect();
    for (walk, stretch) in found.into_iter().filter(|(_, stretch)| stretch.edges.iter().all(|&edge| times[edge] == 1)) {
        for (path, edge, ends) in stretch.edges.iter().map(|&edge| coarse_edges.all[edge]) {
            is_gone[path][edge] = true;
            parted.chords.push(ends);
        }
        parted.fine.extend(walk.between(stretch.ends));
    }
    parted.rest = coarse.iter().zip(&is_gone).flat_map(|(path, is_gone)| path.without(is_gone)).collect();
    (!parted.fine.is_empty()).then_some(parted)
}

/// Straight edges of coarse lines.
struct Edges {
    all: Vec<Edge>,
    /// Both ends of each edge, one after the other.
    ends: Lookup,
    fold: Option<Fold>,
}

impl Edges {
    /// Edges from the start of a walk to its end, with fewer vertices than the walk; the way with the most vertices.
    fn along(&self, walk: &Walk) -> Option<Stretch> {
        let [first, last] = [walk.points[0], walk.points[walk.points.len() - 1]];
        let place = |end: usize| self.all[end / 2].2[end % 2];
        let start =
            place(self.ends.near(first).min_by(|a, b| off(place(*a), first).total_cmp(&off(place(*b), first)))?);
        let (mut at, mut station, mut edges) = (start, 0.0, Vec::new());
        while (at - last).norm() > BESIDE {
            let steps = self.ends.near(at).flat_map(|end| {
                let ahead = walk.stations_of(place(end ^ 1)).into_iter().filter(move |next| *next > station + BESIDE);
                ahead.map(move |next| (next, end))
            });
            let (next, end) = steps.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
            (at, station) = (place(end ^ 1), next);
            edges.push(end / 2);
        }
        let is_finer = walk.has_curves || walk.points.len() > edges.len() + 1;
        let is_whole = station >= walk.length() - BESIDE;
        let is_over_its_edge = match edges[..] {
            [] => false,
            [edge] => self.is_nearest(edge, walk),
            _ => true,
        };
        (is_finer && is_whole && is_over_its_edge).then_some(Stretch { edges, ends: [start, at] })
    }

    /// True if a fine line over a single edge is nearer to that edge than to all others, so that it is no control polygon of a
    /// curve between the ends of a straight edge. One that ends at a fold goes on there.
    fn is_nearest(&self, edge: usize, walk: &Walk) -> bool {
        let is_on_fold = |at: &Point| self.fold.is_some_and(|fold| fold.off(*at).abs() <= MEETS);
        if self.all[edge].2.iter().any(is_on_fold) {
            return true;
        }
        let off = |k: usize, at: Point| polyline::distance_to_segment(at, self.all[k].2[0], self.all[k].2[1]);
        let farthest = walk.points.iter().max_by(|a, b| off(edge, **a).total_cmp(&off(edge, **b)));
        let is_cut = |k: &usize| !self.fold.is_some_and(|fold| fold.has_edge(self.all[*k].2, None));
        farthest.is_some_and(|&at| (0..self.all.len()).filter(is_cut).all(|k| off(k, at) >= off(edge, at)))
    }
}

fn off(a: Point, b: Point) -> f64 {
    (a - b).norm()
}

impl Walk {
    /// The walk along fine lines; `None` for a ring, or if they branch.
    fn of(paths: &[Path]) -> Option<Self> {
        let paths = walk(paths)?;
        let mut points: Vec<Point> = Vec::new();
        for path in &paths {
            // Lines that meet have one vertex there.
            points.extend(path.points.first().filter(|_| points.is_empty()));
            for (k, curve) in path.curves.iter().enumerate() {
                let inner = (1..SAMPLES).map(|i| i as f64 / SAMPLES as f64);
                points.extend(curve.iter().flat_map(|round| inner.clone().map(|share| round.at(share))));
                points.push(path.edge(k)[1]);
            }
        }
        let is_ring = off(*points.first()?, *points.last()?) <= MEETS;
        let edges = points.windows(2).map(|edge| Extent::between(edge[0], edge[1]).grown(BESIDE)).collect();
        let has_curves = paths.iter().any(|path| path.curves.iter().any(Option::is_some));
        let stations = polyline::stations(&points);
        (!is_ring).then(|| Self { paths, stations, boxes: Boxes::new(edges), has_curves, points })
    }

    fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// Stations at which it passes a place.
    fn stations_of(&self, at: Point) -> Vec<f64> {
        let edge = |k: usize| [self.points[k], self.points[k + 1]];
        let on = self.boxes.at(at).filter(|&k| polyline::distance_to_segment(at, edge(k)[0], edge(k)[1]) <= BESIDE);
        on.map(|k| self.stations[k] + polyline::foot(at, edge(k)[0], edge(k)[1]) * off(edge(k)[0], edge(k)[1]))
            .collect()
    }

    /// Its lines, moved at both ends to vertices of the coarse line.
    fn between(self, [start, end]: [Point; 2]) -> Vec<Path> {
        let mut paths = self.paths;
        if let Some(at) =
            paths.first_mut().filter(|path| path.curves[0].is_none()).and_then(|path| path.points.first_mut())
        {
            *at = start;
        }
        let last = paths.last_mut().filter(|path| path.curves[path.curves.len() - 1].is_none());
        if let Some(at) = last.and_then(|path| path.points.last_mut()) {
            *at = end;
        }
        paths
    }
}

impl Path {
    /// Runs of the edges that are left.
    fn without(&self, is_gone: &[bool]) -> Vec<Self> {
        let Some(first) = is_gone.iter().position(|&is_gone| is_gone) else { return vec![self.clone()] };
        let count = self.curves.len();
        // A ring is followed from the first edge that is gone.
        let order: Vec<usize> =
            if self.is_closed { (0..count).map(|k| (first + k) % count).collect() } else { (0..count).collect() };
        let runs = order.chunk_by(|&a, &b| is_gone[a] == is_gone[b]).filter(|run| !is_gone[run[0]]);
        let of_run = |run: &[usize]| {
            let points = run.iter().map(|&k| self.points[k]).chain([self.edge(run[run.len() - 1])[1]]).collect();
            let curves = run.iter().map(|&k| self.curves[k]).collect();
            Self { points, curves, is_closed: false, ..self.clone() }
        };
        runs.map(of_run).collect()
    }
}
