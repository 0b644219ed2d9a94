//! Regions of the plane, each bounded by the rings of one owner under the even-odd rule, and the clear distance along a ray
//! before it enters a region. Every query visits nearby edges only, so querying everywhere is nearly linear.

use std::borrow::Cow;
use std::ops::RangeInclusive;

use rayon::prelude::*;

use super::boxes::Boxes;
use super::slots::Slots;
use super::{Extent, Point, Vector, cross, polyline};

/// Minimum average number of edges per band of a region.
const EDGES_A_BAND: usize = 4;
/// Maximum average number of bands per edge. Long edges side by side would otherwise fill every band.
const BANDS_AN_EDGE: f64 = 4.0;
/// Distance below which two places are equal, mm: rounding of coordinates of some metres.
const SAME_EPSILON: f64 = 1e-9;
/// Maximum depth in a strip that still counts as its edge, in widths of the strip.
const STRIP_SHARE: f64 = 0.25;
/// Minimum cosine between the two edges of a strip (10 degrees). It excludes the edges at a corner, where one ends where the
/// other begins.
const PARALLEL: f64 = 0.985;
/// Sampling between two crossings, to see if a ray lies well inside: minimum number of samples, and maximum distance between
/// them, mm, at most the depth of the corner of a small notch.
const PROBES: f64 = 4.0;
const PROBE_STEP: f64 = 0.25;

/// An index of regions.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Regions<'a> {
    /// The region of each owner, in the given order.
    owners: Vec<Region<'a>>,
    /// Index of their boxes.
    boxes: Boxes,
}

/// A straight line segment, given by its direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Start point.
    pub from: Point,
    /// Direction, a unit vector.
    pub along: Vector,
    /// Its length, mm.
    pub reach: f64,
}

/// Length of a ray before it enters a region, mm; infinite when it enters none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Room {
    /// Length before it enters the region of its own owner.
    pub own: f64,
    /// Length before it enters the region of another owner.
    pub other: f64,
}

impl Room {
    /// Length before it enters any region, mm.
    pub fn least(self) -> f64 {
        self.own.min(self.other)
    }

    /// Remaining room after the first `way` mm.
    #[must_use]
    pub fn without(self, way: f64) -> Self {
        let [own, other] = [self.own, self.other].map(|room| (room - way).max(0.0));
        Self { own, other }
    }
}

/// A straight piece of a ring.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Edge {
    from: Point,
    to: Point,
}

/// The region of one owner.
#[derive(Debug, Clone, PartialEq)]
struct Region<'a> {
    owner: u32,
    extent: Extent,
    /// The rings, one after the other; each ends with its first point. Nearly all regions have a single ring in this form
    /// already.
    points: Cow<'a, [Point]>,
    bands: Bands,
}

/// Edges by horizontal band, so that a ray along X only visits the edges that it can meet.
#[derive(Debug, Clone, PartialEq)]
struct Bands {
    bottom: f64,
    height: f64,
    count: usize,
    /// Edges of each band, by the index of their first point.
    edges: Slots,
}

impl Bands {
    /// Sorts the edges into the bands of the box. `ends` holds the last index of each ring; no edge starts there.
    fn new(points: &[Point], ends: &[usize], extent: Extent) -> Self {
        let edges = points.len() - ends.len();
        let count = (edges / EDGES_A_BAND).max(1);
        let rise: f64 = points.windows(2).map(|ends| (ends[1].y - ends[0].y).abs()).sum();
        let least = rise / (BANDS_AN_EDGE * edges as f64);
        let height = (extent.size().1 / count as f64).max(least).max(f64::MIN_POSITIVE);
        let mut bands = Self { bottom: extent.min.y, height, count, edges: Slots::default() };
        bands.edges = Slots::new(count, |see| {
            let mut first = 0;
            for &end in ends {
                for (ends, i) in points[first..=end].windows(2).zip(first as u32..) {
                    bands.met(ends[0].y.min(ends[1].y), ends[0].y.max(ends[1].y)).for_each(|band| see(band, i));
                }
                first = end + 1;
            }
        });
        bands
    }

    /// The bands between two heights, clamped to the box.
    fn met(&self, low: f64, high: f64) -> RangeInclusive<usize> {
        let [low, high] =
            [low, high].map(|y| (((y - self.bottom) / self.height).max(0.0) as usize).min(self.count - 1));
        low..=high
    }

    /// Edges of the bands between two heights; some appear more than once.
    fn near(&self, low: f64, high: f64) -> &[u32] {
        self.edges.of_all(self.met(low, high))
    }
}

impl<'a> Regions<'a> {
    /// The regions of `owners`, in this order, each bounded by the rings from `rings`. Rings may repeat their first point or
    /// not. They are requested one owner at a time, so that not all are in memory at once.
    pub fn new(owners: impl IntoIterator<Item = u32>, rings: impl Fn(u32) -> Vec<Cow<'a, [Point]>> + Sync) -> Self {
        let owners: Vec<u32> = owners.into_iter().collect();
        let owners: Vec<Region<'a>> =
            owners.into_par_iter().filter_map(|owner| Region::new(owner, rings(owner))).collect();
        Self { boxes: Boxes::new(owners.iter().map(|region| region.extent).collect()), owners }
    }

    /// The owners whose region contains a point, ascending. A point on an edge may count either way.
    pub fn owners_at(&self, point: Point) -> Vec<u32> {
        let near = self.boxes.at(point).map(|i| &self.owners[i]);
        let mut owners: Vec<u32> = near.filter(|region| region.holds(point)).map(|region| region.owner).collect();
        owners.sort_unstable();
        owners
    }

    /// The owners whose region contains a point, each with the distance of the point from the edges, mm, at most `reach`.
    pub fn depths_at(&self, point: Point, reach: f64) -> impl Iterator<Item = (u32, f64)> + '_ {
        self.depths_at_of(point, reach).map(|(region, depth)| (region.owner, depth))
    }

    /// The owners whose region contains a point or lies less than `reach` mm from it, each with the depth of the point: its
    /// distance from the edges, mm, at most `reach`, negative outside.
    pub fn depths_about(&self, point: Point, reach: f64) -> impl Iterator<Item = (u32, f64)> + '_ {
        let near = self.boxes.near(around(point, reach)).map(|i| &self.owners[i]);
        near.filter_map(move |region| {
            let away = region.depth(point, reach);
            let depth = if region.holds(point) { away } else { -away };
            (depth > -reach).then_some((region.owner, depth))
        })
    }

    /// The owners in whose region a point lies deeper than `slack` mm, or, in a strip, deeper than a quarter of its width. Each
    /// comes with the distance of the point from the edges, mm, at most `reach`.
    pub fn deep_at(&self, point: Point, reach: f64, slack: f64) -> impl Iterator<Item = (u32, f64)> + '_ {
        self.depths_at_of(point, reach).filter_map(move |(region, depth)| {
            let is_in_strip = || {
                let nearest = region.nearest(point, slack);
                nearest.is_some_and(|(_, edge)| depth > region.edge_of_strip(point, edge, slack))
            };
            (depth > slack || is_in_strip()).then_some((region.owner, depth))
        })
    }

    fn depths_at_of(&self, point: Point, reach: f64) -> impl Iterator<Item = (&Region<'a>, f64)> + '_ {
        let near = self.boxes.at(point).map(|i| &self.owners[i]);
        near.filter(move |region| region.holds(point)).map(move |region| (region, region.depth(point, reach)))
    }

    /// Cost of [`Regions::owners_at`], in comparisons of boxes and of edges.
    pub fn cost_at(&self, point: Point) -> usize {
        let near = self.boxes.at(point).map(|i| self.owners[i].bands.near(point.y, point.y).len());
        self.boxes.cost_at(point) + near.sum::<usize>()
    }

    /// Room of a ray of `owner` before it enters a region. `slack`, mm, applies to its own region and to others. A stretch no
    /// deeper than `slack`, or than a quarter of the width of a strip, lies along an edge and does not enter.
    pub fn room(&self, ray: &Ray, owner: u32, slack: [f64; 2]) -> Room {
        let mut room = Room { own: f64::INFINITY, other: f64::INFINITY };
        let mut extent = around(ray.from, SAME_EPSILON);
        let to = around(ray.from + ray.along * ray.reach, SAME_EPSILON);
        extent.add(to.min);
        extent.add(to.max);
        let near: Vec<&Region> = self.boxes.near(extent).map(|i| &self.owners[i]).collect();
        let mut cuts = Vec::new();
        for region in &near {
            region.near(extent).for_each(|edge| edge.crossings(ray, &mut cuts));
        }
        cuts.sort_by(f64::total_cmp);
        let at = |way: f64| ray.from + ray.along * way;
        let mut a = 0.0;
        for b in cuts.into_iter().chain([ray.reach]) {
            let from = std::mem::replace(&mut a, b);
            if b - from <= SAME_EPSILON {
                continue;
            }
            let middle = at(f64::midpoint(from, b));
            for region in near.iter().filter(|region| region.holds(middle)) {
                let (so_far, slack) = if region.owner == owner { (room.own, slack[0]) } else { (room.other, slack[1]) };
                let probes = ((b - from) / PROBE_STEP).ceil().max(PROBES);
                let is_deep = |i: usize| region.is_deep(at(from + (b - from) * (i as f64 / probes)), slack);
                if from >= so_far || !(1..=probes as usize).any(is_deep) {
                    continue;
                }
                if region.owner == owner {
                    room.own = from;
                } else {
                    room.other = from;
                }
            }
        }
        room
    }
}

/// The box of half width `reach` around a point, mm.
fn around(point: Point, reach: f64) -> Extent {
    let reach = Vector::new(reach, reach);
    Extent { min: point - reach, max: point + reach }
}

impl<'a> Region<'a> {
    /// The region bounded by the rings of one owner; `None` when they have no edges.
    fn new(owner: u32, mut rings: Vec<Cow<'a, [Point]>>) -> Option<Self> {
        if let [ring] = &mut rings[..]
            && let [first, .., last] = **ring
            && first == last
            && ring.windows(2).all(|ends| ends[0] != ends[1])
        {
            let mut extent = Extent::EMPTY;
            ring.iter().for_each(|&point| extent.add(point));
            let bands = Bands::new(ring, &[ring.len() - 1], extent);
            return Some(Self { owner, extent, points: std::mem::take(ring), bands });
        }
        let (mut points, mut ends, mut extent) = (Vec::new(), Vec::new(), Extent::EMPTY);
        points.reserve_exact(rings.iter().map(|ring| ring.len() + 1).sum());
        for ring in rings {
            let Some(&last) = ring.last() else { continue };
            let first = points.len();
            points.push(last);
            for &to in &*ring {
                if points[points.len() - 1] != to {
                    extent.add(to);
                    points.push(to);
                }
            }
            if points.len() - first < 2 {
                // A single point bounds nothing.
                points.truncate(first);
            } else {
                ends.push(points.len() - 1);
            }
        }
        let bands = (!ends.is_empty()).then(|| Bands::new(&points, &ends, extent))?;
        Some(Self { owner, extent, points: points.into(), bands })
    }

    fn edge(&self, i: u32) -> Edge {
        let i = i as usize;
        Edge { from: self.points[i], to: self.points[i + 1] }
    }

    /// Edges whose boxes meet a box; some appear more than once.
    fn near(&self, extent: Extent) -> impl Iterator<Item = Edge> + '_ {
        let edges = if self.extent.meets(&extent) { self.bands.near(extent.min.y, extent.max.y) } else { &[] };
        edges.iter().map(|&i| self.edge(i)).filter(move |edge| extent.meets_box_of([edge.from, edge.to]))
    }

    /// True if a point inside lies deeper than `slack` mm, or, where the region is a strip, deeper than a quarter of its width.
    fn is_deep(&self, point: Point, slack: f64) -> bool {
        self.nearest(point, slack).is_none_or(|(away, edge)| away > self.edge_of_strip(point, edge, slack))
    }

    /// The edge nearest to a point, and its distance, mm; `None` beyond `reach`.
    fn nearest(&self, point: Point, reach: f64) -> Option<(f64, Edge)> {
        let near = self.near(around(point, reach)).map(|edge| (edge.distance(point), edge));
        near.filter(|(away, _)| *away <= reach).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Maximum depth of a point in a strip that still counts as its edge, mm. Infinite where there is no strip, or where the
    /// strip is so wide that this depth would exceed `slack`.
    fn edge_of_strip(&self, point: Point, nearest: Edge, slack: f64) -> f64 {
        STRIP_SHARE * self.width_at(point, nearest, slack / STRIP_SHARE)
    }

    /// Width across a point and its nearest edge, mm. Infinite where the region is no strip, or one wider than `most`.
    fn width_at(&self, point: Point, edge: Edge, most: f64) -> f64 {
        let Some(along) = polyline::direction(edge.from, edge.to) else { return f64::INFINITY };
        let away = cross(along, point - edge.from);
        let across = Vector::new(-along.y, along.x) * away.signum();
        let ray = Ray { from: point, along: across, reach: most - away.abs() };
        let mut extent = around(point, SAME_EPSILON);
        extent.add(point + across * ray.reach);
        let mut ways = Vec::new();
        for other in self.near(extent) {
            let direction = polyline::direction(other.from, other.to);
            if direction.is_some_and(|direction| direction.dot(&along).abs() >= PARALLEL) {
                other.crossings(&ray, &mut ways);
            }
        }
        away.abs() + ways.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// Distance of a point inside from the edges, mm, at most `reach`.
    fn depth(&self, point: Point, reach: f64) -> f64 {
        let near = self.near(around(point, reach));
        near.map(|edge| edge.distance(point)).fold(reach, f64::min)
    }

    /// True if a ray to the right of a point crosses the edges an odd number of times.
    fn holds(&self, point: Point) -> bool {
        let crossed = |&&i: &&u32| {
            let Edge { from, to } = self.edge(i);
            (from.y > point.y) != (to.y > point.y)
                && from.x + (to.x - from.x) * (point.y - from.y) / (to.y - from.y) > point.x
        };
        self.extent.holds(point) && self.bands.near(point.y, point.y).iter().filter(crossed).count() % 2 == 1
    }
}

impl Edge {
    fn distance(&self, point: Point) -> f64 {
        polyline::distance_to_segment(point, self.from, self.to)
    }

    /// Appends the distance along a ray at which it crosses or touches the edge.
    fn crossings(&self, ray: &Ray, cuts: &mut Vec<f64>) {
        let (a, b) = (self.from - ray.from, self.to - ray.from);
        let (side_a, side_b) = (cross(ray.along, a), cross(ray.along, b));
        let mut add = |way: f64| {
            if way > 0.0 && way < ray.reach {
                cuts.push(way);
            }
        };
        for (end, side) in [(a, side_a), (b, side_b)] {
            if side.abs() <= SAME_EPSILON {
                add(ray.along.dot(&end));
            }
        }
        if side_a * side_b < 0.0 {
            add(ray.along.dot(&(a + (b - a) * (side_a / (side_a - side_b)))));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, side: f64) -> Cow<'static, [Point]> {
        [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)].map(|(dx, dy)| Point::new(x + dx, y + dy)).to_vec().into()
    }

    fn east(x: f64, y: f64) -> Ray {
        Ray { from: Point::new(x, y), along: Vector::new(1.0, 0.0), reach: 20.0 }
    }

    #[test]
    fn a_cut_out_belongs_to_no_region_and_what_lies_in_it_to_its_own() {
        let mut turned = square(10.0, 10.0, 30.0);
        turned.to_mut().reverse();
        let regions = Regions::new([1, 2], |owner| match owner {
            1 => vec![square(0.0, 0.0, 50.0), turned.clone()],
            _ => vec![square(20.0, 20.0, 10.0)],
        });
        let owners = |x: f64, y: f64| regions.owners_at(Point::new(x, y));
        assert_eq!([owners(5.0, 5.0), owners(15.0, 15.0), owners(25.0, 25.0)], [vec![1], vec![], vec![2]]);
        assert_eq!([owners(-5.0, 25.0), owners(55.0, 25.0), owners(25.0, 99.0)].concat(), Vec::<u32>::new());
    }

    #[test]
    fn a_way_ends_where_it_enters_a_region() {
        let regions = Regions::new([1, 2], |owner| vec![square(if owner == 1 { 0.0 } else { 10.5 }, 0.0, 10.0)]);
        let room = |ray: &Ray, owner| regions.room(ray, owner, [0.05; 2]);
        let from_corner = room(&east(10.0, 5.0), 1);
        assert!((from_corner.other - 0.5).abs() < 1e-9 && from_corner.own == f64::INFINITY);
        assert_eq!(room(&east(0.0, 5.0), 1).own, 0.0);
        // Along the edge, and nearer to it than the slack, the ray enters nothing.
        assert_eq!(room(&east(10.0, 0.0), 1).least(), f64::INFINITY);
        assert_eq!(room(&east(10.0, 0.04), 1).least(), f64::INFINITY);
        // A ray that starts in another region has no room there.
        assert_eq!(room(&east(12.0, 5.0), 1), Room { own: f64::INFINITY, other: 0.0 });
    }

    #[test]
    fn a_way_across_a_strip_enters_it_however_narrow_that_is_and_one_beside_a_corner_does_not() {
        let strip = |width: f64| {
            let corners = [(5.0, 0.0), (5.0 + width, 0.0), (5.0 + width, 30.0), (5.0, 30.0)];
            corners.map(|(x, y)| Point::new(x, y)).to_vec().into()
        };
        for width in [0.01, 0.1, 0.3, 0.4, 0.8, 3.0] {
            let regions =
                Regions::new([1, 2], |owner| vec![if owner == 1 { strip(width) } else { square(50.0, 0.0, 5.0) }]);
            let room = |ray: &Ray| regions.room(ray, 2, [0.05, 0.2]).other;
            assert!((room(&east(0.0, 10.0)) - 5.0).abs() < 1e-9, "across {width} mm");
            // Along its edge, at a fifth of its width or of the band inside.
            let inside = 5.0 + 0.2 * width.min(0.2);
            let up = Ray { from: Point::new(inside, 1.0), along: Vector::new(0.0, 1.0), reach: 20.0 };
            assert_eq!(room(&up), f64::INFINITY, "along {width} mm");
            let deep = |x: f64| regions.deep_at(Point::new(x, 10.0), 5.0, 0.2).count();
            assert_eq!([deep(inside), deep(5.0 + width / 2.0)], [0, 1], "in {width} mm");
        }
        let corner = [(0.0, 0.0), (30.0, 0.0), (30.0, 17.3)].map(|(x, y)| Point::new(x, y)).to_vec();
        let regions = Regions::new([1], |_| vec![corner.clone().into()]);
        assert_eq!(regions.deep_at(Point::new(0.4, 0.1), 5.0, 0.2).count(), 0);
    }

    #[test]
    fn no_regions_leave_room_everywhere() {
        let nothing = Regions::new([], |_| Vec::new());
        assert_eq!(nothing.room(&east(0.0, 0.0), 0, [0.1; 2]).least(), f64::INFINITY);
        assert!(nothing.owners_at(Point::origin()).is_empty());
    }
}
