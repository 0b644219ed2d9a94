//! Improvement of the order with common lines: a piece is cut where others leave some of its outline, and that affects the best
//! order in turn.
//!
//! The order of two parts determines with which of them an edge is cut, so that another order has other cuts. The search
//! repeats with the cuts of the last order, a few times; then pairs of parts with a common edge exchange their precedence. The
//! order whose cuts take the least time is kept.

use super::block::{Search, order};
use super::rules::Rules;
use crate::analysis::{air, duration};
use crate::ir::Marker;
use crate::ir::marker::Piece;
use crate::machine::Job;
use crate::pass::marker::cut::{self, Group};
use crate::pass::marker::visit::{Cuts, Measures};

/// Greatest number of rounds from each starting order.
const ROUNDS: usize = 12;
/// Greatest number of pieces ordered in all rounds together, except for one round.
const MOST_PIECES: usize = 2000;
/// Number of rounds without a gain after which the search ends.
const PATIENCE: usize = 3;
/// Greatest number of pieces in all orders with an exchanged pair together.
const MOST_EXCHANGED: usize = 20_000;
/// Least gain that counts, s.
const LEAST_GAIN: f64 = 1e-6;

/// Marker with its cuts.
struct Made {
    marker: Marker,
    groups: Vec<Group>,
    /// Approximate duration of the cuts and of the moves between them, s.
    time: f64,
}

/// Improves the order of pieces with common lines, also starting from the order of the file, where that suits the common edges.
pub(super) fn improve(marker: &mut Marker, as_filed: Marker, job: &Job) {
    let Some(least) = ordered(marker, as_filed, job) else { return };
    let best = Made::of(marker.clone(), job).exchanged(job).improved(job);
    if best.time < least - LEAST_GAIN {
        *marker = best.without_cuts();
    }
}

/// Improves the order without exchanging pairs of parts, which takes as long as everything else. Returns the approximate
/// duration of the cuts, s; `None` without common lines.
pub(super) fn ordered(marker: &mut Marker, as_filed: Marker, job: &Job) -> Option<f64> {
    let routed = Made::of(marker.clone(), job);
    if routed.marker.common.is_empty() {
        return None;
    }
    let as_is: Vec<usize> = (0..as_filed.pieces.len()).collect();
    let is_allowed = Rules::of(&as_filed, job).broken(&as_is) == 0;
    let filed = is_allowed.then(|| Made::of(as_filed, job));
    let mut least = routed.time;
    for made in filed.into_iter().chain([routed]) {
        let best = made.improved(job);
        if best.time < least - LEAST_GAIN {
            least = best.time;
            *marker = best.without_cuts();
        }
    }
    Some(least)
}

impl Made {
    fn of(mut marker: Marker, job: &Job) -> Self {
        let groups = cut::made(&mut marker, job);
        let time = air::spent(&marker, job) + duration::of_cuts(&marker, job);
        Self { marker, groups, time }
    }

    /// Best order found from here: each is searched near the previous one, with the cuts of that.
    fn improved(self, job: &Job) -> Self {
        let rounds = (MOST_PIECES / self.marker.pieces.len()).clamp(1, ROUNDS);
        let measures = Measures::new(job, &self.marker);
        let (mut best, mut walked, mut waited) = (self, None::<Self>, 0);
        for _ in 0..rounds {
            let made = walked.as_ref().unwrap_or(&best);
            let mut other = made.without_cuts();
            order(&mut other, job, &|piece, _| made.cuts_of(piece, &measures), Search::Near);
            let made = Self::of(other, job);
            if made.time < best.time - LEAST_GAIN {
                (best, walked, waited) = (made, None, 0);
            } else {
                waited += 1;
                walked = Some(made);
            }
            if waited == PATIENCE {
                break;
            }
        }
        best
    }

    /// Best order found by moving the first of two parts with a common edge behind the other, or the other before it, as long
    /// as that gains.
    fn exchanged(self, job: &Job) -> Self {
        let base = self.without_cuts();
        let rules = Rules::of(&base, job);
        let count = base.pieces.len();
        let mut order: Vec<usize> = (0..count).collect();
        let broken = rules.broken(&order);
        let (mut best, mut left) = (self, MOST_EXCHANGED / count);
        let mut is_improved = true;
        while std::mem::take(&mut is_improved) {
            let pieces = best.marker.common.iter().map(|edge| edge.pieces);
            let mut pairs: Vec<[usize; 2]> = pieces.map(|pair| pair.map(|place| order[place as usize])).collect();
            pairs.sort_unstable();
            pairs.dedup();
            for pair in pairs {
                for is_back in [true, false] {
                    let other = exchanged(&order, pair, is_back);
                    if left == 0 {
                        return best;
                    }
                    if rules.broken(&other) > broken {
                        continue;
                    }
                    left -= 1;
                    let made = Self::of(in_order(&base, &other), job);
                    if made.time < best.time - LEAST_GAIN {
                        (best, order, is_improved) = (made, other, true);
                    }
                }
            }
        }
        best
    }

    /// Marker with the same pieces, without cuts.
    fn without_cuts(&self) -> Marker {
        Marker { cuts: Vec::new(), common: Vec::new(), junctions: Vec::new(), ..self.marker.clone() }
    }

    /// Cuts of a piece: contours that are cut as a whole begin anywhere, with their indices; edges have indices behind these.
    fn cuts_of(&self, piece: usize, measures: &Measures) -> Cuts {
        let (of_piece, list) = (&self.marker.pieces[piece], &self.marker.list);
        let mut cuts = Cuts::marks(of_piece, list, measures);
        let range = self.marker.range_of(piece as u32);
        let groups = &self.groups[range.clone()];
        for (place, cut) in self.marker.cuts[range].iter().enumerate() {
            match groups[place] {
                Group::Slits => {}
                Group::Contour(contour) => {
                    cuts.add(contour, measures.of_contour(&of_piece.contours[contour], of_piece, list), false);
                }
                group @ Group::Edges(_) => {
                    let starts = vec![measures.as_is(cut.range, list)];
                    let is_of_last = place > 0 && groups[place - 1] == group;
                    cuts.add(of_piece.contours.len() + place, starts, is_of_last);
                }
            }
        }
        // A piece that is only cut with others keeps its place among these.
        if cuts.is_empty() { Cuts::drawn(of_piece, list, measures) } else { cuts }
    }
}

/// Order in which the first of two pieces is moved right behind the other, or the other right before the first.
fn exchanged(order: &[usize], pair: [usize; 2], is_back: bool) -> Vec<usize> {
    let place = |piece: usize| order.iter().position(|&other| other == piece).expect("each piece is in it");
    let [one, other] = pair.map(place);
    let [low, high] = [one.min(other), one.max(other)];
    let mut then = order.to_vec();
    if is_back {
        then[low..=high].rotate_left(1);
    } else {
        then[low..=high].rotate_right(1);
    }
    then
}

/// Marker with its pieces in another order; events stay at the same places in the order.
fn in_order(base: &Marker, order: &[usize]) -> Marker {
    let mut marker = base.clone();
    let asked = base.pieces.iter().map(|piece| piece.events.clone());
    let pieces = order.iter().zip(asked).map(|(&i, events)| Piece { events, ..base.pieces[i].clone() });
    marker.pieces = pieces.collect();
    marker
}
