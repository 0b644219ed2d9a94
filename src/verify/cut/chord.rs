//! The chord mode: the blade's heel lies on the path, too.
//!
//! Where the heel has come past the place of the plunge, the path is the way that the tip itself has gone: the blade
//! must be a chord of that. Before, it is known by its tolerance band alone. A line that somewhere is too tight for the
//! blade may be cut along the tangent all the same; where that is, is found here by laying the blade on the line, place
//! by place.

use super::body::Cut;
use super::follow::{Follower, Foot};
use crate::geom::{Point, Vector, angle};
use crate::ir::verdict::Worst;
use crate::machine::Knife;
use crate::verify::program::row::Row;
use crate::verify::reference::line::Line;

/// Halvings that place the heel between two tips: to a millionth of the way between them.
const HALVINGS: usize = 20;

/// Where the body of a blade is looked at, in parts of its width from the heel: on an arc it is off the most in its middle,
/// where a curve turns to the other side, in its quarters.
pub(super) const BODY_SHARES: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// A blade that goes along a line.
#[derive(Clone, Copy)]
pub(in crate::verify) struct Blade<'a> {
    pub(in crate::verify) line: &'a Line<'a>,
    /// From its centre to its tip and to its heel, mm.
    pub(in crate::verify) ends: [f64; 2],
    pub(in crate::verify) cut: &'a Cut,
    /// Its direction from the heel to the tip at each row.
    pub(in crate::verify) directions: &'a [Vector],
    /// Where the places of the cut stand.
    pub(in crate::verify) feet: &'a [Foot],
}

/// Where a place of a blade stands beside its line at each row: the place at a share of the width before the heel.
pub(in crate::verify) fn along(rows: &[Row], blade: Blade, share: f64) -> Vec<Foot> {
    let Blade { line, ends: [tip, heel], cut, directions, feet } = blade;
    let place = |(row, along): (&Row, &Vector)| row.centre + along * (share * (tip + heel) - heel);
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
pub(in crate::verify) struct Trailing<'a> {
    pub(in crate::verify) rows: &'a [Row],
    /// The tip at each row.
    pub(in crate::verify) tips: &'a [Point],
    /// Unit vector from the heel to the tip at each row.
    pub(in crate::verify) blades: &'a [Vector],
    /// Where the heel stands beside the line at each row.
    pub(in crate::verify) heels: &'a [Foot],
    /// How far a heel may stand off the line, mm.
    pub(in crate::verify) allowed: f64,
    /// Rounding of a tip's place, mm.
    pub(in crate::verify) rounding: f64,
}

impl Trailing<'_> {
    /// The blade against the chord of its way, and against the tolerance band where it has not yet come that far.
    pub(in crate::verify) fn check(&self, knife: &Knife, heading: &mut Worst) {
        let Self { rows, tips, blades, heels, allowed, rounding } = *self;
        let width = knife.width_mm;
        // Both ends of a chord are rounded.
        let noise = (2.0 * rounding / width).atan();
        let is_far = |k: usize, i: usize| (tips[k] - tips[i]).norm() >= width;
        // The last tip that the heel has passed.
        let mut passed: Option<usize> = None;
        for (i, row) in rows.iter().enumerate() {
            if passed.is_none() && is_far(0, i) {
                passed = Some(0);
            }
            let Some(mut k) = passed else {
                heading.see(((heels[i].deviation - allowed).max(0.0) / width).atan().to_degrees(), || row.sighting());
                continue;
            };
            while k + 1 < i && is_far(k + 1, i) {
                k += 1;
            }
            passed = Some(k);
            let chord = tips[i] - self.behind(k, tips[i], width);
            let askew = (angle::turn(chord, blades[i]).abs() - noise).max(0.0);
            heading.see(askew.to_degrees(), || row.sighting());
        }
    }

    /// The place between tip `k` and the next one that is one width away from where the tip is now.
    fn behind(&self, k: usize, tip: Point, width: f64) -> Point {
        let (mut far, mut near) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(far, near);
            if (self.between(k, middle) - tip).norm() >= width { far = middle } else { near = middle }
        }
        self.between(k, far)
    }

    /// A place at a share of the way from tip `k` to the next: the cubic through both with the slopes of their
    /// neighbours, as Catmull and Rom have it, because the tip bows between two rows.
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
