//! Borders around one part: rectangles that are drawn like the outline of a part with a cut-out or a seam line.
//!
//! The line in a border is a part if something on it or in it is for a part: a seam line, a notch from its edge inwards, or a
//! long open line such as a grain line. A cut-out is waste, and has none of these. Lines in a corner of a plot's rectangle that is
//! empty elsewhere may be parts as well: parts are laid from a corner of the cloth, and a cut-out so near to two edges would leave
//! a strip. Without such a sign the rectangle is a part, with a warning.

use super::doubts::SHORTEST_NAMED;
use super::frame;
use super::line::{Class, Line, SHORTEST_NOTCH};
use super::sheet::Sheet;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, polyline, ring};
use crate::ir::marker::Notch;
use crate::machine::Job;
use crate::machine::plot::Frame;

/// Least share of the rectangle around it that a single part in a frame fills: a pocket or a loop fills less.
pub(super) const LEAST_SINGLE_FILL: f64 = 0.15;
/// Usual allowance of a seam at the most, mm; hems are wider.
const WIDEST_SEAM: f64 = 15.0;
/// Farthest that two even margins differ, mm.
const EVEN: f64 = 1.0;
/// Greatest distance of laid parts from the two nearest sides of the cloth, mm.
const CORNER: f64 = 30.0;
/// Least ratio of the empty margin of a frame to the margin on the opposite side.
const EMPTIER: f64 = 2.0;
/// Least number of margins out of four that are wide or of a width of their own if the outline may be a frame.
const ODD_MARGINS: usize = 3;

/// True if one part takes nearly all the area, beside test squares and titles: it may be the edge of the cloth.
pub(super) fn has_one_main_part(sheet: &Sheet) -> bool {
    let areas = sheet.lines.iter().filter(|line| line.class == Class::Part).map(|line| line.area);
    let (all, largest) = areas.fold((0.0, 0.0), |(all, largest): (f64, f64), area| (all + area, largest.max(area)));
    all - largest <= frame::MOST_OUTSIDE * largest
}

/// True if a short stroke begins on a line inside a rectangle without notches: that line may be the part.
pub(super) fn has_notches(sheet: &Sheet, inner: usize) -> bool {
    has_strokes(sheet, inner, |_, _| true)
}

/// True if a short stroke begins on a line inside a rectangle without notches, and leads into that line. Notches of a cut-out
/// lead out of it.
fn has_notches_inwards(sheet: &Sheet, inner: usize) -> bool {
    let leads_inwards = |line: &Line, points: &[Point]| {
        let ends = line.as_drawn(&sheet.vertices);
        let middle = ends[0].at + (ends[ends.len() - 1].at - ends[0].at) / 2.0;
        // The strokes of a V or a castle end on the edge, and their other vertices lie inside.
        let places = ends[1..ends.len() - 1].iter().map(|vertex| vertex.at).chain(std::iter::once(middle));
        let well = |at: &Point| polyline::distance(*at, points) > sheet.band();
        let mut places = places.filter(well).peekable();
        places.peek().is_some() && places.all(|at| ring::contains(points, at))
    };
    has_strokes(sheet, inner, leads_inwards)
}

/// True if a part has notches that are strokes.
fn is_marked(sheet: &Sheet, part: usize) -> bool {
    sheet.marks.iter().any(|mark| mark.outline == part) || sheet.strokes.iter().any(|one| one.outline == part)
}

/// True if a short stroke that satisfies a condition begins on a line inside a rectangle without notches.
fn has_strokes(sheet: &Sheet, inner: usize, is: impl Fn(&Line, &[Point]) -> bool) -> bool {
    let is_bare = |part: usize| sheet.lines[part].is_rectangle(sheet.band()) && !is_marked(sheet, part);
    if !sheet.nest.outermost(inner).is_some_and(is_bare) {
        return false;
    }
    let points = sheet.lines[inner].points(&sheet.vertices);
    let is_short = |line: &&Line| {
        let is_open = !line.is_closed && line.is_open_question();
        is_open && (SHORTEST_NOTCH..=Notch::LONGEST).contains(&line.length)
    };
    let mut work = Budget::of_a_marker();
    let is_on = |line: &Line| {
        let ends = line.as_drawn(&sheet.vertices);
        let distance = |at: Point| polyline::distance(at, &points);
        work.spend(points.len()) && [0, ends.len() - 1].iter().any(|&end| distance(ends[end].at) <= Notch::MISS)
    };
    sheet.lines.iter().filter(is_short).filter(|line| is(line, &points)).any(is_on)
}

/// True if the outline of a seam line is a rectangle that may be a frame around a part: most of its sides are farther off than
/// seams are wide, or at distances of their own.
pub(super) fn has_wide_margins(sheet: &Sheet, seam: usize) -> bool {
    let inner = sheet.lines[seam].extent;
    sheet.nest.outermost(seam).is_some_and(|part| {
        let outer = sheet.lines[part].extent;
        let (low, high) = (inner.min - outer.min, outer.max - inner.max);
        let margins = [low.x, low.y, high.x, high.y];
        let is_equal = |one: f64| margins.iter().filter(|other| (**other - one).abs() <= EVEN).count() > 1;
        let odd = margins.iter().filter(|&&margin| margin > WIDEST_SEAM || !is_equal(margin)).count();
        odd >= ODD_MARGINS && sheet.lines[part].is_rectangle(sheet.band())
    })
}

/// The largest rectangle that is taken for a part around a line that has a sign of a part.
pub(super) fn border(sheet: &Sheet, job: &Job) -> Option<usize> {
    if job.profile.hpgl.frame != Frame::Auto || !has_one_main_part(sheet) {
        return None;
    }
    let around = |i: usize| {
        let part = sheet.nest.parent(i).filter(|_| matches!(sheet.lines[i].class, Class::Inner | Class::Seam))?;
        let (part_line, inner) = (&sheet.lines[part], &sheet.lines[i]);
        let is_border = part_line.class == Class::Part
            && part_line.is_rectangle(sheet.band())
            && inner.area >= LEAST_SINGLE_FILL * part_line.area;
        let may_be = is_border && !inner.is_cut && !inner.usage.is_drawn();
        (may_be && is_of_a_part(sheet, i)).then_some(part)
    };
    let by_area = |a: &usize, b: &usize| sheet.lines[*a].area.total_cmp(&sheet.lines[*b].area).then(b.cmp(a));
    let marked = (0..sheet.lines.len()).filter_map(around).max_by(by_area);
    marked.or_else(|| largest_part(sheet).filter(|&part| holds_a_lay(sheet, part)))
}

/// The part with the largest area.
fn largest_part(sheet: &Sheet) -> Option<usize> {
    let parts = (0..sheet.lines.len()).filter(|&i| sheet.lines[i].class == Class::Part);
    parts.max_by(|&a, &b| sheet.lines[a].area.total_cmp(&sheet.lines[b].area).then(b.cmp(&a)))
}

/// True if the closed lines in a rectangle of a plot without notches lie in a corner of it, and it is empty elsewhere.
fn holds_a_lay(sheet: &Sheet, part: usize) -> bool {
    let outer = &sheet.lines[part];
    let is_plot = !sheet.pens.iter().any(|pen| pen.is_layer);
    if !is_plot || !outer.is_rectangle(sheet.band()) || is_marked(sheet, part) {
        return false;
    }
    let mut held = Extent::EMPTY;
    let is_held = |i: &usize| sheet.lines[*i].class == Class::Inner && sheet.nest.outermost(*i) == Some(part);
    let is_left = |line: &&Line| !line.is_cut && !line.usage.is_drawn();
    let inner = (0..sheet.lines.len()).filter(is_held).map(|i| &sheet.lines[i]).filter(is_left);
    let largest = inner.fold(0.0, |largest: f64, line| {
        held.join(&line.extent);
        largest.max(line.size())
    });
    if largest < SHORTEST_NAMED {
        return false;
    }
    let (low, high) = (held.min - outer.extent.min, outer.extent.max - held.max);
    let margins = [[low.x, high.x], [low.y, high.y]].map(|[a, b]| (a.min(b), a.max(b)));
    margins.iter().all(|&(near, _)| near <= CORNER)
        && margins.iter().any(|&(near, far)| far > EMPTIER * near.max(0.0) + EVEN)
}

/// True if a line in a rectangle has a sign of a part.
fn is_of_a_part(sheet: &Sheet, line: usize) -> bool {
    match sheet.lines[line].class {
        Class::Inner => {
            let is_seam = |i: usize| sheet.lines[i].class == Class::Seam && sheet.nest.parent(i) == Some(line);
            (0..sheet.lines.len()).any(is_seam) || has_notches_inwards(sheet, line) || holds_long_line(sheet, line)
        }
        // A seam line has the grain line of its part in it, and notches may begin on it where the allowance is even.
        _ => has_wide_margins(sheet, line) && has_notches_inwards(sheet, line),
    }
}

/// True if a long open line, such as a grain line, lies in a closed line whose part has no notches.
fn holds_long_line(sheet: &Sheet, outer: usize) -> bool {
    if sheet.nest.parent(outer).is_some_and(|part| is_marked(sheet, part)) {
        return false;
    }
    let extent = sheet.lines[outer].extent;
    let is_long = |line: &&Line| {
        !line.is_closed && line.is_open_question() && line.length >= SHORTEST_NAMED && extent.covers(&line.extent)
    };
    let mut long = sheet.lines.iter().filter(is_long).peekable();
    if long.peek().is_none() {
        return false;
    }
    let points = sheet.lines[outer].points(&sheet.vertices);
    let mut work = Budget::of_a_marker();
    let is_in = |line: &Line| {
        let mut places = line.as_drawn(&sheet.vertices).iter();
        places.all(|vertex| work.spend(points.len()) && ring::contains(&points, vertex.at))
    };
    long.any(is_in)
}
