//! Chordal deviation: distance of a path from the blade that is plunged at its start.

use std::ops::RangeInclusive;

use super::blade::{PASSING_SHARE, Plunge, STILL_TOLERANCES, stands_across};
use super::overlaps::overlaps;
use crate::analysis::cloth::Surroundings;
use crate::geom::{Point, polyline};
use crate::ir::toolpath::{Run, Side};
use crate::machine::Knife;

/// Share of the tolerance above which a deviation from the plunged blade is declared: smoothing may add to it.
pub const WORTH_SHARE: f64 = 0.25;
/// Share of the tolerance that the polyline may use here; smoothing moves the tip by up to the rest.
const SHARE: f64 = 0.45;
/// Share of the tolerance at a bend, which smoothing moves towards the blade: a smaller share would cause lifts for the
/// rounding of the file.
const BEND_TOLERANCE_SHARE: f64 = 0.8;
/// Greatest share of the total turn under a blade at one vertex of a curve; a vertex with more is a bend.
const BEND_SHARE: f64 = 0.7;

/// Length of a run examined from its plunge, in blade widths: the blade spans less on any curve that it fits.
pub const REACH: f64 = 4.0;

/// Motion of a blade on a run between plunge and lift.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Leeway {
    /// The blade covers the whole run, within the deviation that is allowed anyway.
    None,
    /// The run is so little longer than the blade that this would turn to the tangent nearly on the spot.
    OnTheSpot,
    /// The blade moves along the run.
    Free,
}

/// Deviation of the start of an open run from the blade that is plunged there.
#[derive(Debug, Clone, Copy)]
pub struct Deviation {
    /// Vertex of the run under the blade with the greatest deviation.
    pub vertex: usize,
    /// Deviation at that vertex, mm.
    pub distance: f64,
    /// Greatest deviation on the smoothed path, mm: the lesser of this deviation, if it is declared, and that of an arc with
    /// the same turn, plus the tolerance.
    pub most: f64,
    /// True if the deviation is at most that of an arc with the same turn, at a bend at most the tolerance, and the blade does
    /// not stand across the path.
    pub fits: bool,
    /// Motion of the blade between plunge and lift.
    pub leeway: Leeway,
    /// True if the path under the blade turns gradually, and not at a single bend.
    pub is_curve: bool,
    /// Net turn of the path under the blade, rad: left less right turns, absolute, so that rounding cancels.
    pub turned: f64,
}

impl Deviation {
    /// Deviation of an open run with the overlaps that there is room for; `None` if no vertex is under the blade, or if the run
    /// hardly turns there.
    pub fn of(run: &Run, around: &Surroundings) -> Option<Self> {
        let (knife, tolerance) = (around.knife, around.tolerance);
        let asked = || overlaps(run, around).map(|overlap| overlap.length);
        may_deviate(run, knife, tolerance).then(|| Self::with(run, asked(), knife, tolerance))?
    }

    /// Deviation of an open run with its present overlaps; `None` as for [`Deviation::of`].
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
            leeway: under.leeway(tolerance),
            is_curve: turns.is_curve,
            turned: turns.signed,
        })
    }

    /// True if the deviation is too small to report.
    pub fn is_slight(&self, around: &Surroundings) -> bool {
        self.distance <= around.knife.max_bow_mm
    }

    /// True if the blade may plunge like that: it fits the path and deviates only slightly, within its passing tolerance if it
    /// has no way to turn.
    pub fn is_good(&self, around: &Surroundings) -> bool {
        let may_pass = !self.is_one_plunge() || self.distance <= PASSING_SHARE * around.tolerance;
        self.fits && self.is_slight(around) && may_pass
    }

    /// True if the blade has no way to turn between plunge and lift.
    pub fn is_one_plunge(&self) -> bool {
        self.leeway != Leeway::Free
    }
}

/// True if a run turns enough near its start to deviate noticeably from the blade. A path that turns by a under a blade of
/// width w deviates by at most w/2 tan(a/2), an arc with the same turn by about half of that; the difference may be a share of
/// the tolerance.
fn may_deviate(run: &Run, knife: &Knife, tolerance: f64) -> bool {
    let turned = polyline::turn_within(&run.points, knife.width_mm).min(std::f64::consts::PI);
    knife.width_mm / 2.0 * (turned / 2.0).tan() > knife.max_bow_mm.min(2.0 * SHARE * tolerance)
}

/// Path under a blade that is plunged at the start of a run.
struct Under {
    plunge: Plunge,
    /// Path of which the blade is a chord.
    path: Vec<Point>,
    /// Index in the path of the first vertex of the run: 1 behind a heel overlap, else 0.
    skipped: usize,
    /// Index in the path of the last vertex of the run.
    last: usize,
    /// True for each end of the run that is an end of its line.
    of_line: [bool; 2],
}

/// Turn of the path under a blade, rad.
struct Turns {
    /// Angle between the extreme headings, up to and including the next vertex ahead of the tip.
    all: f64,
    /// Net turn, absolute: left less right turns.
    signed: f64,
    /// True if no vertex makes most of the turn.
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
            // A blade that covers a whole run is a chord of that alone.
            return Self { plunge: Plunge::over(&run.points), path: run.points.clone(), skipped: 0, last, of_line };
        }
        Self { plunge, path, skipped, last: last + skipped, of_line }
    }

    /// Inner vertices of the run under the blade.
    fn vertices(&self) -> RangeInclusive<usize> {
        self.skipped + 1..=self.plunge.chord.min(self.last - 1)
    }

    /// True if the tip would be on the same part of the path if that were moved by `tolerance` mm: no local maximum of the
    /// distance from the start is that near to the blade width.
    fn is_sure(&self, tolerance: f64) -> bool {
        let width = self.plunge.blade().norm();
        let away = |point: Point| (point - self.path[0]).norm();
        let mut far = self.path.windows(3).enumerate().filter_map(|(before, points)| {
            let [a, b, c] = [points[0], points[1], points[2]].map(away);
            (b >= a && b > c).then_some((before + 1, b))
        });
        let is_near = |(_, farthest): &(usize, f64)| (farthest - width).abs() <= tolerance;
        // Behind the tip only the first bend matters.
        let behind = far.clone().find(|(vertex, _)| *vertex > self.plunge.chord);
        self.plunge.covers_all
            || !far
                .by_ref()
                .take_while(|(vertex, _)| *vertex <= self.plunge.chord)
                .chain(behind)
                .any(|far| is_near(&far))
    }

    fn leeway(&self, tolerance: f64) -> Leeway {
        if self.plunge.turns_on_the_spot(&self.path) {
            Leeway::OnTheSpot
        } else if self.plunge.stands_still(&self.path, tolerance) {
            Leeway::None
        } else {
            Leeway::Free
        }
    }

    fn distance(&self, vertex: usize) -> f64 {
        self.plunge.distance(self.path[vertex])
    }

    fn turns(&self, tolerance: f64) -> Turns {
        let chord = self.plunge.chord;
        let corners = self.path.windows(3).take(chord + 1);
        let mut turns: Vec<f64> = corners.map(|w| polyline::turn_at(w[0], w[1], w[2])).collect();
        // A bend ahead of the tip is no evidence of a curve under the blade.
        if let [under @ .., next] = &mut turns[..]
            && under.len() == chord
        {
            let sharpest = under.iter().map(|turn| turn.abs()).fold(0.0, f64::max);
            // It is no evidence either where the tip, moved a little by smoothing, may stand before the vertex behind it.
            let is_told = (self.plunge.tip - self.path[chord]).norm() > STILL_TOLERANCES * tolerance;
            // A curve continues soon; a bend followed by a long straight edge is not a curve.
            let goes_on = (self.path[chord + 1] - self.path[0]).norm() <= REACH * self.plunge.blade().norm();
            *next = if is_told && goes_on { next.clamp(-sharpest, sharpest) } else { 0.0 };
        }
        let total: f64 = turns.iter().map(|turn| turn.abs()).sum();
        let is_curve = turns.iter().all(|turn| turn.abs() <= BEND_SHARE * total);
        // A curve turns along its chords, not at its vertices: at each end of its line it turns further by half of the turn at
        // the vertex.
        let half = |end: usize, turn: Option<&f64>| {
            turn.filter(|_| is_curve && self.plunge.covers_all && self.of_line[end]).map_or(0.0, |turn| turn / 2.0)
        };
        let halves = [half(0, turns.first()), half(1, turns.last())];
        let all = range(&turns, halves);
        Turns { all, signed: turns.iter().sum::<f64>().abs(), is_curve }
    }
}

/// Angle between the extreme headings of a path with these turns and the additional turns `before` and `behind` them, rad.
fn range(turns: &[f64], [before, behind]: [f64; 2]) -> f64 {
    let (mut heading, mut reach) = (0.0_f64, [0.0_f64; 2]);
    for turn in std::iter::once(&before).chain(turns).chain([&behind]) {
        heading += turn;
        reach = [reach[0].min(heading), reach[1].max(heading)];
    }
    reach[1] - reach[0]
}
