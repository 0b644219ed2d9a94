//! Knots: the vertices of a run that define its curve. Some systems add vertices for the sake of notches, which their own
//! curve goes through without them: those that the curve of the others passes are no knots.
//!
//! The search starts without any of the vertices that may have been added. Where the curve misses some of them, it takes back
//! the one whose curve misses fewest of the others, until none is missed. Then each that was taken back is left out once more,
//! alone and with some behind it, since a knot that was missing then may be there now. A vertex bends the curve around it alone,
//! so one is tried on a few knots around it.

use std::ops::Range;

use super::drafting::Drafting;
use super::leg::Stretch;
use super::nodes::{Node, ON};
use super::run::Run;
use crate::geom::budget::Budget;
use crate::geom::{Point, polyline};

/// Least number of knots of a ring.
const LEAST_RING: usize = 3;
/// Rounds in which one vertex of each group is taken back; after them all that are missed.
const MOST_ROUNDS: usize = 32;
/// Vertices of a group that are tried in one round: those that are missed most.
const MOST_TRIED: usize = 8;
/// Knots between two groups.
const BETWEEN_GROUPS: usize = 3;
/// Knots to each side of a vertex that bend the curve there by more than rounding.
const WINDOW: usize = 8;
/// Spans to each side of a vertex that it bends enough to be looked at.
const SEEN: usize = 4;
/// Neighbours of a vertex with which it is left out.
const MOST_BEHIND: usize = 4;

/// A curve through a run.
pub(super) struct Fit {
    /// Positions of the knots in the run.
    pub(super) knots: Vec<usize>,
    /// The curve from each knot to the next, and of a ring from the last to the first.
    pub(super) spans: Vec<Stretch>,
}

/// A vertex that a curve misses.
#[derive(Debug, Clone, Copy)]
struct Miss {
    /// Position in the run.
    place: usize,
    /// mm.
    distance: f64,
}

/// Lays the curve of a run; `None` where it takes too many places.
pub(super) fn fit(run: &Run, drafting: &mut Drafting, work: &mut Budget) -> Option<Fit> {
    let passing = Search::of(run, drafting, work).and_then(Search::run);
    let knots = passing.as_ref().map_or_else(|| (0..run.places.len()).collect(), |fit| fit.knots.clone());
    let points: Vec<Point> = knots.iter().map(|&i| run.at(i)).collect();
    let mut spans = drafting.spans(&points, run.is_ring);
    // Where a vertex is passed, the chords keep as near to the curve as when that was found.
    if let (Some(spans), Some(fine)) = (&mut spans, passing) {
        let next = knots.iter().copied().skip(1).chain([knots[0] + run.places.len()]);
        for (k, (fine, next)) in fine.spans.into_iter().zip(next).enumerate() {
            if next > knots[k] + 1 {
                spans[k] = fine;
            }
        }
    }
    let spans = drafting.kept(spans)?;
    Some(Fit { knots, spans })
}

/// Search for the knots among the vertices of a run. Its functions return `None` beyond the budget.
struct Search<'a> {
    run: &'a Run<'a>,
    drafting: &'a Drafting,
    work: &'a mut Budget,
    is_knot: Vec<bool>,
    /// Whether a vertex may be there for the sake of a notch alone.
    is_added: Vec<bool>,
}

impl<'a> Search<'a> {
    /// A search; `None` where each vertex is a knot.
    fn of(run: &'a Run, drafting: &'a Drafting, work: &'a mut Budget) -> Option<Self> {
        let count = run.places.len();
        let is_inner = |i: usize| run.is_ring || (1..count - 1).contains(&i);
        let is_added: Vec<bool> =
            (0..count).map(|i| is_inner(i) && run.nodes[run.places[i]] == Node::Notched).collect();
        if !drafting.rule.may_pass_notches() || !is_added.contains(&true) {
            return None;
        }
        let mut is_knot: Vec<bool> = is_added.iter().map(|is_added| !is_added).collect();
        if run.is_ring && is_knot.iter().filter(|is_knot| **is_knot).count() < LEAST_RING {
            for k in 0..LEAST_RING {
                is_knot[k * count / LEAST_RING] = true;
            }
        }
        Some(Self { run, drafting, work, is_knot, is_added })
    }

    fn run(mut self) -> Option<Fit> {
        self.take_back()?;
        let mut knots = self.is_knot.iter().filter(|is_knot| **is_knot).count();
        for i in 0..self.is_knot.len() {
            if self.is_knot[i] && self.is_added[i] {
                knots -= self.leave_out(i, knots)?;
            }
        }
        self.take_back()
    }

    /// Takes back vertices that the curve misses until it misses none.
    fn take_back(&mut self) -> Option<Fit> {
        for round in 0.. {
            let (fit, misses) = self.whole()?;
            if misses.is_empty() {
                return Some(fit);
            }
            for group in self.groups(&misses) {
                if round < MOST_ROUNDS {
                    let best = self.best(&group)?;
                    self.is_knot[best] = true;
                } else {
                    for miss in group {
                        self.is_knot[miss.place] = true;
                    }
                }
            }
        }
        None
    }

    /// The curve as it is now, and what it misses.
    fn whole(&mut self) -> Option<(Fit, Vec<Miss>)> {
        let count = self.run.places.len();
        let knots: Vec<usize> = (0..count).filter(|&i| self.is_knot[i]).collect();
        let spans = self.curve(&knots, self.run.is_ring)?;
        let mut misses = self.misses(&knots, &spans, 0..spans.len())?;
        misses.sort_by_key(|miss| miss.place);
        Some((Fit { knots, spans }, misses))
    }

    /// Groups of missed vertices: one vertex of a group may be the reason for the others.
    fn groups(&self, misses: &[Miss]) -> Vec<Vec<Miss>> {
        let knots = |range: Range<usize>| self.is_knot[range].iter().filter(|is_knot| **is_knot).count();
        let are_near = |a: &Miss, b: &Miss| knots(a.place..b.place) < BETWEEN_GROUPS;
        let mut groups: Vec<Vec<Miss>> = misses.chunk_by(are_near).map(<[Miss]>::to_vec).collect();
        // The last group of a ring may go on in the first.
        if let ([first, .., last], true) = (misses, self.run.is_ring)
            && groups.len() > 1
            && knots(last.place..self.is_knot.len()) + knots(0..first.place) < BETWEEN_GROUPS
        {
            let rest = groups.pop().unwrap_or_default();
            groups[0].splice(0..0, rest);
        }
        groups
    }

    /// The vertex of a group that leaves least of it missed once it is a knot.
    fn best(&mut self, group: &[Miss]) -> Option<usize> {
        let mut tried = group.to_vec();
        tried.sort_by(|a, b| b.distance.total_cmp(&a.distance));
        tried.truncate(MOST_TRIED);
        let mut best: Option<((usize, f64), usize)> = None;
        for Miss { place, .. } in tried {
            self.is_knot[place] = true;
            let misses = self.around(place)?;
            self.is_knot[place] = false;
            let rest = (misses.len(), misses.iter().map(|miss| miss.distance).sum::<f64>());
            if best.is_none_or(|(least, _)| rest.0.cmp(&least.0).then(rest.1.total_cmp(&least.1)).is_lt()) {
                best = Some((rest, place));
            }
        }
        best.map(|(_, place)| place)
    }

    /// Leaves a vertex out of some knots, alone or with some behind it, where the curve passes them without: how many it
    /// leaves out.
    fn leave_out(&mut self, i: usize, knots: usize) -> Option<usize> {
        let count = self.run.places.len();
        let end = if self.run.is_ring { i + count } else { count };
        let behind = (i + 1..end).map(|k| k % count).filter(|&k| self.is_knot[k] && self.is_added[k]);
        let all: Vec<usize> = std::iter::once(i).chain(behind.take(MOST_BEHIND)).collect();
        let skipped = all.get(2).map(|&next| vec![i, next]);
        for set in (1..=all.len()).map(|some| all[..some].to_vec()).chain(skipped) {
            if self.run.is_ring && knots < set.len() + LEAST_RING {
                continue;
            }
            self.set_knots(&set, false);
            if self.around(i)?.is_empty() {
                return Some(set.len());
            }
            self.set_knots(&set, true);
        }
        Some(0)
    }

    fn set_knots(&mut self, places: &[usize], are_knots: bool) {
        for &k in places {
            self.is_knot[k] = are_knots;
        }
    }

    /// Vertices around one that the curve misses.
    fn around(&mut self, i: usize) -> Option<Vec<Miss>> {
        let count = self.run.places.len();
        let is_knot = |k: &usize| self.is_knot[k % count];
        // Places beyond the last of a ring lie in its next round.
        let (middle, first, end) = if self.run.is_ring { (i + count, i + 1, i + 2 * count) } else { (i, 0, count) };
        let mut before: Vec<usize> = (first..middle).rev().filter(is_knot).take(WINDOW).collect();
        let behind: Vec<usize> = (middle..end).filter(is_knot).take(WINDOW).collect();
        let all = self.run.is_ring && before.len().min(behind.len()) < WINDOW;
        if all {
            return self.whole().map(|(_, misses)| misses);
        }
        before.reverse();
        let span = before.len().saturating_sub(1);
        let knots = [before, behind].concat();
        let spans = self.curve(&knots, false)?;
        self.misses(&knots, &spans, span.saturating_sub(SEEN)..(span + SEEN + 1).min(spans.len()))
    }

    /// The curve through knots, in the chords of a trial.
    fn curve(&mut self, knots: &[usize], is_ring: bool) -> Option<Vec<Stretch>> {
        let points: Vec<Point> = knots.iter().map(|&i| self.run.at(i)).collect();
        let spans = self.drafting.trial(&points, is_ring)?;
        let places: usize = spans.iter().map(Vec::len).sum();
        self.work.spend(knots.len() + places).then_some(spans)
    }

    /// Vertices that some spans of a curve through knots miss.
    fn misses(&mut self, knots: &[usize], spans: &[Stretch], seen: Range<usize>) -> Option<Vec<Miss>> {
        let count = self.run.places.len();
        let mut misses = Vec::new();
        for k in seen {
            let [from, to] = [knots[k], knots.get(k + 1).copied().unwrap_or(knots[0] + count)];
            if to == from + 1 {
                continue;
            }
            let way = [&[self.run.at(from)], &spans[k][..], &[self.run.at(to)]].concat();
            if !self.work.spend((to - from) * way.len()) {
                return None;
            }
            for i in from + 1..to {
                let distance = polyline::distance(self.run.at(i), &way);
                misses.extend((distance > ON).then_some(Miss { place: i % count, distance }));
            }
        }
        Some(misses)
    }
}
