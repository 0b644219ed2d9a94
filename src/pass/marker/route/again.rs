//! Once more: with common lines a piece is cut where others leave something of its outline, and that decides anew in which
//! order pieces come.
//!
//! Which of two parts an edge is cut with follows from their order, so that other cuts are made in another one. The order is
//! looked for with the cuts that the last one gives, a few times; the one whose cuts take the least time stays.

use super::block::{Search, is_allowed, order};
use crate::analysis::air;
use crate::ir::Marker;
use crate::machine::Job;
use crate::pass::marker::cut::{self, Group};
use crate::pass::marker::visit::{Cuts, Measures};

/// How often another order is looked for from each one that it starts with, at the most.
const ROUNDS: usize = 12;
/// Pieces that are ordered in these rounds together, at the most, but for one round.
const MOST_PIECES: usize = 2000;
/// Rounds after which the search ends when none of them gains.
const PATIENCE: usize = 3;
/// Gains that are less are none, s.
const LEAST_GAIN: f64 = 1e-6;

/// A marker with its cuts.
struct Made {
    marker: Marker,
    groups: Vec<Group>,
    /// What its cuts take, s, about: the moves between them, lifts and plunges, and their lengths.
    time: f64,
}

/// Puts pieces with common lines in a better order, if there is one: also one that is like that of the file, where this
/// suits what the parts have in common.
pub(super) fn improve(marker: &mut Marker, as_filed: Marker, job: &Job) {
    let routed = Made::of(marker.clone(), job);
    if routed.marker.common.is_empty() {
        return;
    }
    let filed = is_allowed(&as_filed, job).then(|| Made::of(as_filed, job));
    let mut least = routed.time;
    for made in filed.into_iter().chain([routed]) {
        let best = made.improved(job);
        if best.time < least - LEAST_GAIN {
            least = best.time;
            *marker = best.without_cuts();
        }
    }
}

impl Made {
    fn of(mut marker: Marker, job: &Job) -> Self {
        let groups = cut::made(&mut marker, job);
        let knife = &job.profile.knife;
        let [x, y, _] = job.profile.axes.limits();
        let speed = knife.feed_mm_s.unwrap_or(f64::INFINITY).min(x.speed).min(y.speed);
        let lifts = marker.cuts.len() as f64 * (knife.plunge() + knife.clear());
        let time = air::spent(&marker, job) + air::at_corners(&marker, job) + lifts + marker.cut_length() / speed;
        Self { marker, groups, time }
    }

    /// The best that is found from here on: each order is looked for near the one before, with the cuts that this gives.
    fn improved(self, job: &Job) -> Self {
        let rounds = (MOST_PIECES / self.marker.pieces.len()).clamp(1, ROUNDS);
        let (mut best, mut walked, mut waited) = (self, None::<Self>, 0);
        for _ in 0..rounds {
            let made = walked.as_ref().unwrap_or(&best);
            let mut other = made.without_cuts();
            order(&mut other, job, &|piece, marker| made.cuts_of(piece, marker, job), Search::Near);
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

    /// The same pieces, as they were before their cuts were made.
    fn without_cuts(&self) -> Marker {
        Marker { cuts: Vec::new(), common: Vec::new(), junctions: Vec::new(), ..self.marker.clone() }
    }

    /// How a piece is cut: contours that are cut as a whole begin anywhere, by their places; edges have places behind these.
    fn cuts_of(&self, piece: usize, marker: &Marker, job: &Job) -> Cuts {
        let measures = Measures::new(job, marker);
        let (of_piece, list) = (&marker.pieces[piece], &self.marker.list);
        let mut cuts = Cuts::marks(of_piece, list, &measures);
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
        // One that is cut with others alone keeps a place among these.
        if cuts.is_empty() { Cuts::drawn(of_piece, list, &measures) } else { cuts }
    }
}
