//! Open lines around a cut. If uncut lines run along nearly all of it from outside, they are its outline, and the cut is a seam
//! line by mistake. Examples are an outline in dashes, in sides that do not meet, or in stretches between notches.
//!
//! Lines are examined place by place, regardless of strokes. No cut may lie in between, and a line in another cut is a line of
//! that.

use std::cell::OnceCell;

use super::rectangle;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, Vector, cross, left, polyline, ring};

/// Smallest cut that is examined, mm.
const LEAST_SIZE: f64 = 30.0;
/// Number of places of a cut whose surroundings are examined.
const SAMPLES: usize = 64;
/// Fraction of these places beside which lines must run.
const NEARLY_ALL: f64 = 0.8;
/// Range of the distance of an outline from a line that is cut instead, mm: closer is the same edge, farther is another part.
const OFF: [f64; 2] = [1.5, 50.0];
/// Greatest distance of surrounding lines beyond the box of a cut, mm: longer lines are edges of the cloth.
const BEYOND: f64 = 100.0;
/// Cosine of the greatest angle between the direction to a line and the normal of the cut; then the sine of the greatest angle
/// between line and cut.
const AHEAD: f64 = 0.7;
const ALONG: f64 = 0.5;
/// Spacing of the sampled places of a line, mm.
const SPACING: f64 = 3.0;
/// Distance from a cut within which a place counts as cut, mm.
const CUT: f64 = 0.3;
/// Largest letter, mm; unlike a letter, a dash is straight.
const LETTER: f64 = 15.0;
/// Greatest deviation of a straight stroke, mm.
const STRAIGHT: f64 = 0.1;

/// Place of a line that is not cut, and its edge.
struct Uncut {
    at: Point,
    edge: [Point; 2],
}

/// Edges indexed by their boxes.
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

    /// True if an edge lies between two places.
    fn part(&self, [from, to]: [Point; 2]) -> bool {
        self.near(Extent::between(from, to)).any(|edge| polyline::distance_of_segments([from, to], edge) <= 0.0)
    }
}

/// Indices of the cuts that open lines surround. Ends within `close` mm of each other may be one place. If the work budget runs
/// out, the remaining cuts are included.
pub(super) fn surrounded(drawn: &[Vec<Point>], cuts: &[Vec<Point>], close: f64) -> Vec<usize> {
    let rectangles = rectangle::drawn(drawn, close);
    let is_edge = |stroke: &Vec<Point>| rectangles.iter().any(|one| one.runs_along(stroke, close));
    surrounded_but_by(is_edge, drawn, cuts, close)
}

/// True if open lines surround an outline. Those along the frame of the plot or along another outline count as well.
pub(super) fn is_surrounded(outline: &[Point], drawn: &[Vec<Point>], close: f64) -> bool {
    !surrounded_but_by(|_| false, drawn, &[outline.to_vec()], close).is_empty()
}

/// Surrounded cuts, without regard for some open lines.
fn surrounded_but_by(
    is_edge: impl Fn(&Vec<Point>) -> bool,
    drawn: &[Vec<Point>],
    cuts: &[Vec<Point>],
    close: f64,
) -> Vec<usize> {
    let is_open = |stroke: &&Vec<Point>| {
        let [first, last] = [stroke[0], stroke[stroke.len() - 1]];
        let (width, height) = Extent::of(stroke).size();
        let is_letter = width.max(height) <= LETTER && !is_straight(stroke);
        (last - first).norm() > close && !is_letter
    };
    let open = drawn.iter().filter(|stroke| stroke.len() > 1).filter(is_open).filter(|stroke| !is_edge(stroke));
    let edges: Vec<[Point; 2]> = open.flat_map(|stroke| stroke.windows(2)).map(|ends| [ends[0], ends[1]]).collect();
    if edges.is_empty() {
        return Vec::new();
    }
    let walls = Edges::of(cuts);
    let mut work = Budget::of_lines(drawn.len() + cuts.len());
    let places = edges.into_iter().flat_map(places).filter(|place| !walls.are_at(place.at)).collect::<Vec<_>>();
    let boxes = Boxes::new(places.iter().map(|place| Extent::between(place.at, place.at)).collect());
    let around = Around { places, boxes, walls, cuts, cut_boxes: OnceCell::new() };
    (0..cuts.len()).filter(|&k| around.goes_around(&cuts[k], &mut work)).collect()
}

fn is_straight(stroke: &[Point]) -> bool {
    let far = stroke.iter().max_by(|a, b| (*a - stroke[0]).norm().total_cmp(&(*b - stroke[0]).norm()));
    far.is_some_and(|far| stroke.iter().all(|at| polyline::distance_to_segment(*at, stroke[0], *far) <= STRAIGHT))
}

/// Sampled places of an edge.
fn places(edge: [Point; 2]) -> impl Iterator<Item = Uncut> {
    let way = edge[1] - edge[0];
    let count = (way.norm() / SPACING).ceil().max(1.0) as usize;
    (0..count).map(move |k| Uncut { at: edge[0] + way * ((k as f64 + 0.5) / count as f64), edge })
}

/// Lines of a plot around its cuts: places of the uncut lines, and the edges of the cuts.
struct Around<'a> {
    places: Vec<Uncut>,
    boxes: Boxes,
    walls: Edges,
    cuts: &'a [Vec<Point>],
    /// The boxes of the cuts, built at first use.
    cut_boxes: OnceCell<Boxes>,
}

impl Around<'_> {
    /// True if lines surround a cut, or the work budget is used up.
    fn goes_around(&self, cut: &[Point], work: &mut Budget) -> bool {
        // Few cuts are surrounded by lines at all.
        self.runs_around(cut, false, work) && self.runs_around(cut, true, work)
    }

    /// True if lines surround a cut. Those in other cuts are left out if it `is_strict`.
    fn runs_around(&self, cut: &[Point], is_strict: bool, work: &mut Budget) -> bool {
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
            let outward = -left(way) * turn;
            let found = self.line_beside(at, way, outward, &within);
            let is_its_own = |place| !is_strict || !self.lie_apart([place, at - outward * OFF[0]], work);
            beside += usize::from(found.is_some_and(is_its_own));
        }
        beside as f64 >= NEARLY_ALL * SAMPLES as f64
    }

    /// True if a place lies well inside a cut that another one does not lie in.
    fn lie_apart(&self, [place, other]: [Point; 2], work: &mut Budget) -> bool {
        let boxes = self.cut_boxes.get_or_init(|| Boxes::new(self.cuts.iter().map(|cut| Extent::of(cut)).collect()));
        boxes.at(place).map(|k| &self.cuts[k]).any(|cut| {
            work.spend(3 * cut.len())
                && ring::contains(cut, place)
                && !ring::contains(cut, other)
                && polyline::distance(place, cut) > OFF[0]
        })
    }

    /// Place of a line that runs beside a place of a cut, on its outer side, without another cut in between.
    fn line_beside(&self, at: Point, way: Vector, outward: Vector, within: &Extent) -> Option<Point> {
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
        nearest.map(|(_, place)| place).filter(|&place| !self.walls.part([at + outward * CUT, place]))
    }
}
