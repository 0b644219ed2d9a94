//! One stroke of the knife, from its plunge to its lift: its cut, and the headings of the blade.
//!
//! The cut of a stroke is the blade's body where it plunges, then the track of the tip. Both are followed along their line of
//! the reference.

use std::ops::RangeToInclusive;

use super::body::{Cut, Sagitta};
use super::chord::{self, Blade, Trailing};
use super::done::Done;
use super::drift;
use super::heading::{self, Moving, Plunge};
use super::naming::Naming;
use super::overcut::{self, Lines, Overcut};
use super::strokes::Stroke;
use super::trial::{REACH, Trace, Tracer, Trial};
use super::worsts::Worsts;
use crate::geom::{Point, Vector, cross, left};
use crate::ir::verdict::{Sighting, Worst};
use crate::machine::{Fit, Follow, Knife, MachineProfile};
use crate::verify::axes::crawl;
use crate::verify::declared::{Account, Declared};
use crate::verify::program::row::{Going, Rounding, Row, SAGITTA};
use crate::verify::reference::common::Common;
use crate::verify::reference::ground::Ground;
use crate::verify::reference::held::Held;
use crate::verify::reference::line::Line;
use crate::verify::reference::lines::Reference;
use crate::verify::rules;

/// Distance along the line from its chord, beside the tolerance, within which a cap may be obeyed, mm: a tip that takes a bend
/// inside its tolerance band passes the vertex early or late by less.
const CAP_ASIDE: f64 = 0.5;

/// Greatest number of parts into which a step is divided to compare it with caps: enough for any step of a sound program.
const PARTS_MAX: f64 = 32.0;
/// Distance, beside the offset itself, by which a line may bend away from a cut that leaves it straight on, mm.
const BOW: f64 = 0.1;
/// Fraction by which F may exceed the feed: covers rounding, and a line in the place of an arc, whose ends are a little faster
/// than its middle.
const FEED_EPSILON: f64 = 1e-3;

impl Stroke {
    /// Place `i` of its cut.
    pub(super) fn sighting(&self, cut: &Cut, i: usize) -> Sighting {
        let row = &self.rows()[cut.rows[i.saturating_sub(cut.body)]];
        row.seen_at(cut.points[i])
    }
}

/// The cut of a stroke, and the line that it was meant for once that is known.
pub(in crate::verify) struct Traced {
    pub(super) stroke: Stroke,
    /// Leading end of the blade at each row, and the direction to it from the other end.
    tips: Vec<Point>,
    pub(super) blades: Vec<Vector>,
    /// Distances from the centre to the leading and the trailing end, mm.
    pub(super) ends: [f64; 2],
    /// Velocity of the tip at each row, mm/s, for rows without a time.
    ways: Vec<Vector>,
    pub(super) cut: Cut,
    trace: Trace,
    best: Option<Trial>,
}

impl Traced {
    /// The rows of its stroke.
    pub(super) fn rows_of(&self) -> &[Row] {
        self.stroke.rows()
    }

    /// Number of rows of its stroke.
    pub(in crate::verify) fn rows(&self) -> usize {
        self.stroke.rows().len()
    }
}

/// Judges strokes.
pub(in crate::verify) struct Judge<'a> {
    pub(in crate::verify) reference: &'a Reference<'a>,
    /// The edges that are cut with other parts.
    pub(in crate::verify) common: &'a Common,
    /// Contents of parts, each with the outline that must be cut later.
    pub(in crate::verify) held: &'a [Held],
    /// Rounding of the rows.
    pub(in crate::verify) rows_rounding: Rounding,
    pub(super) profile: &'a MachineProfile,
    /// Deviations found at the declarations of the program.
    pub(in crate::verify) account: Option<Account<'a>>,
    pub(super) knife: &'a Knife,
    period: f64,
    /// Rounding of a tip's place, mm.
    rounding: f64,
    /// Shortest motion of the tip that shows a direction, mm, and the turn that rounding may add to a shorter one, degrees.
    way_min: f64,
    noise_deg: f64,
    pub(super) tracer: Tracer<'a>,
    /// Greatest overlap at one end, and the sum over both ends, mm.
    pub(super) overlap: f64,
    overlaps: f64,
    /// Greatest excess of a tolerance band over its tolerance, mm: the chord sagitta.
    pub(super) sagitta: f64,
    pub(super) overcut: Overcut<'a>,
    naming: Naming,
    worsts: Worsts,
}

impl<'a> Judge<'a> {
    /// Judges a program with rounded rows by the reference and the parts of a ground.
    pub(in crate::verify) fn new(
        Ground { reference, grid, inside, common, held }: &'a Ground<'a>,
        declared: Option<&'a Declared>,
        profile: &'a MachineProfile,
        rounding: Rounding,
    ) -> Self {
        let place = rounding.place();
        let knife = &profile.knife;
        let [heel, front] = knife.most_overlaps();
        let overlaps = front + heel;
        let tolerance = reference.tolerance;
        let tracer = Tracer {
            reference,
            grid,
            declared,
            width: knife.width_mm,
            allowed: tolerance + place,
            max_uncut: profile.verify.max_uncut_mm,
            max_heading: profile.verify.max_heading_deg.to_radians(),
            slack: overlaps + knife.width_mm + 2.0 * tolerance,
        };
        Self {
            reference,
            common,
            held,
            rows_rounding: rounding,
            profile,
            account: declared.map(|declared| Account::new(declared, reference)),
            knife,
            period: profile.time.period(),
            rounding: place,
            way_min: heading::way_min(rounding),
            noise_deg: heading::noise_deg(rounding),
            tracer,
            overlap: front.max(heel),
            overlaps,
            sagitta: if profile.path.fit == Fit::Curve { profile.path.chord_sag_max_mm } else { 0.0 },
            overcut: Overcut::new(reference, inside, declared, profile, place),
            naming: Naming::new(tolerance),
            worsts: Worsts::new(profile, tolerance, rounding),
        }
    }

    /// Makes the judge exact for programs that tell the velocity of the tip at each place: rounding then turns no direction.
    pub(in crate::verify) fn with_exact_directions(mut self, profile: &MachineProfile) -> Self {
        self.worsts.heading = Worst::new(&rules::HEADING, Some(profile.verify.max_heading_deg));
        self
    }

    /// Worst values before anything is judged.
    pub(in crate::verify) fn worsts(&self) -> Worsts {
        self.worsts.clone()
    }

    /// Traces the cut of a stroke over the lines near it.
    pub(in crate::verify) fn trace(&self, stroke: Stroke) -> Traced {
        let rows = stroke.rows();
        let mut blades: Vec<Vector> = Vec::with_capacity(rows.len());
        for (i, row) in rows.iter().enumerate() {
            // While C rests the blade keeps its direction.
            let rests = i > 0 && rows[i - 1].c_deg == row.c_deg;
            blades.push(if rests { blades[i - 1] } else { row.along() });
        }
        let mut ends = self.knife.ends();
        if self.goes_backwards(rows, &blades) {
            for blade in &mut blades {
                *blade = -*blade;
            }
            ends.reverse();
        }
        let [lead, heel] = ends;
        // The tip swings about the centre as the blade turns.
        let way = |(going, &blade): (&Going, &Vector)| going.way + left(blade) * (lead * going.turn);
        let ways = stroke.goings().iter().zip(&blades).map(way).collect();
        let tips: Vec<Point> = rows.iter().zip(&blades).map(|(row, &along)| row.centre + along * lead).collect();
        let heel = rows[0].centre - blades[0] * heel;
        let sagitta = if stroke.goings().is_empty() { Sagitta::Timed } else { Sagitta::Within(SAGITTA) };
        let cut = Cut::new(&tips, heel, sagitta, self.reference.tolerance);
        let trace = self.tracer.trace(&cut, rows[0].block);
        Traced { stroke, tips, blades, ends, ways, cut, trace, best: None }
    }

    /// True if the back edge of a blade with two edges leads: the centre moves towards its heel.
    fn goes_backwards(&self, rows: &[Row], blades: &[Vector]) -> bool {
        let along = rows.windows(2).zip(blades).map(|(w, blade)| (w[1].centre - w[0].centre).dot(blade));
        self.knife.edges == 2 && along.sum::<f64>() < 0.0
    }

    /// Finds the line that a stroke was meant for, which depends on earlier cuts, and marks the stretches that it cuts.
    pub(in crate::verify) fn settle(&self, traced: &mut Traced, done: &mut Done) {
        let Traced { stroke, cut, trace, .. } = traced;
        let first = &stroke.rows()[0];
        let Some(mut best) = self.tracer.choose(trace, cut, &done.coverage) else { return };
        best.passed = done.coverage.passed(best.line, &best.stretches);
        best.untouched = done.coverage.untouched(best.line, &best.thin);
        done.coverage.add_cores(best.line, &best.thin);
        done.order.cut(first.tick, best.line, stroke.sighting(cut, cut.body));
        done.coverage.add(best.line, &best.stretches, cut.is_plunge_cut());
        done.meetings.see(cut, &best);
        self.see_beyond(cut, &best, &mut done.coverage);
        traced.best = Some(best);
    }

    /// Judges a stroke whose line is known.
    pub(in crate::verify) fn check(&self, traced: &Traced, worsts: &mut Worsts) {
        let Traced { stroke, cut, best, .. } = traced;
        let rows = stroke.rows();
        let seen = |i: usize| stroke.sighting(cut, i);
        worsts.down.see(cut.way(), || rows[rows.len() - 1].sighting());
        self.check_feed(traced, &mut worsts.feed);
        if stroke.goings().is_empty() {
            self.check_standing(traced, &mut worsts.crawl);
        } else {
            self.check_crawl(traced, &mut worsts.crawl);
        }
        self.check_heading(traced, &mut worsts.heading);
        let Some(best) = best else {
            worsts.stray.see(cut.length().max(self.knife.width_mm).max(REACH), || seen(cut.body));
            return;
        };
        if cut.is_plunge_cut() && self.knife.width_mm > 0.0 {
            self.check_plunge_cut(cut, best, &seen, worsts);
        } else {
            self.check_way(cut, best, &seen, &mut worsts.on_path);
            self.check_lifts(cut, best, &seen, worsts);
        }
        worsts.on_path.see(best.worst.0, || seen(best.worst.1));
        let outer = best.outer(cut);
        self.check_ends((cut, best), &outer, &seen, &mut worsts.stray);
        self.check_veer(cut, best, &seen, &mut worsts.stray);
        self.check_overlaps(cut, best, &seen, worsts);
        worsts.once.see(self.twice(cut, best), || seen(cut.body));
        if !best.laps {
            self.overcut.see(&self.ends(cut, best), &outer, &seen, worsts);
        }
        self.check_body(traced, best, worsts);
        self.find(traced, best);
        if stroke.goings().is_empty() {
            // Only rows with a time name their blocks one by one.
            self.check_names(rows, cut, best, &mut worsts.block);
        }
    }

    /// The blade leaves its line straight on; places beyond the end are compared with that direction.
    fn check_way(&self, cut: &Cut, trial: &Trial, seen: &impl Fn(usize) -> Sighting, on_path: &mut Worst) {
        let line = &self.reference.lines[trial.line];
        let last = *trial.held.end();
        let foot = trial.feet[last];
        let along = line.direction(foot.chord);
        for (i, &point) in cut.points.iter().enumerate().skip(last + 1) {
            on_path.see(cross(along, point - cut.points[last]).abs(), || seen(i));
        }
    }

    /// Length of a line that a stroke cuts twice, mm. A plunge cut may be longer than the rest of its line.
    fn twice(&self, cut: &Cut, trial: &Trial) -> f64 {
        let all = trial.stretches.iter().map(|[a, b]| b - a).sum::<f64>();
        // A plunge may repeat a stretch that earlier plunges only passed within the tolerance: no blade has lain on it.
        let is_new = |length: f64| length >= self.reference.tolerance;
        if !is_new(trial.fresh) && !is_new(trial.untouched) && !trial.is_last {
            // A stroke that cuts nothing new counts with its overlaps.
            all - trial.fresh + self.overlaps + self.knife.width_mm.max(REACH)
        } else if cut.is_plunge_cut() {
            0.0
        } else {
            // A ring that ends over its own start cuts that twice.
            trial.passed + (all - self.reference.lines[trial.line].length()).max(0.0)
        }
    }

    /// Compares the blade with its orientation mode. A plunge cut has no direction of motion, so both modes are equal for it.
    fn check_heading(&self, traced: &Traced, heading: &mut Worst) {
        let Traced { stroke, tips, blades, cut, best, .. } = traced;
        let is_chord = self.knife.follow == Follow::Chord && self.knife.width_mm > 0.0 && !cut.is_plunge_cut();
        let (true, Some(trial)) = (is_chord, best) else { return self.check_tangent(traced, heading) };
        let mut chord = self.worsts.heading.clone();
        let rows = stroke.rows();
        if !trial.laps {
            // At the plunge both modes are equal: the line gives the turn of the tip's path from there on.
            let first = tips.iter().position(|tip| (tip - tips[0]).norm() >= self.way_min).unwrap_or(0);
            let (lead, fade) = (self.plunge(cut, trial).lead(), self.knife.width_mm);
            self.compare(&Moving { lead, fade, ..self.moving(traced, ..=first) }, &mut chord);
        }
        let heels = chord::along(rows, self.blade(traced, trial), 0.0);
        let allowed = self.reference.tolerance + self.rounding;
        Trailing { rows, tips, blades, heels: &heels, allowed, rounding: self.rounding }.check(self.knife, &mut chord);
        let ends = [trial.feet[0].station, trial.feet[cut.points.len() - 1].station];
        if self.reference.lines[trial.line].is_tight([ends[0].min(ends[1]), ends[0].max(ends[1])]) {
            // Where the line is too tight for the chord mode, the tangent mode holds.
            let mut tangent = self.worsts.heading.clone();
            self.check_tangent(traced, &mut tangent);
            if tangent.value() < chord.value() {
                chord = tangent;
            }
        }
        heading.add(&chord);
    }

    /// Compares the blade with the direction of motion of its tip.
    fn check_tangent(&self, traced: &Traced, heading: &mut Worst) {
        let Traced { stroke, cut, best, .. } = traced;
        let lead = match best {
            None => heading::ANY,
            Some(trial) if trial.laps => heading::NONE,
            Some(trial) => self.plunge(cut, trial).lead(),
        };
        let fade = self.knife.width_mm.min(cut.way());
        self.compare(&Moving { lead, fade, ..self.moving(traced, ..=stroke.rows().len() - 1) }, heading);
    }

    /// Compares a blade with the motion of its tip: row by row where rows show a direction, else by its drift.
    fn compare(&self, moving: &Moving, heading: &mut Worst) {
        if moving.ways.is_empty() && self.noise_deg > 0.0 {
            let [x, y, c] = self.rows_rounding.axes;
            let rounding = x.hypot(y) + c.to_radians() * self.knife.width_mm;
            drift::check(moving, [rounding, self.tracer.max_heading], heading);
        } else {
            moving.check(heading);
        }
    }

    /// The first rows of a stroke, to be compared with the motion of their tip.
    fn moving<'t>(&self, traced: &'t Traced, rows: RangeToInclusive<usize>) -> Moving<'t> {
        let Traced { stroke, tips, blades, ways, .. } = traced;
        Moving {
            rows: &stroke.rows()[rows],
            ways: ways.get(rows).unwrap_or_default(),
            tips: &tips[rows],
            blades: &blades[rows],
            lead: heading::NONE,
            fade: 0.0,
            way_min: self.way_min,
            noise_deg: self.noise_deg,
        }
    }

    pub(super) fn blade<'t>(&'t self, traced: &'t Traced, trial: &'t Trial) -> Blade<'t> {
        let line = &self.reference.lines[trial.line];
        Blade { line, ends: traced.ends, cut: &traced.cut, directions: &traced.blades, feet: &trial.feet }
    }

    /// Greatest deviation of a cut from its line, mm.
    pub(in crate::verify) fn allowed(&self) -> f64 {
        self.tracer.allowed
    }

    fn plunge(&self, cut: &Cut, trial: &Trial) -> Plunge<'_> {
        let (heel, tip) = (trial.feet[0], trial.feet[cut.body]);
        let last = trial.feet[cut.points.len() - 1];
        let line = &self.reference.lines[trial.line];
        let sign = if last.station < heel.station { -1.0 } else { 1.0 };
        Plunge { line, heel, tip, sign, band: self.reference.tolerance + self.rounding + self.sagitta }
    }

    /// Excess of a length over the allowed one, mm; 0 where rounding of the rows explains it.
    pub(super) fn excess(&self, length: f64, allowed: f64) -> f64 {
        let excess = length - allowed;
        if excess > self.rounding { excess } else { excess.min(0.0) }
    }

    /// Beyond its stretch of the line a stroke may cut overlaps only; `outer` are the places there.
    fn check_ends(
        &self,
        (cut, trial): (&Cut, &Trial),
        outer: &[(usize, f64)],
        seen: &impl Fn(usize) -> Sighting,
        stray: &mut Worst,
    ) {
        if trial.laps || cut.is_plunge_cut() && self.knife.width_mm > 0.0 {
            return;
        }
        let allowed = self.overlap + self.reference.tolerance;
        for &(i, beyond) in outer.iter().filter(|(_, beyond)| *beyond > allowed) {
            let end = self.reference.lines[trial.line].place(trial.feet[i].station);
            stray.see(self.excess(beyond, allowed.max(self.reference.across(end))), || seen(i));
        }
    }

    /// Where windows of a conveyor split an edge, its cuts leave the edge by at most the distance of the profile.
    fn check_veer(&self, cut: &Cut, trial: &Trial, seen: &impl Fn(usize) -> Sighting, stray: &mut Worst) {
        let (line, bite) = (&self.reference.lines[trial.line], &self.profile.bite);
        let is_section = self.reference.marker.pieces[line.piece as usize].section.is_some();
        if line.aside.is_empty() || !is_section {
            return;
        }
        let tolerance = self.reference.tolerance;
        // The cut and its line may each be off by the tolerance.
        let allowed = bite.veer(tolerance) + 2.0 * tolerance + BOW;
        for i in trial.held.clone() {
            let station = trial.feet[i].station;
            if line.aside.iter().any(|&[from, to]| (from..=to).contains(&station)) {
                let away = self.overcut.distance_to_edges(cut.points[i], 2.0 * allowed);
                stray.see(self.excess(away, allowed), || seen(i));
            }
        }
    }

    /// Compares the speed of the tip from row to row, or F, with the greatest cap that holds anywhere on the step.
    fn check_feed(&self, traced: &Traced, feed: &mut Worst) {
        let Traced { stroke, ways, cut, best, .. } = traced;
        let rows = stroke.rows();
        let slack = self.reference.tolerance + CAP_ASIDE;
        let of_line = best.as_ref().map(|trial| (trial, &self.reference.lines[trial.line], trial.sign(cut)));
        let feed_of_knife = self.knife.feed_mm_s.unwrap_or(f64::INFINITY);
        let only = of_line.map_or(Some(feed_of_knife), |(_, line, sign)| line.only_cap(sign));
        let cap = |i: usize| {
            let by_place = |(trial, line, sign): (&Trial, &Line, f64)| {
                let [a, b] = [0, 1].map(|k| trial.feet[cut.body + i + k].station);
                let (low, high) = (a.min(b), a.max(b));
                // F holds over the whole step, which may be long: each part of it has its own cap.
                let parts = if ways.is_empty() { 1.0 } else { ((high - low) / CAP_ASIDE).ceil().clamp(1.0, PARTS_MAX) };
                let part = |k: usize| low + (high - low) * (k as f64 / parts);
                let caps = (0..parts as usize).map(|k| [part(k) - slack, part(k + 1) + slack]);
                caps.map(|ends| line.cap(ends, sign, f64::max)).fold(f64::INFINITY, f64::min)
            };
            only.or_else(|| of_line.map(by_place)).unwrap_or(feed_of_knife)
        };
        let rounding = 4.0 * self.rounding / self.period;
        for (i, ends) in cut.points[cut.body..].windows(2).enumerate() {
            let last = cut.rows[i + 1];
            if ways.is_empty() {
                let speed = (ends[1] - ends[0]).norm() / self.period;
                feed.see_under(speed, cap(i) + rounding, || rows[last - 1].sighting());
            } else {
                let speed = ways[last].norm() * (1.0 - FEED_EPSILON);
                feed.see_under(speed, cap(i), || rows[last].sighting());
            }
        }
    }

    /// Longest time that a stroke whose rows have times stays in one place.
    fn check_standing(&self, traced: &Traced, crawl: &mut Worst) {
        let Traced { stroke, tips, cut, best, .. } = traced;
        let rows = stroke.rows();
        let least = |trial: &Trial| {
            let (line, sign) = (&self.reference.lines[trial.line], trial.sign(cut));
            line.only_cap(sign).unwrap_or_else(|| line.cap([0.0, line.length()], sign, f64::min))
        };
        let feed = best.as_ref().map_or(self.knife.feed_mm_s.unwrap_or(f64::INFINITY), least);
        let times: Vec<f64> = rows.iter().map(|row| row.t).collect();
        let (longest, row) = crawl::longest(&times, tips, crawl::fair_time(self.profile, feed));
        crawl.see(longest, || rows[row].sighting());
    }

    /// Compares the least F with the least cap that holds anywhere on a step and with the limits of the axes.
    fn check_crawl(&self, traced: &Traced, crawl: &mut Worst) {
        let Traced { stroke, ways, cut, best: Some(trial), .. } = traced else { return };
        let (rows, goings) = (stroke.rows(), stroke.goings());
        let (line, sign) = (&self.reference.lines[trial.line], trial.sign(cut));
        let (only, slack) = (line.only_cap(sign), self.reference.tolerance + CAP_ASIDE);
        // A tip that turns on the spot stays at one place of its cut.
        let (mut place, mut least) = (0, (f64::INFINITY, 0));
        for (i, (going, way)) in goings.iter().zip(ways).enumerate() {
            let before = place;
            place += usize::from(cut.rows.get(place + 1) == Some(&i));
            // Nothing moves there, or an axis works harder than at the slowest place so far.
            if going.used == 0.0 || going.used >= least.0 {
                continue;
            }
            let cap = only.unwrap_or_else(|| {
                let [a, b] = [before, place].map(|place| trial.feet[cut.body + place].station);
                line.cap([a.min(b) - slack, a.max(b) + slack], sign, f64::min)
            });
            let used = going.used.max(way.norm() / cap);
            if used < least.0 {
                least = (used, i);
            }
        }
        crawl.see(least.0.recip(), || rows[least.1].sighting());
    }

    /// A stroke on its line.
    pub(super) fn ends<'t>(&'t self, cut: &'t Cut, trial: &'t Trial) -> overcut::Ends<'t> {
        let lines = Lines { reference: self.reference, grid: self.tracer.grid };
        overcut::Ends { cut, trial, line: &self.reference.lines[trial.line], lines }
    }

    /// Compares the block names of rows with the blocks of the chords that they cut.
    fn check_names(&self, rows: &[Row], cut: &Cut, trial: &Trial, block: &mut Worst) {
        let line = &self.reference.lines[trial.line];
        let [from, to] = trial.reach;
        let reach = [from.min(to), from.max(to)];
        for (i, ends) in (cut.body..).zip(cut.rows.iter().zip(cut.rows[1..].iter().chain([&rows.len()]))) {
            // The excess length of a plunge cut has the block name of the nearest place on its line.
            let station = trial.feet[i.clamp(*trial.held.start(), *trial.held.end())].station;
            for row in rows[*ends.0..*ends.1].iter().filter(|row| row.knife) {
                // A plunge cut may cut several chords while its tip is on none of them.
                let is_of_plunge_cut = cut.is_plunge_cut() && line.names(row.block, reach);
                let away = if is_of_plunge_cut { 0.0 } else { self.naming.away(row.block, line, station) };
                block.see(away, || row.sighting());
            }
        }
    }
}
