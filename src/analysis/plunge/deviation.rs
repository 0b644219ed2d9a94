//! How far a path lies beside the blade that is plunged at its start: its chordal deviation.

use std::ops::RangeInclusive;

use super::blade::{PASSING_SHARE, Plunge, STILL_TOLERANCES, stands_across};
use super::overlaps::overlaps;
use crate::analysis::cloth::Surroundings;
use crate::geom::{Point, polyline};
use crate::ir::toolpath::{Run, Side};
use crate::machine::Knife;

/// Part of the tolerance from which on a path that lies beside the plunged blade is declared: smoothing may add to it.
pub const WORTH_SHARE: f64 = 0.25;
/// Part of the tolerance that the polyline may take here; smoothing moves the tip by up to the rest.
const SHARE: f64 = 0.45;
/// The same at a bend, which smoothing takes on the side of the blade: more would be a lift for the rounding of the file.
const BEND_TOLERANCE_SHARE: f64 = 0.8;
/// Greatest part of all the turn under a blade that one vertex of a curve makes; one that makes more is a bend.
const BEND_SHARE: f64 = 0.7;

/// Length of a run, in widths of the blade, that is looked at from where it plunges: on any curve that it lies on it spans
/// less.
pub const REACH: f64 = 4.0;

/// How the start of an open run lies beside the blade that is plunged there.
#[derive(Debug, Clone, Copy)]
pub struct Deviation {
    /// The vertex of the run under the blade that lies farthest beside it.
    pub vertex: usize,
    /// How far that is, mm.
    pub distance: f64,
    /// How far it may be on the smoothed path, mm: as it is here, if that is declared, and as on an arc that turns as much,
    /// and the tolerance.
    pub most: f64,
    /// Whether that is no more than on an arc that turns as much, and the blade does not stand across it; at a bend no more
    /// than the tolerance.
    pub fits: bool,
    /// Whether the blade covers all of the run, but for as little as it may be off anyway.
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
        let (knife, tolerance) = (around.knife, around.tolerance);
        let asked = || overlaps(run, around).map(|overlap| overlap.length);
        may_deviate(run, knife, tolerance).then(|| Self::with(run, asked(), knife, tolerance))?
    }

    /// That of an open run with the overlaps that it has.
    pub fn placed(run: &Run, knife: &Knife, tolerance: f64) -> Option<Self> {
        may_deviate(run, knife, tolerance).then(|| Self::with(run, [run.heel, run.front], knife, tolerance))?
    }

    fn with(run: &Run, overlaps: [f64; 2], knife: &Knife, tolerance: f64) -> Option<Self> {
        let under = Under::new(run, overlaps, knife.width_mm);
        let vertex = under.vertices().max_by(|&a, &b| under.distance(a).total_cmp(&under.distance(b)))?;
        let distance = under.distance(vertex);
        let turns = under.turns(tolerance);
        let blade = under.plunge.blade();
        let first = polyline::direction(under.path[0], under.path[1]);
        let is_across = first.is_some_and(|first| stands_across(blade, first));
        let is_arc = turns.is_curve && !is_across;
        let arc = if is_arc { polyline::sagitta(blade.norm(), turns.all) } else { 0.0 };
        let share = match (under.plunge.covers_all, turns.is_curve) {
            (true, _) => PASSING_SHARE,
            (false, true) => SHARE,
            (false, false) => BEND_TOLERANCE_SHARE,
        };
        Some(Self {
            vertex: vertex - under.skipped,
            distance,
            most: arc.min(if distance > WORTH_SHARE * tolerance { distance } else { 0.0 }) + tolerance,
            fits: under.is_sure(tolerance) && distance <= arc + share * tolerance,
            covers_all: under.plunge.stands_still(&under.path, tolerance),
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
fn may_deviate(run: &Run, knife: &Knife, tolerance: f64) -> bool {
    let turned = polyline::turn_within(&run.points, knife.width_mm).min(std::f64::consts::PI);
    knife.width_mm / 2.0 * (turned / 2.0).tan() > knife.max_bow_mm.min(2.0 * SHARE * tolerance)
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
    /// Whether the run begins and ends where its line does.
    of_line: [bool; 2],
}

/// How much the path under a blade turns, rad.
struct Turns {
    /// Between its headings that are farthest apart, up to and at the vertex that the tip goes to next.
    all: f64,
    /// What it turns to the one side less what it turns to the other.
    signed: f64,
    /// Whether no vertex makes most of it.
    is_curve: bool,
}

impl Under {
    fn new(run: &Run, overlaps: [f64; 2], width: f64) -> Self {
        let path = run.extended_by(overlaps);
        let plunge = Plunge::at_start(&path, width);
        let skipped = usize::from(overlaps[0] > 0.0);
        let last = run.points.len() - 1;
        let of_line = run.ends.map(|end| end.side != Side::Contour);
        if plunge.covers_all {
            // What covers all of a run is a chord of that alone.
            return Self { plunge: Plunge::over(&run.points), path: run.points.clone(), skipped: 0, last, of_line };
        }
        Self { plunge, path, skipped, last: last + skipped, of_line }
    }

    /// The inner vertices of the run under the blade.
    fn vertices(&self) -> RangeInclusive<usize> {
        self.skipped + 1..=self.plunge.chord.min(self.last - 1)
    }

    /// Whether the tip would stand on the same part of the path were that moved by `tolerance` mm: no bend of it comes as near
    /// to the distance at which the tip stands and turns back.
    fn is_sure(&self, tolerance: f64) -> bool {
        let width = self.plunge.blade().norm();
        let away = |point: Point| (point - self.path[0]).norm();
        let mut far = self.path.windows(3).enumerate().filter_map(|(before, points)| {
            let [a, b, c] = [points[0], points[1], points[2]].map(away);
            (b >= a && b > c).then_some((before + 1, b))
        });
        let is_near = |(_, farthest): &(usize, f64)| (farthest - width).abs() <= tolerance;
        // Of the bends behind the tip the first one alone matters.
        let behind = far.clone().find(|(vertex, _)| *vertex > self.plunge.chord);
        self.plunge.covers_all
            || !far
                .by_ref()
                .take_while(|(vertex, _)| *vertex <= self.plunge.chord)
                .chain(behind)
                .any(|far| is_near(&far))
    }

    fn distance(&self, vertex: usize) -> f64 {
        self.plunge.distance(self.path[vertex])
    }

    fn turns(&self, tolerance: f64) -> Turns {
        let chord = self.plunge.chord;
        let corners = self.path.windows(3).take(chord + 1);
        let mut turns: Vec<f64> = corners.map(|w| polyline::turn_at(w[0], w[1], w[2])).collect();
        // A bend ahead of the tip says nothing of the curve under the blade.
        if let [under @ .., next] = &mut turns[..]
            && under.len() == chord
        {
            let sharpest = under.iter().map(|turn| turn.abs()).fold(0.0, f64::max);
            // Nor does that where the tip, moved a little by smoothing, may stand before the vertex behind it.
            let is_told = (self.plunge.tip - self.path[chord]).norm() > STILL_TOLERANCES * tolerance;
            // A curve goes on soon; a bend that is followed by a long straight edge is none.
            let goes_on = (self.path[chord + 1] - self.path[0]).norm() <= REACH * self.plunge.blade().norm();
            *next = if is_told && goes_on { next.clamp(-sharpest, sharpest) } else { 0.0 };
        }
        let total: f64 = turns.iter().map(|turn| turn.abs()).sum();
        let is_curve = turns.iter().all(|turn| turn.abs() <= BEND_SHARE * total);
        // A curve turns along its chords, not at its vertices: to the ends of its line by half as much again.
        let half = |end: usize, turn: Option<&f64>| {
            turn.filter(|_| is_curve && self.plunge.covers_all && self.of_line[end]).map_or(0.0, |turn| turn / 2.0)
        };
        let halves = [half(0, turns.first()), half(1, turns.last())];
        let all = range(&turns, halves);
        Turns { all, signed: turns.iter().sum::<f64>().abs(), is_curve }
    }
}

/// Between the headings that are farthest apart on a way that turns so and, before and behind that, by so much more, rad.
fn range(turns: &[f64], [before, behind]: [f64; 2]) -> f64 {
    let (mut heading, mut reach) = (0.0_f64, [0.0_f64; 2]);
    for turn in std::iter::once(&before).chain(turns).chain([&behind]) {
        heading += turn;
        reach = [reach[0].min(heading), reach[1].max(heading)];
    }
    reach[1] - reach[0]
}
