//! CSV polylines: a header `x_mm,y_mm`, one point per row, a blank line between contours.
//!
//! Receives decimal numbers in mm. Promises one contour and one piece per polyline; a polyline that ends at its start point is
//! closed. Never guesses at decimal commas or other columns.

use super::{Dialect, Likeness, Read};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Point;
use crate::ir::Marker;
use crate::ir::list::{FULL_SPEED, Joint, Segment};
use crate::ir::marker::{Contour, Piece};
use crate::machine::Job;
use crate::source::{Source, Span, line_end};

pub(super) const DIALECT: Dialect = Dialect {
    name: "csv",
    about: "polylines in mm: `x_mm,y_mm`, a row a point, a blank line between contours",
    extensions: &["csv"],
    sniff,
    syntax: check_syntax,
    read: Read::Marker(read),
    words: &[],
};

const HEADER: &[u8] = b"x_mm,y_mm";
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
/// Number of bytes searched for the first row.
const SNIFFED_BYTES: usize = 4096;
/// Largest coordinate, mm: a kilometre, far beyond any table.
const VALUE_MAX: f64 = 1e6;

fn sniff(bytes: &[u8]) -> Likeness {
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    let bytes = &bytes[..bytes.len().min(SNIFFED_BYTES)];
    let end = line_end(bytes);
    let Some(line) = bytes.split(|&byte| byte == end).map(<[u8]>::trim_ascii).find(|line| !line.is_empty()) else {
        return Likeness::No;
    };
    let is_number = |field: &[u8]| std::str::from_utf8(field.trim_ascii()).is_ok_and(|f| f.parse::<f64>().is_ok());
    if is_header(line) {
        Likeness::Sure
    } else if line.iter().any(|b| b",;".contains(b)) && line.split(|b| b",;".contains(b)).all(is_number)
        || (line.starts_with(b"x") || line.starts_with(b"X")) && line.contains(&b',')
    {
        Likeness::Maybe
    } else {
        Likeness::No
    }
}

/// True if a row is the header, ignoring case and blanks.
fn is_header(line: &[u8]) -> bool {
    let letters = line.iter().filter(|byte| !byte.is_ascii_whitespace());
    letters.map(u8::to_ascii_lowercase).eq(HEADER.iter().copied())
}

/// A row of the file: a point or a blank line, which ends a contour.
enum Row {
    Point(Point),
    Blank,
}

/// Parses the rows after the header; faulty rows are reported and skipped.
fn rows(source: &Source, out: &mut Diagnostics) -> Vec<(Row, Span)> {
    let bytes = source.bytes();
    let mut rows = Vec::new();
    let mut at = if bytes.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK.len() } else { 0 };
    let end = line_end(bytes);
    let mut number = 0;
    let mut headed = false;
    while at < bytes.len() {
        let length = memchr::memchr(end, &bytes[at..]).unwrap_or(bytes.len() - at);
        let line = bytes[at..at + length].trim_ascii_end();
        number += 1;
        let span = Span { start: at as u32, end: (at + line.len()) as u32, block: number };
        at += length + 1;
        if line.trim_ascii().is_empty() {
            rows.push((Row::Blank, span));
        } else if !headed && is_header(line) {
            headed = true;
        } else {
            if !headed {
                headed = true;
                let finding = Diagnostic::new(&code::CSV_HEADER, "the first row is not `x_mm,y_mm`").at(span);
                out.push(finding.hint("write the header `x_mm,y_mm`, and the numbers in mm"));
                // A header with other words is one fault, not two.
                if line.iter().any(u8::is_ascii_alphabetic) {
                    continue;
                }
            }
            match point(line, span) {
                Ok(point) => rows.push((Row::Point(point), span)),
                Err(fault) => out.push(fault),
            }
        }
    }
    rows
}

/// `<row>`: a point as two numbers.
fn point(line: &[u8], span: Span) -> Result<Point, Diagnostic> {
    let fields = line.split(|&byte| byte == b',').count();
    if fields != 2 {
        let message = format!("the row has {fields} {} instead of 2", if fields == 1 { "field" } else { "fields" });
        let fault = Diagnostic::new(&code::CSV_ROW, message).at(span);
        return Err(if fields == 4 || line.contains(&b';') {
            fault.hint("write decimal points, not decimal commas, and a comma between x and y")
        } else {
            fault.hint("write x and y in mm, separated by a comma")
        });
    }
    let mut start = span.start;
    let mut values = [0.0; 2];
    for (value, field) in values.iter_mut().zip(line.split(|&byte| byte == b',')) {
        let place = Span { start, end: start + field.len() as u32, ..span };
        *value = number(field.trim_ascii(), place)?;
        start = place.end + 1;
    }
    Ok(Point::new(values[0], values[1]))
}

/// `<number>`: a decimal number with an optional exponent.
fn number(field: &[u8], span: Span) -> Result<f64, Diagnostic> {
    let fault = |message: String| {
        Diagnostic::new(&code::CSV_ROW, message).at(span).hint("write a finite decimal number, such as -12.5")
    };
    let shown = String::from_utf8_lossy(&field[..field.len().min(20)]).into_owned();
    let digits = field.iter().all(|byte| byte.is_ascii_digit() || b"+-.eE".contains(byte));
    let value = std::str::from_utf8(field).ok().filter(|_| digits).and_then(|text| text.parse::<f64>().ok());
    match value {
        None if field.is_empty() => Err(fault("a coordinate is missing".to_owned())),
        None => Err(fault(format!("`{shown}` is not a decimal number"))),
        Some(value) if value.abs() > VALUE_MAX => Err(fault(format!("`{shown}` is beyond {VALUE_MAX:.0} mm"))),
        // Adding zero turns -0.0 into 0.0: both are the same position but have different bit patterns.
        Some(value) => Ok(value + 0.0),
    }
}

fn check_syntax(source: &Source, out: &mut Diagnostics) {
    rows(source, out);
}

fn read(source: &Source, _: &Job, out: &mut Diagnostics) -> Marker {
    let mut marker = Marker::default();
    let mut faults = Diagnostics::default();
    let rows = rows(source, &mut faults);
    // A contour with faulty rows may look shorter than it is, so faults of rows replace findings on length.
    let mut short = Diagnostics::default();
    for polyline in rows.split(|(row, _)| matches!(row, Row::Blank)) {
        add(&mut marker, polyline, &mut short);
    }
    out.extend(if faults.has_errors() { faults } else { short });
    if marker.pieces.is_empty() && !out.has_errors() {
        let finding = Diagnostic::new(&code::CSV_NOTHING_TO_CUT, "the file holds no contour");
        out.push(finding.hint("export the points again: a row `x,y` each, below the header"));
    }
    marker
}

/// Adds a polyline as a piece with one contour.
fn add(marker: &mut Marker, polyline: &[(Row, Span)], out: &mut Diagnostics) {
    let points: Vec<(Point, Span)> = polyline
        .iter()
        .filter_map(|(row, span)| match row {
            Row::Point(point) => Some((*point, *span)),
            Row::Blank => None,
        })
        .collect();
    let (Some(&(first, span)), Some(&(last, _))) = (points.first(), points.last()) else { return };
    if points.iter().all(|(point, _)| *point == first) {
        out.push(
            Diagnostic::new(&code::CSV_NO_LENGTH, "the contour that starts here has no two different points").at(span),
        );
        return;
    }
    let segment = |pair: &[(Point, Span)]| Segment {
        from: pair[0].0,
        to: pair[1].0,
        span: pair[1].1,
        joint: Joint::default(),
        percent: FULL_SPEED,
    };
    if let Some(range) = marker.list.append(points.windows(2).map(segment)) {
        let contours = vec![Contour { range, closed: first == last }];
        marker.pieces.push(Piece { number: marker.pieces.len() as u32 + 1, span, contours, ..Piece::default() });
    }
}
