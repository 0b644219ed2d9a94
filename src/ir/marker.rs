//! What the file says, in mm: the pieces, which lie on the cloth as they are drawn, and the cuts, which the knife makes.

use std::borrow::Cow;

pub use super::label::Label;

use super::drawing::Account;
use super::list::{Range, SegmentList};
use super::toolpath;
use crate::geom::{Extent, Point, Vector};
use crate::machine::labels::Labels;
use crate::machine::letters::Letters;
use crate::source::Span;

/// The whole of a cutter file.
#[derive(Debug, Clone, Default)]
pub struct Marker {
    /// Segments of all contours and cuts.
    pub list: SegmentList,
    /// Pieces in cut order.
    pub pieces: Vec<Piece>,
    /// What the knife cuts, in order, those of a piece behind each other in the order of the pieces; none before the pass
    /// `cut`.
    pub cuts: Vec<Cut>,
    /// The edges that parts have in common and that are cut once.
    pub common: Vec<CommonEdge>,
    /// By how much less is cut than if every part were cut all round, mm.
    pub spared: f64,
    /// Where edges of parts run beside those of others, so near that a thin strip stands between two cuts.
    pub near: Vec<NearEdge>,
    /// Where cuts of several parts must cross: lines from where a cut leaves its own outline to where it ends across another
    /// part's, mm; without a length where two cross as they are drawn.
    pub junctions: Vec<[Point; 2]>,
    /// The grid to which the file rounds, mm, as large as it lies on the table; 0 when there is none.
    pub unit: f64,
    /// Way of the cloth before a program begins, mm.
    pub moved_on: u32,
    /// What happens behind the last piece.
    pub closing: Vec<Event>,
    /// How its texts are encoded, where the file says so; `None` = as the profile has it.
    pub letters: Option<Letters>,
    /// Of a drawing: what all of its lines were taken for.
    pub drawing: Option<Account>,
}

/// A piece of the garment, or what the file calls one.
#[derive(Debug, Clone, Default)]
pub struct Piece {
    /// Its number in the file (N), or its place in the order, from 1.
    pub number: u32,
    /// Which copy of the marker it is of, from 1; 0 where there is but one.
    pub copy: u32,
    /// Where it starts in the source.
    pub span: Span,
    /// Holes, in cut order.
    pub drills: Vec<Drill>,
    /// Notches, in cut order; they are cut before the contours.
    pub notches: Vec<Notch>,
    /// Contours, in cut order.
    pub contours: Vec<Contour>,
    /// Notches that the contours make, in the order in which they come to them: nothing is cut for a row of this list.
    pub outline_notches: Vec<OutlineNotch>,
    /// Texts.
    pub labels: Vec<Label>,
    /// What happens before the piece is cut, in order.
    pub events: Vec<Event>,
    /// The speed of the tip that the file asks for, mm/s: the least while any of the piece is cut; `None` = whatever the
    /// profile allows.
    pub feed: Option<f64>,
    /// What the file's list of labels says of it, in the file's order.
    pub fields: Vec<Field>,
    /// Stretch along X, mm, in which its outline is cut with it, where windows of a conveyor split the piece; `None` = it is cut
    /// whole. Of the sections of a piece the last one has its contours and its texts, each one the slits and holes in its stretch.
    pub section: Option<[f64; 2]>,
}

/// Something for the controller or the operator, between two pieces: the knife is up and the axes rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Event {
    /// What is asked for.
    pub kind: toolpath::Event,
    /// Where it stands in the source.
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

/// What the knife cuts in one go, as far as the drawing tells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cut {
    /// What it is of the part that it cuts.
    pub kind: CutKind,
    /// The piece that it is cut with: its place in the marker.
    pub piece: u32,
    /// The parts on its left and on its right, by the pieces that their outlines are of; `None` = waste.
    pub sides: [Option<u32>; 2],
    /// Its segments: those of a contour where that is cut as it is drawn.
    pub range: Range,
}

/// An edge that two parts have in common and that is cut once: with the part that comes first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CommonEdge {
    /// The piece with which it is cut, and the one that is spared it: their places in the marker.
    pub pieces: [u32; 2],
    /// The edge as the outline of the spared one has it.
    pub range: Range,
    /// How far it is from where it is cut at the most, mm.
    pub shift: f64,
}

/// A straight stretch of a cut around a part beside which one around another part runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearEdge {
    /// The piece that it is cut with: its place in the marker.
    pub piece: u32,
    /// The ends of the stretch, in the direction of the cut.
    pub ends: [Point; 2],
}

/// What a cut is of the part that it cuts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CutKind {
    /// The closed line around it.
    Outline,
    /// The closed line around a cut-out of it.
    Inner,
    /// A stretch of one of the two: the rest is cut with other parts, or is a notch on an edge that is cut straight through.
    Edge,
    /// A stroke of a notch.
    Slit,
    /// A line that does not close.
    Line,
}

impl CutKind {
    /// Whether it ends where it starts.
    pub fn is_closed(self) -> bool {
        match self {
            Self::Outline | Self::Inner => true,
            Self::Edge | Self::Slit | Self::Line => false,
        }
    }
}

/// A line of a piece, as it is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contour {
    /// Its segments.
    pub range: Range,
    /// Whether it ends where it starts.
    pub closed: bool,
}

/// A short cut that marks a place on the seam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Notch {
    /// Its shape.
    pub kind: NotchKind,
    /// Where it meets the outline.
    pub root: Point,
    /// Its innermost point.
    pub tip: Point,
    /// Its speed in percent of the speed of the piece, 1 to 100.
    pub percent: u8,
    /// Where it stands in the source.
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
    /// Where it starts.
    pub from: Point,
    /// Where it ends.
    pub to: Point,
    /// The block that its end came from.
    pub span: Span,
}

impl NotchStroke {
    /// Length, mm.
    pub fn length(&self) -> f64 {
        (self.to - self.from).norm()
    }
}

impl Notch {
    /// Longest slit, and longest crossbar, mm: what cutters punch is 3 to 12 mm deep, and the lines that are drawn inside
    /// parts are longer.
    pub const LONGEST: f64 = 15.0;
    /// Longest stroke from edge to edge that is a notch, mm: there and back, and as much again across.
    pub const LONGEST_STROKE: f64 = 4.0 * Self::LONGEST;
    /// Widest mouth, mm.
    pub const WIDEST: f64 = 12.0;
    /// How far from its edge a stroke of a notch may begin, mm, beside rounding: drawing programs leave it by some units.
    pub const MISS: f64 = 0.5;

    /// How far it goes into the part, mm.
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

/// A notch that an outline makes: it goes into the part and comes back, or out of it. The outline cuts it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutlineNotch {
    /// Its form.
    pub form: NotchForm,
    /// Whether it stands out of the part.
    pub outwards: bool,
    /// The two points of the edge between which it opens, in the order of the outline.
    pub mouth: [Point; 2],
    /// The middle of its bottom; the apex of a V.
    pub tip: Point,
    /// How many segments the outline has from one end of the mouth to the other.
    pub segments: u32,
    /// Where its tip stands in the source.
    pub span: Span,
}

/// What a notch that an outline makes looks like.
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

    /// Unit vector from the edge into the part, whichever way the notch goes.
    pub fn inwards(&self) -> Vector {
        let along = (self.tip - self.root()) / self.depth();
        if self.outwards { -along } else { along }
    }

    /// What lists call it: its form, and whether it stands out.
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
    /// Its place.
    pub at: Point,
    /// Which drill, 1 to 4.
    pub tool: u8,
    /// Where it stands in the source.
    pub span: Span,
}

impl Piece {
    /// What lists and pictures call it: its number, and behind a stroke the copy of the marker that it is of, if there are
    /// several.
    pub fn name(&self) -> String {
        let Self { number, copy, .. } = self;
        if *copy == 0 { number.to_string() } else { format!("{number}/{copy}") }
    }

    /// Where a place of it lies on the table when the cloth has come `station` mm: of a section no farther back than that begins.
    pub fn on_table(&self, at: Point, station: u32) -> Point {
        let x = self.section.map_or(at.x, |[from, to]| at.x.clamp(from, to));
        Point::new(x - f64::from(station), at.y)
    }

    /// Whether it is a section of a piece behind it, which has the contours.
    pub fn is_early_section(&self) -> bool {
        self.section.is_some() && self.contours.is_empty()
    }

    /// Whether another piece is this one or a section of it.
    pub fn is_of(&self, other: &Self) -> bool {
        (self.number, self.copy, self.span) == (other.number, other.copy, other.span)
    }

    /// Every place of its drill holes and its notches. Those of its contours are the segment list's.
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
    /// How its texts are encoded, in the encoding of the profile where the file says nothing.
    pub fn letters(&self, labels: &Labels) -> Letters {
        self.letters.unwrap_or_else(|| labels.letters())
    }

    /// All contours in cut order, with the index of their piece.
    pub fn contours(&self) -> impl Iterator<Item = (usize, &Contour)> {
        self.pieces.iter().enumerate().flat_map(|(i, piece)| piece.contours.iter().map(move |c| (i, c)))
    }

    /// The piece that has the contours of each: itself, but for the early sections of one that windows of a conveyor split.
    pub fn owners(&self) -> Vec<usize> {
        let owner = |i: usize| {
            let section = &self.pieces[i];
            let last = || self.pieces.iter().rposition(|piece| piece.section.is_some() && piece.is_of(section));
            if section.is_early_section() { last().unwrap_or(i) } else { i }
        };
        (0..self.pieces.len()).map(owner).collect()
    }

    /// The pieces, each with the holes and slits of its early sections.
    pub fn wholes(&self) -> Cow<'_, [Piece]> {
        if !self.pieces.iter().any(Piece::is_early_section) {
            return Cow::Borrowed(&self.pieces);
        }
        let mut wholes = self.pieces.clone();
        for (section, owner) in self.pieces.iter().zip(self.owners()).filter(|(piece, _)| piece.is_early_section()) {
            wholes[owner].drills.extend_from_slice(&section.drills);
            wholes[owner].notches.extend_from_slice(&section.notches);
        }
        wholes.retain(|piece| !piece.is_early_section());
        Cow::Owned(wholes)
    }

    /// The cuts of a piece, by its place.
    pub fn cuts_of(&self, piece: u32) -> &[Cut] {
        &self.cuts[self.range_of(piece)]
    }

    /// The places of these among all cuts.
    pub fn range_of(&self, piece: u32) -> std::ops::Range<usize> {
        let first = |piece: u32| self.cuts.partition_point(|cut| cut.piece < piece);
        first(piece)..first(piece + 1)
    }

    /// The points of a contour: one more than its segments; a closed one ends with its first point.
    pub fn points(&self, contour: &Contour) -> Vec<Point> {
        self.list.points(contour.range).into_owned()
    }

    /// Length of all cuts, mm, without overlaps; that of what is drawn as long as there are none.
    pub fn cut_length(&self) -> f64 {
        if self.cuts.is_empty() { self.drawn_length() } else { self.length(self.cuts.iter().map(|cut| cut.range)) }
    }

    /// Length of the edges that are cut once for two parts, mm.
    pub fn common_length(&self) -> f64 {
        self.length(self.common.iter().map(|edge| edge.range))
    }

    /// Length of the edges that run beside those of other parts, mm; where both are cut each counts.
    pub fn near_length(&self) -> f64 {
        self.near.iter().map(|NearEdge { ends: [from, to], .. }| (to - from).norm()).sum()
    }

    fn length(&self, ranges: impl Iterator<Item = Range>) -> f64 {
        ranges.fold(0.0, |sum, range| {
            let points = self.list.points(range);
            points.windows(2).fold(sum, |sum, ends| sum + (ends[1] - ends[0]).norm())
        })
    }

    /// Length of all contours and slits as they are drawn, mm.
    pub fn drawn_length(&self) -> f64 {
        let contours = self.length(self.contours().map(|(_, contour)| contour.range));
        let notches: f64 =
            self.pieces.iter().flat_map(|p| &p.notches).flat_map(Notch::strokes).map(|s| s.length()).sum();
        contours + notches
    }

    /// Length of all cuts of a piece by its place, mm, without overlaps; that of what is drawn as long as there are none.
    pub fn cut_length_of(&self, part: u32) -> f64 {
        if self.cuts.is_empty() {
            let piece = &self.pieces[part as usize];
            let slits: f64 = piece.notches.iter().flat_map(Notch::strokes).map(|stroke| stroke.length()).sum();
            return self.length(piece.contours.iter().map(|contour| contour.range)) + slits;
        }
        self.length(self.cuts_of(part).iter().map(|cut| cut.range))
    }

    /// The box around everything that is cut or drilled.
    pub fn extent(&self) -> Extent {
        self.extent_at(|_, at| at)
    }

    /// The box around all that is cut and drilled, as it comes to lie on the table: a conveyor moves the cloth on.
    pub fn extent_on_table(&self) -> Extent {
        let stations = self.stations();
        self.extent_at(|part, at| self.pieces[part].on_table(at, stations[part]))
    }

    /// Way of the cloth by the time that each piece is cut, mm.
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

    /// Box around all pieces, whose places come to lie elsewhere, piece by piece.
    fn extent_at(&self, place: impl Fn(usize, Point) -> Point) -> Extent {
        let mut extent = Extent::EMPTY;
        for (part, piece) in self.pieces.iter().enumerate() {
            let mut add = |at: Point| extent.add(place(part, at));
            for contour in &piece.contours {
                self.list.points(contour.range).iter().copied().for_each(&mut add);
            }
            for stroke in piece.notches.iter().flat_map(Notch::strokes) {
                add(stroke.from);
                add(stroke.to);
            }
            piece.drills.iter().for_each(|drill| add(drill.at));
        }
        extent
    }
}
