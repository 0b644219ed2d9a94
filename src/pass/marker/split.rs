//! Split: places where borders of a conveyor's windows may divide the outline of a piece, and the resulting cuts.
//!
//! Both halves of a split cut run along the line past the border by the overlap. There each of them leaves the line straight
//! into the waste, by more than the conveyor may move the cloth from its place. So each end is farther from the other half than
//! the cloth moves: the halves cross for every position of the cloth, and no thread is left between them.

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, Rotation, Vector, polyline};
use crate::ir::Marker;
use crate::ir::list::{Joint, Range, Segment, SegmentList};
use crate::ir::marker::{Contour, Notch};
use crate::machine::{Bite, Job};

/// Length of the deviation, as a multiple of its offset: ten degrees, for which no blade needs to be lifted.
const LEAD_SHARE: f64 = 6.0;
/// Excess length of the deviation over the blade, mm, so that the blade plunges on a straight line.
const BLADE_ROOM: f64 = 1.0;
/// Distance before a bend at which a line gets another vertex, mm: a curve through shorter segments bulges less.
const BEND: f64 = 1.0;
/// Distance of the halves' ends from any corner, notch or hole, mm.
const FREE: f64 = 15.0;
/// Greatest turn at a vertex between the halves, rad (6 degrees), and greatest bow of the line there, mm.
const MOST_TURN: f64 = 0.105;
const MOST_BOW: f64 = 0.5;
/// Bow beyond which a line counts as a curve, mm: a plunge harms it more.
const CURVE: f64 = 0.05;
/// Costs of a split on a straight line, and on a curve.
const COST: u32 = 1;
const CURVE_COST: u32 = 3;
/// Least sine of the angle between the line and the border (10 degrees).
const LEAST_SINE: f64 = 0.174;
/// Length of the line itself next to such a stretch that is ignored, mm, in addition to that distance.
const ROOM: f64 = 1.0;
/// Rounding of lengths, mm.
const SAME_EPSILON: f64 = 1e-6;

/// Overlap of the halves of a split cut.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lap {
    /// Length past the border along the line, mm.
    overlap: f64,
    /// Offset from the line after that, mm.
    veer: f64,
    /// Length of the deviation, mm.
    lead: f64,
    /// Least distance of any other line, mm.
    clear: f64,
}

impl Lap {
    /// Overlap for a job and a file with a grid of `unit` mm.
    pub(super) fn of(job: &Job, unit: f64) -> Self {
        let (bite, knife) = (&job.profile.bite, &job.profile.knife);
        let veer = bite.veer(job.profile.tolerance(unit));
        let lead = (LEAD_SHARE * veer).max(knife.width_mm + BLADE_ROOM);
        let [heel, front] = knife.most_overlaps();
        // The overlaps of the blade continue in the direction of the deviation, and a cut in another window may be nearer by
        // the tolerance.
        let aside = veer * (1.0 + heel.max(front) / lead);
        let clear = aside + Bite::MATCHES * bite.match_mm + knife.clearance_mm + job.profile.band(unit);
        Self { overlap: bite.overlap_mm, veer, lead, clear }
    }

    /// Length of a half past its border, mm.
    pub(super) fn length(&self) -> f64 {
        self.overlap + self.lead
    }
}

/// A closed outline, addressed by stations.
pub(super) struct Ring {
    /// The outline in the list.
    range: Range,
    segments: Vec<Segment>,
    /// Stations of the starts of the segments and of the last end, mm.
    stations: Vec<f64>,
    is_part_left: bool,
}

impl Ring {
    /// Outline of a closed range of a list, with its part on the left or on the right.
    pub(super) fn new(list: &SegmentList, range: Range, is_part_left: bool) -> Self {
        let segments: Vec<Segment> = list.walk(range).map(|(_, segment)| segment).collect();
        Self { stations: polyline::stations(&list.points(range)), range, segments, is_part_left }
    }

    fn length(&self) -> f64 {
        self.stations[self.segments.len()]
    }

    /// Stations at which the outline crosses a border, mm, each with true if it goes towards greater X there.
    fn crossings(&self, x: f64) -> Vec<(f64, bool)> {
        let crossing = |(segment, start): (&Segment, &f64)| {
            let [a, b] = [segment.from.x, segment.to.x];
            ((a < x) != (b < x)).then(|| (start + segment.length() * ((x - a) / (b - a)), a < x))
        };
        self.segments.iter().zip(&self.stations).filter_map(crossing).collect()
    }

    /// The outline from one station to a greater one, at most once round.
    fn between(&self, from: f64, to: f64) -> Vec<Segment> {
        let (length, count) = (self.length(), self.segments.len());
        let laps = (from / length).floor() * length;
        let [from, to] = [from - laps, to - laps];
        let first = self.stations.partition_point(|&station| station <= from).clamp(1, count) - 1;
        let mut found: Vec<Segment> = Vec::new();
        for i in first..first + 2 * count {
            let segment = self.segments[i % count];
            let start = self.stations[i % count] + if i >= count { length } else { 0.0 };
            let way = segment.length();
            if to - start <= SAME_EPSILON {
                break;
            }
            if start + way - from <= SAME_EPSILON {
                continue;
            }
            let place = |station: f64| segment.from + (segment.to - segment.from) * ((station - start) / way);
            let is_whole = [from - start <= SAME_EPSILON, start + way - to <= SAME_EPSILON];
            found.push(Segment {
                from: if is_whole[0] { segment.from } else { place(from) },
                to: if is_whole[1] { segment.to } else { place(to) },
                joint: if is_whole[0] { segment.joint } else { Joint::default() },
                ..segment
            });
        }
        found
    }

    /// Cuts of the outline between borders, each with the number of its section, from 0.
    pub(super) fn sections(&self, borders: &[f64], lap: Lap) -> Vec<(usize, Vec<Segment>)> {
        let mut starts: Vec<(f64, usize)> = Vec::new();
        for (before, &x) in borders.iter().enumerate() {
            starts.extend(self.crossings(x).into_iter().map(|(at, is_on)| (at, before + usize::from(is_on))));
        }
        starts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let ends = starts.iter().cycle().skip(1).zip(1..);
        let last = |place: usize| if place == starts.len() { self.length() } else { 0.0 };
        let cuts = starts.iter().zip(ends);
        cuts.map(|(&(from, section), (&(to, _), place))| {
            (section, self.led([from - lap.overlap, to + last(place) + lap.overlap], lap))
        })
        .collect()
    }

    /// The outline between two stations, extended at both ends into the waste.
    fn led(&self, [from, to]: [f64; 2], lap: Lap) -> Vec<Segment> {
        let line = [[from, from + BEND], [from + BEND, to - BEND], [to - BEND, to]];
        let mut line: Vec<Segment> = line.into_iter().flat_map(|[from, to]| self.between(from, to)).collect();
        // Both ends are computed from stations: rounding may separate them.
        for i in 1..line.len() {
            line[i].from = line[i - 1].to;
        }
        let turn = Rotation((lap.veer / lap.lead).asin()).unit();
        // The waste is on one side ahead, and on the other side looking back from the start.
        let side = if self.is_part_left { -1.0 } else { 1.0 };
        let aside = |way: Vector, side: f64| {
            Vector::new(way.x * turn.x - side * way.y * turn.y, side * way.x * turn.y + way.y * turn.x)
        };
        let [first, last] = [line[0], line[line.len() - 1]];
        let [back, on] = [-direction(&first), direction(&last)];
        let start = first.from + aside(back, -side) * lap.lead;
        let end = last.to + aside(on, side) * lap.lead;
        let lead_in = Segment { from: start, to: first.from, joint: Joint::default(), ..first };
        // A blade that turned here in the cloth would swing its heel into the part.
        let lifted = Joint { lift: true, ..Joint::default() };
        let lead_out = Segment { from: last.to, to: end, joint: lifted, ..last };
        std::iter::once(lead_in).chain(line).chain([lead_out]).collect()
    }
}

/// Direction of a segment, unit vector.
fn direction(segment: &Segment) -> Vector {
    (segment.to - segment.from) / segment.length()
}

/// Lines of a marker that a split must keep away from.
pub(super) struct Lines {
    /// Lines with their contour; `None` for slits and holes.
    lines: Vec<([Point; 2], Option<Range>)>,
    boxes: Boxes,
}

impl Lines {
    /// Lines of a marker: contours, slits and holes.
    pub(super) fn of(marker: &Marker) -> Self {
        let mut lines = Vec::new();
        for piece in &marker.pieces {
            for &Contour { range, .. } in &piece.contours {
                lines.extend(marker.list.lines(range).map(|ends| (ends, Some(range))));
            }
            let slits = piece.notches.iter().flat_map(Notch::strokes).map(|stroke| [stroke.from, stroke.to]);
            let holes = piece.drills.iter().map(|drill| [drill.at; 2]);
            lines.extend(slits.chain(holes).map(|ends| (ends, None)));
        }
        let boxes = Boxes::new(lines.iter().map(|([from, to], _)| Extent::between(*from, *to)).collect());
        Self { lines, boxes }
    }

    /// Cost of splitting an outline at a border; `None` where it must not be split.
    pub(super) fn cost(&self, ring: &Ring, x: f64, lap: Lap) -> Option<u32> {
        let crossings = ring.crossings(x);
        crossings.iter().map(|&(at, _)| self.cost_at(ring, at, lap)).sum()
    }

    fn cost_at(&self, ring: &Ring, at: f64, lap: Lap) -> Option<u32> {
        let reach = lap.length() + FREE;
        if ring.length() < 4.0 * reach {
            return None;
        }
        let line = ring.between(at - reach, at + reach);
        let [from, to] = [line[0].from, line[line.len() - 1].to];
        let along = polyline::direction(from, to)?;
        let bow = line.iter().map(|segment| polyline::distance_to_line(segment.to, from, along)).fold(0.0, f64::max);
        let bends = |ends: &[Segment]| direction(&ends[0]).dot(&direction(&ends[1])) < MOST_TURN.cos();
        let is_plain = |segment: &Segment| segment.joint == Joint::default() && segment.percent == line[0].percent;
        if along.x.abs() < LEAST_SINE
            || bow > MOST_BOW
            || line.windows(2).any(bends)
            || !line[1..].iter().all(is_plain)
            || self.is_crowded(ring, (at, reach), lap)
        {
            return None;
        }
        Some(if bow > CURVE { CURVE_COST } else { COST })
    }

    /// True if any other line, or the same one farther on, is in the way of the halves of a split at a station; the halves
    /// reach `reach` mm along the line.
    fn is_crowded(&self, ring: &Ring, (at, reach): (f64, f64), lap: Lap) -> bool {
        let line = ring.between(at - reach, at + reach);
        let chord = [line[0].from, line[line.len() - 1].to];
        let clear = lap.clear + MOST_BOW;
        let is_near = |ends: [Point; 2]| polyline::distance_of_segments(ends, chord) <= clear;
        let near = self.boxes.near(Extent::between(chord[0], chord[1]).grown(clear));
        if near.map(|i| self.lines[i]).any(|(ends, of)| of != Some(ring.range) && is_near(ends)) {
            return true;
        }
        let beyond = reach + clear + ROOM;
        let rest = ring.between(at + beyond, at - beyond + ring.length());
        rest.iter().any(|segment| is_near([segment.from, segment.to]))
    }
}
