//! Repeated strokes: each has the places of an earlier one, in either direction, and a pen of the same use. A whole plot may be
//! drawn twice, an outline, or a notch; a single stroke may go there and back.
//!
//! Two parts that share an edge may both draw it, which is not a repetition: other strokes continue from its ends to both
//! sides. Therefore the copies of a stroke are removed only if no place remains at which more than two strokes meet. If all
//! strokes that meet do so twice, half of the copies are removed: the parts were drawn twice, each with its own edges.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::line::{Class, Line};
use super::pens::Use;
use crate::geom::again::{Course, Step, course, turns_back};
use crate::geom::{Point, bits};
use crate::ir::drawing::{Drawing, PenStroke, Vertex};
use crate::ir::marker::Notch;

/// Greatest number of ends in one cell that are compared: more are the centre of a star, and nothing is removed there.
const MOST_ENDS: usize = 32;

/// Equal strokes, in the order of the file.
type Set = Vec<usize>;

/// Removes repeated strokes from a drawing, except those whose places were `laid` in order. Ends within `reach` of each other,
/// mm, may belong to one line.
pub(super) fn take(drawing: &mut Drawing, uses: &[Use], laid: &Range<usize>, reach: f64) -> Vec<PenStroke> {
    let mut again = there_and_back(drawing);
    let sets = sets(drawing, uses, laid);
    if sets.is_empty() {
        return again;
    }
    let mut taken = vec![false; drawing.strokes.len()];
    let (closed, open): (Vec<Set>, Vec<Set>) = sets.into_iter().partition(|set| is_closed(drawing, set[0]));
    closed.iter().flat_map(|set| &set[1..]).for_each(|&stroke| taken[stroke] = true);
    for stroke in Open::new(drawing, open, reach).again() {
        taken[stroke] = true;
    }
    let mut flags = taken.iter();
    again.extend(drawing.strokes.extract_if(.., |_| flags.next().is_some_and(|&is_taken| is_taken)));
    again
}

/// Lines of repeated strokes.
pub(super) fn lines(strokes: Vec<PenStroke>, drawing: &Drawing, uses: &[Use]) -> impl Iterator<Item = Line> {
    strokes.into_iter().map(|stroke| {
        let usage = uses.get(usize::from(stroke.pen)).copied().unwrap_or(Use::Ignore);
        let line = Line::of(&drawing.vertices[stroke.range()], stroke.first, usage);
        Line { class: Class::Again, ..line }
    })
}

/// Replaces a stroke there and back by the lines that it draws, and removes its repetitions. A short straight one stays: it is
/// a notch.
fn there_and_back(drawing: &mut Drawing) -> Vec<PenStroke> {
    let mut again = Vec::new();
    for k in 0..drawing.strokes.len() {
        let stroke = drawing.strokes[k];
        let range = stroke.range();
        if !turns_back(range.len(), |place| drawing.vertices[range.start + place].at) {
            continue; // the usual case
        }
        let vertices = drawing.vertices[range].to_vec();
        let places: Vec<Point> = vertices.iter().map(|vertex| vertex.at).collect();
        let is_slit = |course: &Course| course.straight(&places).is_some_and(|length| length <= Notch::LONGEST);
        let Some(course) = course(&places).filter(|course| !is_slit(course)) else { continue };
        let mut add = |row: &[Step]| {
            let first = drawing.vertices.len() as u32;
            let vertex = |step: &Step| Vertex { at: places[step.place], span: vertices[step.led].span };
            drawing.vertices.extend(row.iter().map(vertex));
            PenStroke { first, end: first + row.len() as u32, pen: stroke.pen }
        };
        again.extend(course.again.iter().map(|row| add(row)));
        let paths: Vec<PenStroke> = course.paths.iter().map(|path| add(path)).collect();
        drawing.strokes[k] = paths[0];
        drawing.strokes.extend(&paths[1..]);
    }
    again
}

fn is_closed(drawing: &Drawing, stroke: usize) -> bool {
    let range = drawing.strokes[stroke].range();
    drawing.vertices[range.start].at == drawing.vertices[range.end - 1].at
}

/// Sets of at least two equal strokes.
fn sets(drawing: &Drawing, uses: &[Use], laid: &Range<usize>) -> Vec<Set> {
    let usage = |k: usize| uses.get(usize::from(drawing.strokes[k].pen)).copied().unwrap_or(Use::Ignore);
    let places = |k: usize| drawing.strokes[k].range().map(|i| bits(drawing.vertices[i].at));
    // The sums of both ends already distinguish most strokes from all others.
    let common = |k: usize| {
        let range = drawing.strokes[k].range();
        let [[ax, ay], [bx, by]] = [range.start, range.end - 1].map(|i| bits(drawing.vertices[i].at));
        (range.len(), ax.wrapping_add(bx), ay.wrapping_add(by))
    };
    let is_meant = |k: &usize| !laid.contains(&drawing.strokes[*k].range().start) && usage(*k) != Use::Ignore;
    let meant = (0..drawing.strokes.len()).filter(is_meant);
    let mut alike: Vec<((usize, u64, u64), usize)> = meant.map(|k| (common(k), k)).collect();
    alike.sort_unstable();
    // A stroke is compared in the direction whose places sort first.
    let is_back = |k: usize| places(k).rev().cmp(places(k)) == Ordering::Less;
    let alike = alike.chunk_by(|a, b| a.0 == b.0).filter(|set| set.len() > 1).flatten();
    let mut keyed: Vec<(Use, usize, bool, usize)> =
        alike.map(|&((length, ..), k)| (usage(k), length, is_back(k), k)).collect();
    let order = |a: &(Use, usize, bool, usize), b: &(Use, usize, bool, usize)| {
        let ways = match (a.2, b.2) {
            (false, false) => places(a.3).cmp(places(b.3)),
            (false, true) => places(a.3).cmp(places(b.3).rev()),
            (true, false) => places(a.3).rev().cmp(places(b.3)),
            (true, true) => places(a.3).rev().cmp(places(b.3).rev()),
        };
        (a.0, a.1).cmp(&(b.0, b.1)).then(ways)
    };
    keyed.sort_unstable_by(|a, b| order(a, b).then(a.3.cmp(&b.3)));
    let same = keyed.chunk_by(|a, b| order(a, b) == Ordering::Equal).filter(|set| set.len() > 1);
    same.map(|set| set.iter().map(|key| key.3).collect()).collect()
}

/// Repeated open strokes among all others.
struct Open<'a> {
    drawing: &'a Drawing,
    sets: Vec<Set>,
    /// Set of each stroke.
    set_of: Vec<Option<usize>>,
    /// Strokes with an end in each cell, and the size of a cell, mm.
    cells: BTreeMap<[i64; 2], Vec<usize>>,
    reach: f64,
}

/// Strokes that meet the ends of a set.
struct Meeting {
    /// Other sets.
    sets: BTreeSet<usize>,
    /// True if more than two strokes would meet at an end with each drawn once.
    is_crossing: bool,
    /// True if some stroke there is drawn an odd number of times.
    is_odd: bool,
}

impl<'a> Open<'a> {
    fn new(drawing: &'a Drawing, sets: Vec<Set>, reach: f64) -> Self {
        let mut open = Self { drawing, sets, set_of: Vec::new(), cells: BTreeMap::new(), reach };
        if open.sets.is_empty() {
            return open;
        }
        open.set_of = vec![None; drawing.strokes.len()];
        for (k, set) in open.sets.iter().enumerate() {
            for &stroke in set {
                open.set_of[stroke] = Some(k);
            }
        }
        for stroke in (0..drawing.strokes.len()).filter(|&k| !is_closed(drawing, k)) {
            for end in open.ends(stroke) {
                open.cells.entry(open.cell(end)).or_default().push(stroke);
            }
        }
        open
    }

    fn ends(&self, stroke: usize) -> [Point; 2] {
        let range = self.drawing.strokes[stroke].range();
        [range.start, range.end - 1].map(|k| self.drawing.vertices[k].at)
    }

    fn cell(&self, at: Point) -> [i64; 2] {
        [at.x, at.y].map(|mm| (mm / self.reach).floor() as i64)
    }

    /// Repeated strokes.
    fn again(&self) -> Vec<usize> {
        let meetings: Vec<Meeting> = (0..self.sets.len()).map(|set| self.meeting(set)).collect();
        let mut again = Vec::new();
        let mut seen = vec![false; self.sets.len()];
        for first in 0..self.sets.len() {
            if std::mem::replace(&mut seen[first], true) {
                continue;
            }
            // Connected sets.
            let mut group = vec![first];
            let mut next = 0;
            while let Some(&set) = group.get(next) {
                next += 1;
                for &other in &meetings[set].sets {
                    if !std::mem::replace(&mut seen[other], true) {
                        group.push(other);
                    }
                }
            }
            let is_simple = group.iter().all(|&set| !meetings[set].is_crossing);
            let is_double = group.iter().all(|&set| !meetings[set].is_odd);
            let pen = self.widest_pen(&group);
            for &set in group.iter().filter(|_| is_simple || is_double) {
                let mut strokes = self.sets[set].clone();
                strokes.sort_by_key(|&stroke| self.drawing.strokes[stroke].pen != pen);
                let kept = if is_simple { 1 } else { strokes.len() / 2 };
                again.extend(strokes.split_off(kept));
            }
        }
        again
    }

    /// Pen that draws the most strokes of some sets, so that the rest can be joined; the first of several.
    fn widest_pen(&self, group: &[usize]) -> u16 {
        let mut counts: BTreeMap<u16, usize> = BTreeMap::new();
        let pens = group.iter().flat_map(|&set| &self.sets[set]).map(|&stroke| self.drawing.strokes[stroke].pen);
        pens.for_each(|pen| *counts.entry(pen).or_default() += 1);
        let widest = counts.into_iter().max_by(|a, b| a.1.cmp(&b.1).then(b.0.cmp(&a.0)));
        widest.map_or(0, |(pen, _)| pen)
    }

    /// Strokes that meet both ends of a set.
    fn meeting(&self, set: usize) -> Meeting {
        let mut meeting = Meeting { sets: BTreeSet::new(), is_crossing: false, is_odd: self.sets[set].len() % 2 == 1 };
        for end in self.ends(self.sets[set][0]) {
            // Other strokes, by the first one of their set.
            let mut others = BTreeSet::new();
            let [column, row] = self.cell(end);
            for cell in (column - 1..=column + 1).flat_map(|c| (row - 1..=row + 1).map(move |r| [c, r])) {
                let Some(there) = self.cells.get(&cell) else { continue };
                if there.len() > MOST_ENDS {
                    (meeting.is_crossing, meeting.is_odd) = (true, true);
                    continue;
                }
                let is_near = |&&stroke: &&usize| {
                    self.set_of[stroke] != Some(set)
                        && self.ends(stroke).iter().any(|other| (other - end).norm() <= self.reach)
                };
                others.extend(there.iter().filter(is_near).map(|&k| self.set_of[k].map_or(k, |set| self.sets[set][0])));
            }
            meeting.is_crossing |= others.len() > 1;
            for first in others {
                meeting.is_odd |= self.set_of[first].is_none_or(|set| self.sets[set].len() % 2 == 1);
                meeting.sets.extend(self.set_of[first]);
            }
        }
        meeting
    }
}
