//! Inner: a piece that lies in another is cut before it: what is cut out is free and shifts, with all that lies in it.
//!
//! Needs: welded contours. In a file without numbers of pieces every contour is a piece. Leaves true: no piece that lies
//! within the outline of another comes behind it, unless something is asked of the operator between them; otherwise pieces
//! keep the order of the file. What is asked stays where it is: before the pieces that are brought before the one behind it.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use super::{MarkerPass, depth_cost, too_many_outlines};
use crate::diagnostic::Diagnostics;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::nest::Shape;
use crate::geom::region::Regions;
use crate::geom::{Extent, Point, ring};
use crate::ir::list::SegmentList;
use crate::ir::marker::{Contour, Event, Marker, Piece};
use crate::machine::Job;

pub(super) const PASS: MarkerPass =
    MarkerPass { name: "inner", about: "puts a piece that lies in another before it", run };

fn run(marker: &mut Marker, _: &Job, diagnostics: &mut Diagnostics) {
    let Marker { list, pieces, .. } = marker;
    let mut search = Search::new(list, pieces);
    // The pieces that wait for others that the file has behind them, each with these.
    let mut waiting: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    // The last piece so far before which something is asked: no other is brought past that.
    let mut asked = 0;
    for (i, piece) in pieces.iter().enumerate() {
        asked = if piece.events.is_empty() { asked } else { i };
        for holder in search.holders(i).into_iter().filter(|holder| (asked..i).contains(holder)) {
            waiting.entry(holder).or_default().push(i);
        }
    }
    if let Some(i) = search.ended {
        diagnostics.push(too_many_outlines(&pieces[i]));
        return;
    }
    if !waiting.is_empty() {
        // Pieces move only between two places where something is asked, so that these are still the first of theirs.
        let events: Vec<Vec<Event>> = pieces.iter_mut().map(|piece| std::mem::take(&mut piece.events)).collect();
        let mut left: Vec<Option<Piece>> = pieces.drain(..).map(Some).collect();
        pieces.extend(inside_out(left.len(), waiting).into_iter().filter_map(|i| left[i].take()));
        for (piece, events) in pieces.iter_mut().zip(events) {
            piece.events = events;
        }
    }
}

/// The order of so many pieces in which each comes when all that it waits for has come, and otherwise as in the file.
fn inside_out(count: usize, mut waiting: BTreeMap<usize, Vec<usize>>) -> Vec<usize> {
    for inner in waiting.values_mut() {
        inner.reverse(); // the first is the last to be taken
    }
    let (mut order, mut is_done, mut open) = (Vec::with_capacity(count), vec![false; count], Vec::new());
    for next in 0..count {
        open.extend((!is_done[next]).then_some(next));
        while let Some(&piece) = open.last() {
            if let Some(inner) = waiting.get_mut(&piece).and_then(Vec::pop) {
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

/// What it takes to tell what lies in what.
struct Search<'a> {
    list: &'a SegmentList,
    pieces: &'a [Piece],
    /// The boxes around the closed contours of the pieces.
    spaces: Boxes,
    /// The pieces whose boxes others cover.
    covered: BTreeSet<usize>,
    /// The closed contours of these others, and the piece of each.
    wide: Regions<'a>,
    piece_of: Vec<usize>,
    /// The area within the widest contour of each of them, mm^2.
    areas: BTreeMap<usize, f64>,
    work: Budget,
    /// The piece at which no work was left.
    ended: Option<usize>,
}

impl<'a> Search<'a> {
    fn new(list: &'a SegmentList, pieces: &'a [Piece]) -> Self {
        let space = |piece: &Piece| extent(list, closed(piece));
        let mut search = Self {
            list,
            pieces,
            spaces: Boxes::new(pieces.par_iter().map(space).collect()),
            covered: BTreeSet::new(),
            wide: Regions::default(),
            piece_of: Vec::new(),
            areas: BTreeMap::new(),
            work: Budget::of_a_marker(),
            ended: None,
        };
        let mut is_wide = vec![false; pieces.len()];
        for i in 0..pieces.len() {
            let mut depth = 0;
            for wider in search.wider(i) {
                is_wide[wider] = true;
                depth += 1;
            }
            if depth > 0 {
                search.covered.insert(i);
            }
            search.spend(depth_cost(depth), i);
        }
        let wide = (0..pieces.len()).filter(|&i| is_wide[i]);
        let contours = |i: usize| closed(&pieces[i]).map(move |contour| (contour.range, i));
        let (ranges, piece_of): (Vec<_>, Vec<_>) = wide.flat_map(contours).unzip();
        for (&range, &i) in ranges.iter().zip(&piece_of) {
            let area = ring::area(&list.points(range)).abs();
            search.areas.entry(i).and_modify(|widest| *widest = widest.max(area)).or_insert(area);
        }
        search.wide = Regions::new(0..ranges.len() as u32, |i| vec![list.points(ranges[i as usize])]);
        search.piece_of = piece_of;
        search
    }

    /// The pieces whose boxes cover that of a piece.
    fn wider(&mut self, i: usize) -> Vec<usize> {
        let space = self.extent(i);
        if space.is_empty() || !self.spend(self.spaces.cost_at(space.min), i) {
            return Vec::new();
        }
        // What covers a box holds its corner.
        let others = self.spaces.at(space.min).filter(|&k| k != i);
        others.filter(|&k| self.spaces.all()[k].covers(&space)).collect()
    }

    /// The pieces within whose outlines a piece lies, in order.
    fn holders(&mut self, i: usize) -> Vec<usize> {
        if !self.covered.contains(&i) {
            return Vec::new(); // as nearly all
        }
        let mut wider = self.wider(i);
        let Some(place) = self.place(i) else { return Vec::new() };
        if !self.spend(self.wide.cost_at(place), i) {
            return Vec::new();
        }
        let around = self.wide.owners_at(place);
        let around: BTreeSet<usize> = around.into_iter().map(|contour| self.piece_of[contour as usize]).collect();
        let space = self.extent(i);
        let area = |piece: &usize| self.areas.get(piece).copied().unwrap_or_default();
        let is_larger = |k: &usize| self.spaces.all()[*k] != space || area(k) > area(&i);
        wider.retain(|k| around.contains(k) && is_larger(k));
        self.spend(depth_cost(wider.len()), i);
        wider
    }

    /// The box of a piece: around its closed contours, or around the others where none is closed.
    fn extent(&self, i: usize) -> Extent {
        let space = self.spaces.all()[i];
        if space.is_empty() { extent(self.list, self.pieces[i].contours.iter()) } else { space }
    }

    /// A place of a piece: well inside it, or the middle of the first segment of a line, which may begin on an outline.
    fn place(&self, i: usize) -> Option<Point> {
        let rings: Vec<_> = closed(&self.pieces[i]).map(|contour| self.list.points(contour.range)).collect();
        if !rings.is_empty() {
            return Shape::new(&rings).inner();
        }
        let line = self.list.points(self.pieces[i].contours.first()?.range);
        Some(line[0] + (line[1] - line[0]) / 2.0)
    }

    /// Takes work for a piece; `false` when none is left.
    fn spend(&mut self, amount: usize, i: usize) -> bool {
        let is_left = self.work.spend(amount);
        self.ended = self.ended.or(Some(i).filter(|_| !is_left));
        is_left
    }
}

fn extent<'a>(list: &SegmentList, contours: impl Iterator<Item = &'a Contour>) -> Extent {
    let mut extent = Extent::EMPTY;
    contours.for_each(|contour| extent.join(&Extent::of(&list.points(contour.range))));
    extent
}

fn closed(piece: &Piece) -> impl Iterator<Item = &Contour> {
    piece.contours.iter().filter(|contour| contour.closed)
}
