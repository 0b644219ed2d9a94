//! Order: cuts the contents of a contour before it, and the outline last: once a part is free it shifts, with everything in it.
//!
//! Needs: welded contours. In a file without piece numbers every contour is a piece. Leaves true: no contour follows a closed
//! one of its piece that contains it, and no piece follows one whose outline contains it, unless an event lies between them;
//! otherwise contours and pieces keep the order of the file. Events keep their places: pieces moved forward stay behind the
//! event before them. Holes and slits precede all contours anyway.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::ops::Range;

use super::pass::MarkerPass;
use super::search::too_many_outlines;
use crate::analysis::nesting::Nesting;
use crate::diagnostic::Diagnostics;
use crate::ir::marker::{Event, Marker, Piece};
use crate::machine::Job;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "order", about: "puts what lies inside a contour before it, the outline last", run };

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    let nesting = Nesting::of(marker, job.profile.band(marker.unit));
    if let Some(line) = nesting.ended() {
        diagnostics.push(too_many_outlines(&marker.pieces[nesting.lines()[line].group as usize]));
        return;
    }
    if nesting.is_flat() {
        return; // the usual case for markers of whole parts: no nesting
    }
    for (piece, i) in marker.pieces.iter_mut().zip(0..) {
        sort_contours(piece, nesting.of_group(i), &nesting);
    }
    let waiting = waiting(&marker.pieces, &nesting);
    sort_pieces(&mut marker.pieces, &waiting);
}

/// Sorts the contours of a piece by the outermost contour around them, the most deeply nested first.
fn sort_contours(piece: &mut Piece, lines: Range<usize>, nesting: &Nesting) {
    if piece.contours.len() < 2 {
        return;
    }
    let place = |line: usize| {
        let around = || nesting.around(line).filter(|outer| lines.contains(outer));
        (around().next_back().unwrap_or(line), Reverse(around().count()))
    };
    let mut order: Vec<usize> = lines.clone().collect();
    order.sort_by_key(|&line| place(line)); // stable: the order of the file among equals
    piece.contours = order.into_iter().map(|line| piece.contours[line - lines.start]).collect();
}

/// Pieces that must wait for later ones of the file, each with these.
fn waiting(pieces: &[Piece], nesting: &Nesting) -> BTreeMap<usize, Vec<usize>> {
    let mut waiting: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    // Last piece so far with an event before it: no other piece is moved past that.
    let mut asked = 0;
    for (i, piece) in pieces.iter().enumerate() {
        asked = if piece.events.is_empty() { asked } else { i };
        for holder in nesting.holders(i).into_iter().filter(|holder| (asked..i).contains(holder)) {
            waiting.entry(holder).or_default().push(i);
        }
    }
    waiting
}

/// Reorders pieces so that each follows all those for which it waits, otherwise as in the file.
fn sort_pieces(pieces: &mut Vec<Piece>, waiting: &BTreeMap<usize, Vec<usize>>) {
    if waiting.is_empty() {
        return; // the usual case
    }
    // Pieces move only between two events, so that these keep their places.
    let events: Vec<Vec<Event>> = pieces.iter_mut().map(|piece| std::mem::take(&mut piece.events)).collect();
    let mut left: Vec<Option<Piece>> = pieces.drain(..).map(Some).collect();
    pieces.extend(inside_out(left.len(), waiting).into_iter().filter_map(|i| left[i].take()));
    for (piece, events) in pieces.iter_mut().zip(events) {
        piece.events = events;
    }
}

fn inside_out(count: usize, waiting: &BTreeMap<usize, Vec<usize>>) -> Vec<usize> {
    let mut left: BTreeMap<usize, std::slice::Iter<usize>> =
        waiting.iter().map(|(&piece, inner)| (piece, inner.iter())).collect();
    let (mut order, mut is_done, mut open) = (Vec::with_capacity(count), vec![false; count], Vec::new());
    for next in 0..count {
        open.extend((!is_done[next]).then_some(next));
        while let Some(&piece) = open.last() {
            if let Some(&inner) = left.get_mut(&piece).and_then(Iterator::next) {
                open.extend((!is_done[inner]).then_some(inner));
            } else {
                is_done[piece] = true;
                order.push(piece);
                open.pop();
            }
        }
    }
    order
}
