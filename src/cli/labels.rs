//! Labels of a cutter file, piece by piece: position and text of each, and the fields of the list behind M0.

use std::fmt::Write as _;

use serde::Serialize;

use crate::ir::Marker;
use crate::ir::marker;
use crate::machine::Job;
use crate::pipeline::significant;
use crate::source::{Source, Span};
use crate::units::deg;
use crate::units::number::fixed;

/// Significant digits of positions and angles, far below the resolution of a file.
const DIGITS: i32 = 9;

/// Labels and fields of one piece. Fields are keys of the JSON output.
#[derive(Debug, Serialize)]
pub(super) struct Labelled {
    piece: u32,
    /// Absent if there is only one copy.
    #[serde(skip_serializing_if = "Option::is_none")]
    copy: Option<u32>,
    #[serde(skip)]
    name: String,
    labels: Vec<Label>,
    fields: Vec<Field>,
}

#[derive(Debug, Serialize)]
struct Label {
    text: String,
    mirrored: Option<String>,
    x_mm: Option<f64>,
    y_mm: Option<f64>,
    angle_deg: Option<f64>,
    block: u32,
}

#[derive(Debug, Serialize)]
struct Field {
    letter: char,
    value: String,
}

/// The pieces that have labels or fields, in the order of the marker.
pub(super) fn of(marker: &Marker, source: &Source, job: &Job) -> Vec<Labelled> {
    let letters = marker.letters(&job.profile.labels);
    let text = |span: Span| letters.text(source.slice(span));
    let label = |label: &marker::Label| Label {
        text: text(label.span),
        mirrored: label.mirrored.map(text),
        x_mm: label.at.map(|at| significant(at.x, DIGITS)),
        y_mm: label.at.map(|at| significant(at.y, DIGITS)),
        angle_deg: label.heading.map(|heading| significant(deg(heading.radians()), DIGITS)),
        block: label.span.block,
    };
    let field = |field: &marker::Field| Field { letter: char::from(field.letter), value: text(field.span) };
    let labelled = marker.pieces.iter().map(|piece| Labelled {
        piece: piece.number,
        copy: Some(piece.copy).filter(|&copy| copy > 0),
        name: piece.name(),
        labels: piece.labels.iter().map(label).collect(),
        fields: piece.fields.iter().map(field).collect(),
    });
    labelled.filter(|piece| !(piece.labels.is_empty() && piece.fields.is_empty())).collect()
}

/// A table of labels and one of fields. Missing values are shown as a hyphen.
pub(super) fn text(pieces: &[Labelled]) -> String {
    let mut out = String::new();
    // Writing into a `String` cannot fail, so the results of `writeln!` are dropped throughout.
    if pieces.iter().all(|piece| piece.labels.is_empty()) {
        out.push_str("\n  no labels\n");
    } else {
        out.push_str("\n  piece      x mm      y mm  angle deg  label\n");
    }
    let number = |value: Option<f64>| value.map_or("-".to_owned(), |value| fixed(value, 1));
    for Labelled { name, labels, .. } in pieces {
        for Label { text, mirrored, x_mm, y_mm, angle_deg, .. } in labels {
            let (x, y, angle) = (number(*x_mm), number(*y_mm), number(*angle_deg));
            let _ = writeln!(out, "  {name:>5}  {x:>8}  {y:>8}  {angle:>9}  {text}");
            if let Some(mirrored) = mirrored {
                let _ = writeln!(out, "  {:>5}  {:>8}  {:>8}  {:>9}  {mirrored}", "", "", "", "mirrored:");
            }
        }
    }
    if pieces.iter().any(|piece| !piece.fields.is_empty()) {
        out.push_str("\n  piece  field behind M0\n");
    }
    for Labelled { name, fields, .. } in pieces {
        for Field { letter, value } in fields {
            let _ = writeln!(out, "  {name:>5}  {letter}  {value}");
        }
    }
    if out.contains(char::REPLACEMENT_CHARACTER) {
        out.push_str("\n  \u{fffd} stands for bytes that are no text in this encoding: name another one, as in\n  --set labels.encoding=windows-1251\n");
    }
    out
}
