//! Ordering of pieces, separately between any two events.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::rules::{Rules, extent};
use super::tours::{Tour, Tours};
use crate::analysis::air::{Air, Stop};
use crate::geom::{Point, bits};
use crate::ir::list::{Segment, SegmentList};
use crate::ir::marker::{Marker, OutlineNotch, Piece};
use crate::machine::Job;
use crate::pass::marker::visit::{Begin, Cuts, Visit};

/// Range of a search for orders.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Search {
    /// All orders.
    Whole,
    /// Orders similar to the present one.
    Near,
}

/// Orders pieces with the given cuts, block by block.
pub(super) fn order(marker: &mut Marker, job: &Job, cuts: &dyn Fn(usize, &Marker) -> Cuts, search: Search) {
    let routing = Routing::of(marker, job);
    let cuts: Vec<Cuts> = (0..marker.pieces.len()).map(|piece| cuts(piece, marker)).collect();
    let Marker { pieces, list, .. } = marker;
    let mut home = routing.home;
    for block in blocks(pieces) {
        // A conveyor moves the cloth under the axes: relative to the cloth they are that much farther.
        let advances = pieces[block.start].events.iter().map(|event| event.kind.advance_mm());
        home.at.x += f64::from(advances.sum::<u32>());
        let lay = Lay { cuts: &cuts[block.clone()], first: block.start, pieces, list };
        let route = routing.route(&lay, home, search);
        home = route.end;
        route.apply(&mut pieces[block], list);
    }
}

/// Pieces of a block.
struct Lay<'a> {
    /// Cuts of each.
    cuts: &'a [Cuts],
    /// Index of its first piece.
    first: usize,
    pieces: &'a [Piece],
    list: &'a SegmentList,
}

/// Blocks of pieces without an event between them: events stay between the same blocks.
fn blocks(pieces: &[Piece]) -> Vec<Range<usize>> {
    let asked = (1..pieces.len()).filter(|&i| !pieces[i].events.is_empty());
    let ends: Vec<usize> = asked.chain([pieces.len()]).collect();
    std::iter::once(0).chain(ends.iter().copied()).zip(ends.iter().copied()).map(|(first, end)| first..end).collect()
}

/// Parameters of routes.
struct Routing {
    air: Air,
    /// Position of the axes before the program, with the blade in any direction.
    home: Stop,
    rules: Rules,
}

/// Order of the pieces of a block.
struct Route {
    /// Indices in the block, each with its visit; `None` if nothing is cut.
    sequence: Vec<(usize, Option<Visit>)>,
    /// Stop at the last lift.
    end: Stop,
}

impl Route {
    /// Applies the order to the pieces of the block.
    fn apply(self, pieces: &mut [Piece], list: &mut SegmentList) {
        let events = pieces.first_mut().map(|first| std::mem::take(&mut first.events)).unwrap_or_default();
        let mut taken: Vec<Option<Piece>> = pieces.iter_mut().map(|piece| Some(std::mem::take(piece))).collect();
        for (slot, (i, visit)) in pieces.iter_mut().zip(self.sequence) {
            *slot = taken[i].take().expect("each piece comes once");
            if let Some(visit) = visit {
                apply(&visit, slot, list);
            }
        }
        if let Some(first) = pieces.first_mut() {
            first.events = events;
        }
    }
}

impl Routing {
    fn of(marker: &Marker, job: &Job) -> Self {
        let [x, y, _] = job.profile.home;
        Self { air: Air::new(job), home: Stop::anyhow(Point::new(x, y)), rules: Rules::of(marker, job) }
    }

    /// Best order of the pieces of a block, from the given position of the axes.
    fn route(&self, lay: &Lay, home: Stop, search: Search) -> Route {
        let left: Vec<usize> = (0..lay.cuts.len()).filter(|&i| !lay.cuts[i].is_empty()).collect();
        let visits: Vec<Vec<Visit>> = left.iter().map(|&i| lay.cuts[i].visits(&self.air)).collect();
        let extents = left.iter().map(|&i| extent(&lay.pieces[lay.first + i], lay.list)).collect();
        let place = |piece: usize| left.binary_search(&piece.checked_sub(lay.first)?).ok();
        let mut before = vec![Vec::new(); left.len()];
        for (k, &i) in left.iter().enumerate() {
            for holder in self.rules.held[lay.first + i].iter().filter_map(|&holder| place(holder)) {
                before[holder].push(k as u32);
            }
        }
        let tours = Tours { visits: &visits, extents, before, home, air: self.air, window: self.rules.window };
        let Tour { order, visit: chosen, .. } = match search {
            Search::Whole => tours.best(),
            Search::Near => tours.like((0..visits.len()).collect()),
        };
        let end = order.last().map_or(home, |&last| visits[last][chosen[last]].ends[1]);
        let mut visits: Vec<Option<Visit>> =
            visits.into_iter().zip(&chosen).map(|(mut of, &chosen)| Some(of.swap_remove(chosen))).collect();
        let visited = order.iter().map(|&k| (left[k], visits[k].take()));
        let empty = (0..lay.cuts.len()).filter(|i| left.binary_search(i).is_err()).map(|i| (i, None));
        Route { sequence: visited.chain(empty).collect(), end }
    }
}

/// Applies the sequence of notches and the starts of contours of a visit to a piece.
fn apply(visit: &Visit, piece: &mut Piece, list: &mut SegmentList) {
    piece.notches = visit.slits.iter().map(|&slit| piece.notches[slit]).collect();
    let begun = |i: usize| visit.cuts.iter().find(|(contour, _)| *contour == i).map(|(_, begin)| *begin);
    for (i, contour) in piece.contours.iter_mut().enumerate() {
        // The cuts of a contour with common lines have directions of their own.
        let Begin { segment, is_reversed } = begun(i).unwrap_or_default();
        if segment > 0 {
            let mut segments: Vec<Segment> = list.walk(contour.range).map(|(_, segment)| segment).collect();
            segments.rotate_left(segment);
            contour.range = list.append(segments).expect("it has as many segments as before");
        }
        if is_reversed {
            contour.range = contour.range.reversed();
            let points: BTreeSet<[u64; 2]> = list.points(contour.range).iter().map(|&point| bits(point)).collect();
            let is_on = |notch: &OutlineNotch| notch.mouth.iter().all(|&end| points.contains(&bits(end)));
            let of_contour = piece.outline_notches.iter_mut().filter(|notch| is_on(notch));
            of_contour.for_each(|notch| notch.mouth.reverse());
        }
    }
    if visit.cuts.iter().any(|(_, begin)| *begin != Begin::default()) {
        // Notches are sorted in the order in which the contours pass them.
        let places =
            piece.contours.iter().flat_map(|contour| list.walk(contour.range)).map(|(_, segment)| bits(segment.from));
        let place: BTreeMap<[u64; 2], usize> = places.zip(0..).collect();
        piece.outline_notches.sort_by_key(|notch| place.get(&bits(notch.mouth[0])).copied());
    }
}
