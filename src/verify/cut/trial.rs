//! A stroke followed along the lines near it: what it cuts of each, and how far off it is there.

use std::ops::RangeInclusive;

use super::body::{Body, Cut};
use super::coverage::Coverage;
use super::covered::Covered;
use super::follow::{Follower, Foot};
use super::joints::{Around, Joints};
use super::passing::{longest, passed, skipped};
use crate::geom::Point;
use crate::verify::reference::grid::Grid;
use crate::verify::reference::line::Line;
use crate::verify::reference::lines::Reference;

/// How far from a line a stroke may lie and still be taken for a bad cut of it, mm.
pub(super) const REACH: f64 = 2.0;
/// Lines that a stroke is tried on, at the most.
const TRIALS: usize = 8;

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
        let way = (cut.stations[self.probe] - cut.stations[other.probe]).abs();
        let apart = (self.station - other.station).abs();
        apart <= way + 2.0 * REACH || line.ring && line.length() - apart <= way + 2.0 * REACH
    }
}

impl Cut {
    /// Places of the tip that are looked at to find the lines near it.
    fn tip_probes(&self) -> [usize; 3] {
        let tips = self.points.len() - self.body;
        [1, 2, 3].map(|part| self.body + (tips - 1) * part / 4)
    }

    /// The same, and some of the body: on a short line the tip may stand beyond its end all the time.
    fn probes(&self) -> Vec<usize> {
        let mut probes = self.tip_probes().to_vec();
        if self.body > 0 {
            probes.extend([0, 1, 2, 3].iter().map(|part| self.body * part / 4));
        }
        probes
    }
}

/// A stroke followed along one line.
pub(in crate::verify) struct Trial {
    pub(in crate::verify) line: usize,
    pub(in crate::verify) feet: Vec<Foot>,
    /// Stations that were cut.
    pub(in crate::verify) stretches: Vec<[f64; 2]>,
    /// How much of them was not cut before, mm.
    pub(in crate::verify) fresh: f64,
    /// How much of the line is then still uncut, mm.
    left: f64,
    /// Greatest deviation, mm, and the index of its place.
    pub(in crate::verify) worst: (f64, usize),
    /// Whether it goes all the way round a closed line.
    pub(in crate::verify) laps: bool,
    /// The places that are held to the line: of a plunge cut its longest stretch on it; its surplus lies before and behind.
    pub(in crate::verify) held: RangeInclusive<usize>,
    /// The joints between which it is a plunge cut that fits what was left of its line: its blade may then be longer.
    pub(in crate::verify) fits: Option<[[f64; 2]; 2]>,
    /// Its line, when that is a curve which could be nibbled and this one plunge covers.
    pub(in crate::verify) covered: Option<Covered>,
    /// From where to where it cuts what was not cut before.
    pub(in crate::verify) hull: [f64; 2],
}

/// Finds the lines near strokes, and follows strokes along them.
pub(in crate::verify) struct Tracer<'a> {
    pub(in crate::verify) reference: &'a Reference<'a>,
    pub(in crate::verify) grid: &'a Grid,
    pub(in crate::verify) joints: Joints,
    /// Width of the blade, mm.
    pub(in crate::verify) width: f64,
    /// How far a cut may be off its line, mm.
    pub(in crate::verify) allowed: f64,
    /// Longest stretch that may be left uncut, mm.
    pub(in crate::verify) max_uncut: f64,
    /// How much a stroke may cut that is not of its line, mm: overlaps, and the surplus of the blade.
    pub(in crate::verify) slack: f64,
}

/// A stroke followed along the line that its row names.
pub(in crate::verify) struct Trace {
    trials: Vec<Trial>,
    /// The block that its row names.
    block: u32,
}

impl Tracer<'_> {
    /// Follows a cut along the line that has `block`. Nearly always the tip shows where; if it does not, the blade may.
    pub(in crate::verify) fn trace(&self, cut: &Cut, block: u32) -> Trace {
        let named = |probes: &[usize]| self.candidates(cut, probes, |line| self.is_named(line, block));
        let mut candidates = named(&cut.tip_probes());
        if candidates.is_empty() {
            candidates = named(&cut.probes());
        }
        Trace { trials: candidates.iter().map(|candidate| self.follow(cut, candidate)).collect(), block }
    }

    fn is_named(&self, line: usize, block: u32) -> bool {
        self.reference.lines[line].has(block)
    }

    /// The line that a stroke was meant for: of those on which it cuts the most, but for overlaps and the surplus of the
    /// blade, which may lie on a neighbour, the one that its row names as the block being cut, else the one that it
    /// completes best. The name decides between equals only: what is cut is seen on the cloth.
    pub(in crate::verify) fn choose(&self, trace: &mut Trace, cut: &Cut, coverage: &Coverage) -> Option<Trial> {
        let tolerance = self.reference.tolerance;
        let mut trials = std::mem::take(&mut trace.trials);
        self.weigh(&mut trials, coverage);
        // What a stroke cuts of the line that it names cannot be much exceeded by what it cuts of another when it is about
        // all that it cuts: nearly always, and then the others need not be looked at.
        let enough = tolerance.max(cut.length() - self.slack);
        if !trials.iter().any(|trial| trial.fresh >= enough) {
            let candidates = self.candidates(cut, &cut.probes(), |_| true);
            trials = candidates.iter().map(|candidate| self.follow(cut, candidate)).collect();
            self.weigh(&mut trials, coverage);
        }
        let most = trials.iter().map(|trial| trial.fresh).fold(0.0, f64::max);
        trials.retain(|trial| trial.fresh >= tolerance.min(most));
        trials.retain(|trial| trial.fresh >= most - self.slack);
        trials.into_iter().min_by(|a, b| {
            let by_name = self.is_named(b.line, trace.block).cmp(&self.is_named(a.line, trace.block));
            by_name
                .then(a.left.total_cmp(&b.left))
                .then(b.fresh.total_cmp(&a.fresh))
                .then(a.worst.0.total_cmp(&b.worst.0))
                .then(a.line.cmp(&b.line))
        })
    }

    /// How much of what trials cut was not cut before, and what that leaves.
    fn weigh(&self, trials: &mut [Trial], coverage: &Coverage) {
        for trial in trials {
            trial.fresh = coverage.fresh(trial.line, &trial.stretches);
            let left = self.reference.lines[trial.line].length() - coverage.length(trial.line) - trial.fresh;
            trial.left = (left - 2.0 * self.reference.tolerance).max(0.0);
        }
    }

    /// Where to begin following: the lines `meant` that pass near some places of the stroke, the nearest first.
    fn candidates(&self, cut: &Cut, probes: &[usize], meant: impl Fn(usize) -> bool) -> Vec<Candidate> {
        let mut found: Vec<Candidate> = Vec::new();
        // Runs of one line come one after the other.
        let mut last = (usize::MAX, false);
        for &probe in probes {
            let point = cut.points[probe];
            for run in self.grid.near(point, REACH) {
                if last.0 != run.line() {
                    last = (run.line(), meant(run.line()));
                }
                if !last.1 {
                    continue;
                }
                let line = &self.reference.lines[run.line()];
                for chord in run.chords().filter(|&chord| line.may_reach(chord, point, REACH)) {
                    let foot = line.chord(chord).foot(line, point);
                    let away = if foot.beyond > 0.0 { foot.deviation.hypot(foot.beyond) } else { foot.deviation };
                    if away > REACH {
                        continue;
                    }
                    let next = Candidate { line: run.line(), chord, probe, station: foot.station, away };
                    let known = |known: &&mut Candidate| known.line == next.line && next.continues(known, cut, line);
                    match found.iter_mut().find(known) {
                        Some(known) if next.away < known.away => *known = next,
                        Some(_) => {}
                        None => found.push(next),
                    }
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
        let feet = feet(line, points, chord, from);
        let length = line.length();
        let way = (feet[points.len() - 1].station - feet[cut.body].station).abs();
        // The blade of a stroke that goes all the way round lies behind its start, where the end comes by again.
        let laps = line.ring && way > length - self.width.min(0.5 * length);
        let first = if laps { cut.body } else { 0 };
        let allowed = self.allowed;
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
            covered: None,
            hull: [0.0; 2],
        };
        let ends = [0, cut.body].map(|end| trial.feet[end].station);
        let is_nibble = cut.is_plunge_cut() && !laps && ends.iter().any(|&station| line.is_nibbled(station));
        if let Some(covered) = Covered::new(line, cut, allowed).filter(|_| is_nibble) {
            let is_on = |&i: &usize| trial.feet[i].beyond == 0.0;
            if let (Some(first), Some(last)) = ((0..points.len()).find(is_on), (0..points.len()).rev().find(is_on)) {
                (trial.held, trial.stretches, trial.covered) = (first..=last, vec![[0.0, length]], Some(covered));
                return trial;
            }
        }
        let body = if laps { Body::default() } else { self.body(line, cut, &trial.feet, is_nibble) };
        let off = |i: usize, foot: &Foot| if i < cut.body { body.off(i, foot) } else { foot.deviation };
        if cut.is_plunge_cut() {
            // A blade that never moves is often longer than what it cuts: what it is longer by leaves the line straight on,
            // at corners as at bends. That is overcut, not a bad way.
            let on: Vec<bool> = (0..points.len()).map(|i| i >= first && off(i, &trial.feet[i]) <= allowed).collect();
            if let Some(held) = longest(&on) {
                trial.held = held;
            }
        }
        self.gather(&mut trial, cut, off);
        if let ([[a, b]], true) = (&mut trial.stretches[..], laps) {
            // The feet of one place may differ on both sides of a vertex.
            if (points[points.len() - 1] - points[cut.body]).norm() <= self.max_uncut {
                *b = b.max(*a + length);
            }
        }
        trial
    }

    /// The plunged blade of a cut as a chord of its line, or as none where it could have been laid nearer.
    fn body(&self, line: &Line, cut: &Cut, feet: &[Foot], is_nibble: bool) -> Body {
        let allowed = self.allowed;
        let mut body = Body::new(line, cut, feet, allowed);
        if !is_nibble && body.sag <= allowed {
            return body;
        }
        let around = |end: usize| Around { station: feet[end].station, slack: 2.0 * allowed, band: 0.0 };
        let permitted = self.joints.permitted_deviation(line, body.ends.map(around), cut);
        if is_nibble && permitted == 0.0 {
            // What nibbles is within the tolerance of what it cuts.
            Body::default()
        } else {
            if body.sag > permitted + allowed {
                body.sag = 0.0;
            }
            body
        }
    }

    /// Gathers the stretches of its line that a cut cuts, and how far it is off it there; `off` tells how far a place is.
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
            if joined && i > cut.body {
                let skipped = skipped(line, cut, &trial.feet, i);
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

/// Where the places of a cut stand beside a line: followed both ways from one of them, which is near a chord.
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

impl Trial {
    /// +1 when the tip goes with the line, -1 when it goes against it.
    pub(in crate::verify) fn sign(&self, cut: &Cut) -> f64 {
        if self.feet[cut.points.len() - 1].station < self.feet[cut.body].station { -1.0 } else { 1.0 }
    }

    /// Those of its stretches that are held to the line: a blade's surplus may cross it once more.
    pub(in crate::verify) fn held_stretches(&self) -> Vec<[f64; 2]> {
        let [a, b] = [*self.held.start(), *self.held.end()].map(|i| self.feet[i].station);
        let is_held = |[low, high]: &[f64; 2]| *low <= a.max(b) && *high >= a.min(b);
        self.stretches.iter().copied().filter(is_held).collect()
    }

    fn note(&mut self, deviation: f64, place: usize) {
        if deviation > self.worst.0 {
            self.worst = (deviation, place);
        }
    }
}
