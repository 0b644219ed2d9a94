//! Visits of pieces: in which sequence and from which starts the cuts of one may be made, and how long the moves take.
//!
//! Slits are cut on the way round the outline, from each of them on and either way, then each closed contour from the corner
//! that is nearest in time. What the file asks for at the start of a contour holds there, so that such a one is left alone.

use crate::analysis::air::{Air, Stop};
use crate::geom::{Point, corner, polyline};
use crate::ir::list::{Joint, Segment, SegmentList};
use crate::ir::marker::{Contour, OutlineNotch, Piece};

/// Visits of a piece that are looked at, at the most.
const MOST_VISITS: usize = 32;
/// Comparisons of slits with segments of their outline, at the most: of more slits the sequence stays.
const MOST_LOOKS: usize = 10_000_000;
/// Corners of a contour that are looked at, at the most, each either way round.
const MOST_STARTS: usize = 64;

/// What visits are made by.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measures {
    /// How long moves take.
    pub(super) air: Air,
    /// Greatest turn that is no corner, rad.
    pub(super) corner: f64,
    /// What coordinates are multiples of, mm.
    pub(super) unit: f64,
}

/// A sequence of the cuts of a piece.
#[derive(Debug, Clone)]
pub(super) struct Visit {
    /// The notches that are drawn as slits, by their places in the piece.
    pub(super) slits: Vec<usize>,
    /// Where each contour starts.
    pub(super) starts: Vec<Begin>,
    /// Where the knife first comes down, and where it last comes up.
    pub(super) ends: [Stop; 2],
    /// Time of the moves between them, s.
    pub(super) within: f64,
}

/// How a contour is begun.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Begin {
    /// The segment that starts where it is begun, by its place among those of the contour; of an open one the first.
    pub(super) segment: usize,
    /// Whether it is cut against its direction from there on.
    pub(super) is_reversed: bool,
}

/// A start of a contour.
#[derive(Debug, Clone, Copy)]
struct Start {
    begin: Begin,
    /// Where the knife comes down then, and where it comes up.
    stops: [Stop; 2],
}

/// Chooses a start of a contour by where the knife came up before.
type Choice<'a> = dyn Fn(Option<&Stop>, &[Start]) -> Start + 'a;

/// A piece as it may be visited.
pub(super) struct Cuts {
    /// Holes, in the order of the file.
    drills: Vec<Stop>,
    /// Slits, with where each stands on the outline, mm from its start.
    slits: Vec<([Stop; 2], f64)>,
    /// For each contour where it may start, as the file has it first.
    contours: Vec<Vec<Start>>,
}

impl Cuts {
    pub(super) fn of(piece: &Piece, list: &SegmentList, measures: &Measures) -> Self {
        let air = &measures.air;
        let contours: Vec<Vec<Segment>> = piece.contours.iter().map(|c| segments(c, list)).collect();
        let is_few = |outline: &Vec<Segment>| outline.len() * piece.notches.len() <= MOST_LOOKS;
        let is_closed = piece.contours.last().is_some_and(|last| last.closed);
        let outline = contours.last().filter(|outline| is_closed && is_few(outline));
        let slits = piece.notches.iter().map(|notch| {
            let strokes: Vec<_> = notch.strokes().collect();
            let [first, last] = [strokes[0], strokes[strokes.len() - 1]];
            let ends = [air.down(first.from, first.to), air.up(last.from, last.to)];
            (ends, outline.map_or(0.0, |outline| station(outline, notch.root)))
        });
        Self {
            drills: piece.drills.iter().map(|drill| air.drill(drill.at)).collect(),
            slits: slits.collect(),
            contours: piece.contours.iter().zip(&contours).map(|(c, of)| starts(c, of, piece, measures)).collect(),
        }
    }

    /// Whether anything is cut or drilled.
    pub(super) fn is_empty(&self) -> bool {
        self.drills.is_empty() && self.slits.is_empty() && self.contours.is_empty()
    }

    /// The visit as it is drawn.
    pub(super) fn as_is(&self, air: &Air) -> Visit {
        self.visit((0..self.slits.len()).collect(), &|_, starts| starts[0], air)
    }

    /// The ways in which it may be visited, that of the file first.
    pub(super) fn visits(&self, air: &Air) -> Vec<Visit> {
        let count = self.slits.len();
        let mut visits = vec![self.as_is(air)];
        let mut round: Vec<usize> = (0..count).collect();
        round.sort_by(|&a, &b| self.slits[a].1.total_cmp(&self.slits[b].1));
        let nearest = |before: Option<&Stop>, starts: &[Start]| {
            let time = |start: &Start| before.map_or(0.0, |before| air.time(before, &start.stops[0]));
            let best = starts.iter().min_by(|a, b| time(a).total_cmp(&time(b)));
            *best.unwrap_or(&starts[0])
        };
        let step = (2 * count).div_ceil(MOST_VISITS).max(1);
        for first in (0..count).step_by(step) {
            let onward: Vec<usize> = (0..count).map(|i| round[(first + i) % count]).collect();
            let back: Vec<usize> = (0..count).map(|i| round[(first + count - i) % count]).collect();
            visits.extend([onward, back].map(|slits| self.visit(slits, &nearest, air)));
        }
        if count == 0 && !self.contours.is_empty() {
            let step = self.contours[0].len().div_ceil(MOST_VISITS);
            for start in self.contours[0].iter().skip(1).step_by(step) {
                let from_it = |before: Option<&Stop>, starts: &[Start]| {
                    if before.is_none() { *start } else { nearest(before, starts) }
                };
                visits.push(self.visit(Vec::new(), &from_it, air));
            }
        }
        visits
    }

    /// The visit with slits in a sequence, each contour from the start that is chosen by where the knife was before.
    fn visit(&self, slits: Vec<usize>, choose: &Choice, air: &Air) -> Visit {
        let mut ends: Vec<[Stop; 2]> = self.drills.iter().map(|&stop| [stop; 2]).collect();
        ends.extend(slits.iter().map(|&slit| self.slits[slit].0));
        let mut starts = Vec::with_capacity(self.contours.len());
        for contour in &self.contours {
            let Start { begin, stops } = choose(ends.last().map(|ends| &ends[1]), contour);
            starts.push(begin);
            ends.push(stops);
        }
        let within = ends.windows(2).map(|pair| air.time(&pair[0][1], &pair[1][0])).sum();
        Visit { slits, starts, ends: [ends[0][0], ends[ends.len() - 1][1]], within }
    }
}

/// Of the visits of each piece in an order those that take the least time together, with that time, s: dynamic programming,
/// exact.
pub(super) fn choose(order: &[usize], visits: &[Vec<Visit>], home: &Stop, air: &Air) -> (Vec<usize>, f64) {
    // For each visit of each piece the best one of the piece before.
    let mut came: Vec<Vec<usize>> = Vec::with_capacity(order.len());
    let mut spent: Vec<f64> = Vec::new();
    for (i, &piece) in order.iter().enumerate() {
        let before = i.checked_sub(1).map(|before| &visits[order[before]]);
        let best = |visit: &Visit| match before {
            None => (0, air.time(home, &visit.ends[0])),
            Some(before) => {
                let times = before.iter().zip(&spent).map(|(b, spent)| spent + air.time(&b.ends[1], &visit.ends[0]));
                times.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).expect("each piece has a visit")
            }
        };
        let reached: Vec<(usize, f64)> = visits[piece]
            .iter()
            .map(|visit| (best(visit), visit.within))
            .map(|((from, time), within)| (from, time + within))
            .collect();
        came.push(reached.iter().map(|reached| reached.0).collect());
        spent = reached.into_iter().map(|reached| reached.1).collect();
    }
    let mut chosen = vec![0; visits.len()];
    let (mut at, time) = spent.into_iter().enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default();
    for (i, &piece) in order.iter().enumerate().rev() {
        chosen[piece] = at;
        at = came[i][at];
    }
    (chosen, time)
}

fn segments(contour: &Contour, list: &SegmentList) -> Vec<Segment> {
    list.walk(contour.range).map(|(_, segment)| segment).collect()
}

/// How far from the start of an outline the place of it is that is nearest to a point, mm.
fn station(outline: &[Segment], point: Point) -> f64 {
    let mut start = 0.0;
    let mut best = (f64::INFINITY, 0.0);
    for segment in outline {
        let away = polyline::distance_to_segment(point, segment.from, segment.to);
        if away < best.0 {
            let length = segment.length();
            let along = (point - segment.from).dot(&(segment.to - segment.from)) / length;
            best = (away, start + along.clamp(0.0, length));
        }
        start += segment.length();
    }
    best.1
}

/// Where a contour may start: as it does, and, if the file asks for nothing on it, at its other end, or a closed one at its
/// corners, either way round.
fn starts(contour: &Contour, of: &[Segment], piece: &Piece, measures: &Measures) -> Vec<Start> {
    let &Measures { air, corner: limit, unit } = measures;
    let count = of.len();
    let start = |segment: usize, is_reversed: bool| {
        let begin = Begin { segment, is_reversed };
        // The last segment of a closed one ends where the first starts.
        let (first, last) = (&of[segment], &of[(segment + count - 1) % count]);
        let stops = if is_reversed {
            [air.down(last.to, last.from), air.up(first.to, first.from)]
        } else {
            [air.down(first.from, first.to), air.up(last.from, last.to)]
        };
        Start { begin, stops }
    };
    let mut found = vec![start(0, false)];
    let is_plain = of.iter().all(|segment| segment.joint == Joint::default() && segment.percent == of[0].percent);
    if is_plain {
        found.push(start(0, true));
    }
    if !contour.closed || !is_plain || count < 3 {
        return found;
    }
    let is_corner = |&i: &usize| {
        let before = (1..count).map(|k| of[(i + count - k) % count].from);
        let behind = (0..count - 1).map(|k| of[(i + k) % count].to);
        corner::is_corner(of[i].from, &before, &behind, limit, unit)
    };
    let on_notch = on_notches(of, &piece.outline_notches);
    let corners: Vec<usize> = (1..count).filter(|&i| !on_notch[i]).filter(is_corner).collect();
    let step = corners.len().div_ceil(MOST_STARTS).max(1);
    found
        .extend(corners.into_iter().step_by(step).flat_map(|i| [false, true].map(|is_reversed| start(i, is_reversed))));
    found
}

/// Which points of a closed contour are of notches that it makes, mouths included.
fn on_notches(of: &[Segment], notches: &[OutlineNotch]) -> Vec<bool> {
    let count = of.len();
    let mut found = vec![false; count];
    for notch in notches {
        let opens = |&i: &usize| {
            of[i].from == notch.mouth[0] && of[(i + notch.segments as usize - 1) % count].to == notch.mouth[1]
        };
        if let Some(first) = (0..count).find(opens) {
            (0..=notch.segments as usize).for_each(|k| found[(first + k) % count] = true);
        }
    }
    found
}
