//! Closed line of a part that is being converted to cuts.

use crate::geom::{Point, Vector, cross, polyline, ring};
use crate::ir::list::{Joint, Segment};

/// Length below which a stretch counts as empty, mm: rounding.
const SAME_PLACE: f64 = 1e-9;

/// Closed line of a part, as it is cut.
#[derive(Debug)]
pub(super) struct Ring {
    /// Index of its piece in the marker.
    pub(super) piece: usize,
    /// Part that it bounds, by the index of the piece of the part's outline.
    pub(super) part: u32,
    /// True if the part is on its left.
    pub(super) is_part_left: bool,
    /// Number of advances of the cloth before it is cut.
    pub(super) advances: usize,
    /// Segments; the last one ends where the first starts.
    segments: Vec<Segment>,
    /// Distance from its start to each segment, and the total length, mm.
    stations: Vec<f64>,
    /// Segments that run straight over the mouth of a notch, in order.
    mouths: Vec<Mouth>,
}

/// Notch whose mouth is cut through.
#[derive(Debug, Clone)]
pub(super) struct Mouth {
    /// Index of the segment over its mouth.
    pub(super) segment: usize,
    /// Legs, in the order of the outline.
    pub(super) legs: Vec<Segment>,
}

impl Ring {
    pub(super) fn new(
        [piece, part]: [usize; 2],
        is_part_left: bool,
        segments: Vec<Segment>,
        mouths: Vec<Mouth>,
    ) -> Self {
        let part = part as u32;
        let mut ring = Self { piece, part, is_part_left, advances: 0, segments, stations: Vec::new(), mouths };
        ring.measure();
        ring
    }

    fn measure(&mut self) {
        let mut length = 0.0;
        self.stations.clear();
        self.stations.push(length);
        self.stations.extend(self.segments.iter().map(|segment| {
            length += segment.length();
            length
        }));
    }

    /// Length, mm.
    pub(super) fn length(&self) -> f64 {
        self.stations[self.segments.len()]
    }

    pub(super) fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Notches over whose mouths it runs.
    pub(super) fn mouths(&self) -> &[Mouth] {
        &self.mouths
    }

    /// Station at which a segment starts, mm.
    pub(super) fn station(&self, segment: usize) -> f64 {
        self.stations[segment]
    }

    /// True if a place lies within its part, as far as this ring bounds that.
    pub(super) fn holds(&self, place: Point) -> bool {
        let points: Vec<Point> =
            self.segments.iter().map(|segment| segment.from).chain([self.segments[0].from]).collect();
        let is_part_within = (ring::area(&points) > 0.0) == self.is_part_left;
        ring::contains(&points, place) == is_part_within
    }

    /// Restores the legs of the notches that are not wanted as separate cuts.
    pub(super) fn keep_mouths(&mut self, mut is_wanted: impl FnMut(&Mouth) -> bool) -> bool {
        let mouths = std::mem::take(&mut self.mouths);
        let count = mouths.len();
        let mut segments = Vec::with_capacity(self.segments.len());
        let mut mouths = mouths.into_iter().peekable();
        for (i, segment) in self.segments.iter().enumerate() {
            match mouths.next_if(|mouth| mouth.segment == i) {
                Some(mouth) if is_wanted(&mouth) => {
                    self.mouths.push(Mouth { segment: segments.len(), ..mouth });
                    segments.push(*segment);
                }
                Some(mouth) => segments.extend(mouth.legs),
                None => segments.push(*segment),
            }
        }
        self.segments = segments;
        self.measure();
        self.mouths.len() < count
    }

    /// Segment at a station, which may be on any lap, and the station on the first lap.
    fn segment_at(&self, station: f64) -> (usize, f64) {
        let station = station.rem_euclid(self.length());
        let next = self.stations.partition_point(|&start| start <= station);
        (next.clamp(1, self.segments.len()) - 1, station)
    }

    /// Place at a station.
    pub(super) fn place(&self, station: f64) -> Point {
        let (i, station) = self.segment_at(station);
        let Segment { from, to, .. } = self.segments[i];
        from + (to - from) * ((station - self.stations[i]) / self.segments[i].length())
    }

    /// Direction of arrival at a station, in or against the direction of the ring, as a unit vector.
    pub(super) fn arriving(&self, station: f64, is_along: bool) -> Vector {
        let Segment { from, to, .. } = self.arriving_on(station, is_along);
        let along = (to - from) / (to - from).norm();
        if is_along { along } else { -along }
    }

    /// Segment on which it arrives at a station, in or against its direction.
    pub(super) fn arriving_on(&self, station: f64, is_along: bool) -> Segment {
        let count = self.segments.len();
        let (i, at) = self.segment_at(station);
        let near = |a: f64| (a - at).abs() <= SAME_PLACE;
        let i = if is_along && near(self.stations[i]) {
            (i + count - 1) % count
        } else if !is_along && near(self.stations[i + 1]) {
            (i + 1) % count
        } else {
            i
        };
        self.segments[i]
    }

    /// Unit vector across it at a station, into its part.
    pub(super) fn inwards(&self, station: f64) -> Vector {
        let (i, _) = self.segment_at(station);
        let Segment { from, to, .. } = self.segments[i];
        let left = crate::geom::left(to - from) / (to - from).norm();
        if self.is_part_left { left } else { -left }
    }

    /// Stations of the vertices strictly between two stations.
    pub(super) fn vertices(&self, [from, to]: [f64; 2]) -> impl Iterator<Item = f64> + '_ {
        let (length, count) = (self.length(), self.segments.len());
        let lap = (from / length).floor();
        let first = self.stations.partition_point(|&start| start <= from - lap * length);
        let station = move |i: usize| self.stations[i % count] + (lap + (i / count) as f64) * length;
        (first..).map(station).take_while(move |&station| station < to)
    }

    /// Stretch between two stations, as segments of a separate cut.
    pub(super) fn stretch(&self, [from, to]: [f64; 2]) -> Vec<Segment> {
        let mut found: Vec<Segment> = Vec::new();
        let mut at = from;
        for end in self.vertices([from, to]).chain([to]) {
            if end - at <= SAME_PLACE {
                continue;
            }
            let (i, _) = self.segment_at(f64::midpoint(at, end));
            let start = found.last().map_or_else(|| self.place(from), |last| last.to);
            // Codes of the file at the start of a segment apply only there.
            let is_whole = !found.is_empty() && (start - self.segments[i].from).norm() <= SAME_PLACE;
            let joint = if is_whole { self.segments[i].joint } else { Joint::default() };
            found.push(Segment { from: start, to: self.place(end), joint, ..self.segments[i] });
            at = end;
        }
        found.retain(|segment| segment.from != segment.to);
        found
    }
}

/// Crossing of a line, from a place along a unit vector, with a segment: the distance ahead, mm, at least `least`, and the sine
/// of the angle between them.
pub(super) fn crossing(at: Point, along: Vector, [from, to]: [Point; 2], least: f64) -> Option<(f64, f64)> {
    let direction = polyline::direction(from, to)?;
    let sine = cross(along, direction);
    if sine == 0.0 {
        return None;
    }
    let ahead = cross(from - at, direction) / sine;
    let place = (at + along * ahead - from).dot(&direction);
    let is_on = place >= -SAME_PLACE && place <= (to - from).norm() + SAME_PLACE;
    (is_on && ahead >= least).then_some((ahead, sine.abs()))
}
