//! What must be cut, as lines: the stretches of contours between corners, and the slits.
//!
//! Corners and the tube are found anew from the marker and the profile; see the module doc of the stage.

use std::ops::RangeInclusive;

use rayon::prelude::*;

use super::caps::{Caps, End, Feeds};
use super::chord;
use super::nibbles::{self, Blade};
use super::notches;
use super::winding::Winding;
use crate::geom::{Point, Vector, angle, left, polyline};
use crate::ir::Marker;
use crate::ir::list::Segment;
use crate::ir::marker::{Piece, Stroke};
use crate::machine::{Fit, Follow, MachineProfile, TightCurves};

/// Longest chord that counts as a chord of a curve, mm.
const CURVE_CHORD: f64 = 25.0;

/// Ways along a contour that differ by less are the same, mm: rounding of their sums.
const SAME_WAY: f64 = 1e-6;

/// Smaller turns are none, rad.
const TURN_EPSILON: f64 = 1e-6;

/// A stretch that is cut from one end to the other, mm.
#[derive(Debug)]
pub(super) struct Line {
    /// Index of its piece.
    pub(super) piece: usize,
    /// Rank of its contour or slit among events, holes, slits and contours, in cut order.
    pub(super) rank: usize,
    /// Its points; a ring ends with its first one.
    pub(super) points: Box<[Point]>,
    /// Length from the first point to each point.
    pub(super) stations: Box<[f64]>,
    /// Source block of each chord.
    pub(super) blocks: Box<[u32]>,
    /// How fast the tip may be, with the line and, by the way from its end, against it: before a corner it may have to be
    /// slower.
    caps: [Caps; 2],
    /// Outward bulge of each chord in its middle, to its left, in lengths of the chord.
    bulges: Box<[f64]>,
    /// Whether it is a closed contour without a corner.
    pub(super) ring: bool,
    /// Whether C cannot follow it in one: then the knife is lifted amid it.
    pub(super) winds: bool,
    /// By the stations of tail and tip: where it is too tight for the blade to be its chord.
    pub(super) tight: Box<[[f64; 2]]>,
    /// By stations: where it may be nibbled, which is cut by plunges without motion.
    pub(super) nibbled: Box<[[f64; 2]]>,
}

/// All lines of a marker.
#[derive(Debug)]
pub(super) struct Reference<'a> {
    /// The marker that they come from.
    pub(super) marker: &'a Marker,
    /// The lines, in cut order.
    pub(super) lines: Vec<Line>,
    /// Ranks of the holes, in the order of the marker.
    pub(super) holes: Vec<usize>,
    /// Ranks of the events, in the order of the marker.
    pub(super) events: Vec<usize>,
    /// Permitted deviation of the tip, mm.
    pub(super) tolerance: f64,
}

impl<'a> Reference<'a> {
    /// The lines of `marker`.
    pub(super) fn new(marker: &'a Marker, profile: &MachineProfile) -> Self {
        let of_pieces: Vec<OfPiece> = marker
            .pieces
            .par_iter()
            .enumerate()
            .map(|(index, piece)| OfPiece::new(index, (piece, marker), profile))
            .collect();
        let count = of_pieces.iter().map(|piece| piece.lines.len()).sum();
        let (mut lines, mut holes, mut events) = (Vec::with_capacity(count), Vec::new(), Vec::new());
        let mut first = 0;
        for (piece, OfPiece { ranks, lines: mut of_piece }) in marker.pieces.iter().zip(of_pieces) {
            events.extend((first..).take(piece.events.len()));
            holes.extend((first + piece.events.len()..).take(piece.drills.len()));
            for line in &mut of_piece {
                line.rank += first;
            }
            lines.append(&mut of_piece);
            first += ranks;
        }
        events.extend((first..).take(marker.closing.len()));
        Self { marker, lines, holes, events, tolerance: profile.tolerance(marker.unit) }
    }
}

/// What is cut of a piece.
struct OfPiece {
    /// Its lines, their ranks counted from those of the piece.
    lines: Vec<Line>,
    /// How many ranks the piece has.
    ranks: usize,
}

impl OfPiece {
    fn new(index: usize, (piece, marker): (&Piece, &Marker), profile: &MachineProfile) -> Self {
        // Events come first, then holes, then slits, then contours.
        let mut ranks = piece.events.len() + piece.drills.len()..;
        let mut rank = || ranks.next().expect("a marker has fewer lines than numbers");
        let feeds = Feeds::new(profile, piece);
        let mut replaced = Vec::new();
        let outlines: Vec<Vec<Segment>> = piece
            .contours
            .iter()
            .map(|contour| {
                let mut outline = marker.list.walk(contour.range).map(|(_, segment)| segment).collect();
                replaced.extend(notches::straighten(&mut outline, piece, profile.notch));
                outline
            })
            .collect();
        let slits = notches::slits(piece, profile.notch, &replaced);
        let slits = slits.iter().map(|(stroke, percent)| slit(stroke, [index, rank()], feeds.at(*percent)));
        let mut lines: Vec<Line> = slits.collect();
        for (contour, outline) in piece.contours.iter().zip(outlines) {
            let place = Place { owner: [index, rank()], feeds, profile };
            lines.extend(contour_lines(outline, contour.closed, place));
        }
        if let Some(range) = profile.blade_range() {
            for line in &mut lines {
                line.winds = Winding::new(line, profile).is_past(range);
            }
        }
        let (knife, tolerance) = (&profile.knife, profile.tolerance(marker.unit));
        for line in &mut lines {
            // What begins on a curve that the blade has no way to enter may be nibbled, whatever is done about others.
            let is_lifted = line.winds || knife.longest_cut().is_some_and(|longest| line.length() > longest);
            let blade = Blade { knife, tolerance };
            let ends = if is_lifted || line.ring { [0.0; 2] } else { nibbles::bowed_ends(&line.points, blade) };
            let is_bowed = ends != [0.0; 2] || is_lifted && nibbles::bows_anywhere(line, blade);
            let is_nibbling = knife.tight_curves == TightCurves::Nibble;
            if is_bowed || is_nibbling || knife.follow == Follow::Chord {
                line.tight = chord::tight(&line.points, line.ring, knife).into();
            }
            line.nibbled = match is_bowed || is_nibbling && !line.tight.is_empty() {
                false => Box::default(),
                true if is_lifted => Box::new([[f64::NEG_INFINITY, f64::INFINITY]]),
                true => nibbles::stretches(line, ends, blade),
            };
        }
        Self { lines, ranks: rank() }
    }
}

/// What the lines of a contour have in common.
#[derive(Clone, Copy)]
struct Place<'a> {
    /// Index of its piece, and its rank.
    owner: [usize; 2],
    feeds: Feeds<'a>,
    profile: &'a MachineProfile,
}

/// The line of a slit, `cap` mm/s being the greatest speed of the tip.
fn slit(stroke: &Stroke, [piece, rank]: [usize; 2], cap: f64) -> Line {
    let points = Box::new([stroke.from, stroke.to]);
    Line {
        caps: [Caps::all(cap), Caps::all(cap)],
        piece,
        rank,
        stations: polyline::stations(&*points).into(),
        points,
        blocks: Box::new([stroke.span.block]),
        bulges: Box::new([0.0]),
        ring: false,
        winds: false,
        tight: Box::default(),
        nibbled: Box::default(),
    }
}

/// Cuts a contour at its corners.
fn contour_lines(mut segments: Vec<Segment>, closed: bool, place: Place) -> Vec<Line> {
    let Place { owner, feeds, profile } = place;
    let mut lines = Vec::new();
    let count = segments.len();
    // At the start of each segment.
    let mut turns: Vec<f64> = Vec::with_capacity(count);
    for i in 0..count {
        let before = &segments[(i + count - 1) % count];
        turns.push(angle::turn(before.to - before.from, segments[i].to - segments[i].from));
    }
    let limit = profile.corner.angle();
    let is_corner = |i: usize, segments: &[Segment], turns: &[f64]| segments[i].joint.lift || turns[i].abs() > limit;
    let mut ring = false;
    // Where a contour ends no corner lies before the tip.
    let mut ends = vec![0];
    if closed {
        let corners: Vec<usize> = (0..count).filter(|&i| is_corner(i, &segments, &turns)).collect();
        match corners.first() {
            Some(&first) => {
                ends = nearest_to_start(&segments, &corners).map(|i| i - first).collect();
                segments.rotate_left(first);
                turns.rotate_left(first);
            }
            None => ring = true,
        }
    }
    let mut from = 0;
    for i in 1..=count {
        if i == count || is_corner(i, &segments, &turns) {
            let inner = i - from;
            let turn_at = |k: usize| match (k == 0 || k == inner, ring) {
                (true, false) => 0.0,
                (true, true) => turns[0],
                (false, _) => turns[from + k],
            };
            let bends: Vec<f64> = (0..=inner).map(turn_at).collect();
            let points: Box<[Point]> =
                std::iter::once(segments[from].from).chain(segments[from..i].iter().map(|s| s.to)).collect();
            let chords = segments[from..i].iter();
            let [piece, rank] = owner;
            let stations: Box<[f64]> = polyline::stations(&points).into();
            let limits: Vec<f64> = chords.clone().map(|s| feeds.at(s.percent)).collect();
            let end = |vertex: usize| if ring || ends.contains(&(vertex % count)) { End::Plain } else { End::AtCorner };
            lines.push(Line {
                piece,
                rank,
                caps: feeds.both_ways(&stations, limits, [end(from), end(i)]),
                stations,
                points,
                blocks: chords.clone().map(|s| s.span.block).collect(),
                bulges: chords.zip(bends.windows(2)).map(|(s, t)| bulge(s, t, profile)).collect(),
                ring,
                winds: false,
                tight: Box::default(),
                nibbled: Box::default(),
            });
            from = i;
        }
    }
    lines
}

/// The corners of a closed contour at which it may begin, and end: those least far along it from its start in the file.
fn nearest_to_start<'a>(segments: &[Segment], corners: &'a [usize]) -> impl Iterator<Item = usize> + 'a {
    let mut stations = vec![0.0];
    for segment in segments {
        stations.push(stations[stations.len() - 1] + segment.length());
    }
    let length = stations[segments.len()];
    let away = move |i: &usize| stations[*i].min(length - stations[*i]);
    let least = corners.iter().map(&away).fold(f64::INFINITY, f64::min);
    corners.iter().copied().filter(move |i| away(i) <= least + SAME_WAY)
}

/// On a chord between two turns to the same side the curve that was flattened lies outside, by about length * turn / 8.
fn bulge(segment: &Segment, turns: &[f64], profile: &MachineProfile) -> f64 {
    let length = segment.length();
    let is_turn = |turn: &f64| turn.abs() > TURN_EPSILON && turn.abs() < profile.corner.angle();
    let curved = turns[0] * turns[1] > 0.0 && turns.iter().all(is_turn);
    if profile.path.fit == Fit::Polygon || !curved || length > CURVE_CHORD {
        return 0.0;
    }
    let mean = f64::midpoint(turns[0], turns[1]);
    let sagitta = (length * mean.abs() / 8.0).min(profile.path.chord_sag_max_mm);
    -mean.signum() * sagitta / length
}

/// A chord of a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chord {
    pub(super) index: usize,
    /// Where it starts, and the station of that, mm.
    from: Point,
    start: f64,
    /// mm.
    length: f64,
    /// Unit vector along it.
    pub(super) along: Vector,
    /// From its middle to where the core of the tube reaches there.
    bulge: Vector,
}

impl Chord {
    /// Distance of a point from the tube's core beside it, mm, and the station of the foot. The core at a place of the
    /// chord is the segment from the chord to its bulge there.
    pub(super) fn deviation(&self, point: Point) -> (f64, f64) {
        let from = point - self.from;
        if self.length == 0.0 {
            return (from.norm(), self.start);
        }
        let way = from.dot(&self.along).clamp(0.0, self.length);
        let away = from - self.along * way;
        if self.bulge == Vector::zeros() {
            return (away.norm(), self.start + way);
        }
        let share = way / self.length;
        let reach = self.bulge * (4.0 * share * (1.0 - share));
        let height = reach.norm();
        if height == 0.0 {
            return (away.norm(), self.start + way);
        }
        let outward = reach / height;
        let used = away.dot(&outward).clamp(0.0, height);
        ((away - outward * used).norm(), self.start + way)
    }
}

impl Line {
    /// Its length, mm.
    pub(super) fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// Number of chords.
    pub(super) fn chords(&self) -> usize {
        self.blocks.len()
    }

    /// Unit vector along a chord.
    pub(super) fn direction(&self, chord: usize) -> Vector {
        (self.points[chord + 1] - self.points[chord]) / (self.stations[chord + 1] - self.stations[chord])
    }

    /// One of its chords.
    pub(super) fn chord(&self, index: usize) -> Chord {
        let (start, length) = (self.stations[index], self.stations[index + 1] - self.stations[index]);
        let way = self.points[index + 1] - self.points[index];
        Chord {
            index,
            from: self.points[index],
            start,
            length,
            along: way / length,
            bulge: left(way) * self.bulges[index],
        }
    }

    /// Whether a point may be nearer than `reach` mm to the tube's core beside a chord, as far as its box tells.
    pub(super) fn may_reach(&self, chord: usize, point: Point, reach: f64) -> bool {
        let bulge = self.bulges[chord].abs() * (self.stations[chord + 1] - self.stations[chord]);
        let (from, to) = (self.points[chord] - point, self.points[chord + 1] - point);
        let reach = reach + bulge;
        let is_between = |a: f64, b: f64| a.min(b) <= reach && a.max(b) >= -reach;
        is_between(from.x, to.x) && is_between(from.y, to.y)
    }

    /// The vertices between two stations; on a ring these may lie on any lap, and its last point is left to its first.
    pub(super) fn vertices(&self, low: f64, high: f64) -> impl Iterator<Item = usize> + '_ {
        let length = self.length();
        let count = if self.ring { self.chords() } else { self.points.len() };
        let lap = if self.ring { (low / length).floor() } else { 0.0 };
        let first = self.stations[..count].partition_point(|&s| s + lap * length < low);
        let laps = if self.ring { usize::MAX } else { count };
        let station = move |i: usize| self.stations[i % count] + (lap + (i / count) as f64) * length;
        (first..laps).take_while(move |&i| station(i) <= high).map(move |i| i % count)
    }

    /// Whether it is too tight for the blade somewhere between two stations.
    pub(super) fn is_tight(&self, [low, high]: [f64; 2]) -> bool {
        let lap = if self.ring { (low / self.length()).floor() * self.length() } else { 0.0 };
        // On a ring the stretches may lie on the next lap.
        let laps = if self.ring { 2 } else { 1 };
        (0..laps).any(|i| {
            let by = lap + f64::from(i) * self.length();
            self.tight.iter().any(|[a, b]| a + by <= high && b + by >= low)
        })
    }

    /// Its points; of a ring those of two laps.
    pub(super) fn twice_round(&self) -> Vec<Point> {
        let more = if self.ring { &self.points[1..] } else { &[] };
        [&self.points, more].concat()
    }

    /// Whether it may be nibbled at a station, which on a ring may lie on any lap.
    pub(super) fn is_nibbled(&self, station: f64) -> bool {
        let laps = if self.ring { &[0.0, 1.0, -1.0][..] } else { &[0.0] };
        let station = if self.ring { station.rem_euclid(self.length()) } else { station };
        let is_in = |[low, high]: &[f64; 2], lap: f64| (*low..=*high).contains(&(station + lap * self.length()));
        self.nibbled.iter().any(|stretch| laps.iter().any(|&lap| is_in(stretch, lap)))
    }

    /// Turn of the line at a vertex, rad; none at the ends of an open line.
    pub(super) fn turn(&self, vertex: usize) -> f64 {
        let count = self.chords();
        if !self.ring && (vertex == 0 || vertex == count) {
            return 0.0;
        }
        angle::turn(self.direction((vertex + count - 1) % count), self.direction(vertex % count))
    }

    /// The greatest speed of the tip, mm/s, where that is one all along; `sign` is +1 with the line, -1 against it.
    pub(super) fn only_cap(&self, sign: f64) -> Option<f64> {
        self.caps[usize::from(sign <= 0.0)].only()
    }

    /// The greatest speed of the tip between two stations, mm/s; `sign` is +1 with the line, -1 against it.
    pub(super) fn cap(&self, [low, high]: [f64; 2], sign: f64) -> f64 {
        let length = self.length();
        let (caps, low, high) =
            if sign > 0.0 { (&self.caps[0], low, high) } else { (&self.caps[1], length - high, length - low) };
        if self.ring { caps.greatest_round(low, high, length) } else { caps.greatest(low, high) }
    }

    /// The least of the caps between two stations, likewise.
    pub(super) fn least_cap(&self, [low, high]: [f64; 2], sign: f64) -> f64 {
        let length = self.length();
        let (caps, low, high) =
            if sign > 0.0 { (&self.caps[0], low, high) } else { (&self.caps[1], length - high, length - low) };
        if self.ring { caps.least_round(low, high, length) } else { caps.least(low, high) }
    }

    /// The point at a station.
    pub(super) fn place(&self, station: f64) -> Point {
        let chord = self.chord_at(station);
        self.points[chord] + self.direction(chord) * (station - self.stations[chord])
    }

    /// The chords between two stations; on a ring they are counted on past its end.
    pub(super) fn chords_between(&self, [low, high]: [f64; 2]) -> RangeInclusive<usize> {
        let lap = if self.ring { (low / self.length()).floor() * self.length() } else { 0.0 };
        let (low, high) = (low - lap, high - lap);
        let over = if self.ring && high >= self.length() { self.length() } else { 0.0 };
        let laps = if over > 0.0 { self.chords() } else { 0 };
        self.chord_at(low)..=self.chord_at(high - over) + laps
    }

    /// Whether a block is that of a chord between two stations.
    pub(super) fn names(&self, block: u32, ends: [f64; 2]) -> bool {
        self.chords_between(ends).any(|chord| self.blocks[chord % self.chords()] == block)
    }

    /// The last vertex before a station, which on a ring may lie on any lap; `None` where an open line starts.
    pub(super) fn vertex_before(&self, station: f64) -> Option<usize> {
        let lap = if self.ring { station.rem_euclid(self.length()) } else { station };
        let before = self.stations.partition_point(|&s| s < lap);
        before.checked_sub(1).or_else(|| self.ring.then(|| self.chords() - 1))
    }

    /// The chord of a station.
    pub(super) fn chord_at(&self, station: f64) -> usize {
        self.stations.partition_point(|&s| s <= station).clamp(1, self.chords()) - 1
    }

    /// The same, looked for from a chord on that is near.
    pub(super) fn chord_near(&self, chord: usize, station: f64) -> usize {
        let mut chord = chord;
        while chord > 0 && self.stations[chord] > station {
            chord -= 1;
        }
        while chord + 1 < self.chords() && self.stations[chord + 1] <= station {
            chord += 1;
        }
        chord
    }
}
