//! What must be cut of a marker, as lines to which places of blades are compared.

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, Vector, polyline};
use crate::verify::{Capped, Required, RequiredCut};

/// A cut.
#[derive(Debug)]
pub(super) struct Line {
    /// Its points; a closed one ends with its first.
    pub(super) points: Vec<Point>,
    /// The way along it to each, mm.
    pub(super) stations: Vec<f64>,
    /// Whether it ends where it starts.
    pub(super) closed: bool,
    /// The blocks that it came from, in order.
    pub(super) blocks: Vec<u32>,
    /// How fast the tip may go, stretch by stretch.
    caps: Vec<Capped>,
    /// Where the knife is lifted at a corner, mm along it.
    corners: Vec<f64>,
}

/// All cuts.
#[derive(Debug)]
pub(super) struct Lines {
    pub(super) all: Vec<Line>,
    /// Line and segment of each box.
    segments: Vec<(usize, usize)>,
    boxes: Boxes,
}

/// A place on a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Foot {
    /// The way along the line, mm; round a closed one it goes on.
    pub(super) station: f64,
    /// How far the place that was asked for is from it, mm.
    pub(super) distance: f64,
}

impl Lines {
    /// Those that are required.
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

    /// The lines that come within a distance of a point, with where they do: one segment each.
    pub(super) fn near(&self, point: Point, reach: f64) -> impl Iterator<Item = (usize, usize, Foot)> + '_ {
        let extent = Extent::between(point, point).grown(reach);
        let near = self.boxes.near(extent).map(|i| self.segments[i]);
        near.map(move |(i, k)| (i, k, self.all[i].foot(k, point))).filter(move |near| near.2.distance <= reach)
    }
}

impl Line {
    /// Length, mm.
    pub(super) fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// The foot of a point on a segment.
    fn foot(&self, segment: usize, point: Point) -> Foot {
        let (a, b) = (self.points[segment], self.points[segment + 1]);
        let share = polyline::foot(point, a, b);
        let station = self.stations[segment] + share * (self.stations[segment + 1] - self.stations[segment]);
        Foot { station, distance: (point - (a + (b - a) * share)).norm() }
    }

    /// The direction of a segment.
    pub(super) fn along(&self, segment: usize) -> Option<Vector> {
        polyline::direction(self.points[segment], self.points[segment + 1])
    }

    /// The foot of a point nearest to it among places of the line that are no farther than `reach` from a station.
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

    /// The points of the line strictly between two stations, in the order of these.
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

    /// How far a station is from the nearest place where the knife is lifted at a corner, or where an open line ends, mm;
    /// infinite where there is none.
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

    /// How much the line turns between two stations, to either side, rad.
    pub(super) fn turns_between(&self, ends: [f64; 2]) -> f64 {
        let [from, to] = ends.map(|station| self.place(station));
        let inner = self.between(ends);
        let way: Vec<Point> = [from].into_iter().chain(inner).chain([to]).collect();
        way.windows(3).map(|w| polyline::turn_at(w[0], w[1], w[2]).abs()).sum()
    }

    /// The place at a station.
    pub(super) fn place(&self, station: f64) -> Point {
        polyline::place(&self.points, &self.stations, self.within(station))
    }

    /// A station as it is counted from the start of the line.
    pub(super) fn within(&self, station: f64) -> f64 {
        if self.closed { station.rem_euclid(self.length()) } else { station }
    }

    /// The one speed that caps the tip all along, mm/s; `None` when there are several.
    pub(super) fn only_cap(&self) -> Option<f64> {
        let first = self.caps.first()?.speeds[0];
        self.caps.iter().all(|cap| cap.speeds == [first; 2]).then_some(first)
    }

    /// The greatest cap between two stations of a tip that goes with the line, or against it, mm/s.
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

    /// The slowest of all caps, mm/s.
    pub(super) fn least_cap(&self) -> f64 {
        self.caps.iter().flat_map(|cap| cap.speeds).fold(f64::INFINITY, f64::min)
    }
}
