//! Cut: cuts of the knife, made from the pieces as drawn: slits first, then contours, piece by piece.
//!
//! Needs: pieces in cut order, with the notches that their outlines make, and only those that this run cuts. Leaves true: a cut
//! for each contour and each stroke of a notch, in the style of the profile; where edges of two parts are one, open cuts for
//! the rest of the later part. A contour that is cut as drawn keeps its range of the list; one that runs straight over the
//! mouths of its notches has a range of its own. Reports slits that the profile makes deeper and that lead out of their part.

mod common;
mod facing;
mod lead;
mod past;
mod ring;
mod stretch;
mod style;
mod travel;

use std::collections::BTreeMap;

use self::common::share;
use self::facing::Near;
use self::ring::{Mouth, Ring};
use self::stretch::Asked;
use self::style::{Bridged, Slit};
pub(super) use self::travel::Group;
use self::travel::arrange;
use super::pass::MarkerPass;
use super::search::search_ended;
use super::split::{self, Lap};
use crate::analysis::cloth::Cloth;
use crate::analysis::nesting::Nesting;
use crate::diagnostic::Diagnostics;
use crate::geom;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Point, polyline};
use crate::ir::list::{Joint, Range, Segment, SegmentList};
use crate::ir::marker::{CommonEdge, Contour, Cut, CutKind, Marker, Notch, NotchStroke, OutlineNotch, Piece};
use crate::ir::toolpath::Event;
use crate::machine::{Job, NotchStyle, Notches};

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "cut", about: "makes the cuts of the pieces, notches in the style of the profile", run };

/// A slit is cut without overlap at either end.
const BARE: Joint = Joint { lift: true, full_advance: true, no_overcut: true };

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    let groups = make(marker, job, diagnostics);
    arrange(marker, &groups, job);
}

/// Makes the cuts without messages, and returns the group of each.
pub(super) fn made(marker: &mut Marker, job: &Job) -> Vec<Group> {
    let groups = make(marker, job, &mut Diagnostics::default());
    arrange(marker, &groups, job);
    groups
}

/// Makes the cuts, and returns the group of each.
fn make(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) -> Vec<Group> {
    let style = job.profile.notch;
    if style.depth_mm.is_some() && style.style != NotchStyle::Skip {
        style::check_depths(marker, &Cloth::new(marker, &job.profile), style, diagnostics);
    }
    let nesting = Nesting::of(marker, job.profile.band(marker.unit));
    let asked = job.profile.common(marker.unit).map(|distance| Asked {
        near: Near { distance, slack: marker.unit * std::f64::consts::SQRT_2 },
        min: job.profile.common.min_mm,
        beyond: job.profile.tolerance(marker.unit),
        width: job.profile.knife.width_mm,
        corner: job.profile.corner_angle(),
    });
    let Marker { list, pieces, cuts, common, junctions, unit, .. } = marker;
    (*cuts, *common, *junctions) = (Vec::new(), Vec::new(), Vec::new());
    let mut cutting = Cutting { list, nesting: &nesting, style, piece: 0, cuts, groups: Vec::new() };
    let mut styled: Vec<Styled> = pieces.iter().map(|piece| cutting.styled(piece)).collect();
    let mut sections = cutting.sections(pieces, &styled, Lap::of(job, *unit));
    let slits: f64 = styled.iter().flat_map(|styled| &styled.slits).map(|slit| slit.stroke.length()).sum();
    let mut shared = match asked {
        Some(asked) => cutting.share(pieces, &mut styled, asked, (common, junctions), diagnostics),
        None => BTreeMap::new(),
    };
    // Length of the cuts if each part were cut all round.
    let alone = (!shared.is_empty()).then(|| {
        let outlines = styled.iter().flat_map(|styled| &styled.outlines);
        slits + outlines.map(|&range| polyline::length(&cutting.list.points(range))).sum::<f64>()
    });
    for (i, Styled { slits, outlines }) in styled.into_iter().enumerate() {
        cutting.piece = i;
        for slit in slits {
            cutting.slit(&slit);
        }
        cutting.group(Group::Slits);
        let section = sections.remove(&i);
        let split = section.as_ref().map(|section| section.line);
        let contours = outlines.into_iter().enumerate().zip(nesting.of_group(i));
        for ((contour, range), line) in contours.filter(|(_, line)| Some(*line) != split) {
            match shared.remove(&line) {
                Some(of_line) => cutting.edges(of_line, range, line),
                None => cutting.contour(range, line),
            }
            cutting.group(Group::Contour(contour));
        }
        if let Some(Section { cuts, outline, line }) = section {
            cutting.edges([Vec::new(), cuts], outline, line);
        }
    }
    let groups = cutting.groups;
    marker.spared = alone.map_or(0.0, |alone| alone - marker.cut_length());
    groups
}

/// Cuts of the outline of a piece that belong to a section of it.
struct Section {
    cuts: Vec<Vec<Segment>>,
    /// The outline, and the index of its line.
    outline: Range,
    line: usize,
}

/// A piece with its notches in the style of the profile.
struct Styled {
    slits: Vec<Slit>,
    /// Its contours as they are cut.
    outlines: Vec<Range>,
}

/// The cuts of a piece while they are made.
struct Cutting<'a> {
    list: &'a mut SegmentList,
    nesting: &'a Nesting,
    style: Notches,
    /// Index of the piece in the marker.
    piece: usize,
    cuts: &'a mut Vec<Cut>,
    /// Group of each cut.
    groups: Vec<Group>,
}

/// Open cuts of a line that has edges in common with others: the legs of notches on these edges, and the rest of its own edges.
type OfLine = [Vec<Vec<Segment>>; 2];

impl Cutting<'_> {
    /// The slits and the contours of a piece as they are cut.
    fn styled(&mut self, piece: &Piece) -> Styled {
        let mut slits: Vec<Slit> = piece.notches.iter().flat_map(|notch| self.drawn(notch)).collect();
        let outline = |contour: &Contour| self.outline(contour.range, &piece.outline_notches, &mut slits);
        let outlines = piece.contours.iter().map(outline).collect();
        Styled { slits, outlines }
    }

    /// Cuts of the sections of pieces that windows of a conveyor split, by the indices of the pieces.
    fn sections(&self, pieces: &[Piece], styled: &[Styled], lap: Lap) -> BTreeMap<usize, Section> {
        let mut found = BTreeMap::new();
        for (i, owner) in pieces.iter().enumerate().filter(|(_, piece)| piece.section.is_some()) {
            let mut lines = styled[i].outlines.iter().zip(self.nesting.of_group(i));
            // Early sections have inner contours alone.
            let outline = lines.find(|(_, line)| self.nesting.around(*line).len() == 0);
            let Some((&outline, line)) = outline else { continue };
            let of_owner = (0..pieces.len()).filter(|&k| pieces[k].section.is_some() && pieces[k].is_of(owner));
            let mut of_owner: Vec<(f64, usize)> = of_owner.filter_map(|k| Some((pieces[k].section?[0], k))).collect();
            of_owner.sort_by(|a, b| a.0.total_cmp(&b.0));
            let borders: Vec<f64> = of_owner.iter().skip(1).map(|(from, _)| *from).collect();
            for (_, k) in &of_owner {
                found.insert(*k, Section { cuts: Vec::new(), outline, line });
            }
            let ring = split::Ring::new(self.list, outline, self.is_part_left(outline, line));
            for (section, cut) in ring.sections(&borders, lap) {
                let section =
                    found.get_mut(&of_owner[section].1).expect("there is a section on either side of a border");
                section.cuts.push(cut);
            }
        }
        found
    }

    /// Cuts of the lines that have edges in common with those of other parts. Adds the cuts that stand for these edges to
    /// `common`, crossings of cuts to `junctions`, and extends slits on these edges to the cuts.
    fn share(
        &mut self,
        pieces: &[Piece],
        styled: &mut [Styled],
        asked: Asked,
        (common, junctions): (&mut Vec<CommonEdge>, &mut Vec<[Point; 2]>),
        diagnostics: &mut Diagnostics,
    ) -> BTreeMap<usize, OfLine> {
        let around = Boxes::new(self.nesting.lines().iter().map(|line| line.extent).collect());
        let is_near = |line: usize| {
            let near = around.near(around.all()[line].grown(asked.near.distance));
            near.into_iter().any(|other| self.part(other) != self.part(line))
        };
        let mut lines = Vec::new();
        let mut rings = Vec::new();
        let mut advances = 0;
        for (i, (piece, styled)) in pieces.iter().zip(&*styled).enumerate() {
            advances +=
                piece.events.iter().filter(|event| matches!(event.kind, Event::Advance | Event::AdvanceBy(_))).count();
            // Split outlines have no common lines: their sections are cut in several windows.
            let is_whole = piece.section.is_none();
            let of_piece = styled.outlines.iter().zip(self.nesting.of_group(i)).filter(|_| is_whole);
            for (&range, line) in of_piece.filter(|&(_, line)| self.nesting.lines()[line].is_closed && is_near(line)) {
                lines.push(line);
                let mut ring = self.ring(i, piece, range, line);
                ring.advances = advances;
                rings.push(ring);
            }
        }
        let mut slits: Vec<&mut [Slit]> = styled.iter_mut().map(|styled| &mut styled.slits[..]).collect();
        let count = rings.iter().map(|ring| ring.segments().len()).sum();
        let Some(outcomes) = share(&mut rings, &mut slits, asked, &mut Budget::of_lines(count)) else {
            diagnostics.push(search_ended("edges that parts have in common are cut for each of them"));
            return BTreeMap::new();
        };
        let mut cuts = BTreeMap::new();
        for ((outcome, line), ring) in outcomes.into_iter().zip(lines).zip(&rings) {
            junctions.extend(outcome.junctions);
            for (other, segments, shift) in outcome.shared {
                let range = self.list.append(segments).expect("a common edge has a length");
                let pieces = [rings[other].piece, ring.piece].map(|piece| piece as u32);
                common.push(CommonEdge { pieces, range, shift });
            }
            if let Some(mut legs) = outcome.cuts {
                let edges = legs.split_off(outcome.legs);
                cuts.insert(line, [legs, edges]);
            }
        }
        cuts
    }

    /// A closed line that bounds a part as it is cut: straight over the mouths of its notches.
    fn ring(&self, i: usize, piece: &Piece, range: Range, line: usize) -> Ring {
        let part = self.part(line).expect("a closed line bounds a part");
        let mut segments: Vec<Segment> = self.list.walk(range).map(|(_, segment)| segment).collect();
        let is_drawn = self.style.style == NotchStyle::AsDrawn;
        // A notch that protrudes is cloth of the part: a cut over its mouth would take it off.
        let inwards: Vec<OutlineNotch> =
            piece.outline_notches.iter().copied().filter(|notch| !notch.outwards).collect();
        let mouths = if is_drawn { style::bridge(&mut segments, &inwards) } else { Vec::new() };
        let mouths = mouths.into_iter().map(|bridged| Mouth { segment: bridged.at, legs: bridged.legs }).collect();
        Ring::new([i, part], self.is_part_left(range, line), segments, mouths)
    }

    /// Part of a line, by the index of the piece of its outline.
    fn part(&self, line: usize) -> Option<usize> {
        self.nesting.outline(line).map(|outline| self.nesting.lines()[outline].group as usize)
    }

    /// The cuts of a notch that is drawn as strokes.
    fn drawn(&self, notch: &Notch) -> impl Iterator<Item = Slit> + use<> {
        let percent = notch.percent;
        style::strokes(notch, self.style).map(move |stroke| Slit { stroke, percent })
    }

    /// A contour as it is cut; slits that replace its notches are added to `slits`.
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
            slits.extend(bridged.iter().map(|Bridged { notch, percent, .. }| Slit {
                stroke: style::slit(notch, self.style),
                percent: *percent,
            }));
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
        if !self.nesting.lines()[line].is_closed {
            self.push(CutKind::Line, range, [self.part(line); 2]);
            return;
        }
        let kind = if self.nesting.is_inner(line) { CutKind::Inner } else { CutKind::Outline };
        self.push(kind, range, self.sides(range, line));
    }

    /// Parts on the left and on the right of a closed line, or of cuts in the same direction, of this range.
    fn sides(&self, range: Range, line: usize) -> [Option<usize>; 2] {
        let part = self.part(line);
        if self.is_part_left(range, line) { [part, None] } else { [None, part] }
    }

    /// True if the part that a closed line bounds is on its left: the inside of a counter-clockwise ring is.
    fn is_part_left(&self, range: Range, line: usize) -> bool {
        (geom::ring::area(&self.list.points(range)) > 0.0) != self.nesting.is_inner(line)
    }

    /// Puts the cuts since the last group into one group.
    fn group(&mut self, group: Group) {
        self.groups.resize(self.cuts.len(), group);
    }

    /// Adds the cuts of a line, of this range, that has edges in common with others.
    fn edges(&mut self, of_line: OfLine, drawn: Range, line: usize) {
        for cuts in of_line {
            let first = self.cuts.len();
            for cut in cuts {
                self.edge(cut, drawn, line);
            }
            self.group(Group::Edges(first));
        }
    }

    fn edge(&mut self, segments: Vec<Segment>, drawn: Range, line: usize) {
        let is_closed = segments.first().map(|first| first.from) == segments.last().map(|last| last.to);
        let range = self.list.append(segments).expect("it has a length");
        if is_closed {
            return self.contour(range, line);
        }
        self.push(CutKind::Edge, range, self.sides(drawn, line));
    }

    fn push(&mut self, kind: CutKind, range: Range, sides: [Option<usize>; 2]) {
        let sides = sides.map(|part| part.map(|part| part as u32));
        self.cuts.push(Cut { kind, piece: self.piece as u32, sides, range });
    }
}
