//! The order of visits and which of each piece is made: the two chosen in turn.

use super::near::near;
use super::sequence::{START, Ways};
use super::small::AHEAD;
use super::times::Times;
use super::tour;
use crate::analysis::air::{Air, Stop};
use crate::geom::Extent;
use crate::pass::marker::visit::{Choices, Visit};

/// How often the order and the visits are chosen in turn, at the most.
const ROUNDS: usize = 6;
/// From which of these rounds on the order is looked for thoroughly: for rougher ones before other visits are chosen.
const THOROUGH: usize = 3;
/// Visits of which it is looked for from the first round on as well, at the most, and as often as something is gained.
const FEW: usize = 1000;

/// The visits of pieces, of which one each is made.
pub(super) struct Tours<'a> {
    pub(super) visits: &'a [Vec<Visit>],
    /// The boxes around the pieces.
    pub(super) extents: Vec<Extent>,
    /// Those that come before each.
    pub(super) before: Vec<Vec<u32>>,
    /// Where the axes stand first.
    pub(super) home: Stop,
    pub(super) air: Air,
    /// How far pieces may lie behind the foremost so far, mm, if that counts.
    pub(super) window: Option<f64>,
}

/// An order of visits, and which of each piece.
pub(super) struct Tour {
    pub(super) order: Vec<usize>,
    pub(super) visit: Vec<usize>,
    /// Time of the moves with the knife up, s.
    time: f64,
}

impl Tours<'_> {
    /// One with little travel that is much like an order: only what is improved step by step is another in it.
    pub(super) fn like(&self, order: Vec<usize>) -> Tour {
        self.improved(order, usize::MAX)
    }

    /// The shortest that is found.
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

    /// Whether none lies farther behind the foremost before it than the window, if there is one.
    fn keeps_window(&self, order: &[usize]) -> bool {
        let mut front = f64::NEG_INFINITY;
        order.iter().map(|&visit| self.extents[visit].min.x).all(|along| {
            let is_kept = self.window.is_none_or(|window| along >= front - window);
            front = front.max(along);
            is_kept
        })
    }

    /// An order improved; another is looked for thoroughly from some round on, of few visits until nothing is gained.
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

/// Strips that are narrower hold one piece each, mm.
const LEAST_STRIP: f64 = 1.0;

/// Visits in strips across the cloth, up and down in turn; with a window by their left edges, which that is about, and none
/// wider than what is left of that when a small piece is brought before one that it lies ahead of.
fn strips(extents: &[Extent], window: Option<f64>) -> Vec<usize> {
    let whole = extents.iter().fold(Extent::EMPTY, |mut whole, extent| {
        whole.join(extent);
        whole
    });
    let (width, height) = whole.size();
    let middle = |i: usize| extents[i].min + (extents[i].max - extents[i].min) / 2.0;
    // As wide as two pieces.
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
