//! Cut: what the knife does, made from the pieces as they are drawn: slits first, then contours, piece by piece.
//!
//! Needs: pieces in cut order, with the notches that their outlines make, and only those that this run cuts. Leaves
//! true: a cut for each contour and each stroke of a notch, in the style of the profile. A contour that is cut as it is
//! drawn is the same range of the list; one that runs straight over the mouths of its notches has a range of its own.
//! Says where a slit that the profile makes deeper leads out of its part.

mod style;

use super::pass::MarkerPass;
use crate::analysis::cloth::Cloth;
use crate::analysis::nesting::Nesting;
use crate::diagnostic::Diagnostics;
use crate::geom::ring;
use crate::ir::list::{Joint, Range, Segment, SegmentList};
use crate::ir::marker::{Cut, CutKind, Marker, Notch, NotchStroke, OutlineNotch, Piece};
use crate::machine::{Job, NotchStyle, Notches};

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "cut", about: "makes the cuts of the pieces, notches in the style of the profile", run };

/// A slit is cut without overlap at either end.
const BARE: Joint = Joint { lift: true, full_advance: true, no_overcut: true };

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    let style = job.profile.notch;
    if style.depth_mm.is_some() && style.style != NotchStyle::Skip {
        style::check_depths(marker, &Cloth::new(marker, &job.profile), style, diagnostics);
    }
    let nesting = Nesting::of(marker);
    let Marker { list, pieces, cuts, .. } = marker;
    cuts.clear();
    for (i, piece) in pieces.iter().enumerate() {
        let mut cutting = Cutting { list, nesting: &nesting, style, piece: i, cuts };
        cutting.cut(piece);
    }
}

/// A cut of a notch: a stroke, and its speed in percent of the speed of its piece.
struct Slit {
    stroke: NotchStroke,
    percent: u8,
}

/// The cuts of a piece, as they are made.
struct Cutting<'a> {
    list: &'a mut SegmentList,
    nesting: &'a Nesting,
    style: Notches,
    /// Its place in the marker.
    piece: usize,
    cuts: &'a mut Vec<Cut>,
}

impl Cutting<'_> {
    fn cut(&mut self, piece: &Piece) {
        let mut slits: Vec<Slit> = piece.notches.iter().flat_map(|notch| self.drawn(notch)).collect();
        let ranges: Vec<Range> = piece
            .contours
            .iter()
            .map(|contour| self.outline(contour.range, &piece.outline_notches, &mut slits))
            .collect();
        for slit in slits {
            self.slit(&slit);
        }
        for (range, line) in ranges.into_iter().zip(self.nesting.of_group(self.piece)) {
            self.contour(range, line);
        }
    }

    /// The cuts of a notch that is drawn as strokes.
    fn drawn(&self, notch: &Notch) -> impl Iterator<Item = Slit> + use<> {
        let percent = notch.percent;
        style::strokes(notch, self.style).map(move |stroke| Slit { stroke, percent })
    }

    /// A contour as it is cut; what its notches become instead is added to the slits.
    fn outline(&mut self, range: Range, notches: &[OutlineNotch], slits: &mut Vec<Slit>) -> Range {
        if self.style.style == NotchStyle::AsDrawn || notches.is_empty() {
            return range;
        }
        let mut outline: Vec<Segment> = self.list.walk(range).map(|(_, segment)| segment).collect();
        let bridged = style::bridge(&mut outline, notches);
        if bridged.is_empty() {
            return range;
        }
        if self.style.style == NotchStyle::Slit {
            slits.extend(
                bridged
                    .iter()
                    .map(|(notch, percent)| Slit { stroke: style::slit(notch, self.style), percent: *percent }),
            );
        }
        self.list.append(outline).expect("an outline keeps more than its notches")
    }

    fn slit(&mut self, Slit { stroke, percent }: &Slit) {
        let NotchStroke { from, to, span } = *stroke;
        let range = self.list.append([Segment { from, to, span, joint: BARE, percent: *percent }]);
        let part = self.nesting.part_of(self.piece);
        self.push(CutKind::Slit, range.expect("it has a segment"), [part; 2]);
    }

    fn contour(&mut self, range: Range, line: usize) {
        let part = self.nesting.outline(line).map(|outline| self.nesting.lines()[outline].group as usize);
        let is_inner = self.nesting.is_inner(line);
        if !self.nesting.lines()[line].is_closed {
            self.push(CutKind::Line, range, [part; 2]);
            return;
        }
        // The inside of a ring that runs counter-clockwise is on its left.
        let is_part_left = (ring::area(&self.list.points(range)) > 0.0) != is_inner;
        let kind = if is_inner { CutKind::Inner } else { CutKind::Outline };
        self.push(kind, range, if is_part_left { [part, None] } else { [None, part] });
    }

    fn push(&mut self, kind: CutKind, range: Range, sides: [Option<usize>; 2]) {
        let sides = sides.map(|part| part.map(|part| part as u32));
        self.cuts.push(Cut { kind, piece: self.piece as u32, sides, range });
    }
}
