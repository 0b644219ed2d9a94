//! What is cut of a drawing: parts with their cut-outs, notches and holes.
//!
//! A plot draws frames, letters and grain lines with the same pen as parts. Pens and options decide where they say
//! something; elsewhere shapes do: closed lines are parts or cut-outs, short marks and spikes on them are notches, small
//! closed squares and circles are holes when the profile wants that; a rectangle around all others is the frame.

use std::collections::BTreeSet;

use super::beside::{self, Beside, MARK_REACH};
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
/// Share of its part that a cut-out takes at most without a doubt.
const LARGE_CUT_OUT: f64 = 0.5;
/// The same where another pen draws it, or the part is a rectangle that may be a frame: as full as frames are.
const DOUBTFUL_CUT_OUT: f64 = nest::LEAST_FILL;
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
    is_cut_short |= are_marks_cut_short || are_line_marks_cut_short;
    // Among marks that were not searched to the end nobody knows which are no notches.
    let beside = if is_cut_short { Beside::default() } else { beside_outlines(&drawing, &shapes, unit) };
    if is_cut_short || beside.is_cut_short {
        let message = "there are too many lines to find every notch and letter among them: some are not recognised";
        out.push(Diagnostic::new(&code::HPGL_SEARCH_ENDED, message).hint("split the plot, or leave texts out"));
    }
    name_near_outlines(&drawing, &shapes, out);
    let left = Lines { drawing: &drawing, shapes: &shapes, beside: &beside };
    name_dividing(left, &joints, out);
    name_missed_marks(left, out);
    if !is_nest_cut_short {
        name_large_cut_outs(Nested { drawing: &drawing, shapes: &shapes, outlines: &outlines, parents: &parents }, out);
    }
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

/// Whether a line is left that a guess might have cut.
fn is_open_rest(shape: &Shape) -> bool {
    shape.class == Class::Other && shape.wanted == Wanted::Guess && !shape.is_closed
}

/// What is left beside outlines and notches. Small outlines are holes that are drawn with a cross.
fn beside_outlines(drawing: &Drawing, shapes: &[Shape], unit: f64) -> Beside {
    let is_rest = |shape: &Shape| is_open_rest(shape) && shape.gap(drawing).is_none();
    let is_edge = |shape: &Shape| match shape.class {
        Class::Part | Class::CutOut | Class::Line => shape.size() > LONGEST_NOTCH,
        Class::Notch => true,
        Class::Hole | Class::Frame | Class::Text | Class::Other | Class::Pen => false,
    };
    let candidates: Vec<usize> = (0..shapes.len()).filter(|&i| is_rest(&shapes[i])).collect();
    let outlines: Vec<usize> = (0..shapes.len()).filter(|&i| is_edge(&shapes[i])).collect();
    beside::find(Search { drawing, shapes, unit, candidates: &candidates, outlines: &outlines })
}

/// Lines, and which of them stand beside outlines.
#[derive(Debug, Clone, Copy)]
struct Lines<'a> {
    drawing: &'a Drawing,
    shapes: &'a [Shape],
    beside: &'a Beside,
}

/// Names lines that are not cut and may part two pieces: they lead from one place where three lines met before they were
/// joined to another, or from outline to outline.
fn name_dividing(lines: Lines, joints: &BTreeSet<[u64; 2]>, out: &mut Diagnostics) {
    let Lines { drawing, shapes, beside } = lines;
    let is_joint = |vertex: &Vertex| joints.contains(&bits(vertex.at));
    let joins = |shape: &Shape| {
        let vertices = shape.vertices(drawing);
        let is_long = is_open_rest(shape) && shape.length >= SHORTEST_NAMED;
        is_long && is_joint(&vertices[0]) && is_joint(&vertices[vertices.len() - 1])
    };
    let between_joints: Vec<&Shape> = shapes.iter().filter(|shape| joins(shape)).collect();
    let between_outlines: Vec<&Shape> =
        beside.dividing.iter().map(|&i| &shapes[i]).filter(|shape| !joins(shape)).collect();
    let ways = [
        (between_joints, "between places where three lines meet"),
        (between_outlines, "from one place of an outline to another"),
    ];
    for (all, way) in ways {
        let Some(first) = all.first() else { continue };
        let length = fixed(all.iter().map(|shape| shape.length).sum(), 1);
        let lines = if all.len() == 1 {
            format!("a line of {length} mm leads")
        } else {
            format!("{} lines of {length} mm in all lead", all.len())
        };
        let message = format!("{lines} {way}, the first one here: in no outline, not cut");
        let finding = Diagnostic::new(&code::HPGL_DIVIDING, message).at(first.vertices(drawing)[1].span);
        let hint = "if it parts two pieces, let the CAD draw each whole; `--cut all` cuts every line as it stands";
        out.push(finding.hint(hint));
    }
}

/// Names short lines that are not cut and stand where notches do.
fn name_missed_marks(Lines { drawing, shapes, beside }: Lines, out: &mut Diagnostics) {
    let Some(first) = beside.marks.first().map(|&i| &shapes[i]) else { return };
    let lines = if beside.marks.len() == 1 {
        format!("a mark of {} mm stands", fixed(first.length, 1))
    } else {
        format!("{} marks, the first one here, stand", beside.marks.len())
    };
    let message =
        format!("{lines} across an outline or a notch, or within {MARK_REACH} mm of an edge: no notch, not cut");
    let finding = Diagnostic::new(&code::HPGL_MISSED_MARK, message).at(first.vertices(drawing)[1].span);
    out.push(finding.hint(format!(
        "move the mark onto the edge in the CAD system: notches are lines from the edge of at most {LONGEST_NOTCH} mm; \
         `--cut all` cuts every line"
    )));
}

/// Outlines, and of each the one that holds it.
#[derive(Debug, Clone, Copy)]
struct Nested<'a> {
    drawing: &'a Drawing,
    shapes: &'a [Shape],
    outlines: &'a [usize],
    parents: &'a [Option<usize>],
}

/// Names cut-outs that leave little of their part: the inner one may be a seam, or the outer one a frame.
fn name_large_cut_outs(nested: Nested, out: &mut Diagnostics) {
    let Nested { drawing, shapes, outlines, parents } = nested;
    let shape = |k: usize| &shapes[outlines[k]];
    let parts = outlines.iter().filter(|&&i| shapes[i].class == Class::Part).count();
    let share = |k: usize| {
        let (inner, outer) = (shape(k), shape(parents[k]?));
        let may_be_frame = parts == 1 && outlines.len() == 2 && nest::is_rectangle(outer);
        let is_doubtful = may_be_frame || inner.stroke.pen != outer.stroke.pen;
        let least = if is_doubtful { DOUBTFUL_CUT_OUT } else { LARGE_CUT_OUT };
        let share = inner.area.abs() / outer.area.abs();
        let is_guessed = inner.class == Class::CutOut && inner.wanted == Wanted::Guess;
        (is_guessed && share > least).then_some((inner, outer, share))
    };
    let all: Vec<(&Shape, &Shape, f64)> = (0..outlines.len()).filter_map(share).collect();
    let Some(&(inner, outer, share)) = all.first() else { return };
    let lines = if all.len() == 1 {
        "a cut-out takes".to_owned()
    } else {
        format!("{} cut-outs take much of their parts, the first one here", all.len())
    };
    let message =
        format!("{lines} {} percent of its part: it may be a seam, or the part a frame", fixed(100.0 * share, 0));
    let finding = Diagnostic::new(&code::HPGL_LARGE_CUT_OUT, message).at(inner.vertices(drawing)[1].span);
    out.push(if inner.stroke.pen == outer.stroke.pen {
        finding
            .hint("if only one of the lines is to be cut, let the CAD draw it with a pen of its own, for `--cut-pens`")
    } else {
        finding.hint(format!(
            "if only one of the lines is to be cut, say which: `--cut-pens {}` the outer, `--cut-pens {}` the inner",
            outer.stroke.pen, inner.stroke.pen
        ))
    });
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
