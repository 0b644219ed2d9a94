//! Reading: line by line, each line word by word.

use std::str::{FromStr, SplitWhitespace};

use thiserror::Error;

use super::{ADVANCE_BY, ENDS, EVENTS, FORMS, JOINTS, KINDS, ORIENTATION_MODES, SHAPES, SIDES};
use crate::geom::{Heading, Point, Vector};
use crate::ir::list::{FULL_SPEED, Joint, Range, Segment};
use crate::ir::marker::{
    CommonEdge, Contour, Cut, Drill, Event, Field, Label, Marker, NearEdge, Notch, NotchKind, NotchStroke,
    OutlineNotch, Piece,
};
use crate::ir::toolpath::{self, Air, Edge, End, Overcut, PlungeCut, Pose, Run, Step, Toolpath};
use crate::source::Span;

/// A text that is not what [`print_marker`](super::print_marker) or [`print_toolpath`](super::print_toolpath) writes.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("line {line}: expected {expected}")]
pub struct ReadError {
    /// Number of the line, from 1.
    pub line: usize,
    /// Expected text.
    pub expected: String,
}

type Read<T> = Result<T, ReadError>;

/// First words of the lines of a marker.
const LINES: &str = "piece, event, feed-mm-s, section, drill, slit, contour, notch, label, field, closing, cut, common, \
    junction or near";

/// Reads the text of a marker.
pub fn read_marker(text: &str) -> Read<Marker> {
    let mut lines = lines(text);
    let mut marker = Marker::default();
    let mut head = lines.next_or("marker")?;
    head.expect("marker")?;
    head.expect("unit-mm")?;
    marker.unit = head.number()?;
    if head.has("moved-on") {
        marker.moved_on = head.whole("the way of the cloth, mm")?;
    }
    head.end()?;
    while let Some(mut line) = lines.take() {
        match line.word(LINES)? {
            "piece" => {
                let number = line.whole("a piece number")?;
                let copy = if line.has("copy") { line.whole("a number of a copy")? } else { 0 };
                marker.pieces.push(Piece { number, copy, span: line.span()?, ..Piece::default() });
            }
            "closing" => marker.closing.push(event(&mut line)?),
            "cut" => {
                let cut = cut(&mut line, &mut lines, &mut marker)?;
                marker.cuts.push(cut);
            }
            "common" => {
                let edge = common(&mut line, &mut lines, &mut marker)?;
                marker.common.push(edge);
            }
            "junction" => {
                let from = line.point()?;
                line.expect("to")?;
                marker.junctions.push([from, line.point()?]);
            }
            "near" => {
                line.expect("piece")?;
                let piece = place(&mut line, &marker)?;
                let from = line.point()?;
                line.expect("to")?;
                marker.near.push(NearEdge { piece, ends: [from, line.point()?] });
            }
            "contour" => {
                let closed = line.choice(&[("closed", true), ("open", false)])?;
                let range = range(&line, &mut lines, &mut marker)?;
                let piece = marker.pieces.last_mut().ok_or_else(|| line.error("piece"))?;
                piece.contours.push(Contour { range, closed });
            }
            word => of_piece(word, &mut line, &mut marker)?,
        }
        line.end()?;
    }
    Ok(marker)
}

/// Adds the content of a line to the last piece.
fn of_piece(word: &str, line: &mut Line<'_>, marker: &mut Marker) -> Read<()> {
    let Some(piece) = marker.pieces.last_mut() else { return Err(line.error("piece")) };
    match word {
        "drill" => {
            let (at, tool, span) = drill(line)?;
            piece.drills.push(Drill { at, tool, span });
        }
        "slit" => {
            let NotchStroke { from: root, to: tip, span } = stroke(line)?;
            let percent = line.percent()?;
            let kind = if line.has("bar") { NotchKind::T(stroke(line)?) } else { NotchKind::Slit };
            piece.notches.push(Notch { kind, root, tip, percent, span });
        }
        "notch" => piece.outline_notches.push(outline_notch(line)?),
        "label" => {
            let at = if line.has("at") { Some(line.point()?) } else { None };
            let heading = if line.has("heading-rad") { Some(Heading::new(line.number()?)) } else { None };
            let span = line.span()?;
            let mirrored = if line.has("mirrored") { Some(line.span()?) } else { None };
            piece.labels.push(Label { at, heading, span, mirrored });
        }
        "event" => piece.events.push(event(line)?),
        "feed-mm-s" => piece.feed = Some(line.number()?),
        "section" => {
            let from = line.number()?;
            line.expect("to")?;
            piece.section = Some([from, line.number()?]);
        }
        "field" => {
            let letter = line.word("a letter")?;
            let &[letter @ b'A'..=b'Z'] = letter.as_bytes() else { return Err(line.error("a letter")) };
            piece.fields.push(Field { letter, span: line.span()? });
        }
        _ => return Err(line.error(LINES)),
    }
    Ok(())
}

/// The number of a piece in the marker, from 1.
fn place(line: &mut Line<'_>, marker: &Marker) -> Read<u32> {
    let place: usize = line.whole("the place of a piece")?;
    let piece = place.checked_sub(1).filter(|&piece| piece < marker.pieces.len());
    piece.map(|piece| piece as u32).ok_or_else(|| line.error("the place of a piece"))
}

/// A common edge of two parts, with the segments that follow.
fn common(line: &mut Line<'_>, lines: &mut Lines<'_>, marker: &mut Marker) -> Read<CommonEdge> {
    line.expect("cut")?;
    let cut = place(line, marker)?;
    line.expect("spared")?;
    let spared = place(line, marker)?;
    line.expect("shift-mm")?;
    let shift = line.number()?;
    Ok(CommonEdge { pieces: [cut, spared], range: range(line, lines, marker)?, shift })
}

/// A cut of a contour, or of the segments that follow.
fn cut(line: &mut Line<'_>, lines: &mut Lines<'_>, marker: &mut Marker) -> Read<Cut> {
    let kind = line.choice(&KINDS)?;
    line.expect("piece")?;
    let piece = place(line, marker)?;
    line.expect("sides")?;
    let sides = [line.side()?, line.side()?];
    let range = if line.has("contour") {
        let contour: usize = line.whole("the place of a contour")?;
        let found = contour.checked_sub(1).and_then(|contour| marker.pieces[piece as usize].contours.get(contour));
        found.ok_or_else(|| line.error("the place of a contour"))?.range
    } else {
        range(line, lines, marker)?
    };
    Ok(Cut { kind, piece, sides, range })
}

/// The segments that follow a line.
fn range(line: &Line<'_>, lines: &mut Lines<'_>, marker: &mut Marker) -> Read<Range> {
    let chain = segments(lines)?;
    marker.list.append(chain).ok_or_else(|| line.error("a segment in the next line"))
}

/// An event.
fn event_kind(line: &mut Line<'_>) -> Read<toolpath::Event> {
    if line.has(ADVANCE_BY) {
        return Ok(toolpath::Event::AdvanceBy(line.whole("the way of the cloth, mm")?));
    }
    line.choice(&EVENTS)
}

fn event(line: &mut Line<'_>) -> Read<Event> {
    Ok(Event { kind: event_kind(line)?, span: line.span()? })
}

fn outline_notch(line: &mut Line<'_>) -> Read<OutlineNotch> {
    let form = line.choice(&FORMS)?;
    let outwards = line.has("out");
    let before = line.point()?;
    line.expect("to")?;
    let tip = line.point()?;
    line.expect("to")?;
    let mouth = [before, line.point()?];
    line.expect("segments")?;
    let segments = line.whole("a number of segments")?;
    Ok(OutlineNotch { form, outwards, mouth, tip, segments, span: line.span()? })
}

fn drill(line: &mut Line<'_>) -> Read<(Point, u8, Span)> {
    let at = line.point()?;
    line.expect("tool")?;
    Ok((at, line.whole("the number of a drill")?, line.span()?))
}

fn stroke(line: &mut Line<'_>) -> Read<NotchStroke> {
    let from = line.point()?;
    line.expect("to")?;
    Ok(NotchStroke { from, to: line.point()?, span: line.span()? })
}

/// The segment lines that follow.
fn segments(lines: &mut Lines<'_>) -> Read<Vec<Segment>> {
    let mut chain: Vec<Segment> = Vec::new();
    while let Some(mut line) = lines.take_if(&["from", "to"]) {
        let before = chain.last().map(|segment| segment.to);
        let from = match (before, line.has("from")) {
            (None, true) => line.point()?,
            (Some(before), false) => before,
            (None, false) => return Err(line.error("from")),
            (Some(_), true) => return Err(line.error("to, since a segment starts where the one before it ends")),
        };
        line.expect("to")?;
        let (to, span) = (line.point()?, line.span()?);
        chain.push(Segment { from, to, span, percent: line.percent()?, joint: line.joint() });
        line.end()?;
    }
    Ok(chain)
}

/// Reads the text of a toolpath.
pub fn read_toolpath(text: &str) -> Read<Toolpath> {
    let mut lines = lines(text);
    let mut head = lines.next_or("toolpath")?;
    head.expect("toolpath")?;
    head.expect("piece")?;
    let piece = head.whole("a piece number")?;
    let part = if head.has("part") { head.whole("the place of a piece")? } else { 0 };
    head.expect("tolerance-mm")?;
    let tolerance = head.number()?;
    head.expect("entry")?;
    let entry = head.pose()?;
    head.end()?;
    let mut steps = Vec::new();
    while let Some(mut line) = lines.take() {
        let step = match line.word("run, stab, turn, travel, drill or event")? {
            "run" => Step::Run(run(&mut line, &mut lines)?),
            "stab" => Step::PlungeCut(plunge_cut(&mut line, &mut lines)?),
            "turn" => Step::Turn(air(&mut line)?),
            "travel" => Step::Travel(air(&mut line)?),
            "drill" => {
                let (at, tool, span) = drill(&mut line)?;
                Step::Drill(toolpath::Drill { at, tool, span })
            }
            "event" => Step::Event(event_kind(&mut line)?),
            _ => return Err(line.error("run, stab, turn, travel, drill or event")),
        };
        line.end()?;
        steps.push(step);
    }
    Ok(Toolpath { piece, part, tolerance, entry, steps })
}

fn air(line: &mut Line<'_>) -> Read<Air> {
    let from = line.pose()?;
    line.expect("to")?;
    Ok(Air { from, to: line.pose()? })
}

fn run(line: &mut Line<'_>, lines: &mut Lines<'_>) -> Read<Run> {
    let shape = line.choice(&SHAPES)?;
    let orientation = line.choice(&ORIENTATION_MODES)?;
    let (front, heel) = overlaps(line)?;
    line.expect("feed")?;
    let feed = if line.has("off") { f64::INFINITY } else { line.number()? };
    let turned = line.has("turned");
    let edge = edge(line);
    let ends = ends(lines)?;
    let start = pose_line(lines, "start")?;
    let end = pose_line(lines, "end")?;
    let mut run = Run {
        points: Vec::new(),
        spans: Vec::new(),
        joints: Vec::new(),
        feeds: Vec::new(),
        junctions: Vec::new(),
        shape,
        orientation,
        front,
        heel,
        ends,
        turned,
        edge,
        start,
        end,
    };
    while run.points.len() < 2 || lines.is_next("point") {
        let mut line = lines.next_or("point")?;
        line.expect("point")?;
        run.points.push(line.point()?);
        if run.points.len() > 1 {
            run.spans.push(line.span()?);
            run.feeds.push(if line.has("feed") { line.number()? } else { feed });
            run.junctions.push(line.has("junction"));
        }
        run.joints.push(line.joint());
        line.end()?;
    }
    if !run.junctions.contains(&true) {
        run.junctions.clear();
    }
    Ok(run)
}

fn plunge_cut(line: &mut Line<'_>, lines: &mut Lines<'_>) -> Read<PlungeCut> {
    line.expect("along")?;
    let along = Vector::new(line.number()?, line.number()?);
    let (front, heel) = overlaps(line)?;
    let turned = line.has("turned");
    let edge = edge(line);
    let mut overcut = [Overcut::default(); 2];
    if line.has("harm") {
        for end in &mut overcut {
            *end = Overcut { own: line.number()?, other: line.number()? };
        }
    }
    let ends = ends(lines)?;
    let pose = pose_line(lines, "pose")?;
    let (mut points, mut spans) = (Vec::new(), Vec::new());
    while points.len() < 2 || lines.is_next("point") {
        let mut line = lines.next_or("point")?;
        line.expect("point")?;
        points.push(line.point()?);
        if points.len() > 1 {
            spans.push(line.span()?);
        }
        line.end()?;
    }
    Ok(PlungeCut { points, spans, along, front, heel, ends, turned, edge, overcut, pose })
}

fn edge(line: &mut Line<'_>) -> Edge {
    if line.has("backwards") { Edge::Back } else { Edge::Front }
}

fn overlaps(line: &mut Line<'_>) -> Read<(f64, f64)> {
    line.expect("front")?;
    let front = line.number()?;
    line.expect("heel")?;
    Ok((front, line.number()?))
}

fn ends(lines: &mut Lines<'_>) -> Read<[End; 2]> {
    let mut line = lines.next_or("ends")?;
    line.expect("ends")?;
    let mut ends = [line.choice(&ENDS)?, line.choice(&ENDS)?];
    line.end()?;
    if lines.is_next("sides") {
        let mut line = lines.next_or("sides")?;
        line.expect("sides")?;
        for end in &mut ends {
            end.side = line.choice(&SIDES)?;
        }
        line.end()?;
    }
    Ok(ends)
}

fn pose_line(lines: &mut Lines<'_>, name: &str) -> Read<Pose> {
    let mut line = lines.next_or(name)?;
    line.expect(name)?;
    let pose = line.pose()?;
    line.end()?;
    Ok(pose)
}

/// The lines that are not blank.
struct Lines<'a> {
    rest: std::iter::Peekable<std::vec::IntoIter<Line<'a>>>,
    /// Number of the line after the text, for errors at its end.
    end: usize,
}

fn lines(text: &str) -> Lines<'_> {
    let code = |line: &'_ str| line.find(';').map_or(line.len(), |at| at);
    let held: Vec<Line<'_>> = text
        .lines()
        .enumerate()
        .map(|(i, line)| Line { number: i + 1, words: line[..code(line)].split_whitespace() })
        .filter(|line| line.peek().is_some())
        .collect();
    Lines { rest: held.into_iter().peekable(), end: text.lines().count() + 1 }
}

impl<'a> Lines<'a> {
    fn take(&mut self) -> Option<Line<'a>> {
        self.rest.next()
    }

    /// The next line when it starts with one of some words.
    fn take_if(&mut self, words: &[&str]) -> Option<Line<'a>> {
        self.rest.next_if(|line| line.peek().is_some_and(|word| words.contains(&word)))
    }

    fn is_next(&mut self, word: &str) -> bool {
        self.rest.peek().is_some_and(|line| line.peek() == Some(word))
    }

    fn next_or(&mut self, expected: &str) -> Read<Line<'a>> {
        self.rest.next().ok_or_else(|| ReadError { line: self.end, expected: expected.to_owned() })
    }
}

/// Rest of a line.
struct Line<'a> {
    number: usize,
    words: SplitWhitespace<'a>,
}

impl<'a> Line<'a> {
    fn peek(&self) -> Option<&'a str> {
        self.words.clone().next()
    }

    fn error(&self, expected: &str) -> ReadError {
        ReadError { line: self.number, expected: expected.to_owned() }
    }

    fn word(&mut self, expected: &str) -> Read<&'a str> {
        self.words.next().ok_or_else(|| self.error(expected))
    }

    /// Takes the next word when it is `word`.
    fn has(&mut self, word: &str) -> bool {
        let found = self.peek() == Some(word);
        if found {
            self.words.next();
        }
        found
    }

    fn expect(&mut self, word: &str) -> Read<()> {
        if self.has(word) { Ok(()) } else { Err(self.error(word)) }
    }

    fn end(&self) -> Read<()> {
        if self.peek().is_none() { Ok(()) } else { Err(self.error("the end of the line")) }
    }

    fn choice<T: Copy>(&mut self, table: &[(&str, T)]) -> Read<T> {
        let names = || table.iter().map(|row| row.0).collect::<Vec<_>>().join(" or ");
        let word = self.words.next();
        table.iter().find(|row| word == Some(row.0)).map(|row| row.1).ok_or_else(|| self.error(&names()))
    }

    fn number(&mut self) -> Read<f64> {
        let number = self.words.next().and_then(|word| word.parse::<f64>().ok());
        number.filter(|number| number.is_finite()).ok_or_else(|| self.error("a finite number"))
    }

    fn whole<T: FromStr>(&mut self, expected: &str) -> Read<T> {
        self.words.next().and_then(|word| word.parse().ok()).ok_or_else(|| self.error(expected))
    }

    fn point(&mut self) -> Read<Point> {
        Ok(Point::new(self.number()?, self.number()?))
    }

    fn pose(&mut self) -> Read<Pose> {
        let at = self.point()?;
        self.expect("c-rad")?;
        Ok(Pose::new(at.x, at.y, self.number()?))
    }

    /// A speed; full speed if there is none.
    fn percent(&mut self) -> Read<u8> {
        if self.has("percent") { self.whole("a number of percents up to 255") } else { Ok(FULL_SPEED) }
    }

    /// A side of a cut: the number of a part, or waste.
    fn side(&mut self) -> Read<Option<u32>> {
        if self.has("-") {
            return Ok(None);
        }
        let part: u32 = self.whole("the place of a part, or -")?;
        part.checked_sub(1).map(Some).ok_or_else(|| self.error("the place of a part, or -"))
    }

    /// A joint from its words, in order; any of them may be absent.
    fn joint(&mut self) -> Joint {
        let mut joint = Joint::default();
        for (word, flag) in JOINTS {
            *flag(&mut joint) = self.has(word);
        }
        joint
    }

    /// A span; the span of no block if there is none.
    fn span(&mut self) -> Read<Span> {
        let Some(text) = self.peek().and_then(|word| word.strip_prefix('@')) else { return Ok(Span::default()) };
        self.words.next();
        let parse = || {
            let (bytes, block) = text.split_once('#')?;
            let (start, end) = bytes.split_once("..")?;
            Some(Span { start: start.parse().ok()?, end: end.parse().ok()?, block: block.parse().ok()? })
        };
        parse().ok_or_else(|| self.error("a span @start..end#block"))
    }
}
