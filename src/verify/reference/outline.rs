//! A contour as lines: parted at its corners, each line with its tolerance band and with how fast the tip may be on it.
//!
//! Corners and the tolerance band are found anew from the marker and the profile; see the module doc of the stage.

use std::borrow::Cow;

use super::caps::{End, Feeds};
use super::line::{Line, OfCut};
use super::near::Near;
use super::notches;
use super::vertex::Vertex;
use crate::geom::{Point, angle, corner};
use crate::ir::Marker;
use crate::ir::list::{Segment, SegmentList};
use crate::ir::marker::{Contour, Cut, OutlineNotch, Piece};
use crate::machine::{Fit, MachineProfile, Notches};

/// Longest chord that counts as a chord of a curve, mm.
const CURVE_CHORD: f64 = 25.0;

/// Ways along a contour that differ by less are the same, mm: rounding of their sums.
const SAME_WAY: f64 = 1e-6;

/// Smaller turns are none, rad.
const TURN_EPSILON: f64 = 1e-6;

/// What the lines of a contour have in common.
#[derive(Clone, Copy)]
pub(in crate::verify) struct OfContour<'a> {
    /// Index of its piece, and its rank.
    pub(in crate::verify) owner: [u32; 2],
    /// Its place among the cuts of its piece.
    pub(in crate::verify) cut: u32,
    /// How fast the tip may be in its piece.
    pub(in crate::verify) feeds: Feeds<'a>,
    /// Where it may have to be slower; `None` where it may not.
    pub(in crate::verify) near: Option<&'a Near<'a>>,
    pub(in crate::verify) profile: &'a MachineProfile,
    /// What the points of the marker are rounded to, mm; 0 = nothing.
    pub(in crate::verify) unit: f64,
}

/// What is cut of a contour.
pub(in crate::verify) struct Outline<'a> {
    /// From the first corner on, once that is found.
    segments: Vec<Segment>,
    /// How it turns where each of them starts, rad.
    turns: Vec<f64>,
    closed: bool,
    /// Whether it is the edge of a part.
    bounds: bool,
    /// The points between the segments where the marker keeps them side by side, from its start on; else none.
    points: &'a [Point],
    /// The place of the first segment among those of the marker.
    first: usize,
    /// Length of the contour from its start as it is drawn to that, mm.
    before: f64,
    /// Length from there to each segment, and of all, mm.
    stations: Vec<f64>,
}

impl<'a> Outline<'a> {
    /// A contour of a piece, and the notches that it makes and that are cut otherwise than they are drawn, with their
    /// speeds.
    pub(in crate::verify) fn new(
        contour: &Contour,
        piece: &Piece,
        marker: &'a Marker,
        notch: Notches,
    ) -> (Self, Vec<(OutlineNotch, u8)>) {
        let mut segments: Vec<Segment> = marker.list.walk(contour.range).map(|(_, segment)| segment).collect();
        let replaced = notches::straighten(&mut segments, piece, notch);
        let points = match marker.list.points(contour.range) {
            Cow::Borrowed(points) if replaced.is_empty() => points,
            Cow::Borrowed(_) | Cow::Owned(_) => &[],
        };
        (Self::of_segments(segments, points, contour.closed), replaced)
    }

    /// A cut of a piece whose contours are not all cut with it: these are its edges, whatever is cut of them.
    pub(in crate::verify) fn of_cut(cut: &Cut, list: &'a SegmentList) -> Self {
        let segments = list.walk(cut.range).map(|(_, segment)| segment).collect();
        Self { bounds: false, ..Self::of_segments(segments, &[], cut.kind.is_closed()) }
    }

    /// Its segments, as they are cut.
    pub(in crate::verify) fn segments(&self) -> &[Segment] {
        &self.segments
    }

    fn of_segments(segments: Vec<Segment>, points: &'a [Point], closed: bool) -> Self {
        let count = segments.len();
        let before = |i: usize| &segments[(i + count - 1) % count];
        let way = |segment: &Segment| segment.to - segment.from;
        let turns = (0..count).map(|i| angle::turn(way(before(i)), way(&segments[i]))).collect();
        Self { segments, turns, closed, bounds: closed, points, first: 0, before: 0.0, stations: Vec::new() }
    }

    /// Its lines, which end at its corners.
    pub(in crate::verify) fn lines(mut self, place: OfContour) -> Vec<Line<'a>> {
        let limit = place.profile.corner_angle();
        let is_corner = |i: &usize| self.segments[*i].joint.lift || self.is_corner(*i, limit, place.unit);
        let mut corners: Vec<usize> = (0..self.segments.len()).filter(is_corner).collect();
        let count = self.segments.len();
        // Where a contour ends no corner lies before the tip.
        let mut ends = vec![0];
        let mut ring = false;
        if self.closed {
            match corners.first() {
                Some(&first) => {
                    ends = nearest_to_start(&self.segments, &corners).map(|i| i - first).collect();
                    self.before = self.segments[..first].iter().map(Segment::length).sum();
                    self.segments.rotate_left(first);
                    self.turns.rotate_left(first);
                    self.first = first;
                    corners = corners.into_iter().map(|corner| corner - first).collect();
                }
                None => ring = true,
            }
        }
        self.stations = stations(&self.segments);
        let end = |vertex: usize| if ring || ends.contains(&(vertex % count)) { End::Plain } else { End::AtCorner };
        let mut from = 0;
        let stops = corners.into_iter().filter(|&corner| corner > 0).chain([count]);
        let line = |to: usize| {
            let line = self.line([from, to], ring, [end(from), end(to)], place);
            from = to;
            line
        };
        stops.map(line).collect()
    }

    /// Whether the contour turns by more than `limit` rad where a segment starts, and not by the rounding of its points to
    /// `unit` mm alone.
    fn is_corner(&self, i: usize, limit: f64, unit: f64) -> bool {
        let (before, behind) = self.segments.split_at(i);
        let round: &[Segment] = if self.closed { &self.segments } else { &[] };
        let from = before.iter().rev().chain(round[i.min(round.len())..].iter().rev()).map(|segment| segment.from);
        let to = behind.iter().chain(&round[..i.min(round.len())]).map(|segment| segment.to);
        corner::is_corner(self.segments[i].from, &from, &to, limit, unit)
    }

    /// The line of the segments from one up to another; `ends` are how it starts and how it ends.
    fn line(&self, [from, to]: [usize; 2], ring: bool, ends: [End; 2], place: OfContour) -> Line<'a> {
        let OfContour { owner, cut, feeds, profile, near, .. } = place;
        let chords = &self.segments[from..to];
        let turn_at = |k: usize| match (k == 0 || k == chords.len(), ring) {
            (true, false) => 0.0,
            (true, true) => self.turns[0],
            (false, _) => self.turns[from + k],
        };
        let sagitta = |k: usize| sagitta(&chords[k], [turn_at(k), turn_at(k + 1)], profile);
        let path = path(chords, sagitta);
        let percents = chords.iter().map(|chord| chord.percent);
        let near = near.map_or_else(Vec::new, |near| near.along(owner[0], chords));
        let caps = feeds.both_ways(&path, percents, ends, &near);
        let cut = OfCut {
            index: cut,
            offset: self.before + self.stations[from],
            round: self.closed.then(|| self.stations[self.segments.len()]),
            bounds: self.bounds,
            is_edge: false,
            is_bare: self.segments.iter().any(|segment| segment.joint.full_advance || segment.joint.no_overcut),
        };
        Line::new(owner, cut, self.points([from, to]), path, caps, ring)
    }

    /// The points of the segments from one up to another: those of the marker, but for a line over its start.
    fn points(&self, [from, to]: [usize; 2]) -> Cow<'a, [Point]> {
        let first = (self.first + from) % self.segments.len();
        let chords = &self.segments[from..to];
        let last = chords.last().map(|chord| chord.to);
        let own = || Cow::Owned(chords.iter().map(|chord| chord.from).chain(last).collect());
        self.points.get(first..=first + chords.len()).map_or_else(own, Cow::Borrowed)
    }
}

/// What is known of the points of a line of these chords; `bulge` gives the bulge of each.
fn path(chords: &[Segment], sagitta: impl Fn(usize) -> f32) -> Box<[Vertex]> {
    let mut path = Vec::with_capacity(chords.len() + 1);
    let mut station = 0.0;
    for (k, chord) in chords.iter().enumerate() {
        path.push(Vertex { station, sagitta: sagitta(k), block: chord.span.block });
        station += chord.length();
    }
    path.push(Vertex { station, sagitta: 0.0, block: chords[chords.len() - 1].span.block });
    path.into()
}

/// Length of segments from the first to each, and of all, mm.
fn stations(segments: &[Segment]) -> Vec<f64> {
    let mut stations = Vec::with_capacity(segments.len() + 1);
    let mut length = 0.0;
    stations.push(length);
    stations.extend(segments.iter().map(|segment| {
        length += segment.length();
        length
    }));
    stations
}

/// The corners of a closed contour at which it may begin, and end: those least far along it from its start in the file.
fn nearest_to_start<'a>(segments: &[Segment], corners: &'a [usize]) -> impl Iterator<Item = usize> + 'a {
    let stations = stations(segments);
    let length = stations[segments.len()];
    let away = move |i: &usize| stations[*i].min(length - stations[*i]);
    let least = corners.iter().map(&away).fold(f64::INFINITY, f64::min);
    corners.iter().copied().filter(move |i| away(i) <= least + SAME_WAY)
}

/// On a chord between two turns to the same side the curve that was flattened lies outside, by about length * turn / 8.
fn sagitta(segment: &Segment, turns: [f64; 2], profile: &MachineProfile) -> f32 {
    let length = segment.length();
    let is_turn = |turn: &f64| turn.abs() > TURN_EPSILON && turn.abs() < profile.corner_angle();
    let curved = turns[0] * turns[1] > 0.0 && turns.iter().all(is_turn);
    if profile.path.fit == Fit::Polygon || !curved || length > CURVE_CHORD {
        return 0.0;
    }
    let mean = f64::midpoint(turns[0], turns[1]);
    let sagitta = (length * mean.abs() / 8.0).min(profile.path.chord_sag_max_mm);
    (-mean.signum() * sagitta / length) as f32
}
