//! Bridges: short straight lines between the strokes of an outline that nearly meet.
//!
//! Ends at most `drawing.close_mm` apart that are mutually nearest are bridged if the strokes then go around something and come
//! back. A dashed line has larger gaps, and stays as it is. If another line begins beside a bridge and leads inwards, the ring
//! may combine two outlines, and stays open.

use super::chains::{Chains, End, other, place};
use super::line::SMALL_OUTLINE;
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline, ring};
use crate::ir::drawing::Drawing;
use crate::ir::marker::Notch;

/// Greatest share of an outline that its bridges take up: the gaps of dashed lines take a fifth and more.
const MOST_BRIDGED: f64 = 0.05;
/// Greatest number of ends near one that are compared: more are the centre of a star.
const MOST_ENDS: usize = 64;
/// Difference of distances that count as equal, mm: less than any unit of a file.
const EQUAL_EPSILON: f64 = 1e-6;

/// Free ends of strokes, and the greatest length of bridges.
pub(super) struct Gaps<'a> {
    pub(super) drawing: &'a Drawing,
    pub(super) chains: &'a Chains,
    /// Ascending.
    pub(super) ends: &'a [End],
    /// Greatest length of a bridge, mm.
    pub(super) close: f64,
}

impl Gaps<'_> {
    /// Bridges, each from an end to another.
    pub(super) fn bridges(&self) -> Vec<[End; 2]> {
        let at = |end: &End| place(self.drawing, *end);
        let boxes = Boxes::new(self.ends.iter().map(|end| Extent::between(at(end), at(end))).collect());
        let nearest: Vec<Option<usize>> = (0..self.ends.len()).map(|k| self.nearest(k, &boxes)).collect();
        let mut across = vec![None; self.chains.links.len()];
        for (k, near) in nearest.iter().enumerate() {
            if let Some(near) = near.filter(|&near| nearest[near] == Some(k))
                && self.chains.far(self.ends[k]) != self.ends[near]
            {
                across[self.ends[k]] = Some(self.ends[near]);
            }
        }
        let mut found = Vec::new();
        let mut seen = vec![false; across.len()];
        for &end in self.ends {
            if let Some(ring) = self.ring(end, &across, &mut seen).filter(|ring| self.goes_around(ring, &boxes)) {
                found.extend(ring);
            }
        }
        found
    }

    /// Ends of other strokes of the same pen within reach of an end, each with its distance, mm, and its index in `ends`.
    fn near<'b>(&'b self, k: usize, boxes: &'b Boxes) -> impl Iterator<Item = (f64, usize)> + 'b {
        let pen = |end: End| self.drawing.strokes[end / 2].pen;
        let (end, at) = (self.ends[k], place(self.drawing, self.ends[k]));
        let reach = Extent::between(at, at).grown(self.close);
        let is_few = boxes.cost_near(&reach) <= MOST_ENDS;
        let near = is_few.then(|| boxes.near(reach)).into_iter().flatten();
        let others = near.filter(move |&near| {
            self.ends[near] != end && self.ends[near] != other(end) && pen(self.ends[near]) == pen(end)
        });
        let apart = others.map(move |near| ((place(self.drawing, self.ends[near]) - at).norm(), near));
        apart.filter(|(distance, _)| *distance <= self.close)
    }

    /// End that is nearer to one than all others; `None` if two are equally near.
    fn nearest(&self, k: usize, boxes: &Boxes) -> Option<usize> {
        let (distance, nearest) = self.near(k, boxes).min_by(|a, b| a.0.total_cmp(&b.0))?;
        let is_other = |(apart, near): (f64, usize)| near != nearest && apart <= distance + EQUAL_EPSILON;
        (!self.near(k, boxes).any(is_other)).then_some(nearest)
    }

    /// Bridges of the ring from an end on; `None` if there is no ring, or if it was visited before.
    fn ring(&self, first: End, across: &[Option<End>], seen: &mut [bool]) -> Option<Vec<[End; 2]>> {
        let mut bridges = Vec::new();
        let mut at = first;
        loop {
            let next = across[at]?;
            if seen[at] {
                return None;
            }
            (seen[at], seen[next]) = (true, true);
            bridges.push([at, next]);
            at = self.chains.far(next);
            if at == first {
                return Some(bridges);
            }
        }
    }

    /// True if a ring is as large as an outline, mostly drawn, and a single outline.
    fn goes_around(&self, bridges: &[[End; 2]], boxes: &Boxes) -> bool {
        let (mut places, mut bridged) = (Vec::new(), 0.0);
        for &[from, to] in bridges {
            bridged += (place(self.drawing, from) - place(self.drawing, to)).norm();
            self.chains.from(to).for_each(|end| places.extend(self.places(end)));
        }
        let drawn = polyline::length(&places) - bridged;
        let (width, height) = Extent::of(&places).size();
        if width.max(height) <= SMALL_OUTLINE || bridged > MOST_BRIDGED * drawn {
            return false;
        }
        places.extend(places.first().copied());
        let mut own: Vec<End> = bridges.iter().flatten().copied().collect();
        own.sort_unstable();
        let in_ring = |end: End| own.binary_search(&end).is_ok();
        let leads_in = |k: usize| {
            let end = self.ends[k];
            let is_long = || polyline::length(&self.places(end)) > Notch::LONGEST;
            !in_ring(end) && is_long() && ring::contains(&places, place(self.drawing, end))
        };
        let index = |end: End| self.ends.binary_search(&end).ok();
        let near = bridges.iter().flatten().filter_map(|&end| index(end)).flat_map(|k| self.near(k, boxes));
        !near.into_iter().any(|(_, k)| leads_in(k))
    }

    /// Places of a stroke, starting from an end.
    fn places(&self, end: End) -> Vec<Point> {
        let stroke = &self.drawing.vertices[self.drawing.strokes[end / 2].range()];
        let places = stroke.iter().map(|vertex| vertex.at);
        if end.is_multiple_of(2) { places.collect() } else { places.rev().collect() }
    }
}
