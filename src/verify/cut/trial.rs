//! Stroke followed along the nearby lines: the stretches that it cuts of each, and its deviation.

use std::ops::RangeInclusive;

use super::body::Cut;
use super::coverage::Coverage;
use super::covered::{Near, covered};
use super::follow::{Follower, Foot};
use super::heading::on_lap;
use super::passing::{longest, passed, skipped};
use super::plunged::Plunged;
use crate::geom::{Point, angle};
use crate::ir::declaration::{Kind, Which};
use crate::verify::declared::{Declared, Stretch};
use crate::verify::reference::grid::Grid;
use crate::verify::reference::line::{Chord, Line};
use crate::verify::reference::lines::Reference;

/// Greatest distance from a line at which a stroke still counts as a bad cut of it, mm.
pub(super) const REACH: f64 = 2.0;
/// Fraction of the tolerance by which a line that lies on a blade may be off it.
const ON_SHARE: f64 = 0.1;
/// Smallest cosine of the angle between a plunge cut and a line that it cuts (30 degrees); other lines it crosses.
const ALONG: f64 = 0.87;
/// Rounding of a station, mm.
const STATION_EPSILON: f64 = 1e-6;
/// Maximum number of lines tried for a stroke.
const TRIALS: usize = 8;

/// Place of a cut near a line.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    line: usize,
    chord: usize,
    /// Index of the point of the cut.
    probe: usize,
    /// Station on the line, mm.
    station: f64,
    /// Distance from the line, mm.
    away: f64,
}

impl Candidate {
    /// True if following the line from `other` passes here. On a line that ends at its own start, the heel lies at its end, and
    /// following from there leads nowhere.
    fn continues(&self, other: &Self, cut: &Cut, line: &Line) -> bool {
        let way = (cut.stations[self.probe] - cut.stations[other.probe]).abs();
        let apart = (self.station - other.station).abs();
        apart <= way + 2.0 * REACH || line.ring && line.length() - apart <= way + 2.0 * REACH
    }
}

impl Cut {
    /// Points of the tip at which nearby lines are searched.
    fn tip_probes(&self) -> [usize; 3] {
        let tips = self.points.len() - self.body;
        [1, 2, 3].map(|part| self.body + (tips - 1) * part / 4)
    }

    /// Points of the tip and some of the body: on a short line the tip may be beyond the end all the time.
    fn probes(&self) -> Vec<usize> {
        let mut probes = self.tip_probes().to_vec();
        // The probes of a tip that stands still coincide.
        probes.dedup();
        if self.body > 0 {
            probes.extend([0, 1, 2, 3].iter().map(|part| self.body * part / 4));
        }
        probes
    }
}

/// Stroke followed along one line.
pub(in crate::verify) struct Trial {
    pub(in crate::verify) line: usize,
    pub(in crate::verify) feet: Vec<Foot>,
    /// Station ranges that were cut.
    pub(in crate::verify) stretches: Vec<[f64; 2]>,
    /// Length of the stretches that was not cut before, mm.
    pub(in crate::verify) fresh: f64,
    /// Length of the stretches that a moving blade had cut before, mm.
    pub(in crate::verify) passed: f64,
    /// Stretches of the line that lie on a plunged blade itself; empty for a moving blade.
    pub(in crate::verify) thin: Vec<[f64; 2]>,
    /// Length of `thin` that no blade had passed or lain on before, mm.
    pub(in crate::verify) untouched: f64,
    /// Fraction of the line that is still uncut afterwards.
    left: f64,
    /// True if it cuts the whole remainder of the line.
    pub(in crate::verify) is_last: bool,
    /// Greatest deviation, mm, and the index of its place.
    pub(in crate::verify) worst: (f64, usize),
    /// True if it goes all the way around a closed line.
    pub(in crate::verify) laps: bool,
    /// Places on the line or on its straight extension; places before and after them go beyond the cut.
    pub(in crate::verify) held: RangeInclusive<usize>,
    /// Stations between which it cuts the line, starting at the heel.
    pub(in crate::verify) reach: [f64; 2],
    /// Range of stations, in the order of the line, without parts that lie only in the tolerance band beside a blade that does
    /// not move.
    pub(in crate::verify) core: [f64; 2],
    /// Position of the plunged blade over a curve; `None` if it lies on the line or the position is not permitted.
    pub(in crate::verify) over: Option<Plunged>,
}

/// Finds the lines near strokes and follows strokes along them.
pub(in crate::verify) struct Tracer<'a> {
    pub(in crate::verify) reference: &'a Reference<'a>,
    pub(in crate::verify) grid: &'a Grid,
    /// Deviations that the program declares; `None` for a program without declarations.
    pub(in crate::verify) declared: Option<&'a Declared>,
    /// Width of the blade, mm.
    pub(in crate::verify) width: f64,
    /// Greatest permitted deviation of a cut from its line, mm.
    pub(in crate::verify) allowed: f64,
    /// Longest stretch that may be left uncut, mm.
    pub(in crate::verify) max_uncut: f64,
    /// Greatest permitted angle between the blade and its line or path, rad.
    pub(in crate::verify) max_heading: f64,
    /// Length that a stroke may cut besides its line, mm: overlaps and the surplus of the blade.
    pub(in crate::verify) slack: f64,
}

/// Trials of a stroke along the line that its row names.
pub(in crate::verify) struct Trace {
    trials: Vec<Trial>,
    /// Block that its row names.
    block: u32,
}

impl Tracer<'_> {
    /// Follows a cut along the line with `block`; a plunge cut along all lines near it.
    pub(in crate::verify) fn trace(&self, cut: &Cut, block: u32) -> Trace {
        let trials = if cut.is_plunge_cut() {
            self.follow_all(cut, &self.about(cut, |line| self.is_named(line, block)), block)
        } else {
            self.follow_all(cut, &self.meant(cut, |line| self.is_named(line, block)), block)
        };
        Trace { trials, block }
    }

    /// Candidates among the lines that are `meant`. The tip almost always suffices; otherwise the whole blade is searched.
    fn meant(&self, cut: &Cut, meant: impl Fn(usize) -> bool) -> Vec<Candidate> {
        let of_tip = self.candidates(cut, &cut.tip_probes(), &meant);
        if of_tip.is_empty() { self.candidates(cut, &cut.probes(), &meant) } else { of_tip }
    }

    /// Candidates among all lines near a cut, and always those that are `meant`. A plunge cut may be entirely surplus, with its
    /// tip far from its line.
    fn about(&self, cut: &Cut, meant: impl Fn(usize) -> bool) -> Vec<Candidate> {
        let all = self.candidates(cut, &cut.probes(), |_| true);
        if all.len() < TRIALS {
            return all;
        }
        let mut candidates = self.meant(cut, meant);
        candidates.retain(|meant| all.iter().all(|other| other.line != meant.line));
        candidates.extend(all);
        candidates
    }

    fn is_named(&self, line: usize, block: u32) -> bool {
        self.reference.lines[line].has(block)
    }

    /// Line that a stroke was meant for. Candidates are the lines of which it cuts most, up to overlaps and the surplus of the
    /// blade, which may lie on a neighbour. Among them, the one that its row names comes first, then the one that it completes
    /// best. A line that a plunged blade only crosses, or lies askew to, is chosen only without an alternative. The name
    /// decides only between equals, since the cut is visible on the cloth.
    pub(in crate::verify) fn choose(&self, trace: &mut Trace, cut: &Cut, coverage: &Coverage) -> Option<Trial> {
        let tolerance = self.reference.tolerance;
        let mut trials = std::mem::take(&mut trace.trials);
        self.weigh(&mut trials, coverage);
        // If the named line accounts for nearly the whole cut, no other line can exceed it by much. That is the usual case, and
        // then the other lines need not be checked.
        let enough = tolerance.max(cut.length() - self.slack);
        if !cut.is_plunge_cut() && !trials.iter().any(|trial| trial.fresh >= enough) {
            // The named line is tried even if many others lie nearer.
            let candidates = self.candidates(cut, &cut.probes(), |_| true);
            trials.retain(|named| candidates.iter().all(|other| other.line != named.line));
            trials.extend(self.follow_all(cut, &candidates, trace.block));
            self.weigh(&mut trials, coverage);
        }
        // A plunge is meant for a line that its blade lies over, however little of it is uncut. Lines that it crosses count
        // only without such a line.
        if cut.is_plunge_cut() && trials.iter().any(|trial| self.lies_over(cut, trial)) {
            trials.retain(|trial| self.lies_over(cut, trial));
        }
        let most = trials.iter().map(|trial| trial.fresh).fold(0.0, f64::max);
        trials.retain(|trial| trial.fresh >= tolerance.min(most) || trial.is_last);
        trials.retain(|trial| trial.fresh >= most - self.slack);
        // A blade cuts along itself: if it lies along one line and askew to another, it cuts the first and only nicks the
        // second.
        let is_askew = |trial: &Trial| {
            cut.is_plunge_cut() && trial.askew(&self.reference.lines[trial.line], cut) > self.max_heading
        };
        trials.into_iter().min_by(|a, b| {
            let by_name = self.is_named(b.line, trace.block).cmp(&self.is_named(a.line, trace.block));
            by_name
                .then_with(|| is_askew(a).cmp(&is_askew(b)))
                .then(a.left.total_cmp(&b.left))
                .then(b.fresh.total_cmp(&a.fresh))
                .then(a.worst.0.total_cmp(&b.worst.0))
                .then(a.line.cmp(&b.line))
        })
    }

    /// Updates the fresh length of each trial and the remainder of its line.
    fn weigh(&self, trials: &mut [Trial], coverage: &Coverage) {
        for trial in trials {
            trial.fresh = coverage.fresh(trial.line, &trial.stretches);
            let uncut = self.reference.lines[trial.line].length() - coverage.length(trial.line);
            let left = (uncut - trial.fresh - 2.0 * self.reference.tolerance).max(0.0);
            trial.left = left / self.reference.lines[trial.line].length();
            trial.is_last = uncut > self.max_uncut && uncut - trial.fresh <= self.max_uncut;
        }
    }

    /// Starting places on the lines that are `meant` near some probes of the stroke, nearest first.
    fn candidates(&self, cut: &Cut, probes: &[usize], meant: impl Fn(usize) -> bool) -> Vec<Candidate> {
        let mut found: Vec<Candidate> = Vec::new();
        let add = |found: &mut Vec<Candidate>, next: Candidate| {
            let line = &self.reference.lines[next.line];
            let known = |known: &&mut Candidate| known.line == next.line && next.continues(known, cut, line);
            match found.iter_mut().find(known) {
                Some(known) if next.away < known.away => *known = next,
                Some(_) => {}
                None => found.push(next),
            }
        };
        // Runs of one line are adjacent.
        let mut last = (usize::MAX, false);
        for &probe in probes {
            let point = cut.points[probe];
            // Among the chords around a place, only the nearest is where the line passes it.
            let mut here: Vec<Candidate> = Vec::new();
            for run in self.grid.near(point, REACH) {
                if last.0 != run.line() {
                    let is_edge = self.reference.lines[run.line()].cut.is_edge;
                    last = (run.line(), !is_edge && meant(run.line()));
                }
                if !last.1 {
                    continue;
                }
                let line = &self.reference.lines[run.line()];
                for chord in run.chords().filter(|&chord| line.may_reach(chord, point, REACH)) {
                    let foot = line.chord(chord).foot(line, point);
                    let away = if foot.beyond > 0.0 { foot.deviation.hypot(foot.beyond) } else { foot.deviation };
                    if away <= REACH {
                        add(&mut here, Candidate { line: run.line(), chord, probe, station: foot.station, away });
                    }
                }
            }
            for next in here {
                add(&mut found, next);
            }
        }
        found.sort_by(|a, b| a.away.total_cmp(&b.away).then(a.line.cmp(&b.line)).then(a.probe.cmp(&b.probe)));
        found.truncate(TRIALS);
        found
    }

    /// Trials of a cut on its candidates. If a plunge cut lies over one of the lines, it is not followed along any.
    fn follow_all(&self, cut: &Cut, candidates: &[Candidate], block: u32) -> Vec<Trial> {
        let lay = |candidate| if cut.is_plunge_cut() && cut.body > 0 { self.lay(cut, candidate, block) } else { None };
        let lain: Vec<Option<Trial>> = candidates.iter().map(lay).collect();
        if lain.iter().flatten().any(|trial| self.lies_over(cut, trial)) {
            return lain.into_iter().flatten().collect();
        }
        let trials = lain.into_iter().zip(candidates);
        trials.map(|(lain, candidate)| lain.unwrap_or_else(|| self.go_along(cut, candidate))).collect()
    }

    /// True if a plunge cut cuts a part of a line without merely crossing it.
    fn lies_over(&self, cut: &Cut, trial: &Trial) -> bool {
        !trial.stretches.is_empty() && !trial.is_across(cut, &self.reference.lines[trial.line])
    }

    /// Follows a cut along a line in both directions from the candidate.
    fn go_along(&self, cut: &Cut, &Candidate { line: index, chord, probe: from, .. }: &Candidate) -> Trial {
        let line = &self.reference.lines[index];
        let points = &cut.points;
        let feet = feet(line, points, chord, from);
        let length = line.length();
        let way = (feet[points.len() - 1].station - feet[cut.body].station).abs();
        // On a stroke all the way around, the blade lies behind its start, where the end passes again.
        let laps = line.ring && way > length - self.width.min(0.5 * length);
        let first = if laps { cut.body } else { 0 };
        let allowed = self.allowed;
        let over = if laps { None } else { self.over(line, cut, &feet) };
        let off = |i: usize, foot: &Foot| if over.is_some_and(|over| over.spans(i)) { 0.0 } else { foot.deviation };
        let on: Vec<bool> = (0..points.len()).map(|i| i >= first && off(i, &feet[i]) <= allowed).collect();
        let held = held(&on, cut);
        let mut trial = Trial {
            line: index,
            reach: reach(&feet, &held),
            core: reach(&feet, &held),
            feet,
            stretches: Vec::new(),
            fresh: 0.0,
            passed: 0.0,
            thin: Vec::new(),
            untouched: 0.0,
            left: 0.0,
            is_last: false,
            worst: (0.0, cut.body),
            laps,
            held,
            over,
        };
        self.gather(&mut trial, cut, off);
        if let ([[a, b]], true) = (&mut trial.stretches[..], laps) {
            // The feet of one place may differ on both sides of a vertex.
            if (points[points.len() - 1] - points[cut.body]).norm() <= self.max_uncut {
                *b = b.max(*a + length);
            }
        }
        trial
    }

    /// Position of the plunged blade of a cut over a curve of its line; `None` if it lies on the line or the position is not
    /// permitted.
    fn over(&self, line: &Line, cut: &Cut, feet: &[Foot]) -> Option<Plunged> {
        let over = Plunged::new(line, cut, feet, self.allowed).filter(|over| over.sagitta > self.allowed)?;
        self.permits(&over, line, over.ends.map(|end| feet[end].station)).then_some(over)
    }

    /// True if a blade may lie over its line like that between two stations: at most as far off as a curve with the same turn,
    /// and as declared.
    fn permits(&self, over: &Plunged, line: &Line, stations: [f64; 2]) -> bool {
        let told = |declared: &Declared| declared.most(Kind::Plunge, Stretch { line, stations, end: None });
        let permitted = over.bound.min(self.declared.map_or(f64::INFINITY, told));
        over.sagitta <= permitted + self.allowed
    }

    /// Distances within which a plunge cut cuts a line.
    pub(super) fn near(&self) -> Near {
        let beyond = self.allowed - self.reference.tolerance;
        Near { reach: 2.0 * self.width + REACH, beside: self.allowed, beyond }
    }

    /// Lays a plunge cut over a line near a candidate; `None` if it is too far away to cut any of it. Of several stretches
    /// under the blade it is compared with the one that its row names, else with the longest.
    fn lay(&self, cut: &Cut, &Candidate { line: index, station, .. }: &Candidate, block: u32) -> Option<Trial> {
        let line = &self.reference.lines[index];
        let blade = cut.blade();
        let stretches = covered(line, blade, station, self.near());
        let whole = [stretches.first()?[0], stretches.last()?[1]];
        // In a hole narrower than the blade it also lies over places that it is not meant for.
        let named = |stretch: &[f64; 2]| line.length_named(block, *stretch);
        let main = stretches
            .iter()
            .copied()
            .max_by(|a, b| named(a).total_cmp(&named(b)).then((a[1] - a[0]).total_cmp(&(b[1] - b[0]))))?;
        // A blade covers a curve only if the curve is the whole line.
        let is_all = whole[1] - whole[0] >= line.length() - 2.0 * self.allowed;
        let lain = (stretches.len() > 1 && is_all).then(|| Lain::new(line, cut, whole)).and_then(|lain| {
            let ends = [*lain.held.start(), *lain.held.end()];
            let over = Plunged::over(line, cut, ends, whole, self.allowed);
            self.permits(&over, line, whole).then_some((lain, over))
        });
        let (lain, over) = lain.map_or_else(|| (Lain::new(line, cut, main), None), |(lain, over)| (lain, Some(over)));
        // Stretches where the line lies on the blade itself, from the first place to the last.
        let thin = Near { beside: self.near().beyond + ON_SHARE * self.reference.tolerance, ..self.near() };
        let [low, high] = if over.is_some() { whole } else { main };
        let mut on = covered(line, blade, station, thin);
        on.retain(|[a, b]| *a >= low && *b <= high);
        let core = on.iter().copied().reduce(|[a, _], [_, b]| [a, b]);
        let Lain { feet, held, reach } = lain;
        let mut trial = Trial {
            line: index,
            feet,
            stretches: if over.is_some() { vec![whole] } else { stretches },
            fresh: 0.0,
            passed: 0.0,
            thin: on,
            untouched: 0.0,
            left: 0.0,
            is_last: false,
            worst: (0.0, cut.body),
            laps: false,
            held,
            reach,
            core: core.unwrap_or(reach),
            over,
        };
        if over.is_none() {
            for i in trial.held.clone() {
                trial.note(trial.feet[i].deviation, i);
            }
        }
        Some(trial)
    }

    /// Collects the stretches of its line that a cut cuts, and its greatest deviation there; `off` returns the deviation of a
    /// place.
    fn gather(&self, trial: &mut Trial, cut: &Cut, off: impl Fn(usize, &Foot) -> f64) {
        let (line, points, allowed) = (&self.reference.lines[trial.line], &cut.points, self.allowed);
        let first = if trial.laps { cut.body } else { 0 };
        let mut open: Option<[f64; 2]> = None;
        for i in first..points.len() {
            let foot = trial.feet[i];
            let off = off(i, &foot);
            if trial.held.contains(&i) {
                trial.note(off, i);
            }
            let mut joined = i > first && off <= allowed;
            let is_over = trial.over.is_some_and(|over| over.ends[0] < i && i <= over.ends[1]);
            if joined && !is_over {
                let skipped = skipped(line, cut, &trial.feet, i, allowed);
                trial.note(skipped, i);
                joined = skipped <= allowed;
            }
            let station = foot.station;
            // A straight blade that leaves the line at a bend cuts up to the bend, which may lie between two places.
            let goes_on = joined && open.is_some();
            let bend = if i > first && i <= cut.body && !goes_on {
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
    }
}

/// Feet of the points of a cut on a line, followed in both directions from point `from`, which is near `chord`.
fn feet(line: &Line, points: &[Point], chord: usize, from: usize) -> Vec<Foot> {
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
    feet
}

/// Range of places that count as the cut of the line, given which places are `on` it: for a plunge cut the longest run of them;
/// for a moving blade everything from the first to the last, so that departures in between are seen.
fn held(on: &[bool], cut: &Cut) -> RangeInclusive<usize> {
    let all = 0..=on.len() - 1;
    if cut.is_plunge_cut() {
        return longest(on).unwrap_or(all);
    }
    let first = on[..=cut.body].iter().position(|&on| on).unwrap_or(cut.body);
    let last = on[cut.body..].iter().rposition(|&on| on).map_or(cut.body, |last| cut.body + last);
    first..=last
}

/// Stations between which the held places cut the line: those of the first and last place between its ends, or the ends of the
/// line just before and after them.
fn reach(feet: &[Foot], held: &RangeInclusive<usize>) -> [f64; 2] {
    let is_inner = |i: &usize| feet[*i].beyond == 0.0;
    let first = held.clone().find(is_inner).unwrap_or(*held.start());
    let last = held.clone().rev().find(is_inner).unwrap_or(*held.end());
    let led = |edge: usize, next: Option<usize>| {
        let next = next.and_then(|i| feet.get(i)).filter(|foot| foot.beyond > 0.0);
        next.unwrap_or(&feet[edge]).station
    };
    [led(first, first.checked_sub(1)), led(last, Some(last + 1))]
}

/// Plunge cut laid over a stretch of a line.
struct Lain {
    /// Feet of its points; points beyond the stretch have the station of its end.
    feet: Vec<Foot>,
    /// Range of points over the stretch.
    held: RangeInclusive<usize>,
    /// Stretch, starting at the heel.
    reach: [f64; 2],
}

impl Lain {
    fn new(line: &Line, cut: &Cut, [low, high]: [f64; 2]) -> Self {
        let heel = cut.points[0];
        let axis = (cut.points[cut.body] - heel).normalize();
        let way = |station: f64| (line.place(on_lap(line, station)) - heel).dot(&axis);
        let is_turned = way(low) > way(high);
        let [first, last] = if is_turned { [high, low] } else { [low, high] };
        let (from, to) = (way(first), way(last));
        let laps_before = if line.ring { (low / line.length()).floor() } else { 0.0 };
        let lap =
            |chord: usize| if line.ring { (laps_before + (chord / line.chords()) as f64) * line.length() } else { 0.0 };
        let under: Vec<(Chord, f64)> =
            line.chords_between([low, high]).map(|i| (line.chord(i % line.chords()), lap(i))).collect();
        let foot = |&point: &Point| {
            let along = (point - heel).dot(&axis);
            let beyond = (from - along).max(along - to).max(0.0);
            let end = if along < from { first } else { last };
            if beyond > 0.0 {
                return Foot { station: end, deviation: 0.0, beyond, chord: line.chord_at(on_lap(line, end)) };
            }
            let feet = under.iter().map(|(chord, lap)| {
                let (deviation, station) = chord.deviation(point);
                Foot { station: (station + lap).clamp(low, high), deviation, beyond: 0.0, chord: chord.index }
            });
            let nearest = feet.min_by(|a, b| a.deviation.total_cmp(&b.deviation));
            nearest.expect("a stretch has a chord")
        };
        let feet: Vec<Foot> = cut.points.iter().map(foot).collect();
        let is_over = |i: &usize| feet[*i].beyond == 0.0;
        let nearest = || (0..=cut.body).min_by(|&a, &b| feet[a].beyond.total_cmp(&feet[b].beyond)).unwrap_or(0);
        let first_over = (0..=cut.body).find(is_over).unwrap_or_else(nearest);
        let last_over = (first_over..=cut.body).rev().find(is_over).unwrap_or(first_over);
        Self { feet, held: first_over..=last_over, reach: [first, last] }
    }
}

impl Trial {
    /// Angle between the blade and the line under it, rad; 0 if the blade lies between the directions of the chords there.
    pub(super) fn askew(&self, line: &Line, cut: &Cut) -> f64 {
        let [first, last] = self.reach;
        let blade = (cut.points[cut.body] - cut.points[0]) * if last < first { -1.0 } else { 1.0 };
        // Chords that only touch the cut at its ends are left out.
        let (low, high) = (first.min(last), first.max(last));
        let aside = STATION_EPSILON.min(0.25 * (high - low));
        let chords = line.chords_between([low + aside, high - aside]);
        let (mut turned, mut cone) = (0.0, [0.0_f64; 2]);
        for chord in chords.clone().skip(1) {
            turned += line.turn(chord % line.chords());
            cone = [cone[0].min(turned), cone[1].max(turned)];
        }
        let askew = angle::turn(line.direction(*chords.start() % line.chords()), blade);
        (cone[0] - askew).max(askew - cone[1]).max(0.0)
    }

    /// Direction of the tip: +1 with the line, -1 against it.
    pub(in crate::verify) fn sign(&self, cut: &Cut) -> f64 {
        if self.feet[cut.points.len() - 1].station < self.feet[cut.body].station { -1.0 } else { 1.0 }
    }

    /// Distance of place `i` beyond an end of the line or beyond the held places, mm.
    pub(in crate::verify) fn beyond(&self, cut: &Cut, i: usize) -> f64 {
        if self.held.contains(&i) || cut.is_plunge_cut() && cut.body > 0 {
            return self.feet[i].beyond;
        }
        let edge = i.clamp(*self.held.start(), *self.held.end());
        self.feet[i].beyond.max((cut.points[i] - cut.points[edge]).norm() + self.feet[edge].beyond)
    }

    /// Places beyond an end of the line or beyond the held places, each with its distance, mm.
    pub(super) fn outer(&self, cut: &Cut) -> Vec<(usize, f64)> {
        let places = (0..cut.points.len()).map(|i| (i, self.beyond(cut, i)));
        places.filter(|(_, beyond)| *beyond > 0.0).collect()
    }

    /// End of the stroke at which a place is.
    pub(super) fn end_at(&self, place: usize) -> Which {
        if place <= *self.held.start() { Which::Start } else { Which::End }
    }

    /// True if the blade of a plunge cut stands across everything that it cuts of its line.
    fn is_across(&self, cut: &Cut, line: &Line) -> bool {
        let blade = cut.blade().map(|end| end.coords);
        let along = (blade[1] - blade[0]).normalize();
        let mut chords = self.stretches.iter().flat_map(|&stretch| line.chords_between(stretch));
        chords.all(|chord| line.direction(chord % line.chords()).dot(&along).abs() < ALONG)
    }

    fn note(&mut self, deviation: f64, place: usize) {
        if deviation > self.worst.0 {
            self.worst = (deviation, place);
        }
    }
}
