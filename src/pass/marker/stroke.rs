//! Stroke: a notch that a drawing draws as an open stroke between two places of an outline becomes a part of that outline.
//!
//! Needs: welded contours. The stroke replaces the edge over its mouth, as if the file drew the notch in the outline, so that
//! all later passes see the same notches for both kinds of drawing. Leaves true: outlines stay closed, each stroke that is part
//! of one is listed as its notch, and a stroke that overlaps the mouth of another one stays a contour of its own. Cutter files
//! are left alone: their cuts are meant.

use super::pass::MarkerPass;
use super::search;
use crate::diagnostic::Diagnostics;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, cross, polyline};
use crate::ir::list::{Range, Segment, SegmentList};
use crate::ir::marker::{Contour, Marker, Notch, NotchForm, OutlineNotch, Piece};
use crate::machine::Job;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "stroke", about: "makes notches that are drawn from edge to edge part of their outlines", run };

/// Distance by which rounding moves a place: in units of the file, or in mm without a grid.
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
    /// Distance within which places are one, mm.
    grid: f64,
    work: Budget,
}

/// A place on an outline: the index of a segment, and the share of it.
type Place = (usize, f64);

/// A stroke between two places of an outline, in the direction of the outline.
struct Mouth {
    from: Place,
    to: Place,
    /// Its contour in the piece.
    contour: usize,
    segments: Vec<Segment>,
}

impl Mouth {
    /// Its notch in an outline; the form is that of a notch that is neither a V nor a castle.
    fn notch(&self, outline: &[Segment]) -> OutlineNotch {
        let mouth = [self.from, self.to].map(|place| at(outline, place));
        let depth = |segment: &&Segment| polyline::distance_to_segment(segment.to, mouth[0], mouth[1]);
        let deepest = self.segments.iter().max_by(|a, b| depth(a).total_cmp(&depth(b)));
        let Segment { to: tip, span, .. } = *deepest.expect("a stroke has segments");
        let segments = u32::try_from(self.segments.len()).expect("a stroke has few segments");
        OutlineNotch { form: NotchForm::U, outwards: false, mouth, tip, segments, span }
    }
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
        let points = || self.list.points(contour.range);
        let longest = Notch::MOST_TOUCHING as f64 * Notch::LONGEST_STROKE;
        !contour.closed && points().len() > 2 && polyline::length(&points()) <= longest
    }

    /// Puts the strokes that stand on an outline into it, and returns their indices.
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
        mouths.sort_by(|a, b| a.from.0.cmp(&b.from.0).then(a.from.1.total_cmp(&b.from.1)));
        let mut end = (0, 0.0);
        let mut left: Vec<usize> = Vec::new();
        for mouth in &mouths {
            if mouth.from < mouth.to && mouth.from >= end {
                end = mouth.to;
            } else {
                left.push(mouth.contour);
            }
        }
        // A stroke that draws several notches is taken whole or not at all.
        mouths.retain(|mouth| !left.contains(&mouth.contour));
        if mouths.is_empty() {
            return Vec::new();
        }
        if let Some(range) = self.list.append(with(&segments, &mouths)) {
            piece.contours[outline].range = range;
            piece.outline_notches.extend(mouths.iter().map(|mouth| mouth.notch(&segments)));
        }
        mouths.iter().map(|mouth| mouth.contour).collect()
    }

    /// Greatest distance of a stroke's end from the edge, mm.
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
            let Some(notches) = self.notches(outline, range) else { continue };
            for segments in notches {
                let ends = [segments[0].from, segments[segments.len() - 1].to];
                let [Some(first), Some(last)] = ends.map(|end| self.place(outline, end)) else { continue };
                let station = |(segment, share): Place| stations[segment] + share * outline[segment].length();
                let forward = (station(last) - station(first)).rem_euclid(round);
                let is_forward = forward <= round / 2.0;
                let [mut from, mut to] = if is_forward { [first, last] } else { [last, first] };
                // The outline starts where it ends.
                let end = (outline.len() - 1, 1.0);
                if from == end {
                    from = (0, 0.0);
                }
                if to == (0, 0.0) {
                    to = end;
                }
                let segments = if is_forward { segments } else { reversed(&segments) };
                mouths.push(Mouth { from, to, contour, segments });
            }
        }
        mouths
    }

    /// The segments of each notch of a stroke, which comes back to the outline between two notches that touch; `None` if one of
    /// them is no notch.
    fn notches(&mut self, outline: &[Segment], range: Range) -> Option<Vec<Vec<Segment>>> {
        let segments: Vec<Segment> = self.list.walk(range).map(|(_, segment)| segment).collect();
        let [start, end] = self.list.ends_of(range);
        let side = |segment: &Segment| cross(end - start, segment.to - start);
        let deepest = segments.iter().map(side).max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
        let mut notches: Vec<Vec<Segment>> = Vec::new();
        let mut rest = &segments[..];
        while let Some(first) = rest.first() {
            let mut off = Vec::with_capacity(rest.len());
            for segment in rest {
                let edges = outline.iter().map(|edge| polyline::distance_to_segment(segment.to, edge.from, edge.to));
                let distance = self.work.spend(outline.len()).then(|| edges.fold(f64::INFINITY, f64::min))?;
                // An end past the edge lies on the other side.
                off.push(if side(segment) * deepest < 0.0 { 0.0 } else { distance });
            }
            let is_off = |distance: &f64| *distance > self.reach();
            // Between two notches it is nearest to the outline before it leaves it again.
            let count = off.iter().position(is_off).and_then(|deep| {
                let back = deep + off[deep..].iter().position(|distance| !is_off(distance))?;
                let again = back + off[back..].iter().position(is_off)?;
                let nearest = (back..again).min_by(|&a, &b| off[a].total_cmp(&off[b]))?;
                Some(nearest + 1)
            });
            let (notch, others) = rest.split_at(count.unwrap_or(rest.len()));
            let mouth = (notch[notch.len() - 1].to - first.from).norm();
            let length: f64 = notch.iter().map(Segment::length).sum();
            if notch.len() < 2 || mouth > Notch::WIDEST || length > Notch::LONGEST_STROKE {
                return None;
            }
            notches.push(notch.to_vec());
            rest = others;
        }
        (notches.len() <= Notch::MOST_TOUCHING).then_some(notches)
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
        // Segments beside a mouth must not be shorter than the grid.
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
    let at = at(outline, (first, share));
    let halves = [Segment { from: at, ..outline[first] }, Segment { to: at, ..outline[first] }];
    let between = outline[first + 1..].iter().chain(&outline[..first]).copied();
    let all = std::iter::once(halves[0]).chain(between).chain([halves[1]]);
    all.filter(|segment| segment.from != segment.to).collect()
}

/// A line in the other direction.
fn reversed(segments: &[Segment]) -> Vec<Segment> {
    segments.iter().rev().map(|segment| Segment { from: segment.to, to: segment.from, ..*segment }).collect()
}

/// A place of an outline.
fn at(outline: &[Segment], (segment, share): Place) -> Point {
    let Segment { from, to, .. } = outline[segment];
    if share == 1.0 { to } else { from + (to - from) * share }
}

/// An outline with strokes in place of the edge over their mouths, which are in order.
fn with(outline: &[Segment], mouths: &[Mouth]) -> Vec<Segment> {
    let at = |place: Place| at(outline, place);
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
