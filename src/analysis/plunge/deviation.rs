//! How far a path lies beside the blade that is plunged at its start: its chordal deviation.

use std::ops::RangeInclusive;

use super::blade::{PASSING_SHARE, Plunge, stands_across};
use super::overlaps::overlaps;
use crate::analysis::cloth::Surroundings;
use crate::geom::{Point, polyline};
use crate::ir::toolpath::Run;

/// Part of the tolerance that the polyline may take here; smoothing moves the tip by up to the rest.
const SHARE: f64 = 0.45;
/// The same of the polyline as it is seen without what came before it, which no more may add to.
const SEEN_SHARE: f64 = 0.95;
/// Greatest part of all the turn under a blade that one vertex of a curve makes; one that makes more is a bend.
const BEND_SHARE: f64 = 0.7;

/// How the start of an open run lies beside the blade that is plunged there.
#[derive(Debug, Clone, Copy)]
pub struct Deviation {
    /// The vertex of the run under the blade that lies farthest beside it.
    pub vertex: usize,
    /// How far that is, mm.
    pub distance: f64,
    /// Whether that is no more than on an arc that turns as much, and the blade does not stand across it.
    pub fits: bool,
    /// Whether the blade covers all of the run.
    pub covers_all: bool,
    /// Whether what lies under it turns little by little, and not at one bend.
    pub is_curve: bool,
    /// How much that turns in all, rad: what it turns to the one side less what it turns to the other, which may be
    /// rounding.
    pub turned: f64,
}

impl Deviation {
    /// That of an open run with the overlaps that there is room for; `None` when there is no vertex under the blade, or the
    /// run hardly turns there.
    pub fn of(run: &Run, around: &Surroundings) -> Option<Self> {
        if !may_deviate(run, around) {
            return None;
        }
        let under = Under::new(run, around);
        let vertex = under.vertices().max_by(|&a, &b| under.distance(a).total_cmp(&under.distance(b)))?;
        let distance = under.distance(vertex);
        let turns = under.turns();
        let blade = under.plunge.blade();
        let first = polyline::direction(under.path[0], under.path[1]);
        let is_across = first.is_some_and(|first| stands_across(blade, first));
        let arc = |turn: f64| if is_across { 0.0 } else { polyline::sagitta(blade.norm(), turn) };
        Some(Self {
            vertex: vertex - under.skipped,
            distance,
            fits: distance <= arc(turns.total + turns.outer) + SHARE * around.tolerance
                && distance <= arc(turns.seen) + SEEN_SHARE * around.tolerance,
            covers_all: under.plunge.covers_all,
            is_curve: turns.is_curve,
            turned: turns.signed,
        })
    }

    /// Whether the path lies no farther beside the blade than is worth a word.
    pub fn is_slight(&self, around: &Surroundings) -> bool {
        self.distance <= around.knife.max_bow_mm
    }

    /// Whether the blade may plunge like that: it enters its path and lies slightly beside it, or cuts all of it as it
    /// should.
    pub fn is_good(&self, around: &Surroundings) -> bool {
        self.fits && self.is_slight(around) && (!self.covers_all || self.distance <= PASSING_SHARE * around.tolerance)
    }
}

/// Whether a run turns enough near its start to lie anything but well beside the blade: a path that turns by a under a
/// blade of the width w lies beside it by at most w/2 tan(a/2), an arc that turns as much by about half of that, and
/// the difference may be a part of the tolerance.
fn may_deviate(run: &Run, around: &Surroundings) -> bool {
    let knife = around.knife;
    let turned = polyline::turn_within(&run.points, knife.width_mm).min(std::f64::consts::PI);
    knife.width_mm / 2.0 * (turned / 2.0).tan() > knife.max_bow_mm.min(2.0 * SHARE * around.tolerance)
}

/// What lies under a blade plunged at the start of a run.
struct Under {
    plunge: Plunge,
    /// What the blade is a chord of.
    path: Vec<Point>,
    /// The vertex of the path at which the run begins: behind the heel overlap, if there is one.
    skipped: usize,
    /// The vertex of the path at which the run ends.
    last: usize,
}

/// How much the path under a blade turns, rad.
struct Turns {
    /// To either side, up to and at the vertex that the tip goes to next: a curve turns along its chords, not at its
    /// vertices.
    total: f64,
    /// The same, what it turns to the one side less what it turns to the other.
    signed: f64,
    /// What a curve turns along the halves of the chords at the ends of the run, beside that.
    outer: f64,
    /// As much of all that as can be told from what lies under the blade alone.
    seen: f64,
    /// Whether no vertex makes most of it.
    is_curve: bool,
}

impl Under {
    fn new(run: &Run, around: &Surroundings) -> Self {
        let [heel, front] = overlaps(run, around).map(|overlap| overlap.length);
        let path = run.extended_by([heel, front]);
        let plunge = Plunge::at_start(&path, around.knife.width_mm);
        let skipped = usize::from(heel > 0.0);
        let last = run.points.len() - 1;
        if plunge.covers_all {
            // What covers all of a run is a chord of that alone.
            return Self { plunge: Plunge::over(&run.points), path: run.points.clone(), skipped: 0, last };
        }
        Self { plunge, path, skipped, last: last + skipped }
    }

    /// The inner vertices of the run under the blade.
    fn vertices(&self) -> RangeInclusive<usize> {
        self.skipped + 1..=self.plunge.chord.min(self.last - 1)
    }

    fn distance(&self, vertex: usize) -> f64 {
        self.plunge.distance(self.path[vertex])
    }

    fn turns(&self) -> Turns {
        let chord = self.plunge.chord;
        let corners = self.path.windows(3).take(chord + 1);
        let signed: Vec<f64> = corners.map(|w| polyline::turn_at(w[0], w[1], w[2])).collect();
        let turns: Vec<f64> = signed.iter().map(|turn| turn.abs()).collect();
        let total: f64 = turns.iter().sum();
        let is_curve = turns.iter().all(|&turn| turn <= BEND_SHARE * total);
        let end = (self.last - 1).min(turns.len());
        let outer = match &turns[self.skipped.min(end)..end] {
            [first, .., last] if is_curve && chord + 1 >= self.last => f64::midpoint(*first, *last),
            [first, ..] if is_curve => first / 2.0,
            _ => 0.0,
        };
        // A single vertex under the blade tells nobody that the curve begins before it.
        let under = &turns[..chord.min(turns.len())];
        let sharpest = under.iter().copied().fold(0.0, f64::max);
        let is_told = sharpest <= BEND_SHARE * under.iter().sum::<f64>();
        let seen = if is_told { total + outer } else { total };
        Turns { total, signed: signed.iter().sum::<f64>().abs(), outer, seen, is_curve }
    }
}
