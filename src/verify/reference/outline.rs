//! Division of a contour into lines at its corners, each with its tolerance band and speed caps.
//!
//! Corners and tolerance band are derived from the marker and the profile alone; see the module documentation of the stage.

use std::borrow::Cow;

use super::caps::{End, Feeds};
use super::line::{Line, OfCut};
use super::near::Near;
use super::notches;
use super::vertex::Vertex;
use crate::geom::corner::Corners;
use crate::geom::{Point, angle};
use crate::ir::Marker;
use crate::ir::list::{Segment, SegmentList};
use crate::ir::marker::{Contour, Cut, OutlineNotch, Piece};
use crate::machine::{Fit, MachineProfile, Notches};

/// Longest chord that counts as part of a curve, mm.
const CURVE_CHORD: f64 = 25.0;

/// Difference below which two lengths along a contour are equal, mm: rounding of their sums.
const SAME_WAY: f64 = 1e-6;

/// Turns up to this angle count as none, rad.
const TURN_EPSILON: f64 = 1e-6;

/// Common properties of the lines of a contour.
#[derive(Clone, Copy)]
pub(in crate::verify) struct OfContour<'a> {
    /// Index of the piece, and rank of the contour.
    pub(in crate::verify) owner: [u32; 2],
    /// Index among the cuts of the piece.
    pub(in crate::verify) cut: u32,
    /// Feeds of the piece.
    pub(in crate::verify) feeds: Feeds<'a>,
    /// Near edges, where the tip may have to be slower; `None` without that option.
    pub(in crate::verify) near: Option<&'a Near<'a>>,
    pub(in crate::verify) profile: &'a MachineProfile,
    /// Rounding unit of the marker's points, mm; 0 = none.
    pub(in crate::verify) unit: f64,
}

/// Part of a contour that is cut.
pub(in crate::verify) struct Outline<'a> {
    /// Segments, starting at the first corner once that is found.
    segments: Vec<Segment>,
    /// Turn at the start of each segment, rad.
    turns: Vec<f64>,
    closed: bool,
    /// True for the edge of a part.
    bounds: bool,
    /// True if codes of the file may forbid overlaps at its ends.
    is_bare: bool,
    /// Points between the segments, from the start of the contour, if the marker keeps them adjacent; otherwise empty.
    points: &'a [Point],
    /// Index of the first segment among those of the marker.
    first: usize,
    /// Length of the contour from its drawn start to the first segment, mm.
    before: f64,
    /// Length from the first segment to each segment, and total length, mm.
    stations: Vec<f64>,
}

impl<'a> Outline<'a> {
    /// Outline of a contour of a piece, and its notches that are not cut as drawn, with their speeds in percent.
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

    /// Outline of a cut of a piece that shares cuts with others: the edge of the part is its contours, not this cut.
    pub(in crate::verify) fn of_cut(cut: &Cut, list: &'a SegmentList) -> Self {
        let segments = list.walk(cut.range).map(|(_, segment)| segment).collect();
        Self { bounds: false, ..Self::of_segments(segments, &[], cut.kind.is_closed()) }
    }

    /// Segments as they are cut.
    pub(in crate::verify) fn segments(&self) -> &[Segment] {
        &self.segments
    }

    fn of_segments(segments: Vec<Segment>, points: &'a [Point], closed: bool) -> Self {
        let count = segments.len();
        let before = |i: usize| &segments[(i + count - 1) % count];
        let way = |segment: &Segment| segment.to - segment.from;
        let turns = (0..count).map(|i| angle::turn(way(before(i)), way(&segments[i]))).collect();
        let is_bare = segments.iter().any(|segment| segment.joint.full_advance || segment.joint.no_overcut);
        Self { segments, turns, closed, bounds: closed, is_bare, points, first: 0, before: 0.0, stations: Vec::new() }
    }

    /// Lines of the contour, which end at its corners.
    pub(in crate::verify) fn lines(mut self, place: OfContour) -> Vec<Line<'a>> {
        let limit = place.profile.corner_angle();
        let (count, closed) = (self.segments.len(), self.closed);
        // An open contour has one more vertex than segments.
        let vertices = if closed { count } else { count + 1 };
        let point = |i: usize| self.segments.get(i).map_or_else(|| self.segments[count - 1].to, |next| next.from);
        let places = Corners { point, count: vertices, is_ring: closed, limit, unit: place.unit };
        let is_corner = |i: &usize| self.segments[*i].joint.lift || places.is_at(*i);
        let mut corners: Vec<usize> = (0..count).filter(is_corner).collect();
        // At an end of the contour the tip does not slow down for a corner.
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

    /// Line of a range of segments; `ends` are the kinds of its start and end.
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
            is_bare: self.is_bare,
        };
        Line::new(owner, cut, self.points([from, to]), path, caps, ring)
    }

    /// Points of a range of segments: borrowed from the marker unless the line passes the start of the contour.
    fn points(&self, [from, to]: [usize; 2]) -> Cow<'a, [Point]> {
        let first = (self.first + from) % self.segments.len();
        let chords = &self.segments[from..to];
        let last = chords.last().map(|chord| chord.to);
        let own = || Cow::Owned(chords.iter().map(|chord| chord.from).chain(last).collect());
        self.points.get(first..=first + chords.len()).map_or_else(own, Cow::Borrowed)
    }
}

/// Stations, bulges and blocks of the points of a line; `sagitta` returns the bulge of each chord.
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

/// Length from the first segment to each segment, and total length, mm.
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

/// Corners of a closed contour at which it may begin and end: those closest along it to its start in the file.
fn nearest_to_start<'a>(segments: &[Segment], corners: &'a [usize]) -> impl Iterator<Item = usize> + 'a {
    let stations = stations(segments);
    let length = stations[segments.len()];
    let away = move |i: &usize| stations[*i].min(length - stations[*i]);
    let least = corners.iter().map(&away).fold(f64::INFINITY, f64::min);
    corners.iter().copied().filter(move |i| away(i) <= least + SAME_WAY)
}

/// Bulge of a chord, in lengths of the chord: between two turns to the same side, the flattened curve lies outside the chord by
/// about length * turn / 8.
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
