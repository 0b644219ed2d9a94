//! Marker of a drawing with classified lines, and the account of its uncut lines.

use super::line::{Class, Closing, Line, RULES, Rule};
use super::marks::Mark;
use super::sheet::Sheet;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Point, Vector, cross, polyline, ring};
use crate::ir::Marker;
use crate::ir::drawing::{Account, Aside, LayerLines, LineClass, Redrawn, Vertex};
use crate::ir::list::{FULL_SPEED, SegmentList};
use crate::ir::marker::{Contour, Drill, Label, Notch, NotchKind, NotchStroke, Piece};

/// Number of the drill that makes the holes.
const DRILL: u8 = 1;

/// Makes the marker.
pub(super) fn marker(mut sheet: Sheet, layers: Vec<LayerLines>, diagnostics: &mut Diagnostics) -> Marker {
    let texts = std::mem::take(&mut sheet.texts);
    let mut making = Making::new(&sheet);
    making.add_notches();
    making.add_holes();
    making.add_contours();
    let texts_outside = making.add_labels(texts);
    if making.work.is_spent() && sheet.nest.ended().is_none() {
        let message = "there are too many lines to find the part of every hole, text and line";
        let finding = Diagnostic::new(&code::DRAWING_SEARCH_ENDED, message);
        diagnostics.push(finding.hint("split the plot, or leave texts out"));
    }
    let Making { list, mut pieces, .. } = making;
    let aside = aside(&sheet);
    let account = Account {
        classes: classes(&sheet.lines),
        layers,
        pen_down: pen_down(&sheet),
        texts_outside,
        aside,
        notches_left_out: Vec::new(),
        pieces_left_out: Vec::new(),
    };
    for (piece, number) in pieces.iter_mut().zip(1..) {
        piece.number = number;
    }
    Marker { list, pieces, unit: sheet.unit, drawing: Some(account), ..Marker::default() }
}

struct Making<'a> {
    sheet: &'a Sheet,
    list: SegmentList,
    pieces: Vec<Piece>,
    /// Closed lines that own pieces, in cut order, and their boxes.
    owners: Vec<usize>,
    boxes: Boxes,
    /// Piece of each line, plus one.
    piece_of: Vec<u32>,
    work: Budget,
}

impl<'a> Making<'a> {
    /// Creates a piece for each part that is cut or contains something, in the order of the file.
    fn new(sheet: &'a Sheet) -> Self {
        let lines = &sheet.lines;
        let owners = owners(sheet);
        let mut piece_of = vec![0; lines.len()];
        owners.iter().zip(1..).for_each(|(&owner, piece)| piece_of[owner] = piece);
        let span = |&i: &usize| Piece { span: lines[i].span(&sheet.vertices), ..Piece::default() };
        let boxes = Boxes::new(owners.iter().map(|&i| lines[i].extent).collect());
        let pieces = owners.iter().map(span).collect();
        let mut list = SegmentList::default();
        let cut = || lines.iter().filter(|line| line.is_cut);
        list.reserve(cut().map(|line| (line.end - line.first) as usize).sum(), cut().count());
        Self { sheet, list, pieces, owners, boxes, piece_of, work: Budget::of_a_marker() }
    }

    fn add_notches(&mut self) {
        let sheet = self.sheet;
        for mark in sheet.marks.iter().filter(|mark| sheet.lines[mark.line].is_cut) {
            let own = self.piece_of[mark.outline].checked_sub(1);
            let piece = own.map_or_else(|| self.piece_around(mark.cut[1], &sheet.lines[mark.line]), |own| own as usize);
            self.pieces[piece].notches.push(notch(mark, sheet));
        }
    }

    fn add_holes(&mut self) {
        for line in self.sheet.lines.iter().filter(|line| line.is_cut && line.class == Class::Hole) {
            let vertices = line.vertices(&self.sheet.vertices);
            let (at, span) = (centroid(vertices), line.span(&self.sheet.vertices));
            let piece = self.piece_around(at, line);
            self.pieces[piece].drills.push(Drill { at, tool: DRILL, span });
        }
    }

    /// Adds contours, with the lines inside a part before its outline.
    fn add_contours(&mut self) {
        let sheet = self.sheet;
        // A notch from edge to edge becomes a part of its outline in a pass, as in every dialect.
        for stroke in sheet.strokes.iter().filter(|stroke| sheet.lines[stroke.line].is_cut) {
            let line = &sheet.lines[stroke.line];
            let own = self.piece_of[stroke.outline].checked_sub(1);
            let piece = own.map_or_else(|| self.piece_around(stroke.tip, line), |own| own as usize);
            self.add_contour(piece, line);
        }
        let is_line =
            |i: &usize| sheet.lines[*i].is_cut && !matches!(sheet.lines[*i].class, Class::Hole | Class::Notch);
        let all: Vec<usize> = (0..sheet.lines.len()).filter(is_line).collect();
        for is_outline in [false, true] {
            for &i in &all {
                if (self.piece_of[i] > 0) != is_outline {
                    continue;
                }
                let line = &sheet.lines[i];
                let owner = sheet.part_around(i).map_or(0, |part| self.piece_of[part]);
                let piece = match (self.piece_of[i].checked_sub(1), owner.checked_sub(1)) {
                    (Some(own), _) => own as usize,
                    (None, Some(part)) => part as usize,
                    (None, None) => self.piece_around(line.vertices(&sheet.vertices)[0].at, line),
                };
                self.add_contour(piece, line);
            }
        }
    }

    fn add_contour(&mut self, piece: usize, line: &Line) {
        let all = &self.sheet.vertices;
        // The retraced part of a line is removed by a pass, as in every dialect.
        let vertices = match line.closing {
            Closing::Drawn | Closing::Bridged(..) | Closing::Gap(_) | Closing::Edge(_) => line.vertices(all),
            Closing::Retraced | Closing::Open(_) => line.as_drawn(all),
        };
        let (points, spans): (Vec<Point>, Vec<_>) = vertices.iter().map(|vertex| (vertex.at, vertex.span)).unzip();
        if let Some(range) = self.list.append_line(&points, &spans) {
            self.pieces[piece].contours.push(Contour { range, closed: points.first() == points.last() });
        }
    }

    /// Piece with the innermost outline around a place; a new one if there is none.
    fn piece_around(&mut self, at: Point, line: &Line) -> usize {
        self.part_around(at).unwrap_or_else(|| {
            self.pieces.push(Piece { span: line.span(&self.sheet.vertices), ..Piece::default() });
            self.pieces.len() - 1
        })
    }

    fn part_around(&mut self, at: Point) -> Option<usize> {
        let lines = &self.sheet.lines;
        let mut best: Option<(f64, usize)> = None;
        if !self.work.spend(self.boxes.cost_at(at)) {
            return None;
        }
        for piece in self.boxes.at(at) {
            let line = &lines[self.owners[piece]];
            let rank = (line.area, piece);
            if best.is_some_and(|best| rank >= best) {
                continue;
            }
            let points = line.points(&self.sheet.vertices);
            if self.work.spend(points.len()) && ring::contains(&points, at) {
                best = Some(rank);
            }
        }
        best.map(|(_, piece)| piece)
    }

    /// Assigns each text to the part in which it stands; returns the number of texts outside of all parts, such as titles.
    fn add_labels(&mut self, texts: Vec<Label>) -> usize {
        let mut outside = 0;
        for text in texts {
            match text.at.and_then(|at| self.part_around(at)) {
                Some(piece) => self.pieces[piece].labels.push(text),
                None => outside += 1,
            }
        }
        outside
    }
}

/// Closed lines that own pieces, in the order of the file: the first owns piece 1.
pub(super) fn owners(sheet: &Sheet) -> Vec<usize> {
    let lines = &sheet.lines;
    let mut owns = vec![false; lines.len()];
    for i in (0..lines.len()).filter(|&i| lines[i].is_cut && lines[i].is_outline()) {
        // A line inside a part that is not cut is a part of its own.
        let part = sheet.part_around(i);
        owns[part.unwrap_or(i)] |= lines[i].class != Class::Hole || part.is_some();
    }
    (0..lines.len()).filter(|&i| owns[i]).collect()
}

/// Notch of a mark.
fn notch(mark: &Mark, sheet: &Sheet) -> Notch {
    let [root, tip] = mark.cut;
    let kind = mark.bar.map_or(NotchKind::Slit, |bar| {
        let vertices = sheet.lines[bar].vertices(&sheet.vertices);
        let last = vertices[vertices.len() - 1];
        NotchKind::T(NotchStroke { from: vertices[0].at, to: last.at, span: last.span })
    });
    let span = sheet.lines[mark.line].vertices(&sheet.vertices)[mark.leg].span;
    Notch { kind, root, tip, percent: FULL_SPEED, span }
}

/// Centroid of a closed line: that of a circle regardless of its chords.
fn centroid(vertices: &[Vertex]) -> Point {
    let origin = vertices[0].at;
    let part = |pair: &[Vertex]| {
        let (a, b) = (pair[0].at - origin, pair[1].at - origin);
        ((a + b) * cross(a, b), cross(a, b))
    };
    let add = |sum: (Vector, f64), part: (Vector, f64)| (sum.0 + part.0, sum.1 + part.1);
    let (sum, doubled) = vertices.windows(2).map(part).fold((Vector::zeros(), 0.0), add);
    origin + sum / (3.0 * doubled)
}

/// Drawn lines that are not cut.
fn aside(sheet: &Sheet) -> Aside {
    let mut aside = Aside { moved: sheet.moved.clone(), ..Aside::default() };
    for line in &sheet.lines {
        let vertices = line.as_drawn(&sheet.vertices);
        if line.is_cut && line.class != Class::Hole && matches!(line.closing, Closing::Gap(_) | Closing::Edge(_)) {
            let ring = line.points(&sheet.vertices);
            aside.moved.closed.push(ring[vertices.len() - 1..].to_vec());
        }
        match (line.is_cut, line.class) {
            // The outline of a hole is drilled, not cut.
            (false, _) | (true, Class::Hole) => aside.add(Some(line.class.rule().name), vertices),
            (true, _) => {}
        }
    }
    // Two legs of one line are both cut.
    for marks in sheet.marks.chunk_by(|a, b| a.line == b.line) {
        // The marker has no places amid the length of a crossbar.
        for bar in marks.iter().filter_map(|mark| mark.bar).filter(|&bar| sheet.lines[bar].is_cut) {
            aside.moved.points += sheet.lines[bar].vertices(&sheet.vertices).len() - 2;
        }
        if let [mark] = marks
            && sheet.lines[mark.line].is_cut
        {
            leave_beside_cut(sheet.lines[mark.line].vertices(&sheet.vertices), mark, &mut aside);
        }
    }
    aside
}

/// Sets the places of a stroke aside that are not part of its cut, if it has more than these two.
fn leave_beside_cut(vertices: &[Vertex], mark: &Mark, aside: &mut Aside) {
    if vertices.len() == 2 {
        return;
    }
    aside.add(None, &vertices[mark.leg..]);
    if mark.leg > 1 {
        aside.moved.points += mark.leg - 1;
        let drawn: Vec<Point> = vertices[..=mark.leg].iter().map(|vertex| vertex.at).collect();
        let now = [drawn[0], drawn[mark.leg]];
        aside.moved.redrawn.push(Redrawn { drawn, now });
    }
}

fn pen_down(sheet: &Sheet) -> f64 {
    let lines = sheet.lines.iter().fold(0.0, |sum, line| sum + line.length);
    let longer = |Redrawn { drawn, now: [from, to] }: &Redrawn| polyline::length(drawn) - (to - from).norm();
    let bridges: f64 = sheet.moved.closed.iter().map(|bridge| polyline::length(bridge)).sum();
    sheet.moved.redrawn.iter().map(longer).fold(lines, |sum, longer| sum + longer) - bridges
}

/// Numbers and lengths of the lines of each class.
fn classes(lines: &[Line]) -> Vec<LineClass> {
    let row = |cut, rule: &Rule| LineClass { name: rule.name, about: rule.about, cut, count: 0, length: 0.0 };
    let mut classes: Vec<LineClass> = RULES.iter().flat_map(|rule| [row(true, rule), row(false, rule)]).collect();
    for line in lines {
        let name = line.class.rule().name;
        if let Some(class) = classes.iter_mut().find(|class| class.cut == line.is_cut && class.name == name) {
            (class.count, class.length) = (class.count + 1, class.length + line.length);
        }
    }
    classes.retain(|class| class.count > 0);
    classes
}
