//! One stroke of the knife, from its plunge to its lift: what it cut, and how the blade lay.
//!
//! What a stroke cuts is the blade's body where it plunges, then the track of the tip. Both are followed along the line
//! of the reference that they belong to. Under the tangent law the blade lies along the tip's way; after a plunge as a
//! chord it fades from the chord to the tangent over the next blade width, by the step of degree 7.

use super::coverage::Coverage;
use super::follow::{Follower, Foot, on_chord};
use super::grid::Grid;
use super::inside::Inside;
use super::read::{ROUNDING, Row};
use super::reference::{Line, Reference};
use super::worst::{Worst, at};
use crate::geom::{Point, angle, polyline};
use crate::ir::Finding;
use crate::ir::finding::Sighting;
use crate::machine::{Knife, MachineProfile};

/// Distance of two places at which the body of a plunged blade is looked at, mm.
const BODY_STEP: f64 = 0.25;
/// How far from a line a stroke may lie and still be taken for a bad cut of it, mm.
const REACH: f64 = 2.0;
/// Lines that a stroke is tried on, at the most.
const TRIALS: usize = 8;
/// Least way of the tip between two rows that shows a direction, mm: its rounding is then below 0.01 degrees.
const WAY_MIN: f64 = 0.02;
/// Rounding of a tip's place, mm.
const PLACE_ROUNDING: f64 = 4.0 * ROUNDING;

/// The rows of a stroke.
#[derive(Debug, Default)]
pub(super) struct Stroke {
    rows: Vec<Row>,
}

impl Stroke {
    pub(super) fn push(&mut self, row: &Row) {
        self.rows.push(*row);
    }

    pub(super) fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    pub(super) fn clear(&mut self) {
        self.rows.clear();
    }
}

/// Judges strokes.
pub(super) struct Judge<'a> {
    reference: &'a Reference<'a>,
    knife: &'a Knife,
    period: f64,
    grid: Grid,
    inside: Inside,
    overlaps: f64,
    table: [Option<[f64; 2]>; 2],
    on_path: Worst,
    stray: Worst,
    once: Worst,
    heading: Worst,
    body: Worst,
    feed: Worst,
    off_table: Worst,
    overcut: [Worst; 3],
}

/// A stroke followed along one line.
struct Trial {
    line: usize,
    feet: Vec<Foot>,
    /// Stations that were cut.
    stretches: Vec<[f64; 2]>,
    fresh: f64,
    /// Greatest deviation, mm, and the index of its place.
    worst: (f64, usize),
}

/// What a stroke cuts: the body's places, then the tip's.
struct Cut {
    points: Vec<Point>,
    /// Number of places of the body.
    body: usize,
    /// The row of each place of the tip.
    rows: Vec<usize>,
}

impl<'a> Judge<'a> {
    pub(super) fn new(reference: &'a Reference, profile: &'a MachineProfile) -> Self {
        let knife = &profile.knife;
        let verify = &profile.verify;
        let front = knife.front_overlap_mm.max(knife.corner_front_overlap_mm);
        let heel = knife.heel_overlap_mm.max(knife.corner_heel_overlap_mm);
        let overlaps = front + heel;
        let tolerance = reference.tolerance;
        let period = profile.time.period();
        let feed = knife.feed_mm_s.map(|feed| feed + 4.0 * PLACE_ROUNDING / period);
        let strict = profile.table.strict;
        Self {
            reference,
            knife,
            period,
            grid: Grid::new(reference),
            inside: Inside::new(reference.marker),
            overlaps,
            table: [profile.table.x_mm, profile.table.y_mm],
            on_path: Worst::new("verify/on-path", "mm", Some(tolerance + PLACE_ROUNDING)),
            stray: Worst::new("verify/stray", "mm", Some(0.0)),
            // The surplus of a stab, or the body that plunges into a ring, lies over what is cut from the other side.
            once: Worst::new("verify/once", "mm", Some(overlaps + knife.width_mm + 2.0 * tolerance)),
            heading: Worst::new("verify/heading", "deg", Some(verify.max_heading_deg)),
            body: Worst::new("verify/body", "mm", verify.max_body_mm),
            feed: Worst::new("verify/feed", "mm/s", feed),
            off_table: Worst::new("verify/table", "mm", strict.then_some(PLACE_ROUNDING)),
            overcut: [
                Worst::new("verify/overcut-part", "mm", verify.max_overcut_part_mm),
                Worst::new("verify/overcut-neighbour", "mm", verify.max_overcut_neighbour_mm),
                Worst::new("verify/overcut-waste", "mm", verify.max_overcut_waste_mm),
            ],
        }
    }

    pub(super) fn findings(self) -> Vec<Finding> {
        let one = [self.on_path, self.stray, self.once, self.heading, self.body, self.feed, self.off_table];
        one.into_iter().chain(self.overcut).map(Worst::finding).collect()
    }

    /// Judges one stroke and marks what it cut.
    pub(super) fn judge(&mut self, stroke: &Stroke, coverage: &mut Coverage) {
        let rows = &stroke.rows;
        let tips: Vec<Point> = rows.iter().map(|row| row.centre + row.along() * self.knife.radius()).collect();
        self.check_heading(rows, &tips);
        self.check_feed(rows, &tips);
        self.check_table(rows);
        let cut = self.cut(rows, &tips);
        let trial =
            self.candidates(&cut).into_iter().map(|(line, chord, at)| self.follow(&cut, line, chord, at, coverage));
        let best = trial.max_by(|a, b| a.fresh.total_cmp(&b.fresh).then(b.worst.0.total_cmp(&a.worst.0)));
        let seen = |i: usize| {
            let row = &rows[cut.rows[i.saturating_sub(cut.body)]];
            at(row.t, cut.points[i], row.block)
        };
        let Some(best) = best else {
            self.stray.see(polyline::length(&cut.points).max(self.knife.width_mm).max(REACH), || seen(cut.body));
            return;
        };
        self.on_path.see(best.worst.0, || seen(best.worst.1));
        let length: f64 = best.stretches.iter().map(|[a, b]| b - a).sum();
        let mut twice = length - best.fresh;
        if best.fresh < self.reference.tolerance {
            // A stroke that cuts nothing new counts with its overlaps.
            twice += self.overlaps + self.knife.width_mm.max(REACH);
        }
        self.once.see(twice, || seen(cut.body));
        coverage.add(best.line, &best.stretches);
        self.check_overcut(&cut, &best, &seen);
        self.check_body(rows, &cut, &best);
    }

    fn cut(&self, rows: &[Row], tips: &[Point]) -> Cut {
        let steps = (self.knife.width_mm / BODY_STEP).ceil() as usize;
        let tail = rows[0].centre - rows[0].along() * self.knife.back();
        let body = (0..steps).map(|i| tail + (tips[0] - tail) * (i as f64 / steps as f64));
        let mut points: Vec<Point> = body.collect();
        // Rest rows repeat their place; a track of places that differ is enough.
        let moves: Vec<usize> = (0..tips.len()).filter(|&i| i == 0 || tips[i] != tips[i - 1]).collect();
        points.extend(moves.iter().map(|&i| tips[i]));
        Cut { points, body: steps, rows: moves }
    }

    /// Lines that pass near the stroke: line, chord, and the place of the cut that is near it.
    fn candidates(&self, cut: &Cut) -> Vec<(usize, usize, usize)> {
        let count = cut.points.len();
        let tips = count - cut.body;
        let mut probes: Vec<usize> = [1, 2, 3].iter().map(|part| cut.body + (tips - 1) * part / 4).collect();
        if tips < 4 {
            probes.extend([1, 2, 3].iter().map(|part| (count - 1) * part / 4));
        }
        let mut found: Vec<(usize, usize, usize, f64)> = Vec::new();
        for probe in probes {
            let point = cut.points[probe];
            for (line, chord) in self.grid.near(point) {
                let (line, chord) = (line as usize, chord as usize);
                let foot = on_chord(&self.reference.lines[line], chord, point);
                let away = foot.deviation.hypot(foot.beyond);
                if away > REACH {
                    continue;
                }
                match found.iter_mut().find(|f| f.0 == line) {
                    Some(best) if away < best.3 => *best = (line, chord, probe, away),
                    Some(_) => {}
                    None => found.push((line, chord, probe, away)),
                }
            }
        }
        found.sort_by(|a, b| a.3.total_cmp(&b.3).then(a.0.cmp(&b.0)));
        found.truncate(TRIALS);
        found.into_iter().map(|(line, chord, probe, _)| (line, chord, probe)).collect()
    }

    /// Follows a cut along a line, from the place `from` beside chord `chord` both ways.
    fn follow(&self, cut: &Cut, index: usize, chord: usize, from: usize, coverage: &Coverage) -> Trial {
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
        let sag = if cut.body > 0 { plunge_sag(line, &feet[..=cut.body], self.knife.width_mm) } else { 0.0 };
        let allowed = self.reference.tolerance + PLACE_ROUNDING;
        let mut trial = Trial { line: index, feet, stretches: Vec::new(), fresh: 0.0, worst: (0.0, cut.body) };
        let mut open: Option<[f64; 2]> = None;
        for i in 0..points.len() {
            let in_body = i < cut.body;
            let off = (trial.feet[i].deviation - if in_body { sag } else { 0.0 }).max(0.0);
            // Into a ring the blade may plunge along the tangent: its body then cuts beside the line, which is reported.
            if !(in_body && line.ring) {
                trial.note(off, i);
            }
            let mut joined = i > 0 && off <= allowed;
            if joined && i > cut.body {
                let skipped = skipped(line, points, &trial.feet, i);
                trial.note(skipped, i);
                joined = skipped <= allowed;
            }
            let station = trial.feet[i].station;
            match (&mut open, joined) {
                (Some([a, b]), true) => (*a, *b) = (a.min(station), b.max(station)),
                (_, false) => {
                    trial.stretches.extend(open.take());
                    open = (off <= allowed).then_some([station; 2]);
                }
                (None, true) => open = Some([station; 2]),
            }
        }
        trial.stretches.extend(open);
        trial.fresh = coverage.fresh(index, &trial.stretches);
        trial
    }

    /// The blade against its law while the tip moves.
    fn check_heading(&mut self, rows: &[Row], tips: &[Point]) {
        let total = polyline::length(tips);
        let fade = self.knife.width_mm.min(total);
        let mut lead = None;
        let mut way = 0.0;
        for i in 1..rows.len().saturating_sub(1) {
            way += (tips[i] - tips[i - 1]).norm();
            let along = tips[i + 1] - tips[i - 1];
            if along.norm() < WAY_MIN {
                continue;
            }
            let ahead = angle::wrap(along.y.atan2(along.x) - rows[i].c_deg.to_radians());
            let lead = *lead.get_or_insert(ahead);
            let expected = if way < fade { lead * fading(way / fade) } else { 0.0 };
            self.heading.see(angle::wrap(ahead - expected).abs().to_degrees(), || rows[i].sighting());
        }
    }

    fn check_feed(&mut self, rows: &[Row], tips: &[Point]) {
        for (row, ends) in rows.iter().zip(tips.windows(2)) {
            self.feed.see((ends[1] - ends[0]).norm() / self.period, || row.sighting());
        }
    }

    fn check_table(&mut self, rows: &[Row]) {
        for row in rows {
            let along = row.along();
            for point in [row.centre + along * self.knife.radius(), row.centre - along * self.knife.back()] {
                for (value, range) in [point.x, point.y].into_iter().zip(self.table) {
                    if let Some([least, most]) = range {
                        self.off_table.see((least - value).max(value - most), || row.sighting());
                    }
                }
            }
        }
    }

    /// How far the blade goes beyond the ends of its line, and into what.
    fn check_overcut(&mut self, cut: &Cut, trial: &Trial, seen: &impl Fn(usize) -> Sighting) {
        let line = &self.reference.lines[trial.line];
        if line.ring {
            return;
        }
        for (i, foot) in trial.feet.iter().enumerate() {
            if foot.beyond <= PLACE_ROUNDING {
                continue;
            }
            let pieces = self.inside.pieces_at(cut.points[i]);
            let into = if pieces.contains(&line.piece) {
                0
            } else if pieces.is_empty() {
                2
            } else {
                1
            };
            self.overcut[into].see(foot.beyond, || seen(i));
        }
    }

    /// How far the tail leaves the line while the blade moves.
    fn check_body(&mut self, rows: &[Row], cut: &Cut, trial: &Trial) {
        if self.knife.width_mm == 0.0 {
            return;
        }
        let line = &self.reference.lines[trial.line];
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
    fn note(&mut self, deviation: f64, place: usize) {
        if deviation > self.worst.0 {
            self.worst = (deviation, place);
        }
    }
}

/// By how much the path may bow away from the body of a plunged blade: w^2 k / 8, with k the mean curvature under it.
fn plunge_sag(line: &Line, feet: &[Foot], width: f64) -> f64 {
    let stations = feet.iter().map(|f| f.station);
    let (low, high) = (stations.clone().fold(f64::INFINITY, f64::min), stations.fold(0.0, f64::max));
    // The chord that is being left counts, too: a curve turns along its chords, not at its vertices.
    let (first, last) = (line.chord_at(low), (line.chord_at(high) + 1).min(line.chords() - 1));
    let turned: f64 =
        (first..last).map(|chord| angle::turn(line.direction(chord), line.direction(chord + 1)).abs()).sum();
    width * turned / 8.0
}

/// How far the tip's way from place `i - 1` to place `i` passes by the vertices between their stations, mm.
fn skipped(line: &Line, points: &[Point], feet: &[Foot], i: usize) -> f64 {
    let (a, b) = (feet[i - 1].station, feet[i].station);
    let (low, high) = (a.min(b), a.max(b));
    let length = line.length();
    let lap = if line.ring { (low / length).floor() * length } else { 0.0 };
    let mut vertex = line.stations.partition_point(|&s| s + lap <= low);
    let mut worst = 0.0_f64;
    // The tip bows between two rows: a quarter of the second difference of neighbouring rows, at the most.
    let bow = |k: usize| {
        if k == 0 || k + 1 >= points.len() {
            return 0.0;
        }
        ((points[k + 1] - points[k]) - (points[k] - points[k - 1])).norm() / 8.0
    };
    let bow = bow(i).max(bow(i - 1));
    let mut lap = lap;
    loop {
        if vertex >= line.points.len() {
            if !line.ring {
                return worst;
            }
            (vertex, lap) = (1, lap + length);
        }
        if line.stations[vertex] + lap >= high {
            return worst;
        }
        let away = polyline::distance_to_segment(line.points[vertex], points[i - 1], points[i]);
        worst = worst.max(away - bow);
        vertex += 1;
    }
}

/// What is left of the lead at a fraction of the fade: 1 - (35 x^4 - 84 x^5 + 70 x^6 - 20 x^7).
fn fading(x: f64) -> f64 {
    let x4 = x * x * x * x;
    1.0 - x4 * (35.0 - x * (84.0 - x * (70.0 - x * 20.0)))
}
