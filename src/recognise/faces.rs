//! Faces of the graph that loose lines of a drawing with layers make: parts whose common edges are drawn twice, once for each.
//!
//! In the order of the file such lines tell the parts apart ([`succession`](super::succession)). In any other order their strokes
//! are put in the order of the faces that they bound, so that the rings are found. A graph that is not plane, has an edge of two
//! faces that is drawn once, or a face below the size of a part, stays as it is drawn.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

use super::chains::{End, other, place};
use super::line::SMALL_OUTLINE;
use super::meeting;
use super::pens::Use;
use crate::geom::{Extent, Point, polyline, ring};
use crate::ir::drawing::{Drawing, PenStroke, Redrawn, Vertex};

/// Ends at one place that are looked at: more are the middle of a star.
const MOST_ENDS: usize = 64;
/// Distance of two strokes that are drawn along each other, in those of ends that meet: stations differ as lengths do.
const REACH_OF_TWINS: f64 = 2.0;
/// Stretch of a stroke that its direction at an end is taken from, mm.
const STRETCH: f64 = 1.0;
/// Places of a stroke that are looked at for its direction at an end.
const MOST_STEPS: usize = 64;
/// Least angle between two strokes that leave a place, rad: nearer ones are in no order.
const LEAST_ANGLE: f64 = 1e-3;

/// Puts strokes in the order of the faces that they bound; the lines that were moved so that their ends meet.
pub(super) fn put_in_order(drawing: &mut Drawing, uses: &[Use], reach: f64) -> Vec<Redrawn> {
    let is_asked = |k: &usize| {
        let pen = usize::from(drawing.strokes[*k].pen);
        drawing.pens.get(pen).is_some_and(|pen| pen.is_layer)
            && !matches!(uses.get(pen), None | Some(Use::Ignore | Use::Drawn))
    };
    let is_open = |k: &usize| (place(drawing, 2 * k) - place(drawing, 2 * k + 1)).amax() > reach;
    let strokes: Vec<usize> = (0..drawing.strokes.len()).filter(is_asked).filter(is_open).collect();
    let graph = Graph::new(drawing, &strokes, reach);
    if graph.twins.is_empty() {
        return Vec::new(); // as in nearly all
    }
    let mut redrawn = Vec::new();
    let mut in_order: BTreeMap<usize, Vec<PenStroke>> = BTreeMap::new();
    let mut taken: BTreeSet<usize> = BTreeSet::new();
    let mut places: Vec<Vertex> = Vec::new();
    for component in graph.components() {
        if !component.iter().any(|stroke| graph.twins.contains_key(stroke)) {
            continue;
        }
        let Some(faces) = graph.faces(&component) else { continue };
        let mut sides: BTreeMap<usize, usize> = BTreeMap::new();
        faces.iter().flatten().for_each(|end| *sides.entry(end / 2).or_default() += 1);
        if sides.iter().any(|(stroke, count)| (*count > 1) != graph.twins.contains_key(stroke)) {
            continue;
        }
        for &end in faces.iter().flatten() {
            let twin = graph.twins.get(&(end / 2)).filter(|_| taken.contains(&(end / 2)));
            let stroke = twin.copied().unwrap_or(end / 2);
            taken.insert(stroke);
            let from = if graph.node[&(2 * stroke)] == graph.node[&end] { 2 * stroke } else { 2 * stroke + 1 };
            let first = (drawing.vertices.len() + places.len()) as u32;
            let mut along = directed(graph.vertices(stroke), from);
            redrawn.extend(graph.meet(&mut along, [end, other(end)]));
            places.append(&mut along);
            let end = (drawing.vertices.len() + places.len()) as u32;
            let laid = PenStroke { first, end, pen: drawing.strokes[stroke].pen };
            in_order.entry(component[0]).or_default().push(laid);
        }
    }
    let strokes = drawing.strokes.iter().enumerate().flat_map(|(k, &stroke)| {
        in_order.remove(&k).unwrap_or_default().into_iter().chain((!taken.contains(&k)).then_some(stroke))
    });
    drawing.strokes = strokes.collect();
    drawing.vertices.append(&mut places);
    redrawn
}

/// The places of a stroke from one of its ends on; each line keeps what drew it.
fn directed(vertices: &[Vertex], from: End) -> Vec<Vertex> {
    if from.is_multiple_of(2) {
        return vertices.to_vec();
    }
    let last = vertices.len() - 1;
    (0..=last).rev().map(|k| Vertex { at: vertices[k].at, span: vertices[(k + 1).min(last)].span }).collect()
}

/// Strokes between the places where their ends meet, those that lead nowhere left out.
struct Graph<'a> {
    drawing: &'a Drawing,
    /// The place of each end.
    node: BTreeMap<End, usize>,
    /// The ends at each place, those of twins left out.
    nodes: BTreeMap<usize, Vec<End>>,
    /// Strokes that lie on others, by these.
    twins: BTreeMap<usize, usize>,
}

impl<'a> Graph<'a> {
    fn new(drawing: &'a Drawing, strokes: &[usize], reach: f64) -> Self {
        let node = ends_at_places(drawing, strokes, reach);
        let mut graph = Self { drawing, node, nodes: BTreeMap::new(), twins: BTreeMap::new() };
        let mut between: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
        for &stroke in strokes {
            let mut places = graph.places(stroke);
            places.sort_unstable();
            let known = between.entry(places).or_default();
            // A place where more strokes end has no order anyway.
            let twin = known.iter().take(MOST_ENDS).position(|&other| graph.are_twins([other, stroke], reach));
            if let Some(k) = twin {
                graph.twins.insert(known.swap_remove(k), stroke);
                continue;
            }
            known.push(stroke);
            for (end, place) in [2 * stroke, 2 * stroke + 1].into_iter().zip(graph.places(stroke)) {
                graph.nodes.entry(place).or_default().push(end);
            }
        }
        graph.leave_out_dead_ends();
        graph
    }

    /// Leaves out strokes that lead nowhere, and those that do then.
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

    /// The places of both ends of a stroke.
    fn places(&self, stroke: usize) -> [usize; 2] {
        [2 * stroke, 2 * stroke + 1].map(|end| self.node[&end])
    }

    fn vertices(&self, stroke: usize) -> &'a [Vertex] {
        &self.drawing.vertices[self.drawing.strokes[stroke].range()]
    }

    /// Whether two strokes between two places are drawn along each other.
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

    /// Moves the first and the last place of a stroke to where others meet it; the lines that were moved.
    fn meet(&self, along: &mut [Vertex], ends: [End; 2]) -> Vec<Redrawn> {
        let last = along.len() - 1;
        let before: Vec<Point> = along.iter().map(|vertex| vertex.at).collect();
        let [first, end] = ends.map(|end| place(self.drawing, self.node[&end]));
        (along[0].at, along[last].at) = (first, end);
        let moved = |&k: &usize| along[k].at != before[k] || along[k + 1].at != before[k + 1];
        let redrawn = |k: usize| Redrawn { drawn: before[k..k + 2].to_vec(), now: [along[k].at, along[k + 1].at] };
        let mut lines = vec![0, last - 1];
        lines.dedup();
        lines.into_iter().filter(moved).map(redrawn).collect()
    }

    /// Strokes that hang together, in their order.
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

    /// The faces of a plane graph but the one around it: each as the ends at which its strokes begin, counter-clockwise, in the
    /// order of their first strokes; `None` for one that is not plane, has strokes with one face on both sides, or small faces.
    fn faces(&self, component: &[usize]) -> Option<Vec<Vec<End>>> {
        let places: BTreeSet<usize> = component.iter().flat_map(|&stroke| self.places(stroke)).collect();
        if places.iter().all(|place| self.nodes[place].len() < 3) {
            return None; // a ring
        }
        // Of each end the one that is next to it clockwise.
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
        // Euler's formula for a graph that hangs together.
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

    /// The ends at a place, counter-clockwise by the directions in which their strokes leave it.
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

    /// The direction in which a stroke leaves the place of an end, rad; `None` of one without length there.
    fn heading(&self, end: End) -> Option<f64> {
        let vertices = self.vertices(end / 2);
        let from = place(self.drawing, self.node[&end]);
        let at = |k: usize| vertices[if end.is_multiple_of(2) { k } else { vertices.len() - 1 - k }].at;
        let ways = (1..vertices.len()).map(|k| at(k) - from);
        let way = ways.take(MOST_STEPS).find(|way| way.norm() >= STRETCH).unwrap_or(at(vertices.len() - 1) - from);
        (way.norm() >= STRETCH).then(|| way.y.atan2(way.x))
    }

    /// Places of some strokes behind each other.
    fn points(&self, ends: &[End]) -> Vec<Point> {
        let vertices = |&end: &End| directed(self.vertices(end / 2), end);
        ends.iter().flat_map(vertices).map(|vertex| vertex.at).collect()
    }
}

/// The place of each end of the strokes, named by the first end there.
fn ends_at_places(drawing: &Drawing, strokes: &[usize], reach: f64) -> BTreeMap<End, End> {
    let ends: Vec<End> = strokes.iter().flat_map(|stroke| [2 * stroke, 2 * stroke + 1]).collect();
    let drawn: Vec<(u16, Point)> =
        ends.iter().map(|&end| (drawing.strokes[end / 2].pen, place(drawing, end))).collect();
    let places = meeting::places(&drawn, reach).into_iter().map(|first| ends[first]);
    ends.iter().copied().zip(places).collect()
}
