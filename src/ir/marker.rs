//! Content of the file, in mm: the pieces as they are drawn on the cloth, and the cuts of the knife.

use std::borrow::Cow;

pub use super::label::Label;

use super::drawing::Account;
use super::list::{Range, SegmentList};
use super::toolpath;
use crate::geom::{Extent, Point, Vector};
use crate::machine::labels::Labels;
use crate::machine::letters::Letters;
use crate::source::Span;

/// A whole cutter file.
#[derive(Debug, Clone, Default)]
pub struct Marker {
    /// Segments of all contours and cuts.
    pub list: SegmentList,
    /// Pieces in cut order.
    pub pieces: Vec<Piece>,
    /// Cuts of the knife in order, grouped by piece in the order of the pieces; empty before the pass `cut`.
    pub cuts: Vec<Cut>,
    /// Edges that two parts have in common and that are cut once.
    pub common: Vec<CommonEdge>,
    /// Length that common edges save compared with cutting every part all round, mm.
    pub spared: f64,
    /// Edges of parts beside edges of other parts, so near that a thin strip remains between two cuts.
    pub near: Vec<NearEdge>,
    /// Places where cuts of several parts must cross: lines from the end of the own outline of a cut to its end across another
    /// part's cut, mm; zero length where two cuts cross as drawn.
    pub junctions: Vec<[Point; 2]>,
    /// Grid to which the file rounds, mm, scaled as the marker on the table; 0 when there is none.
    pub unit: f64,
    /// Advance of the cloth before a program begins, mm.
    pub moved_on: u32,
    /// Events after the last piece.
    pub closing: Vec<Event>,
    /// Encoding of its texts, if the file declares one; `None` = the encoding of the profile.
    pub letters: Option<Letters>,
    /// For a drawing, the classification of all of its lines.
    pub drawing: Option<Account>,
}

/// A piece of the garment, or an object that the file calls a piece.
#[derive(Debug, Clone, Default)]
pub struct Piece {
    /// Its number in the file (N), or its index in the order, from 1.
    pub number: u32,
    /// Number of the copy of the marker that it belongs to, from 1; 0 if there is only one.
    pub copy: u32,
    /// Its start in the source.
    pub span: Span,
    /// Holes, in cut order.
    pub drills: Vec<Drill>,
    /// Notches, in cut order; they are cut before the contours.
    pub notches: Vec<Notch>,
    /// Contours, in cut order.
    pub contours: Vec<Contour>,
    /// Notches that the contours make, in contour order: the contours cut them, entries of this list cut nothing.
    pub outline_notches: Vec<OutlineNotch>,
    /// Texts.
    pub labels: Vec<Label>,
    /// Events before the piece is cut, in order.
    pub events: Vec<Event>,
    /// Speed of the tip that the file asks for, mm/s: the least one asked for within the piece; `None` = the profile alone
    /// limits the speed.
    pub feed: Option<f64>,
    /// Fields of the piece in the file's list of labels, in the file's order.
    pub fields: Vec<Field>,
    /// Stretch along X, mm, in which the outline is cut with this section, where windows of a conveyor split the piece; `None`
    /// = it is cut whole. The last section of a piece holds its outline and its texts; each section holds the inner contours,
    /// slits and holes in its stretch.
    pub section: Option<[f64; 2]>,
}

/// Something for the controller or the operator, between two pieces: the knife is up and the axes rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Event {
    /// Its kind.
    pub kind: toolpath::Event,
    /// Its place in the source.
    pub span: Span,
}

/// A field of a piece in the file's list of labels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Field {
    /// Its name, an upper-case letter.
    pub letter: u8,
    /// The bytes of its value in the source.
    pub span: Span,
}

/// A line that the knife cuts in one go, as far as the drawing tells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cut {
    /// Its role in the part that it cuts.
    pub kind: CutKind,
    /// Index in the marker of the piece that it is cut with.
    pub piece: u32,
    /// Parts on its left and on its right, by the indices of the pieces of their outlines; `None` = waste.
    pub sides: [Option<u32>; 2],
    /// Its segments: those of a contour if that is cut as drawn.
    pub range: Range,
}

/// An edge that two parts have in common and that is cut once, with the part that comes first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CommonEdge {
    /// Indices in the marker of the piece with which it is cut, and of the piece that is spared it.
    pub pieces: [u32; 2],
    /// The edge as part of the outline of the spared piece.
    pub range: Range,
    /// Greatest distance of the edge from its cut, mm.
    pub shift: f64,
}

/// A straight stretch of a cut around a part, beside a cut around another part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearEdge {
    /// Index in the marker of the piece that it is cut with.
    pub piece: u32,
    /// The ends of the stretch, in the direction of the cut.
    pub ends: [Point; 2],
}

/// Role of a cut in the part that it cuts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CutKind {
    /// The closed line around it.
    Outline,
    /// The closed line around a cut-out of it.
    Inner,
    /// A stretch of an outline or a cut-out: the rest is cut with other parts, or is a notch on an edge that is cut straight
    /// through.
    Edge,
    /// A stroke of a notch.
    Slit,
    /// A line that does not close.
    Line,
}

impl CutKind {
    /// True if it ends at its start.
    pub fn is_closed(self) -> bool {
        match self {
            Self::Outline | Self::Inner => true,
            Self::Edge | Self::Slit | Self::Line => false,
        }
    }
}

/// A line of a piece, as drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contour {
    /// Its segments.
    pub range: Range,
    /// True if it ends at its start.
    pub closed: bool,
}

/// A short cut that marks a place on the seam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Notch {
    /// Its shape.
    pub kind: NotchKind,
    /// Its start on the outline.
    pub root: Point,
    /// Its innermost point.
    pub tip: Point,
    /// Its speed in percent of the speed of the piece, 1 to 100.
    pub percent: u8,
    /// Its place in the source.
    pub span: Span,
}

/// Shape of a notch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NotchKind {
    /// One straight cut from the edge into the part.
    Slit,
    /// A slit, and a crossbar over its tip.
    T(NotchStroke),
}

/// A straight cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NotchStroke {
    /// Start point.
    pub from: Point,
    /// End point.
    pub to: Point,
    /// Source of its end point.
    pub span: Span,
}

impl NotchStroke {
    /// Length, mm.
    pub fn length(&self) -> f64 {
        (self.to - self.from).norm()
    }
}

impl Notch {
    /// Longest slit, and longest crossbar, mm: cutters punch notches 3 to 12 mm deep, and lines inside parts are longer.
    pub const LONGEST: f64 = 15.0;
    /// Longest stroke from edge to edge that is a notch, mm: there and back, and the same length across.
    pub const LONGEST_STROKE: f64 = 4.0 * Self::LONGEST;
    /// Widest mouth, mm.
    pub const WIDEST: f64 = 12.0;
    /// Greatest number of notches that touch each other in one stroke.
    pub const MOST_TOUCHING: usize = 3;
    /// Greatest distance from its edge at which a stroke of a notch may begin, mm, beside rounding: CAD programs miss the edge
    /// by some units.
    pub const MISS: f64 = 0.5;

    /// Depth in the part, mm.
    pub fn depth(&self) -> f64 {
        (self.tip - self.root).norm()
    }

    /// Its cuts in their order: from the edge inwards, then the crossbar if it has one.
    pub fn strokes(&self) -> impl Iterator<Item = NotchStroke> + use<> {
        let stem = NotchStroke { from: self.root, to: self.tip, span: self.span };
        let bar = match self.kind {
            NotchKind::Slit => None,
            NotchKind::T(bar) => Some(bar),
        };
        std::iter::once(stem).chain(bar)
    }
}

/// A notch that an outline makes: the outline goes into the part and back, or out of it and back, and cuts the notch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutlineNotch {
    /// Its form.
    pub form: NotchForm,
    /// True if it protrudes from the part.
    pub outwards: bool,
    /// The two points of the edge between which it opens, in the order of the outline.
    pub mouth: [Point; 2],
    /// The middle of its bottom; the apex of a V.
    pub tip: Point,
    /// Number of segments of the outline from one end of the mouth to the other.
    pub segments: u32,
    /// Place of its tip in the source.
    pub span: Span,
}

/// Form of a notch that an outline makes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum NotchForm {
    /// Two legs that meet.
    V,
    /// A rectangle.
    Castle,
    /// A round bottom, between straight sides or alone.
    U,
}

impl OutlineNotch {
    /// From the middle of the mouth to the tip, mm.
    pub fn depth(&self) -> f64 {
        (self.tip - self.root()).norm()
    }

    /// Width of the mouth, mm.
    pub fn width(&self) -> f64 {
        (self.mouth[1] - self.mouth[0]).norm()
    }

    /// The middle of the mouth.
    pub fn root(&self) -> Point {
        self.mouth[0] + (self.mouth[1] - self.mouth[0]) / 2.0
    }

    /// Unit vector from the edge into the part, for notches in either direction.
    pub fn inwards(&self) -> Vector {
        let along = (self.tip - self.root()) / self.depth();
        if self.outwards { -along } else { along }
    }

    /// Word for lists: its form, and `-out` if it protrudes.
    pub fn word(&self) -> &'static str {
        match (self.form, self.outwards) {
            (NotchForm::V, false) => "v",
            (NotchForm::V, true) => "v-out",
            (NotchForm::Castle, false) => "castle",
            (NotchForm::Castle, true) => "castle-out",
            (NotchForm::U, false) => "u",
            (NotchForm::U, true) => "u-out",
        }
    }
}

/// A hole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drill {
    /// Its centre.
    pub at: Point,
    /// Number of the drill, 1 to 4.
    pub tool: u8,
    /// Its place in the source.
    pub span: Span,
}

impl Piece {
    /// Name for lists and pictures: its number, and after a slash the copy of the marker if there are several.
    pub fn name(&self) -> String {
        let Self { number, copy, .. } = self;
        if *copy == 0 { number.to_string() } else { format!("{number}/{copy}") }
    }

    /// Place on the table of one of its points after the cloth has advanced `station` mm; X is limited to the stretch of a
    /// section.
    pub fn on_table(&self, at: Point, station: u32) -> Point {
        let x = self.section.map_or(at.x, |[from, to]| at.x.clamp(from, to));
        Point::new(x - f64::from(station), at.y)
    }

    /// True if both are the same piece, or sections of the same piece.
    pub fn is_of(&self, other: &Self) -> bool {
        (self.number, self.copy, self.span) == (other.number, other.copy, other.span)
    }

    /// Every place of its drill holes and its notches; the places of its contours are in the segment list.
    pub fn places_mut(&mut self) -> impl Iterator<Item = &mut Point> {
        let drills = self.drills.iter_mut().map(|drill| &mut drill.at);
        let notches = self.notches.iter_mut().flat_map(|Notch { root, tip, kind, .. }| {
            let bar = match kind {
                NotchKind::Slit => None,
                NotchKind::T(bar) => Some([&mut bar.from, &mut bar.to]),
            };
            [root, tip].into_iter().chain(bar.into_iter().flatten())
        });
        let drawn = self.outline_notches.iter_mut();
        drills.chain(notches).chain(drawn.flat_map(|notch| notch.mouth.iter_mut().chain([&mut notch.tip])))
    }
}

impl Marker {
    /// Encoding of its texts: that of the file, or else that of the profile.
    pub fn letters(&self, labels: &Labels) -> Letters {
        self.letters.unwrap_or_else(|| labels.letters())
    }

    /// All contours in cut order, with the index of their piece.
    pub fn contours(&self) -> impl Iterator<Item = (usize, &Contour)> {
        self.pieces.iter().enumerate().flat_map(|(i, piece)| piece.contours.iter().map(move |c| (i, c)))
    }

    /// Index of the piece that holds the outline of each piece: itself, except for early sections of a piece that windows of a
    /// conveyor split.
    pub fn owners(&self) -> Vec<usize> {
        let owner = |(i, section): (usize, &Piece)| {
            let last = || self.pieces.iter().rposition(|piece| piece.section.is_some() && piece.is_of(section));
            section.section.and_then(|_| last()).unwrap_or(i)
        };
        self.pieces.iter().enumerate().map(owner).collect()
    }

    /// Number of pieces; one that windows of a conveyor split counts once.
    pub fn piece_count(&self) -> usize {
        self.owners().into_iter().enumerate().filter(|(i, owner)| i == owner).count()
    }

    /// The pieces, each with the inner contours, holes and slits of its early sections.
    pub fn wholes(&self) -> Cow<'_, [Piece]> {
        if self.pieces.iter().all(|piece| piece.section.is_none()) {
            return Cow::Borrowed(&self.pieces);
        }
        let (mut wholes, owners) = (self.pieces.clone(), self.owners());
        for (i, &owner) in owners.iter().enumerate().filter(|(i, owner)| i != *owner) {
            let section = &self.pieces[i];
            wholes[owner].contours.extend_from_slice(&section.contours);
            wholes[owner].drills.extend_from_slice(&section.drills);
            wholes[owner].notches.extend_from_slice(&section.notches);
        }
        let mut places = owners.into_iter().enumerate();
        wholes.retain(|_| places.next().is_some_and(|(i, owner)| i == owner));
        Cow::Owned(wholes)
    }

    /// Index among the contours of a piece, by its own index, of the outline that windows of a conveyor split: the widest along
    /// X. `None` for other pieces and for early sections.
    pub fn split_outline(&self, part: usize) -> Option<usize> {
        let piece = &self.pieces[part];
        let is_last = |section: &Piece| section.section.is_none() || !section.is_of(piece);
        if piece.section.is_none() || !self.pieces[part + 1..].iter().all(is_last) {
            return None;
        }
        let width = |i: usize| self.list.extent(piece.contours[i].range).size().0;
        (0..piece.contours.len()).max_by(|&a, &b| width(a).total_cmp(&width(b)))
    }

    /// Cuts of a section of a piece that windows of a conveyor split, by its index: those of the outline in its stretch, with
    /// their overlaps; empty for other pieces and before the pass `cut`.
    pub fn section_cuts(&self, part: usize) -> impl Iterator<Item = Range> + '_ {
        let cuts = if self.pieces[part].section.is_some() { self.cuts_of(part as u32) } else { &[] };
        cuts.iter().filter(|cut| cut.kind == CutKind::Edge).map(|cut| cut.range)
    }

    /// Cuts of a piece, by its index.
    pub fn cuts_of(&self, piece: u32) -> &[Cut] {
        &self.cuts[self.range_of(piece)]
    }

    /// Range of the cuts of a piece among all cuts.
    pub fn range_of(&self, piece: u32) -> std::ops::Range<usize> {
        let first = |piece: u32| self.cuts.partition_point(|cut| cut.piece < piece);
        first(piece)..first(piece + 1)
    }

    /// The points of a contour: one more than its segments; a closed one ends with its first point.
    pub fn points(&self, contour: &Contour) -> Vec<Point> {
        self.list.points(contour.range).into_owned()
    }

    /// Length of all cuts, mm, without overlaps; length of the drawing before there are cuts.
    pub fn cut_length(&self) -> f64 {
        if self.cuts.is_empty() { self.drawn_length() } else { self.length(self.cuts.iter().map(|cut| cut.range)) }
    }

    /// Length of the edges that are cut once for two parts, mm.
    pub fn common_length(&self) -> f64 {
        self.length(self.common.iter().map(|edge| edge.range))
    }

    /// Length of the edges beside those of other parts, mm; where both are cut, each counts.
    pub fn near_length(&self) -> f64 {
        self.near.iter().map(|NearEdge { ends: [from, to], .. }| (to - from).norm()).sum()
    }

    fn length(&self, ranges: impl Iterator<Item = Range>) -> f64 {
        ranges.fold(0.0, |sum, range| {
            let points = self.list.points(range);
            points.windows(2).fold(sum, |sum, ends| sum + (ends[1] - ends[0]).norm())
        })
    }

    /// Length of all contours and slits as drawn, mm.
    pub fn drawn_length(&self) -> f64 {
        let contours = self.length(self.contours().map(|(_, contour)| contour.range));
        let notches: f64 =
            self.pieces.iter().flat_map(|p| &p.notches).flat_map(Notch::strokes).map(|s| s.length()).sum();
        contours + notches
    }

    /// Length of all cuts of a piece by its index, mm, without overlaps; length of its drawing before there are cuts.
    pub fn cut_length_of(&self, part: u32) -> f64 {
        if self.cuts.is_empty() {
            let piece = &self.pieces[part as usize];
            let slits: f64 = piece.notches.iter().flat_map(Notch::strokes).map(|stroke| stroke.length()).sum();
            return self.length(piece.contours.iter().map(|contour| contour.range)) + slits;
        }
        self.length(self.cuts_of(part).iter().map(|cut| cut.range))
    }

    /// Box around all cuts and holes.
    pub fn extent(&self) -> Extent {
        self.extent_at(|_, at| at)
    }

    /// Box around all cuts and holes on the table, after the advances of a conveyor.
    pub fn extent_on_table(&self) -> Extent {
        let stations = self.stations();
        self.extent_at(|part, at| self.pieces[part].on_table(at, stations[part]))
    }

    /// Advance of the cloth at the time that each piece is cut, mm.
    pub fn stations(&self) -> Vec<u32> {
        let mut station = self.moved_on;
        let bites =
            self.pieces.iter().map(|piece| piece.events.iter().map(|event| event.kind.advance_mm()).sum::<u32>());
        bites
            .map(|by| {
                station += by;
                station
            })
            .collect()
    }

    /// Windows of a conveyor in which the pieces are cut, in order: the advance of the cloth before each, in all, mm, and its
    /// pieces by index. One window if the cloth lies still.
    pub fn windows(&self) -> Vec<(u32, std::ops::Range<usize>)> {
        let stations = self.stations();
        let mut first = 0;
        let window = |same: &[u32]| {
            first += same.len();
            (same[0], first - same.len()..first)
        };
        stations.chunk_by(|a, b| a == b).map(window).collect()
    }

    /// Ends along X of what is cut with a piece, by its index, mm: of a section, its stretch; `None` if nothing is cut.
    pub fn cut_ends(&self, part: usize) -> Option<[f64; 2]> {
        let mut extent = Extent::EMPTY;
        self.each_place(part, |at| extent.add(at));
        self.pieces[part].section.or_else(|| (!extent.is_empty()).then_some([extent.min.x, extent.max.x]))
    }

    /// Box around all pieces under a map that depends on the piece.
    fn extent_at(&self, place: impl Fn(usize, Point) -> Point) -> Extent {
        let mut extent = Extent::EMPTY;
        for part in 0..self.pieces.len() {
            self.each_place(part, |at| extent.add(place(part, at)));
        }
        extent
    }

    /// Gives `take` every vertex, end of a slit and hole of a piece, by its index.
    fn each_place(&self, part: usize, mut take: impl FnMut(Point)) {
        let piece = &self.pieces[part];
        for contour in &piece.contours {
            self.list.points(contour.range).iter().copied().for_each(&mut take);
        }
        for stroke in piece.notches.iter().flat_map(Notch::strokes) {
            take(stroke.from);
            take(stroke.to);
        }
        piece.drills.iter().for_each(|drill| take(drill.at));
    }
}
