//! Which way the blade must point: along the way of its tip; at the plunge, and as long as it does not move, as a chord of
//! its line.
//!
//! In the tangent mode the blade lies along the tip's way; after a plunge as a chord it fades from the
//! chord to the tangent over the next blade width, by the step of degree 7.

use std::f64::consts::PI;

use super::follow::Foot;
use crate::geom::{Point, Vector, angle, cross, polyline};
use crate::ir::verdict::Worst;
use crate::verify::program::row::{Rounding, Row};
use crate::verify::reference::line::Line;

/// Least way of the tip that shows a direction, mm: with six decimals its rounding is then below 0.02 degrees.
const WAY_MIN: f64 = 0.005;
/// The same where numbers are coarser, in roundings of an axis: longer ways would show no tight curve.
const COARSE_WAY: f64 = 1000.0;
/// Smaller turns are none, rad.
const TURN_EPSILON: f64 = 1e-6;
/// Longest chord that counts as a chord of a curve, mm: along it the curve turns from the direction of the chord before
/// to that of the chord behind.
const CURVE_CHORD: f64 = 25.0;
/// Farthest ahead that a bend is looked for, mm: a curve that far away does not bow the start of a way.
const BEND_REACH: f64 = 100.0;

/// Rows that are looked at for a second place on one side of the end of a way, at the most: a knife may rest.
const LOOK: usize = 64;
/// Part of an angle by which rounding may seem to make it less.
const SURE_EPSILON: f64 = 1e-9;

/// Radius of a curve that a knife follows, at the least, mm.
const TIGHT: f64 = 5.0;

/// Any lead is right: for a stroke that belongs to no line.
pub(super) const ANY: [f64; 2] = [-PI, PI];
/// None is: the blade plunges along its way.
pub(super) const NONE: [f64; 2] = [0.0; 2];

/// Least way of the tip that shows a direction, mm.
pub(super) fn way_min(rounding: Rounding) -> f64 {
    (COARSE_WAY * rounding.axis()).max(WAY_MIN)
}

/// By how much coarse numbers may turn a direction, degrees; none for those that leave it below what is judged.
pub(super) fn noise_deg(rounding: Rounding) -> f64 {
    let way = way_min(rounding);
    // At the ends of a stroke the direction is that of a chord ahead or behind, which a curve bows away from.
    if way > WAY_MIN { (rounding.place() / way + way / (2.0 * TIGHT)).to_degrees() } else { 0.0 }
}

/// A stroke whose blade is compared with the way of its tip.
pub(in crate::verify) struct Moving<'a> {
    pub(in crate::verify) rows: &'a [Row],
    /// The way of the tip at each row where that is known exactly; else none.
    pub(in crate::verify) ways: &'a [Vector],
    /// The tip at each row.
    pub(in crate::verify) tips: &'a [Point],
    /// Unit vector from the heel to the tip at each row.
    pub(in crate::verify) blades: &'a [Vector],
    /// Least and greatest turn from the blade to the tip's way at the plunge, rad.
    pub(in crate::verify) lead: [f64; 2],
    /// Way of the tip over which that fades, mm.
    pub(in crate::verify) fade: f64,
    /// Least way of the tip that shows a direction, mm.
    pub(in crate::verify) way_min: f64,
    /// By how much rounding may turn the direction of a shorter one, degrees.
    pub(in crate::verify) noise_deg: f64,
}

impl Moving<'_> {
    /// The blade against where its orientation mode has it: along the way of the tip; before the tip has moved, along the
    /// way to come.
    pub(in crate::verify) fn check(&self, heading: &mut Worst) {
        let Self { rows, tips, .. } = *self;
        let last = rows.len() - 1;
        let [least, greatest] = self.lead;
        let is_clear = |i: usize, k: usize| (tips[k] - tips[i]).norm() >= self.way_min;
        let stations = polyline::stations(tips);
        let (mut before, mut behind) = (0, 0);
        let mut lead = None;
        for i in 0..=last {
            let along = if let Some(&way) = self.ways.get(i) {
                // Of any length: what matters is where it points.
                way.try_normalize(0.0).unwrap_or_default()
            } else {
                // The nearest rows on either side at which the tip is clearly elsewhere: where it rests its place is
                // only noise. Neither ever goes back, so that a long rest costs no more than a way.
                while before + 1 < i && is_clear(i, before + 1) {
                    before += 1;
                }
                behind = behind.max(i + 1).min(last);
                while behind < last && !is_clear(i, behind) {
                    behind += 1;
                }
                self.direction([before, i, behind])
            };
            if along.norm() < self.way_min {
                // A blade that goes nowhere turns nowhere.
                heading.see((rows[i].c_deg - rows[0].c_deg).abs(), || rows[i].sighting());
                continue;
            }
            let ahead = |along: Vector| angle::turn(self.blades[i], along);
            let lead = *lead.get_or_insert_with(|| ahead(along).clamp(least, greatest));
            let way = stations[i];
            let (aside, forth) = (cross(self.blades[i], along).abs(), self.blades[i].dot(&along));
            if way >= self.fade && aside < heading.value().to_radians() * (1.0 - SURE_EPSILON) * forth {
                // An angle is less than its tangent: this one is not the worst, and need not be known.
                continue;
            }
            let expected = if way < self.fade { lead * fading(way / self.fade) } else { 0.0 };
            let askew = |along: Vector| angle::wrap(ahead(along) - expected).abs().to_degrees();
            // Rounding turns the direction of a short move, but not by as much that of the way which it is part of.
            let of_way = self.around(i, &stations).map_or(f64::INFINITY, |along| askew(along) - self.noise_deg);
            heading.see(askew(along).min(of_way.max(0.0)), || rows[i].sighting());
        }
    }

    /// Direction of the way at the middle one of three rows, to the second order: that of the parabola through them; at an end
    /// of the way that of the parabola through the rows on its one side. A place too near to show a direction gives none.
    fn direction(&self, [before, here, behind]: [usize; 3]) -> Vector {
        let (tips, last) = (self.tips, self.tips.len() - 1);
        let is_clear = |i: usize, k: usize| (tips[k] - tips[i]).norm() >= self.way_min;
        let (to, from) = (tips[here] - tips[before], tips[behind] - tips[here]);
        let (a, b) = (to.norm(), from.norm());
        let led = |near: usize, far: Option<usize>| far.map(|far| at_end([tips[far], tips[near], tips[here]]));
        match [is_clear(here, before), is_clear(here, behind)] {
            [true, true] => to * (b / a) + from * (a / b),
            [true, false] => led(before, (0..before).rev().take(LOOK).find(|&far| is_clear(before, far))).unwrap_or(to),
            [false, true] => {
                let far = (behind + 1..=last).take(LOOK).find(|&far| is_clear(behind, far));
                led(behind, far).map_or(from, |along| -along)
            }
            [false, false] => to + from,
        }
    }

    /// Where the way points that lies about a row of a move which is told but too short to show a direction by itself;
    /// `None` for any other.
    fn around(&self, i: usize, stations: &[f64]) -> Option<Vector> {
        let last = stations.len() - 1;
        // The end of a move and the start of the next are two rows at one place.
        let step = (stations[i] - stations[i.saturating_sub(1)]).max(stations[(i + 1).min(last)] - stations[i]);
        if self.ways.is_empty() || step >= self.way_min {
            return None;
        }
        let at = |station: f64| {
            let next = stations.partition_point(|&s| s < station).clamp(1, last);
            let (low, high) = (stations[next - 1], stations[next]);
            let share = if high > low { ((station - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
            self.tips[next - 1] + (self.tips[next] - self.tips[next - 1]) * share
        };
        let half = 0.5 * self.way_min;
        polyline::direction(at(stations[i] - half), at(stations[i] + half))
    }
}

/// Direction of a way at the last of three places, to the second order: that of the parabola through them.
fn at_end([far, near, end]: [Point; 3]) -> Vector {
    let (first, last) = (near - far, end - near);
    let (a, b) = (first.norm(), last.norm());
    let along = last / b;
    (along + (along - first / a) * (b / (a + b))) * b
}

/// What is left of the lead at a fraction of the fade: 1 - (35 x^4 - 84 x^5 + 70 x^6 - 20 x^7).
pub(super) fn fading(x: f64) -> f64 {
    let x4 = x * x * x * x;
    1.0 - x4 * (35.0 - x * (84.0 - x * (70.0 - x * 20.0)))
}

/// A blade that plunges on a line: where its heel and its tip stand, and which way it goes from there.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Plunge<'a> {
    pub(in crate::verify) line: &'a Line<'a>,
    pub(in crate::verify) heel: Foot,
    pub(in crate::verify) tip: Foot,
    /// +1 with the line, -1 against it.
    pub(in crate::verify) sign: f64,
    /// Farthest that a way may lie off the line, mm: its tolerance and the bulge of a curve.
    pub(in crate::verify) band: f64,
}

impl Plunge<'_> {
    /// The blade as a chord of the line itself.
    pub(in crate::verify) fn chord(&self) -> Vector {
        point_at(self.line, &self.tip) - point_at(self.line, &self.heel)
    }

    /// Least and greatest turn from the blade to the way of its tip, rad: by the chords of the line about the tip, and
    /// by as much as a way may bow inside its tolerance band. On a line without a bend the way is straight.
    pub(in crate::verify) fn lead(&self) -> [f64; 2] {
        let line = self.line;
        let chord = self.chord() * self.sign;
        let width = chord.norm();
        if width <= self.band {
            return ANY;
        }
        let at = on_lap(line, self.tip.station);
        let count = line.chords();
        let here = line.chord_at(at);
        let mut lead = [f64::INFINITY, f64::NEG_INFINITY];
        let mut add = |k: usize| {
            let turn = angle::turn(chord, line.direction(k));
            lead = [lead[0].min(turn), lead[1].max(turn)];
        };
        add(here);
        if at - line.station(here) <= CURVE_CHORD && (here > 0 || line.ring) {
            add((here + count - 1) % count);
        }
        if line.station(here + 1) - at <= CURVE_CHORD && (here + 1 < count || line.ring) {
            add((here + 1) % count);
        }
        // A way that is straight for a length l may bow by twice `band` on it: its curvature is then
        // 16 band / l^2, and it leads the blade by half of that times the width.
        let slack = self.straight().map_or(0.0, |length| 8.0 * self.band * width / length.max(width).powi(2));
        [lead[0] - slack, lead[1] + slack]
    }

    /// How far it is from the heel to the first bend; `None` when there is none within reach.
    fn straight(&self) -> Option<f64> {
        let Self { line, heel, sign, .. } = *self;
        let from = heel.station;
        let [low, high] = if sign > 0.0 { [from, from + BEND_REACH] } else { [from - BEND_REACH, from] };
        let bends = line.vertices(low, high).filter(|&vertex| line.turn(vertex).abs() > TURN_EPSILON);
        let length = line.length();
        let away = |vertex: usize| {
            let way = sign * (line.station(vertex) - from);
            heel.beyond + if line.ring { way.rem_euclid(length) } else { way }
        };
        bends.map(away).filter(|&way| way > self.band).reduce(f64::min)
    }
}

/// A station on the first lap.
pub(super) fn on_lap(line: &Line, station: f64) -> f64 {
    if line.ring { station.rem_euclid(line.length()) } else { station }
}

/// The place of the line, or of its straight extension, at which something stands.
fn point_at(line: &Line, foot: &Foot) -> Point {
    let station = on_lap(line, foot.station);
    let chord = line.chord_at(station);
    let way = if station <= 0.0 { -foot.beyond } else { foot.beyond };
    line.point(chord) + line.direction(chord) * (station - line.station(chord) + way)
}
