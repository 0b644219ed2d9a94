//! Direction of the blade over the cloth: along the tangent of the leading end's path, or as a chord of it with both ends on
//! it. A blade that plunged as a chord of a curve turns to the tangent over the next blade width.

use super::ground::Ground;
use super::rules;
use super::strokes::Stroke;
use crate::geom::{Point, Vector, angle};
use crate::ir::verdict::WorstByRule;
use crate::units::deg;

/// Length of the path on either side from which its direction is computed, mm: rounding to six decimals turns it by less than
/// 0.02 degrees, and even the tightest bend within a tolerance looks straight over it.
const LOOK: f64 = 0.005;

/// Blade of a stroke.
pub(super) struct Blade<'a> {
    pub(super) stroke: &'a Stroke,
    /// Path under the blade at the plunge, without the leading end.
    pub(super) under: Vec<Point>,
    /// Total turn of the line under the blade at the plunge, rad: an upper bound on the angle of a chord.
    pub(super) bend: f64,
}

impl Blade<'_> {
    /// Verifies the heading of the blade.
    pub(super) fn judge(&self, ground: &Ground, worst: &mut WorstByRule) {
        let Self { stroke, under, bend } = self;
        let width = ground.profile.knife.width_mm;
        let limit = ground.profile.verify.max_heading_deg;
        // The trailing end of a blade as a chord follows the line that lay under it, which is known to within the tolerance.
        let beside = if width > 0.0 { deg((ground.tolerance() / width).atan()) } else { 0.0 };
        let way: Vec<Point> = under.iter().chain(&stroke.trace[1..]).copied().collect();
        let (mut behind, mut gone, mut lead_at_plunge) = (0, 0.0, None);
        for (i, along) in stroke.along.iter().enumerate() {
            let lead = under.len() + i;
            while behind + 1 < lead && (way[behind + 1] - way[lead]).norm() > width {
                behind += 1;
            }
            if i > 0 {
                gone += (way[lead] - way[lead - 1]).norm();
            }
            let Some(tangent) = direction(stroke, i) else { continue };
            let ahead = angle::turn(*along, tangent);
            let at_plunge = *lead_at_plunge.get_or_insert(ahead.clamp(-bend, *bend));
            let fading = if gone < width { at_plunge * left(gone / width) } else { 0.0 };
            let off = |way: Vector| deg(angle::turn(way, *along)).abs();
            let chord = if width > 0.0 { chord([way[behind], way[behind + 1]], way[lead], width) } else { None };
            let allowed = limit + if behind < under.len() { beside } else { 0.0 };
            let off = chord.map_or(off(tangent), |chord| off(chord).min(off(tangent)));
            let off = off.min(deg(angle::wrap(ahead - fading)).abs());
            worst.see_under(&rules::HEADING, off, allowed, stroke.places[i]);
        }
    }
}

/// Remaining fraction of the angle between a blade that plunged as a chord and its path, at a fraction of its width: the
/// smoothstep polynomial of degree 7, whose first three derivatives vanish at both ends.
fn left(part: f64) -> f64 {
    1.0 - part.powi(4) * (35.0 - part * (84.0 - part * (70.0 - part * 20.0)))
}

/// Direction of the leading end's path at a row, from the nearest clearly distinct positions before and after it; `None` near
/// the ends of a stroke and where the blade does not move.
fn direction(stroke: &Stroke, i: usize) -> Option<Vector> {
    let way = &stroke.trace[1..];
    let before = (0..i).rev().find(|&k| (way[k] - way[i]).norm() >= LOOK)?;
    let behind = (i + 1..way.len()).find(|&k| (way[k] - way[i]).norm() >= LOOK)?;
    // At unequal distances a single secant is off: weight both secants so that they give the tangent.
    let [a, b] = [way[i] - way[before], way[behind] - way[i]];
    let (la, lb) = (a.norm(), b.norm());
    Some(a / la * (lb / (la + lb)) + b / lb * (la / (la + lb)))
}

/// Vector to the leading end from the place on a chord of the path that is one blade width behind.
fn chord([from, to]: [Point; 2], here: Point, width: f64) -> Option<Vector> {
    let (a, d) = (from - here, to - from);
    let (square, half, rest) = (d.norm_squared(), a.dot(&d), a.norm_squared() - width * width);
    if square == 0.0 {
        return (from != here).then(|| here - from);
    }
    let root = (half * half - square * rest).max(0.0).sqrt();
    let x = [(-half - root) / square, (-half + root) / square].into_iter().find(|x| (0.0..=1.0).contains(x));
    let place = from + d * x.unwrap_or(0.0);
    (place != here).then(|| here - place)
}
