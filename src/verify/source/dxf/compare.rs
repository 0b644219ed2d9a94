//! A marker as it was read against what its file cuts, place by place.

use super::cloth::cloth;
use super::cuts::{Cuts, MEETS, Mark};
use crate::geom::{Point, polyline};
use crate::ir::finding::Sighting;
use crate::ir::marker::{Notch, NotchKind};
use crate::ir::{Finding, Marker};
use crate::machine::Job;
use crate::verify::worst::{Worst, at};

/// Rounding of places on a table that is a kilometre long, mm, and of sums of lengths, as a part of them.
const PLACE_EPSILON: f64 = 1e-6;
const LENGTH_EPSILON: f64 = 1e-9;
/// How far a notch may be from its point, mm.
const NOTCH_OFF: f64 = 1.0;
/// How much shorter than the edge a mouth may be that is cut into it, as a part.
const MOUTH_SHORTER: f64 = 0.05;

/// Where a marker cuts, as it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct CutPlaces {
    contours: Vec<Vec<(Point, u32)>>,
    notches: Vec<Notch>,
    holes: Vec<(Point, u32)>,
}

impl CutPlaces {
    /// Those of a marker before any pass, each with the block that it comes from.
    pub fn of(marker: &Marker) -> Self {
        let line = |(_, contour): (usize, &crate::ir::marker::Contour)| {
            let mut line: Vec<(Point, u32)> =
                marker.list.vertices(contour.range).map(|(at, span)| (at, span.block)).collect();
            // What leads to the first place of a closed one is told by its last.
            if let (true, Some(last)) = (contour.closed, line.last().copied()) {
                line[0] = last;
            }
            line
        };
        Self {
            contours: marker.contours().map(line).collect(),
            notches: marker.pieces.iter().flat_map(|piece| piece.notches.iter().copied()).collect(),
            holes: marker.pieces.iter().flat_map(|piece| &piece.drills).map(|d| (d.at, d.span.block)).collect(),
        }
    }
}

/// Points by X, to be looked up.
struct Lookup(Vec<Point>);

impl Lookup {
    fn of(points: impl Iterator<Item = Point>) -> Self {
        let mut points: Vec<Point> = points.collect();
        points.sort_by(|a, b| a.x.total_cmp(&b.x));
        Self(points)
    }

    /// Whether one of them is so near to a place.
    fn has(&self, at: Point, reach: f64) -> bool {
        let first = self.0.partition_point(|point| point.x < at.x - reach);
        let near = self.0[first..].iter().take_while(|point| point.x <= at.x + reach);
        near.into_iter().any(|point| (point - at).norm() <= reach)
    }
}

/// Compares a marker as it was read with a scan of the bytes of a set of patterns.
pub fn pattern_audit(bytes: &[u8], read: &CutPlaces, job: &Job) -> Vec<Finding> {
    let (cuts, off) = cloth(bytes, job);
    let reach = PLACE_EPSILON + off;
    let mut marks = cuts.marks.clone();
    marks.sort_by_key(|mark| mark.block);
    let lines: Vec<Line> = read.contours.iter().map(|contour| Line::of(contour, &marks)).collect();
    vec![
        points(&cuts, &lines, reach),
        holes(&cuts, read, reach),
        length(&cuts, &lines),
        notches(&marks, read, &lines, reach),
    ]
}

/// A contour, its notches apart.
#[derive(Debug, Default)]
struct Line {
    /// Its places but those of notches, and the two ends of their mouths.
    drawn: Vec<(Point, u32)>,
    /// Places of notches.
    notched: Vec<(Point, u32)>,
    /// Widths of the mouths, mm.
    widths: Vec<f64>,
}

/// The marks of a block among all, which are sorted by it.
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

/// How many places of the file no line comes to, and how many of the lines the file does not have.
fn points(cuts: &Cuts, lines: &[Line], reach: f64) -> Finding {
    let mut worst = Worst::new("source/points", "points", Some(0.0));
    let mut count = 0.0;
    let mut see = |point: Point, block: u32| {
        count += 1.0;
        worst.see(count, || Sighting { time: None, line: None, point, block });
    };
    let of_marker = Lookup::of(lines.iter().flat_map(|line| &line.drawn).map(|place| place.0));
    let notched: Vec<u32> = lines.iter().flat_map(|line| &line.notched).map(|place| place.1).collect();
    let mut notched = notched;
    notched.sort_unstable();
    let mouths: Vec<&Mark> = cuts.marks.iter().filter(|mark| notched.binary_search(&mark.block).is_ok()).collect();
    let widest = mouths.iter().map(|mark| mark.width).fold(0.0, f64::max) / 2.0 + NOTCH_OFF;
    let in_a_mouth = Lookup::of(mouths.iter().map(|mark| mark.at));
    for place in &cuts.places {
        let reach = if place.is_end { MEETS + reach } else { reach };
        if !of_marker.has(place.at, reach) && !in_a_mouth.has(place.at, widest) {
            see(place.at, 0);
        }
    }
    let of_file = Lookup::of(cuts.places.iter().map(|place| place.at));
    let mut next = lines.iter().flat_map(|line| &line.drawn).filter(|place| notched.binary_search(&place.1).is_err());
    next.by_ref().for_each(|&(at, block)| {
        let is_on_curve = || cuts.rounds.iter().any(|round| ((at - round.centre).norm() - round.radius).abs() <= reach);
        if !of_file.has(at, reach) && !is_on_curve() {
            see(at, block);
        }
    });
    worst.finding()
}

/// How many holes are missing or too many.
fn holes(cuts: &Cuts, read: &CutPlaces, reach: f64) -> Finding {
    let mut worst = Worst::new("source/drills", "holes", Some(0.0));
    let [of_file, of_marker] =
        [Lookup::of(cuts.holes.iter().copied()), Lookup::of(read.holes.iter().map(|hole| hole.0))];
    let missing = cuts.holes.iter().filter(|at| !of_marker.has(**at, reach)).count();
    let wrong = read.holes.iter().filter(|(at, _)| !of_file.has(*at, reach)).count();
    let differ = cuts.holes.len().abs_diff(read.holes.len()).max(missing + wrong);
    worst.see(differ as f64, || at(0.0, Point::origin(), 0));
    worst.finding()
}

/// Whether the lines are as long as those of the file, their notches apart.
fn length(cuts: &Cuts, lines: &[Line]) -> Finding {
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
    let mut worst = Worst::new("source/length", "mm", Some(limit));
    worst.see((length - cuts.length).abs(), || at(0.0, Point::origin(), 0));
    worst.finding()
}

impl Cuts {
    /// Whether ends of lines miss each other.
    fn gaps(&self) -> bool {
        let ends = || self.places.iter().filter(|place| place.is_end);
        let mut points: Vec<[f64; 2]> = ends().map(|place| [place.at.x, place.at.y]).collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        // Each has one at least at the same place, to rounding.
        !points
            .chunk_by(|a, b| (a[0] - b[0]).abs() <= PLACE_EPSILON && (a[1] - b[1]).abs() <= PLACE_EPSILON)
            .all(|same| same.len() > 1)
    }
}

/// How many notches no point of the file asks for, at its place and as deep as it says.
fn notches(marks: &[Mark], read: &CutPlaces, lines: &[Line], reach: f64) -> Finding {
    let mut worst = Worst::new("source/notches", "notches", Some(0.0));
    let mut count = 0.0;
    let mut see = |point: Point, block: u32| {
        count += 1.0;
        worst.see(count, || Sighting { time: None, line: None, point, block });
    };
    for notch in &read.notches {
        let is_asked = |mark: &Mark| {
            let is_bar = match notch.kind {
                NotchKind::Slit => true,
                NotchKind::T(bar) => {
                    let middle = bar.from + (bar.to - bar.from) / 2.0;
                    let width = if mark.width > 0.0 { mark.width } else { mark.depth };
                    (middle - notch.tip).norm() <= reach && (bar.length() - width).abs() <= reach
                }
            };
            (notch.root - mark.at).norm() <= NOTCH_OFF + reach && (notch.depth() - mark.depth).abs() <= reach && is_bar
        };
        if !of_block(marks, notch.span.block).iter().any(is_asked) {
            see(notch.tip, notch.span.block);
        }
    }
    for &(at, block) in lines.iter().flat_map(|line| &line.notched) {
        let is_asked = |mark: &Mark| (at - mark.at).norm() <= mark.depth.hypot(mark.width / 2.0) + NOTCH_OFF + reach;
        if !of_block(marks, block).iter().any(is_asked) {
            see(at, block);
        }
    }
    worst.finding()
}
