//! The chord law: the blade's tail lies on the path, too.
//!
//! Where the tail has come past the place of the plunge, the path is the way that the tip itself has gone: the blade must
//! be a chord of that. Before, it is known by its tube alone. A line that somewhere is too tight for the blade may be cut
//! along the tangent all the same; where that is, is found here by laying the blade on the line, place by place.

use super::body::Cut;
use super::follow::{Follower, Foot};
use super::line::Line;
use super::read::Row;
use super::worst::Worst;
use crate::geom::{Point, Vector, angle, polyline};
use crate::machine::Knife;

/// Cosines of the blade with a line at its tail and at its tip below which it may be that it could not follow: a little
/// more than what is needed, because overlaps and what lies between two places matter.
const TAIL_COSINE: f64 = 0.47;
const TIP_COSINE: f64 = 0.1;
/// Distance of the places at which a blade is laid on a line, mm.
const STEP: f64 = 0.1;
/// Turn of a line without which it is not tight, rad (46 degrees): the blade's cosines are those of less.
const TURN_MIN: f64 = 0.8;
/// Length of a line on which it turns that much where it is tight, in widths of the blade: twice what a blade may span.
const WIDTHS: f64 = 3.0;
/// Halvings that place the tail between two tips: to a millionth of the way between them.
const HALVINGS: usize = 20;

/// Where the body of a blade is looked at, in parts of its width from the tail: on an arc it is off the most in its middle,
/// where a curve turns to the other side, in its quarters.
pub(super) const BODY_SHARES: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// A blade that goes along a line.
#[derive(Clone, Copy)]
pub(super) struct Blade<'a> {
    pub(super) line: &'a Line<'a>,
    /// From its centre to its tip and to its tail, mm.
    pub(super) ends: [f64; 2],
    pub(super) cut: &'a Cut,
    /// Its direction from the tail to the tip at each row.
    pub(super) directions: &'a [Vector],
    /// Where the places of the cut stand.
    pub(super) feet: &'a [Foot],
}

/// Where a place of a blade stands beside its line at each row: the place at a share of the width before the tail.
pub(super) fn along(rows: &[Row], blade: Blade, share: f64) -> Vec<Foot> {
    let Blade { line, ends: [tip, tail], cut, directions, feet } = blade;
    let place = |(row, along): (&Row, &Vector)| row.centre + along * (share * (tip + tail) - tail);
    let foot = feet[(share * cut.body as f64) as usize];
    let lap = if line.ring { (foot.station / line.length()).floor() * line.length() } else { 0.0 };
    let chord = line.chord_at(foot.station - lap);
    let with = feet[cut.points.len() - 1].station >= foot.station;
    let mut places = rows.iter().zip(directions).map(place).peekable();
    let Some(&first) = places.peek() else { return Vec::new() };
    let mut follower = Follower::new(line, chord, first, if with { 1.0 } else { -1.0 });
    places.map(|place| if place == follower.point() { follower.foot() } else { follower.step(place) }).collect()
}

/// A stroke whose blade is compared with the way of its own tip.
pub(super) struct Trailing<'a> {
    pub(super) rows: &'a [Row],
    /// The tip at each row.
    pub(super) tips: &'a [Point],
    /// Unit vector from the tail to the tip at each row.
    pub(super) blades: &'a [Vector],
    /// Where the tail stands beside the line at each row.
    pub(super) tails: &'a [Foot],
    /// How far a tail may stand off the line, mm.
    pub(super) allowed: f64,
}

impl Trailing<'_> {
    /// The blade against the chord of its way, and against the tube where it has not yet come that far.
    pub(super) fn check(&self, knife: &Knife, heading: &mut Worst) {
        let Self { rows, tips, blades, tails, allowed } = *self;
        let width = knife.width_mm;
        let is_far = |k: usize, i: usize| (tips[k] - tips[i]).norm() >= width;
        // The last tip that the tail has passed.
        let mut passed: Option<usize> = None;
        for (i, row) in rows.iter().enumerate() {
            if passed.is_none() && is_far(0, i) {
                passed = Some(0);
            }
            let Some(mut k) = passed else {
                heading.see(((tails[i].deviation - allowed).max(0.0) / width).atan().to_degrees(), || row.sighting());
                continue;
            };
            while k + 1 < i && is_far(k + 1, i) {
                k += 1;
            }
            passed = Some(k);
            let chord = tips[i] - self.behind(k, (tips[i], width));
            heading.see(angle::turn(chord, blades[i]).abs().to_degrees(), || row.sighting());
        }
    }

    /// The place between tip `k` and the next one that is one width away from where the tip is now.
    fn behind(&self, k: usize, (tip, width): (Point, f64)) -> Point {
        let (mut far, mut near) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(far, near);
            if (self.between(k, middle) - tip).norm() >= width { far = middle } else { near = middle }
        }
        self.between(k, far)
    }

    /// A place at a share of the way from tip `k` to the next: the cubic through both with the slopes of their neighbours, as
    /// Catmull and Rom have it, because the tip bows between two rows.
    fn between(&self, k: usize, x: f64) -> Point {
        let at = |i: usize| self.tips[i.min(self.tips.len() - 1)];
        let (a, b) = (at(k), at(k + 1));
        let (before, behind) = (at(k.saturating_sub(1)), at(k + 2));
        let from = if k == 0 { b - a } else { (b - before) * 0.5 };
        let to = if k + 2 >= self.tips.len() { b - a } else { (behind - a) * 0.5 };
        let (square, cube) = (x * x, x * x * x);
        a + (b - a) * (3.0 * square - 2.0 * cube) + from * (x - 2.0 * square + cube) + to * (cube - square)
    }
}

/// Whether a blade, from its tail to its tip, may stand across a line that has a direction at its tail.
pub(super) fn stands_across(blade: Vector, direction: Vector) -> bool {
    blade.dot(&direction) < TAIL_COSINE * blade.norm()
}

/// The stretches of a line, by the stations of tail and tip, on which a blade as its chord would stand across it.
pub(super) fn tight(line: &Line, knife: &Knife) -> Vec<[f64; 2]> {
    let width = knife.width_mm;
    if width == 0.0 || line.chords() < 2 {
        return Vec::new();
    }
    let (path, start) = led_on(line, knife);
    let stations = polyline::stations(&path);
    let last = if line.ring { line.length() } else { stations[stations.len() - 1] };
    let mut found: Vec<[f64; 2]> = Vec::new();
    for [low, high] in sharp(&path, &stations, WIDTHS * width) {
        let (low, high) = ((low - WIDTHS * width).max(0.0), high.min(last));
        let steps = ((high - low) / STEP).ceil().max(0.0) as usize;
        for tail in (0..=steps).map(|i| (low + STEP * i as f64).min(high)) {
            let Some(tip) = across_at(&path, &stations, (tail, width)) else { continue };
            match found.last_mut() {
                Some(stretch) if tail - start <= stretch[1] => stretch[1] = stretch[1].max(tip - start),
                _ => found.push([tail - start, tip - start]),
            }
        }
    }
    found
}

/// A line led straight on by its greatest overlaps, or a ring twice round; and the station of its first point there.
fn led_on(line: &Line, knife: &Knife) -> (Vec<Point>, f64) {
    let mut path = line.twice_round();
    if line.ring {
        return (path, 0.0);
    }
    let heel = knife.heel_overlap_mm.max(knife.corner_heel_overlap_mm);
    let front = knife.front_overlap_mm.max(knife.corner_front_overlap_mm);
    let n = path.len();
    if let Some(along) = polyline::direction(path[n - 2], path[n - 1]).filter(|_| front > 0.0) {
        path.push(path[n - 1] + along * front);
    }
    match polyline::direction(path[0], path[1]).filter(|_| heel > 0.0) {
        Some(along) => {
            path.insert(0, path[0] - along * heel);
            (path, heel)
        }
        None => (path, 0.0),
    }
}

/// The stretches of a path, not longer than `reach` but for those that meet, on which it turns enough to be tight.
fn sharp(path: &[Point], stations: &[f64], reach: f64) -> Vec<[f64; 2]> {
    let turn = |vertex: usize| polyline::turn_at(path[vertex - 1], path[vertex], path[vertex + 1]).abs();
    let mut found: Vec<[f64; 2]> = Vec::new();
    let (mut first, mut sum) = (1, 0.0);
    for vertex in 1..path.len() - 1 {
        sum += turn(vertex);
        while stations[vertex] - stations[first] > reach {
            sum -= turn(first);
            first += 1;
        }
        if sum >= TURN_MIN {
            let stretch = [stations[first], stations[vertex]];
            match found.last_mut() {
                // Those whose blades reach into each other are one.
                Some(last) if stretch[0] <= last[1] + reach => last[1] = stretch[1],
                _ => found.push(stretch),
            }
        }
    }
    found
}

/// The station of the tip when the blade, its tail at a station, stands across the path or finds no place on it; `None` when
/// it is a chord like any other.
fn across_at(path: &[Point], stations: &[f64], (tail, width): (f64, f64)) -> Option<f64> {
    let chord = stations.partition_point(|&s| s <= tail).clamp(1, path.len() - 1) - 1;
    let along = |chord: usize| -> Vector { (path[chord + 1] - path[chord]) / (stations[chord + 1] - stations[chord]) };
    let from = path[chord] + along(chord) * (tail - stations[chord]);
    let rest: Vec<Point> = std::iter::once(from)
        .chain(path[chord + 1..].iter().copied().take_while({
            let mut is_left = false;
            move |point| !std::mem::replace(&mut is_left, (point - from).norm() > width)
        }))
        .collect();
    let found = polyline::first_at_distance(&rest, width);
    let (tip, at) = found.unwrap_or((path[path.len() - 1], path.len() - 2 - chord));
    let at = chord + at;
    let blade = tip - from;
    let is_across = stands_across(blade, along(chord)) || blade.dot(&along(at)) < TIP_COSINE * blade.norm();
    is_across.then(|| stations[at] + (tip - path[at]).norm())
}
