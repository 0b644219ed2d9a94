//! Slits that a plot draws separately: short straight strokes from the edge of a closed stroke inwards. They are not part of a
//! line that begins at their foot or continues from their tip: a dart, a fold line, a pleat, a seam line.
//!
//! A stroke of the size of a notch still continues from a tip: a notch may be drawn in several strokes.

use super::chains::{End, other, place};
use super::line::{Line, SMALL_OUTLINE};
use super::pens::Use;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, Vector, angle, polyline, ring};
use crate::ir::drawing::Drawing;
use crate::ir::marker::Notch;

/// Least distance of the tip of a slit from the edge, mm.
const LEAST_DEPTH: f64 = 0.5;
/// Greatest turn between the halves of a crossbar, rad.
const STRAIGHT: f64 = 0.2;
/// Least turn at the tip of a short line into a line that is drawn side by side, rad.
const BEND: f64 = 0.5;
/// Number of closed strokes in a rectangle that make it a frame, at whose edge outlines in strokes may begin.
const FRAMED: usize = 2;

/// Strokes of a drawing, with possible dead-end slits among them.
pub(super) struct Slits<'a> {
    pub(super) drawing: &'a Drawing,
    /// Strokes that are closed, or nearly so.
    pub(super) rings: Vec<usize>,
    pub(super) candidates: Vec<usize>,
    /// Distance within which strokes touch, mm.
    pub(super) touch: f64,
}

impl Slits<'_> {
    /// Ends of candidates that stand on an edge from which they lead inwards.
    pub(super) fn feet(&self, work: &mut Budget) -> Vec<End> {
        let ends: Vec<End> = self.candidates.iter().flat_map(|k| [2 * k, 2 * k + 1]).collect();
        let reach = Notch::MISS + self.touch;
        let at = |end: End| place(self.drawing, end);
        let boxes = Boxes::new(ends.iter().map(|&end| Extent::between(at(end), at(end)).grown(reach)).collect());
        let rings = Boxes::new(self.rings.iter().map(|&ring| self.extent(ring)).collect());
        let mut feet = Vec::new();
        for &stroke in &self.rings {
            let vertices = &self.drawing.vertices[self.drawing.strokes[stroke].range()];
            let line = Line::of(vertices, 0, Use::Unsaid);
            if line.size() <= SMALL_OUTLINE || boxes.near(line.extent).next().is_none() {
                continue;
            }
            if line.is_rectangle(self.touch) && is_around(&rings, line.extent) {
                continue;
            }
            let places = line.points(vertices);
            let mut near: Vec<End> = boxes.near(line.extent).map(|k| ends[k]).collect();
            near.sort_unstable();
            for end in near {
                if !work.spend(3 * places.len()) {
                    return feet;
                }
                let [foot, tip] = [end, other(end)].map(|end| (at(end), polyline::distance(at(end), &places)));
                let leads_in = foot.1 <= reach && tip.1 > foot.1.max(LEAST_DEPTH);
                if leads_in && ring::contains(&places, tip.0) {
                    feet.push(end);
                }
            }
        }
        feet.sort_unstable();
        feet.dedup();
        feet
    }

    fn extent(&self, stroke: usize) -> Extent {
        self.drawing.vertices[self.drawing.strokes[stroke].range()].iter().fold(Extent::EMPTY, |mut extent, vertex| {
            extent.add(vertex.at);
            extent
        })
    }

    /// True if a slit ends where it meets others, given by their ends there.
    pub(super) fn ends_at_tip(&self, foot: End, others: &[End], feet: &[End]) -> bool {
        let is_foot = |end: End| feet.binary_search(&end).is_ok();
        let is_long = |end: End| self.length(end) > Notch::LONGEST_STROKE;
        match *others {
            [one] if is_long(one) => {
                let turn = angle::turn(self.way(foot), self.way(one)).abs();
                turn <= BEND || !self.leads_to_slit(one, feet)
            }
            [] | [_] => false,
            [a, b] if !is_long(a) && !is_long(b) => {
                let is_half =
                    |end: End| !is_foot(end) && !is_foot(other(end)) && self.length(end) <= Notch::LONGEST / 2.0;
                is_half(a) && is_half(b) && angle::turn(-self.way(a), self.way(b)).abs() <= STRAIGHT
            }
            _ => others.iter().any(|&end| is_long(end)),
        }
    }

    /// True if a stroke leads from an end to the tip of a slit.
    fn leads_to_slit(&self, end: End, feet: &[End]) -> bool {
        let to = place(self.drawing, other(end));
        feet.iter().any(|&foot| (place(self.drawing, other(foot)) - to).amax() <= self.touch)
    }

    /// Vector from an end of a stroke to its other end.
    fn way(&self, end: End) -> Vector {
        place(self.drawing, other(end)) - place(self.drawing, end)
    }

    fn length(&self, end: End) -> f64 {
        let vertices = &self.drawing.vertices[self.drawing.strokes[end / 2].range()];
        polyline::length(&vertices.iter().map(|vertex| vertex.at).collect::<Vec<Point>>())
    }
}

/// True if a rectangle contains enough of the boxes to be a frame. Its own box is one of them.
fn is_around(boxes: &Boxes, rectangle: Extent) -> bool {
    boxes.near(rectangle).filter(|&k| rectangle.covers(&boxes.all()[k])).take(1 + FRAMED).count() > FRAMED
}
