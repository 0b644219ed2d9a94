//! Stroke: a notch that a drawing draws as an open stroke between two places of an outline becomes a part of that outline.
//!
//! Needs: welded contours. The stroke takes the place of the edge over its mouth, as if the file drew the notch in the
//! outline, so that all passes behind this one see the same notches whatever drew them. Leaves true: outlines stay closed,
//! and a stroke that overlaps the mouth of another one stays a contour of its own. Cutter files are left alone: what they
//! cut is meant.

use super::pass::MarkerPass;
use super::search;
use crate::diagnostic::Diagnostics;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, polyline};
use crate::ir::list::{Range, Segment, SegmentList};
use crate::ir::marker::{Contour, Marker, Notch, Piece};
use crate::machine::Job;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "stroke", about: "makes notches that are drawn from edge to edge part of their outlines", run };

/// Distance by which rounding moves a place: in units of the file, and without a grid in mm.
const ROUNDING: f64 = std::f64::consts::SQRT_2;
const NO_GRID: f64 = 0.01;

fn run(marker: &mut Marker, _: &Job, diagnostics: &mut Diagnostics) {
    let Marker { list, pieces, unit, drawing, .. } = marker;
    if drawing.is_none() {
        return;
    }
    let grid = if *unit > 0.0 { *unit } else { NO_GRID };
    let mut joining = Joining { list, grid, work: Budget::of_a_marker() };
    for piece in pieces {
        joining.join(piece);
    }
    if joining.work.is_spent() {
        diagnostics.push(search::search_ended("some notches that are strokes from edge to edge are cut by themselves"));
    }
}

struct Joining<'a> {
    list: &'a mut SegmentList,
    /// Places nearer than this are one, mm.
    grid: f64,
    work: Budget,
}

/// A place on an outline: a segment, and the share of it.
type Place = (usize, f64);

/// A stroke between two places of an outline, in the direction of the outline.
struct Mouth {
    from: Place,
    to: Place,
    /// Its contour in the piece.
    contour: usize,
    segments: Vec<Segment>,
}

impl Joining<'_> {
    fn join(&mut self, piece: &mut Piece) {
        let mut strokes: Vec<usize> = (0..piece.contours.len()).filter(|&k| self.may_be(&piece.contours[k])).collect();
        if strokes.is_empty() {
            return; // as in nearly all
        }
        let mut joined = Vec::new();
        for k in 0..piece.contours.len() {
            if piece.contours[k].closed {
                let taken = self.join_outline(piece, k, &strokes);
                strokes.retain(|stroke| !taken.contains(stroke));
                joined.extend(taken);
            }
        }
        let mut place = 0..;
        piece.contours.retain(|_| !joined.contains(&place.next().expect("it never ends")));
    }

    fn may_be(&self, contour: &Contour) -> bool {
        let [start, end] = self.list.ends_of(contour.range);
        let points = || self.list.points(contour.range);
        !contour.closed
            && (end - start).norm() <= Notch::WIDEST
            && points().len() > 2
            && polyline::length(&points()) <= Notch::LONGEST_STROKE
    }

    /// Puts the strokes that stand on an outline into it: which ones.
    fn join_outline(&mut self, piece: &mut Piece, outline: usize, strokes: &[usize]) -> Vec<usize> {
        let range = piece.contours[outline].range;
        let reach = Extent::of(&self.list.points(range)).grown(self.reach());
        let is_near = |range: Range| self.list.ends_of(range).into_iter().all(|end| reach.holds(end));
        let ranges = strokes.iter().map(|&k| (k, piece.contours[k].range)).filter(|&(_, range)| is_near(range));
        let ranges: Vec<(usize, Range)> = ranges.collect();
        if ranges.is_empty() {
            return Vec::new();
        }
        let mut segments: Vec<Segment> = self.list.walk(range).map(|(_, segment)| segment).collect();
        let mut mouths = self.mouths(&segments, &ranges);
        // The outline starts outside all mouths.
        if let Some(around) = mouths.iter().find(|mouth| mouth.from > mouth.to) {
            segments = from_place(&segments, around.to);
            mouths = self.mouths(&segments, &ranges);
        }
        mouths.retain(|mouth| mouth.from < mouth.to);
        mouths.sort_by(|a, b| a.from.0.cmp(&b.from.0).then(a.from.1.total_cmp(&b.from.1)));
        let mut end = (0, 0.0);
        mouths.retain(|mouth| {
            mouth.from >= end && {
                end = mouth.to;
                true
            }
        });
        if mouths.is_empty() {
            return Vec::new();
        }
        if let Some(range) = self.list.append(with(&segments, &mouths)) {
            piece.contours[outline].range = range;
        }
        mouths.iter().map(|mouth| mouth.contour).collect()
    }

    /// How far from the edge a stroke may end, mm.
    fn reach(&self) -> f64 {
        Notch::MISS + ROUNDING * self.grid
    }

    /// The mouths of those strokes that begin and end on an outline.
    fn mouths(&mut self, outline: &[Segment], strokes: &[(usize, Range)]) -> Vec<Mouth> {
        let mut mouths = Vec::new();
        let stations: Vec<f64> = std::iter::once(0.0)
            .chain(outline.iter().scan(0.0, |sum, segment| {
                *sum += segment.length();
                Some(*sum)
            }))
            .collect();
        let round = stations[outline.len()];
        for &(contour, range) in strokes {
            let ends = self.list.ends_of(range);
            let [Some(first), Some(last)] = ends.map(|end| self.place(outline, end)) else { continue };
            let station = |(segment, share): Place| stations[segment] + share * outline[segment].length();
            let forward = (station(last) - station(first)).rem_euclid(round);
            let is_forward = forward <= round / 2.0;
            let range = if is_forward { range } else { range.reversed() };
            let segments: Vec<Segment> = self.list.walk(range).map(|(_, segment)| segment).collect();
            let [mut from, mut to] = if is_forward { [first, last] } else { [last, first] };
            // The outline starts where it ends.
            let end = (outline.len() - 1, 1.0);
            if from == end {
                from = (0, 0.0);
            }
            if to == (0, 0.0) {
                to = end;
            }
            mouths.push(Mouth { from, to, contour, segments });
        }
        mouths
    }

    /// The place of an outline nearest to a point, if that lies on it.
    fn place(&mut self, outline: &[Segment], point: Point) -> Option<Place> {
        if !self.work.spend(outline.len()) {
            return None;
        }
        let away = |segment: &Segment| polyline::distance_to_segment(point, segment.from, segment.to);
        let (nearest, distance) =
            outline.iter().map(away).enumerate().min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)))?;
        if distance > self.reach() {
            return None;
        }
        let Segment { from, to, .. } = outline[nearest];
        let share = polyline::foot(point, from, to).clamp(0.0, 1.0);
        let at = from + (to - from) * share;
        // No segment shorter than the grid is left beside a mouth.
        let share = if (at - from).norm() < self.grid {
            0.0
        } else if (at - to).norm() < self.grid {
            1.0
        } else {
            share
        };
        Some((nearest, share))
    }
}

/// An outline that starts at a place.
fn from_place(outline: &[Segment], (first, share): Place) -> Vec<Segment> {
    let Segment { from, to, .. } = outline[first];
    let at = if share == 1.0 { to } else { from + (to - from) * share };
    let halves = [Segment { from: at, ..outline[first] }, Segment { to: at, ..outline[first] }];
    let between = outline[first + 1..].iter().chain(&outline[..first]).copied();
    let all = std::iter::once(halves[0]).chain(between).chain([halves[1]]);
    all.filter(|segment| segment.from != segment.to).collect()
}

/// An outline with strokes in place of the edge over their mouths, which are in order.
fn with(outline: &[Segment], mouths: &[Mouth]) -> Vec<Segment> {
    let at = |(segment, share): Place| {
        let Segment { from, to, .. } = outline[segment];
        if share == 1.0 { to } else { from + (to - from) * share }
    };
    let mut all: Vec<Segment> = Vec::with_capacity(outline.len() + mouths.len());
    let mut add = |segment: Segment| {
        if segment.from != segment.to {
            all.push(segment);
        }
    };
    let mut start: Place = (0, 0.0);
    for mouth in mouths {
        for (k, segment) in outline.iter().enumerate().take(mouth.from.0 + 1).skip(start.0) {
            let from = if k == start.0 { at(start) } else { segment.from };
            let to = if k == mouth.from.0 { at(mouth.from) } else { segment.to };
            add(Segment { from, to, ..*segment });
        }
        let last = mouth.segments.len() - 1;
        for (k, segment) in mouth.segments.iter().enumerate() {
            let from = if k == 0 { at(mouth.from) } else { segment.from };
            let to = if k == last { at(mouth.to) } else { segment.to };
            add(Segment { from, to, ..*segment });
        }
        start = mouth.to;
    }
    for (k, segment) in outline.iter().enumerate().skip(start.0) {
        let from = if k == start.0 { at(start) } else { segment.from };
        add(Segment { from, ..*segment });
    }
    all
}
