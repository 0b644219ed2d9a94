//! Notches that are drawn as strokes of their own: from the edge of a part inwards.

use std::collections::BTreeMap;

use arrayvec::ArrayVec;

use super::line::{Class, Line, ROUNDING, SHORTEST_NOTCH, is_straight};
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::near::{Near, sorted};
use crate::geom::polyline::distance_of_segments;
use crate::geom::{Extent, Point, polyline, ring};
use crate::ir::drawing::Vertex;
use crate::ir::marker::Notch;

/// Distance from its edge within which the other end of a mark is on the edge, too, mm: such a line lies along it, or leads
/// from edge to edge.
pub(super) const TOUCH: f64 = 0.1;
/// Farthest that a place of a crossbar lies off the straight line between its ends, mm: rounding of decimals.
const ON_LINE: f64 = 1e-6;
/// Distance from an outline within which the end of a stroke as long as a notch is reported, mm: it may be a notch that misses
/// its edge.
const NEAR: f64 = 2.0;
/// Longest stroke across an edge that may be a notch, mm: as far outside as inside.
const LONGEST_ACROSS: f64 = 2.0 * Notch::LONGEST;
/// Samples of lines that may divide a part, as fractions of their length.
const PROBES: [f64; 3] = [0.25, 0.5, 0.75];
/// Greatest number of outlines that meet at one place.
const MEETING: usize = 4;

/// A stroke that is a notch of an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mark {
    /// Its line, and the outline that it stands on, as indices of lines.
    pub(super) line: usize,
    pub(super) outline: usize,
    /// From the edge inwards.
    pub(super) cut: [Point; 2],
    /// Index of its vertex that leads to the tip.
    pub(super) leg: usize,
    /// Index of the line that is its crossbar.
    pub(super) bar: Option<usize>,
    /// Distance of its start from the edge, mm.
    pub(super) miss: f64,
}

/// A stroke that may be a notch, by its shape: a whole line, or one of two legs.
pub(super) struct Candidate {
    pub(super) line: usize,
    leg: usize,
    /// True if the line has another leg.
    is_leg: bool,
    pub(super) ends: [Point; 2],
    /// The outlines that each end stands on, with the distance.
    pub(super) on: [ArrayVec<(f64, usize), MEETING>; 2],
}

impl Candidate {
    /// A line as a whole, by its ends.
    pub(super) fn whole(line: usize, ends: [Point; 2]) -> Self {
        Self { line, leg: 0, is_leg: false, ends, on: [ArrayVec::new(), ArrayVec::new()] }
    }
}

/// Data of a search for marks.
#[derive(Debug, Clone, Copy)]
pub(super) struct Search<'a> {
    pub(super) lines: &'a [Line],
    pub(super) vertices: &'a [Vertex],
    /// Length of a unit, mm.
    pub(super) unit: f64,
    /// Closed lines that may have notches.
    pub(super) outlines: &'a [usize],
}

/// A stroke of a line: the index of the vertex that leads to its end, and both its ends.
type Stroke = (usize, [Point; 2]);

/// The stroke of a straight line that may be a notch.
fn stroke(vertices: &[Vertex]) -> Option<Stroke> {
    let first = vertices[0].at;
    let far =
        |(_, a): &(usize, &Vertex), (_, b): &(usize, &Vertex)| (a.at - first).norm().total_cmp(&(b.at - first).norm());
    let (place, tip) = vertices.iter().enumerate().max_by(far).filter(|_| is_straight(vertices))?;
    Some((place, [first, tip.at])).filter(|stroke| is_notch(stroke.1))
}

/// The legs of a line that may be notches: two slits that face each other across the common edge of two parts and were
/// drawn or joined as one line.
fn legs(vertices: &[Vertex]) -> Option<[Stroke; 2]> {
    let (first, last) = (vertices[0].at, vertices[vertices.len() - 1].at);
    let legs = match vertices {
        [_, edge, _] if is_straight(vertices) => [(1, [edge.at, first]), (2, [edge.at, last])],
        [_, edge, other, _] if is_straight(vertices) && (other.at - edge.at).norm() <= Notch::MISS => {
            [(1, [edge.at, first]), (3, [other.at, last])]
        }
        _ => return None,
    };
    legs.iter().all(|leg| is_notch(leg.1)).then_some(legs)
}

fn is_notch([a, b]: [Point; 2]) -> bool {
    (SHORTEST_NOTCH..=Notch::LONGEST).contains(&(b - a).norm())
}

/// Notches among the open lines without a class.
pub(super) fn on_outlines(search: Search, work: &mut Budget) -> Vec<Mark> {
    let Search { lines, vertices, unit, .. } = search;
    let open = (0..lines.len()).filter(|&i| !lines[i].is_closed && lines[i].is_open_question());
    let mut candidates: Vec<Candidate> = Vec::new();
    for line in open.filter(|&i| lines[i].length <= Notch::LONGEST_STROKE) {
        let vertices = lines[line].vertices(vertices);
        let whole = stroke(vertices).map(|stroke| (false, stroke));
        let legs = legs(vertices).into_iter().flatten().map(|leg| (true, leg));
        for (is_leg, (leg, ends)) in whole.into_iter().chain(legs) {
            candidates.push(Candidate { line, leg, is_leg, ends, on: [ArrayVec::new(), ArrayVec::new()] });
        }
    }
    if candidates.is_empty() {
        return Vec::new();
    }
    let slack = ROUNDING * unit;
    meet(&mut candidates, search, Notch::MISS + slack, work);
    let mut marks: Vec<(bool, Mark)> = Vec::new();
    for candidate in &candidates {
        // A line that is a notch as a whole has no legs.
        let is_taken = marks.last().is_some_and(|(is_leg, mark)| mark.line == candidate.line && !is_leg);
        if let Some(mark) = mark(candidate, search, TOUCH + slack, work).filter(|_| !is_taken) {
            marks.push((candidate.is_leg, mark));
        }
    }
    // Legs are cut in pairs only.
    let is_kept = |k: usize, (is_leg, mark): &(bool, Mark)| {
        let beside = [k.checked_sub(1), Some(k + 1)].into_iter().flatten().filter_map(|k| marks.get(k));
        !is_leg || beside.filter(|(_, other)| other.line == mark.line).count() == 1
    };
    marks.iter().enumerate().filter(|(k, mark)| is_kept(*k, mark)).map(|(_, mark)| mark.1).collect()
}

/// Finds the outlines that the ends of candidates stand on.
pub(super) fn meet(candidates: &mut [Candidate], search: Search, reach: f64, work: &mut Budget) {
    let Search { lines, vertices, outlines, .. } = search;
    let ends: Vec<Extent> =
        candidates.iter().flat_map(|c| c.ends).map(|end| Extent::between(end, end).grown(reach)).collect();
    let boxes = Boxes::new(ends);
    let place = |candidates: &[Candidate], end: usize| candidates[end / 2].ends[end % 2];
    for &outline in outlines {
        let extent = &lines[outline].extent;
        if !work.spend(boxes.cost_near(extent)) {
            return;
        }
        let mut near: Vec<usize> = boxes.near(*extent).collect();
        near.sort_by(|&a, &b| place(candidates, a).x.total_cmp(&place(candidates, b).x).then(a.cmp(&b)));
        if near.is_empty() {
            continue;
        }
        for edge in lines[outline].vertices(vertices).windows(2) {
            let [a, b] = [edge[0].at, edge[1].at];
            let beside = Extent::between(a, b).grown(reach);
            let first = near.partition_point(|&end| place(candidates, end).x < beside.min.x);
            for &end in &near[first..] {
                let at = place(candidates, end);
                if at.x > beside.max.x {
                    break;
                }
                if !work.spend(1) {
                    return;
                }
                let distance = if beside.holds(at) { polyline::distance_to_segment(at, a, b) } else { f64::INFINITY };
                if distance <= reach {
                    note(&mut candidates[end / 2].on[end % 2], outline, distance);
                }
            }
        }
    }
}

/// Records the distance of an end from an outline that it stands on.
fn note(on: &mut ArrayVec<(f64, usize), MEETING>, outline: usize, distance: f64) {
    if let Some(known) = on.iter_mut().find(|(_, known)| *known == outline) {
        known.0 = known.0.min(distance);
    } else if !on.is_full() {
        on.push((distance, outline));
    }
}

/// The notch of a candidate: of the outline that it starts on and leads into.
fn mark(candidate: &Candidate, search: Search, touch: f64, work: &mut Budget) -> Option<Mark> {
    let Search { lines, vertices, .. } = search;
    let mut best: Option<(f64, Mark)> = None;
    for (from, to) in [(0, 1), (1, 0)] {
        for &(distance, outline) in &candidate.on[from] {
            let tip = candidate.ends[to];
            let lies_on =
                candidate.on[to].iter().any(|&(beside, other)| other == outline && beside <= touch.max(distance));
            let points = || lines[outline].points(vertices);
            if lies_on
                || best.is_some_and(|(least, _)| least <= distance)
                || !work.spend(lines[outline].vertices(vertices).len())
            {
                continue;
            }
            // A notch leads into a part, and from a cut-out into the cloth around it.
            let is_in = ring::contains(&points(), tip);
            if is_in == (lines[outline].class == Class::Part) {
                let Candidate { line, leg, ends, .. } = *candidate;
                let mark = Mark { line, outline, cut: [ends[from], ends[to]], leg, bar: None, miss: distance };
                best = Some((distance, mark));
            }
        }
    }
    best.map(|(_, mark)| mark)
}

/// True if a stroke goes straight from its first vertex to its last; a T in one stroke does not.
fn goes_straight(places: &[Vertex]) -> bool {
    places.len() == 2 || polyline::is_straight(&places.iter().map(|place| place.at).collect::<Vec<Point>>(), ON_LINE)
}

/// Assigns strokes divided by the tip of a notch to it as crossbars, and returns the lines of these.
pub(super) fn take_crossbars(marks: &mut [Mark], search: Search) -> Vec<usize> {
    let Search { lines, vertices, unit, .. } = search;
    let tips = sorted(marks.iter().map(|mark| mark.cut[1]));
    // A file may be rounded more than the unit of its plotter tells.
    let mut near = Near::within(TOUCH + ROUNDING * unit);
    let mut bars = Vec::new();
    let is_bar = |&i: &usize| {
        let line = &lines[i];
        line.is_open_question() && line.length <= Notch::LONGEST && goes_straight(line.vertices(vertices))
    };
    for bar in (0..lines.len()).filter(is_bar) {
        let places = lines[bar].vertices(vertices);
        let [a, b] = [places[0].at, places[places.len() - 1].at];
        let divides = |mark: &Mark| {
            let tip = mark.cut[1];
            mark.line != bar && mark.bar.is_none() && (tip - a).norm().min((tip - b).norm()) > SHORTEST_NOTCH / 2.0
        };
        let mut nearest: Option<(f64, usize)> = None;
        near.each(&tips, [a, b], |i| {
            let off = polyline::distance_to_segment(marks[i].cut[1], a, b);
            if divides(&marks[i]) && nearest.is_none_or(|(least, _)| off < least) {
                nearest = Some((off, i));
            }
        });
        if let Some((_, i)) = nearest {
            marks[i].bar = Some(bar);
            bars.push(bar);
        }
    }
    bars
}

/// Position of a line at an outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Lie {
    /// An open line starts or ends on it.
    Ends,
    /// An open stroke as long as a notch goes from it to itself, with a mouth that is too wide for one.
    Wide,
    /// An open stroke between two places of it, deeper than a notch.
    Deep,
    /// An open line between two places of it through the inside, longer than a notch: it divides the part.
    Divides,
    /// A dividing line between places where strokes of the outline meet: it may be the common edge of two parts.
    Between,
    /// An open line outside joins two places of it and is longer than a notch: it may bound a part that has an edge in common.
    Outside,
    /// An open line leads from it to another outline.
    Joins,
    /// An open line goes along it.
    Along,
    /// A small closed line touches it, nearly does or lies across it.
    Stands,
    /// A straight stroke of up to twice the length of a notch crosses it, and ends on none.
    Crosses,
    /// Strokes as long as notches begin near it, and stand as letters do.
    Letters,
    /// Strokes as long as notches begin on it, and are barbs of an arrow or arms of a cross.
    Sign,
}

/// A line at an outline that is no notch.
#[derive(Debug, Clone, Copy)]
pub(super) struct EdgeLine {
    pub(super) line: usize,
    pub(super) outline: usize,
    /// The outline that it leads to.
    pub(super) other: Option<usize>,
    pub(super) lie: Lie,
}

/// Open lines without a class that start or end on an outline; also strokes as long as a notch that nearly do.
pub(super) fn from_edges(search: Search, work: &mut Budget) -> Vec<EdgeLine> {
    let Search { lines, vertices, unit, .. } = search;
    let is_open = |line: &Line| !line.is_closed && line.is_open_question();
    let ends = |line: usize| {
        let all = lines[line].vertices(vertices);
        [all[0].at, all[all.len() - 1].at]
    };
    let open = (0..lines.len()).filter(|&i| is_open(&lines[i]));
    let open = open.map(|line| Candidate::whole(line, ends(line)));
    let is_short = |candidate: &Candidate| {
        let (length, [a, b]) = (lines[candidate.line].length, candidate.ends);
        let is_bent = length <= Notch::LONGEST_STROKE && (SHORTEST_NOTCH..=Notch::WIDEST).contains(&(b - a).norm());
        (SHORTEST_NOTCH..=Notch::LONGEST).contains(&length) || is_bent
    };
    let (mut short, mut candidates): (Vec<Candidate>, Vec<Candidate>) = open.partition(is_short);
    for (candidates, reach) in [(&mut short, NEAR), (&mut candidates, TOUCH)] {
        if !candidates.is_empty() {
            meet(candidates, search, reach + ROUNDING * unit, work);
        }
    }
    candidates.extend(short);
    candidates.sort_unstable_by_key(|candidate| candidate.line);
    let mut edge_line = |Candidate { line, on, .. }: &Candidate| {
        let of = |on: &ArrayVec<(f64, usize), MEETING>| {
            on.iter().map(|&(_, outline)| outline).collect::<ArrayVec<_, MEETING>>()
        };
        let [starts, ends] = [of(&on[0]), of(&on[1])];
        let both = starts.iter().filter(|outline| ends.contains(outline));
        let lies: ArrayVec<(usize, Lie), MEETING> =
            both.map(|&outline| (outline, lie(*line, outline, search, work))).collect();
        // Beside one of two parts that touch it may divide the other.
        let inside = lies.iter().find(|(_, lie)| *lie != Lie::Outside);
        if let Some(&(outline, lie)) = inside.or(lies.first()) {
            return Some(EdgeLine { line: *line, outline, other: None, lie });
        }
        match (starts.first(), ends.first()) {
            (Some(&outline), other @ Some(_)) => {
                Some(EdgeLine { line: *line, outline, other: other.copied(), lie: Lie::Joins })
            }
            (Some(&outline), None) | (None, Some(&outline)) => {
                Some(EdgeLine { line: *line, outline, other: None, lie: Lie::Ends })
            }
            (None, None) => None,
        }
    };
    let mut found: Vec<EdgeLine> = candidates.iter().filter_map(&mut edge_line).collect();
    let free = candidates.iter().filter(|candidate| candidate.on.iter().all(ArrayVec::is_empty));
    found.extend(crossing(free.map(|candidate| (candidate.line, candidate.ends)).collect(), search, work));
    found.extend(standing(search, work));
    found
}

/// Short straight strokes across an outline that end at none, each with the first outline that it crosses.
fn crossing(mut strokes: Vec<(usize, [Point; 2])>, search: Search, work: &mut Budget) -> Vec<EdgeLine> {
    let Search { lines, vertices, .. } = search;
    strokes.retain(|&(line, _)| {
        let length = lines[line].length;
        (SHORTEST_NOTCH..=LONGEST_ACROSS).contains(&length) && is_straight(lines[line].vertices(vertices))
    });
    edge_lines(&strokes, Lie::Crosses, 0.0, search, work)
}

/// Lines with a stroke within `reach` mm of an outline: each once, with the first such outline.
fn edge_lines(
    strokes: &[(usize, [Point; 2])],
    lie: Lie,
    reach: f64,
    search: Search,
    work: &mut Budget,
) -> Vec<EdgeLine> {
    let Search { lines, vertices, outlines, .. } = search;
    if strokes.is_empty() {
        return Vec::new();
    }
    let around = |[a, b]: [Point; 2]| Extent::between(a, b).grown(reach);
    let boxes = Boxes::new(strokes.iter().map(|stroke| around(stroke.1)).collect());
    let mut found: BTreeMap<usize, usize> = BTreeMap::new();
    'all: for &outline in outlines {
        let extent = lines[outline].extent;
        if !work.spend(boxes.cost_near(&extent)) || !boxes.near(extent).any(|_| true) {
            continue;
        }
        for edge in lines[outline].vertices(vertices).windows(2).map(|ends| [ends[0].at, ends[1].at]) {
            let beside = Extent::between(edge[0], edge[1]);
            if !work.spend(1 + boxes.cost_near(&beside)) {
                break 'all;
            }
            for (line, stroke) in boxes.near(beside).map(|k| strokes[k]) {
                if !found.contains_key(&line) && work.spend(1) && distance_of_segments(stroke, edge) <= reach {
                    found.insert(line, outline);
                }
            }
        }
    }
    found.into_iter().map(|(line, outline)| EdgeLine { line, outline, other: None, lie }).collect()
}

/// Lie of a line whose ends both lie on an outline.
fn lie(line: usize, outline: usize, Search { lines, vertices, unit, .. }: Search, work: &mut Budget) -> Lie {
    let places = lines[line].points(vertices);
    let longest = if is_straight(lines[line].vertices(vertices)) { Notch::LONGEST } else { Notch::LONGEST_STROKE };
    let outline = lines[outline].points(vertices);
    if lines[line].length <= longest {
        return as_notch(&places);
    }
    if !work.spend(2 * PROBES.len() * outline.len()) {
        return Lie::Ends;
    }
    let stations = polyline::stations(&places);
    let probes = PROBES.map(|share| polyline::place(&places, &stations, share * lines[line].length));
    let is_off = |at: &Point| polyline::distance(*at, &outline) > TOUCH + ROUNDING * unit;
    let mut off = probes.iter().filter(|at| is_off(at)).peekable();
    if off.peek().is_none() {
        Lie::Along
    } else if !off.any(|at| ring::contains(&outline, *at)) {
        Lie::Outside
    } else if lines[line].is_between {
        Lie::Between
    } else {
        Lie::Divides
    }
}

/// Position of a stroke from edge to edge that is no notch: the measure that it violates.
fn as_notch(places: &[Point]) -> Lie {
    let [first, last] = [places[0], places[places.len() - 1]];
    let depth = places.iter().map(|at| polyline::distance_to_segment(*at, first, last)).fold(0.0, f64::max);
    match (last - first).norm() {
        _ if depth < SHORTEST_NOTCH => Lie::Ends,
        mouth if mouth > Notch::WIDEST => Lie::Wide,
        _ if depth > Notch::LONGEST => Lie::Deep,
        _ => Lie::Ends,
    }
}

/// Small closed lines with a place on an outline, or nearly so: closed notches, or signs.
fn standing(search: Search, work: &mut Budget) -> Vec<EdgeLine> {
    let Search { lines, vertices, unit, .. } = search;
    let mut candidates = Vec::new();
    let may_be = |line: &Line| match line.class {
        Class::Sign => true,
        Class::Inner | Class::SmallOutline => line.size() <= Notch::LONGEST + TOUCH,
        _ => false,
    };
    for line in (0..lines.len()).filter(|&i| may_be(&lines[i])) {
        let edges = lines[line].vertices(vertices).windows(2);
        let edges = edges.filter(|ends| (ends[1].at - ends[0].at).norm() >= SHORTEST_NOTCH);
        candidates.extend(edges.map(|ends| Candidate::whole(line, [ends[0].at, ends[1].at])));
    }
    if candidates.is_empty() {
        return Vec::new();
    }
    meet(&mut candidates, search, Notch::MISS + ROUNDING * unit, work);
    let stands = |Candidate { line, on, .. }: &Candidate| {
        let &(_, outline) = on.iter().flatten().next()?;
        Some(EdgeLine { line: *line, outline, other: None, lie: Lie::Stands })
    };
    let mut found: Vec<EdgeLine> = candidates.iter().filter_map(stands).collect();
    found.dedup_by_key(|edge| edge.line);
    found
}
