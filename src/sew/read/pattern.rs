//! Patterns as lists of points: `x_mm,y_mm,element`, one point per row, a blank line between seams.
//!
//! The third field of the first row of a seam gives its element: `straight`, `zigzag`, `bar-tack`, `box-x`, `satin` or `eyelet`.
//! After a blank, `arc` or `circle` for its shape, `tie`, `back-tack` or `open` for its ends, also of one alone as in `end open`, `pitch 3`, `width 4`, `speed 1200`,
//! `thread 2`, `order 1` and `stop` may follow. An empty field is a straight seam with the defaults of the profile.

use super::format::{FARTHEST, Format, Input};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::front::sewn;
use crate::geom::{Point, cross};
use crate::machine::sewing::Ends;
use crate::sew::pattern::{Element, Pattern, Seam, Shape, distinct};
use crate::source::{Source, Span};

pub(super) const FORMAT: Format = Format {
    name: "pattern",
    about: "seams as points in mm: `x_mm,y_mm,element`, a row a point, a blank line between seams",
    extensions: &["csv"],
    record_word: "line",
    is_it: |bytes, _| sewn::is_pattern(bytes),
    read,
};

/// Number of corners of a box.
const BOX_CORNERS: usize = 4;

/// Words for the ends of a seam.
const ENDS: [(&str, Ends); 3] = [("tie", Ends::Tie), ("back-tack", Ends::BackTack), ("open", Ends::Open)];
/// Words for one end of a seam, before how it is locked.
const SIDES: [&str; 2] = ["start", "end"];
/// Words before a number, with its range: mm, and stitches per minute.
const PITCH: Number = Number { word: "pitch", what: "a stitch length in mm", range: [0.05, 50.0] };
const WIDTH: Number = Number { word: "width", what: "a width in mm", range: [0.1, 50.0] };
const SPEED: Number = Number { word: "speed", what: "a speed in stitches per minute", range: [10.0, 20_000.0] };
/// Words for the shape of a seam.
const SHAPES: [(&str, Shape); 2] = [("arc", Shape::Arc), ("circle", Shape::Circle)];
/// Words for the thread, before its number, and for a wait before the seam.
const THREAD: &str = "thread";
/// Name of the shape of a seam in messages.
const SHAPE: &str = "the shape";
const STOP: &str = "stop";
/// Word for the place of a seam in the sewing order, before its number.
const ORDER: &str = "order";

/// A number of a seam.
struct Number {
    word: &'static str,
    what: &'static str,
    range: [f64; 2],
}

impl Number {
    /// Parses the number that follows the word.
    fn parse(&self, text: Option<&str>) -> Result<Option<f64>, String> {
        let text = text.unwrap_or_default();
        let [least, most] = self.range;
        let found = text.parse().ok().filter(|&value: &f64| value >= least && value <= most);
        found.map(Some).ok_or_else(|| format!("`{text}` is not {} from {least} to {most}", self.what))
    }
}

fn read(source: &Source, out: &mut Diagnostics) -> Input {
    let mut pattern = Pattern::default();
    let Some(separator) = sewn::pattern_separator(source.bytes()) else {
        let end = memchr::memchr(b'\n', source.bytes()).unwrap_or(source.bytes().len()) as u32;
        let finding = Diagnostic::new(&code::SEW_ROW, "the first row of a pattern is `x_mm,y_mm,element`");
        out.push(
            finding.at(Span { start: 0, end, block: 1 }).hint("its points are in mm; name the fields in the first row"),
        );
        return Input::Pattern(pattern);
    };
    let separator = char::from(separator);
    let mut open: Option<Seam> = None;
    let mut start = 0;
    for (line, row) in source.bytes().split(|&byte| byte == b'\n').zip(1..) {
        let span = Span { start, end: start + line.len() as u32, block: row };
        start = span.end + 1;
        if row == 1 {
            continue;
        }
        // Spreadsheets quote texts, and keep the separators of an empty row.
        let text = String::from_utf8_lossy(line).replace('"', "");
        if text.trim_matches(|c: char| c == separator || c.is_ascii_whitespace()).is_empty() {
            finish(open.take(), &mut pattern, out);
            continue;
        }
        let added = point(&text, separator).and_then(|(point, words)| add(&mut open, point, words, span));
        if let Err(message) = added {
            out.push(Diagnostic::new(&code::SEW_ROW, message).at(span).hint(hint()));
        }
    }
    finish(open.take(), &mut pattern, out);
    Input::Pattern(pattern)
}

/// Hint on the content of a row.
fn hint() -> String {
    let elements = Element::WORDS.map(|(word, _)| word).join(", ");
    let shapes = SHAPES.map(|(word, _)| word).join(", ");
    let ends = ENDS.map(|(word, _)| word).join(", ");
    format!(
        "a row is x and y in mm and, in the first of a seam, what is made along it, as in `0,0,zigzag open`: one of \
         {elements}, and of {shapes}, {ends}, `{} open`, `{} 3`, `{} 4`, `{} 1200`, `{THREAD} 2`, `{ORDER} 1`, `{STOP}`",
        SIDES[1], PITCH.word, WIDTH.word, SPEED.word
    )
}

/// Adds a point to the open seam, or begins a seam.
fn add(open: &mut Option<Seam>, point: Point, words: &str, span: Span) -> Result<(), String> {
    match open {
        Some(seam) if words.is_empty() => seam.points.push(point),
        Some(_) => return Err(format!("`{words}` stands amid a seam; an element begins behind a blank line")),
        None => {
            // The following points belong to the seam even if its words are faulty, so that one slip is one fault.
            let plain = Seam::plain(vec![point], span);
            *open = Some(plain.clone());
            *open = Some(with_words(plain, words)?);
        }
    }
    Ok(())
}

/// The point of a row, and the words after it.
fn point(text: &str, separator: char) -> Result<(Point, &str), String> {
    let mut fields = text.splitn(3, separator);
    let mut number = || {
        let field = fields.next().unwrap_or_default().trim();
        // If the separator is not a comma, commas are decimal.
        let decimal = if separator == ',' { field.to_owned() } else { field.replace(',', ".") };
        match decimal.parse::<f64>() {
            Ok(value) if value.abs() <= FARTHEST => Ok(value + 0.0),
            Ok(_) | Err(_) => Err(format!("`{field}` is no coordinate in mm")),
        }
    };
    let point = Point::new(number()?, number()?);
    Ok((point, fields.next().unwrap_or_default().trim()))
}

/// Applies words to a seam.
pub(super) fn with_words(mut seam: Seam, words: &str) -> Result<Seam, String> {
    let mut words = words.split_whitespace();
    // A repeated word is refused: either occurrence may be meant.
    let mut said: Vec<&str> = Vec::new();
    let mut once = |kind: &'static str| {
        let is_new = !said.contains(&kind);
        said.push(kind);
        if is_new { Ok(()) } else { Err(format!("{kind} is named twice")) }
    };
    let lock = |word: &str| ENDS.iter().find(|(name, _)| *name == word).map(|(_, ends)| *ends);
    while let Some(word) = words.next() {
        if let Some((_, element)) = Element::WORDS.iter().find(|(name, _)| *name == word) {
            once("the element")?;
            seam.element = *element;
            if *element == Element::Eyelet {
                once(SHAPE)?;
                seam.shape = Shape::Circle;
            }
        } else if let Some((_, shape)) = SHAPES.iter().find(|(name, _)| *name == word) {
            once(SHAPE)?;
            seam.shape = *shape;
        } else if let Some(ends) = lock(word) {
            once("what is done at the ends")?;
            seam.ends = seam.ends.map(|told| told.or(Some(ends)));
        } else if let Some(side) = SIDES.iter().position(|name| *name == word) {
            once(["what is done at the start", "what is done at the end"][side])?;
            let told = words.next().unwrap_or_default();
            seam.ends[side] = Some(lock(told).ok_or_else(|| format!("`{told}` is no way to lock an end"))?);
        } else if word == PITCH.word {
            once("the pitch")?;
            seam.pitch = PITCH.parse(words.next())?;
        } else if word == WIDTH.word {
            once("the width")?;
            seam.width = WIDTH.parse(words.next())?;
        } else if word == SPEED.word {
            once("the speed")?;
            seam.rpm = SPEED.parse(words.next())?;
        } else if word == STOP {
            seam.stop = true;
        } else if word == THREAD {
            once("the thread")?;
            seam.thread = counted(words.next(), "of a thread")?;
        } else if word == ORDER {
            once("the order")?;
            seam.order = Some(counted(words.next(), "in the order")?);
        } else {
            return Err(format!("`{word}` is no element of a pattern"));
        }
    }
    if seam.width.is_some() && matches!(seam.element, Element::Straight | Element::BoxX | Element::Satin) {
        return Err("a width is given for a seam that has none".to_owned());
    }
    Ok(seam)
}

/// A number from 1; `whose` says what it is a number of.
fn counted(text: Option<&str>, whose: &str) -> Result<u16, String> {
    let number = text.unwrap_or_default();
    number.parse().ok().filter(|&count: &u16| count > 0).ok_or_else(|| format!("`{number}` is no number {whose}"))
}

/// Reason why the element of a seam does not suit its line; `None` if it does. The line has no equal points in a row.
pub(super) fn fault(seam: &Seam) -> Option<String> {
    let points = &seam.points;
    let corners = points.len() - usize::from(points.len() > 1 && points.first() == points.last());
    let name = Element::WORDS.iter().find(|(_, element)| *element == seam.element).map_or("", |(word, _)| word);
    match seam.element {
        Element::BoxX | Element::BarTack | Element::Satin if seam.shape != Shape::Line => {
            Some(format!("a {name} follows no arc or circle"))
        }
        Element::BoxX if corners != BOX_CORNERS => Some(format!("a box has four corners, and this has {corners}")),
        Element::BarTack if points.len() != 2 => {
            Some(format!("a bar tack goes from one point to another, and this has {}", points.len()))
        }
        Element::Satin => satin_fault(points),
        Element::Straight | Element::Zigzag | Element::BarTack | Element::BoxX | Element::Eyelet => {
            (points.len() < 2).then(|| "the seam that starts here has no two different points".to_owned())
        }
    }
}

/// Reason why points are no satin: each two are a rung from rail to rail.
fn satin_fault(points: &[Point]) -> Option<String> {
    if points.len() < 4 || !points.len().is_multiple_of(2) {
        let message = "the points of a satin alternate between its two rails, two a rung, and this has";
        return Some(format!("{message} {}", points.len()));
    }
    let rails_cross = |area: &[Point]| {
        let [a, b, c, d] = [area[0], area[1], area[2], area[3]];
        let side = |from: Point, to: Point, point: Point| cross(to - from, point - from);
        side(a, c, b) * side(a, c, d) < 0.0 && side(b, d, a) * side(b, d, c) < 0.0
    };
    let rung = points.windows(4).step_by(2).position(rails_cross)?;
    Some(format!("the rails of a satin cross behind its rung {}", rung + 1))
}

/// Ends a seam: removes consecutive equal points, which are no corners, and checks it.
fn finish(seam: Option<Seam>, pattern: &mut Pattern, out: &mut Diagnostics) {
    let Some(mut seam) = seam else { return };
    if seam.element != Element::Satin {
        // The rails of a satin may meet in a point.
        seam.points = distinct(&seam.points);
    }
    match fault(&seam) {
        Some(message) => out.push(Diagnostic::new(&code::SEW_ELEMENT, message).at(seam.span)),
        None => pattern.seams.push(seam),
    }
}
