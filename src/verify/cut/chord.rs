//! Chord mode: the heel of the blade lies on the path, too.
//!
//! Once the heel has passed the place of the plunge, the path is the way that the tip has gone, and the blade must be a chord
//! of it. Before that, only the tolerance band of the path is known. A line with places that are too tight for the blade may
//! still be cut along the tangent; such places are found here by laying the blade on the line place by place.

use super::body::Cut;
use super::follow::{Follower, Foot};
use crate::geom::{Point, Vector, angle};
use crate::ir::verdict::Worst;
use crate::machine::Knife;
use crate::verify::program::row::Row;
use crate::verify::reference::line::Line;

/// Number of halvings that locate the heel between two tips: to a millionth of their distance.
const HALVINGS: usize = 20;

/// Places on the body of a blade that are checked, as fractions of its width from the heel: on an arc the deviation is greatest
/// in the middle, at an inflection in the quarters.
pub(super) const BODY_SHARES: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// Blade that moves along a line.
#[derive(Clone, Copy)]
pub(in crate::verify) struct Blade<'a> {
    pub(in crate::verify) line: &'a Line<'a>,
    /// Distances from the C axis to tip and heel, mm.
    pub(in crate::verify) ends: [f64; 2],
    pub(in crate::verify) cut: &'a Cut,
    /// Direction from heel to tip at each row.
    pub(in crate::verify) directions: &'a [Vector],
    /// Feet of the points of the cut.
    pub(in crate::verify) feet: &'a [Foot],
}

/// Feet of one place of the blade at each row; `share` is its distance from the heel as a fraction of the width.
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

/// Stroke whose blade is compared with the path of its own tip.
pub(in crate::verify) struct Trailing<'a> {
    pub(in crate::verify) rows: &'a [Row],
    /// Tip at each row.
    pub(in crate::verify) tips: &'a [Point],
    /// Unit vector from the heel to the tip at each row.
    pub(in crate::verify) blades: &'a [Vector],
    /// Foot of the heel on the line at each row.
    pub(in crate::verify) heels: &'a [Foot],
    /// Greatest permitted deviation of a heel, mm.
    pub(in crate::verify) allowed: f64,
    /// Rounding of a tip position, mm.
    pub(in crate::verify) rounding: f64,
}

impl Trailing<'_> {
    /// Compares the blade with the chord of the tip's path, and with the tolerance band until the heel has reached that path.
    pub(in crate::verify) fn check(&self, knife: &Knife, heading: &mut Worst) {
        let Self { rows, tips, blades, heels, allowed, rounding } = *self;
        let width = knife.width_mm;
        // Both ends of a chord are rounded.
        let noise = (2.0 * rounding / width).atan();
        let is_far = |k: usize, i: usize| (tips[k] - tips[i]).norm() >= width;
        // Last tip position that the heel has passed.
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

    /// Point between tip `k` and the next that is one blade width away from the current tip.
    fn behind(&self, k: usize, tip: Point, width: f64) -> Point {
        let (mut far, mut near) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(far, near);
            if (self.between(k, middle) - tip).norm() >= width { far = middle } else { near = middle }
        }
        self.between(k, far)
    }

    /// Point at a fraction of the way from tip `k` to the next, on the Catmull-Rom cubic: the tip's path bows between two rows.
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
