//! Bite: windows of a conveyor, and how far the cloth is moved on between them.
//!
//! Needs: the pieces on the table, what lies within a part before it. Leaves true: without `bite.length_mm` everything; else
//! every piece lies in one window with all that the blade reaches beyond its lines, windows come in the order of their places
//! along X, and the first piece of each but the first has the way of the cloth before it, in whole mm. Within a window pieces
//! keep their order.
//!
//! A window takes every piece that ends in it, and the next one begins where the first of the others does. As no piece is
//! split, no other choice needs fewer windows: one that begins farther back ends farther back. Where the file moves the cloth
//! on by itself (M69) its own windows are kept, and so is the place of every stop.

use super::pass::MarkerPass;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Extent;
use crate::ir::marker::{Event, Marker, Notch, Piece};
use crate::ir::toolpath;
use crate::machine::Job;
use crate::units::number::{fixed, up};

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "bite", about: "parts a marker into the windows of a conveyor", run };

/// Decimals of lengths in messages, mm.
const DECIMALS: u32 = 1;

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    let Some(length) = job.profile.bite.length_mm else { return };
    let reach = job.profile.knife.reach();
    let spans: Vec<Option<Reached>> = marker.pieces.iter().map(|piece| reached(marker, piece, reach)).collect();
    let Some(least) = spans.iter().flatten().map(|span| span.from).reduce(f64::min) else { return };
    let start = job.profile.table.x_mm.map_or(least, |[start, _]| start);
    let mut windows = Windows { length, start, by: 0, is_begun: false };
    let mut order: Vec<(usize, u32)> = Vec::with_capacity(spans.len());
    for block in blocks(&marker.pieces) {
        let moves_on = marker.pieces[block.start].events.iter().any(|event| event.kind == toolpath::Event::Advance);
        if let Err(finding) = windows.take(block.map(|i| (i, spans[i])).collect(), moves_on, &mut order) {
            diagnostics.push(finding.told(marker, length));
            return;
        }
    }
    let end = spans.iter().flatten().map(|span| span.to).fold(start, f64::max);
    lay(marker, &order, windows.behind(end));
}

/// Where the blade may stand along X while it cuts a piece, mm.
#[derive(Debug, Clone, Copy)]
struct Reached {
    from: f64,
    to: f64,
}

/// Where the blade may stand for a piece; `None` where nothing of it is cut.
fn reached(marker: &Marker, piece: &Piece, reach: f64) -> Option<Reached> {
    let mut extent = Extent::EMPTY;
    piece.contours.iter().for_each(|contour| extent.join(&marker.list.extent(contour.range)));
    for stroke in piece.notches.iter().flat_map(Notch::strokes) {
        extent.join(&Extent::between(stroke.from, stroke.to));
    }
    piece.drills.iter().for_each(|drill| extent.add(drill.at));
    (!extent.is_empty()).then_some(Reached { from: extent.min.x - reach, to: extent.max.x + reach })
}

/// Pieces between two places where something is asked for: no piece is brought past one.
fn blocks(pieces: &[Piece]) -> Vec<std::ops::Range<usize>> {
    let mut starts: Vec<usize> = (0..pieces.len()).filter(|&i| i == 0 || !pieces[i].events.is_empty()).collect();
    starts.push(pieces.len());
    starts.windows(2).map(|ends| ends[0]..ends[1]).collect()
}

/// Windows as they are laid.
struct Windows {
    /// Length of each, mm.
    length: f64,
    /// Where the first begins, mm.
    start: f64,
    /// How far the cloth has been moved on, whole mm.
    by: u32,
    /// Whether anything was cut so far.
    is_begun: bool,
}

/// Why a piece is in no window.
enum Misfit {
    /// It is longer than a window; its length with what the blade needs beside it, mm.
    Long(usize, f64),
    /// It begins before the window that the file has come to, by so much, mm.
    Behind(usize, f64),
}

impl Windows {
    /// Puts the pieces of a block into windows: the place of each, with the way of the cloth by then. Behind an advance of the
    /// file a window begins.
    fn take(
        &mut self,
        mut left: Vec<(usize, Option<Reached>)>,
        moves_on: bool,
        order: &mut Vec<(usize, u32)>,
    ) -> Result<(), Misfit> {
        let mut is_next = moves_on && self.is_begun;
        while !left.is_empty() {
            let cut = left.iter().filter_map(|&(i, span)| Some((i, span?)));
            let first = cut.min_by(|(_, a), (_, b)| a.from.total_cmp(&b.from));
            if let Some((i, Reached { from, .. })) = first {
                let begins = self.start + f64::from(self.by);
                // Of the first window the table is the judge.
                if from < begins && self.by > 0 {
                    return Err(Misfit::Behind(i, begins - from));
                }
                if is_next {
                    self.by += (from - begins).floor() as u32;
                }
            }
            let end = self.start + f64::from(self.by) + self.length;
            let count = left.len();
            left.retain(|&(i, span)| {
                let is_in = span.is_none_or(|span| span.to <= end);
                if is_in {
                    order.push((i, self.by));
                    self.is_begun |= span.is_some();
                }
                !is_in
            });
            if let Some((i, span)) = first.filter(|_| is_next && left.len() == count) {
                return Err(Misfit::Long(i, span.to - span.from));
            }
            is_next = true;
        }
        Ok(())
    }

    /// How far the cloth is moved on until a place is behind the windows, whole mm.
    fn behind(&self, end: f64) -> u32 {
        (end - self.start).ceil().max(0.0) as u32
    }
}

impl Misfit {
    fn told(self, marker: &Marker, length: f64) -> Diagnostic {
        let has = fixed(length, DECIMALS);
        let (piece, message, hint) = match self {
            Self::Long(i, long) => {
                let (number, long) = (marker.pieces[i].number, up(long, DECIMALS));
                let message =
                    format!("piece {number} takes {long} mm along X with its overlaps, and a bite has {has} mm");
                (i, message, "turn the marker, or leave the piece out (`--skip`) and cut it on a longer table")
            }
            Self::Behind(i, by) => {
                let (number, by) = (marker.pieces[i].number, up(by, DECIMALS));
                let message = format!("piece {number} begins {by} mm before the bite in which the file has it");
                (i, message, "the file moves the cloth on, or stops, before it: a conveyor does not run back")
            }
        };
        let numbers = vec![marker.pieces[piece].number];
        Diagnostic::new(&code::MARKER_BITE, message).at(marker.pieces[piece].span).about(numbers).hint(hint)
    }
}

/// Puts pieces in order, and the ways of the cloth before the first of each window; an advance of the file at the end moves all
/// off the table.
fn lay(marker: &mut Marker, order: &[(usize, u32)], end: u32) {
    let mut pieces: Vec<Option<Piece>> = std::mem::take(&mut marker.pieces).into_iter().map(Some).collect();
    let bite = |mm: u32, span| Event { kind: toolpath::Event::Bite(mm), span };
    let mut at = 0;
    for &(i, by) in order {
        let mut piece = pieces[i].take().expect("each piece is in one window");
        let asked = piece.events.iter().find(|event| event.kind == toolpath::Event::Advance).map(|event| event.span);
        piece.events.retain(|event| event.kind != toolpath::Event::Advance);
        if by > at {
            piece.events.insert(0, bite(by - at, asked.unwrap_or(piece.span)));
        }
        at = by;
        marker.pieces.push(piece);
    }
    for event in &mut marker.closing {
        if event.kind == toolpath::Event::Advance {
            *event = bite(end.saturating_sub(at), event.span);
            at = end;
        }
    }
}
