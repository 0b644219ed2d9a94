//! Pieces from parts, cut-outs, notches, holes and lines, and the account of what was not cut.

use std::collections::BTreeMap;

use super::classify::{Sorted, depth};
use super::drawing::{Vertex, led_to, moments};
use super::notch::Found;
use super::shape::{CLASSES, Class, LONGEST_NOTCH, Shape};
use super::spike::{self, Pruned, prune};
use super::vee::{Material, Outline};
use crate::diagnostic::{Diagnostic, code};
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, Vector, cross, ring};
use crate::ir::Marker;
use crate::ir::list::{FULL_SPEED, Joint, Segment, SegmentList};
use crate::ir::marker::{Aside, Contour, Drawing, DrawnClass, Drill, Label, Notch, NotchKind, Piece};
use crate::machine::Job;
use crate::source::Span;

/// The drill that makes the holes.
const DRILL: u8 = 1;
/// Visits of boxes and vertices to find the pieces of labels, lines and holes: a guard against drawings that are made to be slow.
const MOST_WORK: usize = 200_000_000;

/// The marker, and what was not found for it.
#[derive(Debug)]
pub(super) struct Made {
    pub(super) marker: Marker,
    pub(super) findings: Vec<Diagnostic>,
}

/// Makes the marker.
pub(super) fn marker(sorted: &Sorted, labels: Vec<Label>, job: &Job) -> Made {
    let unit = job.profile.hpgl.unit.mm();
    let moved = sorted.drawing.moved;
    let mut making = Making {
        sorted,
        unit,
        list: SegmentList::default(),
        aside: Aside { points: moved.points, moments: moved.moments, bounds: moved.bounds },
        parts: Vec::new(),
        boxes: Boxes::default(),
        pieces: Vec::new(),
        vees: BTreeMap::new(),
        spikes: 0,
        spike_length: 0.0,
        texts_outside: 0,
        work: MOST_WORK,
        findings: Vec::new(),
    };
    let cut = || sorted.shapes.iter().filter(|shape| shape.class.is_cut() && shape.class != Class::Hole);
    making.list.reserve(cut().map(|shape| shape.stroke.range().len() - 1).sum(), cut().count());
    making.begin_parts();
    making.add_notches();
    making.add_inner();
    making.add_outlines();
    making.add_labels(labels);
    making.say_what_was_not_searched();
    let drawing = making.account();
    for (i, piece) in making.pieces.iter_mut().enumerate() {
        piece.number = i as u32 + 1;
    }
    let marker = Marker { list: making.list, pieces: making.pieces, unit, drawing: Some(drawing), ..Marker::default() };
    Made { marker, findings: making.findings }
}

/// The centre of gravity of a closed line: that of a circle whatever its chords.
fn centroid(shape: &Shape, vertices: &[Vertex]) -> Point {
    let origin = vertices[0].at;
    let part = |pair: &[Vertex]| {
        let (a, b) = (pair[0].at - origin, pair[1].at - origin);
        (a + b) * cross(a, b)
    };
    let sum = vertices.windows(2).map(part).fold(Vector::zeros(), |sum, part| sum + part);
    origin + sum / (6.0 * shape.area)
}

/// An outline without its spikes, and the piece that it is of.
#[derive(Debug, Clone, Copy)]
struct Ring<'a> {
    piece: usize,
    outline: usize,
    vertices: &'a [Vertex],
}

struct Making<'a> {
    sorted: &'a Sorted,
    unit: f64,
    list: SegmentList,
    aside: Aside,
    /// The outlines of parts, as indices in the list of outlines, in cut order; then their pieces in the same order.
    parts: Vec<usize>,
    /// The boxes of the parts, by their index in that list.
    boxes: Boxes,
    pieces: Vec<Piece>,
    /// The marks of two legs of each outline.
    vees: BTreeMap<usize, Vec<Found>>,
    /// Notches that were spikes of outlines, and their length, mm.
    spikes: usize,
    spike_length: f64,
    texts_outside: usize,
    work: usize,
    findings: Vec<Diagnostic>,
}

impl Making<'_> {
    fn shape(&self, outline: usize) -> &Shape {
        &self.sorted.shapes[self.sorted.outlines[outline]]
    }

    fn span(&self, shape: &Shape) -> Span {
        shape.vertices(&self.sorted.drawing)[1].span
    }

    /// Parts in the order of the file; one that lies in the cut-out of another comes before that one.
    fn begin_parts(&mut self) {
        let parents = &self.sorted.parents;
        let outermost = |k: usize| std::iter::successors(Some(k), |&k| parents[k]).last().unwrap_or(k);
        let mut keys: Vec<(usize, usize, usize)> = (0..self.sorted.outlines.len())
            .filter(|&k| self.shape(k).class == Class::Part)
            .map(|k| (outermost(k), usize::MAX - depth(parents, k), k))
            .collect();
        keys.sort_unstable();
        self.parts = keys.into_iter().map(|(_, _, k)| k).collect();
        self.boxes = Boxes::new(self.parts.iter().map(|&k| *self.shape(k).extent()).collect());
        self.pieces =
            self.parts.iter().map(|&k| Piece { span: self.span(self.shape(k)), ..Piece::default() }).collect();
    }

    /// The piece of an outline: its own, or that of the part whose cut-out it is.
    fn piece_of(&self, pieces: &[usize], outline: usize) -> usize {
        let part = if self.shape(outline).class == Class::Part { None } else { self.sorted.parents[outline] };
        pieces[part.unwrap_or(outline)]
    }

    /// The piece of each outline that is a part.
    fn pieces_by_outline(&self) -> Vec<usize> {
        let mut pieces = vec![0; self.sorted.outlines.len()];
        for (piece, &outline) in self.parts.iter().enumerate() {
            pieces[outline] = piece;
        }
        pieces
    }

    /// The marks on outlines: those of one line are cut before them, those of two wait for them.
    fn add_notches(&mut self) {
        let sorted = self.sorted;
        let by_outline = self.pieces_by_outline();
        for found in &sorted.notches {
            let piece = self.piece_of(&by_outline, found.outline);
            if found.cut.is_some() {
                self.add_slits(piece, found);
            } else {
                self.vees.entry(found.outline).or_default().push(*found);
            }
        }
    }

    /// A mark as slits: one from the edge, or one from each side of the mouth of two legs, which meet at the tip.
    fn add_slits(&mut self, piece: usize, found: &Found) {
        let shape = &self.sorted.shapes[found.mark];
        let vertices = shape.vertices(&self.sorted.drawing);
        let mut add = |root, tip, span| {
            let notch = Notch { kind: NotchKind::Slit, root, tip, percent: FULL_SPEED, span };
            self.pieces[piece].notches.push(notch);
        };
        match (found.cut, vertices) {
            (None, [first, tip, last]) => {
                add(first.at, tip.at, tip.span);
                add(last.at, tip.at, last.span);
                self.aside.points += shape.points() - 2;
            }
            (Some([root, tip]), [_, first, back @ ..]) => {
                add(root, tip, first.span);
                self.aside.points += shape.points() - 1;
                // The way back, where it is drawn.
                self.aside.moments += moments(&vertices[1..]);
                for vertex in back {
                    self.aside.bounds.add(vertex.at);
                }
            }
            _ => {}
        }
    }

    /// What else is cut before the outlines: holes, and lines with the marks on them.
    fn add_inner(&mut self) {
        let sorted = self.sorted;
        for (i, shape) in sorted.shapes.iter().enumerate() {
            match shape.class {
                Class::Hole => {
                    let middle = centroid(shape, shape.vertices(&sorted.drawing));
                    let span = self.span(shape);
                    let piece = self.piece_around(middle, span);
                    self.pieces[piece].drills.push(Drill { at: middle, tool: DRILL, span });
                }
                Class::Line => {
                    let vertices = shape.vertices(&sorted.drawing);
                    let piece = self.piece_around(vertices[0].at, self.span(shape));
                    let is_on_line = |found: &&Found| sorted.lines[found.outline] == i;
                    let first = sorted.line_notches.partition_point(|found| sorted.lines[found.outline] < i);
                    for found in sorted.line_notches[first..].iter().take_while(is_on_line) {
                        self.add_slits(piece, found);
                    }
                    self.add_contour(piece, vertices);
                }
                Class::Part | Class::CutOut | Class::Notch | Class::Frame | Class::Text | Class::Other | Class::Pen => {
                }
            }
        }
        let is_inner = |shape: &Shape| matches!(shape.class, Class::Hole | Class::Line);
        if self.work == 0 && sorted.shapes.iter().any(is_inner) {
            let message =
                "there are too many lines to tell which part each hole or line lies in: some would come behind it";
            let finding = Diagnostic::new(&code::HPGL_TOO_MANY, message);
            self.findings.push(finding.hint("split the plot, or leave out fills and hatchings"));
        }
    }

    /// Cut-outs, then the part itself, with the spikes among their notches.
    fn add_outlines(&mut self) {
        let sorted = self.sorted;
        let by_outline = self.pieces_by_outline();
        for class in [Class::CutOut, Class::Part] {
            for outline in 0..sorted.outlines.len() {
                let shape = self.shape(outline);
                if shape.class != class {
                    continue;
                }
                let (vertices, has_spikes) = (shape.vertices(&sorted.drawing), shape.has_spikes);
                let piece = self.piece_of(&by_outline, outline);
                let marks = self.vees.remove(&outline).unwrap_or_default();
                if !has_spikes {
                    self.add_outline(Ring { piece, outline, vertices }, &marks);
                    continue;
                }
                let measure = spike::Measure { unit: self.unit, longest: LONGEST_NOTCH };
                let Pruned { vertices, spikes, points, moments, bounds } = prune(vertices, measure);
                self.aside.points += points;
                self.aside.moments += moments;
                self.leave_aside(&bounds);
                self.spikes += spikes.len();
                for spike in spikes {
                    let (root, tip, span) = (spike.root, spike.tip.at, spike.tip.span);
                    let notch = Notch { kind: NotchKind::Slit, root, tip, percent: FULL_SPEED, span };
                    self.spike_length += notch.depth();
                    self.pieces[piece].notches.push(notch);
                }
                self.add_outline(Ring { piece, outline, vertices: &vertices }, &marks);
            }
        }
    }

    /// An outline, led into those of the marks of two legs that are V notches; of others each leg is cut by itself.
    fn add_outline(&mut self, ring: Ring, marks: &[Found]) {
        let Ring { piece, outline, vertices } = ring;
        if marks.is_empty() {
            self.add_contour(piece, vertices);
            return;
        }
        let shape = *self.shape(outline);
        let drawing = &self.sorted.drawing;
        let material = if shape.class == Class::CutOut { Material::Outside } else { Material::Inside };
        let mut notched = Outline::new(vertices, material, self.unit);
        self.aside.points += led_to(vertices);
        for found in marks {
            let mark = &self.sorted.shapes[found.mark];
            let &[first, tip, last] = mark.vertices(drawing) else { continue };
            self.work = self.work.saturating_sub(notched.len());
            let mouth = if self.work > 0 { notched.notch([first, tip, last]) } else { None };
            let Some(mouth) = mouth else {
                self.add_slits(piece, found);
                continue;
            };
            self.aside.points += mark.points();
            self.aside.moments += mouth.moments;
            self.leave_aside(&mouth.bounds);
        }
        let vertices = notched.into_vertices();
        self.aside.points -= led_to(&vertices);
        self.add_contour(piece, &vertices);
    }

    fn add_contour(&mut self, piece: usize, vertices: &[Vertex]) {
        let segments = vertices.windows(2).map(|pair| Segment {
            from: pair[0].at,
            to: pair[1].at,
            span: pair[1].span,
            joint: Joint::default(),
            percent: FULL_SPEED,
        });
        let closed = vertices.first().map(|v| v.at) == vertices.last().map(|v| v.at);
        if let Some(range) = self.list.append(segments) {
            self.pieces[piece].contours.push(Contour { range, closed });
        }
    }

    /// The piece whose part holds a place most closely; a new one when none does.
    fn piece_around(&mut self, at: Point, span: Span) -> usize {
        self.part_around(at).unwrap_or_else(|| {
            self.pieces.push(Piece { span, ..Piece::default() });
            self.pieces.len() - 1
        })
    }

    /// The piece of the least part that holds a place; of equal ones the first.
    fn part_around(&mut self, at: Point) -> Option<usize> {
        let mut best: Option<(f64, usize)> = None;
        self.work = self.work.saturating_sub(self.boxes.cost_at(at));
        for piece in self.boxes.at(at) {
            if self.work == 0 {
                return None;
            }
            let shape = self.shape(self.parts[piece]);
            let rank = (shape.area.abs(), piece);
            if best.is_some_and(|best| rank >= best) {
                continue;
            }
            let vertices = shape.vertices(&self.sorted.drawing);
            self.work = self.work.saturating_sub(vertices.len());
            let points: Vec<Point> = vertices.iter().map(|vertex| vertex.at).collect();
            if ring::contains(&points, at) {
                best = Some(rank);
            }
        }
        best.map(|(_, piece)| piece)
    }

    /// A label goes to the part that it stands in; titles beside the parts go to none and are counted.
    fn add_labels(&mut self, labels: Vec<Label>) {
        for label in labels {
            match label.at.and_then(|at| self.part_around(at)) {
                Some(piece) => self.pieces[piece].labels.push(label),
                None => self.texts_outside += 1,
            }
        }
    }

    fn say_what_was_not_searched(&mut self) {
        if self.work == 0 && self.findings.is_empty() {
            let message = "there are too many lines to find the part of every text and the shape of every notch";
            let finding = Diagnostic::new(&code::HPGL_SEARCH_ENDED, message);
            self.findings.push(finding.hint("split the plot, or leave texts out"));
        }
    }

    /// Something is drawn there that is not cut.
    fn leave_aside(&mut self, extent: &Extent) {
        if !extent.is_empty() {
            self.aside.bounds.add(extent.min);
            self.aside.bounds.add(extent.max);
        }
    }

    /// What all lines were taken for, and what of them is not cut.
    fn account(&mut self) -> Drawing {
        let shapes = &self.sorted.shapes;
        for shape in shapes.iter().filter(|shape| !shape.class.is_cut() || shape.class == Class::Hole) {
            self.aside.points += shape.points();
            self.aside.moments += shape.moments(&self.sorted.drawing);
            self.leave_aside(shape.extent());
        }
        let class = |&(class, name): &(Class, &'static str)| {
            let of = || shapes.iter().filter(|shape| shape.class == class);
            // The sum of no numbers would be the negative of zero.
            let (mut count, length) = (of().count(), of().fold(0.0, |sum, shape| sum + shape.length));
            if class == Class::Notch {
                count += self.spikes;
            }
            DrawnClass { name, cut: class.is_cut(), count, length }
        };
        let classes: Vec<DrawnClass> = CLASSES.iter().map(class).collect();
        let drawn = shapes.iter().fold(0.0, |sum, shape| sum + shape.length);
        let pen_down = drawn + self.sorted.drawing.moved.moments.length();
        Drawing { pen_down, classes, texts_outside: self.texts_outside, aside: self.aside }
    }
}
