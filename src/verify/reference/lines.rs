//! Lines that must be cut: the stretches of contours between corners, as `outline` finds them, and the slits.

use std::borrow::Cow;
use std::ops::Range;

use rayon::prelude::*;

use super::band::band;
use super::caps::{BothWays, Feeds};
use super::line::{Line, OfCut};
use super::near::Near;
use super::outline::{OfContour, Outline};
use super::shared::{self, Around, Chords, Drawn, SAME};
use super::vertex::Vertex;
use super::{notches, tight};
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline};
use crate::ir::Marker;
use crate::ir::list::Segment;
use crate::ir::marker::{Cut, CutKind, NotchStroke, Piece};
use crate::machine::{Follow, MachineProfile};

/// All lines of a marker.
#[derive(Debug)]
pub(in crate::verify) struct Reference<'a> {
    /// The marker.
    pub(in crate::verify) marker: &'a Marker,
    /// The lines, in cut order.
    pub(in crate::verify) lines: Vec<Line<'a>>,
    /// Ranks of the holes, in the order of the marker.
    pub(in crate::verify) holes: Vec<usize>,
    /// Ranks of the events, in the order of the marker.
    pub(in crate::verify) events: Vec<usize>,
    /// Cuts of each piece.
    pub(in crate::verify) of_pieces: Vec<CutOfPiece>,
    /// The piece that holds the contours of each piece: another one for the early sections of a piece in several windows.
    pub(in crate::verify) owners: Vec<usize>,
    /// Closed contours of the pieces that are not wholly cut with their own cuts.
    pub(in crate::verify) shared: Vec<Around>,
    /// Open contours of these pieces; no other cut stands for them.
    pub(in crate::verify) open: Vec<Drawn>,
    /// Starts of the marker's junctions.
    junctions: Boxes,
    /// Permitted deviation of the tip, mm.
    pub(in crate::verify) tolerance: f64,
    /// Depth in a part up to which a place counts as on its edge, mm.
    pub(in crate::verify) band: f64,
    /// Greatest distance of edges of two parts that are cut once, mm; 0 where each is cut.
    pub(in crate::verify) common: f64,
}

/// Cuts of a piece.
#[derive(Debug)]
pub(in crate::verify) struct CutOfPiece {
    /// Its slits among all lines.
    pub(in crate::verify) slits: Range<usize>,
    /// Ranks of the cuts of each contour, as far as they are cuts of the piece.
    pub(in crate::verify) contours: Vec<Range<u32>>,
}

/// Greatest distance that a cut goes past its end to cross the cut of another part, in multiples of the distance of two edges.
const ACROSS: f64 = 4.0;

impl<'a> Reference<'a> {
    /// Distance past the end of a line at a place that the knife may go because another part's cut ends beside it there, mm:
    /// the cloth only comes free where both cross.
    pub(in crate::verify) fn across(&self, end: Point) -> f64 {
        let near = self.junctions.near(Extent::between(end, end).grown(self.tolerance));
        let here = near.map(|i| self.marker.junctions[i]).filter(|[from, _]| (from - end).norm() <= self.tolerance);
        let ways = here.map(|[from, to]| (to - from).norm() + self.tolerance);
        ways.filter(|&way| way <= ACROSS * self.common).fold(0.0, f64::max)
    }

    /// The lines of `marker`.
    pub(in crate::verify) fn new(marker: &'a Marker, profile: &MachineProfile) -> Self {
        let near = profile.knife.near_share().map(|_| Near::new(marker));
        let owners = marker.owners();
        let of_piece = |index| {
            let mut of_piece = OfPiece::new(index, marker, profile, near.as_ref());
            if owners[index] != index {
                of_piece.see_aside([index, owners[index]].map(|i| &marker.pieces[i]), marker, profile);
            }
            of_piece
        };
        let of_pieces: Vec<OfPiece<'a>> = (0..marker.pieces.len()).into_par_iter().map(of_piece).collect();
        let count = of_pieces.iter().map(|piece| piece.lines.len()).sum();
        let (mut first, mut first_cut, mut lines) = (0, 0, Vec::with_capacity(count));
        let (mut holes, mut events) = (Vec::new(), Vec::new());
        let (mut shared, mut open, mut cut_of_pieces) = (Vec::new(), Vec::new(), Vec::new());
        for (piece, of_piece) in marker.pieces.iter().zip(of_pieces) {
            let OfPiece { ranks, cuts, lines: mut of_piece, slits, contours, mut rings, open: mut of_open } = of_piece;
            events.extend((first..).take(piece.events.len()));
            holes.extend((first + piece.events.len()..).take(piece.drills.len()));
            for line in &mut of_piece {
                line.rank += small(first);
                line.cut.index = line.cut.index.saturating_add(first_cut);
            }
            rings.iter_mut().flatten().flat_map(|drawn| &mut drawn.cut).for_each(|cut| *cut += first_cut);
            let slits = lines.len()..lines.len() + slits;
            let section = piece.section.map(|_| owners[cut_of_pieces.len()]);
            shared.extend(rings.into_iter().map(|stretches| Around { slits: slits.clone(), stretches, section }));
            let contours = contours.into_iter().map(|ranks| ranks.start + small(first)..ranks.end + small(first));
            cut_of_pieces.push(CutOfPiece { slits, contours: contours.collect() });
            open.append(&mut of_open);
            first_cut += cuts;
            lines.append(&mut of_piece);
            first += ranks;
        }
        events.extend((first..).take(marker.closing.len()));
        Self {
            marker,
            lines,
            holes,
            events,
            of_pieces: cut_of_pieces,
            owners,
            shared,
            open,
            junctions: starts(&marker.junctions),
            tolerance: profile.tolerance(marker.unit),
            band: band(marker.unit, profile),
            common: profile.common(marker.unit).unwrap_or(0.0),
        }
    }
}

/// Starts of junctions, by place.
fn starts(junctions: &[[Point; 2]]) -> Boxes {
    Boxes::new(junctions.iter().map(|[from, _]| Extent::between(*from, *from)).collect())
}

/// Cuts of a piece, while they are built.
struct OfPiece<'a> {
    /// Its lines, with ranks counted from the first of the piece.
    lines: Vec<Line<'a>>,
    /// Number of slits; they come first among the lines.
    slits: usize,
    /// Number of ranks.
    ranks: usize,
    /// Number of cuts.
    cuts: u32,
    /// Ranks of the cuts of each contour; empty where all of it is cut with other pieces.
    contours: Vec<Range<u32>>,
    /// Its closed contours, if they are not wholly cut with it.
    rings: Vec<Vec<Drawn>>,
    /// Its open contours in that case.
    open: Vec<Drawn>,
}

impl<'a> OfPiece<'a> {
    fn new(index: usize, marker: &'a Marker, profile: &MachineProfile, near: Option<&Near>) -> Self {
        let piece = &marker.pieces[index];
        // Events come first, then holes, then slits, then contours.
        let mut ranks = piece.events.len() + piece.drills.len()..;
        let mut rank = || ranks.next().expect("a marker has fewer lines than numbers");
        let feeds = Feeds::new(profile, piece);
        let mut replaced = Vec::new();
        let outline = |contour| {
            let (outline, bridged) = Outline::new(contour, piece, marker, profile.notch);
            replaced.extend(bridged);
            outline
        };
        let outlines: Vec<Outline> = piece.contours.iter().map(outline).collect();
        let slits = notches::slits(piece, profile.notch, &replaced);
        // Cuts of a piece are numbered in the order of their ranks.
        let mut cuts = 0..;
        let mut cut = || cuts.next().expect("a piece has fewer cuts than numbers");
        let of_cuts = of_cuts(index, marker);
        let roots = if of_cuts.is_some() { roots(&slits, index, marker) } else { Vec::new() };
        let slits = slits.iter().zip(roots.into_iter().chain(std::iter::repeat(None)));
        let slits = slits
            .map(|((stroke, percent), root)| slit(stroke, root, [index, rank()].map(small), cut(), feeds.at(*percent)));
        let mut lines: Vec<Line> = slits.collect();
        let mut drawn: Vec<(bool, Vec<Segment>)> = Vec::new();
        if of_cuts.is_some() {
            let contours = piece.contours.iter().zip(&outlines);
            drawn.extend(contours.map(|(contour, outline)| (contour.closed, outline.segments().to_vec())));
        }
        let slits = lines.len();
        for outline in of_cuts.unwrap_or(outlines) {
            let owner = [index, rank()].map(small);
            let place = OfContour { owner, cut: cut(), feeds, near, profile, unit: marker.unit };
            lines.extend(outline.lines(place));
        }
        let (mut rings, mut open) = (Vec::new(), Vec::new());
        // Ranks of contours follow those of the slits.
        let first = small(piece.events.len() + piece.drills.len());
        let mut contours: Vec<Range<u32>> = Vec::new();
        if drawn.is_empty() {
            contours.extend((first + small(slits)..).take(piece.contours.len()).map(|rank| rank..rank + 1));
        }
        let own = Chords::of_cuts(if drawn.is_empty() { &[] } else { &lines[slits..] });
        for (is_closed, segments) in &drawn {
            let parted = shared::parted(segments, &own);
            let cuts = parted.iter().filter_map(|stretch| stretch.cut);
            let (least, most) = (cuts.clone().min().unwrap_or(0), cuts.max().map_or(0, |cut| cut + 1));
            contours.push(first + least..first + most);
            if *is_closed { rings.push(parted) } else { open.extend(parted) }
        }
        let contours_drawn = Chords::of_contours(drawn.iter().flat_map(|(_, segments)| segments));
        for line in lines[slits..].iter_mut().filter(|_| !drawn.is_empty()) {
            line.aside = shared::aside(line, &contours_drawn).into();
        }
        let edges = rings.iter().filter(|ring| !ring.is_empty());
        lines.extend(edges.map(|ring| edge(ring, [index, 0].map(small))));
        if profile.knife.follow == Follow::Chord {
            for line in &mut lines {
                line.tight = tight::stretches(line, &profile.knife).into();
            }
        }
        Self { lines, slits, contours, rings, open, ranks: rank(), cuts: cut() }
    }

    /// Marks the stretches where the cuts of an early section leave its contours and the outline, which another piece holds.
    fn see_aside(&mut self, [own, owner]: [&Piece; 2], marker: &Marker, profile: &MachineProfile) {
        let contours =
            [own, owner].into_iter().flat_map(|piece| piece.contours.iter().map(move |contour| (piece, contour)));
        let outlines = contours.map(|(piece, contour)| Outline::new(contour, piece, marker, profile.notch).0);
        let drawn: Vec<Segment> = outlines.flat_map(|outline| outline.segments().to_vec()).collect();
        let drawn = Chords::of_contours(drawn.iter());
        for line in &mut self.lines[self.slits..] {
            line.aside = shared::aside(line, &drawn).into();
        }
    }
}

/// Cuts that the marker has for the contours of a piece, if these are not all of the contours; `None` if they are.
pub(super) fn of_cuts(index: usize, marker: &Marker) -> Option<Vec<Outline<'_>>> {
    if marker.cuts.is_empty() {
        return None;
    }
    let cuts = marker.cuts_of(small(index)).iter().filter(|cut| cut.kind != CutKind::Slit);
    let is_whole = cuts.clone().all(|cut| cut.kind != CutKind::Edge)
        && cuts.clone().count() == marker.pieces[index].contours.len();
    (!is_whole).then(|| cuts.map(|cut| Outline::of_cut(cut, &marker.list)).collect())
}

/// Starts of the slits of a piece with common edges; `None` for a slit that starts on the drawn edge.
fn roots(slits: &[(NotchStroke, u8)], index: usize, marker: &Marker) -> Vec<Option<Point>> {
    let cuts = marker.cuts_of(small(index)).iter().filter(|cut| cut.kind == CutKind::Slit);
    let root_of = |(cut, (stroke, _)): (&Cut, &(NotchStroke, u8))| {
        let &[root, tip] = &marker.list.points(cut.range)[..] else { return None };
        let is_longer = tip == stroke.to && polyline::distance_to_segment(stroke.from, root, tip) <= SAME;
        (is_longer && root != stroke.from).then_some(root)
    };
    cuts.zip(slits).map(root_of).collect()
}

/// The drawn edge of a part.
fn edge<'a>(ring: &[Drawn], owner: [u32; 2]) -> Line<'a> {
    let points: Vec<Point> = std::iter::once(ring[0].ends[0]).chain(ring.iter().map(|chord| chord.ends[1])).collect();
    let blocks = ring.iter().map(|chord| chord.block).chain(ring.last().map(|chord| chord.block));
    let stations = polyline::stations(&points);
    let path = stations.into_iter().zip(blocks).map(|(station, block)| Vertex { station, sagitta: 0.0, block });
    let cut = OfCut { index: u32::MAX, offset: 0.0, round: None, bounds: true, is_edge: true, is_bare: true };
    Line::new(owner, cut, Cow::Owned(points), path.collect(), BothWays::One(f64::INFINITY), false)
}

/// Line of a slit that may start before the drawn edge; `cap` is the greatest speed of the tip, mm/s.
fn slit<'a>(stroke: &NotchStroke, root: Option<Point>, owner: [u32; 2], index: u32, cap: f64) -> Line<'a> {
    let start = root.unwrap_or(stroke.from);
    let from = Vertex { station: 0.0, sagitta: 0.0, block: stroke.span.block };
    let to = Vertex { station: (stroke.to - start).norm(), ..from };
    let points = Cow::Owned(vec![start, stroke.to]);
    let cut = OfCut { index, offset: 0.0, round: None, bounds: false, is_edge: false, is_bare: true };
    let mut line = Line::new(owner, cut, points, Box::new([from, to]), BothWays::One(cap), false);
    line.aside = root.map(|root| [0.0, (stroke.from - root).norm()]).into_iter().collect();
    line
}

/// Index or rank in 32 bits: a large marker has a hundred thousand lines.
fn small(count: usize) -> u32 {
    u32::try_from(count).expect("a source below 4 GiB has fewer than 2^32 lines")
}
