//! Stretch that is cut from one end to the other, with its places, stations, chords and caps.

use std::borrow::Cow;
use std::ops::RangeInclusive;

use super::caps::{BothWays, Pick, Way};
use super::vertex::Vertex;
use crate::geom::{Point, Vector, angle, cross, left, polyline};

/// Cut of the marker that a line belongs to.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct OfCut {
    /// Index among the cuts of the marker.
    pub(in crate::verify) index: u32,
    /// Start of the line on the cut, mm from the start of the cut as drawn.
    pub(in crate::verify) offset: f64,
    /// Length of a closed cut, mm; `None` for an open one.
    pub(in crate::verify) round: Option<f64>,
    /// True if the cut bounds a part.
    pub(in crate::verify) bounds: bool,
    /// True for the edge of a part as drawn, which is not a cut itself.
    pub(in crate::verify) is_edge: bool,
    /// True if overlaps at its ends may be forbidden: by codes of the file, or because it is a slit.
    pub(in crate::verify) is_bare: bool,
}

impl OfCut {
    /// True if two stretches of the cut meet; on a closed cut each may continue past its end.
    pub(in crate::verify) fn meets(&self, [low, high]: [f64; 2], [from, to]: [f64; 2]) -> bool {
        let Some(round) = self.round else { return from.min(to) <= high && from.max(to) >= low };
        let length = self.length_of([from, to]);
        // Distance from the start of the one to the start of the other, within one turn.
        let ahead = (from - low).rem_euclid(round);
        ahead <= high - low || round - ahead <= length
    }

    /// Common length of two stretches of the cut, mm; the second may continue past the end of a closed cut.
    pub(in crate::verify) fn common(&self, [low, high]: [f64; 2], [from, to]: [f64; 2]) -> f64 {
        let common = |from: f64, to: f64| (high.min(to) - low.max(from)).max(0.0);
        let Some(round) = self.round else { return common(from.min(to), from.max(to)) };
        let (length, from) = (self.length_of([from, to]), low + (from - low).rem_euclid(round));
        common(from, from + length) + common(from - round, from - round + length)
    }

    /// Length of a stretch of the cut, mm; on a closed cut it may continue past the end.
    pub(in crate::verify) fn length_of(&self, [from, to]: [f64; 2]) -> f64 {
        match self.round {
            Some(round) if to < from => to + round - from,
            _ => (to - from).abs(),
        }
    }
}

/// Stretch that is cut from one end to the other, without a corner. Lengths and stations are in mm.
#[derive(Debug)]
pub(in crate::verify) struct Line<'a> {
    /// Cut that the line belongs to.
    pub(in crate::verify) cut: OfCut,
    /// Index of the piece.
    pub(in crate::verify) piece: u32,
    /// Rank of the contour or slit among events, holes, slits and contours, in cut order.
    pub(in crate::verify) rank: u32,
    /// Points; a ring ends with its first point. Borrowed from the marker where they are adjacent there.
    points: Cow<'a, [Point]>,
    /// Station, bulge and block of each point.
    path: Box<[Vertex]>,
    /// Speed caps of the tip, which may be lower before a corner.
    caps: BothWays,
    /// True for a closed contour without a corner.
    pub(in crate::verify) ring: bool,
    /// Stretches that are too tight for the blade to be a chord, by the stations of heel and tip. Usually empty.
    pub(in crate::verify) tight: Box<[[f64; 2]]>,
    /// Station ranges that are on no edge of the line's own part: only in parts that share edges with others.
    pub(in crate::verify) aside: Box<[[f64; 2]]>,
}

/// Chord of a line.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Chord {
    pub(in crate::verify) index: usize,
    /// Start point, and its station, mm.
    from: Point,
    start: f64,
    /// Length, mm.
    length: f64,
    /// Unit vector along the chord.
    pub(in crate::verify) along: Vector,
    /// Distance from the middle of the chord to the edge of the tolerance band's core there, mm, positive to the left.
    height: f64,
}

impl Chord {
    /// Start of the chord, crest of the curve that it approximates, and end of the chord.
    pub(in crate::verify) fn band(&self) -> [Point; 3] {
        let way = self.along * self.length;
        [self.from, self.from + way / 2.0 + left(self.along) * self.height, self.from + way]
    }

    /// Sagitta of the curve that the chord approximates, mm.
    pub(in crate::verify) fn sagitta(&self) -> f64 {
        self.height.abs()
    }

    /// Station and length of the chord, mm.
    pub(in crate::verify) fn stations(&self) -> [f64; 2] {
        [self.start, self.length]
    }

    /// Distance of a point from the core of the tolerance band at the chord, mm, and the station of the foot. The core at a
    /// place of the chord is the segment from the chord to its bulge there.
    #[inline]
    pub(in crate::verify) fn deviation(&self, point: Point) -> (f64, f64) {
        let from = point - self.from;
        if self.length == 0.0 {
            return (from.norm(), self.start);
        }
        let (ahead, aside) = (from.dot(&self.along), cross(self.along, from));
        let way = ahead.clamp(0.0, self.length);
        let share = way / self.length;
        let height = self.height * (4.0 * share * (1.0 - share));
        let used = if height > 0.0 { aside.clamp(0.0, height) } else { aside.clamp(height, 0.0) };
        (Vector::new(ahead - way, aside - used).norm(), self.start + way)
    }
}

impl<'a> Line<'a> {
    /// Line of a piece at a rank; `path` has an entry for each point.
    pub(in crate::verify) fn new(
        [piece, rank]: [u32; 2],
        cut: OfCut,
        points: Cow<'a, [Point]>,
        path: Box<[Vertex]>,
        caps: BothWays,
        ring: bool,
    ) -> Self {
        debug_assert_eq!(points.len(), path.len(), "all is known of every point");
        Self { cut, piece, rank, points, path, caps, ring, tight: Box::default(), aside: Box::default() }
    }

    /// Point of a vertex.
    pub(in crate::verify) fn point(&self, vertex: usize) -> Point {
        self.points[vertex]
    }

    /// All points in order.
    pub(in crate::verify) fn points(&self) -> impl DoubleEndedIterator<Item = Point> + ExactSizeIterator + '_ {
        self.points.iter().copied()
    }

    /// Length from the first point to another, mm.
    pub(in crate::verify) fn station(&self, vertex: usize) -> f64 {
        self.path[vertex].station
    }

    /// Source block of a chord.
    pub(in crate::verify) fn block(&self, chord: usize) -> u32 {
        self.path[chord].block
    }

    /// True if one of the chords has that block.
    pub(in crate::verify) fn has(&self, block: u32) -> bool {
        self.path[..self.chords()].iter().any(|vertex| vertex.block == block)
    }

    /// Length of the line, mm.
    pub(in crate::verify) fn length(&self) -> f64 {
        self.path[self.path.len() - 1].station
    }

    /// Number of chords.
    pub(in crate::verify) fn chords(&self) -> usize {
        self.path.len() - 1
    }

    /// Number of vertices before a station.
    pub(in crate::verify) fn before(&self, station: f64) -> usize {
        self.path.partition_point(|vertex| vertex.station < station)
    }

    /// Number of vertices before or at a station.
    pub(in crate::verify) fn up_to(&self, station: f64) -> usize {
        self.path.partition_point(|vertex| vertex.station <= station)
    }

    /// Unit vector along a chord.
    pub(in crate::verify) fn direction(&self, chord: usize) -> Vector {
        let [from, to] = self.ends(chord);
        (to - from) / self.length_of(chord)
    }

    /// Chord by its index.
    pub(in crate::verify) fn chord(&self, index: usize) -> Chord {
        let [from, to] = self.ends(index);
        let Vertex { station: start, sagitta, .. } = self.path[index];
        let (way, length) = (to - from, self.length_of(index));
        Chord { index, from, start, length, along: way / length, height: length * f64::from(sagitta) }
    }

    /// Both ends of a chord.
    pub(in crate::verify) fn ends(&self, chord: usize) -> [Point; 2] {
        let [from, to] = self.points[chord..chord + 2] else { unreachable!("a chord has two ends") };
        [from, to]
    }

    /// Length of a chord, mm.
    fn length_of(&self, chord: usize) -> f64 {
        let [from, to] = &self.path[chord..chord + 2] else { unreachable!("a chord has two ends") };
        to.station - from.station
    }

    /// Distance of a point from a chord, mm.
    pub(in crate::verify) fn distance_to_chord(&self, chord: usize, point: Point) -> f64 {
        let [from, to] = self.ends(chord);
        polyline::distance_to_segment(point, from, to)
    }

    /// True if a point may be within `reach` mm of the tolerance band's core at a chord, judged by the chord's box.
    pub(in crate::verify) fn may_reach(&self, chord: usize, point: Point, reach: f64) -> bool {
        let [from, to] = self.ends(chord);
        let reach = reach + f64::from(self.path[chord].sagitta).abs() * self.length_of(chord);
        let (from, to) = (from - point, to - point);
        let is_between = |a: f64, b: f64| (a <= reach || b <= reach) && (a >= -reach || b >= -reach);
        is_between(from.x, to.x) && is_between(from.y, to.y)
    }

    /// True if a point is beyond the end of the line at this chord, where the line is extended straight.
    pub(in crate::verify) fn is_led_on(&self, chord: usize, point: Point) -> bool {
        let [from, to] = self.ends(chord);
        let is_before = chord == 0 && (point - from).dot(&(to - from)) < 0.0;
        let is_behind = || chord + 1 == self.chords() && (point - to).dot(&(to - from)) > 0.0;
        !self.ring && (is_before || is_behind())
    }

    /// Vertices between two stations, which on a ring may lie on any lap; on a ring its last point counts as its first.
    pub(in crate::verify) fn vertices(&self, low: f64, high: f64) -> impl Iterator<Item = usize> + '_ {
        let length = self.length();
        let count = if self.ring { self.chords() } else { self.path.len() };
        let lap = if self.ring { (low / length).floor() } else { 0.0 };
        let first = self.path[..count].partition_point(|vertex| vertex.station + lap * length < low);
        let laps = if self.ring { usize::MAX } else { count };
        let station = move |i: usize| self.station(i % count) + (lap + (i / count) as f64) * length;
        (first..laps).take_while(move |&i| station(i) <= high).map(move |i| i % count)
    }

    /// True if the line is too tight for the blade somewhere between two stations.
    pub(in crate::verify) fn is_tight(&self, [low, high]: [f64; 2]) -> bool {
        let lap = if self.ring { (low / self.length()).floor() * self.length() } else { 0.0 };
        // On a ring the stretches may lie on the next lap.
        let laps = if self.ring { 2 } else { 1 };
        (0..laps).any(|i| {
            let by = lap + f64::from(i) * self.length();
            self.tight.iter().any(|[a, b]| a + by <= high && b + by >= low)
        })
    }

    /// Points of the line; of a ring, those of two laps.
    pub(in crate::verify) fn twice_round(&self) -> Vec<Point> {
        let more = if self.ring { &self.points[1..] } else { &[] };
        [&self.points, more].concat()
    }

    /// Turn of the line at a vertex, rad; 0 at the ends of an open line.
    pub(in crate::verify) fn turn(&self, vertex: usize) -> f64 {
        let count = self.chords();
        if !self.ring && (vertex == 0 || vertex == count) {
            return 0.0;
        }
        angle::turn(self.direction((vertex + count - 1) % count), self.direction(vertex % count))
    }

    /// Speed cap of the tip, mm/s, if it is the same for the whole line; `sign` is +1 with the line, -1 against it.
    pub(in crate::verify) fn only_cap(&self, sign: f64) -> Option<f64> {
        self.caps.only(sign)
    }

    /// Stretches with constant caps: the end of each, and the caps with the line and against it, mm/s.
    pub(in crate::verify) fn caps(&self) -> Vec<(f64, [f64; 2])> {
        self.caps.stretches(self.length())
    }

    /// Cap picked among those between two stations, mm/s; `sign` is +1 with the line, -1 against it.
    pub(in crate::verify) fn cap(&self, [low, high]: [f64; 2], sign: f64, pick: Pick) -> f64 {
        let length = self.length();
        let ends = if sign > 0.0 { [low, high] } else { [length - high, length - low] };
        self.caps.over(ends, Way { sign, round: self.ring.then_some(length) }, pick)
    }

    /// Point at a station.
    pub(in crate::verify) fn place(&self, station: f64) -> Point {
        let chord = self.chord_at(station);
        self.point(chord) + self.direction(chord) * (station - self.station(chord))
    }

    /// Chords between two stations; on a ring, indices continue past its end.
    pub(in crate::verify) fn chords_between(&self, [low, high]: [f64; 2]) -> RangeInclusive<usize> {
        let lap = if self.ring { (low / self.length()).floor() * self.length() } else { 0.0 };
        let (low, high) = (low - lap, high - lap);
        let over = if self.ring && high >= self.length() { self.length() } else { 0.0 };
        let laps = if over > 0.0 { self.chords() } else { 0 };
        self.chord_at(low)..=self.chord_at(high - over) + laps
    }

    /// True if a block belongs to a chord between two stations.
    pub(in crate::verify) fn names(&self, block: u32, ends: [f64; 2]) -> bool {
        self.chords_between(ends).any(|chord| self.block(chord % self.chords()) == block)
    }

    /// Length between two stations that is on chords of a block, mm.
    pub(in crate::verify) fn length_named(&self, block: u32, [low, high]: [f64; 2]) -> f64 {
        let laps = if self.ring { (low / self.length()).floor() * self.length() } else { 0.0 };
        let on = |chord: usize| {
            let lap = laps + (chord / self.chords()) as f64 * self.length();
            let [from, to] = [0, 1].map(|end| self.station(chord % self.chords() + end) + lap);
            (to.min(high) - from.max(low)).max(0.0)
        };
        let named = self.chords_between([low, high]).filter(|chord| self.block(chord % self.chords()) == block);
        named.map(on).sum()
    }

    /// Last vertex before a station, which on a ring may lie on any lap; `None` at the start of an open line.
    pub(in crate::verify) fn vertex_before(&self, station: f64) -> Option<usize> {
        let lap = if self.ring { station.rem_euclid(self.length()) } else { station };
        self.before(lap).checked_sub(1).or_else(|| self.ring.then(|| self.chords() - 1))
    }

    /// Chord at a station.
    pub(in crate::verify) fn chord_at(&self, station: f64) -> usize {
        self.up_to(station).clamp(1, self.chords()) - 1
    }

    /// Chord at a station, searched from a chord nearby.
    pub(in crate::verify) fn chord_near(&self, chord: usize, station: f64) -> usize {
        let mut chord = chord;
        while chord > 0 && self.station(chord) > station {
            chord -= 1;
        }
        while chord + 1 < self.chords() && self.station(chord + 1) <= station {
            chord += 1;
        }
        chord
    }
}
