//! Overlaps past the ends of a line, compared with the profile.

use super::body::Cut;
use super::coverage::Coverage;
use super::stroke::Judge;
use super::trial::Trial;
use super::worsts::{Lacking, Worsts};
use crate::geom::{Point, polyline};
use crate::ir::declaration::{Kind, Which};
use crate::ir::verdict::{Sighting, Worst};
use crate::verify::declared::Stretch;
use crate::verify::reference::line::Line;

impl Judge<'_> {
    /// Checks for overlaps that are shorter than the profile asks for, where waste lies ahead, no code forbids the overlap, and
    /// no declaration covers the difference.
    pub(super) fn check_overlaps(
        &self,
        cut: &Cut,
        trial: &Trial,
        seen: &impl Fn(usize) -> Sighting,
        worsts: &mut Worsts,
    ) {
        let Worsts { overlap, lacking, .. } = worsts;
        let line = &self.reference.lines[trial.line];
        // A line within the tolerance of both its ends shows neither end.
        let is_short = line.length() <= 2.0 * self.tracer.allowed;
        if line.cut.is_bare || is_short {
            return;
        }
        let knife = self.knife;
        if trial.laps {
            self.check_lap(cut, trial, seen, overlap);
        }
        if trial.laps || line.ring {
            return;
        }
        let asked = [
            knife.heel_overlap_mm.min(knife.corner_heel_overlap_mm),
            knife.front_overlap_mm.min(knife.corner_front_overlap_mm),
        ];
        // The two ends of a blade that does not move cannot be told apart.
        let asked = if cut.is_plunge_cut() { [asked[0].min(asked[1]); 2] } else { asked };
        let last = cut.points.len() - 1;
        for (i, place) in [0, last].into_iter().enumerate() {
            let station = trial.reach[i];
            let Some(end_of_line) = self.end_of_line(line, station) else { continue };
            let at_start = end_of_line == 0;
            let missing = asked[i] - trial.beyond(cut, place);
            if missing <= self.tracer.allowed {
                continue;
            }
            let way = way_on(line, at_start, asked[i] + knife.clearance_mm);
            let end_here = if cut.is_plunge_cut() { None } else { Some([Which::Start, Which::End][i]) };
            let here = Stretch { line, stations: [station; 2], end: end_here };
            let told = self.tracer.declared.map_or(0.0, |told| told.most(Kind::Shortened, here));
            // The heel of a blade that plunges on a curve would leave the curve.
            let is_curved = i == 0 && !self.is_straight_about(line, [station; 2]);
            let has_cause = is_curved || self.has_neighbour(way[0], asked[i] + knife.clearance_mm);
            let told = if has_cause { told } else { 0.0 };
            // This close to an end of its line, a cut may also be lifted or begin inside the line.
            let is_lift = self.tracer.declared.is_some_and(|told| told.has(Kind::Lift, here));
            let is_told = is_lift || self.tracer.declared.is_some() && missing <= told + self.tracer.allowed;
            let may = is_told || is_curved && self.tracer.declared.is_none() || self.overcut.leads_into_part(way);
            if !may && cut.is_plunge_cut() {
                let (line, place) = (trial.line, seen(place));
                lacking.push(Lacking { line, end: end_of_line, asked: asked[i], missing, place });
            } else if !may {
                overlap.see(missing, || seen(place));
            }
        }
    }

    /// End of a line near a station: start (0) or end (1); `None` for a station inside the line.
    fn end_of_line(&self, line: &Line, station: f64) -> Option<usize> {
        if station <= self.tracer.allowed {
            return Some(0);
        }
        (line.length() - station <= self.tracer.allowed).then_some(1)
    }

    /// Records the overlaps of a stroke past the ends of its line.
    pub(super) fn see_beyond(&self, cut: &Cut, trial: &Trial, coverage: &mut Coverage) {
        let line = &self.reference.lines[trial.line];
        if trial.laps || line.ring {
            return;
        }
        for (station, place) in trial.reach.into_iter().zip([0, cut.points.len() - 1]) {
            if let Some(end) = self.end_of_line(line, station) {
                coverage.see_beyond(trial.line, end, trial.beyond(cut, place));
            }
        }
    }

    /// Checks the overlap of a ring against the profile.
    fn check_lap(&self, cut: &Cut, trial: &Trial, seen: &impl Fn(usize) -> Sighting, overlap: &mut Worst) {
        let length = self.reference.lines[trial.line].length();
        // Measure along the drawn line or along the tip's path: a winding path is longer than the line.
        let [start, end] = trial.reach;
        let lapped = lapped(cut, length).max((end - start).abs() - length);
        let missing = self.knife.front_overlap_mm.min(length) - lapped;
        // Both its start and its end may deviate along the line.
        if missing > 2.0 * self.tracer.allowed {
            overlap.see(missing - self.tracer.allowed, || seen(cut.points.len() - 1));
        }
    }

    /// True if anything besides the lines that meet there is drawn within `reach` mm of the end of a line, so that it may
    /// obstruct an overlap.
    fn has_neighbour(&self, end: Point, reach: f64) -> bool {
        let reach = reach + self.tracer.allowed + self.reference.band;
        let meets = |ends: [Point; 2]| ends.iter().any(|at| (at - end).norm() <= self.tracer.allowed);
        let is_near = |line: usize, chord: usize| {
            let ends = self.reference.lines[line].ends(chord);
            !meets(ends) && polyline::distance_to_segment(end, ends[0], ends[1]) <= reach
        };
        let near = self.tracer.grid.near(end, reach);
        near.into_iter().any(|run| run.chords().any(|chord| is_near(run.line(), chord)))
    }
}

/// Path length of the tip past its own start after a full turn of a ring of that length, mm.
pub(super) fn lapped(cut: &Cut, length: f64) -> f64 {
    let (start, last) = (cut.points[cut.body], cut.points.len() - 1);
    let end = cut.stations[last];
    let on_way = |k: usize| {
        let [from, to] = [cut.points[k], cut.points[k + 1]];
        let share = polyline::foot(start, from, to).clamp(0.0, 1.0);
        let station = cut.stations[k] + (cut.stations[k + 1] - cut.stations[k]) * share;
        ((from + (to - from) * share - start).norm(), station)
    };
    // Only the second half of the turn counts.
    let behind = (cut.body..last).rev().take_while(|&k| cut.stations[k] - cut.stations[cut.body] >= length / 2.0);
    let nearest = behind.map(on_way).min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.map_or(0.0, |(_, station)| end - station)
}

/// Straight extension of a line beyond its start or its end, `length` mm long.
fn way_on(line: &Line, at_start: bool, length: f64) -> [Point; 2] {
    let (end, along) = if at_start {
        (line.point(0), -line.direction(0))
    } else {
        (line.point(line.chords()), line.direction(line.chords() - 1))
    };
    [end, end + along * length]
}
