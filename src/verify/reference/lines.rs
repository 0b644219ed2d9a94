//! What must be cut, as lines: the stretches of contours between corners, as `outline` finds them, and the slits.

use std::borrow::Cow;

use rayon::prelude::*;

use super::band::band;
use super::caps::{BothWays, Feeds};
use super::line::{Line, OfCut};
use super::outline::{OfContour, Outline};
use super::vertex::Vertex;
use super::{notches, tight};
use crate::ir::Marker;
use crate::ir::marker::NotchStroke;
use crate::machine::{Follow, MachineProfile};

/// All lines of a marker.
#[derive(Debug)]
pub(in crate::verify) struct Reference<'a> {
    /// The marker that they come from.
    pub(in crate::verify) marker: &'a Marker,
    /// The lines, in cut order.
    pub(in crate::verify) lines: Vec<Line<'a>>,
    /// Ranks of the holes, in the order of the marker.
    pub(in crate::verify) holes: Vec<usize>,
    /// Ranks of the events, in the order of the marker.
    pub(in crate::verify) events: Vec<usize>,
    /// Permitted deviation of the tip, mm.
    pub(in crate::verify) tolerance: f64,
    /// How deep a place in a part may lie and still be at its edge, mm.
    pub(in crate::verify) band: f64,
}

impl<'a> Reference<'a> {
    /// The lines of `marker`.
    pub(in crate::verify) fn new(marker: &'a Marker, profile: &MachineProfile) -> Self {
        let of_piece = |index| OfPiece::new(index, marker, profile);
        let of_pieces: Vec<OfPiece<'a>> = (0..marker.pieces.len()).into_par_iter().map(of_piece).collect();
        let count = of_pieces.iter().map(|piece| piece.lines.len()).sum();
        let (mut lines, mut holes, mut events) = (Vec::with_capacity(count), Vec::new(), Vec::new());
        let mut first = 0;
        let mut first_cut = 0;
        for (piece, OfPiece { ranks, cuts, lines: mut of_piece }) in marker.pieces.iter().zip(of_pieces) {
            events.extend((first..).take(piece.events.len()));
            holes.extend((first + piece.events.len()..).take(piece.drills.len()));
            for line in &mut of_piece {
                line.rank += small(first);
                line.cut.index += first_cut;
            }
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
            tolerance: profile.tolerance(marker.unit),
            band: band(marker.unit, profile),
        }
    }
}

/// What is cut of a piece.
struct OfPiece<'a> {
    /// Its lines, their ranks counted from those of the piece.
    lines: Vec<Line<'a>>,
    /// How many ranks the piece has.
    ranks: usize,
    /// How many cuts it has.
    cuts: u32,
}

impl<'a> OfPiece<'a> {
    fn new(index: usize, marker: &'a Marker, profile: &MachineProfile) -> Self {
        let piece = &marker.pieces[index];
        // Events come first, then holes, then slits, then contours.
        let mut ranks = piece.events.len() + piece.drills.len()..;
        let mut rank = || ranks.next().expect("a marker has fewer lines than numbers");
        let feeds = Feeds::new(profile, piece);
        let mut replaced = Vec::new();
        let outlines: Vec<Outline> = piece
            .contours
            .iter()
            .map(|contour| {
                let (outline, bridged) = Outline::new(contour, piece, marker, profile.notch);
                replaced.extend(bridged);
                outline
            })
            .collect();
        let slits = notches::slits(piece, profile.notch, &replaced);
        // Those of the cuts in the piece follow each other as their ranks do.
        let mut cuts = 0..;
        let mut cut = || cuts.next().expect("a piece has fewer cuts than numbers");
        let slits =
            slits.iter().map(|(stroke, percent)| slit(stroke, [index, rank()].map(small), cut(), feeds.at(*percent)));
        let mut lines: Vec<Line> = slits.collect();
        for outline in outlines {
            let place = OfContour { owner: [index, rank()].map(small), cut: cut(), feeds, profile, unit: marker.unit };
            lines.extend(outline.lines(place));
        }
        if profile.knife.follow == Follow::Chord {
            for line in &mut lines {
                line.tight = tight::stretches(line, &profile.knife).into();
            }
        }
        Self { lines, ranks: rank(), cuts: cut() }
    }
}

/// The line of a slit, `cap` mm/s being the greatest speed of the tip.
fn slit<'a>(stroke: &NotchStroke, owner: [u32; 2], index: u32, cap: f64) -> Line<'a> {
    let from = Vertex { station: 0.0, sagitta: 0.0, block: stroke.span.block };
    let to = Vertex { station: stroke.length(), ..from };
    let points = Cow::Owned(vec![stroke.from, stroke.to]);
    let cut = OfCut { index, offset: 0.0, round: None, bounds: false, is_bare: true };
    Line::new(owner, cut, points, Box::new([from, to]), BothWays::One(cap), false)
}

/// An index or a rank, kept small: a large marker has a hundred thousand lines.
fn small(count: usize) -> u32 {
    u32::try_from(count).expect("a source below 4 GiB has fewer than 2^32 lines")
}
