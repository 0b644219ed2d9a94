//! Doubts about parts, by the numbers of their pieces: outlines that were closed or stay open, parts without a seam line, and
//! lines that begin on an outline and are not cut.

use super::line::{Class, Closing, Line, SIGN};
use super::pens::Use;
use super::piece::owners;
use super::sheet::Sheet;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, code};
use crate::machine::CLOSE_MOST_MM;
use crate::units::number::fixed;

/// Pieces that a message names.
const SHOWN: usize = 8;
/// Parts with a seam line for each part without one, at least, and in all: fewer say nothing about the others.
const MANY: usize = 3;
/// Decimals of lengths, mm.
const DECIMALS: u32 = 1;

/// Says all of them.
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

/// Pieces in a few words: their numbers, or how many there are.
fn words(numbers: &[u32]) -> String {
    let shown: Vec<String> = numbers.iter().take(SHOWN).map(u32::to_string).collect();
    let noun = if numbers.len() == 1 { "piece" } else { "pieces" };
    match numbers.len().saturating_sub(SHOWN) {
        0 => format!("{noun} {}", shown.join(", ")),
        more => format!("{noun} {} and {more} more", shown.join(", ")),
    }
}

/// Outlines with a gap around closed lines.
fn open_parts(sheet: &Sheet, out: &mut Diagnostics) {
    let is_held = |line: &Line| line.is_closed && line.size() >= SIGN && line.class != Class::Ignored;
    let mut held = vec![0_usize; sheet.lines.len()];
    for i in sheet.indices(is_held) {
        if let Some(outer) = sheet.nest.outermost(i).filter(|&outer| outer != i) {
            held[outer] += 1;
        }
    }
    let gap = |i: usize| if let Closing::Open(gap) = sheet.lines[i].closing { gap } else { 0.0 };
    let open =
        sheet.indices(|line| matches!(line.closing, Closing::Open(_)) && !line.is_cut && line.usage != Use::Drawn);
    let open: Vec<usize> = open.into_iter().filter(|&i| held[i] > 0 && sheet.lines[i].class != Class::Frame).collect();
    let Some(&first) = open.first() else { return };
    let lines: usize = open.iter().map(|&i| held[i]).sum();
    let widest = fixed(open.iter().map(|&i| gap(i)).fold(0.0, f64::max), DECIMALS);
    let (outlines, around) = match open.len() {
        1 => (format!("an outline has a gap of {widest} mm"), "in it"),
        n => (format!("{n} outlines have gaps of up to {widest} mm"), "in them"),
    };
    let lines = if lines == 1 { "one closed line".to_owned() } else { format!("{lines} closed lines") };
    let message = format!("{outlines}: not cut, and neither is any of {lines} {around}");
    let found = finding(&code::DRAWING_OPEN_PART, message, &sheet.lines[first], sheet);
    let may_close = open.iter().all(|&i| gap(i) <= CLOSE_MOST_MM);
    out.push(found.hint(if may_close {
        format!("let the CAD close it, or close gaps of that width: `--set drawing.close_mm={widest}`")
    } else {
        "let the CAD close it: the gap is wider than `drawing.close_mm` may be".to_owned()
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
        let message = format!("{parts} {verb} no seam line, {}, while {} parts have one", words(&numbers), with.len());
        let found = finding(&code::DRAWING_NO_SEAM, message, &sheet.lines[first], sheet);
        out.push(
            found.about(numbers).hint(
                "if the outline is missing in the file, this is the seam line: leave the piece out with `--skip`",
            ),
        );
    }
}

/// Outlines that were closed.
fn closed(sheet: &Sheet, owners: &[usize], out: &mut Diagnostics) {
    for is_edge in [false, true] {
        let length = |i: usize| match sheet.lines[i].closing {
            Closing::Gap(mm) if !is_edge => Some(mm),
            Closing::Edge(mm) if is_edge => Some(mm),
            Closing::Gap(_) | Closing::Edge(_) | Closing::Drawn | Closing::Retraced | Closing::Open(_) => None,
        };
        let closed: Vec<usize> =
            owners.iter().copied().filter(|&i| sheet.lines[i].is_cut && length(i).is_some()).collect();
        let Some(&first) = closed.first() else { continue };
        let longest = fixed(closed.iter().filter_map(|&i| length(i)).fold(0.0, f64::max), DECIMALS);
        let (outlines, stop) = match closed.len() {
            1 => ("an outline".to_owned(), "stops"),
            n => (format!("{n} outlines"), "stop"),
        };
        let numbers = numbers(owners, &closed);
        let pieces = words(&numbers);
        let message = if is_edge {
            format!("{outlines} {stop} at the edge of the frame, {pieces}: closed along it, by up to {longest} mm")
        } else {
            format!("{outlines} {stop} before the start, {pieces}: closed straight, by up to {longest} mm")
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
    let is_left = |&&(line, part): &&(usize, usize)| {
        let Line { is_cut, usage, .. } = sheet.lines[line];
        !is_cut && usage != Use::Drawn && sheet.lines[part].is_cut
    };
    let (lines, parts): (Vec<usize>, Vec<usize>) = sheet.from_edges.iter().filter(is_left).copied().unzip();
    let Some(&first) = lines.first() else { return };
    let (begin, longest) = match lines.len() {
        1 => ("one open line ends".to_owned(), "it is"),
        n => (format!("{n} open lines end"), "the longest is"),
    };
    let length = fixed(lines.iter().map(|&i| sheet.lines[i].length).fold(0.0, f64::max), DECIMALS);
    let numbers = numbers(owners, &parts);
    let pieces = words(&numbers);
    let message = format!("not cut: {begin} at the outline of {pieces}; {longest} {length} mm long");
    let found = finding(&code::DRAWING_LINE_FROM_EDGE, message, &sheet.lines[first], sheet);
    out.push(
        found
            .about(numbers)
            .hint("notches lead 1 to 15 mm inwards from within 0.5 mm of the edge; `--cut-all` cuts every line"),
    );
}
