//! Coat of the edges: the jet must pass every place that a head can face exactly once.

use super::ground::{Chord, Ground};
use super::rows::{EPSILON, Row, WAY};
use super::rules;
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, polyline};
use crate::ir::verdict::{Sighting, WorstByRule};
use crate::machine::Job;

/// Greatest distance of the middle of the jet from the edge as it passes, mm: far less than the width of any jet.
const SPOT: f64 = 2.0;
/// Spacing of the checked places of the edge, mm.
const STEP: f64 = 1.0;

/// Longest bare stretch that does not count beside places that no head can face, mm: the head's path may end slightly early or
/// late.
const FEW: f64 = SPOT;

/// Motion of the jet from one row to the next.
struct Way {
    /// Middle of the jet at both rows, mm.
    ends: [Point; 2],
    /// Position of the head, mm.
    head: Point,
    /// Index of the second row.
    row: usize,
}

/// State of the coat at a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Coated {
    /// No head can face the place.
    Hidden,
    /// The place has no coat.
    Bare,
    /// The jet passes the place once.
    Once,
    /// The jet passes the place again later.
    Again,
}

/// Run of adjacent places with the same state.
#[derive(Debug, Clone, Copy)]
struct Run {
    coated: Coated,
    /// Length, mm.
    length: f64,
    /// First place, and its block.
    at: Point,
    block: u32,
}

/// Coat of the edges.
pub(super) struct Coat<'a> {
    ground: &'a Ground,
    job: &'a Job,
    ways: Vec<Way>,
    boxes: Boxes,
}

impl<'a> Coat<'a> {
    /// Coat sprayed by some rows, with the middle of the jet at each.
    pub(super) fn new(rows: &[Row], spots: &[Point], ground: &'a Ground, job: &'a Job) -> Self {
        let way = |i: usize| Way { ends: [spots[i - 1], spots[i]], head: rows[i].head, row: i };
        let ways: Vec<Way> = (1..rows.len()).filter(|&i| rows[i].jet && rows[i - 1].jet).map(way).collect();
        let boxes = Boxes::new(ways.iter().map(|way| Extent::between(way.ends[0], way.ends[1])).collect());
        Self { ground, job, ways, boxes }
    }

    /// Verifies the coat.
    pub(super) fn judge(&self, worst: &mut WorstByRule) {
        let (mut bare, mut first, mut again) = (0.0, None, (0.0, None));
        let is_joined = |a: &Chord, b: &Chord| a.ends[1] == b.ends[0];
        for ring in self.ground.chords.chunk_by(is_joined) {
            let runs = runs(ring.iter().flat_map(|chord| self.places(chord)));
            let n = runs.len();
            for (i, run) in runs.iter().enumerate() {
                let sides = [runs[(i + n - 1) % n], runs[(i + 1) % n]];
                let is_beside = n > 1 && sides.iter().any(|side| side.coated == Coated::Hidden);
                if run.coated == Coated::Bare && run.length > if is_beside { FEW } else { 0.0 } {
                    bare += run.length;
                    first = first.or(Some(Sighting::missing(run.at, run.block)));
                }
                if run.coated == Coated::Again && run.length > again.0 {
                    again = (run.length, Some(Sighting::missing(run.at, run.block)));
                }
            }
        }
        worst.see_under(&rules::COVERAGE, bare, EPSILON, first);
        // A closed edge ends where it begins; there the jet may be ahead or behind by the permitted error of the head's
        // direction.
        let profile = &self.job.profile;
        let ahead = profile.tool.distance_mm * profile.verify.max_heading_deg.to_radians().tan();
        let most = 2.0 * (SPOT + self.ground.tolerance + ahead);
        worst.see_under(&rules::TWICE, again.0, most, again.1);
    }

    /// States of the places of a chord, each with its step length.
    fn places(&self, chord: &Chord) -> Vec<Run> {
        let [from, to] = chord.ends;
        let length = (to - from).norm();
        let steps = (length / STEP).ceil().max(1.0);
        let place = |i: usize| from + (to - from) * ((i as f64 + 0.5) / steps);
        let run = |at: Point| Run { coated: self.coated(at, chord), length: length / steps, at, block: chord.block };
        (0..steps as usize).map(|i| run(place(i))).collect()
    }

    fn coated(&self, place: Point, chord: &Chord) -> Coated {
        let (distance, tolerance) = (self.job.profile.tool.distance_mm, self.ground.tolerance);
        let passes = self.passes(place, chord);
        if passes > 0 {
            return if passes == 1 { Coated::Once } else { Coated::Again };
        }
        // In a bay of radius near the distance the head has no path: on a centimetre of it, at most one as long as the
        // tolerance.
        let has_way = 1.0 - distance * chord.bay() > 2.0 * tolerance / WAY;
        if !has_way || self.ground.is_nearer(place + chord.out * distance, distance - tolerance) {
            Coated::Hidden
        } else {
            Coated::Bare
        }
    }

    /// Number of times that the jet passes a place of a chord: on the right side, and without a gap along the chord longer than
    /// the jet's motion in a period.
    fn passes(&self, place: Point, chord: &Chord) -> usize {
        let (tool, period) = (&self.job.profile.tool, self.job.profile.time.period());
        let across = SPOT + self.ground.tolerance;
        let slack = 2.0 * tool.edge_speed_mm_s * period + 2.0 * self.ground.tolerance;
        let along = (chord.ends[1] - chord.ends[0]).normalize();
        let is_passed = |way: &Way| {
            let [a, b] = way.ends.map(|end| (end - place).dot(&along));
            a.min(b) <= slack
                && a.max(b) >= -slack
                && (way.head - place).dot(&chord.out) > 0.0
                && polyline::distance_to_segment(place, way.ends[0], way.ends[1]) <= across
        };
        let near = self.boxes.near(Extent::between(place, place).grown(across)).map(|i| &self.ways[i]);
        let mut rows: Vec<usize> = near.filter(|way| is_passed(way)).map(|way| way.row).collect();
        rows.sort_unstable();
        // After a pause longer than the jet needs for a centimetre, it was elsewhere in between.
        let away = WAY / tool.edge_speed_mm_s / period + 1.0;
        let again = rows.windows(2).filter(|pair| (pair[1] - pair[0]) as f64 > away).count();
        again + usize::from(!rows.is_empty())
    }
}

/// Runs of places around a ring with equal states.
fn runs(places: impl Iterator<Item = Run>) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for place in places {
        match runs.last_mut() {
            Some(last) if last.coated == place.coated => last.length += place.length,
            Some(_) | None => runs.push(place),
        }
    }
    if runs.len() > 1 && runs[0].coated == runs[runs.len() - 1].coated {
        // The start of a ring is arbitrary: join its first and last run.
        let last = runs.pop().expect("more than one");
        runs[0] = Run { length: runs[0].length + last.length, ..last };
    }
    runs
}
