//! Patterns as lists of points: `x_mm,y_mm,element`, a row a point, a blank line between seams.
//!
//! The third field of a seam's first row says what is made along it: `straight`, `zigzag`, `bar-tack` or `box-x`; beside it,
//! behind a blank, `tie`, `back-tack` or `open` for its ends, `thread 2` and `stop`. Empty = a straight seam as the profile
//! has it.

use super::format::{Format, Input, begins_with};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Point;
use crate::machine::sewing::Ends;
use crate::sew::pattern::{Element, Pattern, Seam};
use crate::source::{Source, Span};

pub(super) const FORMAT: Format = Format {
    name: "pattern",
    about: "seams as points in mm: `x_mm,y_mm,element`, a row a point, a blank line between seams",
    is_it: |bytes, _| begins_with(bytes, HEADER),
    read,
};

const HEADER: &[u8] = b"x_mm,y_mm,element";
/// Largest coordinate, mm: no machine is as large.
const FARTHEST: f64 = 1e4;
/// Corners of a box.
const BOX_CORNERS: usize = 4;

/// The words for the ends of a seam.
const ENDS: [(&str, Ends); 3] = [("tie", Ends::Tie), ("back-tack", Ends::BackTack), ("open", Ends::Open)];

fn read(source: &Source, out: &mut Diagnostics) -> Input {
    let mut pattern = Pattern::default();
    let mut open: Option<Seam> = None;
    let mut start = 0;
    for (line, row) in source.bytes().split(|&byte| byte == b'\n').zip(1..) {
        let span = Span { start, end: start + line.len() as u32, block: row };
        start = span.end + 1;
        if row == 1 {
            continue;
        }
        let text = String::from_utf8_lossy(line.trim_ascii());
        if text.is_empty() {
            finish(open.take(), &mut pattern, out);
            continue;
        }
        let added = point(&text).and_then(|(point, words)| add(&mut open, point, words, span));
        if let Err(message) = added {
            let hint =
                "a row is x and y in mm and, in the first of a seam, what is made along it, as in `0,0,zigzag open`";
            out.push(Diagnostic::new(&code::SEW_ROW, message).at(span).hint(hint));
        }
    }
    finish(open.take(), &mut pattern, out);
    Input::Pattern(pattern)
}

/// Adds a point to the seam that is open, or begins one.
fn add(open: &mut Option<Seam>, point: Point, words: &str, span: Span) -> Result<(), String> {
    match open {
        Some(seam) if words.is_empty() => seam.points.push(point),
        Some(_) => return Err(format!("`{words}` stands amid a seam; an element begins behind a blank line")),
        None => {
            // Its points are a seam all the same: one slip is one fault.
            let plain = Seam::plain(vec![point], span);
            *open = Some(plain.clone());
            *open = Some(seam(plain, words)?);
        }
    }
    Ok(())
}

/// The point of a row, and the words behind it.
fn point(text: &str) -> Result<(Point, &str), String> {
    let mut fields = text.splitn(3, ',');
    let mut number = || {
        let field = fields.next().unwrap_or_default().trim();
        match field.parse::<f64>() {
            Ok(value) if value.abs() <= FARTHEST => Ok(value + 0.0),
            Ok(_) | Err(_) => Err(format!("`{field}` is no coordinate in mm")),
        }
    };
    let point = Point::new(number()?, number()?);
    Ok((point, fields.next().unwrap_or_default().trim()))
}

/// A seam with what its words ask for.
fn seam(mut seam: Seam, words: &str) -> Result<Seam, String> {
    let mut words = words.split_whitespace();
    while let Some(word) = words.next() {
        if let Some((_, element)) = Element::WORDS.iter().find(|(name, _)| *name == word) {
            seam.element = *element;
        } else if let Some((_, ends)) = ENDS.iter().find(|(name, _)| *name == word) {
            seam.ends = Some(*ends);
        } else if word == "stop" {
            seam.stop = true;
        } else if word == "thread" {
            let number = words.next().unwrap_or_default();
            let thread = number.parse().ok().filter(|&thread: &u16| thread > 0);
            seam.thread = thread.ok_or_else(|| format!("`{number}` is no number of a thread"))?;
        } else {
            return Err(format!("`{word}` is no element of a pattern"));
        }
    }
    Ok(seam)
}

/// A seam is at its end.
fn finish(seam: Option<Seam>, pattern: &mut Pattern, out: &mut Diagnostics) {
    let Some(seam) = seam else { return };
    let mut distinct = seam.points.clone();
    distinct.dedup();
    let corners = distinct.len() - usize::from(distinct.len() > 1 && distinct.first() == distinct.last());
    let wrong = match seam.element {
        Element::BoxX if corners != BOX_CORNERS => Some(format!("a box has four corners, and this has {corners}")),
        Element::BarTack if distinct.len() != 2 => {
            Some(format!("a bar tack goes from one point to another, and this has {}", distinct.len()))
        }
        Element::Straight | Element::Zigzag | Element::BarTack | Element::BoxX => {
            (distinct.len() < 2).then(|| "the seam that starts here has no two different points".to_owned())
        }
    };
    match wrong {
        Some(message) => out.push(Diagnostic::new(&code::SEW_ELEMENT, message).at(seam.span)),
        None => pattern.seams.push(seam),
    }
}
