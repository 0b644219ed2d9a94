//! Doubts about parts, with the numbers of their pieces: outlines that were closed or stay open, parts without a seam line, and
//! uncut lines that begin on an outline.

use std::collections::{BTreeMap, BTreeSet};

use super::line::{Class, Closing, Line, SIGN};
use super::marks::{EdgeLine, Lie};
use super::pens::Use;
use super::piece::owners;
use super::remains::Remains;
use super::sheet::{Sheet, are_many};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, code, pieces};
use crate::geom::Point;
use crate::machine::{Beside, CLOSE_MOST_MM, Job};
use crate::units::number::fixed;

/// Shortest open line outside of parts that is reported, mm: marks and letters are shorter.
pub(super) const SHORTEST_NAMED: f64 = 100.0;
/// Decimals of lengths, mm.
const DECIMALS: u32 = 1;
/// Step in which `drawing.close_mm` is suggested, mm, and the rounding of a gap that is a multiple of it, in steps.
const CLOSE_STEP: f64 = 0.1;
const CLOSE_EPSILON: f64 = 1e-6;

/// Reports every doubt about parts.
pub(super) fn all(sheet: &Sheet, job: &Job, out: &mut Diagnostics) {
    let owners = owners(sheet);
    open_parts(sheet, out);
    maybe_seams(sheet, &owners, job, out);
    without_seam(sheet, &owners, out);
    closed(sheet, &owners, out);
    from_edges(sheet, &owners, job, out);
}

/// A finding about a line.
pub(super) fn finding(code: &'static Code, message: String, first: &Line, sheet: &Sheet) -> Diagnostic {
    Diagnostic::new(code, message).at(first.span(&sheet.vertices))
}

/// The numbers of the pieces of some lines.
pub(super) fn numbers(owners: &[usize], lines: &[usize]) -> Vec<u32> {
    let number = |line: &usize| owners.binary_search(line).ok().map(|k| k as u32 + 1);
    let mut numbers: Vec<u32> = lines.iter().filter_map(number).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// Outlines with a gap around closed lines, each with the number of these.
fn open_outlines(sheet: &Sheet) -> BTreeMap<usize, usize> {
    let is_held = |line: &Line| line.is_closed && line.size() >= SIGN && !line.is_set_aside();
    // An outline that is only drawn matters where a pen that is a knife draws the line in it.
    let is_told = |outer: usize, inner: usize| {
        let [outer, inner] = [outer, inner].map(|i| &sheet.lines[i]);
        let is_lost = inner.usage.is_knife() && !inner.is_cut;
        (!outer.usage.is_drawn() || is_lost) && outer.class != Class::Frame
    };
    let outer = |i: usize| sheet.nest.outermost(i).filter(|&outer| outer != i && is_told(outer, i));
    let holders = sheet.indices(is_held).into_iter().filter_map(outer);
    // A part is missing if it was taken for a seam line, whatever the pen of the line around it.
    let single = |remains: &&Remains| remains.is_sure && remains.lines.len() == 1;
    let remains = sheet.remains.iter().filter(single).map(|remains| remains.lines[0]);
    let mut held = BTreeMap::new();
    for outline in holders.chain(remains) {
        *held.entry(outline).or_insert(0) += 1;
    }
    held.retain(|&i, _| !sheet.lines[i].is_closed && !sheet.lines[i].is_cut);
    held
}

/// Outlines of several strokes that are incomplete.
fn broken_outlines(sheet: &Sheet) -> impl Iterator<Item = &Remains> {
    let is_left = |remains: &&Remains| remains.is_sure && remains.lines.len() > 1 && !sheet.lines[remains.inner].is_cut;
    sheet.remains.iter().filter(is_left)
}

/// Open lines around closed lines: single outlines with a gap, and strokes of broken outlines.
pub(super) fn doubtful_outlines(sheet: &Sheet) -> [BTreeSet<usize>; 2] {
    let broken = broken_outlines(sheet).flat_map(|remains| remains.lines.iter().copied());
    [open_outlines(sheet).into_keys().collect(), broken.collect()]
}

/// Reports outlines with a gap around closed lines, and incomplete outlines of several strokes.
fn open_parts(sheet: &Sheet, out: &mut Diagnostics) {
    let broken: Vec<&Remains> = broken_outlines(sheet).collect();
    if let Some(first) = broken.first() {
        let message = match broken.len() {
            1 => format!(
                "an outline in {} strokes does not close: not cut, and neither is the closed line in it",
                first.lines.len()
            ),
            n => format!("{n} outlines in strokes do not close: not cut, and neither are the {n} closed lines in them"),
        };
        let found = finding(&code::DRAWING_OPEN_PART, message, &sheet.lines[first.lines[0]], sheet);
        out.push(found.hint(
            "let the CAD draw each outline as one closed line; if they are none, `--cut-pens` leaves their pen out",
        ));
    }
    let open = open_outlines(sheet);
    let Some((&first, _)) = open.first_key_value() else { return };
    let lines: usize = open.values().sum();
    let widest = open.keys().map(|&i| gap(i, sheet)).fold(0.0, f64::max);
    let shown = fixed(widest, DECIMALS);
    let (outlines, around) = match open.len() {
        1 => (format!("an outline has a gap of {shown} mm"), "in it"),
        n => (format!("{n} outlines have gaps of up to {shown} mm"), "in them"),
    };
    let lines = if lines == 1 { "is the closed line".to_owned() } else { format!("are the {lines} closed lines") };
    let message = format!("{outlines}: not cut, and neither {lines} {around}");
    let found = finding(&code::DRAWING_OPEN_PART, message, &sheet.lines[first], sheet);
    let beyond = || "let the CAD close it; if it is the edge of the cloth, leave its pen out (`--cut-pens`)".to_owned();
    out.push(found.hint(how_to_close(widest).unwrap_or_else(beyond)));
}

/// Hint with the key that closes a gap, mm; `None` for one that no key closes.
pub(super) fn how_to_close(gap: f64) -> Option<String> {
    // Rounded up: the gap itself must be within it.
    let close = (gap / CLOSE_STEP - CLOSE_EPSILON).ceil() * CLOSE_STEP;
    let close = Some(close).filter(|close| *close <= CLOSE_MOST_MM)?;
    let close = fixed(close, DECIMALS);
    Some(format!("let the CAD close it, or close gaps of that width: `--set drawing.close_mm={close}`"))
}

/// Parts with open lines beside or all around them: each may be the seam line of an incomplete outline, or another line in it.
/// Nothing is cut until the user says what those lines are, or leaves the parts out.
fn maybe_seams(sheet: &Sheet, owners: &[usize], job: &Job, out: &mut Diagnostics) {
    let is_left = |&line: &usize| !sheet.lines[line].is_cut && !sheet.lines[line].usage.is_drawn();
    let doubtful = sheet.remains.iter().filter(|remains| !remains.is_sure && sheet.lines[remains.inner].is_cut);
    for remains in doubtful.filter(|_| job.profile.drawing.beside == Beside::Outline) {
        let lines: Vec<usize> = remains.lines.iter().copied().filter(is_left).collect();
        let numbers = numbers(owners, &[remains.inner]);
        let is_chosen = numbers.iter().any(|&number| job.selection.has(number));
        let Some(&first) = lines.first().filter(|_| is_chosen) else { continue };
        let around = match lines.len() {
            1 => format!("an open outline, gap {} mm", fixed(gap(first, sheet), DECIMALS)),
            n => format!("an outline of {n} open lines"),
        };
        let message = format!("{} may be a line inside {around}", pieces::listed(&numbers));
        let found = finding(&code::DRAWING_MAY_BE_SEAM, message, &sheet.lines[first], sheet);
        let found = found.on_cloth(sheet.lines[first].vertices(&sheet.vertices)[0].at);
        let skip = numbers.first().map_or(0, |number| *number);
        out.push(
            found
                .about(numbers)
                .hint(format!("if those lines are its outline, let the CAD close it; `--skip {skip}` leaves it out"))
                .hint("if those lines are guides, say so: `--set drawing.beside=guide`"),
        );
    }
}

/// Distance between the ends of a line as drawn, mm.
fn gap(line: usize, sheet: &Sheet) -> f64 {
    let drawn = sheet.lines[line].as_drawn(&sheet.vertices);
    (drawn[drawn.len() - 1].at - drawn[0].at).norm()
}

/// Parts without a seam line where many have one.
fn without_seam(sheet: &Sheet, owners: &[usize], out: &mut Diagnostics) {
    let cut = |parts: Vec<usize>| parts.into_iter().filter(|&part| sheet.lines[part].is_cut).collect::<Vec<_>>();
    let [with, without] = sheet.parts_by_seam().map(cut);
    if let Some(&first) = without.first().filter(|_| are_many(&with, &without)) {
        let (parts, verb) = match without.len() {
            1 => ("a part".to_owned(), "has"),
            n => (format!("{n} parts"), "have"),
        };
        let numbers = numbers(owners, &without);
        let message =
            format!("{parts} {verb} no seam line, {}, while {} parts have one", pieces::listed(&numbers), with.len());
        let found = finding(&code::DRAWING_NO_SEAM, message, &sheet.lines[first], sheet);
        out.push(
            found
                .about(numbers)
                .hint("if its outline is missing, this is the seam line: leave the piece out with `--skip`"),
        );
    }
}

/// Kinds of closing that are reported.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ClosingKind {
    /// They stop before their start.
    Gap,
    /// Their strokes do not meet.
    Bridged,
    /// They stop at the edge of the frame.
    Edge,
}

/// Kind of closing of a line, length of the gap, mm, and the place where the gap begins.
fn closing(line: &Line, sheet: &Sheet) -> Option<(ClosingKind, f64, Point)> {
    let drawn = line.as_drawn(&sheet.vertices);
    let last = drawn[drawn.len() - 1].at;
    match line.closing {
        Closing::Gap(mm) => Some((ClosingKind::Gap, mm, last)),
        Closing::Bridged(mm, at) => Some((ClosingKind::Bridged, mm, at)),
        Closing::Edge(mm) => Some((ClosingKind::Edge, mm, last)),
        Closing::Drawn | Closing::Retraced | Closing::Open(_) => None,
    }
}

/// Outlines that were closed, and other lines that are cut: each kind once, at the widest gap.
fn closed(sheet: &Sheet, owners: &[usize], out: &mut Diagnostics) {
    let cut = sheet.indices(|line| line.is_cut && line.is_closed);
    let closings = cut.into_iter().filter_map(|i| Some((i, closing(&sheet.lines[i], sheet)?)));
    let closings: Vec<(usize, (ClosingKind, f64, Point))> = closings.collect();
    for kind in [ClosingKind::Gap, ClosingKind::Bridged, ClosingKind::Edge] {
        let closed: Vec<&(usize, (ClosingKind, f64, Point))> =
            closings.iter().filter(|(_, how)| how.0 == kind).collect();
        let Some(&&(widest, (_, length, at))) =
            closed.iter().max_by(|a, b| a.1.1.total_cmp(&b.1.1).then(b.0.cmp(&a.0)))
        else {
            continue;
        };
        let are_outlines = closed.iter().all(|(i, _)| owners.binary_search(i).is_ok());
        let [one, several] = if are_outlines { ["an outline", "outlines"] } else { ["a line", "lines"] };
        let (outlines, is_one) = match closed.len() {
            1 => (one.to_owned(), true),
            n => (format!("{n} {several}"), false),
        };
        let parts: Vec<usize> = closed.iter().map(|&&(i, _)| sheet.part_around(i).unwrap_or(i)).collect();
        let numbers = numbers(owners, &parts);
        let of = pieces::listed(&numbers);
        let stop = if is_one { "stops" } else { "stop" };
        let length = fixed(length, DECIMALS);
        let message = match kind {
            ClosingKind::Gap => {
                format!("{outlines} {stop} before the start, {of}: closed straight, by up to {length} mm")
            }
            ClosingKind::Bridged => {
                let have = if is_one { "has gaps between its strokes" } else { "have gaps between their strokes" };
                format!("{outlines} {have}, {of}: closed straight, by up to {length} mm")
            }
            ClosingKind::Edge => {
                format!("{outlines} {stop} at the edge of the frame, {of}: closed along it, by up to {length} mm")
            }
        };
        let line = &sheet.lines[widest];
        let vertices = line.as_drawn(&sheet.vertices);
        let span =
            vertices.iter().skip(1).find(|vertex| vertex.at == at).map_or(line.span(&sheet.vertices), |v| v.span);
        let found = Diagnostic::new(&code::DRAWING_CLOSED, message).at(span).on_cloth(at);
        out.push(
            found
                .about(numbers)
                .hint("look at them in the picture (`-t svg`); `--set drawing.close_mm=0` leaves them open"),
        );
    }
}

/// Warning about lines that lie at an edge in one way.
struct EdgeDoubt {
    lie: Lie,
    code: &'static Code,
    /// Words for one such line, and for several.
    does: [&'static str; 2],
    hints: &'static [&'static str],
}

/// Hint with the measures of the strokes that are notches.
const NOTCHES: &str =
    "notches lead 1 to 15 mm inwards from within 0.5 mm of the edge; `--cut-all` cuts all but a frame";
/// Hint with the greatest measures of a notch.
const MEASURES: &str = "the mouth of a notch is up to 12 mm wide, its depth 15 mm; `--cut-all` cuts all but a frame";

/// Warnings about lines at an edge, in the order in which they are given.
const EDGE_DOUBTS: &[EdgeDoubt] = &[
    EdgeDoubt {
        lie: Lie::Between,
        code: &code::DRAWING_SHARED_EDGE,
        does: ["one line between strokes", "lines between strokes"],
        hints: &[
            "if two parts share it, let the CAD draw each as one closed line, or cut it: `--cut-all`",
            "if it is a line in one part, `--inner ignore` says so",
        ],
    },
    EdgeDoubt {
        lie: Lie::Divides,
        code: &code::DRAWING_DIVIDED_PART,
        does: ["one open line goes from edge to edge", "open lines go from edge to edge"],
        hints: &["if it divides a part in two, let the CAD draw both parts; `--cut-all` cuts every line but a frame"],
    },
    EdgeDoubt {
        lie: Lie::Outside,
        code: &code::DRAWING_OPEN_OUTLINES,
        does: ["one open line outside joins two places of the edge", "open lines outside join two places of the edge"],
        hints: &[
            "if it is a part that has an edge in common, let the CAD draw it as one closed line",
            "`--cut-all` cuts every line but a frame",
        ],
    },
    EdgeDoubt {
        lie: Lie::Wide,
        code: &code::DRAWING_LINE_FROM_EDGE,
        does: ["one stroke above 12 mm wide", "strokes above 12 mm wide"],
        hints: &[MEASURES],
    },
    EdgeDoubt {
        lie: Lie::Deep,
        code: &code::DRAWING_LINE_FROM_EDGE,
        does: ["one stroke above 15 mm deep", "strokes above 15 mm deep"],
        hints: &[MEASURES],
    },
    EdgeDoubt {
        lie: Lie::Letters,
        code: &code::DRAWING_LINE_FROM_EDGE,
        does: ["one stroke like a letter beside the edge", "strokes like letters beside the edge"],
        hints: &["if they are notches, let them begin on the edge; `--cut-all` cuts every line but a frame"],
    },
    EdgeDoubt {
        lie: Lie::Sign,
        code: &code::DRAWING_LINE_FROM_EDGE,
        does: ["one arrow or cross stroke", "arrow or cross strokes"],
        hints: &["if they are notches, let each be one stroke by itself; `--cut-all` cuts every line but a frame"],
    },
    EdgeDoubt {
        lie: Lie::Crosses,
        code: &code::DRAWING_LINE_FROM_EDGE,
        does: ["one stroke stands across the outline", "strokes stand across the outline"],
        hints: &["if they are notches, let them begin on the edge; `--cut-all` cuts every line but a frame"],
    },
    EdgeDoubt {
        lie: Lie::Ends,
        code: &code::DRAWING_LINE_FROM_EDGE,
        does: ["one open line ends at the outline", "open lines end at the outline"],
        hints: &[NOTCHES],
    },
    EdgeDoubt {
        lie: Lie::Joins,
        code: &code::DRAWING_LINE_FROM_EDGE,
        does: ["one open line leads from outline to outline", "open lines lead from outline to outline"],
        hints: &[
            "if two parts have it in common, let the CAD draw each as one closed line",
            "`--cut-all` cuts every line but a frame",
        ],
    },
    EdgeDoubt {
        lie: Lie::Stands,
        code: &code::DRAWING_LINE_FROM_EDGE,
        does: ["one small closed line stands on the outline", "small closed lines stand on the outline"],
        hints: &["if they are notches, let the CAD draw each as an open stroke from edge to edge of its mouth"],
    },
];

/// Uncut lines that begin on the outline of a part, and small closed ones that stand on it.
fn from_edges(sheet: &Sheet, owners: &[usize], job: &Job, out: &mut Diagnostics) {
    let is_left = |&EdgeLine { line, outline, other, .. }: &EdgeLine| {
        let Line { is_cut, usage, .. } = sheet.lines[line];
        !is_cut && usage != Use::Drawn && [Some(outline), other].iter().flatten().any(|&on| sheet.lines[on].is_cut)
    };
    // A user who chooses what becomes of lines in parts has looked at them.
    let lie_of = |edge: &EdgeLine| match edge.lie {
        Lie::Between if job.lines.inner.is_some() => Lie::Divides,
        lie => lie,
    };
    for &EdgeDoubt { lie, code, does, hints } in EDGE_DOUBTS {
        let is_named = |edge: &EdgeLine| lie != Lie::Outside || sheet.lines[edge.line].length >= SHORTEST_NAMED;
        let of_kind = |edge: &&EdgeLine| lie_of(edge) == lie && is_left(edge) && is_named(edge);
        let edges: Vec<&EdgeLine> = sheet.from_edges.iter().filter(of_kind).collect();
        let Some(first) = edges.first() else { continue };
        let (begin, longest) = match edges.len() {
            1 => (does[0].to_owned(), "it is"),
            n => (format!("{n} {}", does[1]), "the longest is"),
        };
        let length = fixed(edges.iter().map(|edge| sheet.lines[edge.line].length).fold(0.0, f64::max), DECIMALS);
        let parts: Vec<usize> = edges.iter().flat_map(|edge| [edge.outline].into_iter().chain(edge.other)).collect();
        let numbers = numbers(owners, &parts);
        let message = format!("not cut: {begin} of {}; {longest} {length} mm long", pieces::listed(&numbers));
        let found = finding(code, message, &sheet.lines[first.line], sheet).about(numbers);
        out.push(hints.iter().fold(found, |found, hint| found.hint(*hint)));
    }
}
