//! Conversion of a pattern set to a marker of its cuts, and to a drawing of all lines by layer.

use super::chain::Chain;
use super::lay::{Laid, Motion};
use super::layer::{CUT_OUT, LAYERS, Layer, OTHER, OUTLINE};
use super::set::Set;
use crate::geom::polyline;
use crate::ir::drawing::{Account, LineClass, Unread, Vertex};
use crate::ir::list::SegmentList;
use crate::ir::marker::{Contour, Drill, Label, Notch, NotchKind, NotchStroke, Piece};
use crate::ir::{Drawing, Marker};
use crate::source::Span;

/// Number of the drill for holes.
const DRILL: u8 = 1;

/// The marker of a set: inner lines of a piece come first, its outline last.
pub(super) fn marker(set: &Set) -> Marker {
    let mut marker = Marker { letters: set.letters, ..Marker::default() };
    let mut account = Account { classes: classes(), ..Account::default() };
    for (laid, number) in set.laid().iter().zip(1..) {
        marker.pieces.push(piece(laid, number, &mut marker.list, &mut account));
    }
    account.texts_outside = set.texts.len();
    account.classes.retain(|class| class.count > 0);
    account.pen_down = account.classes.iter().map(|class| class.length).sum();
    Marker { drawing: Some(account), ..marker }
}

/// A laid piece.
fn piece(laid: &Laid, number: u32, list: &mut SegmentList, account: &mut Account) -> Piece {
    let Laid { piece, motion } = *laid;
    let mut made = Piece { number, span: piece.span, ..Piece::default() };
    if piece.is_at_fault() {
        account.pieces_left_out.push(piece.span);
        return made;
    }
    made.drills.extend(piece.drills.iter().map(|&(at, span)| Drill { at: motion.place(at), tool: DRILL, span }));
    let left_out = piece.doubts.iter().filter(|doubt| doubt.leaves_out());
    account.notches_left_out.extend(left_out.map(|doubt| doubt.span));
    made.notches.extend(piece.slits.iter().map(|slit| moved_notch(slit, motion)));
    let inner = piece.inner.iter().map(|line| (CUT_OUT, line));
    for (layer, line) in inner.chain([(OUTLINE, &piece.outline)]) {
        let vertices = moved(line, motion);
        let (points, spans): (Vec<_>, Vec<Span>) = vertices.iter().map(|vertex| (vertex.at, vertex.span)).unzip();
        see(account, layer, true, &vertices);
        let range = list.append_line(&points, &spans);
        made.contours.extend(range.map(|range| Contour { range, closed: line.is_closed }));
    }
    for (layer, line) in &piece.drawn {
        let vertices = moved(line, motion);
        see(account, layer, false, &vertices);
        account.aside.add(Some(layer.name), &vertices);
    }
    made.labels.extend(piece.labels.iter().map(|label| moved_label(label, motion)));
    made
}

/// One class per layer for cut lines, and one for other lines.
fn classes() -> Vec<LineClass> {
    let row = |layer: &Layer, cut| LineClass { name: layer.name, about: layer.about, cut, count: 0, length: 0.0 };
    let all = || LAYERS.iter().chain([&OTHER]);
    all().map(|layer| row(layer, true)).chain(all().map(|layer| row(layer, false))).collect()
}

/// Counts a line of a layer.
fn see(account: &mut Account, layer: &Layer, cut: bool, vertices: &[Vertex]) {
    let points: Vec<_> = vertices.iter().map(|vertex| vertex.at).collect();
    let is_of = |class: &&mut LineClass| class.cut == cut && class.name == layer.name;
    if let Some(class) = account.classes.iter_mut().find(is_of) {
        (class.count, class.length) = (class.count + 1, class.length + polyline::length(&points));
    }
}

/// The vertices of a laid line; those of a closed line end with the first one again.
fn moved(line: &Chain, motion: Motion) -> Vec<Vertex> {
    line.round().map(|vertex| Vertex { at: motion.place(vertex.at), ..vertex }).collect()
}

fn moved_notch(notch: &Notch, motion: Motion) -> Notch {
    let kind = match notch.kind {
        NotchKind::Slit => NotchKind::Slit,
        NotchKind::T(bar) => {
            NotchKind::T(NotchStroke { from: motion.place(bar.from), to: motion.place(bar.to), ..bar })
        }
    };
    Notch { kind, root: motion.place(notch.root), tip: motion.place(notch.tip), ..*notch }
}

fn moved_label(label: &Label, motion: Motion) -> Label {
    Label {
        at: label.at.map(|at| motion.place(at)),
        heading: label.heading.map(|heading| motion.heading(heading)),
        ..label.clone()
    }
}

/// The drawing of all laid lines, with layers as pens.
pub(super) fn drawing(set: &Set) -> Drawing {
    let mut drawing = Drawing::default();
    let mut draw = |name: &str, line: &Chain, motion: Motion| {
        let pen = drawing.pen(name, true);
        let mut vertices = moved(line, motion).into_iter();
        vertices.next().into_iter().for_each(|first| drawing.begin(first.at, first.span, pen));
        vertices.for_each(|vertex| drawing.line(vertex.at, vertex.span));
        drawing.lift();
    };
    let [cut_out, outline] = [CUT_OUT, OUTLINE].map(|layer| layer.number.to_string());
    for Laid { piece, motion } in set.laid().into_iter().filter(|laid| !laid.piece.is_at_fault()) {
        piece.inner.iter().for_each(|line| draw(&cut_out, line, motion));
        draw(&outline, &piece.plain, motion);
        piece.drawn.iter().for_each(|(layer, line)| draw(set.names.of(*layer), line, motion));
    }
    set.apart.iter().for_each(|(layer, line)| draw(set.names.of(*layer), line, Motion::STILL));
    for entity in &set.unread {
        let pen = drawing.pen(&entity.pen, true);
        drawing.unread.push(Unread { kind: entity.kind.clone(), pen, span: entity.span });
    }
    drawing
}
