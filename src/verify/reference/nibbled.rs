//! Where a line may be nibbled: cut by plunges without motion, each near to what it cuts.
//!
//! That is where the line is too tight for the blade and the profile says so, and where a cut begins on a curve that a
//! plunged blade lies too far beside. Found here anew, and a little more of it than a compile would nibble: rounding
//! matters.

use super::line::Line;
use super::tight::stands_across;
use crate::geom::{Point, polyline};
use crate::machine::{Knife, TightCurves};

/// Part of `knife.max_bow_mm` from which on a line may be nibbled: rounding and overlaps matter.
const DEVIATION_SHARE: f64 = 0.9;
/// Part of the tolerance beyond an arc of the same turn from which on a curve may be one that the blade cannot enter.
const ENTRY_SHARE: f64 = 0.4;
/// The same of the tolerance of a cut that the blade covers.
const TOLERANCE_SHARE: f64 = 0.5;
/// Greatest part of the turn under a blade that one vertex of a curve makes, by a little; one that makes more is a bend.
const BEND_SHARE: f64 = 0.75;

/// What a line is cut with.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Blade<'a> {
    pub(in crate::verify) knife: &'a Knife,
    /// Permitted deviation of the tip, mm.
    pub(in crate::verify) tolerance: f64,
}

/// Whether a blade that plunges anywhere on a line, round a ring, may lie beside it: the knife is lifted somewhere amid it,
/// and what then remains may be short.
pub(super) fn deviates_anywhere(line: &Line, Blade { knife, tolerance }: Blade) -> bool {
    let path = line.twice_round();
    let deviation = |start: usize| Deviation::new(&path[start..], 0.0, knife);
    (0..line.chords())
        .filter_map(deviation)
        .any(|deviation| deviation.is_curve && deviation.away > TOLERANCE_SHARE * tolerance)
}

/// How far a line, from its start and from its end, goes on as a curve that a blade plunged there as a chord of it may
/// not enter, or may lie farther beside than `knife.max_bow_mm`, mm; 0 where it does not begin as one.
pub(super) fn curved_ends(line: &Line, blade: Blade) -> [f64; 2] {
    if blade.knife.width_mm == 0.0 || line.chords() < 2 {
        return [0.0; 2];
    }
    // Nearly always a look at what lies under the blade is all that it takes.
    let heel = blade.heels().into_iter().fold(0.0, f64::max);
    let reach = blade.knife.width_mm + heel;
    [blade.curved_way(|| line.points(), reach), blade.curved_way(|| line.points().rev(), reach)]
}

/// The stretches of a line that may be nibbled where it is too tight or begins or ends bowed, by stations, in order,
/// with as much before and behind as the blade is wide: what nibbles may reach as far. On a ring they may go on past
/// its end.
pub(in crate::verify) fn stretches(line: &Line, tight: &[[f64; 2]], ends: [f64; 2], blade: Blade) -> Vec<[f64; 2]> {
    let (length, width) = (line.length(), blade.knife.width_mm);
    let mut found: Vec<[f64; 2]> = Vec::new();
    if ends[0] > 0.0 {
        found.push([0.0, ends[0]]);
    }
    if blade.knife.tight_curves == TightCurves::Nibble {
        let path = line.twice_round();
        // From the vertex before it to the first one behind at which the blade may plunge.
        found.extend(tight.iter().map(|&[low, high]| {
            let lap = if line.ring && high >= length { length } else { 0.0 };
            let next = line.chord_at(high - lap) + 1;
            let end = blade.first_clear(&path[..path.len().min(next + line.chords() + 1)], next);
            let end = lap + line.station(end % line.chords()) + length * (end / line.chords()) as f64;
            [line.station(line.chord_at(low)).min(low), end.max(high)]
        }));
    }
    if ends[1] > 0.0 {
        found.push([length - ends[1], length]);
    }
    // What is shorter than the blade between two of them, or before an end, is cut with them, too.
    found.into_iter().map(|[low, high]| [low - width, high + width]).collect()
}

impl Blade<'_> {
    fn heels(self) -> [f64; 3] {
        [0.0, self.knife.heel_overlap_mm, self.knife.corner_heel_overlap_mm]
    }

    /// How far a path, given by its points, goes on as a curve that it begins as and that the blade, with its overlaps
    /// as long as `reach`, may not enter, mm; 0 where it begins as none.
    fn curved_way<I: Iterator<Item = Point>>(self, points: impl Fn() -> I, reach: f64) -> f64 {
        let start = points().next().unwrap_or_default();
        let past = points().position(|point| (point - start).norm() > reach);
        // With the vertex behind, because a curve turns along its chords.
        let near: Vec<Point> = points().take(past.map_or(usize::MAX, |past| past + 2)).collect();
        if !self.is_bowed_at_start(&near) {
            return 0.0;
        }
        let path: Vec<Point> = points().collect();
        polyline::length(&path[..=self.first_clear(&path, 1)])
    }

    /// Whether a path begins on a curve beside which it lies too far, by any heel overlap.
    fn is_bowed_at_start(self, path: &[Point]) -> bool {
        let width = self.knife.width_mm;
        let turned = polyline::turn_within(path, width).min(std::f64::consts::PI);
        // A path that turns by a under a blade of the width w lies beside it by at most w/2 tan(a/2).
        width / 2.0 * (turned / 2.0).tan() > TOLERANCE_SHARE * self.tolerance
            && self
                .heels()
                .into_iter()
                .filter_map(|heel| Deviation::new(path, heel, self.knife))
                .any(|deviation| deviation.is_bad(self))
    }

    /// The first vertex of a path, from one of its inner ones on, at which the blade may plunge; its last when there is
    /// none.
    fn first_clear(self, path: &[Point], from: usize) -> usize {
        let last = path.len() - 1;
        let is_clear = |vertex: &usize| {
            Deviation::new(&path[*vertex..], 0.0, self.knife).is_none_or(|deviation| !deviation.is_bad(self))
        };
        (from..last).find(is_clear).unwrap_or(last)
    }
}

/// How a line bows away from a blade that plunges as a chord of it.
struct Deviation {
    /// How far, mm.
    away: f64,
    /// How far an arc would that turns as much under it, mm; none when the blade stands across.
    arc: f64,
    /// Whether the blade covers all of the line.
    is_whole: bool,
    /// Whether the line turns little by little under it, and not at one bend.
    is_curve: bool,
}

/// Whether turns are those of a curve: none of them makes most of what they are together, by a little.
pub(in crate::verify) fn is_curve(turns: &[f64]) -> bool {
    sharpest_share(turns) <= BEND_SHARE
}

/// Which part of all turns the greatest makes; none of nothing.
pub(in crate::verify) fn sharpest_share(turns: &[f64]) -> f64 {
    let all: f64 = turns.iter().sum();
    if all > 0.0 { turns.iter().copied().fold(0.0, f64::max) / all } else { 0.0 }
}

impl Deviation {
    /// The deviation at the start of a path, by a heel overlap; `None` where there is none.
    fn new(path: &[Point], overlap: f64, knife: &Knife) -> Option<Self> {
        // What is straight does not bow.
        path.get(2)?;
        let along = polyline::direction(path[0], path[1])?;
        let heel = path[0] - along * overlap;
        let reached = path.iter().position(|point| (point - heel).norm() >= knife.width_mm);
        let near = reached.unwrap_or(path.len() - 1);
        let mut under = vec![heel];
        under.extend(path[usize::from(overlap == 0.0)..=near].iter());
        let tip = polyline::first_at_distance(&under, knife.width_mm).map_or(path[near], |(tip, _)| tip);
        let away = under.iter().map(|&point| polyline::distance_to_segment(point, heel, tip)).fold(0.0, f64::max);
        under.extend(path.get(near + 1));
        let turns: Vec<f64> = under.windows(3).map(|w| polyline::turn_at(w[0], w[1], w[2]).abs()).collect();
        let turned: f64 = turns.iter().sum();
        let is_across = stands_across(tip - heel, along);
        Some(Self {
            away,
            arc: if is_across { 0.0 } else { polyline::sagitta((tip - heel).norm(), turned) },
            is_whole: reached.is_none(),
            is_curve: is_curve(&turns),
        })
    }

    /// Whether that may be too far.
    fn is_bad(&self, Blade { knife, tolerance }: Blade) -> bool {
        let limit = (self.arc + ENTRY_SHARE * tolerance).min(DEVIATION_SHARE * knife.max_bow_mm);
        let limit = if self.is_whole { limit.min(TOLERANCE_SHARE * tolerance) } else { limit };
        self.is_curve && self.away > limit
    }
}
