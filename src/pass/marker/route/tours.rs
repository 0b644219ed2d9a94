//! Alternating choice of the order of pieces and of the visit of each piece.

use super::near::near;
use super::sequence::{START, Ways};
use super::small::AHEAD;
use super::times::Times;
use super::tour;
use crate::analysis::air::{Air, Stop};
use crate::geom::Extent;
use crate::pass::marker::visit::{Choices, Visit};

/// Greatest number of alternations.
const ROUNDS: usize = 6;
/// First of these rounds with a thorough search for the order: a rough one suffices before other visits are chosen.
const THOROUGH: usize = 3;
/// Greatest number of visits for which the search is thorough from the first round on, and repeated as long as it gains.
const FEW: usize = 1000;

/// Visits of pieces, one of which is made for each.
pub(super) struct Tours<'a> {
    pub(super) visits: &'a [Vec<Visit>],
    /// Bounding boxes of the pieces.
    pub(super) extents: Vec<Extent>,
    /// Pieces that must precede each.
    pub(super) before: Vec<Vec<u32>>,
    /// Initial position of the axes.
    pub(super) home: Stop,
    pub(super) air: Air,
    /// Greatest distance of a piece behind the foremost so far, mm; `None` = any.
    pub(super) window: Option<f64>,
}

/// Order of pieces, and the visit of each.
pub(super) struct Tour {
    pub(super) order: Vec<usize>,
    pub(super) visit: Vec<usize>,
    /// Duration of the moves with the knife up, s.
    time: f64,
}

impl Tours<'_> {
    /// Tour with little travel that resembles an order: only incremental improvements are made.
    pub(super) fn like(&self, order: Vec<usize>) -> Tour {
        self.improved(order, usize::MAX)
    }

    /// Shortest tour found.
    pub(super) fn best(&self) -> Tour {
        let strips = || inner_first(strips(&self.extents, self.window), &self.before);
        let late = self.improved(strips(), THOROUGH);
        if self.visits.len() > FEW {
            return late;
        }
        let given = inner_first((0..self.visits.len()).collect(), &self.before);
        let given = Some(given).filter(|order| self.keeps_window(order));
        let others = given.into_iter().chain([strips()]).map(|order| self.improved(order, 1));
        others.fold(late, |best, other| if other.time < best.time { other } else { best })
    }

    /// True if no piece lies farther behind the foremost before it than the window, if there is one.
    fn keeps_window(&self, order: &[usize]) -> bool {
        let mut front = f64::NEG_INFINITY;
        order.iter().map(|&visit| self.extents[visit].min.x).all(|along| {
            let is_kept = self.window.is_none_or(|window| along >= front - window);
            front = front.max(along);
            is_kept
        })
    }

    /// Improved order; the search is thorough from a round on, and for few visits repeated until nothing is gained.
    fn improved(&self, mut order: Vec<usize>, first: usize) -> Tour {
        let &Self { visits, ref before, home, air, window, .. } = self;
        let choices = Choices { visits, home, air };
        let along: Vec<f64> = self.extents.iter().map(|extent| extent.min.x).collect();
        let (mut chosen, mut whole) = choices.choose(&order);
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
            (chosen, whole) = choices.choose(&order);
            let is_thorough = round >= first || first > ROUNDS;
            if is_thorough && (whole >= last || order.len() > FEW) {
                break;
            }
        }
        Tour { order, visit: chosen, time: whole }
    }
}

/// Least width of a strip, mm.
const LEAST_STRIP: f64 = 1.0;

/// Visits in strips across the cloth, alternately up and down. With a window, strips are assigned by left edges, as in the
/// window, and are at most as wide as the part of it that remains when a small piece is moved before one behind it.
fn strips(extents: &[Extent], window: Option<f64>) -> Vec<usize> {
    let whole = extents.iter().fold(Extent::EMPTY, |mut whole, extent| {
        whole.join(extent);
        whole
    });
    let (width, height) = whole.size();
    let middle = |i: usize| extents[i].min + (extents[i].max - extents[i].min) / 2.0;
    // Width of two pieces.
    let strip = 2.0 * (width * height / extents.len().max(1) as f64).sqrt();
    let strip = strip.min(window.map_or(f64::INFINITY, |window| (1.0 - AHEAD) * window)).max(LEAST_STRIP);
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

/// Order modified so that each visit follows those that must precede it.
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
