//! Direction of the blade: along the path of its tip while it moves; as a chord of its line at the plunge and until it moves.
//!
//! In the tangent mode the blade lies along the tip's path; after a plunge as a chord it fades from chord to tangent over the
//! next blade width, by the smoothstep polynomial of degree 7.

use std::cell::OnceCell;
use std::f64::consts::PI;

use super::follow::Foot;
use crate::geom::{Point, Vector, angle, cross, polyline};
use crate::ir::verdict::Worst;
use crate::verify::program::row::{Rounding, Row};
use crate::verify::reference::line::Line;

/// Shortest path of the tip that shows a direction, mm: with six decimals its rounding error is below 0.02 degrees.
const WAY_MIN: f64 = 0.005;
/// Shortest path that shows a direction with coarser numbers, in multiples of the axis rounding: longer ones would miss tight
/// curves.
const COARSE_WAY: f64 = 1000.0;
/// Turns up to this angle count as none, rad.
const TURN_EPSILON: f64 = 1e-6;
/// Longest chord that counts as part of a curve, mm: along it the curve turns from the direction of the previous chord to that
/// of the next.
const CURVE_CHORD: f64 = 25.0;
/// Greatest distance at which a bend is searched, mm: a curve farther away does not bow the start of a path.
const BEND_REACH: f64 = 100.0;

/// Maximum number of rows searched for a second place on one side of the end of a path: the knife may rest.
const LOOK: usize = 64;
/// Relative amount by which rounding may reduce an angle.
const SURE_EPSILON: f64 = 1e-9;

/// Smallest radius of a curve that a knife follows, mm.
const TIGHT: f64 = 5.0;

/// Lead that permits any direction: for a stroke without a line.
pub(super) const ANY: [f64; 2] = [-PI, PI];
/// Lead of a blade that plunges along its path: zero.
pub(super) const NONE: [f64; 2] = [0.0; 2];

/// Shortest path of the tip that shows a direction, mm.
pub(super) fn way_min(rounding: Rounding) -> f64 {
    (COARSE_WAY * rounding.axis()).max(WAY_MIN)
}

/// Greatest turn of a direction due to coarse numbers, degrees; 0 for numbers that are fine enough.
pub(super) fn noise_deg(rounding: Rounding) -> f64 {
    let way = way_min(rounding);
    // At the ends of a stroke the direction is that of a chord ahead or behind, which deviates from a curve.
    if way > WAY_MIN { (rounding.place() / way + way / (2.0 * TIGHT)).to_degrees() } else { 0.0 }
}

/// Stroke whose blade is compared with the path of its tip.
pub(in crate::verify) struct Moving<'a> {
    pub(in crate::verify) rows: &'a [Row],
    /// Direction of the tip's path at each row when it is known exactly; otherwise empty.
    pub(in crate::verify) ways: &'a [Vector],
    /// Tip at each row.
    pub(in crate::verify) tips: &'a [Point],
    /// Unit vector from the heel to the tip at each row.
    pub(in crate::verify) blades: &'a [Vector],
    /// Least and greatest turn from the blade to the tip's path at the plunge, rad.
    pub(in crate::verify) lead: [f64; 2],
    /// Path length of the tip over which the lead fades, mm.
    pub(in crate::verify) fade: f64,
    /// Shortest path of the tip that shows a direction, mm.
    pub(in crate::verify) way_min: f64,
    /// Greatest turn of a shorter path's direction due to rounding, degrees.
    pub(in crate::verify) noise_deg: f64,
}

impl Moving<'_> {
    /// Compares the blade with its orientation mode: along the path of the tip, and before the tip has moved along the path
    /// ahead.
    pub(in crate::verify) fn check(&self, heading: &mut Worst) {
        let Self { rows, tips, .. } = *self;
        let last = rows.len() - 1;
        let [least, greatest] = self.lead;
        let is_clear = |i: usize, k: usize| (tips[k] - tips[i]).norm() >= self.way_min;
        let (mut before, mut behind) = (0, 0);
        let (mut lead, mut way, stations) = (None, 0.0, OnceCell::new());
        for i in 0..=last {
            way += (tips[i] - tips[i.saturating_sub(1)]).norm();
            let along = if let Some(&way) = self.ways.get(i) {
                // Any length will do: only the direction matters.
                way.try_normalize(0.0).unwrap_or_default()
            } else {
                // Nearest rows on either side with a clearly different tip position: at rest, positions are only noise. Both
                // indices only increase, so that long rests are cheap, too.
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
                // A blade that does not move must not turn.
                heading.see((rows[i].c_deg - rows[0].c_deg).abs(), || rows[i].sighting());
                continue;
            }
            let ahead = |along: Vector| angle::turn(self.blades[i], along);
            let lead = *lead.get_or_insert_with(|| ahead(along).clamp(least, greatest));
            let (aside, forth) = (cross(self.blades[i], along).abs(), self.blades[i].dot(&along));
            if way >= self.fade && aside < heading.value().to_radians() * (1.0 - SURE_EPSILON) * forth {
                // An angle is less than its tangent: this one is not the worst, so it need not be computed.
                continue;
            }
            let expected = if way < self.fade { lead * fading(way / self.fade) } else { 0.0 };
            let askew = |along: Vector| angle::wrap(ahead(along) - expected).abs().to_degrees();
            // Rounding turns the direction of a short move, but much less that of the longer path around it.
            let of_way = self.around(i, &stations).map_or(f64::INFINITY, |along| askew(along) - self.noise_deg);
            heading.see(askew(along).min(of_way.max(0.0)), || rows[i].sighting());
        }
    }

    /// Direction of the path at the middle of three rows, to second order: the tangent of the parabola through them; at an end
    /// of the path, of the parabola through the rows on one side. A row too close to show a direction does not count.
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

    /// Direction of the path around a row of a move that is too short to show a direction by itself; `None` for longer moves
    /// and when directions are not known exactly.
    fn around(&self, i: usize, stations: &OnceCell<Vec<f64>>) -> Option<Vector> {
        let last = self.tips.len() - 1;
        // The end of a move and the start of the next are two rows at the same place.
        let is_long = |k: usize| (self.tips[k] - self.tips[i]).norm() >= self.way_min;
        if self.ways.is_empty() || is_long(i.saturating_sub(1)) || is_long((i + 1).min(last)) {
            return None;
        }
        let stations = stations.get_or_init(|| polyline::stations(self.tips));
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

/// Direction of a path at the last of three places, to second order: the tangent of the parabola through them.
fn at_end([far, near, end]: [Point; 3]) -> Vector {
    let (first, last) = (near - far, end - near);
    let (a, b) = (first.norm(), last.norm());
    let along = last / b;
    (along + (along - first / a) * (b / (a + b))) * b
}

/// Remaining fraction of the lead at fraction `x` of the fade: 1 - (35 x^4 - 84 x^5 + 70 x^6 - 20 x^7).
pub(super) fn fading(x: f64) -> f64 {
    let x4 = x * x * x * x;
    1.0 - x4 * (35.0 - x * (84.0 - x * (70.0 - x * 20.0)))
}

/// Blade that plunges on a line: feet of heel and tip, and the direction of motion.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Plunge<'a> {
    pub(in crate::verify) line: &'a Line<'a>,
    pub(in crate::verify) heel: Foot,
    pub(in crate::verify) tip: Foot,
    /// +1 with the line, -1 against it.
    pub(in crate::verify) sign: f64,
    /// Greatest distance of a path from the line, mm: tolerance and bulge of a curve.
    pub(in crate::verify) band: f64,
}

impl Plunge<'_> {
    /// Chord of the line itself from heel to tip.
    pub(in crate::verify) fn chord(&self) -> Vector {
        point_at(self.line, &self.tip) - point_at(self.line, &self.heel)
    }

    /// Least and greatest turn from the blade to the path of its tip, rad: from the chords of the line around the tip, plus the
    /// bow that the tolerance band permits. On a line without a bend the path is straight.
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
        // Along a straight stretch of length l a path may bow by twice `band`: its curvature is then 16 band / l^2, and it
        // leads the blade by half of that times the width.
        let slack = self.straight().map_or(0.0, |length| 8.0 * self.band * width / length.max(width).powi(2));
        [lead[0] - slack, lead[1] + slack]
    }

    /// Distance from the heel to the first bend, mm; `None` without a bend within reach.
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

/// Station mapped to the first lap.
pub(super) fn on_lap(line: &Line, station: f64) -> f64 {
    if line.ring { station.rem_euclid(line.length()) } else { station }
}

/// Point of a foot on the line or on its straight extension.
fn point_at(line: &Line, foot: &Foot) -> Point {
    let station = on_lap(line, foot.station);
    let chord = line.chord_at(station);
    let way = if station <= 0.0 { -foot.beyond } else { foot.beyond };
    line.point(chord) + line.direction(chord) * (station - line.station(chord) + way)
}
