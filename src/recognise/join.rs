//! Joining of strokes that continue each other: plots lift the pen inside an outline, some write every line separately, in any
//! direction, and outlines end a few units from their start.
//!
//! Ends of one pen at exactly the same coordinates are at one place, and so are two that are within reach of each other and of
//! no third. If two ends are left at a place after the removal of dead ends, they continue each other. If more are left, a line
//! that returns to the place closes; otherwise the two with the least turn continue each other. Two strokes of one notch drawn
//! twice are not joined, and a slit between two strokes of an outline is skipped. A line that starts and ends on the edge of
//! the frame, or runs past its start, is an outline of its own: its neighbours end in the same places.

use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;
use std::ops::Range;

use super::again;
use super::bridge::Gaps;
use super::chains::{Chains, End, other, place};
use super::close::along;
use super::line::{Closing, Line, SHORTEST_NOTCH, SMALL_OUTLINE};
use super::pens::{self, Use};
use super::slits::Slits;
use super::succession::Ends;
use super::tails;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::closing;
use crate::geom::{Extent, Point, Vector, angle, bits, cross, polyline};
use crate::ir::drawing::{Drawing, Moved, PenStroke, Redrawn, Vertex};
use crate::ir::marker::Notch;
use crate::machine::Job;
use crate::source::Span;

/// Greatest gap between two ends along an axis, in units of the file and in mm: plots of several CAD systems end their outlines
/// 0.025 to 0.1 mm from their start. Four units, plus half a unit for the rounding of fractions.
const REACH_UNITS: f64 = 4.5;
const REACH: f64 = 0.2;
/// Number of places of a stroke that is a rectangle.
const RECTANGLE: std::ops::RangeInclusive<usize> = 4..=6;
/// Least number of places of a line that goes around something and returns: a triangle's.
const LEAST_RING: usize = 4;
/// Greatest number of ends at one place that are tested for a continuation: more are the centre of a star or a hatching.
const MOST_ENDS: usize = 8;
/// Greatest turn of a line that continues, rad.
const SHARPEST: f64 = FRAC_PI_2;
/// Length of a line from which its direction at an end is taken, mm, and the greatest number of places for it.
const STRETCH: f64 = 1.0;
const MOST_STEPS: usize = 64;

/// Pen, and cell of a grid.
type Cell = (u16, [i64; 2]);

/// Greatest gap along an axis between two places that are meant to be one, in a file with that unit, mm.
pub(super) fn reach(unit: f64) -> f64 {
    if unit > 0.0 { (REACH_UNITS * unit).min(REACH) } else { REACH }
}

/// Joins the strokes of a drawing. Returns its lines, whose places are among its vertices, and the displacements made. Strokes
/// whose places were `laid` in order are never repetitions.
pub(super) fn join(drawing: &mut Drawing, laid: &Range<usize>, job: &Job, work: &mut Budget) -> (Vec<Line>, Moved) {
    let uses = pens::uses(&drawing.pens, job);
    let reach = reach(drawing.unit);
    let close = job.profile.drawing.close_mm;
    let again = again::take(drawing, &uses, laid, close.max(reach));
    tails::split(drawing, reach);
    let mut joining = Joining { reach, close, strokes: drawing.strokes.len(), drawing, moved: Moved::default() };
    joining.close_alone();
    let (chains, is_between) = joining.chains(work);
    let strokes = std::mem::take(&mut joining.drawing.strokes);
    let mut taken = vec![false; strokes.len()];
    let mut lines = Vec::with_capacity(strokes.len());
    for i in 0..strokes.len() {
        if taken[i] {
            continue;
        }
        let start = chains.start(i);
        let stroke = match chains.links[other(start)] {
            None => strokes[i],
            Some(_) => joining.chain(&strokes, &chains, start, &mut taken),
        };
        let usage = uses.get(usize::from(stroke.pen)).copied().unwrap_or(Use::Ignore);
        let mut line = Line::of(&joining.drawing.vertices[stroke.range()], stroke.first, usage);
        let ends = [start, other(chains.from(start).last().unwrap_or(start))];
        line.is_between = !line.is_closed && ends.iter().all(|&end| is_between.get(end) == Some(&true));
        let bridges = chains.from(start).filter(|end| end / 2 >= joining.strokes);
        let bridges = bridges.map(|end| &joining.moved.closed[end / 2 - joining.strokes]);
        let longest = bridges.map(|bridge| (polyline::length(bridge), bridge[0])).max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((length, at)) = longest {
            line.closing = Closing::Bridged(length, at);
        }
        lines.push(line);
    }
    lines.extend(again::lines(again, joining.drawing, &uses));
    (lines, joining.moved)
}

struct Joining<'a> {
    reach: f64,
    /// Widest gap that is closed, mm.
    close: f64,
    /// Number of strokes in the file; later ones are bridges.
    strokes: usize,
    drawing: &'a mut Drawing,
    moved: Moved,
}

impl Joining<'_> {
    /// Moves the last place of a stroke that nearly closes to its first.
    fn close_alone(&mut self) {
        for k in 0..self.drawing.strokes.len() {
            let range = self.drawing.strokes[k].range();
            let vertices = &mut self.drawing.vertices[range];
            let (first, last) = (vertices[0].at, vertices.len() - 1);
            let gap = (vertices[last].at - first).amax();
            if vertices.len() < LEAST_RING || gap == 0.0 || gap > self.reach || vertices[last - 1].at == first {
                continue;
            }
            let from = std::mem::replace(&mut vertices[last].at, first);
            let before = vertices[last - 1].at;
            self.moved.redrawn.push(Redrawn { drawn: vec![before, from], now: [before, first] });
        }
    }

    /// Chains of the strokes, with a stroke added where a gap is bridged, and true for each end at whose place others continue
    /// without its stroke.
    fn chains(&mut self, work: &mut Budget) -> (Chains, Vec<bool>) {
        let frame = self.frame();
        let open = |k: &usize| {
            let ends = [place(self.drawing, 2 * k), place(self.drawing, 2 * k + 1)];
            ends[0] != ends[1] && !frame.is_some_and(|frame| self.ends_at(&frame, *k)) && !self.retraces(*k)
        };
        let ends: Vec<End> = (0..self.drawing.strokes.len()).filter(open).flat_map(|k| [2 * k, 2 * k + 1]).collect();
        if ends.is_empty() {
            return (Chains::alone(self.drawing.strokes.len()), Vec::new());
        }
        let mut graph = Graph::new(self, self.nodes(ends.clone()));
        graph.put_dead_ends_aside();
        graph.set_slits_apart(work);
        graph.link(work);
        let is_left = graph.left();
        let mut chains = graph.chains;
        if self.close <= self.reach {
            return (chains, is_left); // nearer ends are joined already
        }
        let is_free = |end: &End| chains.links[*end].is_none() && !self.nearly_closes(end / 2);
        let free: Vec<End> = ends.into_iter().filter(is_free).collect();
        let gaps = Gaps { drawing: self.drawing, chains: &chains, ends: &free, close: self.close };
        for pair in gaps.bridges() {
            self.bridge(pair);
            chains.join_over(pair);
        }
        (chains, is_left)
    }

    /// Adds the straight stroke from an end to another.
    fn bridge(&mut self, [from, to]: [End; 2]) {
        let ends = [from, to].map(|end| place(self.drawing, end));
        let (first, pen) = (self.drawing.vertices.len() as u32, self.drawing.strokes[from / 2].pen);
        self.drawing.vertices.extend(ends.map(|at| Vertex { at, span: Span::default() }));
        self.drawing.strokes.push(PenStroke { first, end: first + 2, pen });
        self.moved.closed.push(ends.to_vec());
    }

    /// True if a stroke closes by itself and runs on.
    fn retraces(&self, stroke: usize) -> bool {
        let vertices = &self.drawing.vertices[self.drawing.strokes[stroke].range()];
        closing::retrace(vertices.len(), |k| vertices[k].at, closing::reach(self.drawing.unit)).is_some()
    }

    /// True if a stroke goes around something and ends near enough to its start to be closed.
    fn nearly_closes(&self, stroke: usize) -> bool {
        let vertices = &self.drawing.vertices[self.drawing.strokes[stroke].range()];
        let [first, .., last] = vertices else { return false };
        (last.at - first.at).norm() <= self.close && vertices.iter().any(|at| (at.at - first.at).amax() > SMALL_OUTLINE)
    }

    /// True if a stroke may be a notch by itself, with a mouth and a tip.
    fn is_notch(&self, stroke: usize) -> bool {
        let vertices = &self.drawing.vertices[self.drawing.strokes[stroke].range()];
        let [first, _, .., last] = vertices else { return false };
        if (last.at - first.at).norm() > Notch::WIDEST {
            return false; // the usual case
        }
        let places: Vec<Point> = vertices.iter().map(|vertex| vertex.at).collect();
        let is_deep = |at: &Point| polyline::distance_to_segment(*at, first.at, last.at) >= SHORTEST_NOTCH;
        polyline::length(&places) <= Notch::LONGEST_STROKE && places.iter().any(is_deep)
    }

    /// Place of a stroke that is farthest from the line between its ends.
    fn tip(&self, stroke: usize) -> Option<Point> {
        let vertices = &self.drawing.vertices[self.drawing.strokes[stroke].range()];
        let [first, .., last] = vertices else { return None };
        let depth = |vertex: &Vertex| polyline::distance_to_segment(vertex.at, first.at, last.at);
        vertices.iter().max_by(|a, b| depth(a).total_cmp(&depth(b))).map(|vertex| vertex.at)
    }

    /// True if a stroke may be a slit by itself: straight, with the length of one.
    fn is_slit(&self, stroke: usize) -> bool {
        let vertices = &self.drawing.vertices[self.drawing.strokes[stroke].range()];
        let length = (vertices[vertices.len() - 1].at - vertices[0].at).norm();
        vertices.len() == 2 && (SHORTEST_NOTCH..=Notch::LONGEST).contains(&length)
    }

    /// Largest rectangle drawn by one stroke.
    fn frame(&self) -> Option<Extent> {
        let drawing = &self.drawing;
        let rectangles = drawing.strokes.iter().filter(|stroke| RECTANGLE.contains(&stroke.range().len()));
        let lines = rectangles.map(|stroke| Line::of(&drawing.vertices[stroke.range()], stroke.first, Use::Unsaid));
        let frames =
            lines.filter(|line| line.is_closed && line.is_rectangle(self.close) && line.size() > SMALL_OUTLINE);
        frames.max_by(|a, b| a.area.total_cmp(&b.area)).map(|line| line.extent)
    }

    /// True if a frame closes a stroke. A stroke along its edge is a side of an outline.
    fn ends_at(&self, frame: &Extent, stroke: usize) -> bool {
        let vertices = &self.drawing.vertices[self.drawing.strokes[stroke].range()];
        let ends = [vertices[0].at, vertices[vertices.len() - 1].at];
        let is_side = |on: &[Vertex]| along(frame, [on[0].at, on[1].at], self.close).is_some_and(|at| at.is_empty());
        (ends[1] - ends[0]).amax() > SMALL_OUTLINE
            && along(frame, ends, self.close).is_some()
            && !vertices.windows(2).all(is_side)
    }

    /// Groups of at least two ends at one place.
    fn nodes(&self, ends: Vec<End>) -> Vec<Vec<End>> {
        let key = |end: End| (self.drawing.strokes[end / 2].pen, bits(place(self.drawing, end)), end);
        let mut keyed: Vec<(u16, [u64; 2], End)> = ends.into_iter().map(key).collect();
        keyed.sort_unstable();
        let (mut alone, mut nodes) = (Vec::new(), Vec::new());
        for group in keyed.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            match group {
                [one] => alone.push(one.2),
                _ => nodes.push(group.iter().map(|(.., end)| *end).collect()),
            }
        }
        nodes.extend(self.near_pairs(&alone, self.reach).into_iter().map(|pair| pair.to_vec()));
        nodes
    }

    /// Pairs of ends within reach of each other and of no third.
    fn near_pairs(&self, ends: &[End], reach: f64) -> Vec<[End; 2]> {
        let cell = |end: End| {
            let at = place(self.drawing, end);
            let [x, y] = [at.x, at.y].map(|mm| (mm / reach).floor() as i64);
            ((self.drawing.strokes[end / 2].pen, [x, y]), end)
        };
        let mut cells: Vec<(Cell, End)> = ends.iter().map(|&end| cell(end)).collect();
        cells.sort_unstable();
        let only = self.only_near(&cells, reach);
        let pair = |k: usize| only[k].filter(|&other| k < other && only[other] == Some(k)).map(|other| [k, other]);
        (0..cells.len()).filter_map(pair).map(|pair| pair.map(|k| cells[k].1)).collect()
    }

    /// Index of the only other end within reach of each end; `None` if there are more. The ends are sorted by their cells; the
    /// other end of the same stroke does not count.
    fn only_near(&self, cells: &[(Cell, End)], reach: f64) -> Vec<Option<usize>> {
        let cell = |k: usize| cells.get(k).map(|(cell, _)| *cell);
        // First ends in the three columns of cells around an end, from the row below it; they advance with the ends.
        let mut starts = [0; 3];
        let mut only = Vec::with_capacity(cells.len());
        for (k, &((pen, [x, y]), end)) in cells.iter().enumerate() {
            for (start, column) in starts.iter_mut().zip(x - 1..) {
                while cell(*start).is_some_and(|cell| cell < (pen, [column, y - 1])) {
                    *start += 1;
                }
            }
            // A cell with many ends is not searched.
            if (k.saturating_sub(2)..=k + 2).filter(|&other| cell(other) == cell(k)).count() > 2 {
                only.push(None);
                continue;
            }
            let at = place(self.drawing, end);
            let columns = starts.iter().zip(x - 1..).flat_map(|(&start, column)| {
                (start..).take_while(move |&k| cell(k).is_some_and(|cell| cell <= (pen, [column, y + 1])))
            });
            let is_near = |&there: &usize| {
                let beside = cells[there].1;
                beside != end && beside != other(end) && (place(self.drawing, beside) - at).amax() <= reach
            };
            let mut near = columns.filter(is_near);
            only.push(near.next().filter(|_| near.next().is_none()));
        }
        only
    }

    /// Combines the strokes of a chain into one, starting from an end.
    fn chain(&mut self, strokes: &[PenStroke], chains: &Chains, start: End, taken: &mut [bool]) -> PenStroke {
        let first = self.drawing.vertices.len();
        for at in chains.from(start) {
            taken[at / 2] = true;
            if at / 2 < self.strokes {
                self.append(&strokes[at / 2], at.is_multiple_of(2), first);
            } else {
                let stroke = strokes[at / 2];
                let [from, to] = [stroke.first, stroke.first + 1].map(|k| self.drawing.vertices[k as usize].at);
                // No instruction draws a bridge: it gets the span of the previous one.
                let span = self.drawing.vertices[self.drawing.vertices.len() - 1].span;
                let at = if at.is_multiple_of(2) { to } else { from };
                self.drawing.vertices.push(Vertex { at, span });
            }
        }
        if chains.links[start].is_some() {
            self.close(first);
        }
        let end = self.drawing.vertices.len() as u32;
        PenStroke { first: first as u32, end, pen: strokes[start / 2].pen }
    }

    /// Appends the places of a stroke in either direction; each line keeps its span.
    fn append(&mut self, stroke: &PenStroke, is_forward: bool, first: usize) {
        let range = stroke.range();
        let last = range.end - 1;
        let mut before = self.drawing.vertices.last().copied().filter(|_| self.drawing.vertices.len() > first);
        for step in 0..range.len() {
            let k = if is_forward { range.start + step } else { last - step };
            let lead = if is_forward { k } else { (k + 1).min(last) };
            let vertex = Vertex { at: self.drawing.vertices[k].at, span: self.drawing.vertices[lead].span };
            let Some(end) = before.filter(|_| step < 2) else {
                self.drawing.vertices.push(vertex);
                continue;
            };
            if step == 0 {
                continue; // it starts where the previous stroke ends, within rounding
            }
            let from = self.drawing.vertices[if is_forward { range.start } else { last }].at;
            if from != end.at {
                self.moved.redrawn.push(Redrawn { drawn: vec![from, vertex.at], now: [end.at, vertex.at] });
            }
            self.moved.points += usize::from(end.span == vertex.span || end.at == vertex.at);
            if end.at != vertex.at {
                self.drawing.vertices.push(vertex);
            }
            before = None;
        }
    }

    /// Ends a chain at its start.
    fn close(&mut self, first: usize) {
        let at = self.drawing.vertices[first].at;
        let [.., before, last] = &mut self.drawing.vertices[first..] else { return };
        let from = std::mem::replace(&mut last.at, at);
        if from != at {
            self.moved.redrawn.push(Redrawn { drawn: vec![before.at, from], now: [before.at, at] });
        }
    }

    /// Vector from an end into its stroke.
    fn way(&self, end: End) -> Vector {
        let stroke = &self.drawing.strokes[end / 2];
        let vertices = &self.drawing.vertices[stroke.range()];
        let at = |i: usize| vertices[if end.is_multiple_of(2) { i } else { vertices.len() - 1 - i }].at;
        let ways = (1..vertices.len().min(MOST_STEPS)).map(|i| at(i) - at(0));
        let mut last = Vector::zeros();
        for way in ways {
            last = way;
            if way.norm() >= STRETCH {
                break;
            }
        }
        last
    }
}

/// Strokes and the places where their ends meet, during the choice of continuations.
struct Graph<'a, 'b> {
    joining: &'a Joining<'b>,
    nodes: Vec<Vec<End>>,
    /// Place of each end where it meets others.
    node: Vec<Option<u32>>,
    chains: Chains,
    /// Dead ends.
    is_dead: Vec<bool>,
    /// Ends of notches on an edge of another line, where they meet other strokes.
    on_edge: BTreeSet<End>,
}

impl<'a, 'b> Graph<'a, 'b> {
    fn new(joining: &'a Joining<'b>, nodes: Vec<Vec<End>>) -> Self {
        let ends = 2 * joining.drawing.strokes.len();
        let mut node = vec![None; ends];
        for (k, end) in nodes.iter().enumerate().flat_map(|(k, node)| node.iter().map(move |end| (k, *end))) {
            node[end] = Some(k as u32);
        }
        let strokes = joining.drawing.strokes.len();
        let (chains, is_dead) = (Chains::alone(strokes), vec![false; strokes]);
        Self { joining, nodes, node, chains, is_dead, on_edge: BTreeSet::new() }
    }

    /// Marks dead ends: strokes with an end that meets no other, then those that end only at such strokes.
    fn put_dead_ends_aside(&mut self) {
        let mut degree: Vec<usize> = self.nodes.iter().map(Vec::len).collect();
        let mut queue: Vec<usize> = (0..self.is_dead.len()).filter(|k| self.is_free(*k, &degree)).collect();
        while let Some(stroke) = queue.pop() {
            if std::mem::replace(&mut self.is_dead[stroke], true) {
                continue;
            }
            for node in [2 * stroke, 2 * stroke + 1].into_iter().filter_map(|end| self.node[end]) {
                degree[node as usize] -= 1;
                if degree[node as usize] == 1 {
                    queue.extend(self.nodes[node as usize].iter().map(|end| end / 2).filter(|k| !self.is_dead[*k]));
                }
            }
        }
    }

    fn is_free(&self, stroke: usize, degree: &[usize]) -> bool {
        [2 * stroke, 2 * stroke + 1].iter().any(|&end| self.node[end].is_none_or(|node| degree[node as usize] < 2))
    }

    /// Separates dead-end slits that stand on an edge: other lines begin at their foot or at their tip.
    fn set_slits_apart(&mut self, work: &mut Budget) {
        let joining = self.joining;
        let all = 0..joining.drawing.strokes.len();
        let meets = |k: &usize| [2 * k, 2 * k + 1].iter().any(|&end| self.node[end].is_some());
        let candidates: Vec<usize> =
            all.clone().filter(|k| self.is_dead[*k] && meets(k) && joining.is_slit(*k)).collect();
        if candidates.is_empty() {
            return; // the usual case
        }
        let is_ring = |k: &usize| {
            let ends = [2 * k, 2 * k + 1].map(|end| place(joining.drawing, end));
            ends[0] == ends[1] || joining.nearly_closes(*k) || joining.retraces(*k)
        };
        let touch = joining.reach;
        let slits = Slits { drawing: joining.drawing, rings: all.filter(is_ring).collect(), candidates, touch };
        let feet = slits.feet(work);
        let others = |end: End| {
            let node = self.node[end].map_or(&[][..], |node| &self.nodes[node as usize]);
            node.iter().copied().filter(|&other| other != end).collect::<Vec<End>>()
        };
        let mut apart: Vec<End> = Vec::new();
        for &foot in &feet {
            if !others(foot).iter().any(|end| joining.is_notch(end / 2)) {
                apart.push(foot);
            }
            let tip = other(foot);
            if slits.ends_at_tip(foot, &others(tip), &feet) {
                apart.push(tip);
            }
        }
        for end in apart {
            if let Some(node) = self.node[end].take() {
                self.nodes[node as usize].retain(|&other| other != end);
            }
        }
    }

    /// Closes the rings that strokes draw in succession.
    fn close_rings(&mut self) {
        for ring in (Ends { nodes: &self.nodes, node: &self.node, is_dead: &self.is_dead }).rings() {
            let [first, last] = [*ring.start(), *ring.end()];
            let closing = [2 * last + 1, 2 * first];
            if !self.are_one_notch(closing) && !self.are_facing(closing) {
                (first..last).for_each(|stroke| self.chains.join([2 * stroke + 1, 2 * stroke + 2]));
                self.chains.join(closing);
            }
        }
    }

    /// Chooses continuations at all places: first for rings, then where two lines meet, then where more do, then among dead
    /// ends.
    fn link(&mut self, work: &mut Budget) {
        self.find_edges(work);
        self.close_rings();
        for k in 0..self.nodes.len() {
            if let [a, b] = self.open(k, false)[..]
                && !self.are_one_notch([a, b])
                && !self.are_facing([a, b])
            {
                self.chains.join([a, b]);
            }
        }
        for k in 0..self.nodes.len() {
            while let Some(pair) = self.continuation(k) {
                self.chains.join(pair);
            }
        }
        for k in 0..self.nodes.len() {
            if let [a, b] = self.open_but_slits(k)[..]
                && !self.are_notches([a, b])
            {
                self.chains.join([a, b]);
            }
        }
    }

    /// True if two strokes are one notch that is drawn twice: they meet at both ends and have the same tip.
    fn are_one_notch(&self, [a, b]: [End; 2]) -> bool {
        let far = [a, b].map(|end| self.node[other(end)]);
        let is_pair = a / 2 != b / 2 && far[0].is_some() && far[0] == far[1];
        let tips = [a, b].map(|end| self.joining.tip(end / 2));
        let is_one = |[a, b]: [Option<Point>; 2]| a.zip(b).is_some_and(|(a, b)| (a - b).amax() <= self.joining.reach);
        is_pair && is_one(tips) && [a, b].iter().all(|end| self.joining.is_notch(end / 2))
    }

    /// True if two strokes are notches of two parts at one place of their common edge: they meet at both ends, on an edge, and
    /// lead to opposite sides.
    fn are_facing(&self, [a, b]: [End; 2]) -> bool {
        let far = [a, b].map(|end| self.node[other(end)]);
        let is_pair = a / 2 != b / 2 && far[0].is_some() && far[0] == far[1];
        let is_notch_on_edge = |end: End| {
            self.joining.is_notch(end / 2) && self.on_edge.contains(&end) && self.on_edge.contains(&other(end))
        };
        is_pair && [a, b].into_iter().all(is_notch_on_edge) && self.lead_apart([a, b])
    }

    /// True if the tips of two strokes lie on opposite sides of the line between the ends of the first.
    fn lead_apart(&self, [a, b]: [End; 2]) -> bool {
        let [from, to] = [a, other(a)].map(|end| place(self.joining.drawing, end));
        let side = |end: End| self.joining.tip(end / 2).map_or(0.0, |tip| cross(to - from, tip - from));
        side(a) * side(b) < 0.0
    }

    /// True if one of two strokes is a notch of which the other is not a part: the other is a notch too, or begins at its mouth
    /// on the edge of a part. A slit may also begin at the mouth of a notch whose other end misses the edge.
    fn are_notches(&self, ends: [End; 2]) -> bool {
        let is_apart = |[notch, beside]: [End; 2]| {
            let is_slit = self.joining.is_slit(beside / 2);
            self.on_edge.contains(&notch) && (is_slit || self.on_edge.contains(&other(notch)))
        };
        match ends.map(|end| self.joining.is_notch(end / 2)) {
            [true, true] => true,
            [false, false] => false,
            [true, false] => is_apart(ends),
            [false, true] => is_apart([ends[1], ends[0]]),
        }
    }

    /// Finds the ends of notches on an edge of another line, for notches that meet other strokes.
    fn find_edges(&mut self, work: &mut Budget) {
        let joining = self.joining;
        let notches = self.nodes.iter().flatten().filter(|&&end| joining.is_notch(end / 2));
        let found: BTreeSet<End> = notches.flat_map(|&end| [end, other(end)]).collect();
        let found: Vec<End> = found.into_iter().collect();
        if found.is_empty() {
            return;
        }
        let at = |end: End| place(joining.drawing, end);
        let boxes = Boxes::new(found.iter().map(|&end| Extent::between(at(end), at(end)).grown(Notch::MISS)).collect());
        let meets = |end: End, stroke: usize| {
            let node = self.node[end];
            node.is_some() && [2 * stroke, 2 * stroke + 1].iter().any(|&end| self.node[end] == node)
        };
        let strokes = (0..joining.drawing.strokes.len()).filter(|&k| !joining.is_notch(k) && !joining.is_slit(k));
        for stroke in strokes {
            for ends in joining.drawing.vertices[joining.drawing.strokes[stroke].range()].windows(2) {
                let [a, b] = [ends[0].at, ends[1].at];
                let beside = Extent::between(a, b);
                if !work.spend(boxes.cost_near(&beside)) {
                    return;
                }
                for end in boxes.near(beside).map(|k| found[k]) {
                    let is_on = polyline::distance_to_segment(at(end), a, b) <= Notch::MISS && !meets(end, stroke);
                    if work.spend(1) && is_on {
                        self.on_edge.insert(end);
                    }
                }
            }
        }
    }

    /// True for each end whose stroke is not a dead end and at whose place others continue without it.
    fn left(&self) -> Vec<bool> {
        let mut is_left = vec![false; self.node.len()];
        for node in &self.nodes {
            let goes_on = |&&end: &&End| self.chains.links[end].is_some();
            if node.iter().filter(goes_on).count() > 1 {
                for &end in node {
                    is_left[end] = self.chains.links[end].is_none() && !self.is_dead[end / 2];
                }
            }
        }
        is_left
    }

    /// Free ends at a place.
    fn open(&self, node: usize, with_dead: bool) -> Vec<End> {
        let may_go_on = |stroke: usize| !self.is_dead[stroke] || with_dead && !self.joining.nearly_closes(stroke);
        let is_open = |end: &End| self.chains.links[*end].is_none() && may_go_on(end / 2);
        self.nodes[node].iter().copied().filter(is_open).collect()
    }

    /// Free ends at a place. Slits that begin there and end free are omitted if exactly two other ends remain.
    fn open_but_slits(&self, node: usize) -> Vec<End> {
        let open = self.open(node, true);
        let is_slit = |end: End| self.joining.is_slit(end / 2) && self.node[other(end)].is_none();
        let others: Vec<End> = open.iter().copied().filter(|&end| !is_slit(end)).collect();
        if open.len() > 2 && others.len() == 2 { others } else { open }
    }

    fn continuation(&self, node: usize) -> Option<[End; 2]> {
        let open = self.open(node, false);
        if open.len() > MOST_ENDS {
            return None;
        }
        let pairs = || open.iter().enumerate().flat_map(|(i, &a)| open[i + 1..].iter().map(move |&b| [a, b]));
        let pairs = || pairs().filter(|&pair| !self.are_facing(pair));
        let ring = pairs().find(|&[a, b]| self.chains.far(a) == b && self.joining.drawing.strokes.len() > 1);
        let turn = |[a, b]: [End; 2]| angle::turn(-self.joining.way(a), self.joining.way(b)).abs();
        ring.or_else(|| pairs().filter(|&pair| turn(pair) <= SHARPEST).min_by(|&a, &b| turn(a).total_cmp(&turn(b))))
    }
}
