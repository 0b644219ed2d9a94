//! Assignment of strokes to cuts, from their path over the cloth alone.

use super::chain::Cover;
use super::cover::Covers;
use super::going::Going;
use super::ground::Ground;
use super::heading::Blade;
use super::lines::{Line, Lines};
use super::rules;
use super::strokes::Stroke;
use super::trail::{Followed, Sample, Trail, reach, samples};
use crate::geom::{cross, polyline};
use crate::ir::verdict::WorstByRule;

/// Maximum number of places of a stroke that are compared with all cuts.
const PROBES: usize = 48;
/// Sine of the greatest angle between a cut and a stroke that follows it.
const SINE: f64 = 0.5;
/// Extra distance beyond an overlap that a blade may go past a line, mm: the place where it leaves the line is uncertain by
/// that.
const OVERCUT: f64 = 1.0;

/// Assigns strokes to cuts.
pub(super) struct Follower<'a> {
    pub(super) lines: &'a Lines,
    pub(super) ground: &'a Ground<'a>,
    /// Speed of the conveyor, mm/s.
    pub(super) speed: f64,
    /// Parts that are cut so far.
    pub(super) covers: Covers<'a>,
}

impl Follower<'_> {
    /// Verifies a stroke, given its index among those of its head: assigns it to a cut and records the part that it cuts.
    pub(super) fn judge(&mut self, number: usize, stroke: &Stroke, worst: &mut WorstByRule) {
        let samples = samples(&stroke.trace);
        let Some((found, line)) = self.best(stroke, &samples) else {
            worst.see_under(&rules::STRAY, polyline::length(&stroke.trace), 0.0, stroke.places[0]);
            return;
        };
        worst.see_under(&rules::STRAY, 0.0, 0.0, None);
        let of = &self.lines.all[line];
        let trail = Trail { samples: &samples, line: of, tolerance: self.ground.tolerance() };
        blade(stroke, &found, trail).judge(self.ground, worst);
        Going { stroke, line: of, stations: found.stations, conveyor: self.speed }.judge(self.ground, worst);
        self.place(stroke, (trail, &found), worst);
        let place = stroke.places[0];
        worst.count(&rules::BLOCK, usize::from(!names(stroke, of)), Some(place));
        self.covers.add(line, Cover { ends: found.stations, number, plunge: stroke.is_plunge(), place });
    }

    /// Cut that a stroke was meant for, and the stretch that it follows.
    fn best(&self, stroke: &Stroke, samples: &[Sample]) -> Option<(Followed, usize)> {
        let tolerance = self.ground.tolerance();
        let trail = |line: usize| Trail { samples, line: &self.lines.all[line], tolerance };
        let farthest = farthest(stroke, self.ground);
        let rank = |(found, line): &(Followed, usize)| {
            let [before, behind] = trail(*line).beyond(found);
            // A line on which the stroke breaks no rule comes before one on which it does.
            let excess = (before.max(behind) - farthest).max(0.0) + (found.deviation - tolerance).max(0.0);
            let is_other = !names(stroke, &self.lines.all[*line]);
            (excess, is_other, self.covers.doubled(*line, found.span()), -found.length())
        };
        let all = candidates(samples, self.lines, tolerance).into_iter();
        let all = all.filter_map(|line| Some((trail(line).followed()?, line)));
        let ranked = all.map(|found| (rank(&found), found));
        let best = ranked.min_by(|(a, _), (b, _)| {
            a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.total_cmp(&b.2)).then(a.3.total_cmp(&b.3))
        });
        best.map(|(_, found)| found)
    }

    /// Verifies the position of the blade beside its line and beyond its ends. If the line continues there, the blade must stay
    /// on the continuation, too.
    fn place(&self, stroke: &Stroke, (trail, found): (Trail, &Followed), worst: &mut WorstByRule) {
        let tolerance = trail.tolerance;
        let at = |sample: usize| stroke.places[trail.samples[sample].row.min(stroke.places.len() - 1)];
        worst.see_under(&rules::DEVIATION, found.deviation, tolerance, at(found.worst));
        let farthest = farthest(stroke, self.ground);
        let aside = trail.aside(found);
        for (end, beyond) in trail.beyond(found).into_iter().enumerate() {
            worst.see_under(&rules::OVERCUT, beyond, farthest, at(found.range[end]));
            let goes_on = trail.line.corner_near(found.stations[end]) > farthest;
            if let Some((off, sample)) = aside[end].filter(|_| goes_on) {
                worst.see_under(&rules::DEVIATION, off, tolerance, at(sample));
            }
        }
    }
}

/// Blade of a stroke with the path under it at the plunge: the stretch of the line under it, or just the trailing end if the
/// stroke meets its line later.
fn blade<'a>(stroke: &'a Stroke, found: &Followed, Trail { samples, line, .. }: Trail) -> Blade<'a> {
    let first = found.range[0];
    if samples[first].row > 0 {
        return Blade { stroke, under: vec![stroke.trace[0]], bend: 0.0 };
    }
    let width = (stroke.trace[1] - stroke.trace[0]).norm();
    let from = found.stations[0];
    let to = line.foot_near(stroke.trace[1], from, reach(width)).station;
    let under = [line.place(from)].into_iter().chain(line.between([from, to])).collect();
    Blade { stroke, under, bend: line.turns_between([from, to]) }
}

/// Greatest distance that a stroke may go past its line, mm.
fn farthest(stroke: &Stroke, ground: &Ground) -> f64 {
    let knife = &ground.profile.knife;
    let [heel, front] = knife.most_overlaps();
    let surplus = if stroke.is_plunge() { knife.width_mm } else { 0.0 };
    heel.max(front) + surplus + OVERCUT
}

/// True if all rows of a stroke name a block of the line.
fn names(stroke: &Stroke, line: &Line) -> bool {
    stroke.blocks.iter().all(|block| line.blocks.binary_search(block).is_ok())
}

/// Cuts along which a stroke runs at some place.
fn candidates(samples: &[Sample], lines: &Lines, tolerance: f64) -> Vec<usize> {
    let every = (samples.len() / PROBES).max(1);
    let mut found = Vec::new();
    for i in (0..samples.len()).step_by(every) {
        let here = samples[i].point;
        let other = if i + 1 < samples.len() { samples[i + 1].point } else { samples[i.saturating_sub(1)].point };
        let Some(along) = polyline::direction(here, other) else { continue };
        let is_along =
            |line: usize, k: usize| lines.all[line].along(k).is_some_and(|way| cross(way, along).abs() < SINE);
        found.extend(lines.near(here, tolerance).filter(|near| is_along(near.0, near.1)).map(|near| near.0));
    }
    found.sort_unstable();
    found.dedup();
    found
}
