//! Nesting: the closed lines around each line of a marker or a drawing, and the part that each line belongs to.
//!
//! A closed line holds a smaller one if a place well inside the smaller one is in it and most of the smaller one, as [`Hold`]
//! defines, does not protrude. It holds an open line if the middle of its first segment or all of its vertices are in it; in a
//! marker it also holds an open line of another group on its edge. A line that an odd number of closed lines hold is an inner
//! line: it bounds a cut-out of the part whose outline is the smallest around it. A closed line in a cut-out is a part again.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use rayon::prelude::*;

use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::region::Regions;
use crate::geom::shape::Shape;
use crate::geom::{Extent, Point, ring};
use crate::ir::Marker;
use crate::ir::list::SegmentList;
use crate::ir::marker::{Contour, Piece};

/// Usual limit of the depth of nesting.
const DEEP: usize = 16;
/// Cost of each line around another beyond that depth, relative to the comparison of two boxes: every query of a place visits
/// them all.
const HELD: usize = 200;
/// Distance within which a vertex of an open line is on an outline, neither inside nor outside, mm: coordinates are rounded.
const ON_OUTLINE: f64 = 0.1;
/// Number of samples of a line to see whether it protrudes.
const SAMPLES: usize = 12;

/// A line of a nesting.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// The box around it.
    pub extent: Extent,
    /// Group of lines that belong together, such as those of a piece.
    pub group: u32,
    /// True if it is closed, so that it has an inside.
    pub is_closed: bool,
    /// True if others may be in it.
    pub may_hold: bool,
}

/// Conditions for a line to hold another.
#[derive(Debug, Clone, Copy)]
pub struct Hold {
    /// Least share of the other's box that its own covers; within a group any share suffices.
    pub box_share: f64,
    /// Least share of the other's samples that are in it.
    pub share: f64,
    /// True if the first of two equal lines holds the other.
    pub twins: bool,
    /// Distance by which lines of other groups may protrude and still be inside, mm: edges within it are one.
    pub band: f64,
}

/// Conditions for cutter files: cut-outs are wholly inside, and a part that is cut twice is no cut-out of itself.
const WHOLLY: Hold = Hold { box_share: 1.0, share: 0.0, twins: false, band: 0.0 };

/// The lines around each line.
#[derive(Debug, Default)]
pub struct Nesting {
    lines: Vec<Line>,
    /// For each line in any other, the lines around it, the smallest first.
    around: BTreeMap<usize, Vec<u32>>,
    /// Groups in whose lines something of another group lies.
    holding: BTreeSet<usize>,
    /// The line at which the work budget was spent: nothing is known of it and of later ones.
    ended: Option<usize>,
}

impl Nesting {
    /// Nesting of some lines; `points` gives the points of one, a closed one ending with its first.
    pub fn new<'a>(
        lines: Vec<Line>,
        hold: Hold,
        points: impl Fn(usize) -> Cow<'a, [Point]> + Sync,
        work: &mut Budget,
    ) -> Self {
        let areas = vec![OnceCell::new(); lines.len()];
        let mut search = Search { boxes: holding(&lines), lines, areas, hold, points, work };
        let (candidates, mut ended) = search.candidates();
        let mut holders: Vec<u32> = candidates.values().flatten().copied().collect();
        holders.sort_unstable();
        holders.dedup();
        let regions = Regions::new(holders, |holder| vec![(search.points)(holder as usize)]);
        let mut around = BTreeMap::new();
        for (line, candidates) in candidates {
            let Some(held_by) = search.around(line, &candidates, &regions) else {
                ended = Some(ended.map_or(line, |ended: usize| ended.min(line)));
                break;
            };
            if !held_by.is_empty() {
                around.insert(line, held_by);
            }
        }
        let mut nesting = Self { lines: search.lines, around, ended, ..Self::default() };
        nesting.find_holding();
        nesting
    }

    fn find_holding(&mut self) {
        let group = |line: usize| self.lines[line].group;
        let pairs =
            self.around.iter().flat_map(|(&line, outer)| outer.iter().map(move |&outer| [line, outer as usize]));
        self.holding = pairs
            .filter(|&[line, outer]| group(line) != group(outer))
            .map(|[_, outer]| group(outer) as usize)
            .collect();
    }

    /// Nesting of the contours of a marker, where edges of different pieces within `band` mm are one edge: its lines are those
    /// of [`Marker::contours`], in that order, its groups the indices of its pieces.
    pub fn of(marker: &Marker, band: f64) -> Self {
        Self::of_contours(&marker.list, &marker.contours().collect::<Vec<_>>(), Hold { band, ..WHOLLY })
    }

    /// Nesting of the contours of a piece alone: its lines are the contours.
    pub fn of_piece(list: &SegmentList, piece: &Piece) -> Self {
        match &piece.contours[..] {
            [_] => Self::default(), // as of nearly all
            contours => {
                let contours: Vec<(usize, &Contour)> = contours.iter().map(|contour| (0, contour)).collect();
                Self::of_contours(list, &contours, WHOLLY)
            }
        }
    }

    /// Nesting of some lines, each its own group; closed ones end with their first point.
    pub fn of_lines(lines: &[&[Point]]) -> Self {
        let line = |(group, points): (usize, &&[Point])| {
            let is_closed = points.len() > 2 && points.first() == points.last();
            Line { extent: Extent::of(points), group: group as u32, is_closed, may_hold: is_closed }
        };
        let all = lines.iter().enumerate().map(line).collect();
        Self::new(all, WHOLLY, |i| Cow::Borrowed(lines[i]), &mut Budget::of_a_marker())
    }

    /// Nesting of some contours, each with its group.
    fn of_contours(list: &SegmentList, contours: &[(usize, &Contour)], hold: Hold) -> Self {
        let line = |&(group, contour): &(usize, &Contour)| Line {
            extent: list.extent(contour.range),
            group: group as u32,
            is_closed: contour.closed,
            may_hold: contour.closed,
        };
        let lines = contours.par_iter().map(line).collect();
        let points = |line: usize| list.points(contours[line].1.range);
        let mut nesting = Self::new(lines, hold, points, &mut Budget::of_a_marker());
        nesting.part_overlaid();
        nesting
    }

    /// Removes lines of other groups from those around a line that lies in their part and holds a line of theirs: around their
    /// cut-out it lies over their part, not in it.
    fn part_overlaid(&mut self) {
        let group = |line: usize| self.lines[line].group;
        let pairs =
            self.around.iter().flat_map(|(&line, outer)| outer.iter().map(move |&outer| (outer as usize, line)));
        let held: BTreeSet<(usize, u32)> = pairs.map(|(outer, line)| (outer, group(line))).collect();
        let lines = &self.lines;
        for (line, outer) in &mut self.around {
            let own = lines[*line].group;
            let of = |outer: u32| lines[outer as usize].group;
            // Inside an outline and one of its cut-outs is not in the part.
            let is_in_part = |group: u32| outer.iter().filter(|&&outer| of(outer) == group).count() % 2 == 1;
            let groups = outer.iter().map(|&outer| of(outer)).filter(|&group| group != own);
            let over: BTreeSet<u32> =
                groups.filter(|&group| held.contains(&(*line, group)) && is_in_part(group)).collect();
            outer.retain(|&outer| !over.contains(&of(outer)));
        }
        self.around.retain(|_, outer| !outer.is_empty());
        self.find_holding();
    }

    /// The lines.
    pub fn lines(&self) -> &[Line] {
        &self.lines
    }

    /// The lines of a group; lines must be sorted by group, as in a marker.
    pub fn of_group(&self, group: usize) -> Range<usize> {
        let first = |group: usize| self.lines.partition_point(|line| (line.group as usize) < group);
        first(group)..first(group + 1)
    }

    /// The line at which the search ended early; `None` if it is complete.
    pub fn ended(&self) -> Option<usize> {
        self.ended
    }

    /// True if no line is in another.
    pub fn is_flat(&self) -> bool {
        self.around.is_empty()
    }

    /// The lines around one, the smallest first.
    pub fn around(&self, line: usize) -> impl DoubleEndedIterator<Item = usize> + ExactSizeIterator + '_ {
        self.around.get(&line).map_or(&[][..], Vec::as_slice).iter().map(|&outer| outer as usize)
    }

    /// The smallest line around one.
    pub fn parent(&self, line: usize) -> Option<usize> {
        self.around(line).next()
    }

    /// The largest line around one.
    pub fn outermost(&self, line: usize) -> Option<usize> {
        self.around(line).next_back()
    }

    /// True if an odd number of lines is around one: then a closed one bounds a cut-out, and an open one is in a part.
    pub fn is_inner(&self, line: usize) -> bool {
        self.around(line).len() % 2 == 1
    }

    /// Outline of the part to which a line belongs: itself for an outline, otherwise the smallest outline around it; `None` for
    /// an open line in no part.
    pub fn outline(&self, line: usize) -> Option<usize> {
        if self.is_inner(line) {
            self.around(line).find(|&outer| !self.is_inner(outer))
        } else {
            Some(line).filter(|&line| self.lines[line].is_closed)
        }
    }

    /// The widest closed line of a group; the first of all when none is closed.
    pub fn widest(&self, group: usize) -> Option<usize> {
        let closed = self.of_group(group).filter(|&i| self.lines[i].is_closed);
        let area = |line: usize| box_area(&self.lines[line].extent);
        let widest = closed.max_by(|&a, &b| area(a).total_cmp(&area(b)).then(b.cmp(&a)));
        widest.or_else(|| self.of_group(group).next())
    }

    /// The other groups within whose closed lines a group lies, in order. Its widest line represents it, and its open lines do
    /// if nothing of another group lies in it: two groups never lie in each other.
    pub fn holders(&self, group: usize) -> Vec<usize> {
        let Some(outline) = self.widest(group) else { return Vec::new() };
        let open = self.of_group(group).filter(|&line| !self.lines[line].is_closed && !self.holding.contains(&group));
        let around = open.chain([outline]).flat_map(|line| self.around(line));
        let others = around.map(|line| self.lines[line].group as usize);
        let mut holders: Vec<usize> = others.filter(|&holder| holder != group).collect();
        holders.sort_unstable();
        holders.dedup();
        holders
    }

    /// The part to which a group belongs, by the group of its outline: another group if its widest closed line bounds a cut-out
    /// of that; `None` if none of its lines is closed.
    pub fn part_of(&self, group: usize) -> Option<usize> {
        let widest = self.widest(group).filter(|&line| self.lines[line].is_closed)?;
        self.outline(widest).map(|outline| self.lines[outline].group as usize)
    }
}

fn box_area(extent: &Extent) -> f64 {
    let (width, height) = extent.size();
    width * height
}

/// Boxes of the lines that may hold others, with empty boxes for the rest.
fn holding(lines: &[Line]) -> Boxes {
    Boxes::new(lines.iter().map(|line| if line.may_hold { line.extent } else { Extent::EMPTY }).collect())
}

struct Search<'w, P> {
    lines: Vec<Line>,
    /// Area within each line, mm2, computed at first use: few lines are near enough to others.
    areas: Vec<OnceCell<f64>>,
    boxes: Boxes,
    hold: Hold,
    points: P,
    work: &'w mut Budget,
}

impl<'a, P: Fn(usize) -> Cow<'a, [Point]> + Sync> Search<'_, P> {
    /// Candidates around each line, by their boxes alone, and the line at which the work budget was spent.
    fn candidates(&mut self) -> (BTreeMap<usize, Vec<u32>>, Option<usize>) {
        let mut candidates = BTreeMap::new();
        for (i, line) in self.lines.iter().enumerate() {
            let middle = line.extent.min + (line.extent.max - line.extent.min) / 2.0;
            if line.extent.is_empty() || !self.work.spend(self.boxes.cost_at(middle)) {
                if self.work.is_spent() {
                    return (candidates, Some(i));
                }
                continue;
            }
            let holders = self.boxes.at(middle).filter(|&k| self.may_hold(k, i));
            let holders: Vec<u32> = holders.map(|k| k as u32).collect();
            if !self.work.spend(HELD * holders.len().saturating_sub(DEEP)) {
                return (candidates, Some(i));
            }
            if !holders.is_empty() {
                candidates.insert(i, holders);
            }
        }
        (candidates, None)
    }

    /// True if one line is larger than another and its box leaves little of the other's uncovered.
    fn may_hold(&self, outer: usize, inner: usize) -> bool {
        let (around, own) = (&self.lines[outer], &self.lines[inner]);
        let both = Extent { min: own.extent.min.sup(&around.extent.min), max: own.extent.max.inf(&around.extent.max) };
        let covers = if self.hold.box_share >= 1.0 {
            around.group == own.group || around.extent.grown(self.hold.band).covers(&own.extent)
        } else {
            box_area(&both) >= self.hold.box_share * box_area(&own.extent)
        };
        covers && outer != inner && (!own.is_closed || self.is_larger(outer, inner))
    }

    fn is_larger(&self, one: usize, other: usize) -> bool {
        if self.are_alike(one, other) {
            // A part that fills a cut-out is in it, whichever of the two was drawn larger.
            match [one, other].map(|line| self.is_cut_out(line)) {
                [true, false] => return true,
                [false, true] => return false,
                [true, true] | [false, false] => {}
            }
        }
        let [a, b] = [one, other].map(|line| self.area(line));
        a > b || self.hold.twins && a == b && one < other
    }

    /// True if the boxes of two lines of different groups agree within the band.
    fn are_alike(&self, one: usize, other: usize) -> bool {
        let [a, b] = [one, other].map(|line| &self.lines[line]);
        let covers = |outer: &Line, inner: &Line| outer.extent.grown(self.hold.band).covers(&inner.extent);
        a.group != b.group && covers(a, b) && covers(b, a)
    }

    /// True if the box of a line is in that of a larger one of its group, as for cut-outs.
    fn is_cut_out(&self, line: usize) -> bool {
        let own = &self.lines[line];
        let first = self.lines.partition_point(|other| other.group < own.group);
        let group = self.lines[first..].iter().take_while(|other| other.group == own.group);
        let covers = |other: &Line| other.extent != own.extent && other.extent.covers(&own.extent);
        group.filter(|other| other.may_hold).any(covers)
    }

    fn area(&self, line: usize) -> f64 {
        let area = || if self.lines[line].is_closed { ring::area(&(self.points)(line)).abs() } else { 0.0 };
        *self.areas[line].get_or_init(area)
    }

    /// The candidates that hold a line, the smallest first; `None` when the work budget is spent.
    fn around(&mut self, line: usize, candidates: &[u32], regions: &Regions) -> Option<Vec<u32>> {
        let points = (self.points)(line);
        let is_closed = self.lines[line].is_closed;
        // An open line may begin on an outline.
        let place =
            if is_closed { Shape::new(&[&points]).inner() } else { Some(points[0] + (points[1] - points[0]) / 2.0) };
        let Some(place) = place else { return Some(Vec::new()) };
        if !self.work.spend(regions.cost_at(place)) {
            return None;
        }
        let holders = regions.owners_at(place);
        let holds = |owners: &[u32], candidate: &u32| owners.binary_search(candidate).is_ok();
        let mut around: Vec<u32> = candidates.iter().copied().filter(|candidate| holds(&holders, candidate)).collect();
        if !is_closed && around.len() < candidates.len() {
            // The first segment of an open line may cross a bay of the outline that holds all its vertices.
            let mut left: Vec<u32> = candidates.iter().copied().filter(|one| !holds(&holders, one)).collect();
            let mut deep: Vec<u32> = Vec::new();
            let own = self.lines[line].group;
            let is_edge = |candidate: u32| self.hold.band > 0.0 && self.lines[candidate as usize].group != own;
            let reach = self.hold.band.max(ON_OUTLINE);
            for &point in points.iter() {
                if left.is_empty() {
                    break;
                }
                if !self.work.spend(regions.cost_at(point)) {
                    return None;
                }
                let owners: Vec<(u32, f64)> = regions.depths_about(point, reach).collect();
                let least = |candidate: u32| if is_edge(candidate) { -reach } else { -ON_OUTLINE };
                left.retain(|one| owners.iter().any(|&(owner, depth)| owner == *one && depth > least(*one)));
                deep.extend(owners.iter().filter(|(_, depth)| *depth >= ON_OUTLINE).map(|(owner, _)| owner));
            }
            around.extend(left.into_iter().filter(|&candidate| is_edge(candidate) || deep.contains(&candidate)));
        }
        if self.hold.share > 0.0 && !around.is_empty() {
            if !self.work.spend(SAMPLES * regions.cost_at(place)) {
                return None;
            }
            let samples: Vec<Vec<u32>> = samples(&points).map(|sample| regions.owners_at(sample)).collect();
            let inside = |outer: &u32| samples.iter().filter(|owners| holds(owners, outer)).count();
            around.retain(|outer| inside(outer) as f64 >= self.hold.share * SAMPLES as f64);
        }
        let area = |line: u32| self.area(line as usize);
        around.sort_by(|&a, &b| area(a).total_cmp(&area(b)).then(b.cmp(&a)));
        Some(around)
    }
}

/// Middles of edges of a ring, evenly distributed; edges on those of another ring count either way.
fn samples(ring: &[Point]) -> impl Iterator<Item = Point> {
    let edges = ring.len() - 1;
    (0..SAMPLES).map(move |k| {
        let place = (2 * k + 1) * edges;
        let (edge, share) = (place / (2 * SAMPLES), (place % (2 * SAMPLES)) as f64 / (2 * SAMPLES) as f64);
        ring[edge] + (ring[edge + 1] - ring[edge]) * share
    })
}
