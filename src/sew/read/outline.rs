//! Lines from all other input of `cutc`: contours of cut files and lists of points, lines of plots by their pen or layer,
//! recognised seam lines.

use std::collections::BTreeMap;

use super::inset;
use super::pattern;
use crate::analysis::nesting::Nesting;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::{self, Dialect, Read};
use crate::geom::Point;
use crate::ir::drawing::Vertex;
use crate::ir::marker::{Contour, OutlineNotch};
use crate::ir::{Drawing, Marker};
use crate::machine::Job;
use crate::pass::marker::MARKER_PASSES;
use crate::recognise;
use crate::sew::asked::Asked;
use crate::sew::pattern::{Pattern, Seam, distinct};
use crate::source::{Source, Span};
use crate::units::number::exact;

/// Word for the records of a cutter file or a plot.
pub(super) const RECORD_WORD: &str = "block";
/// Name of recognised seam lines for `--line`.
const SEAM: &str = "seam";
/// Class name of seam lines in recognition.
const SEAM_LINE: &str = "seam line";

/// A line of a file, and the location of its start.
struct Line {
    points: Vec<Point>,
    span: Span,
}

/// Reads the lines of a file; also returns the name of its dialect.
pub(super) fn read(
    source: &Source,
    asked: &Asked,
    job: &Job,
    out: &mut Diagnostics,
) -> Option<(&'static str, Pattern)> {
    let extension = source.name().rsplit_once('.').map(|(_, extension)| extension);
    let from = match asked.from.as_deref() {
        Some(name) => Some(front::by_name(name)?),
        None => None,
    };
    let dialect = front::choose(source, from, extension, out)?;
    let mut seams = Vec::new();
    for (i, Choice { name, words }) in choices(asked.line.as_deref()).into_iter().enumerate() {
        if i > 0 && out.has_errors() {
            break;
        }
        // The file is read again for each of several names; what is said of the file itself is said once.
        let mut said = Diagnostics::default();
        let lines = Reader { source, job }.lines(dialect, name, if i == 0 { &mut *out } else { &mut said });
        said.iter().filter(|found| found.code.name.starts_with("sew/")).for_each(|found| out.push(found.clone()));
        let drawn = if asked.inset == 0.0 { as_drawn(lines) } else { moved(&lines, asked.inset, out) };
        seams.extend(drawn.into_iter().filter_map(|seam| as_told(seam, words, out)));
    }
    Some((dialect.name, Pattern { seams }))
}

/// Name of a pen or layer, and the words of its element.
struct Choice<'a> {
    /// `None` for contours.
    name: Option<&'a str>,
    words: &'a str,
}

/// Names with their words, as in `SEW,TACK=bar-tack`, in sewing order.
fn choices(line: Option<&str>) -> Vec<Choice<'_>> {
    let Some(line) = line else { return vec![Choice { name: None, words: "" }] };
    let items = line.split(',').map(|item| item.split_once('=').unwrap_or((item, "")));
    items.map(|(name, words)| Choice { name: Some(name.trim()), words: words.trim() }).collect()
}

/// A seam with the element that words name; reports words that name none, and lines that do not suit it.
fn as_told(seam: Seam, words: &str, out: &mut Diagnostics) -> Option<Seam> {
    if words.is_empty() {
        return Some(seam);
    }
    let span = seam.span;
    let told = pattern::with_words(Seam { points: distinct(&seam.points), ..seam }, words);
    let told = told.and_then(|seam| match pattern::fault(&seam) {
        None => Ok(seam),
        Some(fault) => Err(fault),
    });
    let report = |message: String| {
        let hint = "an element follows the name of its layer, as in `--line SEW,TACK=bar-tack`";
        out.push(Diagnostic::new(&code::SEW_ELEMENT, message).at(span).hint(hint));
    };
    told.map_err(report).ok()
}

fn as_drawn(lines: Vec<Line>) -> Vec<Seam> {
    lines.into_iter().map(|Line { points, span }| Seam::plain(points, span)).collect()
}

/// The seams of lines. Closed ones lie `inset` mm from their line within the cloth: inside outlines, around cut-outs. Seams
/// that come closer to another line of their part are refused.
fn moved(lines: &[Line], inset: f64, out: &mut Diagnostics) -> Vec<Seam> {
    let nesting = Nesting::of_lines(&lines.iter().map(|line| &line.points[..]).collect::<Vec<_>>());
    let is_closed = |i: &usize| nesting.lines()[*i].is_closed;
    let mut parts: BTreeMap<Option<usize>, Vec<usize>> = BTreeMap::new();
    for i in (0..lines.len()).filter(is_closed) {
        parts.entry(nesting.outline(i)).or_default().push(i);
    }
    let mut seams = Vec::with_capacity(lines.len());
    for (i, Line { points, span }) in lines.iter().enumerate() {
        if !is_closed(&i) {
            seams.push(Seam::plain(points.clone(), *span));
            continue;
        }
        let distance = if nesting.is_inner(i) { -inset } else { inset };
        let others = parts[&nesting.outline(i)].iter().filter(|&&other| other != i);
        let found = inset::inset(points, distance);
        let wrong = match &found {
            _ if nesting.ended().is_some_and(|ended| ended <= i) => {
                "too many lines lie in one another to tell outlines from cut-outs"
            }
            None => "the contour that starts here is too narrow",
            Some(seam) if !others.clone().all(|&other| inset::is_clear(seam, &lines[other].points, inset)) => {
                "the contour that starts here is too near to another of its part"
            }
            Some(seam) => {
                seams.push(Seam::plain(seam.clone(), *span));
                continue;
            }
        };
        let message = format!("{wrong} for an inset of {} mm", exact(inset));
        out.push(Diagnostic::new(&code::SEW_INSET, message).at(*span).hint("give a smaller `--inset`"));
    }
    seams
}

/// Context for reading a file.
struct Reader<'a> {
    source: &'a Source,
    job: &'a Job,
}

impl Reader<'_> {
    /// The chosen lines, in file order.
    fn lines(&self, dialect: &Dialect, asked: Option<&str>, out: &mut Diagnostics) -> Vec<Line> {
        let Self { source, job } = *self;
        match (dialect.read, asked) {
            (Read::Marker(read) | Read::Patterns { cut: read, .. }, None) => contours(read(source, job, out), job),
            (Read::Patterns { drawn: read, seams, .. }, Some(name)) => {
                let name = if name == SEAM { seams } else { name };
                strokes(&read(source, job, out), name, out)
            }
            (Read::Drawing(read), Some(name)) if name != SEAM => strokes(&read(source, job, out), name, out),
            (Read::Drawing(read), asked) => {
                let drawing = read(source, job, out);
                if out.has_errors() {
                    return Vec::new();
                }
                let marker = recognise::marker(drawing, job, out);
                if asked.is_none() { contours(marker, job) } else { seam_lines(&marker, out) }
            }
            (Read::Marker(_), Some(name)) => {
                let message = format!("the file has no line `{name}`: its lines have no pens or layers");
                let hint = "leave `--line` out: its contours are sewn";
                out.push(Diagnostic::new(&code::SEW_NO_LINE, message).hint(hint));
                Vec::new()
            }
        }
    }
}

/// Passes that find the notches of a marker.
const OF_NOTCHES: [&str; 4] = ["weld", "spike", "slit", "notch"];

/// The contours of a marker. Notches are for the knife: slits are not sewn, and seams run straight over the mouths of other
/// notches. A list of points has no grid and no patterns, hence no notches.
fn contours(mut marker: Marker, job: &Job) -> Vec<Line> {
    if marker.unit > 0.0 || marker.drawing.is_some() {
        // Findings on cuts are irrelevant here.
        let mut unsaid = Diagnostics::default();
        let passes = MARKER_PASSES.iter().filter(|pass| OF_NOTCHES.contains(&pass.name));
        passes.for_each(|pass| (pass.run)(&mut marker, job, &mut unsaid));
    }
    let line = |(i, contour): (usize, &Contour)| {
        let piece = &marker.pieces[i];
        let points = marker.points(contour);
        let points = if contour.closed { over_mouths(points, &piece.outline_notches) } else { points };
        Line { points, span: piece.span }
    };
    marker.contours().map(line).collect()
}

/// A closed line, with its first point repeated at the end, without the points between the ends of notch mouths.
fn over_mouths(mut points: Vec<Point>, notches: &[OutlineNotch]) -> Vec<Point> {
    points.pop();
    let count = points.len();
    let mut is_in_mouth = vec![false; count];
    for notch in notches {
        let to_end = notch.segments as usize;
        let opens = |&k: &usize| points[k] == notch.mouth[0] && points[(k + to_end) % count] == notch.mouth[1];
        for start in (0..count).filter(opens) {
            (start + 1..start + to_end).for_each(|k| is_in_mouth[k % count] = true);
        }
    }
    let mut line: Vec<Point> =
        points.into_iter().zip(is_in_mouth).filter(|(_, is_in)| !is_in).map(|(at, _)| at).collect();
    line.extend(line.first().copied());
    line
}

/// The line through vertices of a drawing.
fn through(places: &[Vertex]) -> Line {
    Line { points: places.iter().map(|place| place.at).collect(), span: places[0].span }
}

/// The strokes of a pen or layer.
fn strokes(drawing: &Drawing, name: &str, out: &mut Diagnostics) -> Vec<Line> {
    let is_asked = |pen: u16| drawing.pens.get(usize::from(pen)).is_some_and(|pen| pen.name == name);
    let strokes = drawing.strokes.iter().filter(|stroke| is_asked(stroke.pen));
    let lines: Vec<Line> = strokes.map(|stroke| through(&drawing.vertices[stroke.range()])).collect();
    for unread in drawing.unread.iter().filter(|unread| is_asked(unread.pen)) {
        let message = format!("the {} on `{name}` is of a kind that is not read", unread.kind);
        let finding = Diagnostic::new(&code::SEW_UNREAD, message).at(unread.span);
        out.push(finding.hint("let the CAD system export polylines"));
    }
    if lines.is_empty() && !out.has_errors() {
        let names: Vec<&str> = drawing.pens.iter().map(|pen| pen.name.as_str()).collect();
        let message = format!("the file has no line `{name}`");
        let hint = format!("its pens or layers are {}; `--line {SEAM}` sews the seam lines of parts", names.join(", "));
        out.push(Diagnostic::new(&code::SEW_NO_LINE, message).hint(hint));
    }
    lines
}

/// The recognised seam lines of parts.
fn seam_lines(marker: &Marker, out: &mut Diagnostics) -> Vec<Line> {
    let aside = marker.drawing.iter().flat_map(|account| account.aside.each());
    let seams = aside.filter(|(class, places)| *class == Some(SEAM_LINE) && !places.is_empty());
    let lines: Vec<Line> = seams.map(|(_, places)| through(places)).collect();
    if lines.is_empty() && !out.has_errors() {
        let message = "no seam line was recognised in the file";
        let hint = "a seam line is closed and follows the outline around it from inside; `cutc info` tells what lines were taken for";
        out.push(Diagnostic::new(&code::SEW_NO_LINE, message).hint(hint));
    }
    lines
}
