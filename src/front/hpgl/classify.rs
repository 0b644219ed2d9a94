//! What is cut of a drawing: parts with their cut-outs, notches and holes.
//!
//! A plot draws frames, letters and grain lines with the same pen as parts. Pens and options decide where they say
//! something; elsewhere shapes do: closed lines are parts or cut-outs, short marks and spikes on them are notches, small
//! closed squares and circles are holes when the profile wants that; a rectangle around all others is the frame.

use std::collections::BTreeSet;

use super::chain;
use super::drawing::{Drawing, Stroke, Vertex};
use super::nest::{self, Nest};
use super::notch::{self, Found, Marks, Search};
use super::piece::{self, Made};
use super::shape::{Class, LONGEST_NOTCH, ROUNDING, SHORTEST_NAMED, SHORTEST_OUTLINE, Shape, Wanted, mark};
use super::text;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::bits;
use crate::ir::Marker;
use crate::ir::marker::Label;
use crate::machine::Job;
use crate::units::number::fixed;

/// Everything that is known of a drawing before pieces are made.
#[derive(Debug)]
pub(super) struct Sorted {
    pub(super) drawing: Drawing,
    pub(super) shapes: Vec<Shape>,
    /// The outlines of parts and cut-outs, as indices of shapes.
    pub(super) outlines: Vec<usize>,
    /// Of each outline the least one that holds it, as an index in their list.
    pub(super) parents: Vec<Option<usize>>,
    pub(super) notches: Vec<Found>,
    /// Outlines with a gap that are cut as they stand, as indices of shapes, and the marks on them in that order.
    pub(super) lines: Vec<usize>,
    pub(super) line_notches: Vec<Found>,
}

/// Gap of an outline that is cut as it stands, mm; a line with a wider one may be something else.
const LARGEST_GAP: f64 = 1.0;
/// How much longer one side of a hole's box may be than the other.
const HOLE_RATIO: f64 = 1.1;
/// Share of its box that a circle of eight chords fills; a square fills all of it.
const HOLE_FILL: f64 = 0.7;

/// Decides what is cut, and makes the marker of it.
pub(super) fn classify(mut drawing: Drawing, labels: Vec<Label>, job: &Job, out: &mut Diagnostics) -> Marker {
    let unit = job.profile.hpgl.unit.mm();
    let slack = ROUNDING * unit;
    let is_spur = |drawing: &Drawing, stroke: &Stroke| is_mark(drawing, stroke, unit);
    let mut joints = chain::join(&mut drawing, is_spur);
    chain::snap(&mut drawing, slack);
    joints.append(&mut chain::join(&mut drawing, is_spur));
    let strokes = std::mem::take(&mut drawing.strokes);
    let mut shapes: Vec<Shape> = strokes.into_iter().map(|stroke| Shape::of(&drawing, stroke, job)).collect();
    for finding in leave_out_frames(&drawing, &mut shapes, slack) {
        out.push(finding);
    }
    for shape in &mut shapes {
        shape.class = match shape.wanted {
            _ if shape.class == Class::Frame => Class::Frame,
            Wanted::Nothing => Class::Pen,
            Wanted::All | Wanted::Open if !shape.is_closed => Class::Line,
            Wanted::Guess if shape.length >= SHORTEST_OUTLINE && has_small_gap(shape, &drawing) => Class::Line,
            Wanted::Guess | Wanted::All | Wanted::Closed | Wanted::Open => Class::Other,
        };
    }
    // Marks first: what stands on an outline is no part of a letter.
    let candidates = |shapes: &[Shape]| -> Vec<usize> {
        let may_be = |shape: &Shape| {
            !shape.is_closed && matches!(shape.wanted, Wanted::Guess | Wanted::All) && shape.class != Class::Pen
        };
        (0..shapes.len()).filter(|&i| may_be(&shapes[i])).collect()
    };
    let is_gapped = |shape: &Shape| shape.class == Class::Line && shape.wanted == Wanted::Guess;
    let is_free = |shape: &Shape| shape.is_outline() && shape.class == Class::Other;
    let large: Vec<usize> =
        (0..shapes.len()).filter(|&i| is_free(&shapes[i]) && shapes[i].size() > LONGEST_NOTCH).collect();
    let marks = candidates(&shapes);
    let search = Search { drawing: &drawing, shapes: &shapes, unit, candidates: &marks, outlines: &large };
    let Marks { found, mut is_cut_short } = notch::on_outlines(search);
    for found in found {
        shapes[found.mark].class = Class::Notch;
    }
    let letters = text::mark_letters(&mut shapes);
    is_cut_short |= letters.is_cut_short;
    if let Some(&first) = letters.closed.first() {
        out.push(taken_for_text(letters.closed.len()).at(shapes[first].vertices(&drawing)[1].span));
    }
    for shape in &mut shapes {
        if shape.is_outline() && shape.class == Class::Other && is_hole(shape, job) {
            shape.class = Class::Hole;
        }
    }
    let outlines: Vec<usize> = (0..shapes.len()).filter(|&i| is_free(&shapes[i])).collect();
    let Nest { parents, is_cut_short: is_nest_cut_short } = nest::nest(&drawing, &shapes, &outlines, slack);
    for (k, &outline) in outlines.iter().enumerate() {
        let depth = depth(&parents, k);
        shapes[outline].class = if depth.is_multiple_of(2) { Class::Part } else { Class::CutOut };
    }
    let mut marks = candidates(&shapes);
    marks.retain(|&i| shapes[i].class != Class::Text);
    let search = Search { drawing: &drawing, shapes: &shapes, unit, candidates: &marks, outlines: &outlines };
    let Marks { found: notches, is_cut_short: are_marks_cut_short } = notch::on_outlines(search);
    if is_nest_cut_short {
        let message = "there are too many closed lines to tell which lies in which: cut-outs would be cut as parts";
        out.push(
            Diagnostic::new(&code::HPGL_TOO_MANY, message).hint("split the plot, or leave out fills and hatchings"),
        );
    }
    for shape in &mut shapes {
        // A line that lost its outline to the letters is what it was before.
        if shape.class == Class::Notch {
            shape.class = if shape.wanted == Wanted::All { Class::Line } else { Class::Other };
        }
    }
    for found in &notches {
        shapes[found.mark].class = Class::Notch;
    }
    name_unended(&drawing, &shapes, out);
    let lines: Vec<usize> = (0..shapes.len()).filter(|&i| is_gapped(&shapes[i])).collect();
    marks.retain(|&i| shapes[i].class == Class::Other);
    let search = Search { drawing: &drawing, shapes: &shapes, unit, candidates: &marks, outlines: &lines };
    let Marks { found: mut line_notches, is_cut_short: are_line_marks_cut_short } = notch::on_outlines(search);
    line_notches.sort_by_key(|found| found.outline);
    for found in &line_notches {
        shapes[found.mark].class = Class::Notch;
    }
    if is_cut_short || are_marks_cut_short || are_line_marks_cut_short {
        let message = "there are too many lines to find every notch and letter among them: some are not recognised";
        out.push(Diagnostic::new(&code::HPGL_SEARCH_ENDED, message).hint("split the plot, or leave texts out"));
    }
    name_near_outlines(&drawing, &shapes, out);
    name_dividing(Divided { drawing: &drawing, shapes: &shapes, joints: &joints }, out);
    let sorted = Sorted { drawing, shapes, outlines, parents, notches, lines, line_notches };
    let Made { marker, findings } = piece::marker(&sorted, labels, job);
    for finding in findings {
        out.push(finding);
    }
    marker
}

/// Takes the frames out, and names each.
fn leave_out_frames(drawing: &Drawing, shapes: &mut [Shape], slack: f64) -> Vec<Diagnostic> {
    let name = |shape: &Shape| {
        let (width, height) = shape.extent().size();
        let message = format!(
            "a rectangle of {} x {} mm holds all outlines: it is taken for the frame and not cut",
            fixed(width, 1),
            fixed(height, 1)
        );
        let finding = Diagnostic::new(&code::HPGL_FRAME, message).at(shape.vertices(drawing)[1].span);
        finding.hint("if it is a part, `--cut closed` cuts every closed line")
    };
    nest::frames(shapes, slack).into_iter().map(|frame| name(&shapes[frame])).collect()
}

/// Names so many closed lines that stand among letters.
fn taken_for_text(count: usize) -> Diagnostic {
    let lines =
        if count == 1 { "a small closed line stands".to_owned() } else { format!("{count} small closed lines stand") };
    let message =
        format!("{lines} in a row with open ones of like height, the first one here: taken for letters, not cut");
    let finding = Diagnostic::new(&code::HPGL_TEXT, message);
    finding.hint("if they are parts or cut-outs, `--cut closed` cuts every closed line")
}

fn has_small_gap(shape: &Shape, drawing: &Drawing) -> bool {
    shape.gap(drawing).is_some_and(|gap| gap <= LARGEST_GAP)
}

/// Refuses a plot that ends while the pen draws, unless that line is whole: it closes, by itself or with those that it
/// meets, or it is a notch. Then only the last PU is missing.
fn name_unended(drawing: &Drawing, shapes: &[Shape], out: &mut Diagnostics) {
    let Some(span) = drawing.unended else { return };
    let is_last = |shape: &&Shape| shape.vertices(drawing).iter().any(|vertex| vertex.span == span);
    let Some(shape) = shapes.iter().find(is_last).filter(|shape| shape.class != Class::Notch) else { return };
    let vertices = shape.vertices(drawing);
    let distance = (vertices[vertices.len() - 1].at - vertices[0].at).norm();
    if distance > 0.0 {
        let message = format!("the file ends amid a line, {} mm from where the line starts", fixed(distance, 1));
        let finding = Diagnostic::new(&code::HPGL_ENDS_PEN_DOWN, message).at(span);
        out.push(finding.hint("most likely it is cut short: export it again; if it is complete, put `PU;` at its end"));
    }
}

/// Names lines that are not cut and may be outlines: they nearly close, alone or with others, or they cross themselves.
fn name_near_outlines(drawing: &Drawing, shapes: &[Shape], out: &mut Diagnostics) {
    let is_left = |shape: &&Shape| shape.class == Class::Other && shape.wanted == Wanted::Guess;
    let left: Vec<&Shape> = shapes.iter().filter(is_left).collect();
    let name = |code, message, shape: &Shape| Diagnostic::new(code, message).at(shape.vertices(drawing)[1].span);
    for shape in &left {
        let length = fixed(shape.length, 1);
        if let Some(gap) = shape.gap(drawing) {
            let message =
                format!("a line of {length} mm ends {} mm from where it starts: it is not cut", fixed(gap, 1));
            let finding = name(&code::HPGL_OPEN_OUTLINE, message, shape);
            out.push(finding.hint("if it is an outline, close it; `--cut all` cuts every line as it stands"));
        } else if shape.is_crossed && shape.length >= SHORTEST_OUTLINE {
            let message = format!("a closed line of {length} mm crosses itself, and its halves cancel: it is not cut");
            let finding = name(&code::HPGL_CROSSED, message, shape);
            out.push(finding.hint("if it is an outline, repair it; `--cut closed` cuts it as it is drawn"));
        }
    }
    let strokes: Vec<Stroke> = left.iter().map(|shape| shape.stroke).collect();
    for ring in chain::near_rings(&drawing.vertices, &strokes, LARGEST_GAP) {
        let length: f64 = ring.iter().map(|&k| left[k as usize].length).sum();
        if length >= SHORTEST_NAMED {
            let (count, length) = (ring.len(), fixed(length, 1));
            let message = format!(
                "{count} lines of {length} mm in all go around, but their ends miss each other by up to {LARGEST_GAP} mm: \
                 they are not cut"
            );
            let finding = name(&code::HPGL_OPEN_OUTLINE, message, left[ring[0] as usize]);
            out.push(
                finding.hint("if they are an outline, let the CAD join them; `--cut all` cuts them as they stand"),
            );
        }
    }
}

/// Lines, and the places where three or more of them met before they were joined.
#[derive(Debug, Clone, Copy)]
struct Divided<'a> {
    drawing: &'a Drawing,
    shapes: &'a [Shape],
    joints: &'a BTreeSet<[u64; 2]>,
}

/// Names lines that are not cut and lead from one such place to another: they may part two pieces.
fn name_dividing(Divided { drawing, shapes, joints }: Divided, out: &mut Diagnostics) {
    let is_joint = |vertex: &Vertex| joints.contains(&bits(vertex.at));
    let divides = |shape: &&Shape| {
        let vertices = shape.vertices(drawing);
        let is_left = shape.class == Class::Other && shape.wanted == Wanted::Guess && !shape.is_closed;
        is_left && shape.length >= SHORTEST_NAMED && is_joint(&vertices[0]) && is_joint(&vertices[vertices.len() - 1])
    };
    let all: Vec<&Shape> = shapes.iter().filter(divides).collect();
    let Some(first) = all.first() else { return };
    let length = fixed(all.iter().map(|shape| shape.length).sum(), 1);
    let lines = if all.len() == 1 {
        format!("a line of {length} mm leads")
    } else {
        format!("{} lines of {length} mm in all lead", all.len())
    };
    let message = format!("{lines} between places where three lines meet, the first one here: in no outline, not cut");
    let finding = Diagnostic::new(&code::HPGL_DIVIDING, message).at(first.vertices(drawing)[1].span);
    out.push(
        finding.hint("if it parts two pieces, let the CAD draw each whole; `--cut all` cuts every line as it stands"),
    );
}

/// How many outlines hold one.
pub(super) fn depth(parents: &[Option<usize>], outline: usize) -> usize {
    std::iter::successors(parents[outline], |&parent| parents[parent]).count()
}

fn is_mark(drawing: &Drawing, stroke: &Stroke, unit: f64) -> bool {
    mark(&drawing.vertices[stroke.range()], unit).is_some()
}

/// Whether a closed line is a square or a circle of the size of a hole.
fn is_hole(shape: &Shape, job: &Job) -> bool {
    let (width, height) = shape.extent().size();
    let (greater, less) = (width.max(height), width.min(height));
    let is_small = job.profile.hpgl.drill_max_mm.is_some_and(|most| greater <= most);
    is_small && greater <= HOLE_RATIO * less && shape.area.abs() >= HOLE_FILL * width * height
}
