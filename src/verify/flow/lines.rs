//! Required cuts of a marker as lines, with which blade positions are compared.

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, Vector, polyline};
use crate::verify::{Capped, Required, RequiredCut};

/// Required cut.
#[derive(Debug)]
pub(super) struct Line {
    /// Points, mm; a closed line ends with its first point.
    pub(super) points: Vec<Point>,
    /// Length along the line to each point, mm.
    pub(super) stations: Vec<f64>,
    /// True if the line ends at its start.
    pub(super) closed: bool,
    /// Source blocks, ascending.
    pub(super) blocks: Vec<u32>,
    /// Speed caps of the tip, stretch by stretch.
    caps: Vec<Capped>,
    /// Stations of corners at which the knife is lifted, mm.
    corners: Vec<f64>,
}

/// All required cuts, with an index of their segments.
#[derive(Debug)]
pub(super) struct Lines {
    pub(super) all: Vec<Line>,
    /// Line and segment of each box.
    segments: Vec<(usize, usize)>,
    boxes: Boxes,
}

/// Place on a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Foot {
    /// Station, mm; on a closed line it may continue past the length.
    pub(super) station: f64,
    /// Distance of the queried point, mm.
    pub(super) distance: f64,
}

impl Lines {
    /// Lines of the required cuts.
    pub(super) fn new(required: &Required) -> Self {
        let line = |cut: &RequiredCut| Line {
            stations: polyline::stations(&cut.points),
            points: cut.points.clone(),
            closed: cut.closed,
            blocks: cut.blocks.clone(),
            caps: cut.caps.clone(),
            corners: cut.corners.clone(),
        };
        let all: Vec<Line> = required.cuts.iter().map(line).collect();
        let segments: Vec<(usize, usize)> =
            all.iter().enumerate().flat_map(|(i, line)| (0..line.points.len() - 1).map(move |k| (i, k))).collect();
        let extent = |&(i, k): &(usize, usize)| Extent::between(all[i].points[k], all[i].points[k + 1]);
        let boxes = Boxes::new(segments.iter().map(extent).collect());
        Self { all, segments, boxes }
    }

    /// Segments within a distance of a point, as line, segment and foot.
    pub(super) fn near(&self, point: Point, reach: f64) -> impl Iterator<Item = (usize, usize, Foot)> + '_ {
        let extent = Extent::between(point, point).grown(reach);
        let near = self.boxes.near(extent).map(|i| self.segments[i]);
        near.map(move |(i, k)| (i, k, self.all[i].foot(k, point))).filter(move |near| near.2.distance <= reach)
    }
}

impl Line {
    /// Length of the line, mm.
    pub(super) fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// Foot of a point on a segment.
    fn foot(&self, segment: usize, point: Point) -> Foot {
        let (a, b) = (self.points[segment], self.points[segment + 1]);
        let share = polyline::foot(point, a, b);
        let station = self.stations[segment] + share * (self.stations[segment + 1] - self.stations[segment]);
        Foot { station, distance: (point - (a + (b - a) * share)).norm() }
    }

    /// Direction of a segment; `None` if it has no length.
    pub(super) fn along(&self, segment: usize) -> Option<Vector> {
        polyline::direction(self.points[segment], self.points[segment + 1])
    }

    /// Foot of a point nearest to it among places within `reach` mm of a station.
    pub(super) fn foot_near(&self, point: Point, station: f64, reach: f64) -> Foot {
        let length = self.length();
        let count = self.points.len() - 1;
        let (turn, inner) = if self.closed {
            let turn = (station / length).floor();
            (turn * length, station - turn * length)
        } else {
            (0.0, station.clamp(0.0, length))
        };
        let at = self.stations.partition_point(|&s| s <= inner).clamp(1, count) - 1;
        let mut best = Foot { station: f64::NAN, distance: f64::INFINITY };
        let mut look = |index: isize| {
            let round = index.div_euclid(count.cast_signed()) as f64;
            let k = index.rem_euclid(count.cast_signed()).cast_unsigned();
            let base = turn + round * length;
            let [from, to] = [base + self.stations[k], base + self.stations[k + 1]];
            if from > station + reach || to < station - reach {
                return false;
            }
            let foot = self.foot(k, point);
            if foot.distance < best.distance {
                best = Foot { station: base + foot.station, ..foot };
            }
            true
        };
        let (at, count) = (at.cast_signed(), count.cast_signed());
        let limits = if self.closed { [at - count, at + count] } else { [0, count - 1] };
        let _ = (at..=limits[1]).all(&mut look);
        let _ = (limits[0]..at).rev().all(&mut look);
        best
    }

    /// Points of the line strictly between two stations, in the direction from the first to the second.
    pub(super) fn between(&self, [from, to]: [f64; 2]) -> Vec<Point> {
        let length = self.length();
        let (low, high) = (from.min(to), from.max(to));
        let turns = if self.closed { (low / length).floor() as i64..=(high / length).floor() as i64 } else { 0..=0 };
        let count = self.points.len() - usize::from(self.closed);
        let vertices = turns.flat_map(|turn| (0..count).map(move |k| (turn as f64 * length + self.stations[k], k)));
        let mut found: Vec<Point> =
            vertices.filter(|&(station, _)| station > low && station < high).map(|(_, k)| self.points[k]).collect();
        if from > to {
            found.reverse();
        }
        found
    }

    /// Distance of a station from the nearest corner at which the knife is lifted or end of an open line, mm; infinite without
    /// any.
    pub(super) fn corner_near(&self, station: f64) -> f64 {
        let length = self.length();
        let ends = if self.closed { &[][..] } else { &[0.0, length][..] };
        let away = |at: &f64| {
            let away = (at - station).abs();
            let round = away.rem_euclid(length);
            if self.closed { round.min(length - round) } else { away }
        };
        self.corners.iter().chain(ends).map(away).fold(f64::INFINITY, f64::min)
    }

    /// Sum of the absolute turns of the line between two stations, rad.
    pub(super) fn turns_between(&self, ends: [f64; 2]) -> f64 {
        let [from, to] = ends.map(|station| self.place(station));
        let inner = self.between(ends);
        let way: Vec<Point> = [from].into_iter().chain(inner).chain([to]).collect();
        way.windows(3).map(|w| polyline::turn_at(w[0], w[1], w[2]).abs()).sum()
    }

    /// Point at a station.
    pub(super) fn place(&self, station: f64) -> Point {
        polyline::place(&self.points, &self.stations, self.within(station))
    }

    /// Station counted from the start of the line: on a closed line it is reduced to one turn.
    pub(super) fn within(&self, station: f64) -> f64 {
        if self.closed { station.rem_euclid(self.length()) } else { station }
    }

    /// Speed cap of the tip, mm/s, if it is the same for the whole line in both directions.
    pub(super) fn only_cap(&self) -> Option<f64> {
        let first = self.caps.first()?.speeds[0];
        self.caps.iter().all(|cap| cap.speeds == [first; 2]).then_some(first)
    }

    /// Greatest cap between two stations for a tip that moves with the line, or against it, mm/s.
    pub(super) fn cap(&self, [low, high]: [f64; 2], with: bool) -> f64 {
        let length = self.length();
        let over = |[low, high]: [f64; 2]| {
            let first = self.caps.partition_point(|cap| cap.to < low).min(self.caps.len() - 1);
            let from = |i: usize| if i == 0 { 0.0 } else { self.caps[i - 1].to };
            let on = (first..self.caps.len()).take_while(|&i| i == first || from(i) <= high);
            on.map(|i| self.caps[i].speeds[usize::from(!with)]).fold(0.0, f64::max)
        };
        let (from, way) = (self.within(low), (high - low).min(length));
        if self.closed && from + way > length {
            over([from, length]).max(over([0.0, from + way - length]))
        } else {
            over([from, from + way])
        }
    }

    /// Least cap of the line, mm/s.
    pub(super) fn least_cap(&self) -> f64 {
        self.caps.iter().flat_map(|cap| cap.speeds).fold(f64::INFINITY, f64::min)
    }
}
