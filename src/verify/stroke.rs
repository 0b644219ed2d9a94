//! One stroke of the knife, from its plunge to its lift: what it cut, and how the blade lay.
//!
//! What a stroke cuts is the blade's body where it plunges, then the track of the tip. Both are followed along the line
//! of the reference that they belong to.

use std::ops::RangeInclusive;

use super::Done;
use super::body::{BODY_STEP, Body, Cut};
use super::coverage::Coverage;
use super::follow::{Follower, Foot, on_chord};
use super::grid::Grid;
use super::heading::{self, Moving, Plunge};
use super::joints::{Around, Joints};
use super::overcut::{self, Lines, Overcut};
use super::read::{Rounding, Row};
use super::reference::{Line, Reference};
use super::worst::{Worst, at};
use crate::geom::{Point, Vector, angle, polyline};
use crate::ir::Finding;
use crate::ir::finding::Sighting;
use crate::machine::{Fit, Knife, MachineProfile};

/// How far from a line a stroke may lie and still be taken for a bad cut of it, mm.
const REACH: f64 = 2.0;
/// Lines that a stroke is tried on, at the most.
const TRIALS: usize = 8;
/// How far from its chord, along the line, a cap may be obeyed, mm, beside the tolerance: a tip that takes a bend inside
/// its tube passes the vertex early or late by less.
const CAP_ASIDE: f64 = 0.5;

/// The rows of a stroke.
#[derive(Debug, Default)]
pub(super) struct Stroke {
    rows: Vec<Row>,
    /// The way of the tip at each row, when that is known exactly; then the rows have no time.
    ways: Vec<Vector>,
}

impl Stroke {
    pub(super) fn push(&mut self, row: &Row, way: Option<Vector>) {
        self.rows.push(*row);
        self.ways.extend(way);
    }

    pub(super) fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    pub(super) fn clear(&mut self) {
        self.rows.clear();
        self.ways.clear();
    }
}

/// Judges strokes.
pub(super) struct Judge<'a> {
    reference: &'a Reference<'a>,
    knife: &'a Knife,
    period: f64,
    /// Rounding of a tip's place, mm.
    rounding: f64,
    /// Least way of the tip that shows a direction, mm.
    way_min: f64,
    grid: Grid,
    joints: Joints,
    /// Greatest overlap at one end, and of both ends together.
    overlap: f64,
    overlaps: f64,
    max_uncut: f64,
    /// Greatest bulge of a tube beside its tolerance, mm.
    bulge: f64,
    on_path: Worst,
    stray: Worst,
    once: Worst,
    heading: Worst,
    down: Worst,
    body: Worst,
    feed: Worst,
    overcut: Overcut,
}

/// A place of a cut that is near a line.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    line: usize,
    chord: usize,
    /// Which point of the cut.
    probe: usize,
    /// Where on the line, mm.
    station: f64,
    /// How far off, mm.
    away: f64,
}

impl Candidate {
    /// Whether one who follows the line from `other` comes by here. Where a line ends at its own start the heel lies at its
    /// end, and following from there leads nowhere.
    fn continues(&self, other: &Self, cut: &Cut, line: &Line) -> bool {
        let between = self.probe.min(other.probe)..=self.probe.max(other.probe);
        let way = polyline::length(&cut.points[between]);
        let apart = (self.station - other.station).abs();
        apart <= way + 2.0 * REACH || line.ring && line.length() - apart <= way + 2.0 * REACH
    }
}

/// A stroke followed along one line.
struct Trial {
    line: usize,
    feet: Vec<Foot>,
    /// Stations that were cut.
    stretches: Vec<[f64; 2]>,
    /// How much of them was not cut before, mm.
    fresh: f64,
    /// How much of the line is then still uncut, mm.
    left: f64,
    /// Greatest deviation, mm, and the index of its place.
    worst: (f64, usize),
    /// Whether it goes all the way round a closed line.
    laps: bool,
    /// The places that are held to the line: of a stab its longest stretch on it; its surplus lies before and behind.
    held: RangeInclusive<usize>,
    /// The joints between which it is a stab that fits what was left of its line: its blade may then be longer.
    fits: Option<[[f64; 2]; 2]>,
    /// From where to where it cuts what was not cut before.
    hull: [f64; 2],
}

impl<'a> Judge<'a> {
    pub(super) fn new(reference: &'a Reference, profile: &'a MachineProfile, rounding: Rounding) -> Self {
        let place = rounding.place();
        let way_min = heading::way_min(rounding);
        let knife = &profile.knife;
        let verify = &profile.verify;
        let front = knife.front_overlap_mm.max(knife.corner_front_overlap_mm);
        let heel = knife.heel_overlap_mm.max(knife.corner_heel_overlap_mm);
        let overlaps = front + heel;
        // A part of a long or winding run overlaps with the one before and, on a closed contour, with the one behind.
        let joints = if knife.max_down_mm.is_some() || profile.c.range_deg.is_some() { 2.0 } else { 1.0 };
        let tolerance = reference.tolerance;
        let period = profile.time.period();
        let feed = knife.feed_mm_s.map(|feed| feed + 4.0 * place / period);
        Self {
            reference,
            knife,
            period,
            rounding: place,
            way_min,
            grid: Grid::new(reference),
            joints: Joints::new(knife),
            overlap: front.max(heel),
            overlaps,
            max_uncut: verify.max_uncut_mm,
            bulge: if profile.path.fit == Fit::Curve { profile.path.chord_sag_max_mm } else { 0.0 },
            on_path: Worst::new("verify/on-path", "mm", Some(tolerance + place)),
            stray: Worst::new("verify/stray", "mm", Some(0.0)),
            once: Worst::new("verify/once", "mm", Some(joints * overlaps + 2.0 * tolerance)),
            heading: Worst::new("verify/heading", "deg", Some(verify.max_heading_deg + heading::noise_deg(rounding))),
            down: Worst::new("verify/down", "mm", knife.max_down_mm.map(|longest| longest + tolerance)),
            body: Worst::new("verify/body", "mm", verify.max_body_mm),
            feed: Worst::new("verify/feed", "mm/s", feed),
            overcut: Overcut::new(reference, profile, place),
        }
    }

    /// The same for programs that tell the way of the tip at each place: rounding then turns no direction.
    pub(super) fn with_exact_directions(mut self, profile: &MachineProfile) -> Self {
        self.heading = Worst::new("verify/heading", "deg", Some(profile.verify.max_heading_deg));
        self
    }

    pub(super) fn findings(self) -> Vec<Finding> {
        let one = [self.on_path, self.stray, self.once, self.heading, self.down, self.body, self.feed];
        one.into_iter().map(Worst::finding).chain(self.overcut.findings()).collect()
    }

    /// Judges one stroke and marks what it cut.
    pub(super) fn judge(&mut self, stroke: &Stroke, done: &mut Done) {
        let rows = &stroke.rows;
        let tips: Vec<Point> = rows.iter().map(|row| row.centre + row.along() * self.knife.radius()).collect();
        let cut = Cut::new(rows, &tips, self.knife);
        self.down.see(polyline::length(&tips), || rows[rows.len() - 1].sighting());
        let trials: Vec<Trial> = self.candidates(&cut).iter().map(|candidate| self.follow(&cut, candidate)).collect();
        let seen = |i: usize| {
            let row = &rows[cut.rows[i.saturating_sub(cut.body)]];
            at(row.t, cut.points[i], row.block)
        };
        let Some(mut best) = self.choose(trials, rows[0].block, &done.coverage) else {
            if stroke.ways.is_empty() {
                self.check_feed(rows, &cut, None);
            }
            self.check_heading(stroke, &tips, (&cut, None));
            self.stray.see(polyline::length(&cut.points).max(self.knife.width_mm).max(REACH), || seen(cut.body));
            return;
        };
        if stroke.ways.is_empty() {
            self.check_feed(rows, &cut, Some(&best));
        }
        let line = &self.reference.lines[best.line];
        if let (true, Some(hull)) = (cut.is_stab(), done.coverage.uncut(best.line, &best.stretches)) {
            (best.hull, best.fits) = (hull, self.fits(line, hull));
        }
        self.check_heading(stroke, &tips, (&cut, Some(&best)));
        if cut.is_stab() {
            self.check_stab(&cut, &best, &seen);
        }
        self.on_path.see(best.worst.0, || seen(best.worst.1));
        self.check_ends(&best, &seen);
        done.order.see(rows[0].tick, line.rank, seen(cut.body));
        self.check_once(&cut, &best, &seen);
        done.coverage.add(best.line, &best.stretches);
        self.check_overcut(&cut, &best, &seen);
        self.check_body(rows, &cut, &best);
        for (i, ends) in (cut.body..).zip(cut.rows.iter().zip(cut.rows[1..].iter().chain([&rows.len()]))) {
            let here = rows[*ends.0..*ends.1].iter().filter(|row| row.knife);
            // What a stab is longer by than its cut is named like that.
            let station = best.feet[i.clamp(*best.held.start(), *best.held.end())].station;
            let station = best.fits.map(overcut::innermost).map_or(station, |[from, to]| station.clamp(from, to));
            here.for_each(|row| done.naming.see_cut(row, line, station));
        }
    }

    /// The joints of its line from one of which to another that reaches which a stab cuts anew, the first and the last at
    /// either end; `None` when there are none: only between joints its blade may be longer than what it cuts.
    fn fits(&self, line: &Line, [from, to]: [f64; 2]) -> Option<[[f64; 2]; 2]> {
        let joints = |station: f64| {
            let tube = 2.0 * (self.reference.tolerance + self.rounding);
            self.joints.near(line, Around { station, slack: BODY_STEP + tube, tube })
        };
        let ends = [joints(from)?, joints(to)?];
        (ends[0][0] < ends[1][1]).then_some(ends)
    }

    /// A stab that is longer than what it cuts leaves the line straight on; any other must lie on it with all of its blade.
    fn check_stab(&mut self, cut: &Cut, trial: &Trial, seen: &impl Fn(usize) -> Sighting) {
        let line = &self.reference.lines[trial.line];
        let width = self.knife.width_mm;
        let Some([from, to]) = trial.fits else {
            for (i, foot) in trial.feet.iter().enumerate().filter(|(i, _)| !trial.held.contains(i)) {
                self.on_path.see(foot.deviation, || seen(i));
            }
            let askew = angle::turn(self.plunge(cut, trial).chord(), cut.points[cut.body] - cut.points[0]);
            if width > 0.0 {
                self.heading.see(askew.abs().to_degrees(), || seen(cut.body));
            }
            return;
        };
        if width == 0.0 {
            return;
        }
        if from.into_iter().chain(to).all(f64::is_finite) {
            let blade = cut.points[cut.body] - cut.points[0];
            let with = trial.feet[cut.body].station >= trial.feet[0].station;
            let blade = if with { blade } else { -blade };
            let ends = from.into_iter().flat_map(|from| to.map(|to| [from, to])).filter(|[from, to]| from < to);
            let directions = ends.flat_map(|ends| heading::of_stab(line, ends, &self.joints));
            let askew = directions.map(|direction| angle::turn(direction, blade));
            let [least, greatest] =
                askew.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], turn| [a.min(turn), b.max(turn)]);
            // Overlaps that are shortened lie between none and whole ones, and so does the blade.
            self.heading.see(least.max(-greatest).max(0.0).to_degrees(), || seen(cut.body));
            return;
        }
        // Where the knife may have been lifted anywhere the blade lies between the directions of the chords that it cuts; the tube turns a blade by a little.
        let (first, last) = (trial.feet[*trial.held.start()].station, trial.feet[*trial.held.end()].station);
        let blade = (cut.points[cut.body] - cut.points[0]) * if last < first { -1.0 } else { 1.0 };
        let chords = line.chord_at(first.min(last))..=line.chord_at(first.max(last));
        let (mut turned, mut cone) = (0.0, [0.0_f64; 2]);
        for chord in chords.clone().skip(1) {
            turned += line.turn(chord);
            cone = [cone[0].min(turned), cone[1].max(turned)];
        }
        let askew = angle::turn(line.direction(*chords.start()), blade);
        let slack = (2.0 * (self.reference.tolerance + self.rounding) / width).atan();
        let beyond = (cone[0] - askew).max(askew - cone[1]) - slack;
        self.heading.see(beyond.to_degrees(), || seen(cut.body));
    }

    /// Nothing is cut twice but the overlaps, and what the blade of a stab is longer by than what was left.
    fn check_once(&mut self, cut: &Cut, trial: &Trial, seen: &impl Fn(usize) -> Sighting) {
        let mut twice = trial.stretches.iter().map(|[a, b]| b - a).sum::<f64>() - trial.fresh;
        if trial.fresh < self.reference.tolerance {
            // A stroke that cuts nothing new counts with its overlaps.
            twice += self.overlaps + self.knife.width_mm.max(REACH);
        } else if trial.fits.is_some() {
            twice -= self.knife.width_mm - trial.fresh;
        } else if self.joints.are_anywhere(&self.reference.lines[trial.line]) {
            // What the blade of a stab beside it was longer by.
            twice -= self.knife.width_mm;
        }
        self.once.see(twice, || seen(cut.body));
    }

    /// The line that a stroke was meant for: of those on which it cuts the most, but for overlaps and the surplus of the
    /// blade, which may lie on a neighbour, the one that its row names as the block being cut, else the one that it
    /// completes best. The name decides between equals only: what is cut is seen on the cloth.
    fn choose(&self, mut trials: Vec<Trial>, block: u32, coverage: &Coverage) -> Option<Trial> {
        let tolerance = self.reference.tolerance;
        for trial in &mut trials {
            trial.fresh = coverage.fresh(trial.line, &trial.stretches);
            let left = self.reference.lines[trial.line].length() - coverage.length(trial.line) - trial.fresh;
            trial.left = (left - 2.0 * tolerance).max(0.0);
        }
        let most = trials.iter().map(|trial| trial.fresh).fold(0.0, f64::max);
        trials.retain(|trial| trial.fresh >= tolerance.min(most));
        trials.retain(|trial| trial.fresh >= most - self.overlaps - self.knife.width_mm - 2.0 * tolerance);
        trials.into_iter().min_by(|a, b| {
            let named = |trial: &Trial| self.reference.lines[trial.line].blocks.contains(&block);
            let by_name = named(b).cmp(&named(a));
            by_name
                .then(a.left.total_cmp(&b.left))
                .then(b.fresh.total_cmp(&a.fresh))
                .then(a.worst.0.total_cmp(&b.worst.0))
                .then(a.line.cmp(&b.line))
        })
    }

    /// Where to begin following: the lines that pass near the stroke, the nearest first.
    fn candidates(&self, cut: &Cut) -> Vec<Candidate> {
        let count = cut.points.len();
        let tips = count - cut.body;
        let mut probes: Vec<usize> = [1, 2, 3].iter().map(|part| cut.body + (tips - 1) * part / 4).collect();
        if cut.body > 0 {
            // On a short line the tip may stand beyond its end all the time.
            probes.extend([0, 1, 2, 3].iter().map(|part| cut.body * part / 4));
        }
        let mut found: Vec<Candidate> = Vec::new();
        for probe in probes {
            let point = cut.points[probe];
            for (line, chord) in self.grid.near(point) {
                let (line, chord) = (line as usize, chord as usize);
                let foot = on_chord(&self.reference.lines[line], chord, point);
                let next =
                    Candidate { line, chord, probe, station: foot.station, away: foot.deviation.hypot(foot.beyond) };
                if next.away > REACH {
                    continue;
                }
                match found
                    .iter_mut()
                    .find(|known| known.line == line && next.continues(known, cut, &self.reference.lines[line]))
                {
                    Some(known) if next.away < known.away => *known = next,
                    Some(_) => {}
                    None => found.push(next),
                }
            }
        }
        found.sort_by(|a, b| a.away.total_cmp(&b.away).then(a.line.cmp(&b.line)).then(a.probe.cmp(&b.probe)));
        found.truncate(TRIALS);
        found
    }

    /// Follows a cut along a line, from where it was found both ways.
    fn follow(&self, cut: &Cut, &Candidate { line: index, chord, probe: from, .. }: &Candidate) -> Trial {
        let line = &self.reference.lines[index];
        let points = &cut.points;
        let ahead = points[(from + 1).min(points.len() - 1)] - points[from.saturating_sub(1)];
        let sign = if ahead.dot(&line.direction(chord)) < 0.0 { -1.0 } else { 1.0 };
        let mut forward = Follower::new(line, chord, points[from], sign);
        let mut backward = forward.turned();
        let mut feet = vec![forward.foot(); points.len()];
        for i in from + 1..points.len() {
            feet[i] = forward.step(points[i]);
        }
        for i in (0..from).rev() {
            feet[i] = backward.step(points[i]);
        }
        let length = line.length();
        let way = (feet[points.len() - 1].station - feet[cut.body].station).abs();
        // The blade of a stroke that goes all the way round lies behind its start, where the end comes by again.
        let laps = line.ring && way > length - self.knife.width_mm.min(0.5 * length);
        let first = if laps { cut.body } else { 0 };
        let allowed = self.reference.tolerance + self.rounding;
        let mut trial = Trial {
            line: index,
            feet,
            stretches: Vec::new(),
            fresh: 0.0,
            left: 0.0,
            worst: (0.0, cut.body),
            laps,
            held: first..=points.len() - 1,
            fits: None,
            hull: [0.0; 2],
        };
        let mut body = if laps { Body::default() } else { Body::new(line, cut, &trial.feet, allowed) };
        if body.sag > allowed && !self.may_bow(cut, line, &trial.feet) {
            body.sag = 0.0;
        }
        let off = |i: usize, foot: &Foot| if i < cut.body { body.off(i, foot) } else { foot.deviation };
        if cut.is_stab() {
            // A blade that never moves is often longer than what it cuts: what it is longer by leaves the line straight on,
            // at corners as at bends. That is overcut, not a bad way.
            let on: Vec<bool> = (0..points.len()).map(|i| i >= first && off(i, &trial.feet[i]) <= allowed).collect();
            if let Some(held) = longest(&on) {
                trial.held = held;
            }
        }
        let mut open: Option<[f64; 2]> = None;
        for i in first..points.len() {
            let foot = trial.feet[i];
            let off = off(i, &foot);
            if trial.held.contains(&i) {
                trial.note(off, i);
            }
            let mut joined = i > first && off <= allowed;
            if joined && i > cut.body {
                let skipped = skipped(line, points, &trial.feet, i);
                trial.note(skipped, i);
                joined = skipped <= allowed;
            }
            let station = foot.station;
            // A straight blade that leaves the line at a bend cuts up to the bend, which may lie between two places.
            let bend = if i > first && i <= cut.body {
                passed(line, &points[i - 1..=i], &trial.feet[i - 1..=i], allowed)
            } else {
                None
            };
            if let (Some([a, b]), false, Some([low, high])) = (&mut open, joined, bend) {
                (*a, *b) = (a.min(low), b.max(high));
            }
            if let (Some([a, b]), true) = (&mut open, joined) {
                (*a, *b) = (a.min(station), b.max(station));
            } else {
                trial.stretches.extend(open.take());
                let [low, high] = bend.unwrap_or([station; 2]);
                open = (off <= allowed).then_some([station.min(low), station.max(high)]);
            }
        }
        trial.stretches.extend(open);
        if let ([[a, b]], true) = (&mut trial.stretches[..], laps) {
            // The feet of one place may differ on both sides of a vertex.
            if (points[points.len() - 1] - points[cut.body]).norm() <= self.max_uncut {
                *b = b.max(*a + length);
            }
        }
        trial
    }

    /// Whether the path may bow away from a plunged blade: where a stroke begins at a joint, or a stab ends at one.
    fn may_bow(&self, cut: &Cut, line: &Line, feet: &[Foot]) -> bool {
        let slack = 2.0 * (self.reference.tolerance + self.rounding);
        let is_joint =
            |foot: &Foot| self.joints.near(line, Around { station: foot.station, slack, tube: 0.0 }).is_some();
        is_joint(&feet[0]) || cut.is_stab() && is_joint(&feet[cut.body])
    }

    /// The blade against its law, along the way of its tip; `trial` is the line that it cuts, if any.
    fn check_heading(&mut self, stroke: &Stroke, tips: &[Point], cut: (&Cut, Option<&Trial>)) {
        let lead = match cut {
            (_, None) => heading::ANY,
            (_, Some(trial)) if trial.laps => heading::NONE,
            (cut, Some(trial)) => self.plunge(cut, trial).lead(),
        };
        let fade = self.knife.width_mm.min(polyline::length(tips));
        Moving { rows: &stroke.rows, ways: &stroke.ways, tips, lead, fade, way_min: self.way_min }
            .check(&mut self.heading);
    }

    fn plunge(&self, cut: &Cut, trial: &Trial) -> Plunge<'_> {
        let (tail, tip) = (trial.feet[0], trial.feet[cut.body]);
        let last = trial.feet[cut.points.len() - 1];
        let line = &self.reference.lines[trial.line];
        let sign = if last.station < tail.station { -1.0 } else { 1.0 };
        Plunge { line, tail, tip, sign, tube: self.reference.tolerance + self.rounding + self.bulge }
    }

    /// Beyond the ends of its line a stroke cuts overlaps and what the blade is longer than a short line, or than what was
    /// left of it when it plunges only once, and no more.
    fn check_ends(&mut self, trial: &Trial, seen: &impl Fn(usize) -> Sighting) {
        let line = &self.reference.lines[trial.line];
        if line.ring {
            return;
        }
        let (start, end) = (line.points[0], line.points[line.points.len() - 1]);
        let farthest = line.points.iter().map(|point| (point - start).norm()).fold(0.0, f64::max);
        let width = self.knife.width_mm;
        let surplus = if trial.fits.is_some() {
            width - trial.fresh
        } else if farthest < width {
            width - (end - start).norm()
        } else {
            0.0
        };
        let allowed = self.overlap.max(surplus) + self.reference.tolerance;
        for (i, foot) in trial.feet.iter().enumerate() {
            self.stray.see(foot.beyond - allowed, || seen(i));
        }
    }

    /// The way of the tip from row to row against the greatest cap that holds anywhere on it.
    fn check_feed(&mut self, rows: &[Row], cut: &Cut, trial: Option<&Trial>) {
        let slack = self.reference.tolerance + CAP_ASIDE;
        let rounding = 4.0 * self.rounding / self.period;
        for (i, ends) in cut.points[cut.body..].windows(2).enumerate() {
            let cap = trial.map_or(self.knife.feed_mm_s.unwrap_or(f64::INFINITY), |trial| {
                let [a, b] = [0, 1].map(|k| trial.feet[cut.body + i + k].station);
                self.reference.lines[trial.line].cap([a.min(b) - slack, a.max(b) + slack], trial.sign(cut))
            });
            let speed = (ends[1] - ends[0]).norm() / self.period;
            self.feed.see_under(speed, cap + rounding, || rows[cut.rows[i + 1] - 1].sighting());
        }
    }

    /// How far the blade goes beyond the ends of its line, and into what.
    fn check_overcut(&mut self, cut: &Cut, trial: &Trial, seen: &impl Fn(usize) -> Sighting) {
        if trial.laps {
            return;
        }
        let Trial { feet, held, fits, hull, .. } = trial;
        let is_known = |ends: &[[f64; 2]; 2]| ends.iter().flatten().all(|station| station.is_finite());
        let fits = fits.map(|ends| if is_known(&ends) { ends } else { hull.map(|station| [station; 2]) });
        let stroke = overcut::Stroke { cut, feet, held, line: &self.reference.lines[trial.line], fits };
        self.overcut.see(&stroke, Lines { reference: self.reference, grid: &self.grid }, seen);
    }

    /// How far the path bows away from the plunged blade, and the tail leaves it while the blade moves.
    fn check_body(&mut self, rows: &[Row], cut: &Cut, trial: &Trial) {
        if self.knife.width_mm == 0.0 {
            return;
        }
        let line = &self.reference.lines[trial.line];
        for (i, foot) in trial.feet[..cut.body].iter().enumerate() {
            if foot.beyond == 0.0 && trial.held.contains(&i) {
                self.body.see(foot.deviation, || at(rows[0].t, cut.points[i], rows[0].block));
            }
        }
        let tail = |row: &Row| row.centre - row.along() * self.knife.back();
        let foot = trial.feet[0];
        let lap = if line.ring { (foot.station / line.length()).floor() * line.length() } else { 0.0 };
        let chord = line.chord_at(foot.station - lap);
        let with = trial.feet[cut.points.len() - 1].station >= foot.station;
        let mut follower = Follower::new(line, chord, tail(&rows[0]), if with { 1.0 } else { -1.0 });
        for row in rows {
            let foot = follower.step(tail(row));
            if foot.beyond == 0.0 {
                self.body.see(foot.deviation, || row.sighting());
            }
        }
    }
}

impl Trial {
    /// +1 when the tip goes with the line, -1 when it goes against it.
    fn sign(&self, cut: &Cut) -> f64 {
        if self.feet[cut.points.len() - 1].station < self.feet[cut.body].station { -1.0 } else { 1.0 }
    }

    fn note(&mut self, deviation: f64, place: usize) {
        if deviation > self.worst.0 {
            self.worst = (deviation, place);
        }
    }
}

/// How far the tip's way from place `i - 1` to place `i` passes by the vertices between their stations, mm.
fn skipped(line: &Line, points: &[Point], feet: &[Foot], i: usize) -> f64 {
    let (a, b) = (feet[i - 1].station, feet[i].station);
    let (low, high) = (a.min(b), a.max(b));
    // The tip bows between two rows: as a parabola does, by an eighth of the second difference of neighbouring rows.
    let bow = |k: usize| {
        if k == 0 || k + 1 >= points.len() {
            return 0.0;
        }
        ((points[k + 1] - points[k]) - (points[k] - points[k - 1])).norm() / 8.0
    };
    let away = |vertex: usize| polyline::distance_to_segment(line.points[vertex], points[i - 1], points[i]);
    line.vertices(low.next_up(), high.next_down()).map(away).fold(0.0, f64::max) - bow(i).max(bow(i - 1))
}

/// The stations of the first and the last vertex between two places of a straight blade that it cuts; `None` when there are
/// none.
fn passed(line: &Line, places: &[Point], feet: &[Foot], allowed: f64) -> Option<[f64; 2]> {
    let (a, b) = (feet[0].station, feet[1].station);
    let (low, high) = (a.min(b), a.max(b));
    let is_cut = |vertex: &usize| polyline::distance_to_segment(line.points[*vertex], places[0], places[1]) <= allowed;
    let lap = if line.ring { (low / line.length()).floor() * line.length() } else { 0.0 };
    let cut = line.vertices(low, high).filter(is_cut).map(|vertex| line.stations[vertex] + lap);
    cut.filter(|station| (low..=high).contains(station)).fold(None, |found, station| {
        Some(found.map_or([station; 2], |[first, last]: [f64; 2]| [first.min(station), last.max(station)]))
    })
}

/// The longest stretch of places that hold; the first of two alike.
fn longest(on: &[bool]) -> Option<RangeInclusive<usize>> {
    let mut best: Option<RangeInclusive<usize>> = None;
    let mut from = 0;
    for (i, &holds) in on.iter().enumerate() {
        if !holds {
            from = i + 1;
        } else if best.as_ref().is_none_or(|b| i - from > b.end() - b.start()) {
            best = Some(from..=i);
        }
    }
    best
}
