//! The marker under construction: the motions of the knife are assembled into contours, slits and pieces.
//!
//! Files interrupt an outline for slit notches and corner lifts. If the knife plunges at the end of an open chain of the same
//! piece, that chain continues; a map from end points to chains makes this a single look-up.

pub(super) mod look;

use std::collections::HashMap;

use super::chain::{Chain, Overcut};
use super::lost::{self, Deferred, Uncut};
use super::vertex::{Vertex, Vertices};
use super::{kept, owner};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Extent, Point, bits};
use crate::ir::list::{FULL_SPEED, Joint, SegmentList};
use crate::ir::marker::{Contour, Drill, Event, Label, Marker, Notch, NotchKind, Piece};
use crate::source::Span;

/// A marker under construction, driven by the motions of the knife.
#[derive(Debug)]
pub(super) struct Draft {
    state: State,
    /// Position of the knife, mm.
    at: Point,
    /// Pending requests of M17, M18 and M46.
    advance: bool,
    no_overcut: bool,
    corner_lift: bool,
    /// Speeds in percent, valid until the next piece: that of M25 and that of M60 to M67.
    slow: u8,
    of_piece: u8,
    /// Product of both: the current cutting speed, percent of the feed.
    percent: u8,
    /// The feed set by F, mm/s.
    feed: Option<f64>,
    /// Events before the next piece with a cut.
    events: Vec<Event>,
    /// Chains of the unfinished pieces.
    chains: Vec<Chain>,
    /// Vertex buffers of finished chains, kept for reuse.
    room: Vec<Vertices>,
    /// Open chains, by the bits of their end point.
    open: HashMap<[u64; 2], usize>,
    /// The piece begun by N; `None` in a file without N.
    current: Option<usize>,
    /// For a file without N: items that wait for their contour, and the waiting chains.
    waiting: Piece,
    strokes: Vec<usize>,
    /// The chain left last, ignoring strokes.
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
    /// Down, without a motion since.
    Plunged { joint: Joint, span: Span },
    /// Cutting the chain with this index.
    Cutting(usize),
    /// Cutting a slit from its root, which lies on a contour of this piece.
    Slit { points: Vec<Vertex>, piece: Option<usize>, span: Span },
}

impl Draft {
    /// A raised knife at the origin, with capacity for a number of segments and pieces.
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

    /// True if the knife is down.
    pub(super) fn is_down(&self) -> bool {
        !matches!(self.state, State::Up)
    }

    /// True if an open chain ends at the knife.
    pub(super) fn is_at_open_end(&self) -> bool {
        self.open.contains_key(&bits(self.at))
    }

    /// Moves the knife to a point, mm.
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

    /// Continues the current cut: `add` appends vertices between which no code stands. Returns the block of the last point;
    /// `None` if the knife is not cutting.
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

    /// The piece of a chain that begins at `span`. Without N every contour is a piece.
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

    /// Moves pending events to a piece if it is still empty. Events inside a piece wait for the next one.
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

    /// Records an event (M01, M69).
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
        // The map is mostly empty, and this check is faster than a look-up.
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
            // Without N, items in the file while it interrupts a contour belong to that contour.
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
                self.uncut.end(self.current.map(|piece| self.pieces[piece].number));
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
            State::Slit { ref points, span, .. } => {
                if let Some(finding) = lost::empty_slit(points.len(), span) {
                    out.push(finding);
                }
                self.end_slit();
            }
        }
        self.corner_lift = false;
        if let Some(Deferred { number, span, .. }) = self.deferred.take() {
            self.start_piece(number, span);
        }
    }

    /// Reports a piece that waits for a lift while the knife continues on its possible outline.
    fn check_deferred(&self, out: &mut Diagnostics) {
        if let (State::Cutting(chain), Some(deferred)) = (&self.state, &self.deferred)
            && deferred.leads_on(&self.chains[*chain])
        {
            deferred.refuse(out);
        }
    }

    /// Ends cutting a chain, by an explicit lift or (`None`) for a slit. A closed chain is finished; any other may be continued
    /// at its end.
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

    /// In a file without N a stroke is not a piece: it belongs to the contour that it interrupts, or to the next one, as slits
    /// and drills do. (The passes decide whether it is a slit.)
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

    /// Assigns the waiting strokes to a piece.
    fn claim_strokes(&mut self, piece: Option<usize>) {
        for index in self.strokes.drain(..) {
            // A stroke that the knife has continued is a contour of its own.
            self.chains[index].piece = self.chains[index].piece.or(piece);
        }
    }

    /// Handles a slit with a lost M19: the knife left this point for a near one and returned in the air. Removes the slit from
    /// its chain, which continues from here.
    fn take_spur(&mut self) -> Option<usize> {
        let index = self.left?;
        let chain = &mut self.chains[index];
        let before = chain.points().len().checked_sub(2).filter(|&before| before > 0)?;
        let (root, tip) = chain.vertices.get(before).zip(chain.vertices.get(before + 1))?;
        if root.at != self.at || root.at == tip.at || (tip.at - root.at).norm() > Notch::LONGEST {
            return None;
        }
        // A chain that was closed or continued is no longer waiting.
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
            out.push(lost::open_slit(*span, before, at));
        }
    }

    /// Ends a slit: a straight one becomes a notch, any other an open contour.
    fn end_slit(&mut self) {
        (self.advance, self.no_overcut) = (false, false);
        let State::Slit { mut points, piece, .. } = std::mem::take(&mut self.state) else { return };
        // A slit of no length is kept as in the file; a pass drops and reports it.
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

    /// Marks the current position in the air as that of a label.
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

    /// Adds a hole; the knife is up.
    pub(super) fn drill(&mut self, at: Point, tool: u8, span: Span) {
        if let Some(piece) = self.current {
            self.give_events(piece);
        }
        self.uncut.settle();
        self.target().drills.push(Drill { at, tool, span });
    }

    /// Adds a text.
    pub(super) fn label(&mut self, label: Label) -> LabelId {
        self.uncut.settle();
        let piece = self.current;
        let labels = &mut self.target().labels;
        // Most pieces have one label, and a vector starts with a capacity of four.
        labels.reserve_exact(usize::from(labels.is_empty()));
        labels.push(label);
        LabelId { piece, index: labels.len() - 1 }
    }

    /// The label with an id, as long as no other piece has begun.
    pub(super) fn label_mut(&mut self, id: LabelId) -> Option<&mut Label> {
        if id.piece != self.current {
            return None;
        }
        self.target().labels.get_mut(id.index)
    }

    /// The piece that receives notches, drills and labels.
    fn target(&mut self) -> &mut Piece {
        match self.current {
            Some(piece) => &mut self.pieces[piece],
            None => &mut self.waiting,
        }
    }

    /// Begins a piece (N). While the knife is down this is deferred to the next lift: controllers insert some.
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

    /// Ends a piece. If the piece has a cut, moves in the air after it may lead anywhere.
    fn end_piece(&mut self) {
        let is_empty = |piece: usize| self.pieces[piece].notches.is_empty() && self.pieces[piece].drills.is_empty();
        if self.chains.is_empty() && self.current.is_some_and(is_empty) {
            self.uncut.end(self.current.map(|piece| self.pieces[piece].number));
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

    /// Writes the chains into the list, the slits first, because they are cut before the outlines.
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
                    // Most pieces have one contour.
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

    /// Ends the file and returns the marker and its bounding box. (Computing the box from the marker would cost another pass
    /// over all segments.) Its coordinates are multiples of `unit` mm.
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

/// Limits the feed of a piece, which is cut at the minimum of the feeds in force during its cuts.
fn cap(piece: &mut Piece, feed: Option<f64>) {
    if let Some(feed) = feed {
        piece.feed = Some(piece.feed.map_or(feed, |before| before.min(feed)));
    }
}

/// Identifies a label of the current piece.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct LabelId {
    piece: Option<usize>,
    index: usize,
}
