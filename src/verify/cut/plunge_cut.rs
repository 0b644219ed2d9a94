//! Checks of a plunge cut: its direction, its reach beyond the line, and whether it may stand there.

use super::body::Cut;
use super::covered::covered;
use super::heading::on_lap;
use super::nibbles::Nibble;
use super::stroke::Judge;
use super::trial::{REACH, Trial};
use super::worsts::Worsts;
use crate::geom::polyline;
use crate::ir::declaration::{Kind, Which};
use crate::ir::verdict::{Sighting, Worst};
use crate::verify::declared::Stretch;
use crate::verify::reference::line::Line;

/// Fraction of the tolerance by which a line must deviate from a straight one to count as a bend.
const SLIGHT_SHARE: f64 = 0.1;

impl Judge<'_> {
    /// Verifies a plunge cut.
    pub(super) fn check_plunge_cut(
        &self,
        cut: &Cut,
        trial: &Trial,
        seen: &impl Fn(usize) -> Sighting,
        worsts: &mut Worsts,
    ) {
        let line = &self.reference.lines[trial.line];
        worsts.heading.see(trial.askew(line, cut).to_degrees(), || seen(cut.body));
        if let Some(over) = trial.over {
            // A curve must not be cut straight where shorter cuts would do less harm.
            let excess = over.sagitta - self.overcut.of_chords(&self.ends(cut, trial));
            worsts.on_path.see(excess, || seen(cut.body));
        }
        let is_straight = self.is_straight_about(line, trial.reach);
        if is_straight {
            self.check_surplus(line, cut, trial, seen, &mut worsts.stray);
        }
        self.check_nibble(line, trial, is_straight, || seen(cut.body), worsts);
    }

    /// Checks the surplus: where the line is straight for a blade width, the blade may go beyond it only by its overlaps.
    fn check_surplus(
        &self,
        line: &Line,
        cut: &Cut,
        trial: &Trial,
        seen: &impl Fn(usize) -> Sighting,
        stray: &mut Worst,
    ) {
        let [heel, tip] = cut.blade();
        let Some(along) = polyline::direction(heel, tip) else { return };
        let ends = [0, cut.body].map(|place| trial.feet[place].beyond);
        let at = f64::midpoint(trial.reach[0], trial.reach[1]);
        let most = [ends[0], -ends[1]].map(|shift| {
            let blade = [heel, tip].map(|end| end + along * shift);
            let stretches = covered(line, blade, at, self.tracer.near());
            stretches.iter().map(|[a, b]| b - a).fold(0.0, f64::max)
        });
        if most[0].max(most[1]) < self.knife.width_mm - 2.0 * self.tracer.allowed {
            return;
        }
        let surplus = self.knife.width_mm - most[0].max(most[1]);
        let allowed = self.overlap.max(surplus) + self.reference.tolerance;
        for (place, beyond) in [0, cut.body].into_iter().zip(ends) {
            stray.see(self.excess(beyond, allowed), || seen(place));
        }
    }

    /// Checks a plunge that cuts part of a line: it needs a declaration; in a program without declarations the line must bend
    /// there.
    fn check_nibble(
        &self,
        line: &Line,
        trial: &Trial,
        is_straight: bool,
        seen: impl FnOnce() -> Sighting,
        worsts: &mut Worsts,
    ) {
        let [from, to] = trial.reach;
        let length = (to - from).abs();
        if length >= line.length() - 2.0 * self.tracer.allowed {
            return;
        }
        match self.tracer.declared {
            Some(declared) => {
                let entries = declared.nibbles(Stretch { line, stations: trial.reach, end: None });
                worsts.nibbles.push(Nibble { entries, length, place: seen() });
            }
            None if is_straight => worsts.declared.see(length, seen),
            None => {}
        }
    }

    /// True if a line is straight under a blade and for a blade width on either side.
    pub(super) fn is_straight_about(&self, line: &Line, stations: [f64; 2]) -> bool {
        self.is_straight_within(line, stations, self.tracer.allowed)
    }

    /// True if a line is straight within `slack` mm under a blade and for a blade width on either side.
    fn is_straight_within(&self, line: &Line, [a, b]: [f64; 2], slack: f64) -> bool {
        let (width, length) = (self.knife.width_mm, line.length());
        let (low, high) = (a.min(b) - width, a.max(b) + width);
        let [low, high] = if line.ring { [low, high] } else { [low.max(0.0), high.min(length)] };
        let [from, to] = [low, high].map(|station| line.place(on_lap(line, station)));
        let mut between = line.vertices(low, high).map(|vertex| line.point(vertex));
        between.all(|point| polyline::distance_to_segment(point, from, to) <= slack)
    }

    /// Checks lifts inside a line: each needs a cause and a declaration. In a program without declarations lifts are allowed
    /// anywhere, since the line is still cut.
    pub(super) fn check_lifts(&self, cut: &Cut, trial: &Trial, seen: &impl Fn(usize) -> Sighting, worsts: &mut Worsts) {
        let Some(declared) = self.tracer.declared else { return };
        let line = &self.reference.lines[trial.line];
        let [from, to] = trial.reach;
        let length = (to - from).abs();
        if trial.laps || line.ring && length >= line.length() - 2.0 * self.tracer.allowed {
            return;
        }
        let places = [cut.body, cut.points.len() - 1].into_iter().zip([Which::Start, Which::End]);
        let mut is_nibbled = false;
        for (station, (place, end)) in trial.reach.into_iter().zip(places) {
            let inside = if line.ring { f64::INFINITY } else { station.min(line.length() - station) };
            if inside <= 2.0 * self.tracer.allowed {
                continue;
            }
            if !self.may_lift(line, station) {
                worsts.declared.see(inside.min(self.knife.width_mm.max(REACH)), || seen(place));
            }
            is_nibbled |= !declared.has(Kind::Lift, Stretch { line, stations: [station; 2], end: Some(end) });
        }
        if is_nibbled {
            let entries = declared.nibbles(Stretch { line, stations: trial.reach, end: None });
            worsts.nibbles.push(Nibble { entries, length, place: seen(cut.body) });
        }
    }

    /// True if the knife may have to be lifted inside a line: on a bend, and anywhere if the profile limits the length of a
    /// run, the range of C or the swing of the blade.
    fn may_lift(&self, line: &Line, station: f64) -> bool {
        self.knife.max_down_mm.is_some()
            || self.knife.max_swing_mm.is_some()
            || self.profile.c.range_deg.is_some()
            || !self.is_straight_within(line, [station; 2], SLIGHT_SHARE * self.tracer.allowed)
    }
}
