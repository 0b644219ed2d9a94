//! Outlines of one piece: queries for crossings, containment and distance.

use std::borrow::Cow;

use crate::geom::budget::Budget;
use crate::geom::monotone::{Crossing, crossing};
use crate::geom::{Extent, Point, cross, polyline, ring};
use crate::ir::Chains;
use crate::ir::marker::{Drill, Marker};

/// Greatest number of vertices along which a line is followed from a crossing to check that it leads to the other side.
const MOST_STEPS: usize = 64;

/// Outlines of a piece.
#[derive(Debug)]
pub struct Outlines<'a> {
    /// Points of all contours, one after the other; a closed contour ends with its first point.
    pub points: Cow<'a, [Point]>,
    /// Contours, in order.
    pub contours: Vec<Start>,
    /// Monotone chains of the points.
    pub chains: Chains<'a>,
    /// Bounding box.
    pub extent: Extent,
}

/// Contour among those of a piece.
#[derive(Debug, Clone, Copy)]
pub struct Start {
    /// Index of its first point among all points.
    pub first: usize,
    /// True if it is closed.
    pub is_closed: bool,
}

impl Default for Outlines<'_> {
    fn default() -> Self {
        let (points, chains) = (Cow::default(), Chains::default());
        Self { points, contours: Vec::new(), chains, extent: Extent::EMPTY }
    }
}

impl<'a> Outlines<'a> {
    /// Outlines of a piece, by its index in the marker.
    pub fn of(marker: &'a Marker, piece: usize) -> Self {
        let mut part = Self::default();
        part.gather(marker, piece);
        part
    }

    /// Replaces the outlines by those of another piece, so that one value can be reused for all pieces of a marker.
    pub fn gather(&mut self, marker: &'a Marker, piece: usize) {
        let Self { points, contours, chains, extent } = self;
        contours.clear();
        (*points, *chains, *extent) = (Cow::default(), Chains::default(), Extent::EMPTY);
        for contour in &marker.pieces[piece].contours {
            let start = points.len();
            contours.push(Start { first: start, is_closed: contour.closed });
            extent.join(&marker.list.extent(contour.range));
            let of_contour = (marker.list.points(contour.range), marker.list.chains(contour.range));
            // A piece of one contour, like most, is borrowed and not copied.
            if start == 0 {
                (*points, *chains) = of_contour;
            } else {
                points.to_mut().extend_from_slice(&of_contour.0);
                chains.all.to_mut().extend(of_contour.1.all.iter().map(|chain| chain.moved(start as u32)));
                chains.boxes.to_mut().extend_from_slice(&of_contour.1.boxes);
            }
        }
    }

    /// Points of a contour.
    pub fn contour(&self, k: usize) -> &[Point] {
        let end = self.contours.get(k + 1).map_or(self.points.len(), |next| next.first);
        &self.points[self.contours[k].first..end]
    }

    /// Points of each closed contour.
    pub fn closed(&self) -> impl Iterator<Item = &[Point]> {
        (0..self.contours.len()).filter(|&k| self.contours[k].is_closed).map(|k| self.contour(k))
    }

    /// True if a point lies in the part: inside its outline and outside its cut-outs.
    pub fn holds(&self, point: Point) -> bool {
        self.extent.holds(point) && self.closed().filter(|points| ring::contains(points, point)).count() % 2 == 1
    }

    /// True if a hole is in the part, or if the budget does not suffice to tell.
    pub fn may_hold(&self, drill: &Drill, work: &mut Budget) -> bool {
        let near = self.extent.holds(drill.at);
        !work.spend(if near { self.points.len() } else { 1 }) || (near && self.holds(drill.at))
    }

    /// Distance of a point from the outlines, mm.
    pub fn distance(&self, point: Point) -> f64 {
        let contours = (0..self.contours.len()).map(|k| self.contour(k));
        let ends = contours.flat_map(|points| points.windows(2));
        ends.map(|w| polyline::distance_to_segment(point, w[0], w[1])).fold(f64::INFINITY, f64::min)
    }

    /// Edges that may enter a box, including those of open lines.
    pub fn edges_near(&self, around: Extent) -> impl Iterator<Item = [Point; 2]> {
        let near = self.chains.each().filter(move |(_, extent)| extent.meets(&around));
        near.flat_map(move |(chain, _)| {
            let points = &self.points[chain.first as usize..=chain.last as usize];
            // Along a chain X is monotone.
            let is_rising = points[points.len() - 1].x >= points[0].x;
            let [enters, leaves] = if is_rising { [around.min.x, around.max.x] } else { [around.max.x, around.min.x] };
            let is_before = |x: f64, limit: f64| if is_rising { x < limit } else { x > limit };
            let first = points.partition_point(|point| is_before(point.x, enters)).saturating_sub(1);
            let end = points.partition_point(|point| !is_before(leaves, point.x));
            points[first..(end + 1).min(points.len())].windows(2).map(|w| [w[0], w[1]])
        })
    }

    /// Index of the contour of a point.
    pub fn contour_of(&self, point: usize) -> usize {
        self.contours.partition_point(|contour| contour.first <= point) - 1
    }

    /// True if the line, followed both ways from `segment`, departs by more than `slack` mm from the line through `ends` before
    /// it comes back to that, at either side.
    pub fn leads_across(&self, segment: usize, ends: [Point; 2], slack: f64) -> bool {
        let points = self.contour(self.contour_of(segment));
        let Start { first, is_closed } = self.contours[self.contour_of(segment)];
        let start = segment - first;
        let Some(along) = polyline::direction(ends[0], ends[1]) else { return false };
        let side = |point: Point| cross(along, point - ends[0]);
        // A closed contour repeats its first point.
        let count = points.len() - usize::from(points.first() == points.last());
        let departs = |step: &dyn Fn(usize) -> Option<usize>| {
            // An open line does not continue past its end.
            let place =
                |k: usize| step(k).filter(|&place| is_closed || place < count).map(|place| points[place % count]);
            let Some(first) = place(0) else { return false };
            let sign = side(first).signum();
            let way = (0..count.min(MOST_STEPS)).map_while(place).map(|point| side(point) * sign);
            way.take_while(|&far| far > 0.0).any(|far| far > slack)
        };
        let back = |k: usize| if is_closed { Some(start + count - k) } else { start.checked_sub(k) };
        departs(&|k| Some(start + 1 + k)) && departs(&back)
    }

    /// First crossing of its outlines with themselves or each other; `None` if there is none.
    pub fn self_crossing(&self, marker: &Marker, work: &mut Budget) -> Option<Crossing> {
        let ends = |segment: usize| [self.points[segment], self.points[segment + 1]];
        let mut wanted = |crossing: &Crossing| {
            let [a, b] = crossing.segments;
            self.leads_across(a, ends(b), slack(marker)) && self.leads_across(b, ends(a), slack(marker))
        };
        let mut found: Option<Crossing> = None;
        pairs(&self.chains.boxes, &self.extent, work, |i, k, work| {
            let both = [i.min(k), i.max(k)].map(|chain| self.chains.all[chain]);
            found = crossing([&self.points, &self.points], both, work, &mut wanted);
            found.is_none() && !work.is_spent()
        });
        found
    }
}

/// Greatest displacement of two points by rounding to the grid of the file, mm: its diagonal.
pub fn slack(marker: &Marker) -> f64 {
    marker.unit * std::f64::consts::SQRT_2
}

/// Calls `met` for each pair of overlapping boxes until it returns false: a sweep along the longer side of the common box.
fn pairs(boxes: &[Extent], around: &Extent, work: &mut Budget, mut met: impl FnMut(usize, usize, &mut Budget) -> bool) {
    let (width, height) = around.size();
    let side = |&Extent { min, max }: &Extent| if width >= height { [min.x, max.x] } else { [min.y, max.y] };
    let mut order: Vec<(i64, u32)> =
        boxes.iter().zip(0..).map(|(extent, i)| (in_total_order(side(extent)[0]), i)).collect();
    order.sort_by_key(|&(start, _)| start); // stable: equal starts keep their order
    // Boxes not yet passed by the sweep: their ends and indices.
    let mut active: Vec<(f64, usize)> = Vec::with_capacity(boxes.len());
    for i in order.into_iter().map(|(_, i)| i as usize) {
        let [start, end] = side(&boxes[i]);
        if !work.spend(active.len()) {
            return;
        }
        let mut kept = 0;
        for place in 0..active.len() {
            let (other_end, k) = active[place];
            if other_end < start {
                continue;
            }
            active[kept] = (other_end, k);
            kept += 1;
            if boxes[i].overlaps(&boxes[k]) && !met(k, i, work) {
                return;
            }
        }
        active.truncate(kept);
        active.push((end, i));
    }
}

/// Integer for a number, with the order of [`f64::total_cmp`]: faster to compare.
fn in_total_order(number: f64) -> i64 {
    let bits = number.to_bits().cast_signed();
    bits ^ (bits >> 63 & i64::MAX)
}
