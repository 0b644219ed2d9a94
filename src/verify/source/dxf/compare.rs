//! Comparison of a marker as read with the cuts of its file, place by place.

use std::collections::BTreeMap;

use super::cloth::cloths;
use super::curves::{Bend, Bow, ON};
use super::cuts::{Cuts, Mark};
use super::lines::{MEETS, Round};
use super::lookup::Lookup;
use super::places::CutPlaces;
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, Vector, cross, left, polyline};
use crate::ir::Finding;
use crate::ir::marker::{Notch, NotchKind};
use crate::ir::verdict::{Rule, Sighting, Worst};
use crate::machine::Job;
use crate::machine::patterns::Dxf;
use crate::verify::rules;

/// Rounding error of places on a table of a kilometre, mm; and of sums of lengths, relative.
const PLACE_EPSILON: f64 = 1e-6;
const LENGTH_EPSILON: f64 = 1e-9;
/// Greatest distance of a notch from its point, mm.
const NOTCH_OFF: f64 = Dxf::NOTCH_OFF;
/// Greatest distance along the edge between points of notches that count as one, mm.
const SAME_PLACE: f64 = 0.2;
/// Greatest turn of a line at a curve point, relative to the turn of its chords.
const SMOOTHER: f64 = 0.75;
/// Place on a line beside a curve point at which a curve has left the chords, as a share of the shorter chord; and its least
/// distance from them there, as a share of the height of a round curve, which reaches three quarters of its height.
const LEFT_AT: f64 = 0.25;
const LEFT_BY: f64 = 0.25;
/// Greatest relative shortfall of a mouth against the edge that it is cut into.
const MOUTH_SHORTER: f64 = 0.05;

/// Compares a marker as read with a scan of the bytes of a set of patterns.
pub fn pattern_audit(bytes: &[u8], read: &CutPlaces, job: &Job) -> Vec<Finding> {
    let mut judged = cloths(bytes, read, job).into_iter().map(|cloth| judged(cloth, read));
    let mut least = judged.next().unwrap_or_default();
    // Pieces that insertions place on top of each other may lie in a row instead. The layout with the fewest differences is
    // the one that the marker was read as.
    while !least.iter().all(Finding::holds)
        && let Some(other) = judged.next()
    {
        let differences = |findings: &[Finding]| {
            findings.iter().filter(|finding| !finding.holds()).map(|finding| finding.worst).sum()
        };
        let [before, now]: [f64; 2] = [&least, &other].map(|findings| differences(findings));
        if now < before {
            least = other;
        }
    }
    least
}

/// Compares the marker with one possible layout of the file, in which places may be off by up to `off` mm.
fn judged((cuts, off): (Cuts, f64), read: &CutPlaces) -> Vec<Finding> {
    let mut marks = cuts.marks.clone();
    marks.sort_by_key(|mark| mark.block);
    let lines: Vec<Line> = read.contours.iter().map(|contour| Line::of(contour, &marks)).collect();
    slide(&mut marks, &cuts.chords, &lines);
    let both = Both { cuts, marks, read, lines, reach: PLACE_EPSILON + off };
    vec![both.points(), both.holes(), both.length(), both.notches()]
}

/// Cuts of the file and of the marker.
struct Both<'a> {
    cuts: Cuts,
    /// Marks of notches, sorted by block.
    marks: Vec<Mark>,
    read: &'a CutPlaces,
    lines: Vec<Line>,
    /// Greatest permitted distance between places, mm.
    reach: f64,
}

/// Contour with its notches separated.
#[derive(Debug, Default)]
struct Line {
    /// Places other than those of notches, and both ends of each notch's mouth.
    drawn: Vec<(Point, u32)>,
    /// Places of notches.
    notched: Vec<(Point, u32)>,
    /// Widths of the mouths, mm.
    widths: Vec<f64>,
}

/// A line without the stretches that go out and straight back.
fn without_spikes(line: &[(Point, u32)]) -> Vec<(Point, u32)> {
    let mut kept: Vec<(Point, u32)> = Vec::with_capacity(line.len());
    for &place in line {
        if kept.len() > 1 && kept[kept.len() - 2].0 == place.0 {
            kept.pop();
        } else {
            kept.push(place);
        }
    }
    kept
}

/// Marks of a block; `marks` is sorted by block.
fn of_block(marks: &[Mark], block: u32) -> &[Mark] {
    let first = marks.partition_point(|mark| mark.block < block);
    let end = marks.partition_point(|mark| mark.block <= block);
    &marks[first..end]
}

impl Line {
    fn of(contour: &[(Point, u32)], marks: &[Mark]) -> Self {
        let mut line = Self::default();
        for run in contour.chunk_by(|a, b| a.1 == b.1) {
            match (of_block(marks, run[0].1).first(), run) {
                (Some(mark), [first, .., last]) => {
                    line.drawn.extend([*first, *last]);
                    line.notched.extend_from_slice(run);
                    line.widths.push(mark.width);
                }
                _ => line.drawn.extend_from_slice(run),
            }
        }
        line
    }
}

/// Edges of lines without their notches.
struct Edges {
    ends: Vec<[Point; 2]>,
    boxes: Boxes,
}

impl Edges {
    fn of(lines: &[Line]) -> Self {
        let ends: Vec<[Point; 2]> =
            lines.iter().flat_map(|line| line.drawn.windows(2)).map(|pair| [pair[0].0, pair[1].0]).collect();
        let boxes = Boxes::new(ends.iter().map(|[a, b]| Extent::between(*a, *b)).collect());
        Self { ends, boxes }
    }

    /// Distance of a point from the nearest edge, mm; infinite beyond `reach`.
    fn distance(&self, at: Point, reach: f64) -> f64 {
        let near = self.boxes.near(Extent::between(at, at).grown(reach));
        near.map(|k| polyline::distance_to_segment(at, self.ends[k][0], self.ends[k][1])).fold(f64::INFINITY, f64::min)
    }

    /// Nearest intersection of a straight line through a point with the edges, within `reach` mm on both sides.
    fn met(&self, at: Point, along: Vector, reach: f64) -> Option<Point> {
        let way = [at - along * reach, at + along * reach];
        let meets = |k: usize| {
            let [a, b] = self.ends[k];
            let [from, to] = [a, b].map(|end| cross(along, end - at));
            let place = a + (b - a) * (from / (from - to));
            (from * to <= 0.0 && from != to && (place - at).norm() <= reach).then_some(place)
        };
        let places = self.boxes.near(Extent::between(way[0], way[1])).filter_map(meets);
        places.min_by(|a, b| (a - at).norm().total_cmp(&(b - at).norm()))
    }
}

/// Moves marks beside a chord that is replaced by a curve perpendicularly onto the curve.
fn slide(marks: &mut [Mark], chords: &[[Point; 2]], lines: &[Line]) {
    if chords.is_empty() || marks.is_empty() {
        return;
    }
    let edges = Edges::of(lines);
    let boxes = Boxes::new(chords.iter().map(|[a, b]| Extent::between(*a, *b).grown(NOTCH_OFF)).collect());
    for mark in marks {
        if edges.distance(mark.at, NOTCH_OFF) <= NOTCH_OFF {
            continue;
        }
        let distance = |k: &usize| polyline::distance_to_segment(mark.at, chords[*k][0], chords[*k][1]);
        let nearest = boxes.at(mark.at).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let Some(k) = nearest.filter(|k| distance(k) <= NOTCH_OFF) else { continue };
        let [a, b] = chords[k];
        let up = left(b - a) / (b - a).norm();
        mark.at = edges.met(mark.at, up, Dxf::CURVE_OFF * (b - a).norm() + NOTCH_OFF).unwrap_or(mark.at);
    }
}

impl Bow {
    /// Greatest distance of a curve from the edge, mm.
    fn height(&self) -> f64 {
        Dxf::CURVE_OFF * (self.ends[1] - self.ends[0]).norm()
    }

    fn extent(&self) -> Extent {
        Extent::between(self.ends[0], self.ends[1]).grown(self.height())
    }

    fn may_reach(&self, at: Point, reach: f64) -> bool {
        polyline::distance_to_segment(at, self.ends[0], self.ends[1]) <= self.height() + reach
    }
}

/// Rule whose value is a count.
struct Count {
    worst: Worst,
    count: f64,
}

impl Count {
    fn of(rule: &'static Rule) -> Self {
        Self { worst: Worst::new(rule, Some(0.0)), count: 0.0 }
    }

    fn see(&mut self, point: Point, block: u32) {
        self.count += 1.0;
        self.worst.see(self.count, || Sighting::missing(point, block));
    }
}

impl Both<'_> {
    /// Finding on the number of places of the file that no line reaches, of places of lines that the file does not have, and of
    /// parts of the file that cannot be understood.
    fn points(&self) -> Finding {
        let Self { cuts, lines, reach, .. } = self;
        let mut wrong = Count::of(&rules::SOURCE_POINTS);
        (0..cuts.faults).for_each(|_| wrong.see(Point::origin(), 0));
        let drawn = || lines.iter().flat_map(|line| &line.drawn);
        let of_marker = Lookup::of(drawn().map(|place| place.0), *reach);
        let ends_of_marker = Lookup::of(drawn().map(|place| place.0), MEETS + reach);
        let mut notched: Vec<u32> = lines.iter().flat_map(|line| &line.notched).map(|place| place.1).collect();
        notched.sort_unstable();
        let mouths: Vec<&Mark> = self.marks.iter().filter(|mark| notched.binary_search(&mark.block).is_ok()).collect();
        let half = |mark: &Mark| mark.width / 2.0 + NOTCH_OFF;
        let of_mouths =
            Lookup::of(mouths.iter().map(|mark| mark.at), mouths.iter().map(|m| half(m)).fold(1.0, f64::max));
        let is_in_a_mouth = |at: Point| of_mouths.near(at).any(|k| (at - mouths[k].at).norm() <= half(mouths[k]));
        let edges = Edges::of(lines);
        for place in &cuts.places {
            if place.is_passed && edges.distance(place.at, ON) <= ON + reach {
                continue;
            }
            let of_lines = if place.is_end { &ends_of_marker } else { &of_marker };
            if !of_lines.has(place.at) && !is_in_a_mouth(place.at) {
                wrong.see(place.at, 0);
            }
        }
        let of_file = Lookup::of(cuts.places.iter().map(|place| place.at).chain(cuts.spare.iter().copied()), *reach);
        let rounds = Boxes::new(cuts.rounds.iter().map(|round| round.extent().grown(*reach)).collect());
        let is_on = |at: Point, round: &Round| ((at - round.centre).norm() - round.radius).abs() <= *reach;
        let bows = Boxes::new(cuts.bows.iter().map(|bow| bow.extent().grown(*reach)).collect());
        for &(at, block) in drawn().filter(|place| notched.binary_search(&place.1).is_err()) {
            let is_on_round = || rounds.at(at).any(|k| is_on(at, &cuts.rounds[k]));
            if !of_file.has(at) && !is_on_round() && !bows.at(at).any(|k| cuts.bows[k].may_reach(at, *reach)) {
                wrong.see(at, block);
            }
        }
        self.bends(&mut wrong);
        wrong.worst.finding()
    }

    /// Counts curve points at which lines lie on both chords and turn as much: no curve was laid through them.
    fn bends(&self, wrong: &mut Count) {
        let Self { cuts, lines, reach, .. } = self;
        let bends = Lookup::of(cuts.bends.iter().map(|bend| bend.at), *reach);
        for line in lines.iter().filter(|_| !cuts.bends.is_empty()) {
            let mut places = line.drawn.clone();
            places.dedup_by(|next, before| next.0 == before.0);
            // A slit that stands on a curve point leaves the curve there, and comes back to it.
            let drawn = without_spikes(&places);
            let points: Vec<Point> = drawn.iter().map(|place| place.0).collect();
            let stations = polyline::stations(&points);
            let is_ring = points.len() > 2 && points[0] == points[points.len() - 1];
            // The last place of a ring is its first.
            for (k, &(at, block)) in drawn.iter().enumerate().skip(usize::from(is_ring)) {
                let lies_on_chords = |bend: &Bend| {
                    let length = stations[stations.len() - 1];
                    [-LEFT_AT, LEFT_AT].into_iter().all(|share| {
                        let station = stations[k] + share * bend.chord();
                        let station = if is_ring { station.rem_euclid(length) } else { station.clamp(0.0, length) };
                        bend.off(polyline::place(&points, &stations, station)) <= LEFT_BY * bend.height
                    })
                };
                let next = if k + 1 < points.len() { k + 1 } else { usize::from(is_ring) };
                let turn = polyline::turn_at(points[k.saturating_sub(1)], at, points[next]).abs();
                let is_bent = |bend: &Bend| turn > SMOOTHER * bend.turn && lies_on_chords(bend);
                if bends.near(at).any(|k| is_bent(&cuts.bends[k])) {
                    wrong.see(at, block);
                }
            }
        }
    }

    /// Finding on the number of missing or surplus holes.
    fn holes(&self) -> Finding {
        let Self { cuts, read, reach, .. } = self;
        let mut worst = Worst::new(&rules::SOURCE_DRILLS, Some(0.0));
        let of_file = Lookup::of(cuts.holes.iter().copied(), *reach);
        let of_marker = Lookup::of(read.holes.iter().map(|hole| hole.0), *reach);
        let missing = cuts.holes.iter().filter(|at| !of_marker.has(**at)).count();
        let wrong = read.holes.iter().filter(|(at, _)| !of_file.has(*at)).count();
        let differ = cuts.holes.len().abs_diff(read.holes.len()).max(missing + wrong);
        worst.see(differ as f64, || Sighting::at(0.0, Point::origin(), 0));
        worst.finding()
    }

    /// Finding on the length of the lines without notches, compared with the file.
    fn length(&self) -> Finding {
        let Self { cuts, lines, .. } = self;
        let of_line = |line: &Line| {
            let points: Vec<Point> = line.drawn.iter().map(|place| place.0).collect();
            polyline::length(&points)
        };
        let length: f64 = lines.iter().map(of_line).sum();
        let mouths: f64 = lines.iter().flat_map(|line| &line.widths).sum();
        // Ends that are joined may each be moved.
        let joined = cuts.places.iter().filter(|place| place.is_end).count() as f64;
        let slack = cuts.slack + MOUTH_SHORTER * mouths + if cuts.gaps() { MEETS * joined } else { 0.0 };
        let limit = LENGTH_EPSILON * (1.0 + length) + slack;
        let mut worst = Worst::new(&rules::SOURCE_LENGTH, Some(limit));
        worst.see((length - cuts.length).abs(), || Sighting::at(0.0, Point::origin(), 0));
        worst.finding()
    }

    /// Finding on the number of notches that no mark of the file requests at their place and depth, and of marks without a
    /// notch that are not reported either.
    fn notches(&self) -> Finding {
        let Self { read, reach, marks, .. } = self;
        let mut wrong = Count::of(&rules::SOURCE_NOTCHES);
        let notched: Vec<(Point, u32)> = self.lines.iter().flat_map(|line| line.notched.iter().copied()).collect();
        let far = |mark: &Mark| mark.depth + mark.width / 2.0 + NOTCH_OFF + reach;
        let farthest =
            marks.iter().filter(|mark| mark.depth <= Notch::LONGEST).map(far).fold(NOTCH_OFF + reach, f64::max);
        let of_marks = Lookup::of(marks.iter().map(|mark| mark.at), farthest);
        for notch in &read.notches {
            let is_asked = |mark: &Mark| mark.asks_for(notch, *reach);
            if !of_marks.near(notch.root).any(|k| is_asked(&marks[k])) {
                wrong.see(notch.tip, notch.span.block);
            }
        }
        for &(at, block) in &notched {
            let is_asked = |mark: &Mark| mark.block == block && (at - mark.at).norm() <= far(mark);
            if !of_marks.near(at).any(|k| is_asked(&marks[k])) {
                wrong.see(at, block);
            }
        }
        self.missing(&notched, &mut wrong);
        wrong.worst.finding()
    }

    /// Counts marks without a notch, except reported ones.
    fn missing(&self, notched: &[(Point, u32)], wrong: &mut Count) {
        let Self { read, reach, marks, .. } = self;
        let made: Vec<(Point, u32)> = read.notches.iter().map(|notch| (notch.root, notch.span.block)).collect();
        let half = |mark: &Mark| mark.width / 2.0 + NOTCH_OFF + reach;
        let widest = notched.iter().filter_map(|place| of_block(marks, place.1).first()).map(half).fold(0.0, f64::max);
        let of_slits = Lookup::of(made.iter().map(|slit| slit.0), NOTCH_OFF + SAME_PLACE + reach);
        let of_ways = Lookup::of(notched.iter().map(|place| place.0), widest.max(NOTCH_OFF) + SAME_PLACE);
        let mut told: BTreeMap<u32, usize> = BTreeMap::new();
        read.left_out.iter().for_each(|&block| *told.entry(block).or_default() += 1);
        for mark in marks {
            // Equal marks at one place count as one.
            let is_like = |block: u32| {
                let other = of_block(marks, block).first();
                block == mark.block || other.is_some_and(|other| other.depth == mark.depth && other.width == mark.width)
            };
            let is_way = |k: usize| is_like(notched[k].1) && (notched[k].0 - mark.at).norm() <= half(mark) + SAME_PLACE;
            let is_made = of_slits.near(mark.at).any(|k| is_like(made[k].1)) || of_ways.near(mark.at).any(is_way);
            match told.get_mut(&mark.block) {
                _ if is_made => {}
                Some(count) if *count > 0 => *count -= 1,
                _ => wrong.see(mark.at, mark.block),
            }
        }
    }
}

impl Mark {
    /// True if the mark requests the notch: same block and depth, and for a T the same width.
    fn asks_for(&self, notch: &Notch, reach: f64) -> bool {
        let is_bar = match notch.kind {
            NotchKind::Slit => true,
            NotchKind::T(bar) => {
                let middle = bar.from + (bar.to - bar.from) / 2.0;
                let width = if self.width > 0.0 { self.width } else { self.depth };
                (middle - notch.tip).norm() <= reach && (bar.length() - width).abs() <= reach
            }
        };
        notch.span.block == self.block
            && (notch.root - self.at).norm() <= NOTCH_OFF + reach
            && (notch.depth() - self.depth).abs() <= reach
            && is_bar
    }
}

impl Cuts {
    /// True if some ends of lines do not coincide.
    fn gaps(&self) -> bool {
        let ends = || self.places.iter().filter(|place| place.is_end);
        let mut points: Vec<[f64; 2]> = ends().map(|place| [place.at.x, place.at.y]).collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        // Each end must coincide with at least one other, up to rounding.
        !points
            .chunk_by(|a, b| (a[0] - b[0]).abs() <= PLACE_EPSILON && (a[1] - b[1]).abs() <= PLACE_EPSILON)
            .all(|same| same.len() > 1)
    }
}
