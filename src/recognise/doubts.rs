//! Doubts about parts, by the numbers of their pieces: outlines that were closed or stay open, parts without a seam line, and
//! lines that begin on an outline and are not cut.

use std::collections::BTreeMap;

use super::line::{Class, Closing, Line, SIGN};
use super::marks::EdgeLine;
use super::pens::Use;
use super::piece::owners;
use super::sheet::Sheet;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, code, pieces};
use crate::machine::CLOSE_MOST_MM;
use crate::units::number::fixed;

/// Parts with a seam line for each part without one, at least, and in all: fewer say nothing about the others.
const MANY: usize = 3;
/// Decimals of lengths, mm.
const DECIMALS: u32 = 1;

/// Tells every doubt about parts.
pub(super) fn all(sheet: &Sheet, out: &mut Diagnostics) {
    let owners = owners(sheet);
    open_parts(sheet, out);
    without_seam(sheet, &owners, out);
    closed(sheet, &owners, out);
    from_edges(sheet, &owners, out);
}

/// A finding about a line.
pub(super) fn finding(code: &'static Code, message: String, first: &Line, sheet: &Sheet) -> Diagnostic {
    Diagnostic::new(code, message).at(first.span(&sheet.vertices))
}

/// The numbers of the pieces of some lines.
fn numbers(owners: &[usize], lines: &[usize]) -> Vec<u32> {
    let number = |line: &usize| owners.binary_search(line).ok().map(|k| k as u32 + 1);
    let mut numbers: Vec<u32> = lines.iter().filter_map(number).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// Outlines with a gap around closed lines, each with how many of those it holds.
pub(super) fn open_outlines(sheet: &Sheet) -> BTreeMap<usize, usize> {
    let is_held = |line: &Line| line.is_closed && line.size() >= SIGN && line.class != Class::Ignored;
    let outer = |i: usize| sheet.nest.outermost(i).filter(|&outer| outer != i);
    let holders = sheet.indices(is_held).into_iter().filter_map(outer);
    let mut held = BTreeMap::new();
    for outline in holders.chain(sheet.remains.iter().map(|[outline, _]| *outline)) {
        *held.entry(outline).or_insert(0) += 1;
    }
    let is_left = |line: &Line| !line.is_closed && !line.is_cut && line.usage != Use::Drawn;
    held.retain(|&i, _| is_left(&sheet.lines[i]) && sheet.lines[i].class != Class::Frame);
    held
}

/// Says how many outlines have a gap around closed lines.
fn open_parts(sheet: &Sheet, out: &mut Diagnostics) {
    let open = open_outlines(sheet);
    let Some((&first, _)) = open.first_key_value() else { return };
    let gap = |&i: &usize| {
        let drawn = sheet.lines[i].as_drawn(&sheet.vertices);
        (drawn[drawn.len() - 1].at - drawn[0].at).norm()
    };
    let lines: usize = open.values().sum();
    let widest = fixed(open.keys().map(gap).fold(0.0, f64::max), DECIMALS);
    let (outlines, around) = match open.len() {
        1 => (format!("an outline has a gap of {widest} mm"), "in it"),
        n => (format!("{n} outlines have gaps of up to {widest} mm"), "in them"),
    };
    let lines = if lines == 1 { "is the closed line".to_owned() } else { format!("are the {lines} closed lines") };
    let message = format!("{outlines}: not cut, and neither {lines} {around}");
    let found = finding(&code::DRAWING_OPEN_PART, message, &sheet.lines[first], sheet);
    let may_close = open.keys().all(|i| gap(i) <= CLOSE_MOST_MM);
    out.push(found.hint(if may_close {
        format!("let the CAD close it, or close gaps of that width: `--set drawing.close_mm={widest}`")
    } else {
        "let the CAD close it; if it is the edge of the cloth, leave its pen out (`--cut-pens`)".to_owned()
    }));
}

/// Parts without a seam line where many have one.
fn without_seam(sheet: &Sheet, owners: &[usize], out: &mut Diagnostics) {
    let mut has_seam = vec![false; sheet.lines.len()];
    for i in sheet.indices(|line| line.class == Class::Seam) {
        if let Some(part) = sheet.nest.outermost(i) {
            has_seam[part] = true;
        }
    }
    let parts = sheet.indices(|line| line.class == Class::Part && line.is_cut);
    let (with, without): (Vec<usize>, Vec<usize>) = parts.into_iter().partition(|&part| has_seam[part]);
    if let Some(&first) = without.first().filter(|_| with.len() >= MANY * without.len().max(1)) {
        let (parts, verb) = match without.len() {
            1 => ("a part".to_owned(), "has"),
            n => (format!("{n} parts"), "have"),
        };
        let numbers = numbers(owners, &without);
        let message =
            format!("{parts} {verb} no seam line, {}, while {} parts have one", pieces::listed(&numbers), with.len());
        let found = finding(&code::DRAWING_NO_SEAM, message, &sheet.lines[first], sheet);
        out.push(
            found.about(numbers).hint(
                "if the outline is missing in the file, this is the seam line: leave the piece out with `--skip`",
            ),
        );
    }
}

/// Outlines that were closed, and other lines that are cut.
fn closed(sheet: &Sheet, owners: &[usize], out: &mut Diagnostics) {
    for is_edge in [false, true] {
        let length = |i: usize| match sheet.lines[i].closing {
            Closing::Gap(mm) | Closing::Bridged(mm) if !is_edge => Some(mm),
            Closing::Edge(mm) if is_edge => Some(mm),
            Closing::Gap(_)
            | Closing::Bridged(_)
            | Closing::Edge(_)
            | Closing::Drawn
            | Closing::Retraced
            | Closing::Open(_) => None,
        };
        let closed = sheet.indices(|line| line.is_cut && line.is_closed);
        let closed: Vec<usize> = closed.into_iter().filter(|&i| length(i).is_some()).collect();
        let Some(&first) = closed.first() else { continue };
        let longest = fixed(closed.iter().filter_map(|&i| length(i)).fold(0.0, f64::max), DECIMALS);
        let are_outlines = closed.iter().all(|i| owners.binary_search(i).is_ok());
        let [one, several] = if are_outlines { ["an outline", "outlines"] } else { ["a line", "lines"] };
        let (outlines, stop) = match closed.len() {
            1 => (one.to_owned(), "stops"),
            n => (format!("{n} {several}"), "stop"),
        };
        let parts: Vec<usize> = closed.iter().map(|&i| sheet.part_around(i).unwrap_or(i)).collect();
        let numbers = numbers(owners, &parts);
        let of = pieces::listed(&numbers);
        let message = if is_edge {
            format!("{outlines} {stop} at the edge of the frame, {of}: closed along it, by up to {longest} mm")
        } else {
            format!("{outlines} {stop} before the start, {of}: closed straight, by up to {longest} mm")
        };
        let found = finding(&code::DRAWING_CLOSED, message, &sheet.lines[first], sheet);
        out.push(
            found
                .about(numbers)
                .hint("look at them in the picture (`-t svg`); `--set drawing.close_mm=0` leaves them open"),
        );
    }
}

/// Lines that begin on the outline of a part and are not cut.
fn from_edges(sheet: &Sheet, owners: &[usize], out: &mut Diagnostics) {
    let is_left = |edge: &&EdgeLine| {
        let Line { is_cut, usage, .. } = sheet.lines[edge.line];
        !is_cut && usage != Use::Drawn && sheet.lines[edge.outline].is_cut
    };
    let (dividing, others): (Vec<&EdgeLine>, Vec<&EdgeLine>) =
        sheet.from_edges.iter().filter(is_left).partition(|edge| edge.divides);
    for (edges, code, does, hint) in [
        (
            dividing,
            &code::DRAWING_DIVIDED_PART,
            ["goes from edge to edge", "go from edge to edge"],
            "if it divides a part in two, let the CAD draw both parts; `--cut-all` cuts every line",
        ),
        (
            others,
            &code::DRAWING_LINE_FROM_EDGE,
            ["ends at the outline", "end at the outline"],
            "notches lead 1 to 15 mm inwards from within 0.5 mm of the edge; `--cut-all` cuts every line",
        ),
    ] {
        let Some(first) = edges.first() else { continue };
        let (begin, longest) = match edges.len() {
            1 => (format!("one open line {}", does[0]), "it is"),
            n => (format!("{n} open lines {}", does[1]), "the longest is"),
        };
        let length = fixed(edges.iter().map(|edge| sheet.lines[edge.line].length).fold(0.0, f64::max), DECIMALS);
        let parts: Vec<usize> = edges.iter().map(|edge| edge.outline).collect();
        let numbers = numbers(owners, &parts);
        let message = format!("not cut: {begin} of {}; {longest} {length} mm long", pieces::listed(&numbers));
        out.push(finding(code, message, &sheet.lines[first.line], sheet).about(numbers).hint(hint));
    }
}
