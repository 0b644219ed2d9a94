//! Signs at an edge that are drawn like notches: the barbs of an arrow and the arms of a cross.
//!
//! Two strokes of one length from one foot, at equal angles to the bisector between them, are an arrow. Two that halve each
//! other are a cross; so are four arms from one place.

use std::collections::BTreeSet;

use super::line::{Line, is_straight};
use super::marks::{Mark, Search};
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, Vector, cross};
use crate::ir::marker::Notch;

/// Greatest difference of the barbs, as a fraction of their length.
const ALIKE: f64 = 0.1;
/// Half the angle between the barbs of an arrow, rad.
const BARBS: [f64; 2] = [0.1, 1.3];
/// Greatest angle between the stem of an arrow and the way between its barbs, rad.
const STEM: f64 = 0.2;
/// Shares of their lengths at which the arms of a cross halve each other, and the greatest ratio of these lengths.
const HALF: [f64; 2] = [0.3, 0.7];
const LONGER: f64 = 1.5;
/// Number of strokes beside an arm that meet in the middle of a cross.
const ARMS: usize = 3;

/// Lines among some marks that are signs and no notches. Strokes meet within `touch` mm.
pub(super) fn among(marks: &[Mark], search: Search, touch: f64, work: &mut Budget) -> BTreeSet<usize> {
    let mut signs = BTreeSet::new();
    arrows(marks, touch, &mut signs, work);
    let around = |mark: &Mark| Extent::between(mark.cut[0], mark.cut[1]).grown(touch);
    let boxes = Boxes::new(marks.iter().map(around).collect());
    let may_be_arm = |line: &Line| !line.is_closed && !line.is_set_aside() && line.length <= LONGER * Notch::LONGEST;
    let mut meeting = vec![0; marks.len()];
    for i in (0..search.lines.len()).filter(|&i| may_be_arm(&search.lines[i])) {
        let line = &search.lines[i];
        if !work.spend(boxes.cost_near(&line.extent)) {
            break;
        }
        let places = line.vertices(search.vertices);
        let arm = [places[0].at, places[places.len() - 1].at];
        for k in boxes.near(line.extent).filter(|&k| marks[k].line != i) {
            let mark = marks[k].cut;
            let ends = arm.iter().filter(|end| (*end - mark[1]).norm() <= touch).count();
            meeting[k] += ends;
            if is_straight(places) && are_cross(mark, arm) {
                signs.insert(marks[k].line);
            }
        }
    }
    signs.extend(marks.iter().zip(meeting).filter(|(_, ends)| *ends >= ARMS).map(|(mark, _)| mark.line));
    signs
}

/// Crosses among the lines without a class: the first stroke of each, and its middle.
pub(super) fn crosses(search: Search, work: &mut Budget) -> Vec<(usize, Point)> {
    let Search { lines, vertices, .. } = search;
    let may_be = |&i: &usize| {
        let line = &lines[i];
        !line.is_closed
            && line.is_open_question()
            && line.length <= Notch::LONGEST
            && is_straight(line.vertices(vertices))
    };
    let strokes: Vec<usize> = (0..lines.len()).filter(may_be).collect();
    let boxes = Boxes::new(strokes.iter().map(|&i| lines[i].extent).collect());
    let ends = |k: usize| {
        let places = lines[strokes[k]].vertices(vertices);
        [places[0].at, places[places.len() - 1].at]
    };
    let mut found = Vec::new();
    for (k, &stroke) in strokes.iter().enumerate() {
        if !work.spend(boxes.cost_near(&boxes.all()[k])) {
            break;
        }
        let own = ends(k);
        if boxes.near(boxes.all()[k]).filter(|&other| other > k).any(|other| are_cross(own, ends(other))) {
            found.push((stroke, own[0] + (own[1] - own[0]) / 2.0));
        }
    }
    found
}

/// Whether two strokes halve each other and are about as long.
fn are_cross(one: [Point; 2], other: [Point; 2]) -> bool {
    let is_half = |at: [f64; 2]| at.iter().all(|at| (HALF[0]..=HALF[1]).contains(at));
    are_alike([one, other].map(length), LONGER) && halves(one, other).is_some_and(is_half)
}

/// Finds the marks that are barbs of arrows, or their stem.
fn arrows(marks: &[Mark], touch: f64, signs: &mut BTreeSet<usize>, work: &mut Budget) {
    let roots = Boxes::new(marks.iter().map(|mark| Extent::between(mark.cut[0], mark.cut[0]).grown(touch)).collect());
    for (k, mark) in marks.iter().enumerate() {
        if !work.spend(roots.cost_at(mark.cut[0])) {
            return;
        }
        let beside: Vec<&Mark> = roots.at(mark.cut[0]).filter(|&other| other != k).map(|other| &marks[other]).collect();
        for other in &beside {
            let [a, b] = [mark, other].map(|mark| (mark.cut[1] - mark.cut[0]).normalize());
            let half = cross(a, b).abs().atan2(a.dot(&b)) / 2.0;
            if !are_alike([mark.cut, other.cut].map(length), 1.0 + ALIKE) || !(BARBS[0]..=BARBS[1]).contains(&half) {
                continue;
            }
            let is_stem = |way: Vector| cross(a + b, way).abs().atan2((a + b).dot(&way)) <= STEM;
            signs.extend([mark.line, other.line]);
            signs.extend(beside.iter().filter(|stem| is_stem(stem.cut[1] - stem.cut[0])).map(|stem| stem.line));
        }
    }
}

fn length([a, b]: [Point; 2]) -> f64 {
    (b - a).norm()
}

fn are_alike([a, b]: [f64; 2], ratio: f64) -> bool {
    a.max(b) <= ratio * a.min(b)
}

/// The crossing of two straight strokes, as shares of their lengths; `None` for those that are nearly parallel.
fn halves([a, b]: [Point; 2], [c, d]: [Point; 2]) -> Option<[f64; 2]> {
    let (one, other) = (b - a, d - c);
    let turn = cross(one, other);
    let is_across = turn.abs() >= BARBS[0] * one.norm() * other.norm() && turn != 0.0;
    is_across.then(|| [cross(c - a, other) / turn, cross(c - a, one) / turn])
}
