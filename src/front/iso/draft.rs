//! The marker in the making: what the knife of the file does, gathered into contours, slits and pieces.
//!
//! Files interrupt an outline for slit notches and corner lifts. When the knife goes down where an open chain of the
//! same piece ends, that chain goes on; a map from end points makes that one look-up.

use std::collections::HashMap;

use super::chain::{Chain, Overcut};
use super::lost::{Deferred, Uncut};
use super::vertex::{Vertex, Vertices};
use super::{kept, owner};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Extent, Point, bits};
use crate::ir::list::{FULL_SPEED, Joint, SegmentList};
use crate::ir::marker::{Contour, Drill, Event, Label, Marker, Notch, NotchKind, Piece};
use crate::source::Span;

/// A marker in the making: follows the knife.
#[derive(Debug)]
pub(super) struct Draft {
    state: State,
    /// Where the knife is, mm.
    at: Point,
    /// Asked for by M17, M18 and M46, until obeyed.
    advance: bool,
    no_overcut: bool,
    corner_lift: bool,
    /// Speeds in percent, both until the next piece: M25's and that of M60 to M67.
    slow: u8,
    of_piece: u8,
    /// Both together: the speed of a cut that is made now, percent of the feed.
    percent: u8,
    /// The feed of F, mm/s, from there on.
    feed: Option<f64>,
    /// What happens before the next piece that is cut.
    events: Vec<Event>,
    /// Chains of the pieces that are not finished.
    chains: Vec<Chain>,
    /// Room of those that are, for the next ones: it need not grow again for each.
    room: Vec<Vertices>,
    /// The open ones, by the bits of their end.
    open: HashMap<[u64; 2], usize>,
    /// The piece that N began; `None` in a file without N.
    current: Option<usize>,
    /// In a file without N: what waits for the contour that it belongs to, and the chains that do.
    waiting: Piece,
    strokes: Vec<usize>,
    /// The chain that was left last, strokes not counted.
    left: Option<usize>,
    deferred: Option<Deferred>,
    uncut: Uncut,
    pieces: Vec<Piece>,
    list: SegmentList,
    extent: Extent,
}

#[derive(Debug, Default)]
enum State {
    #[default]
    Up,
    /// Down, and not moved yet.
    Plunged { joint: Joint, span: Span },
    /// Cutting the chain of this index.
    Cutting(usize),
    /// Cutting a slit from its root, which lies on a contour of this piece.
    Slit { points: Vec<Vertex>, piece: Option<usize>, span: Span },
}

impl Draft {
    /// Up, at the origin, with room for so many segments and pieces.
    pub(super) fn with_room(segments: usize, pieces: usize) -> Self {
        let mut list = SegmentList::default();
        list.reserve(segments, 0);
        Self {
            state: State::Up,
            at: Point::origin(),
            advance: false,
            no_overcut: false,
            corner_lift: false,
            slow: FULL_SPEED,
            of_piece: FULL_SPEED,
            percent: FULL_SPEED,
            feed: None,
            events: Vec::new(),
            chains: Vec::new(),
            room: Vec::new(),
            open: HashMap::new(),
            current: None,
            waiting: Piece::default(),
            strokes: Vec::new(),
            left: None,
            deferred: None,
            uncut: Uncut::default(),
            pieces: Vec::with_capacity(pieces),
            list,
            extent: Extent::EMPTY,
        }
    }

    /// Whether it is down.
    pub(super) fn is_down(&self) -> bool {
        !matches!(self.state, State::Up)
    }

    /// Where it is, mm.
    pub(super) fn at(&self) -> Point {
        self.at
    }

    /// A move, mm.
    pub(super) fn go(&mut self, to: Point, span: Span) {
        let percent = self.percent;
        match &mut self.state {
            State::Up if to == self.at => {}
            State::Up => self.uncut.pass(span),
            State::Cutting(chain) => {
                let joint = Joint { lift: std::mem::take(&mut self.corner_lift), ..Joint::default() };
                let chain = &mut self.chains[*chain];
                chain.vertices.push(Vertex { at: to, span, joint, percent });
                if let Some(feed) = self.feed {
                    let piece = chain.piece.expect("what is being cut has a piece");
                    cap(&mut self.pieces[piece], Some(feed));
                }
            }
            State::Slit { points, .. } => points.push(Vertex { at: to, span, joint: Joint::default(), percent }),
            State::Plunged { joint, span: from } => {
                let start = Vertex { at: self.at, span: *from, joint: *joint, percent };
                let joint = Joint { lift: std::mem::take(&mut self.corner_lift), ..Joint::default() };
                let mut vertices = self.room.pop().unwrap_or_default();
                vertices.push(start);
                vertices.push(Vertex { at: to, span, joint, percent });
                let piece = self.piece_of_new_chain(start.span);
                cap(&mut self.pieces[piece], self.feed);
                let piece = Some(piece);
                self.chains.push(Chain { piece, vertices, slit: false, lift: None });
                self.state = State::Cutting(self.chains.len() - 1);
            }
        }
        self.at = to;
    }

    /// Lets `add` add what is cut next: where no code stands between moves, the cut that is being made goes on through
    /// them. Gives the block of its last place; `None` when nothing is cut.
    pub(super) fn cut_on(&mut self, add: impl FnOnce(&mut Vertices)) -> Option<Span> {
        let State::Cutting(chain) = self.state else { return None };
        let vertices = &mut self.chains[chain].vertices;
        let first = vertices.points().len();
        add(vertices);
        vertices.set_speed(first, self.percent);
        let last = vertices.get(vertices.points().len() - 1)?;
        self.at = last.at;
        Some(last.span)
    }

    /// The piece that a chain which begins at `span` belongs to. Without N every contour is a piece.
    fn piece_of_new_chain(&mut self, span: Span) -> usize {
        if let Some(piece) = self.current {
            self.give_events(piece);
            return piece;
        }
        let mut piece = Piece { number: self.pieces.len() as u32 + 1, span, ..std::mem::take(&mut self.waiting) };
        piece.events.append(&mut self.events);
        self.pieces.push(piece);
        self.pieces.len() - 1
    }

    /// What happens before a piece goes to the first one that is begun behind it; inside a piece it waits for the next.
    fn give_events(&mut self, piece: usize) {
        if self.events.is_empty() {
            return;
        }
        let begun = &self.pieces[piece];
        let in_chains = self.chains.iter().rev().any(|chain| chain.piece == Some(piece));
        if !in_chains && begun.notches.is_empty() && begun.drills.is_empty() {
            self.pieces[piece].events.append(&mut self.events);
        }
    }

    /// M25 with its percent, or M26 with full speed.
    pub(super) fn slow(&mut self, percent: u8) {
        self.set_speed(percent, self.of_piece);
    }

    /// M60 to M67.
    pub(super) fn speed_of_piece(&mut self, percent: u8) {
        self.set_speed(self.slow, percent);
    }

    fn set_speed(&mut self, slow: u8, of_piece: u8) {
        (self.slow, self.of_piece) = (slow, of_piece);
        let product = u32::from(slow) * u32::from(of_piece) / u32::from(FULL_SPEED);
        self.percent = product.max(1) as u8;
    }

    /// F, mm/s.
    pub(super) fn feed(&mut self, feed: f64) {
        self.feed = Some(feed);
    }

    /// M01 and M69.
    pub(super) fn event(&mut self, event: Event) {
        self.events.push(event);
    }

    /// M14.
    pub(super) fn down(&mut self, span: Span, out: &mut Diagnostics) {
        self.uncut.settle();
        match &self.state {
            State::Up => {}
            State::Plunged { .. } | State::Cutting(_) => {
                if let Some(deferred) = &mut self.deferred {
                    deferred.refuse(out);
                    deferred.closed_at = None;
                    return;
                }
                let finding = Diagnostic::new(&code::ISO_KNIFE_DOWN_TWICE, "the knife is down already").at(span);
                out.push(finding.hint("an M15 may be missing before it: then two contours are joined by a cut"));
                return;
            }
            State::Slit { .. } => {
                self.report_open_slit("this knife-down", span, out);
                self.end_slit();
            }
        }
        let full_advance = std::mem::take(&mut self.advance);
        // Mostly there is none, and to look for it would take longer than to see that.
        let open = if self.open.is_empty() { None } else { self.open.remove(&bits(self.at)) };
        if let Some(index) = open.or_else(|| self.take_spur()) {
            if self.chains[index].piece.is_none() {
                let start = self.chains[index].start();
                self.chains[index].piece = Some(self.piece_of_new_chain(start));
            }
            let chain = &mut self.chains[index];
            let lift = chain.lift.take();
            let joint = chain.vertices.joint_mut(chain.points().len() - 1);
            joint.lift |= lift.is_some();
            joint.full_advance |= full_advance;
            joint.no_overcut |= lift == Some(Overcut::Forbidden);
            let piece = &mut self.pieces[chain.piece.expect("it was given one")];
            // Without N: what the file holds while it interrupts a contour belongs to that contour.
            piece.drills.append(&mut self.waiting.drills);
            piece.notches.append(&mut self.waiting.notches);
            cap(piece, self.waiting.feed.take());
            if !chain.is_stroke() {
                let piece = chain.piece;
                self.claim_strokes(piece);
            }
            self.state = State::Cutting(index);
        } else {
            self.state = State::Plunged { joint: Joint { full_advance, ..Joint::default() }, span };
        }
    }

    /// M15.
    pub(super) fn up(&mut self, out: &mut Diagnostics) {
        match self.state {
            State::Up => {
                self.uncut.end();
                return;
            }
            State::Plunged { .. } => {
                self.no_overcut = false;
                self.state = State::Up;
            }
            State::Cutting(index) => {
                self.check_deferred(out);
                let overcut = if std::mem::take(&mut self.no_overcut) { Overcut::Forbidden } else { Overcut::Usual };
                self.leave(index, Some(overcut));
            }
            State::Slit { .. } => self.end_slit(),
        }
        self.corner_lift = false;
        if let Some(Deferred { number, span, .. }) = self.deferred.take() {
            self.start_piece(number, span);
        }
    }

    /// Refuses a piece that waits for a lift while the knife cuts what may be its outline.
    fn check_deferred(&self, out: &mut Diagnostics) {
        if let (State::Cutting(chain), Some(deferred)) = (&self.state, &self.deferred)
            && deferred.leads_on(&self.chains[*chain])
        {
            deferred.refuse(out);
        }
    }

    /// The knife leaves the chain, by a lift that is meant or (`None`) for a slit. One that closed on itself is finished;
    /// any other may go on where it ends.
    fn leave(&mut self, index: usize, lift: Option<Overcut>) {
        let chain = &mut self.chains[index];
        chain.lift = lift;
        let (first, last) = chain.ends();
        let piece = chain.piece;
        let is_stroke = chain.is_stroke();
        if first != last || chain.is_point() {
            self.open.insert(bits(last), index);
        }
        self.state = State::Up;
        if !is_stroke {
            self.left = Some(index);
            self.claim_strokes(piece);
        } else if self.current.is_none() {
            self.let_wait(index);
        }
    }

    /// In a file without N a stroke is no piece: it belongs to the contour that it interrupts, or to the next one, as
    /// slits and drills do. (Whether it is a slit is for the passes to tell.)
    fn let_wait(&mut self, index: usize) {
        let chain = &mut self.chains[index];
        let begun = self.pieces.pop_if(|piece| piece.span == chain.start());
        if let Some(mut piece) = begun {
            self.events.splice(..0, piece.events.drain(..));
            self.waiting = piece;
            chain.piece = None;
            self.strokes.push(index);
        }
    }

    /// Gives the strokes that wait to a piece.
    fn claim_strokes(&mut self, piece: Option<usize>) {
        for index in self.strokes.drain(..) {
            // One that the knife went on from is a contour of its own by now.
            self.chains[index].piece = self.chains[index].piece.or(piece);
        }
    }

    /// A slit whose M19 is lost: the knife went on from here to a near place and came back through the air. Takes the slit
    /// off its chain, which goes on from here.
    fn take_spur(&mut self) -> Option<usize> {
        let index = self.left?;
        let chain = &mut self.chains[index];
        let before = chain.points().len().checked_sub(2).filter(|&before| before > 0)?;
        let (root, tip) = chain.vertices.get(before).zip(chain.vertices.get(before + 1))?;
        if root.at != self.at || root.at == tip.at || (tip.at - root.at).norm() > Notch::LONGEST {
            return None;
        }
        // One that closed, or went on meanwhile, is not waiting.
        self.open.get(&bits(tip.at)).filter(|&&open| open == index)?;
        self.open.remove(&bits(tip.at));
        chain.vertices.pop();
        chain.lift = None;
        let notch = Notch { kind: NotchKind::Slit, root: root.at, tip: tip.at, percent: tip.percent, span: tip.span };
        self.pieces[chain.piece?].notches.push(notch);
        Some(index)
    }

    /// M19.
    pub(super) fn slit(&mut self, span: Span) {
        let piece = match self.state {
            State::Up => {
                (self.advance, self.no_overcut) = (true, true);
                return;
            }
            State::Slit { .. } => return,
            State::Plunged { .. } => None,
            State::Cutting(index) => {
                self.leave(index, None);
                self.chains[index].piece
            }
        };
        let root = Vertex { at: self.at, span, joint: Joint::default(), percent: self.percent };
        self.state = State::Slit { points: vec![root], piece, span };
    }

    fn report_open_slit(&self, before: &str, at: Span, out: &mut Diagnostics) {
        if let State::Slit { span, .. } = &self.state {
            let message = format!("the slit that begins in block {} has no M15 before {before}", span.block);
            let finding = Diagnostic::new(&code::ISO_OPEN_SLIT, message).at(at);
            out.push(finding.hint("an M15 belongs behind the tip of a slit; one may be lost"));
        }
    }

    /// Ends a slit: a straight one is a notch, any other an open contour.
    fn end_slit(&mut self) {
        (self.advance, self.no_overcut) = (false, false);
        let State::Slit { mut points, piece, .. } = std::mem::take(&mut self.state) else { return };
        // One that goes nowhere is kept as it stands in the file: dropping it is for the passes, which say so.
        let damaged = points.len() > 1 && points.iter().all(|vertex| bits(vertex.at) == bits(points[0].at));
        if damaged {
            points.truncate(2);
        } else {
            points.dedup_by_key(|vertex| bits(vertex.at));
        }
        match points[..] {
            [] | [_] => {}
            [root, tip] => {
                let percent = tip.percent;
                let notch = Notch { kind: NotchKind::Slit, root: root.at, tip: tip.at, percent, span: tip.span };
                if let Some(piece) = piece.or(self.current) {
                    self.give_events(piece);
                }
                let feed = self.feed;
                let target = match piece {
                    Some(piece) => &mut self.pieces[piece],
                    None => self.target(),
                };
                cap(target, feed);
                target.notches.push(notch);
            }
            [first, ..] => {
                let piece = Some(piece.unwrap_or_else(|| self.piece_of_new_chain(first.span)));
                for vertex in &mut points {
                    vertex.joint.no_overcut = true;
                }
                points[0].joint.full_advance = true;
                let lift = Some(Overcut::Forbidden);
                self.chains.push(Chain { piece, vertices: points.into_iter().collect(), slit: true, lift });
            }
        }
    }

    /// M17.
    pub(super) fn full_advance(&mut self) {
        self.advance = true;
    }

    /// The place where it is, in the air, is that of a label.
    pub(super) fn settle(&mut self) {
        self.uncut.settle();
    }

    /// M18.
    pub(super) fn no_overcut(&mut self) {
        self.no_overcut = true;
    }

    /// M46.
    pub(super) fn corner_lift(&mut self) {
        self.corner_lift = true;
    }

    /// A hole, with the knife up.
    pub(super) fn drill(&mut self, at: Point, tool: u8, span: Span) {
        if let Some(piece) = self.current {
            self.give_events(piece);
        }
        self.uncut.settle();
        self.target().drills.push(Drill { at, tool, span });
    }

    /// A text.
    pub(super) fn label(&mut self, label: Label) -> LabelId {
        self.uncut.settle();
        let piece = self.current;
        let labels = &mut self.target().labels;
        // Most pieces have one, and a vector begins with room for four.
        labels.reserve_exact(usize::from(labels.is_empty()));
        labels.push(label);
        LabelId { piece, index: labels.len() - 1 }
    }

    /// The last label that was added with that id, as long as no other piece began.
    pub(super) fn label_mut(&mut self, id: LabelId) -> Option<&mut Label> {
        if id.piece != self.current {
            return None;
        }
        self.target().labels.get_mut(id.index)
    }

    /// Where notches, drills and labels go.
    fn target(&mut self) -> &mut Piece {
        match self.current {
            Some(piece) => &mut self.pieces[piece],
            None => &mut self.waiting,
        }
    }

    /// N. With the knife down it takes effect at the next lift: controllers insert some.
    pub(super) fn begin_piece(&mut self, number: Option<u32>, span: Span, out: &mut Diagnostics) {
        match &self.state {
            State::Up => {}
            State::Plunged { .. } => {
                self.deferred = Some(Deferred::new(number, span, None));
                return;
            }
            &State::Cutting(chain) => {
                self.check_deferred(out);
                self.deferred = Some(Deferred::new(number, span, Some(&self.chains[chain])));
                return;
            }
            State::Slit { .. } => {
                self.report_open_slit("this piece", span, out);
                self.end_slit();
            }
        }
        self.start_piece(number, span);
    }

    /// A piece ends. Where something is cut of it, a way in the air behind that may lead anywhere.
    fn end_piece(&mut self) {
        let is_empty = |piece: usize| self.pieces[piece].notches.is_empty() && self.pieces[piece].drills.is_empty();
        if self.chains.is_empty() && self.current.is_some_and(is_empty) {
            self.uncut.end();
        }
        self.uncut.settle();
    }

    fn start_piece(&mut self, number: Option<u32>, span: Span) {
        self.end_piece();
        (self.advance, self.no_overcut) = (false, false);
        self.set_speed(FULL_SPEED, FULL_SPEED);
        let waiting = std::mem::take(&mut self.waiting);
        let number = number.unwrap_or(self.pieces.len() as u32 + 1);
        self.pieces.push(Piece { number, span, ..waiting });
        self.current = Some(self.pieces.len() - 1);
        self.claim_strokes(self.current);
        self.finish_chains();
    }

    /// Writes the chains into the list: first the slits, as they are cut before the outlines.
    fn finish_chains(&mut self) {
        self.open.clear();
        self.left = None;
        for slit in [true, false] {
            for chain in self.chains.iter_mut().filter(|chain| chain.slit == slit && !chain.is_point()) {
                let (first, last) = chain.ends();
                if let Some(range) = chain.write(&mut self.list) {
                    self.extent.join(&self.list.extent(range));
                    let piece = chain.piece.expect("every stroke was claimed");
                    let contours = &mut self.pieces[piece].contours;
                    // Most pieces have one.
                    contours.reserve_exact(usize::from(contours.is_empty()));
                    contours.push(Contour { range, closed: first == last });
                }
            }
        }
        for Chain { mut vertices, .. } in self.chains.drain(..) {
            vertices.clear();
            self.room.push(vertices);
        }
    }

    /// The end of the file: what was cut, and the box around it. (The box that a marker can give of itself would cost
    /// another walk over all segments.) Its numbers are multiples of `unit` mm.
    pub(super) fn finish(mut self, last: Span, unit: f64, out: &mut Diagnostics) -> (Marker, Extent) {
        match &self.state {
            State::Up => {}
            State::Slit { .. } => self.report_open_slit("the end of the file", last, out),
            State::Plunged { .. } | State::Cutting(_) => {
                let message = "the knife is down where the file ends";
                let finding = Diagnostic::new(&code::ISO_ENDS_KNIFE_DOWN, message).at(last);
                out.push(finding.hint("the file is most likely cut short; export it again"));
            }
        }
        self.end_piece();
        self.uncut.report(out);
        self.check_deferred(out);
        self.deferred = None;
        self.up(out);
        let Piece { drills, notches, labels, .. } = &self.waiting;
        if !(drills.is_empty() && notches.is_empty() && labels.is_empty() && self.strokes.is_empty()) {
            let mut waiting = std::mem::take(&mut self.waiting);
            if let Some(piece) = self.pieces.last_mut() {
                piece.drills.append(&mut waiting.drills);
                piece.notches.append(&mut waiting.notches);
                piece.labels.append(&mut waiting.labels);
                cap(piece, waiting.feed);
            } else {
                self.pieces.push(Piece { number: 1, ..waiting });
            }
            self.claim_strokes(Some(self.pieces.len() - 1));
        }
        self.finish_chains();
        for piece in &self.pieces {
            piece.notches.iter().flat_map(|notch| [notch.root, notch.tip]).for_each(|at| self.extent.add(at));
            piece.drills.iter().for_each(|drill| self.extent.add(drill.at));
        }
        if self.current.is_none() {
            owner::settle(&self.list, &mut self.pieces, unit, out);
        }
        let mut closing = Vec::new();
        kept::drop_empty(&mut self.pieces, &mut closing);
        closing.append(&mut self.events);
        (Marker { list: self.list, pieces: self.pieces, unit, closing, ..Marker::default() }, self.extent)
    }
}

/// A piece is cut at the least feed in force while any of it is cut.
fn cap(piece: &mut Piece, feed: Option<f64>) {
    if let Some(feed) = feed {
        piece.feed = Some(piece.feed.map_or(feed, |before| before.min(feed)));
    }
}

/// Names a label of the piece that is being read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct LabelId {
    piece: Option<usize>,
    index: usize,
}
