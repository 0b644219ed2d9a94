//! Route: the order of pieces, notches and starts in which the knife travels least.
//!
//! Needs: all pieces with their notches, what lies within a part before it. Leaves true: with `order.policy` `"file"`
//! everything; else the same pieces, each whole, what lies within a part before that still, events between the same pieces;
//! slits on the way round, closed contours begun as they are drawn or at a corner, either way round, open ones from either
//! end, unless the file asks for something on them. With `"steady"` no piece lies farther behind the foremost so far
//! than `order.window_mm`, but where something within it does.

mod near;
mod sequence;
mod times;
mod tour;
mod visit;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use self::near::near;
use self::sequence::{START, Ways};
use self::times::Times;
use self::visit::{Begin, Cuts, Measures, Visit};
use super::pass::MarkerPass;
use crate::analysis::air::{Air, Stop};
use crate::analysis::nesting::Nesting;
use crate::diagnostic::Diagnostics;
use crate::geom::{Extent, Point, bits};
use crate::ir::list::{Segment, SegmentList};
use crate::ir::marker::{Marker, OutlineNotch, Piece};
use crate::machine::{Job, OrderPolicy};

pub(super) const PASS: MarkerPass = MarkerPass {
    name: "route",
    about: "orders pieces and notches and chooses starts and directions for the shortest travel",
    run,
};

/// How often the order and the visits are chosen in turn, at the most.
const ROUNDS: usize = 6;
/// From which of these rounds on the order is looked for thoroughly: for rougher ones before other visits are chosen.
const THOROUGH: usize = 3;
/// Visits of which it is looked for from the first round on as well, at the most, and as often as something is gained.
const FEW: usize = 1000;

fn run(marker: &mut Marker, job: &Job, _: &mut Diagnostics) {
    let policy = job.profile.order.policy(marker.drawing.is_some());
    if policy == OrderPolicy::File {
        return;
    }
    let routing = Routing::of(marker, job, policy);
    let Marker { pieces, list, .. } = marker;
    let mut home = routing.home();
    for block in blocks(pieces) {
        let route = routing.route(block.clone(), pieces, list, home);
        home = route.end;
        route.apply(&mut pieces[block], list);
    }
}

/// The pieces in blocks among which nothing is asked of the operator: that is asked between the same ones.
fn blocks(pieces: &[Piece]) -> Vec<Range<usize>> {
    let asked = (1..pieces.len()).filter(|&i| !pieces[i].events.is_empty());
    let ends: Vec<usize> = asked.chain([pieces.len()]).collect();
    std::iter::once(0).chain(ends.iter().copied()).zip(ends.iter().copied()).map(|(first, end)| first..end).collect()
}

/// What routes go by.
struct Routing<'a> {
    job: &'a Job,
    policy: OrderPolicy,
    measures: Measures,
    /// For each piece those within whose outlines it lies.
    held: Vec<Vec<usize>>,
}

/// The order of the pieces of a block.
struct Route {
    /// Places in the block, each with how it is visited; none where nothing is cut.
    sequence: Vec<(usize, Option<Visit>)>,
    /// Where the knife comes up in the end.
    end: Stop,
}

impl Route {
    /// Puts the pieces of the block in its order.
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

impl<'a> Routing<'a> {
    fn of(marker: &Marker, job: &'a Job, policy: OrderPolicy) -> Self {
        let nesting = Nesting::of(marker);
        let held = (0..marker.pieces.len()).map(|piece| nesting.holders(piece)).collect();
        let measures = Measures { air: Air::new(job), corner: job.profile.corner.angle(), unit: marker.unit };
        Self { job, policy, measures, held }
    }

    /// Where the axes stand before the program, whatever the blade does there.
    fn home(&self) -> Stop {
        let [x, y, _] = self.job.profile.home;
        Stop::anyhow(Point::new(x, y))
    }

    /// The pieces of a block in the best order.
    fn route(&self, block: Range<usize>, pieces: &[Piece], list: &SegmentList, home: Stop) -> Route {
        let of = |piece: &Piece| Cuts::of(piece, list, &self.measures);
        let cuts: Vec<Cuts> = pieces[block.clone()].iter().map(of).collect();
        let left: Vec<usize> = (0..cuts.len()).filter(|&i| !cuts[i].is_empty()).collect();
        let visits: Vec<Vec<Visit>> = left.iter().map(|&i| cuts[i].visits(&self.measures.air)).collect();
        let extents: Vec<Extent> = left.iter().map(|&i| extent(&pieces[block.start + i], list)).collect();
        let place = |piece: usize| left.binary_search(&piece.checked_sub(block.start)?).ok();
        let mut before = vec![Vec::new(); left.len()];
        for (k, &i) in left.iter().enumerate() {
            for holder in self.held[block.start + i].iter().filter_map(|&holder| place(holder)) {
                before[holder].push(k as u32);
            }
        }
        let Chosen { order, visit: chosen, .. } = self.tour(&visits, &extents, &before, home);
        let end = order.last().map_or(home, |&last| visits[last][chosen[last]].ends[1]);
        let mut visits: Vec<Option<Visit>> =
            visits.into_iter().zip(&chosen).map(|(mut of, &chosen)| Some(of.swap_remove(chosen))).collect();
        let visited = order.iter().map(|&k| (left[k], visits[k].take()));
        let empty = (0..cuts.len()).filter(|i| left.binary_search(i).is_err()).map(|i| (i, None));
        Route { sequence: visited.chain(empty).collect(), end }
    }

    /// The order of visits, and which of each piece.
    fn tour(&self, visits: &[Vec<Visit>], extents: &[Extent], before: &[Vec<u32>], home: Stop) -> Chosen {
        let late = self.tour_in_rounds(visits, extents, before, home, THOROUGH);
        if visits.len() > FEW {
            return late;
        }
        let early = self.tour_in_rounds(visits, extents, before, home, 1);
        if early.time < late.time { early } else { late }
    }

    /// The same; the order is looked for thoroughly from some round on, of few until nothing is gained.
    fn tour_in_rounds(
        &self,
        visits: &[Vec<Visit>],
        extents: &[Extent],
        before: &[Vec<u32>],
        home: Stop,
        first: usize,
    ) -> Chosen {
        let air = &self.measures.air;
        let along: Vec<f64> = extents.iter().map(|extent| extent.min.x).collect();
        let window = (self.policy == OrderPolicy::Steady).then_some(self.job.profile.order.window_mm);
        let mut order = inner_first(strips(extents, window), before);
        let (mut chosen, mut whole) = visit::choose(&order, visits, &home, air);
        for round in 1..=ROUNDS {
            let ends: Vec<[Stop; 2]> = visits.iter().zip(&chosen).map(|(of, &chosen)| of[chosen].ends).collect();
            let near = near(&ends.iter().map(|ends| ends.map(|stop| stop.at)).collect::<Vec<_>>());
            let time =
                |from: usize, to: usize| air.time(if from == START { &home } else { &ends[from][1] }, &ends[to][0]);
            let times = Times::new(ends.len(), &time);
            let time = |from: usize, to: usize| times.time(from, to);
            let ways = Ways { time: &time, near: &near, before, along: &along, window };
            tour::improve(&mut order, &ways, (round >= first).then_some(round as u64));
            let last = whole;
            (chosen, whole) = visit::choose(&order, visits, &home, air);
            if round >= first && (whole >= last || order.len() > FEW) {
                break;
            }
        }
        Chosen { order, visit: chosen, time: whole }
    }
}

/// An order of visits, and which of each piece.
struct Chosen {
    order: Vec<usize>,
    visit: Vec<usize>,
    /// Time of the moves with the knife up, s.
    time: f64,
}

/// The box around all of a piece.
fn extent(piece: &Piece, list: &SegmentList) -> Extent {
    let mut extent = Extent::EMPTY;
    piece.contours.iter().for_each(|contour| extent.join(&Extent::of(&list.points(contour.range))));
    piece.notches.iter().for_each(|notch| extent.join(&Extent::between(notch.root, notch.tip)));
    piece.drills.iter().for_each(|drill| extent.join(&Extent::between(drill.at, drill.at)));
    extent
}

/// Strips that are narrower hold one piece each, mm.
const LEAST_STRIP: f64 = 1.0;

/// Visits in strips across the cloth, up and down in turn; with a window by their left edges, which that is about, and none
/// wider than that.
fn strips(extents: &[Extent], window: Option<f64>) -> Vec<usize> {
    let whole = extents.iter().fold(Extent::EMPTY, |mut whole, extent| {
        whole.join(extent);
        whole
    });
    let (width, height) = whole.size();
    let middle = |i: usize| extents[i].min + (extents[i].max - extents[i].min) / 2.0;
    // As wide as two pieces.
    let strip = 2.0 * (width * height / extents.len().max(1) as f64).sqrt();
    let strip = strip.min(window.unwrap_or(f64::INFINITY)).max(LEAST_STRIP);
    let key = |&i: &usize| {
        let at = middle(i);
        let along = if window.is_some() { extents[i].min.x } else { at.x };
        let strip = ((along - whole.min.x) / strip).floor();
        (strip, if strip % 2.0 == 0.0 { at.y } else { -at.y })
    };
    let mut order: Vec<usize> = (0..extents.len()).collect();
    order.sort_by(|a, b| {
        let ((a, up), (b, other)) = (key(a), key(b));
        a.total_cmp(&b).then(up.total_cmp(&other))
    });
    order
}

/// The same order, but each behind those that come before it.
fn inner_first(order: Vec<usize>, before: &[Vec<u32>]) -> Vec<usize> {
    let mut sorted = Vec::with_capacity(order.len());
    let mut is_done = vec![false; order.len()];
    let mut waiting: Vec<_> = before.iter().map(|before| before.iter()).collect();
    let mut open = Vec::new();
    for visit in order {
        open.push(visit);
        while let Some(&visit) = open.last() {
            if let Some(&inner) = waiting[visit].next() {
                open.push(inner as usize);
            } else {
                open.pop();
                sorted.extend((!is_done[visit]).then_some(visit));
                is_done[visit] = true;
            }
        }
    }
    sorted
}

/// Puts the notches of a piece in the sequence of a visit, and lets its contours start where that has it.
fn apply(visit: &Visit, piece: &mut Piece, list: &mut SegmentList) {
    piece.notches = visit.slits.iter().map(|&slit| piece.notches[slit]).collect();
    for (contour, &Begin { segment, is_reversed }) in piece.contours.iter_mut().zip(&visit.starts) {
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
    if visit.starts.iter().any(|start| *start != Begin::default()) {
        // They stand in the order in which the contours come to them.
        let places =
            piece.contours.iter().flat_map(|contour| list.walk(contour.range)).map(|(_, segment)| bits(segment.from));
        let place: BTreeMap<[u64; 2], usize> = places.zip(0..).collect();
        piece.outline_notches.sort_by_key(|notch| place.get(&bits(notch.mouth[0])).copied());
    }
}
