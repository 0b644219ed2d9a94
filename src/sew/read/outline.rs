//! Lines of whatever else `cutc` reads: contours of cut files and lists of points, lines of plots by their pen or layer,
//! seam lines that were recognised.

use super::inset::inset;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::{self, Dialect, Read};
use crate::geom::Point;
use crate::ir::{Drawing, Marker};
use crate::machine::Job;
use crate::recognise;
use crate::sew::asked::Asked;
use crate::sew::pattern::{Pattern, Seam};
use crate::source::{Source, Span};

/// The name of recognised seam lines, as `--line` takes it.
const SEAM: &str = "seam";
/// What recognition calls them.
const SEAM_LINE: &str = "seam line";

/// Reads the lines of a file; the name of its dialect beside them.
pub(super) fn read(
    source: &Source,
    asked: &Asked,
    job: &Job,
    out: &mut Diagnostics,
) -> Option<(&'static str, Pattern)> {
    let extension = source.name().rsplit_once('.').map(|(_, extension)| extension);
    let dialect = match asked.from.as_deref() {
        Some(name) => front::by_name(name),
        None => front::detect(source, extension, out),
    }?;
    let lines = lines(dialect, source, asked, job, out);
    let mut pattern = Pattern::default();
    for (points, span) in lines {
        let seam = Seam::plain(points, span);
        if asked.inset == 0.0 || !seam.is_closed() {
            pattern.seams.push(seam);
            continue;
        }
        if let Some(points) = inset(&seam.points, asked.inset) {
            pattern.seams.push(Seam { points, ..seam });
        } else {
            let message = format!("the contour that starts here is too narrow for an inset of {} mm", asked.inset);
            out.push(Diagnostic::new(&code::SEW_INSET, message).at(span).hint("give a smaller `--inset`"));
        }
    }
    Some((dialect.name, pattern))
}

type Line = (Vec<Point>, Span);

/// The lines that were asked for, in the order of the file.
fn lines(dialect: &Dialect, source: &Source, asked: &Asked, job: &Job, out: &mut Diagnostics) -> Vec<Line> {
    match (dialect.read, asked.line.as_deref()) {
        (Read::Marker(read) | Read::Patterns { cut: read, .. }, None) => contours(&read(source, job, out)),
        (Read::Drawing(read) | Read::Patterns { drawn: read, .. }, Some(name)) if name != SEAM => {
            strokes(&read(source, job, out), name, out)
        }
        (Read::Patterns { cut: read, .. }, Some(_)) => seam_lines(&read(source, job, out), out),
        (Read::Drawing(read), asked) => {
            let drawing = read(source, job, out);
            if out.has_errors() {
                return Vec::new();
            }
            let marker = recognise::marker(drawing, job, out);
            if asked.is_none() { contours(&marker) } else { seam_lines(&marker, out) }
        }
        (Read::Marker(_), Some(name)) => {
            let message = format!("the file has no line `{name}`: its lines have no pens or layers");
            out.push(Diagnostic::new(&code::SEW_NO_LINE, message).hint("leave `--line` out: its contours are sewn"));
            Vec::new()
        }
    }
}

fn contours(marker: &Marker) -> Vec<Line> {
    marker.contours().map(|(piece, contour)| (marker.points(contour), marker.pieces[piece].span)).collect()
}

/// The strokes of a pen or layer.
fn strokes(drawing: &Drawing, name: &str, out: &mut Diagnostics) -> Vec<Line> {
    let is_asked = |pen: u16| drawing.pens.get(usize::from(pen)).is_some_and(|pen| pen.name == name);
    let strokes = drawing.strokes.iter().filter(|stroke| is_asked(stroke.pen));
    let lines: Vec<Line> = strokes
        .map(|stroke| &drawing.vertices[stroke.range()])
        .map(|places| (places.iter().map(|place| place.at).collect(), places[0].span))
        .collect();
    if lines.is_empty() && !out.has_errors() {
        let names: Vec<&str> = drawing.pens.iter().map(|pen| pen.name.as_str()).collect();
        let message = format!("the file has no line `{name}`");
        let hint = format!("its pens or layers are {}; `--line {SEAM}` sews the seam lines of parts", names.join(", "));
        out.push(Diagnostic::new(&code::SEW_NO_LINE, message).hint(hint));
    }
    lines
}

/// The seam lines that were recognised in parts.
fn seam_lines(marker: &Marker, out: &mut Diagnostics) -> Vec<Line> {
    let aside = marker.drawing.iter().flat_map(|account| account.aside.each());
    let seams = aside.filter(|(class, places)| *class == Some(SEAM_LINE) && !places.is_empty());
    let lines: Vec<Line> =
        seams.map(|(_, places)| (places.iter().map(|place| place.at).collect(), places[0].span)).collect();
    if lines.is_empty() && !out.has_errors() {
        let message = "no seam line was recognised in the file";
        let hint = "a seam line is closed and follows the outline around it from inside; `cutc info` tells what lines were taken for";
        out.push(Diagnostic::new(&code::SEW_NO_LINE, message).hint(hint));
    }
    lines
}
