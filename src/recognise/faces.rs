//! Faces of the graph of loose lines in a drawing with layers: parts with common edges, drawn for each of them or once.
//!
//! In the order of the file such lines distinguish the parts ([`succession`](super::succession)). In any other order their
//! stretches between the places where they meet ([`nodes`]) are sorted by the faces that they bound, so that the rings are
//! found. A graph that is not plane, or that has a face smaller than a part, stays as drawn.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

use super::chains::{End, other};
use super::line::SMALL_OUTLINE;
use super::meeting;
use super::nodes::{self, Stretch};
use super::pens::Use;
use crate::geom::{Extent, Point, polyline, ring};
use crate::ir::drawing::{Drawing, Moved, PenStroke, Redrawn, Vertex};
use crate::source::Span;

/// Greatest number of ends at one place that are processed: more are the centre of a star.
const MOST_ENDS: usize = 64;
/// Distance of two strokes drawn along each other, relative to that of ends that meet: stations differ as lengths do.
const REACH_OF_TWINS: f64 = 2.0;
/// Length of a stroke from which its direction at an end is taken, mm.
const STRETCH: f64 = 1.0;
/// Greatest number of places of a stroke for its direction at an end.
const MOST_STEPS: usize = 64;
/// Least angle between two strokes at a place, rad: at a smaller one they have no order.
const LEAST_ANGLE: f64 = 1e-3;
/// Least number of open lines of a part and another one.
const LEAST_STROKES: usize = 2;

/// Sorts lines by the faces that they bound. Returns the displacements that made their ends meet and the edges drawn once but
/// used twice, and the repeated lines on the edge of one face. Unless `divides`, an edge drawn once bounds only one part.
pub(super) fn put_in_order(drawing: &mut Drawing, uses: &[Use], reach: f64, divides: bool) -> (Moved, Vec<PenStroke>) {
    let is_asked = |k: &usize| {
        let pen = usize::from(drawing.strokes[*k].pen);
        drawing.pens.get(pen).is_some_and(|pen| pen.is_layer)
            && !matches!(uses.get(pen), None | Some(Use::Ignore | Use::Drawn | Use::Marks))
    };
    let place = |vertex: u32| drawing.vertices[vertex as usize].at;
    let is_open = |k: &usize| {
        let stroke = drawing.strokes[*k];
        (place(stroke.first) - place(stroke.end - 1)).amax() > reach
    };
    let mut strokes: Vec<usize> = (0..drawing.strokes.len()).filter(is_asked).filter(is_open).collect();
    let mut moved = Moved::default();
    if strokes.len() < LEAST_STROKES {
        return (moved, Vec::new()); // the usual case
    }
    // Dead ends, such as notches, do not split others.
    let leading: BTreeSet<usize> = {
        let stretches = nodes::parted(drawing, &strokes, reach);
        Graph::new(&stretches, reach).strokes()
    };
    strokes.retain(|stroke| leading.contains(stroke));
    let stretches = nodes::parted(drawing, &strokes, reach);
    let graph = Graph::new(&stretches, reach);
    let mut laid = Laid::default();
    for component in graph.components() {
        let Some(faces) = graph.faces(&component) else { continue };
        let mut sides: BTreeMap<usize, usize> = BTreeMap::new();
        faces.iter().flatten().for_each(|end| *sides.entry(end / 2).or_default() += 1);
        let is_twice = |stretch: &usize| graph.twins.contains_key(stretch);
        let is_divided = sides.iter().any(|(stretch, count)| *count > 1 && !is_twice(stretch));
        if is_divided && !divides || !is_divided && !component.iter().any(is_twice) {
            continue;
        }
        laid.add(stretches[component[0]].stroke, &graph, faces, &mut moved);
    }
    let again = laid.put_into(drawing, &graph, &mut moved);
    (moved, again)
}

/// Lines in the order of faces.
#[derive(Default)]
struct Laid {
    /// Places and pens of the lines that replace each stroke.
    lines: BTreeMap<usize, Vec<(Vec<Vertex>, u16)>>,
    /// Stretches that were placed.
    taken: BTreeSet<usize>,
    /// Number of places to which the lines lead.
    places: usize,
}

impl Laid {
    /// Places the stretches of faces in the position of a stroke.
    fn add(&mut self, stroke: usize, graph: &Graph, faces: Vec<Vec<End>>, moved: &mut Moved) {
        for face in faces {
            for end in face {
                let is_laid = self.taken.contains(&(end / 2));
                let twin = graph.twins.get(&(end / 2)).filter(|_| is_laid);
                let stretch = twin.copied().unwrap_or(end / 2);
                self.taken.insert(stretch);
                let from = if graph.node[&(2 * stretch)] == graph.node[&end] { 2 * stretch } else { 2 * stretch + 1 };
                let mut along = graph.directed(from);
                let redrawn = graph.meet(&mut along, [end, other(end)]);
                if is_laid && twin.is_none() {
                    moved.doubled.push(along.clone());
                } else {
                    moved.redrawn.extend(redrawn);
                }
                self.places += places(&along);
                self.lines.entry(stroke).or_default().push((along, graph.stretches[stretch].pen));
            }
        }
    }

    /// Inserts the lines into a drawing in place of the strokes from which they were made; returns the repeated ones.
    fn put_into(mut self, drawing: &mut Drawing, graph: &Graph, moved: &mut Moved) -> Vec<PenStroke> {
        let is_twin = |(stretch, twin): (&usize, &usize)| {
            (self.taken.contains(stretch) && !self.taken.contains(twin)).then_some(*twin)
        };
        let again: BTreeSet<usize> = graph.twins.iter().filter_map(is_twin).collect();
        let laid = self.taken.iter().chain(&again);
        let strokes: BTreeSet<usize> = laid.map(|&stretch| graph.stretches[stretch].stroke).collect();
        let add = |vertices: &[Vertex], pen: u16, drawing: &mut Drawing| {
            let first = drawing.vertices.len() as u32;
            drawing.vertices.extend(vertices);
            PenStroke { first, end: drawing.vertices.len() as u32, pen }
        };
        for (k, stretch) in graph.stretches.iter().enumerate() {
            if strokes.contains(&stretch.stroke) && !self.taken.contains(&k) {
                self.places += places(&stretch.vertices);
            }
            if strokes.contains(&stretch.stroke) && !self.taken.contains(&k) && !again.contains(&k) {
                let lines = self.lines.entry(stretch.stroke).or_default();
                lines.push((stretch.vertices.clone(), stretch.pen));
            }
        }
        let drawn = strokes.iter().map(|&stroke| places(&drawing.vertices[drawing.strokes[stroke].range()]));
        moved.repeated = self.places.saturating_sub(drawn.sum());
        for (k, stroke) in std::mem::take(&mut drawing.strokes).into_iter().enumerate() {
            for (vertices, pen) in self.lines.remove(&k).unwrap_or_default() {
                let stroke = add(&vertices, pen, drawing);
                drawing.strokes.push(stroke);
            }
            if !strokes.contains(&k) {
                drawing.strokes.push(stroke);
            }
        }
        let again = again.into_iter().map(|k| &graph.stretches[k]);
        again.map(|stretch| add(&stretch.vertices, stretch.pen, drawing)).collect()
    }
}

/// Number of places to which a line leads: all chords of an arc lead to one.
fn places(vertices: &[Vertex]) -> usize {
    let mut before: Option<Span> = None;
    let is_new = |pair: &&[Vertex]| pair[0].at != pair[1].at && before.replace(pair[1].span) != Some(pair[1].span);
    vertices.windows(2).filter(is_new).count()
}

/// Places of a stroke from one of its ends; each line keeps its span.
fn directed(vertices: &[Vertex], from: End) -> Vec<Vertex> {
    if from.is_multiple_of(2) {
        return vertices.to_vec();
    }
    let last = vertices.len() - 1;
    (0..=last).rev().map(|k| Vertex { at: vertices[k].at, span: vertices[(k + 1).min(last)].span }).collect()
}

/// Stretches between the places where their ends meet, without dead ends.
struct Graph<'a> {
    stretches: &'a [Stretch],
    /// Distance within which ends meet, mm.
    reach: f64,
    /// Place of each end.
    node: BTreeMap<End, usize>,
    /// Ends at each place, without those of twins.
    nodes: BTreeMap<usize, Vec<End>>,
    /// Stretches that lie on others, by these.
    twins: BTreeMap<usize, usize>,
}

impl<'a> Graph<'a> {
    fn new(stretches: &'a [Stretch], reach: f64) -> Self {
        let node = ends_at_places(stretches, reach);
        let mut graph = Self { stretches, reach, node, nodes: BTreeMap::new(), twins: BTreeMap::new() };
        let mut between: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
        for stretch in 0..stretches.len() {
            let mut places = graph.places(stretch);
            places.sort_unstable();
            let known = between.entry(places).or_default();
            // A place with more lines has no order anyway.
            let twin = known.iter().take(MOST_ENDS).position(|&other| graph.are_twins([other, stretch], reach));
            if let Some(k) = twin {
                graph.twins.insert(known.swap_remove(k), stretch);
                continue;
            }
            known.push(stretch);
            for (end, place) in [2 * stretch, 2 * stretch + 1].into_iter().zip(graph.places(stretch)) {
                graph.nodes.entry(place).or_default().push(end);
            }
        }
        graph.leave_out_dead_ends();
        graph
    }

    /// Strokes that are not dead ends.
    fn strokes(&self) -> BTreeSet<usize> {
        let alive: BTreeSet<usize> = self.nodes.values().flatten().map(|end| end / 2).collect();
        let twins = self.twins.iter().filter(|(stretch, _)| alive.contains(stretch)).map(|(_, twin)| twin);
        alive.iter().chain(twins).map(|&stretch| self.stretches[stretch].stroke).collect()
    }

    /// Place at which an end is drawn.
    fn place(&self, end: End) -> Point {
        place(self.stretches, end)
    }

    /// Places of a stretch, from one of its ends.
    fn directed(&self, from: End) -> Vec<Vertex> {
        directed(self.vertices(from / 2), from)
    }

    /// Removes dead ends repeatedly.
    fn leave_out_dead_ends(&mut self) {
        let mut degree: BTreeMap<usize, usize> = self.nodes.iter().map(|(place, ends)| (*place, ends.len())).collect();
        let mut is_dead: BTreeSet<usize> = BTreeSet::new();
        let mut queue: Vec<usize> = degree.iter().filter(|(_, count)| **count == 1).map(|(place, _)| *place).collect();
        while let Some(place) = queue.pop() {
            let ends = &self.nodes[&place];
            let Some(stroke) = ends.iter().map(|end| end / 2).find(|stroke| !is_dead.contains(stroke)) else {
                continue;
            };
            is_dead.insert(stroke);
            for place in self.places(stroke) {
                let left = degree.entry(place).or_default();
                *left = left.saturating_sub(1);
                queue.extend((*left == 1).then_some(place));
            }
        }
        for ends in self.nodes.values_mut() {
            ends.retain(|end| !is_dead.contains(&(end / 2)));
        }
        self.nodes.retain(|_, ends| !ends.is_empty());
    }

    /// Places of both ends of a stroke.
    fn places(&self, stroke: usize) -> [usize; 2] {
        [2 * stroke, 2 * stroke + 1].map(|end| self.node[&end])
    }

    fn vertices(&self, stretch: usize) -> &'a [Vertex] {
        &self.stretches[stretch].vertices
    }

    /// True if two strokes between two places are drawn along each other.
    fn are_twins(&self, [one, other]: [usize; 2], reach: f64) -> bool {
        let end = if self.places(one)[0] == self.places(other)[0] { 2 * other } else { 2 * other + 1 };
        let [one, other] = [2 * one, end].map(|end| self.points(&[end]));
        let [of_one, of_other] = [&one, &other].map(|points| polyline::stations(points));
        let is_along = |(at, &station): (&Point, &f64)| {
            (polyline::place(&other, &of_other, station) - at).norm() <= REACH_OF_TWINS * reach
        };
        let length = |stations: &[f64]| stations[stations.len() - 1];
        (length(&of_one) - length(&of_other)).abs() <= reach && one.iter().zip(&of_one).all(is_along)
    }

    /// Moves the first and the last place of a stroke to those where others meet it; returns the lines that were moved.
    fn meet(&self, along: &mut [Vertex], ends: [End; 2]) -> Vec<Redrawn> {
        let last = along.len() - 1;
        let before: Vec<Point> = along.iter().map(|vertex| vertex.at).collect();
        let [first, end] = ends.map(|end| self.place(self.node[&end]));
        (along[0].at, along[last].at) = (first, end);
        let moved = |&k: &usize| along[k].at != before[k] || along[k + 1].at != before[k + 1];
        let redrawn = |k: usize| Redrawn { drawn: before[k..k + 2].to_vec(), now: [along[k].at, along[k + 1].at] };
        let mut lines = vec![0, last - 1];
        lines.dedup();
        lines.into_iter().filter(moved).map(redrawn).collect()
    }

    /// Connected components of strokes, in their order.
    fn components(&self) -> Vec<Vec<usize>> {
        let mut components = Vec::new();
        let (mut seen, mut passed): (BTreeSet<usize>, BTreeSet<usize>) = Default::default();
        for first in self.nodes.values().flatten().map(|end| end / 2) {
            let (mut component, mut queue) = (Vec::new(), vec![first]);
            while let Some(stroke) = queue.pop() {
                if seen.insert(stroke) {
                    component.push(stroke);
                    let new = self.places(stroke).into_iter().filter(|place| passed.insert(*place));
                    queue.extend(new.flat_map(|place| &self.nodes[&place]).map(|end| end / 2));
                }
            }
            component.sort_unstable();
            components.extend((!component.is_empty()).then_some(component));
        }
        components
    }

    /// Faces of a plane graph except the outer one, each as the starting ends of its strokes, counter-clockwise, in the order
    /// of their first strokes. `None` for a graph that is not plane, has strokes with one face on both sides, or small faces.
    fn faces(&self, component: &[usize]) -> Option<Vec<Vec<End>>> {
        let places: BTreeSet<usize> = component.iter().flat_map(|&stroke| self.places(stroke)).collect();
        let is_once = |stretch: &usize| !self.twins.contains_key(stretch);
        if places.iter().all(|place| self.nodes[place].len() < 3) && component.iter().all(is_once) {
            return None; // a ring
        }
        // Next end clockwise of each end.
        let mut next: BTreeMap<End, End> = BTreeMap::new();
        for &place in &places {
            let around = self.around(place)?;
            let clockwise = around.iter().cycle().skip(around.len() - 1);
            next.extend(around.iter().copied().zip(clockwise.copied()));
        }
        let mut faces: Vec<Vec<End>> = Vec::new();
        let mut face_of: BTreeMap<End, usize> = BTreeMap::new();
        for start in component.iter().flat_map(|stroke| [2 * stroke, 2 * stroke + 1]) {
            if face_of.contains_key(&start) {
                continue;
            }
            let on = |at: &End| Some(next[&other(*at)]).filter(|&at| at != start);
            let face: Vec<End> = std::iter::successors(Some(start), on).collect();
            face_of.extend(face.iter().map(|&end| (end, faces.len())));
            faces.push(face);
        }
        let has_two_sides = component.iter().all(|stroke| face_of[&(2 * stroke)] != face_of[&(2 * stroke + 1)]);
        // Euler's formula for a connected graph.
        let is_plane = places.len() + faces.len() == component.len() + 2;
        let (inner, around): (Vec<_>, Vec<_>) =
            faces.into_iter().partition(|face| ring::area(&self.points(face)) > 0.0);
        let is_part = |face: &Vec<End>| {
            let (width, height) = Extent::of(&self.points(face)).size();
            let places: BTreeSet<usize> = face.iter().map(|end| self.node[end]).collect();
            width.max(height) > SMALL_OUTLINE && places.len() == face.len()
        };
        (has_two_sides && is_plane && around.len() == 1 && inner.iter().all(is_part)).then_some(inner)
    }

    /// Ends at a place, counter-clockwise by the directions in which their strokes leave it.
    fn around(&self, place: usize) -> Option<Vec<End>> {
        let ends = &self.nodes[&place];
        if ends.len() > MOST_ENDS {
            return None;
        }
        let heading = |&end: &End| Some((self.heading(end)?, end));
        let mut around: Vec<(f64, End)> = ends.iter().map(heading).collect::<Option<_>>()?;
        around.sort_by(|a, b| a.0.total_cmp(&b.0));
        let is_apart = around.windows(2).all(|pair| pair[1].0 - pair[0].0 >= LEAST_ANGLE);
        let turn = TAU - (around[around.len() - 1].0 - around[0].0);
        (is_apart && turn >= LEAST_ANGLE).then(|| around.into_iter().map(|(_, end)| end).collect())
    }

    /// Direction in which a stretch leaves the place of an end, rad; `None` if the stretch is within the size of a place.
    fn heading(&self, end: End) -> Option<f64> {
        let vertices = self.vertices(end / 2);
        let from = self.place(self.node[&end]);
        let at = |k: usize| vertices[if end.is_multiple_of(2) { k } else { vertices.len() - 1 - k }].at;
        let ways = (1..vertices.len()).map(|k| at(k) - from);
        let way = ways.take(MOST_STEPS).find(|way| way.norm() >= STRETCH).unwrap_or(at(vertices.len() - 1) - from);
        (way.norm() > self.reach).then(|| way.y.atan2(way.x))
    }

    /// Places of consecutive strokes.
    fn points(&self, ends: &[End]) -> Vec<Point> {
        let vertices = |&end: &End| directed(self.vertices(end / 2), end);
        ends.iter().flat_map(vertices).map(|vertex| vertex.at).collect()
    }
}

/// Place of each end, identified by the first end there.
fn ends_at_places(stretches: &[Stretch], reach: f64) -> BTreeMap<End, End> {
    let drawn = (0..2 * stretches.len()).map(|end| (stretches[end / 2].pen, place(stretches, end)));
    let drawn: Vec<(u16, Point)> = drawn.collect();
    meeting::places(&drawn, reach).into_iter().enumerate().collect()
}

/// Place at which an end is drawn.
fn place(stretches: &[Stretch], end: End) -> Point {
    let vertices = &stretches[end / 2].vertices;
    vertices[if end.is_multiple_of(2) { 0 } else { vertices.len() - 1 }].at
}
