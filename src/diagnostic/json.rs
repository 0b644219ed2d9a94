//! JSON form of diagnostics: code, severity, place, message, hints.

use serde::Serialize;

use super::{Diagnostic, Severity};
use crate::source::Lines;

/// Diagnostic as JSON. The place on the cloth is null if unknown; block, line and bytes are absent if it concerns the file as a
/// whole.
#[derive(Debug, Serialize)]
pub struct Json {
    code: &'static str,
    severity: Severity,
    file: String,
    /// Pieces concerned, if there are several.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pieces: Vec<u32>,
    piece: Option<u32>,
    /// Absent if there is only one copy.
    #[serde(skip_serializing_if = "Option::is_none")]
    copy: Option<u32>,
    label: Option<String>,
    x_mm: Option<f64>,
    y_mm: Option<f64>,
    /// Magnitude, if it can be measured.
    by_mm: Option<f64>,
    #[serde(flatten)]
    place: Option<Place>,
    message: String,
    hints: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Place {
    block: u32,
    line: u32,
    byte: u32,
    end_byte: u32,
}

/// Resolution of a place, steps per mm: no cut is finer.
const STEPS_A_MM: f64 = 1e4;

fn rounded(value: f64) -> f64 {
    (value * STEPS_A_MM).round() / STEPS_A_MM + 0.0 // no -0
}

impl Diagnostic {
    /// Converts it to its JSON form.
    pub fn to_json(&self, file: &str, lines: &mut Lines) -> Json {
        let [x_mm, y_mm] = [0, 1].map(|axis| self.at.as_ref().map(|at| rounded(at[axis])));
        Json {
            code: self.code.name,
            severity: self.code.severity,
            file: file.to_owned(),
            pieces: self.pieces.to_vec(),
            piece: self.piece.as_ref().map(|piece| piece.number),
            copy: self.piece.as_ref().map(|piece| piece.copy).filter(|&copy| copy > 0),
            label: self.piece.as_ref().and_then(|piece| piece.label.clone()),
            x_mm,
            y_mm,
            by_mm: self.by.map(rounded),
            place: self.span.map(|span| {
                let place = lines.place(span);
                Place { block: place.block, line: place.line, byte: place.byte, end_byte: span.end }
            }),
            message: self.message.clone(),
            hints: self.hints.clone(),
        }
    }
}
