//! Reports of doubts about a drawing: each once, with the number of its lines and the option to type.

use std::cell::LazyCell;
use std::collections::{BTreeMap, BTreeSet};

use super::border::{LEAST_SINGLE_FILL, border, has_notches, has_one_main_part, has_wide_margins};
use super::doubts::{self, SHORTEST_NAMED, finding};
use super::frame;
use super::line::{Class, Line, SMALL_OUTLINE};
use super::marks::{EdgeLine, Lie};
use super::nest::middle;
use super::parts::Parts;
use super::passed;
use super::pens::Use;
use super::piece::owners;
use super::sheet::{self, Sheet};
use super::{signs, size, torn};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, ring};
use crate::ir::drawing::Ending;
use crate::ir::marker::Notch;
use crate::machine::Job;
use crate::machine::plot::{Frame, Inner, PenUse};
use crate::units::MM_PER_M;
use crate::units::number::fixed;

/// Shortest line that may be an outline which the end of the file has cut short, mm.
const SHORTEST_CUT_SHORT: f64 = 25.0;
/// Number of closed lines in a part at which it may be a frame.
const DOUBTFUL: usize = 2;
/// Least share of its box that the edge of a table or of the cloth encloses.
const LEAST_EDGE_FILL: f64 = 0.85;
/// Number of parts in a frame at which it is surely one.
const SURE_PARTS: usize = 4;
/// Most pens that a message names.
const SHOWN_PENS: usize = 8;

/// Reports all doubts, the worst first.
pub(super) fn all(sheet: &Sheet, job: &Job, out: &mut Diagnostics) {
    if sheet.nest.ended().is_some() {
        let message = "there are too many closed lines to tell which lies in which: inner lines would be cut as parts";
        let finding = Diagnostic::new(&code::DRAWING_TOO_MANY, message);
        out.push(finding.hint("split the plot, or leave out fills and hatchings"));
        return;
    }
    if sheet.is_cut_short {
        let message = "there are too many lines to find every notch, letter and seam line among them";
        let finding = Diagnostic::new(&code::DRAWING_SEARCH_ENDED, message);
        out.push(finding.hint("split the plot, or leave texts out"));
    }
    if let Some(finding) = cut_short(sheet, job) {
        out.push(finding);
        return;
    }
    if !job.lines.all
        && !sheet.encoded.is_empty()
        && let Some(finding) = torn::first(sheet)
    {
        out.push(finding);
        return;
    }
    if !job.lines.all
        && let Some(finding) = passed::outlines(sheet)
    {
        out.push(finding);
    }
    match frame_or_part(sheet, job) {
        Some(finding) => out.push(finding),
        None => size::say(sheet, out),
    }
    doubts::all(sheet, job, out);
    seams_of_knives(sheet, out);
    if !sheet.lines.iter().any(|line| line.is_cut) {
        out.push(nothing(sheet, job));
        return;
    }
    inner_lines(sheet, job, out);
    unsaid_holes(sheet, job, out);
    crosses(sheet, out);
    lines_outside(sheet, out);
    outside_frames(sheet, out);
    frames(sheet, job, out);
    drawn_again(sheet, out);
}

/// Lines that are drawn twice and cut once.
fn drawn_again(sheet: &Sheet, out: &mut Diagnostics) {
    let again: Vec<&Line> = sheet.lines.iter().filter(|line| line.class == Class::Again).collect();
    let Some(first) = again.first() else { return };
    let (are, each) = if again.len() == 1 { ("is", "it is") } else { ("are", "each is") };
    let message = format!("{} {are} drawn again: {each} taken once", counted(&again, "line"));
    let found = finding(&code::DRAWING_AGAIN, message, first, sheet);
    out.push(found.hint("look whether the file holds a plot twice; the copies are never cut"));
}

/// Number and total length of several lines, in words.
fn counted(lines: &[&Line], noun: &str) -> String {
    let total = lines.iter().fold(0.0, |sum, line| sum + line.length);
    let length =
        if total < MM_PER_M { format!("{} mm", fixed(total, 1)) } else { format!("{} m", fixed(total / MM_PER_M, 2)) };
    match lines.len() {
        1 => format!("one {noun} of {length}"),
        n => format!("{n} {noun}s of {length} in all"),
    }
}

/// Closed lines that stand on an outline.
fn standing(sheet: &Sheet) -> BTreeSet<usize> {
    sheet.from_edges.iter().filter(|edge| edge.lie == Lie::Stands).map(|edge| edge.line).collect()
}

/// Closed lines inside parts that are not cut: cut-outs, or parts in a frame that was not known for one.
fn inner_lines(sheet: &Sheet, job: &Job, out: &mut Diagnostics) {
    let mut by_part: BTreeMap<usize, Vec<&Line>> = BTreeMap::new();
    // Closed lines that stand on an outline have a warning of their own.
    let standing = standing(sheet);
    let has_one_main_part = has_one_main_part(sheet);
    let is_left = |line: &Line| !line.is_cut && !line.usage.is_drawn();
    let is_inner = |&i: &usize| {
        let line = &sheet.lines[i];
        let is_far_seam =
            || has_one_main_part && line.class == Class::Seam && (has_wide_margins(sheet, i) || has_notches(sheet, i));
        is_left(line) && (line.class == Class::Inner || is_far_seam())
    };
    for i in (0..sheet.lines.len()).filter(is_inner).filter(|i| !standing.contains(i)) {
        by_part.entry(sheet.nest.outermost(i).unwrap_or(i)).or_default().push(&sheet.lines[i]);
    }
    let may_be_frame = |part: usize, held: &[&Line]| {
        let part = &sheet.lines[part];
        let is_filled = held[0].area >= LEAST_SINGLE_FILL * part.area;
        let (width, height) = part.extent.size();
        // The edge of a table or of the cloth fills most of its box; a circle does not.
        let is_like_cloth = part.area >= LEAST_EDGE_FILL * width * height;
        is_like_cloth && held.len() >= DOUBTFUL || has_one_main_part && part.is_rectangle(sheet.band()) && is_filled
    };
    let (doubtful, others): (Vec<_>, Vec<_>) =
        by_part.iter().map(|(&part, held)| (part, &held[..])).partition(|(part, held)| may_be_frame(*part, held));
    // The worst one is an error instead.
    if let Some(&(part, held)) = doubtful.first().filter(|_| frame_or_part(sheet, job).is_none()) {
        let (width, height) = sheet.lines[part].extent.size();
        let others = match doubtful.len() {
            1 => String::new(),
            2 => "; so does another".to_owned(),
            n => format!("; so do {} others", n - 1),
        };
        let message = format!(
            "a part of {} x {} mm holds {} that {} not cut: it may be a frame or the edge of the table{others}",
            fixed(width, 1),
            fixed(height, 1),
            counted(held, "closed line"),
            if held.len() == 1 { "is" } else { "are" }
        );
        let found = finding(&code::DRAWING_MAY_BE_FRAME, message, &sheet.lines[part], sheet);
        let parts: Vec<usize> = doubtful.iter().map(|(part, _)| *part).collect();
        let found = found.about(doubts::numbers(&owners(sheet), &parts));
        out.push(found.hint("`--set hpgl.frame=outermost` if it is one; `--inner cut` cuts cut-outs"));
    }
    single_lines(&others, sheet, job, out);
}

/// Single closed lines inside parts, with the parts.
fn single_lines(others: &[(usize, &[&Line])], sheet: &Sheet, job: &Job, out: &mut Diagnostics) {
    let single: Vec<&Line> = others.iter().flat_map(|(_, held)| *held).copied().collect();
    if let Some(first) = single.first() {
        let lines = counted(&single, "closed line");
        let is_asked = job.lines.inner.unwrap_or(job.profile.hpgl.inner) == Inner::Cut;
        let (message, hint) = if is_asked {
            (
                format!("not cut, since it takes more than half of its part: {lines}"),
                "`--inner all` cuts every closed line",
            )
        } else {
            (
                format!("not cut, but maybe cut-outs: {lines} inside parts"),
                "`--inner cut` cuts cut-outs; `cutc info` and `-t svg` show what lines were taken for",
            )
        };
        let parts: Vec<usize> = others.iter().map(|(part, _)| *part).collect();
        let found = finding(&code::DRAWING_INNER_LINES, message, first, sheet);
        out.push(found.about(doubts::numbers(&owners(sheet), &parts)).hint(hint));
    }
}

/// Seam lines of a pen that is a knife, in outlines that are only drawn: neither is cut.
fn seams_of_knives(sheet: &Sheet, out: &mut Diagnostics) {
    let is_left = |&i: &usize| {
        let line = &sheet.lines[i];
        let is_drawn = |part: usize| sheet.lines[part].usage.is_drawn() && sheet.lines[part].is_closed;
        line.class == Class::Seam
            && line.usage.is_knife()
            && !line.is_cut
            && sheet.nest.outermost(i).is_some_and(is_drawn)
    };
    let left: Vec<&Line> = (0..sheet.lines.len()).filter(is_left).map(|i| &sheet.lines[i]).collect();
    let Some(first) = left.first() else { return };
    let lines = counted(&left, "seam line");
    let message = format!("not cut: {lines} of a knife's pen in outlines that are only drawn");
    let found = finding(&code::DRAWING_INNER_LINES, message, first, sheet);
    let found = found.hint("name the pen of the outlines in `--cut-pens` to cut the parts with their allowance");
    out.push(found.hint("`--inner all` cuts the seam lines: parts without allowance"));
}

/// Small circles that stand alone in parts, if the user has not set the size of holes.
fn unsaid_holes(sheet: &Sheet, job: &Job, out: &mut Diagnostics) {
    if job.profile.hpgl.drill_max_mm.is_some() {
        return;
    }
    let is_sign = |line: &Line| line.class == Class::Sign && !line.is_cut && line.usage != Use::Drawn;
    // Squares are boxes to fill in as often as holes.
    let is_circle = |line: &Line| sheet::is_square_or_circle(line) && !line.is_rectangle(sheet.unit);
    let mut holes = sheet.indices(|line| is_sign(line) && is_circle(line));
    holes.retain(|&i| sheet.part_around(i).is_some());
    if holes.is_empty() {
        return; // as in most plots
    }
    // Beside others it may be a letter; a cross with the same middle marks a hole.
    let boxes = Boxes::new(sheet.lines.iter().map(|line| line.extent).collect());
    let mut work = Budget::of_a_marker();
    holes.retain(|&i| {
        let around = sheet.lines[i].extent.grown(sheet.lines[i].size());
        let at = middle(&sheet.lines[i].extent);
        let is_small = |k: usize| {
            let other = &sheet.lines[k];
            let is_apart = (middle(&other.extent) - at).norm() > sheet.band();
            is_apart && !other.is_set_aside() && other.size() <= Notch::LONGEST
        };
        work.spend(boxes.cost_near(&around)) && !boxes.near(around).any(is_small)
    });
    let Some(&first) = holes.first() else { return };
    let size = holes.iter().map(|&i| sheet.lines[i].size()).fold(0.0, f64::max);
    let mm = fixed(size, 1);
    let circles = match holes.len() {
        1 => format!("one small circle of {mm} mm in a part"),
        n => format!("{n} small circles of up to {mm} mm in parts"),
    };
    let message = format!("not drilled: {circles}");
    let found = finding(&code::DRAWING_HOLES, message, &sheet.lines[first], sheet);
    out.push(
        found.hint(format!("if they are holes, `--set hpgl.drill_max_mm={}`", fixed((size - sheet.unit).ceil(), 0))),
    );
}

/// Crosses in parts, which mark holes as a rule; a circle around one has a finding of its own.
fn crosses(sheet: &Sheet, out: &mut Diagnostics) {
    let mut work = Budget::of_a_marker();
    let crosses = signs::crosses(sheet.search(&[]), &mut work);
    if crosses.is_empty() {
        return; // as in most plots
    }
    let closed = sheet.indices(|line| line.is_closed && !line.is_set_aside());
    let boxes = Boxes::new(closed.iter().map(|&i| sheet.lines[i].extent).collect());
    let mut is_alone = |at: Point| {
        let around = |k: usize| &sheet.lines[closed[k]];
        let is_part =
            |line: &Line| line.class == Class::Part && line.is_cut && ring::contains(&line.points(&sheet.vertices), at);
        work.spend(boxes.cost_at(at))
            && !boxes.at(at).any(|k| around(k).size() <= Notch::LONGEST)
            && boxes.at(at).any(|k| work.spend(around(k).as_drawn(&sheet.vertices).len()) && is_part(around(k)))
    };
    let found: Vec<&Line> =
        crosses.iter().filter(|cross| is_alone(cross.1)).map(|cross| &sheet.lines[cross.0]).collect();
    let Some(first) = found.first() else { return };
    let mm = fixed(found.iter().map(|line| line.length).fold(0.0, f64::max), 1);
    let crosses = match found.len() {
        1 => format!("one cross of {mm} mm in a part"),
        n => format!("{n} crosses of up to {mm} mm in parts"),
    };
    let finding = finding(&code::DRAWING_HOLES, format!("not drilled: {crosses}"), first, sheet);
    out.push(finding.hint("if they mark holes, let the CAD draw circles, and set `hpgl.drill_max_mm`"));
}

/// Small closed lines, and long open ones, that are in no part.
fn lines_outside(sheet: &Sheet, out: &mut Diagnostics) {
    let standing = standing(sheet);
    let is_small = |line: &Line| line.class == Class::SmallOutline && !line.is_cut && !line.usage.is_drawn();
    let small = sheet.indices(is_small).into_iter().filter(|i| !standing.contains(i));
    let small: Vec<&Line> = small.map(|i| &sheet.lines[i]).collect();
    if let Some(first) = small.first() {
        let message = format!("not cut: {} up to 25 mm large in no part", counted(&small, "closed line"));
        let found = finding(&code::DRAWING_SMALL_OUTLINES, message, first, sheet);
        out.push(found.hint("if they are parts, name their pen as a knife: `--cut-pens`"));
    }
    let open: Vec<&Line> = sheet.lines.iter().filter(|line| line.class == Class::OpenLine).collect();
    if let Some(first) = open.first() {
        let places = first.as_drawn(&sheet.vertices);
        let gap = (places[places.len() - 1].at - places[0].at).norm();
        let ends = match gap {
            0.0 => "closes, but crosses itself so that its halves cancel".to_owned(),
            gap => format!("ends {} mm from where it starts", fixed(gap, 1)),
        };
        let first_one = if open.len() == 1 { "it" } else { "the first one" };
        let message = format!("not cut: {} in no part", counted(&open, "open line"));
        let found = finding(&code::DRAWING_OPEN_OUTLINES, message, first, sheet);
        let found = found.hint(format!("{first_one} {ends}"));
        let how = doubts::how_to_close(gap).filter(|_| gap > 0.0);
        let found = found.hint(how.unwrap_or_else(|| "if they are outlines, let the CAD close them".to_owned()));
        out.push(found.hint("`--cut-all` cuts every line but a frame"));
    }
}

/// Long open lines in no part that are not cut.
pub(super) fn open_lines(sheet: &Sheet) -> Vec<usize> {
    // An outline with a gap around closed lines and a line on an outline are told by piece; an edge drawn once more is cut.
    let is_told = |edge: &&EdgeLine| match edge.lie {
        Lie::Along => true,
        Lie::Outside => sheet.lines[edge.outline].is_cut,
        Lie::Joins => [Some(edge.outline), edge.other].iter().flatten().any(|&outline| sheet.lines[outline].is_cut),
        Lie::Ends
        | Lie::Wide
        | Lie::Deep
        | Lie::Divides
        | Lie::Between
        | Lie::Stands
        | Lie::Crosses
        | Lie::Letters
        | Lie::Sign => false,
    };
    let told: BTreeSet<usize> = sheet.from_edges.iter().filter(is_told).map(|edge| edge.line).collect();
    let is_long = |line: &Line| {
        let is_open = matches!(line.class, Class::Other | Class::FromEdge);
        is_open && !line.is_cut && !line.usage.is_drawn() && line.length >= SHORTEST_NAMED
    };
    let parts = LazyCell::new(|| Parts::of(sheet));
    let is_open = |&i: &usize| !told.contains(&i) && is_long(&sheet.lines[i]) && !parts.hold(&sheet.lines[i]);
    (0..sheet.lines.len()).filter(is_open).collect()
}

/// Error about a rectangle that may be a frame or a part, if the user has not said whether the lines in it are cut.
fn frame_or_part(sheet: &Sheet, job: &Job) -> Option<Diagnostic> {
    if job.lines.inner.is_some() || job.lines.all {
        return None;
    }
    let lone = sheet.frame_doubt.is_none().then(|| border(sheet, job)).flatten();
    let line = &sheet.lines[sheet.frame_doubt.or(lone)?];
    let held = sheet.lines.iter().filter(|inner| inner.is_closed && !inner.is_cut && inner.size() > SMALL_OUTLINE);
    let held: Vec<&Line> = held.filter(|inner| line.extent.covers(&inner.extent)).collect();
    if !line.is_cut || lone.is_none() && held.len() < DOUBTFUL {
        return None;
    }
    let (width, height) = line.extent.size();
    let (width, height) = (fixed(width, 1), fixed(height, 1));
    let lines = if held.len() == 1 { "one closed line" } else { &format!("{} closed lines", held.len()) };
    let message = format!("frame or part: {width} x {height} mm around {lines}");
    let found = finding(&code::DRAWING_FRAME_OR_PART, message, line, sheet).on_cloth(line.extent.min);
    // The frame that was asked for is around it.
    let of_frame = match job.profile.hpgl.frame {
        Frame::Outermost => "if it is a frame in the frame, let the CAD draw one of them only",
        Frame::Auto | Frame::None => "if it is a frame, `--set hpgl.frame=outermost`: its parts are cut",
    };
    let of_part = "if it is a part, `--inner ignore`; `--inner cut` cuts its cut-outs, too";
    let has_pens = sheet.pens.iter().filter(|pen| pen.draws && !pen.is_layer).count() > 1;
    let of_pens = has_pens.then_some("if the parts have a pen of their own, name it: `--cut-pens`");
    let found = found.hint(of_frame).hint(of_part);
    Some(of_pens.into_iter().fold(found, Diagnostic::hint))
}

/// Closed lines outside the frames: the cloth is not there.
fn outside_frames(sheet: &Sheet, out: &mut Diagnostics) {
    let is_left = |&i: &usize| {
        let line = &sheet.lines[i];
        line.class == Class::Outside && !line.is_cut && !line.usage.is_drawn() && sheet.nest.parent(i).is_none()
    };
    let left: Vec<usize> = (0..sheet.lines.len()).filter(is_left).collect();
    let by_area = |a: &&usize, b: &&usize| sheet.lines[**a].area.total_cmp(&sheet.lines[**b].area).then(b.cmp(a));
    let Some(&largest) = left.iter().max_by(by_area) else { return };
    let line = &sheet.lines[largest];
    let ((width, height), at) = (line.extent.size(), line.extent.min);
    let (lines, it_is) = match left.len() {
        1 => ("one closed line".to_owned(), "it is"),
        n => (format!("{n} closed lines"), "the largest is"),
    };
    let message = format!(
        "not cut: {lines} outside the frame; {it_is} {} x {} mm at ({}, {})",
        fixed(width, 1),
        fixed(height, 1),
        fixed(at.x, 1),
        fixed(at.y, 1)
    );
    let found = finding(&code::DRAWING_OUTSIDE_FRAME, message, line, sheet).on_cloth(at);
    out.push(
        found.hint("if they are parts, name their pen as a knife: `--cut-pens`; `--cut-all` cuts all but a frame"),
    );
}

/// Frames that may be a part with cut-outs, or that a user who asks for every line may miss.
fn frames(sheet: &Sheet, job: &Job, out: &mut Diagnostics) {
    let parts = sheet.indices(|line| line.class == Class::Part).len();
    let count = frame::cloths(&sheet.lines, sheet.band()).len();
    if parts >= SURE_PARTS * count && !job.lines.all {
        return;
    }
    if let Some(frame) = sheet.lines.iter().rfind(|line| line.class == Class::Frame) {
        let (width, height) = frame.extent.size();
        let size = format!("{} x {} mm", fixed(width, 1), fixed(height, 1));
        let parts = format!("{parts} part{}", if parts == 1 { "" } else { "s" });
        let message = if count > 1 {
            format!("{count} rectangles, one of {size}, around {parts} are taken for frames: not cut")
        } else {
            format!("a rectangle of {size} around {parts} is taken for the frame: not cut")
        };
        let found = finding(&code::DRAWING_FRAME, message, frame, sheet);
        let hint = if job.lines.all { "to cut it too" } else { "if it is a part" };
        out.push(found.hint(format!("{hint}, `--set hpgl.frame=none`")));
    }
}

/// Refuses a file that is cut short: amid a number, or amid an outline where there are others. Inside a part that may be a
/// cut-out, if these are cut.
fn cut_short(sheet: &Sheet, job: &Job) -> Option<Diagnostic> {
    let (span, is_amid_number) = match sheet.ending {
        Ending::Proper => return None,
        Ending::PenDown(span) => (span, false),
        Ending::AmidNumber(span) => (span, true),
        Ending::AmidPair(span) => {
            let message = "the file ends amid a pair of coordinates";
            let found = Diagnostic::new(&code::DRAWING_CUT_SHORT, message).at(span);
            return Some(found.hint("it is cut short: export it again, or transfer it again"));
        }
    };
    let is_last = |line: &&Line| line.vertices(&sheet.vertices).iter().any(|vertex| vertex.span == span);
    // A line that returns to its start is whole, unless a curve does so whatever its last number was.
    let is_curve = |line: &Line| {
        let vertices = line.vertices(&sheet.vertices);
        is_amid_number && vertices.iter().filter(|vertex| vertex.span == span).count() > 1
    };
    // A line that another one draws as well is whole, too.
    let last = sheet
        .lines
        .iter()
        .filter(|line| line.class != Class::Again)
        .find(is_last)
        .filter(|line| !line.is_closed || is_curve(line))?;
    let has_parts = sheet.lines.iter().any(|line| line.class == Class::Part);
    let is_long = has_parts && last.class != Class::Notch && last.length > SHORTEST_CUT_SHORT;
    let cuts_inside = job.lines.inner.unwrap_or(job.profile.hpgl.inner) != Inner::Ignore;
    let is_inside = is_long && Parts::of(sheet).hold(last);
    let message = match (is_amid_number, is_long && (!is_inside || cuts_inside)) {
        (true, _) if last.is_closed => "the file ends amid a number, which the size of its last curve depends on",
        (true, _) => "the file ends amid a number, and the line that it draws does not close",
        (false, true) if is_inside => "the file ends amid a line that does not close, inside a part",
        (false, true) => "the file ends amid a line outside all parts that does not close",
        (false, false) => return None,
    };
    let found = Diagnostic::new(&code::DRAWING_CUT_SHORT, message).at(span);
    Some(found.hint("most likely it is cut short: export it again; if it is complete, put `PU;` at its end"))
}

/// Error that nothing is cut: the pens of the drawing, and the reason that left them out.
fn nothing(sheet: &Sheet, job: &Job) -> Diagnostic {
    if sheet.lines.is_empty() {
        let finding = Diagnostic::new(&code::DRAWING_NOTHING_TO_CUT, "the drawing has no line");
        return finding.hint("check that the export finished, and that it was not told to leave out the outlines");
    }
    let finding = Diagnostic::new(&code::DRAWING_NOTHING_TO_CUT, "no line is taken for something to cut");
    let held: Vec<&str> = sheet.pens.iter().filter(|pen| pen.draws).map(|pen| pen.name.as_str()).collect();
    let Some(&first) = held.first() else {
        return finding.hint("every line is drawn while no pen is taken (SP0); let the CAD take pen 1 for outlines");
    };
    let has_layers = sheet.pens.iter().any(|pen| pen.is_layer);
    let listed = held[..held.len().min(SHOWN_PENS)].join(",");
    let noun = if has_layers { "on layer" } else { "with pen" };
    let drawn = match held.len() {
        1 => format!("the file draws {noun} {first}"),
        n => format!("the file draws {noun}s {listed}{}", if n > SHOWN_PENS { " and others" } else { "" }),
    };
    let (option, unit) = if has_layers { ("layers", "") } else { ("cut-pens", " (`--set hpgl.unit=1`)") };
    let is_out = |line: &Line| matches!(line.usage, Use::Drawn | Use::Marks | Use::Ignore);
    if has_layers && sheet.lines.iter().all(is_out) {
        let hint = format!("names of layers, `--layers` or `drawing.layers` leave all lines out: {drawn}");
        return finding.hint(hint).hint("`--layers NAME` makes a layer the knife");
    }
    let is_wanted =
        |name: &&str| name.parse().is_ok_and(|number| job.lines.pens.as_ref().is_none_or(|p| p.has(number)));
    if let Some(only) = job.lines.pens.as_ref().filter(|_| !held.iter().any(is_wanted)) {
        return finding.hint(format!("`--cut-pens {only}` leaves all lines out: {drawn}"));
    }
    let is_left_out = |name: &&str| matches!(job.profile.hpgl.pen(name), Some(PenUse::Pen | PenUse::Ignore));
    if held.iter().all(is_left_out) {
        let hint = format!("`hpgl.pens` of the profile leaves them out; {drawn}; `--set hpgl.pens.{first}=knife`");
        return finding.hint(hint);
    }
    let mut extent = Extent::EMPTY;
    sheet.lines.iter().for_each(|line| extent.join(&line.extent));
    let (width, height) = extent.size();
    let is_small = sheet.lines.iter().any(|line| line.class == Class::SmallOutline);
    if is_small || width.max(height) <= SMALL_OUTLINE {
        let large = format!("all of it is {} x {} mm", fixed(width, 1), fixed(height, 1));
        return finding.hint(if is_small {
            format!("{large}: a wrong unit{unit}? `--{option} {listed}` cuts small parts")
        } else {
            format!("{large}: a wrong unit{unit}, or decimal commas?")
        });
    }
    let (why, place) = unclosed(sheet);
    let finding = finding.hint(format!("{drawn}, {why}")).hint("`--cut-all` cuts every line but a frame");
    match place {
        Some(line) => finding.at(line.span(&sheet.vertices)),
        None => finding,
    }
}

/// Reason that no line of a sheet is a part, and the line that shows it.
fn unclosed(sheet: &Sheet) -> (String, Option<&Line>) {
    let ends = |line: &Line| {
        let places = line.as_drawn(&sheet.vertices);
        (places[places.len() - 1].at - places[0].at).norm()
    };
    let open = sheet.lines.iter().filter(|line| !line.is_closed && !line.is_set_aside());
    let longest = open.max_by(|a, b| a.length.total_cmp(&b.length));
    match longest {
        _ if sheet.remains.iter().any(|remains| remains.is_sure) => {
            ("its closed lines lie in outlines that are open".to_owned(), None)
        }
        _ if sheet.lines.iter().any(|line| line.is_closed) => ("no closed line is a part".to_owned(), None),
        None => ("no line closes".to_owned(), None),
        Some(line) => match ends(line) {
            0.0 => ("its lines come back but enclose nothing".to_owned(), Some(line)),
            gap => (format!("no line closes: the longest ends {} mm from its start", fixed(gap, 1)), Some(line)),
        },
    }
}
