//! Meetings of strokes: places where the drawing has two cuts meet. The strokes must meet there, or a thread of cloth is left.
//!
//! Two cuts may each be off their line by the tolerance, and to opposite sides; a part that hangs on the thread between them
//! is torn when it is lifted off. Strokes meet at the corners of a contour, where a ring closes and where the knife is lifted
//! amid a line; these are found here, by the lines that the strokes cut. Meetings of different cuts are [`Joints`].

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::body::Cut;
use super::borders::Borders;
use super::joints::{Joints, apart, most_apart};
use super::trial::Trial;
use crate::geom::{Point, cross};
use crate::ir::Finding;
use crate::ir::verdict::{Sighting, Worst};
use crate::verify::reference::common::Joint;
use crate::verify::reference::line::Line;
use crate::verify::reference::lines::Reference;
use crate::verify::rules;

/// Length of an end, in tolerances beside the overlaps: at points of ten degrees and more two cuts cross within it
/// (2 / sin 10 degrees).
const CROSSING: f64 = 12.0;
/// Greatest share of a stroke that counts as its end, if the stroke meets its own other end.
const END_SHARE: f64 = 0.3;
/// Least share of a line that a stroke must cut to meet its own other end.
const ROUND_SHARE: f64 = 0.5;

/// Ends of strokes at the places where they must meet.
#[derive(Debug)]
pub(in crate::verify) struct Meetings<'a> {
    reference: &'a Reference<'a>,
    /// Meetings of different cuts.
    joints: Joints<'a>,
    /// Meetings of cuts in different windows of a conveyor.
    pub(in crate::verify) borders: Borders<'a>,
    /// Corners by the line that begins there.
    corners: BTreeMap<usize, Corner>,
    /// Lines that begin at a corner whose strokes meet.
    met: Vec<bool>,
    /// Strokes on lines that no stroke cuts from end to end.
    parts: BTreeMap<usize, Vec<Part>>,
    /// Length of the end of a stroke that another may meet, mm.
    reach: f64,
    worst: Worst,
    limit: f64,
}

/// A corner whose strokes have not met so far.
#[derive(Debug, Default)]
struct Corner {
    /// Ends of strokes on the line that ends there, and on the one that begins there.
    ends: [Vec<End>; 2],
}

/// The end of a stroke: a polyline that it cuts.
type End = Vec<Point>;

/// A stroke on a part of a line.
#[derive(Debug)]
struct Part {
    /// Stations between which it cuts the line, mm.
    over: [f64; 2],
    /// Its two ends, in the order of the line.
    ends: [End; 2],
}

impl<'a> Meetings<'a> {
    /// Starts with nothing cut; strokes overlap by `overlaps` mm, and a thread may be `limit` mm wide.
    pub(in crate::verify) fn new(reference: &'a Reference<'a>, joints: &'a [Joint], overlaps: f64, limit: f64) -> Self {
        Self {
            reference,
            joints: Joints::new(joints),
            borders: Borders::default(),
            corners: BTreeMap::new(),
            met: vec![false; reference.lines.len()],
            parts: BTreeMap::new(),
            reach: overlaps + CROSSING * reference.tolerance,
            worst: Worst::new(&rules::JOINT, Some(limit)),
            limit,
        }
    }

    /// Records the stretch that a stroke cuts of its line.
    pub(in crate::verify) fn see(&mut self, cut: &Cut, trial: &Trial) {
        let line = &self.reference.lines[trial.line];
        self.joints.see(&cut.points, line.cut.index);
        self.borders.see(&cut.points, line.cut.index);
        let over = trial.stretches.iter().copied().reduce(|[a, b], [low, high]| [a.min(low), b.max(high)]);
        let Some(over @ [low, high]) = over else { return };
        let corners = [self.begins(trial.line), self.next(trial.line)];
        let is_round = line.ring || corners[0].is_some() && corners[0] == corners[1];
        let meets_itself = is_round && high - low > ROUND_SHARE * line.length();
        let [first, last] = self.ends(cut, meets_itself);
        if trial.laps {
            return self.worst.see(closing(&[first, last]), || sighting(line, low));
        }
        let ends = if trial.sign(cut) > 0.0 { [first, last] } else { [last, first] };
        let is_at = [low <= self.limit, high >= line.length() - self.limit].map(|is_at| is_at && !line.ring);
        if is_at == [true; 2] {
            let [start, end] = ends;
            self.meet(corners[0], 1, start);
            self.meet(corners[1], 0, end);
            return;
        }
        for (k, (corner, end)) in corners.into_iter().zip(&ends).enumerate().filter(|(k, _)| is_at[*k]) {
            self.meet(corner, 1 - k, end.clone());
        }
        self.parts.entry(trial.line).or_default().push(Part { over, ends });
    }

    /// The two ends of a stroke; the first includes the blade's body at the plunge. A blade that does not move is both ends.
    /// The ends of a stroke that meets itself are disjoint.
    fn ends(&self, cut: &Cut, meets_itself: bool) -> [End; 2] {
        if cut.is_plunge_cut() {
            let blade = cut.blade().to_vec();
            return [blade.clone(), blade];
        }
        let (start, whole) = (cut.stations[cut.body], cut.length());
        let reach = if meets_itself { self.reach.min(END_SHARE * (whole - start)) } else { self.reach };
        let way = &cut.stations[cut.body..];
        let until = way.partition_point(|&station| station < start + reach).min(way.len() - 1);
        let from = way.partition_point(|&station| station <= whole - reach).saturating_sub(1);
        let tips = &cut.points[cut.body..];
        let heel = (cut.body > 0).then_some(cut.points[0]);
        let end = |heel: Option<Point>, tips: &[Point]| heel.into_iter().chain(tips.iter().copied()).collect();
        // If the stroke is short, its end lies beside the body that plunged.
        let is_short = whole - start < reach;
        [end(heel, &tips[..=until]), end(heel.filter(|_| is_short), &tips[from..])]
    }

    /// The corner at which a line begins, given by the index of that line; `None` at the start of an open cut, and for a ring.
    fn begins(&self, index: usize) -> Option<usize> {
        let (line, lines) = (&self.reference.lines[index], &self.reference.lines);
        let follows = index > 0 && lines[index - 1].cut.index == line.cut.index;
        (!line.ring && (follows || line.cut.round.is_some())).then_some(index)
    }

    /// The corner at which a line ends, given by the line that begins there; `None` at the end of an open cut, and for a ring.
    fn next(&self, index: usize) -> Option<usize> {
        let (line, lines) = (&self.reference.lines[index], &self.reference.lines);
        if line.ring {
            return None;
        }
        if lines.get(index + 1).is_some_and(|next| next.cut.index == line.cut.index) {
            return Some(index + 1);
        }
        let before = lines[..index].iter().rev().take_while(|before| before.cut.index == line.cut.index);
        line.cut.round.map(|_| index - before.count())
    }

    /// Records the end of a stroke at a corner; side 0 = on the line that ends there, 1 = on the line that begins there.
    fn meet(&mut self, corner: Option<usize>, side: usize, end: End) {
        let Some(corner) = corner.filter(|&corner| !self.met[corner]) else { return };
        let known = self.corners.entry(corner).or_default();
        if known.ends[1 - side].iter().any(|other| is_crossed(&end, other)) {
            self.met[corner] = true;
            self.corners.remove(&corner);
        } else {
            known.ends[side].push(end);
        }
    }

    /// Width of the widest thread that is left.
    pub(in crate::verify) fn finding(mut self) -> Finding {
        let lines = &self.reference.lines;
        let of_corners: Vec<(&usize, &Corner)> = self.corners.iter().collect();
        let at_corners = of_corners.par_iter().map(|(line, corner)| (corner.gap(), sighting(&lines[**line], 0.0)));
        let of_parts: Vec<(&usize, &Vec<Part>)> = self.parts.iter().collect();
        let amid = of_parts.par_iter().map(|(line, parts)| widest(&lines[**line], parts, self.reach));
        let found: Vec<(f64, Sighting)> = at_corners.chain(amid).collect();
        for (gap, place) in found {
            self.worst.see(gap, || place);
        }
        self.joints.see_gaps(&mut self.worst);
        self.borders.see_gaps(&mut self.worst);
        self.worst.finding()
    }
}

impl Corner {
    /// Least distance of the strokes on its two lines, mm; 0 if one line is not cut there, which `verify/complete` reports.
    fn gap(&self) -> f64 {
        let [before, behind] = &self.ends;
        let pairs = before.iter().flat_map(|one| behind.iter().map(move |other| (one, other)));
        pairs.map(|(one, other)| apart(one, other, most_apart(one, other))).reduce(f64::min).unwrap_or(0.0)
    }
}

/// Bottleneck of the connections from stroke to stroke along a line, mm, and its place: from the first stroke to the last, or
/// once round a ring.
fn widest(line: &Line, parts: &[Part], reach: f64) -> (f64, Sighting) {
    let mut parts: Vec<([f64; 2], &[End; 2])> =
        parts.iter().map(|part| (on_first_lap(line, part.over), &part.ends)).collect();
    parts.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    if line.ring {
        let ([low, high], ends) = parts[0];
        parts.push(([low + line.length(), high + line.length()], ends));
    }
    let mut gaps: Vec<(f64, usize, usize)> = Vec::new();
    for (i, (over, ends)) in parts.iter().enumerate() {
        let near = parts[i + 1..].iter().take_while(|(other, _)| other[0] <= over[1] + reach);
        // A ring that is cut in one go meets itself.
        let is_round = |j: usize| line.ring && i == 0 && j + 1 == parts.len();
        let gap = |j: usize, others: &[End; 2]| if is_round(j) { closing(ends) } else { gap(ends, others) };
        gaps.extend((i + 1..).zip(near).map(|(j, (_, others))| (gap(j, others), i, j)));
    }
    gaps.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    let mut groups = Groups((0..parts.len()).collect());
    let last = (0..parts.len()).max_by(|&a, &b| parts[a].0[1].total_cmp(&parts[b].0[1])).unwrap_or(0);
    let last = if line.ring { parts.len() - 1 } else { last };
    for (gap, i, j) in gaps {
        groups.join(i, j);
        if groups.of(0) == groups.of(last) {
            return (gap, sighting(line, parts[j].0[0]));
        }
    }
    // Strokes farther apart leave a stretch uncut, which `verify/complete` reports.
    (0.0, sighting(line, 0.0))
}

/// Disjoint sets of strokes: the parent of each; the first stroke of a set is its own parent.
struct Groups(Vec<usize>);

impl Groups {
    /// First stroke of the set of `stroke`, with path halving (Tarjan & van Leeuwen, *Worst-case analysis of set union
    /// algorithms*, 1984).
    fn of(&mut self, mut stroke: usize) -> usize {
        while self.0[stroke] != stroke {
            self.0[stroke] = self.0[self.0[stroke]];
            stroke = self.0[stroke];
        }
        stroke
    }

    fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.of(one), self.of(other));
        self.0[one.max(other)] = one.min(other);
    }
}

/// Stations of a stretch; on a ring, moved to its first lap.
fn on_first_lap(line: &Line, [low, high]: [f64; 2]) -> [f64; 2] {
    let lap = if line.ring { (low / line.length()).floor() * line.length() } else { 0.0 };
    [low - lap, high - lap]
}

/// Distance of the two ends of one stroke, mm.
fn closing([first, last]: &[End; 2]) -> f64 {
    apart(first, last, most_apart(first, last))
}

/// Least distance of the ends of two strokes, mm.
fn gap(ends: &[End; 2], others: &[End; 2]) -> f64 {
    // In nearly all cases the end of one meets the start of the other.
    if is_crossed(&ends[1], &others[0]) {
        return 0.0;
    }
    let pairs = ends.iter().flat_map(|one| others.iter().map(move |other| (one, other)));
    pairs.fold(f64::INFINITY, |least, (one, other)| apart(one, other, least.min(most_apart(one, other))))
}

/// True if two polylines that are nearly straight surely cross: each passes through the chord of the other at the same place.
fn is_crossed(one: &[Point], other: &[Point]) -> bool {
    let passes = |line: &[Point], chord: &[Point]| {
        let (from, way) = (chord[0], chord[chord.len() - 1] - chord[0]);
        let is_left = |point: &Point| cross(way, point - from) > 0.0;
        let first = is_left(&line[0]);
        line[1..].iter().position(|point| is_left(point) != first)
    };
    let (Some(i), Some(j)) = (passes(one, other), passes(other, one)) else { return false };
    apart(&one[i..i + 2], &other[j..j + 2], f64::MIN_POSITIVE) == 0.0
}

/// A place of the drawing without a time of the program.
fn sighting(line: &Line, station: f64) -> Sighting {
    let station = if line.ring { station.rem_euclid(line.length()) } else { station.clamp(0.0, line.length()) };
    Sighting::missing(line.place(station), line.block(line.chord_at(station)))
}
