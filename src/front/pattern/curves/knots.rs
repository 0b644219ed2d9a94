//! Knots: the vertices of a run that define its curve. Some systems add vertices at notches, which do not affect their own
//! curve. Vertices that lie on the curve through the others are therefore no knots.
//!
//! The search starts without all vertices that may have been added. While the curve misses some of them, it restores those
//! whose restoration leaves the fewest others missed. Then each restored vertex is removed once more, alone and with some after
//! it, because a knot that was missing at first may have been restored since. A vertex only bends the curve nearby, so each
//! trial uses a few knots around it.

use std::ops::Range;

use super::drafting::Drafting;
use super::leg::Stretch;
use super::nodes::{Node, ON};
use super::run::Run;
use crate::geom::budget::Budget;
use crate::geom::{Point, polyline};

/// Minimum number of knots of a ring.
const LEAST_RING: usize = 3;
/// Number of rounds in which one vertex per group is restored; later rounds restore all missed ones.
const MOST_ROUNDS: usize = 32;
/// Maximum number of vertices of a group tried in a round: those with the largest distances.
const MOST_TRIED: usize = 8;
/// Number of knots that separate two groups.
const BETWEEN_GROUPS: usize = 3;
/// Number of knots to each side of a vertex that affect the curve there by more than rounding.
const WINDOW: usize = 8;
/// Number of spans to each side of a vertex that are examined for its effect.
const SEEN: usize = 4;
/// Maximum number of following vertices that are removed together with a vertex.
const MOST_BEHIND: usize = 4;

/// A curve through a run.
pub(super) struct Fit {
    /// Indices of the knots in the run.
    pub(super) knots: Vec<usize>,
    /// The curve from each knot to the next; a ring also has one from the last to the first.
    pub(super) spans: Vec<Stretch>,
}

/// A vertex off the curve.
#[derive(Debug, Clone, Copy)]
struct Miss {
    /// Index in the run.
    place: usize,
    /// Distance from the curve, mm.
    distance: f64,
}

/// Lays the curve of a run; `None` if it needs too many points.
pub(super) fn fit(run: &Run, drafting: &mut Drafting, work: &mut Budget) -> Option<Fit> {
    let passing = Search::of(run, drafting, work).and_then(Search::run);
    let knots = passing.as_ref().map_or_else(|| (0..run.places.len()).collect(), |fit| fit.knots.clone());
    let points: Vec<Point> = knots.iter().map(|&i| run.at(i)).collect();
    let mut spans = drafting.spans(&points, run.is_ring);
    // Spans that pass vertices keep the finer chords of the trial that proved it.
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
    /// True for vertices that may have been added for a notch.
    is_added: Vec<bool>,
}

impl<'a> Search<'a> {
    /// Creates a search; `None` if every vertex is a knot.
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

    /// Restores vertices off the curve until there are none.
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

    /// The current curve, and the vertices off it.
    fn whole(&mut self) -> Option<(Fit, Vec<Miss>)> {
        let count = self.run.places.len();
        let knots: Vec<usize> = (0..count).filter(|&i| self.is_knot[i]).collect();
        let spans = self.curve(&knots, self.run.is_ring)?;
        let mut misses = self.misses(&knots, &spans, 0..spans.len())?;
        misses.sort_by_key(|miss| miss.place);
        Some((Fit { knots, spans }, misses))
    }

    /// Groups of missed vertices; one vertex of a group may cause the others.
    fn groups(&self, misses: &[Miss]) -> Vec<Vec<Miss>> {
        let knots = |range: Range<usize>| self.is_knot[range].iter().filter(|is_knot| **is_knot).count();
        let are_near = |a: &Miss, b: &Miss| knots(a.place..b.place) < BETWEEN_GROUPS;
        let mut groups: Vec<Vec<Miss>> = misses.chunk_by(are_near).map(<[Miss]>::to_vec).collect();
        // The last group of a ring may continue in the first.
        if let ([first, .., last], true) = (misses, self.run.is_ring)
            && groups.len() > 1
            && knots(last.place..self.is_knot.len()) + knots(0..first.place) < BETWEEN_GROUPS
        {
            let rest = groups.pop().unwrap_or_default();
            groups[0].splice(0..0, rest);
        }
        groups
    }

    /// The vertex of a group that, as a knot, leaves the fewest vertices missed nearby.
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

    /// Removes a vertex from the knots, alone or with some after it, if the curve still passes them. Returns the number of
    /// removed knots.
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

    /// Missed vertices around a vertex.
    fn around(&mut self, i: usize) -> Option<Vec<Miss>> {
        let count = self.run.places.len();
        let is_knot = |k: &usize| self.is_knot[k % count];
        // Indices past the last vertex of a ring belong to its next repetition.
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

    /// The trial curve through knots.
    fn curve(&mut self, knots: &[usize], is_ring: bool) -> Option<Vec<Stretch>> {
        let points: Vec<Point> = knots.iter().map(|&i| self.run.at(i)).collect();
        let spans = self.drafting.trial(&points, is_ring)?;
        let places: usize = spans.iter().map(Vec::len).sum();
        self.work.spend(knots.len() + places).then_some(spans)
    }

    /// Vertices missed by the spans `seen` of a curve through knots.
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
