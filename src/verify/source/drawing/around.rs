//! Open lines around a cut: where they run along nearly all of it from outside, and nobody cuts them, they are its outline,
//! and a seam line is cut. An outline in dashes, in sides that do not meet or in stretches between notches is such.
//!
//! The lines are looked at place by place, whatever stroke these are of. Nothing that is cut may stand between.

use super::rectangle;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, Vector, cross, left, polyline, ring};

/// Smallest cut that is looked at, mm.
const LEAST_SIZE: f64 = 30.0;
/// Places of a cut from which its surroundings are looked at.
const SAMPLES: usize = 64;
/// Share of them beside which the lines must run.
const NEARLY_ALL: f64 = 0.8;
/// Distance of an outline from a line that is cut for it, mm: less is the same edge, more is another part.
const OFF: [f64; 2] = [1.5, 50.0];
/// How far beyond the box of a cut the lines around it go, mm: longer ones are the edges of the cloth.
const BEYOND: f64 = 100.0;
/// Cosine of the greatest angle between the way to a line and the square to the cut, and the sine of that between them.
const AHEAD: f64 = 0.7;
const ALONG: f64 = 0.5;
/// Places of a line are so far from each other, mm.
const SPACING: f64 = 3.0;
/// How near to a cut the places of a line are that is cut, mm.
const CUT: f64 = 0.3;
/// Largest letter, mm; a dash is straight.
const LETTER: f64 = 15.0;
/// Farthest that a place of a straight stroke lies off it, mm.
const STRAIGHT: f64 = 0.1;

/// A place of a line that is not cut, and the edge that it is of.
struct Uncut {
    at: Point,
    edge: [Point; 2],
}

/// Edges by their boxes.
struct Edges {
    all: Vec<[Point; 2]>,
    boxes: Boxes,
}

impl Edges {
    fn of(lines: &[Vec<Point>]) -> Self {
        let all: Vec<[Point; 2]> =
            lines.iter().flat_map(|line| line.windows(2)).map(|ends| [ends[0], ends[1]]).collect();
        let boxes = Boxes::new(all.iter().map(|[a, b]| Extent::between(*a, *b)).collect());
        Self { all, boxes }
    }

    fn near(&self, extent: Extent) -> impl Iterator<Item = [Point; 2]> + '_ {
        self.boxes.near(extent).map(|k| self.all[k])
    }

    fn are_at(&self, at: Point) -> bool {
        self.near(Extent::between(at, at).grown(CUT)).any(|[a, b]| polyline::distance_to_segment(at, a, b) <= CUT)
    }

    /// Whether one of them stands between two places.
    fn part(&self, [from, to]: [Point; 2]) -> bool {
        self.near(Extent::between(from, to)).any(|edge| polyline::distance_of_segments([from, to], edge) <= 0.0)
    }
}

/// The cuts that open lines go around, given by their indices. Ends within `close` of each other, mm, may be one place; a cut
/// that the search does not come to is among them.
pub(super) fn surrounded(drawn: &[Vec<Point>], cuts: &[Vec<Point>], close: f64) -> Vec<usize> {
    let rectangles = rectangle::drawn(drawn, close);
    let is_open = |stroke: &&Vec<Point>| {
        let [first, last] = [stroke[0], stroke[stroke.len() - 1]];
        let (width, height) = Extent::of(stroke).size();
        let is_letter = width.max(height) <= LETTER && !is_straight(stroke);
        (last - first).norm() > close && !is_letter
    };
    let open: Vec<&Vec<Point>> = drawn.iter().filter(|stroke| stroke.len() > 1).filter(is_open).collect();
    let open = open.into_iter().filter(|stroke| !rectangles.iter().any(|one| one.runs_along(stroke, close)));
    let edges: Vec<[Point; 2]> = open.flat_map(|stroke| stroke.windows(2)).map(|ends| [ends[0], ends[1]]).collect();
    if edges.is_empty() {
        return Vec::new();
    }
    let walls = Edges::of(cuts);
    let mut work = Budget::of_lines(drawn.len() + cuts.len());
    let places = edges.into_iter().flat_map(places).filter(|place| !walls.are_at(place.at)).collect::<Vec<_>>();
    let boxes = Boxes::new(places.iter().map(|place| Extent::between(place.at, place.at)).collect());
    let around = Around { places, boxes, walls };
    (0..cuts.len()).filter(|&k| around.goes_around(&cuts[k], &mut work)).collect()
}

fn is_straight(stroke: &[Point]) -> bool {
    let far = stroke.iter().max_by(|a, b| (*a - stroke[0]).norm().total_cmp(&(*b - stroke[0]).norm()));
    far.is_some_and(|far| stroke.iter().all(|at| polyline::distance_to_segment(*at, stroke[0], *far) <= STRAIGHT))
}

/// Places of an edge.
fn places(edge: [Point; 2]) -> impl Iterator<Item = Uncut> {
    let way = edge[1] - edge[0];
    let count = (way.norm() / SPACING).ceil().max(1.0) as usize;
    (0..count).map(move |k| Uncut { at: edge[0] + way * ((k as f64 + 0.5) / count as f64), edge })
}

/// Lines of a plot about its cuts: places of those that are not cut, and the edges that are.
struct Around {
    places: Vec<Uncut>,
    boxes: Boxes,
    walls: Edges,
}

impl Around {
    /// Whether lines go around a cut, or no work is left to find out.
    fn goes_around(&self, cut: &[Point], work: &mut Budget) -> bool {
        let extent = Extent::of(cut);
        let (width, height) = extent.size();
        let is_ring = cut.len() > 3 && cut[0] == cut[cut.len() - 1] && width.max(height) >= LEAST_SIZE;
        if !is_ring || self.boxes.near(extent.grown(OFF[1])).next().is_none() {
            return false;
        }
        let within = extent.grown(BEYOND);
        let turn = ring::area(cut).signum();
        let stations = polyline::stations(cut);
        let length = stations[stations.len() - 1];
        let mut beside = 0;
        for k in 0..SAMPLES {
            if ((beside + SAMPLES - k) as f64) < NEARLY_ALL * SAMPLES as f64 {
                return false;
            }
            let station = length * (k as f64 + 0.5) / SAMPLES as f64;
            let next = stations.partition_point(|&at| at < station).clamp(1, cut.len() - 1);
            let Some(way) = polyline::direction(cut[next - 1], cut[next]) else { continue };
            let at = polyline::place(cut, &stations, station);
            if !work.spend(self.boxes.cost_near(&Extent::between(at, at).grown(OFF[1]))) {
                return true;
            }
            beside += usize::from(self.is_beside(at, way, -left(way) * turn, &within));
        }
        beside as f64 >= NEARLY_ALL * SAMPLES as f64
    }

    /// Whether a line runs beside a place of a cut, outside, with nothing that is cut between them.
    fn is_beside(&self, at: Point, way: Vector, outward: Vector, within: &Extent) -> bool {
        let near = self.boxes.near(Extent::between(at, at).grown(OFF[1])).map(|k| &self.places[k]);
        let ahead = near.filter_map(|place| {
            let (off, edge) = (place.at - at, place.edge[1] - place.edge[0]);
            let distance = off.norm();
            let is_ahead = (OFF[0]..=OFF[1]).contains(&distance)
                && off.dot(&outward) >= AHEAD * distance
                && cross(way, edge).abs() <= ALONG * edge.norm()
                && place.edge.iter().all(|&end| within.holds(end));
            is_ahead.then_some((distance, place.at))
        });
        let nearest = ahead.min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.is_some_and(|(_, place)| !self.walls.part([at + outward * CUT, place]))
    }
}
