//! Faces of the graph that cutting lines make: parts with an edge in common that is drawn once for both of them.
//!
//! Every line of a knife is cut, so each face that such lines enclose comes free: it is a part. Of other lines that is said
//! where each edge of two faces is drawn twice. Strokes are put in the order of the faces that they bound, an edge of two faces
//! once for each, so that [`succession`](super::succession) finds the rings. A graph that is not plane, or has a face below the
//! size of a part, stays as it is drawn.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;
use std::ops::Range;

use super::chains::{End, other, place};
use super::line::SMALL_OUTLINE;
use super::noding::{Edge, edges};
use super::pens::Use;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, polyline, ring};
use crate::ir::drawing::{Drawing, PenStroke, Redrawn, Vertex};
use crate::units::number::{counted, fixed};

/// Ends at one place that are looked at: more are the middle of a star.
const MOST_ENDS: usize = 64;
/// Ends at one X that are compared with another: more are a hatching.
const MOST_BESIDE: usize = 4096;
/// Stretch of a stroke that its direction at an end is taken from, mm.
const STRETCH: f64 = 1.0;
/// Least angle between two strokes that leave a place, rad: nearer ones are in no order.
const LEAST_ANGLE: f64 = 1e-3;
/// Digits of the length that a message tells.
const DECIMALS: u32 = 1;

/// Edges that are drawn once and bound two faces.
#[derive(Debug, Default)]
pub(super) struct Faces {
    /// Each such edge, as it is drawn.
    pub(super) edges: Vec<Vec<Vertex>>,
    /// Lines that were moved to the places where they meet others.
    pub(super) redrawn: Vec<Redrawn>,
    /// Places where strokes were parted.
    pub(super) parted: usize,
    /// Faces that have such an edge.
    pub(super) count: usize,
    /// Faces among them without any edge of their own: waste between parts looks the same.
    pub(super) enclosed: usize,
}

impl Faces {
    /// Says how many edges are drawn once for two parts.
    pub(super) fn say(&self, out: &mut Diagnostics) {
        let length = |edge: &[Vertex]| edge.windows(2).map(|ends| (ends[1].at - ends[0].at).norm()).sum::<f64>();
        let lengths = self.edges.iter().map(|edge| (length(edge), edge[edge.len() - 1].span));
        let Some((longest, span)) = lengths.max_by(|a, b| a.0.total_cmp(&b.0)) else { return };
        let (edges, faces) = (counted(self.edges.len(), "edge"), counted(self.count, "part"));
        let message = format!("{edges} drawn once for two parts, up to {} mm: {faces}", fixed(longest, DECIMALS));
        let finding = Diagnostic::new(&code::DRAWING_FACES, message).at(span);
        out.push(match self.enclosed {
            0 => finding,
            enclosed => {
                let have = if enclosed == 1 { "has" } else { "have" };
                let hint =
                    format!("{enclosed} of these {have} no edge alone, as waste between parts: `--skip` leaves out");
                finding.hint(hint)
            }
        });
    }
}

/// Puts strokes in the order of the faces that they bound.
pub(super) fn split(drawing: &mut Drawing, uses: &[Use], reach: f64, work: &mut Budget) -> Faces {
    let used = |pen: u16| uses.get(usize::from(pen)).copied().unwrap_or(Use::Ignore);
    let is_layer = |pen: u16| drawing.pens.get(usize::from(pen)).is_some_and(|pen| pen.is_layer);
    let may_cut = |pen: u16| used(pen).is_knife() || used(pen) == Use::Unsaid && is_layer(pen);
    let is_open = |k: &usize| (place(drawing, 2 * k) - place(drawing, 2 * k + 1)).amax() > reach;
    let strokes = (0..drawing.strokes.len()).filter(|&k| may_cut(drawing.strokes[k].pen));
    let graph = Graph::new(edges(drawing, &strokes.filter(is_open).collect::<Vec<_>>(), reach, work), reach);
    let mut laying = Laying::default();
    for component in graph.components() {
        let Some(faces) = graph.faces(&component) else { continue };
        let mut sides = vec![0; component.len()];
        let of = |end: &End| component.binary_search(&(end / 2)).expect("faces are of edges of their graph");
        faces.iter().flatten().for_each(|end| sides[of(end)] += 1);
        let is_twice = |edge: &usize| graph.twins.contains_key(edge);
        let shared: Vec<usize> =
            component.iter().zip(&sides).filter(|(_, count)| **count > 1).map(|(&edge, _)| edge).collect();
        let once: Vec<usize> = shared.iter().copied().filter(|edge| !is_twice(edge)).collect();
        let is_sure = once.is_empty() || used(graph.edges[component[0]].pen).is_knife();
        // An edge of one part that is drawn twice is a copy.
        let is_again = component.iter().any(|edge| is_twice(edge) && !shared.contains(edge));
        if shared.is_empty() || !is_sure || is_again {
            continue;
        }
        let is_shared = |end: &End| shared.binary_search(&(end / 2)).is_ok();
        laying.found.edges.extend(once.iter().map(|&edge| graph.edges[edge].vertices.clone()));
        laying.found.count += faces.iter().filter(|face| face.iter().any(is_shared)).count();
        laying.found.enclosed += faces.iter().filter(|face| face.iter().all(is_shared)).count();
        faces.iter().flatten().for_each(|&end| laying.lay(&graph, end, graph.edges[component[0]].stroke));
    }
    laying.put_into(drawing, &graph.edges)
}

/// Strokes of faces as they are laid behind each other.
#[derive(Debug, Default)]
struct Laying {
    found: Faces,
    /// Strokes by the stroke of the drawing in whose place they stand; their places are among those below.
    in_order: BTreeMap<usize, Vec<(Range<usize>, u16)>>,
    places: Vec<Vertex>,
    /// Edges that bound a face.
    taken: BTreeSet<usize>,
}

impl Laying {
    /// Lays an edge that begins at an end, or its twin where it lies already.
    fn lay(&mut self, graph: &Graph, end: End, stroke: usize) {
        let twin = graph.twins.get(&(end / 2)).filter(|_| self.taken.contains(&(end / 2)));
        let edge = twin.copied().unwrap_or(end / 2);
        self.taken.insert(edge);
        let from = if graph.node[&(2 * edge)] == graph.node[&end] { 2 * edge } else { 2 * edge + 1 };
        let mut along = directed(&graph.edges[edge].vertices, from);
        self.found.redrawn.extend(graph.meet(&mut along, [end, other(end)]));
        let first = self.places.len();
        self.places.append(&mut along);
        let laid = (first..self.places.len(), graph.edges[edge].pen);
        self.in_order.entry(stroke).or_default().push(laid);
    }

    /// Puts all into a drawing: a stroke of which no edge bounds a face stays whole.
    fn put_into(mut self, drawing: &mut Drawing, edges: &[Edge]) -> Faces {
        if self.taken.is_empty() {
            return self.found;
        }
        let mut of_stroke: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        edges.iter().enumerate().for_each(|(k, edge)| of_stroke.entry(edge.stroke).or_default().push(k));
        let strokes = std::mem::take(&mut drawing.strokes);
        let add = |drawing: &mut Drawing, vertices: &[Vertex], pen: u16| {
            let first = drawing.vertices.len() as u32;
            drawing.vertices.extend_from_slice(vertices);
            drawing.strokes.push(PenStroke { first, end: drawing.vertices.len() as u32, pen });
        };
        for (k, stroke) in strokes.into_iter().enumerate() {
            for (range, pen) in self.in_order.remove(&k).unwrap_or_default() {
                add(drawing, &self.places[range], pen);
            }
            let of_stroke = of_stroke.get(&k).map_or(&[][..], Vec::as_slice);
            if !of_stroke.iter().any(|edge| self.taken.contains(edge)) {
                drawing.strokes.push(stroke);
                continue;
            }
            self.found.parted += of_stroke.len() - 1;
            for edge in of_stroke.iter().filter(|edge| !self.taken.contains(edge)) {
                add(drawing, &edges[*edge].vertices, edges[*edge].pen);
            }
        }
        self.found
    }
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
struct Graph {
    edges: Vec<Edge>,
    /// The place of each end.
    node: BTreeMap<End, usize>,
    /// The ends at each place, those of twins left out.
    nodes: BTreeMap<usize, Vec<End>>,
    /// Edges that lie on others, by these.
    twins: BTreeMap<usize, usize>,
}

impl Graph {
    fn new(edges: Vec<Edge>, reach: f64) -> Self {
        let node = meeting(&edges, reach);
        let mut graph = Self { edges, node, nodes: BTreeMap::new(), twins: BTreeMap::new() };
        let mut between: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
        for stroke in 0..graph.edges.len() {
            let mut places = graph.places(stroke);
            places.sort_unstable();
            let known = between.entry(places).or_default();
            let is_free =
                |other: &&usize| !graph.twins.contains_key(*other) && graph.are_twins([**other, stroke], reach);
            if let Some(&other) = known.iter().find(is_free) {
                graph.twins.insert(other, stroke);
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

    fn leave_out_dead_ends(&mut self) {
        let mut queue: Vec<usize> = self.nodes.keys().copied().collect();
        while let Some(place) = queue.pop() {
            let Some(&[end]) = self.nodes.get(&place).map(Vec::as_slice) else { continue };
            for place in self.places(end / 2) {
                self.nodes.entry(place).or_default().retain(|known| known / 2 != end / 2);
                queue.push(place);
            }
        }
        self.nodes.retain(|_, ends| !ends.is_empty());
    }

    /// The places of both ends of a stroke.
    fn places(&self, stroke: usize) -> [usize; 2] {
        [2 * stroke, 2 * stroke + 1].map(|end| self.node[&end])
    }

    /// Whether two strokes between the same places are drawn along each other.
    fn are_twins(&self, [one, other]: [usize; 2], reach: f64) -> bool {
        let [one, other] = [one, other].map(|stroke| self.points(&[2 * stroke]));
        let is_along = |at: &Point| polyline::distance(*at, &other) <= reach;
        (polyline::length(&one) - polyline::length(&other)).abs() <= reach && one.iter().all(is_along)
    }

    /// Moves the first and the last place of a stroke to where others meet it; the lines that were moved.
    fn meet(&self, along: &mut [Vertex], ends: [End; 2]) -> Vec<Redrawn> {
        let last = along.len() - 1;
        let before: Vec<Point> = along.iter().map(|vertex| vertex.at).collect();
        let [first, end] = ends.map(|end| end_of(&self.edges, self.node[&end]));
        (along[0].at, along[last].at) = (first, end);
        let moved = |&k: &usize| along[k].at != before[k] || along[k + 1].at != before[k + 1];
        let redrawn = |k: usize| Redrawn { drawn: before[k..k + 2].to_vec(), now: [along[k].at, along[k + 1].at] };
        let mut lines = vec![0, last - 1];
        lines.dedup();
        lines.into_iter().filter(moved).map(redrawn).collect()
    }

    /// Strokes that hang together, the first one first.
    fn components(&self) -> Vec<Vec<usize>> {
        let mut components = Vec::new();
        let mut seen: BTreeSet<usize> = BTreeSet::new();
        for first in self.nodes.values().flatten().map(|end| end / 2) {
            let (mut component, mut queue) = (Vec::new(), vec![first]);
            while let Some(stroke) = queue.pop() {
                if seen.insert(stroke) {
                    component.push(stroke);
                    queue.extend(self.places(stroke).iter().flat_map(|place| &self.nodes[place]).map(|end| end / 2));
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
        let mut around: Vec<(f64, End)> = ends.iter().map(|&end| (self.heading(end), end)).collect();
        around.sort_by(|a, b| a.0.total_cmp(&b.0));
        let is_apart = around.windows(2).all(|pair| pair[1].0 - pair[0].0 >= LEAST_ANGLE);
        let turn = TAU - (around[around.len() - 1].0 - around[0].0);
        (is_apart && turn >= LEAST_ANGLE).then(|| around.into_iter().map(|(_, end)| end).collect())
    }

    /// The direction in which a stroke leaves the place of an end, rad.
    fn heading(&self, end: End) -> f64 {
        let points = self.points(&[end]);
        let stations = polyline::stations(&points);
        let way = polyline::place(&points, &stations, STRETCH) - points[0];
        way.y.atan2(way.x)
    }

    /// Places of some strokes behind each other.
    fn points(&self, ends: &[End]) -> Vec<Point> {
        let vertices = |&end: &End| directed(&self.edges[end / 2].vertices, end);
        ends.iter().flat_map(vertices).map(|vertex| vertex.at).collect()
    }
}

/// The place of an end, as it is drawn.
fn end_of(edges: &[Edge], end: End) -> Point {
    let vertices = &edges[end / 2].vertices;
    vertices[if end.is_multiple_of(2) { 0 } else { vertices.len() - 1 }].at
}

/// The place of both ends of each edge: ends of one pen within reach of each other, in the order of X, are at one place.
fn meeting(edges: &[Edge], reach: f64) -> BTreeMap<End, usize> {
    let key = |end: End| (edges[end / 2].pen, end_of(edges, end));
    let mut ends: Vec<End> = (0..2 * edges.len()).collect();
    ends.sort_by(|&a, &b| {
        let ((pen, at), (other_pen, other)) = (key(a), key(b));
        pen.cmp(&other_pen).then(at.x.total_cmp(&other.x)).then(a.cmp(&b))
    });
    let mut node: BTreeMap<End, usize> = BTreeMap::new();
    for (k, &end) in ends.iter().enumerate() {
        let (pen, at) = key(end);
        let is_beside = |known: &&End| key(**known).0 == pen && at.x - key(**known).1.x <= reach;
        let before = ends[..k].iter().rev().take_while(is_beside).take(MOST_BESIDE);
        let near = before.copied().find(|&known| (key(known).1 - at).amax() <= reach);
        node.insert(end, near.map_or(end, |known| node[&known]));
    }
    node
}
