//! Measurement of declared deviations, each at the place where the program declares it.

use super::body::Cut;
use super::chord::{self, BODY_SHARES};
use super::heading::on_lap;
use super::overlap::lapped;
use super::plunged::Plunged;
use super::stroke::{Judge, Traced};
use super::trial::Trial;
use crate::geom::{Point, polyline};
use crate::ir::declaration::{Declaration, Kind, Which};
use crate::machine::Follow;
use crate::verify::declared::{Account, Stretch};

/// Greatest travel of a tip that counts as standing still, in multiples of the tolerance: smoothing moves both the plunge and
/// the lift, and the line at each.
const STILL_TOLERANCES: f64 = 4.0;
/// Spacing of the places at which the drawn line is checked, mm.
const SWING_STEP: f64 = 0.25;
/// Length of the line behind the tip that is checked, in multiples of the blade width.
const BEHIND: f64 = 2.0;

impl Judge<'_> {
    /// Measures everything that may be declared of a stroke, if its line has any declarations.
    pub(super) fn find(&self, traced: &Traced, trial: &Trial) {
        let (line, cut) = (&self.reference.lines[trial.line], &traced.cut);
        let Some(account) = self.account.as_ref().filter(|account| !account.is_silent(line)) else { return };
        let whole = Stretch { line, stations: trial.reach, end: None };
        self.find_ends(cut, trial, account);
        if self.knife.width_mm == 0.0 {
            return;
        }
        let under = [0, cut.body].map(|place| trial.feet[place].station);
        let plunged = if cut.is_plunge_cut() { whole } else { Stretch { stations: under, ..whole } };
        // Deviations of the drawn line are quick to measure; those of the rows are measured only if these fall short.
        if let Some(enough) = account.lacks(Kind::Plunge, plunged) {
            account.see(Kind::Plunge, plunged, self.drawn_beside(cut, trial, enough));
        }
        if account.lacks(Kind::Plunge, plunged).is_some() {
            account.see(Kind::Plunge, plunged, self.beside(cut, trial));
        }
        // Blade that is declared to stand still: its tip may travel as far as smoothing moves it.
        let is_still = || cut.tip_travel() <= STILL_TOLERANCES * self.reference.tolerance;
        if account.lacks(Kind::Nibbled, whole).is_some() && is_still() {
            account.see(Kind::Nibbled, whole, (trial.reach[1] - trial.reach[0]).abs());
        }
        if cut.is_plunge_cut() {
            self.find_surplus(cut, trial, account);
            return;
        }
        if let Some(enough) = account.lacks(Kind::Swing, whole) {
            account.see(Kind::Swing, whole, self.drawn_swing(cut, trial, enough));
        }
        if account.lacks(Kind::Swing, whole).is_some() {
            account.see(Kind::Swing, whole, self.swing(traced, trial));
        }
    }

    /// Measures overlaps at both ends of a stroke, and lifts where the stroke ends inside its line.
    fn find_ends(&self, cut: &Cut, trial: &Trial, account: &Account) {
        let (knife, line) = (self.knife, &self.reference.lines[trial.line]);
        let asked = [
            [knife.heel_overlap_mm, knife.corner_heel_overlap_mm, knife.reflex_heel_overlap_mm],
            [knife.front_overlap_mm, knife.corner_front_overlap_mm, knife.reflex_front_overlap_mm],
        ];
        let places = [0, cut.points.len() - 1];
        for (i, which) in [Which::Start, Which::End].into_iter().enumerate() {
            let station = trial.reach[i];
            // The two ends of a blade that does not move cannot be told apart.
            let end = if cut.is_plunge_cut() { None } else { Some(which) };
            let here = Stretch { line, stations: [station; 2], end };
            let is_lap = trial.laps && which == Which::End;
            let beyond = if is_lap { lapped(cut, line.length()) } else { trial.beyond(cut, places[i]) };
            account.see(Kind::Overcut, here, beyond);
            account.see(Kind::Shortened, here, asked[i].into_iter().fold(0.0, f64::max) - beyond);
            let is_amid = || station.min(line.length() - station) > self.tracer.allowed;
            if if line.ring { !trial.laps } else { is_amid() } {
                account.see(Kind::Lift, here, 0.0);
            }
        }
    }

    /// Greatest distance between blade and line at the plunge, mm.
    fn beside(&self, cut: &Cut, trial: &Trial) -> f64 {
        let line = &self.reference.lines[trial.line];
        let over = trial.over.or_else(|| Plunged::new(line, cut, &trial.feet, self.tracer.allowed));
        let body = trial.feet[..cut.body].iter().filter(|foot| foot.beyond == 0.0).map(|foot| foot.deviation);
        body.chain(over.map(|over| over.sagitta)).fold(0.0, f64::max)
    }

    /// Distance between the blade and the drawn line at the plunge, mm. On a tight curve it depends on the start, which the
    /// heel gives only to within the tolerance: the greatest value for three starts, or the first that reaches `enough`.
    fn drawn_beside(&self, cut: &Cut, trial: &Trial, enough: f64) -> f64 {
        let line = &self.reference.lines[trial.line];
        let [from, to] = trial.reach;
        let beside = |from: f64| {
            let from = if line.ring { from } else { from.clamp(0.0, line.length()) };
            let led_on = self.drawn(cut, trial, [from, to]);
            let alone = &led_on[usize::from(trial.beyond(cut, 0) > 0.0 && !trial.laps)..];
            // The body at the start of a ring lies behind the start, or before it on the previous lap.
            let lap = if from < to { -line.length() } else { line.length() };
            let back = if trial.laps { self.drawn(cut, trial, [from, from + lap]) } else { Vec::new() };
            let lines = [&led_on, alone, &back].into_iter().filter(|points| points.len() > 1);
            lines.map(|points| bow(points, self.knife.width_mm)).fold(0.0, f64::max)
        };
        let aside = 2.0 * self.tracer.allowed;
        let mut most = 0.0_f64;
        for from in [from, from - aside, from + aside] {
            if most < enough {
                most = most.max(beside(from));
            }
        }
        most
    }

    /// Greatest distance of the body from the drawn line along the stroke while the blade follows it as a tangent or a chord,
    /// mm: from where the body has left the place of the plunge, on a ring from the start. Stops early once the result reaches
    /// `enough`.
    fn drawn_swing(&self, cut: &Cut, trial: &Trial, enough: f64) -> f64 {
        if enough <= 0.0 {
            return 0.0;
        }
        let width = self.knife.width_mm;
        let behind = if trial.laps { BEHIND * width } else { 0.0 };
        let [from, to] = trial.reach;
        let points = self.drawn(cut, trial, [if from < to { from - behind } else { from + behind }, to]);
        let stations = polyline::stations(&points);
        let mut most = 0.0_f64;
        for chord in 0..points.len() - 1 {
            let Some(along) = polyline::direction(points[chord], points[chord + 1]) else { continue };
            let (start, length) = (stations[chord], stations[chord + 1] - stations[chord]);
            let steps = (length / SWING_STEP).ceil().max(1.0);
            // Beyond one width the blade lies on the chord that it follows.
            let tips = (0..=steps as usize).map(|step| start + length * (step as f64 / steps));
            let mut from = behind.max(width);
            for tip in tips.take_while(|tip| tip - start <= width) {
                if tip < from {
                    continue;
                }
                let first = stations.partition_point(|&passed| passed < tip - BEHIND * width).saturating_sub(1);
                let followed = Followed { points: &points[first..=chord], tip: points[chord] + along * (tip - start) };
                let off = followed.off(followed.tip - along * width);
                most = most.max(off);
                match self.knife.follow {
                    // The deviation grows at most as fast as the tip advances: before this place it does not exceed the maximum
                    // so far.
                    Follow::Tangent => from = tip + (most - off),
                    // Where a line is too tight for the chord mode, the blade lies along the tangent in either mode.
                    Follow::Chord => most = most.max(followed.bow(width)),
                }
                if most >= enough {
                    return most;
                }
            }
        }
        most
    }

    /// Drawn line from one station to the other, extended straight by the overlaps of a stroke.
    fn drawn(&self, cut: &Cut, trial: &Trial, [from, to]: [f64; 2]) -> Vec<Point> {
        let line = &self.reference.lines[trial.line];
        let (low, high) = (from.min(to), from.max(to));
        let inner = line.vertices(low, high).map(|vertex| line.point(vertex));
        let place = |station: f64| line.place(on_lap(line, station));
        let mut points: Vec<Point> = std::iter::once(place(low)).chain(inner).chain([place(high)]).collect();
        if to < from {
            points.reverse();
        }
        let last = points.len() - 1;
        let led = |end: usize, next: usize, place: usize| {
            let along = polyline::direction(points[next], points[end])?;
            let beyond = trial.beyond(cut, place);
            // A ring overlaps itself.
            (beyond > 0.0 && !trial.laps).then(|| points[end] + along * beyond)
        };
        let [before, behind] = [led(0, 1, 0), led(last, last - 1, cut.points.len() - 1)];
        before.into_iter().chain(points).chain(behind).collect()
    }

    /// Greatest distance of the body of a moving blade from its line, mm.
    fn swing(&self, traced: &Traced, trial: &Trial) -> f64 {
        let shares: &[f64] = match self.knife.follow {
            Follow::Tangent => &[0.0],
            Follow::Chord => &BODY_SHARES,
        };
        let feet = shares.iter().flat_map(|&share| chord::along(traced.rows_of(), self.blade(traced, trial), share));
        feet.filter(|foot| foot.beyond == 0.0).map(|foot| foot.deviation).fold(0.0, f64::max)
    }

    /// Measures how deep the ends of a plunge cut reach into the part itself and into other parts.
    fn find_surplus(&self, cut: &Cut, trial: &Trial, account: &Account) {
        let line = &self.reference.lines[trial.line];
        let stroke = self.ends(cut, trial);
        for end in [Which::Start, Which::End] {
            let here = Stretch { line, stations: trial.reach, end: Some(end).filter(|_| self.knife.edges == 1) };
            let is_in = |side: usize| move |entry: &Declaration| self.overcut.is_in(entry, side == 0, line);
            let lacking = [0, 1].map(|side| account.lacks_where(Kind::Surplus, here, is_in(side)));
            if lacking == [None; 2] {
                continue;
            }
            let places = (0..cut.points.len()).filter(|&place| trial.end_at(place) == end);
            let mut deepest = [0.0_f64; 2];
            for place in places {
                let depths = self.overcut.depths_at(place, &stroke);
                deepest = [deepest[0].max(depths[0]), deepest[1].max(depths[1])];
                if deepest.iter().zip(lacking).all(|(depth, enough)| enough.is_none_or(|enough| *depth >= enough)) {
                    break;
                }
            }
            for (side, depth) in deepest.into_iter().enumerate() {
                account.see_where(Kind::Surplus, here, is_in(side), depth);
            }
        }
    }
}

/// Stretch of a drawn line behind the tip of a moving blade.
struct Followed<'a> {
    /// Points of the line up to the start of the tip's chord.
    points: &'a [Point],
    tip: Point,
}

impl Followed<'_> {
    /// Distance of a point from the stretch, mm.
    fn off(&self, place: Point) -> f64 {
        let last = polyline::distance_to_segment(place, self.points[self.points.len() - 1], self.tip);
        let before = self.points.windows(2).map(|ends| polyline::distance_to_segment(place, ends[0], ends[1]));
        before.fold(last, f64::min)
    }

    /// Greatest distance between the stretch and a blade of that width that is its chord from the tip back, mm.
    fn bow(&self, width: f64) -> f64 {
        let back: Vec<Point> = std::iter::once(self.tip).chain(self.points.iter().rev().copied()).collect();
        bow(&back, width)
    }
}

/// Greatest distance between a polyline and the blade that is its chord from its first point on, mm.
fn bow(points: &[Point], width: f64) -> f64 {
    let last = points.len() - 1;
    let (end, chord) = polyline::first_at_distance(points, width).unwrap_or((points[last], last));
    points[..=chord].iter().map(|&point| polyline::distance_to_segment(point, points[0], end)).fold(0.0, f64::max)
}
