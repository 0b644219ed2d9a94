//! Whether the blade lies along its way over the cloth: along the tangent of the leading end's way, or as a chord of it with
//! both ends on it.

use super::ground::Ground;
use super::rules::Rule;
use super::strokes::Stroke;
use super::worst::Worst;
use crate::geom::{Vector, angle};
use crate::units::deg;

/// The direction of a way is taken over so much of it, mm: less is rounding of rows.
const LOOK: f64 = 0.1;

/// Judges a stroke.
pub(super) fn judge(stroke: &Stroke, ground: &Ground, worst: &mut Worst) {
    let width = ground.profile.knife.width_mm;
    let limit = ground.profile.verify.max_heading_deg;
    // The way of the leading end; before it, the blade as it is plunged.
    let trace = &stroke.trace;
    let mut behind = 0;
    for (i, along) in stroke.along.iter().enumerate() {
        let here = trace[i + 1];
        while behind < i && (trace[behind + 1] - here).norm() > width {
            behind += 1;
        }
        let Some(tangent) = direction(stroke, i) else { continue };
        let chord = if width > 0.0 { chord(stroke, behind, i, width) } else { None };
        let off = |way: Vector| deg(angle::turn(way, *along)).abs();
        let off = chord.map_or(off(tangent), |chord| off(chord).min(off(tangent)));
        worst.see(Rule::Heading, off, limit, Some(stroke.places[i]));
    }
}

/// The direction of the leading end at a row: between places as far before as behind it, a little away; `None` near the
/// ends of a stroke, and where the blade does not move.
fn direction(stroke: &Stroke, i: usize) -> Option<Vector> {
    let way = &stroke.trace[1..];
    let before = (0..i).rev().find(|&k| (way[k] - way[i]).norm() >= LOOK)?;
    let behind = (i + 1..way.len()).find(|&k| (way[k] - way[i]).norm() >= LOOK)?;
    // At unequal distances the secant is the tangent elsewhere: two secants meet in it.
    let [a, b] = [way[i] - way[before], way[behind] - way[i]];
    let (la, lb) = (a.norm(), b.norm());
    Some(a / la * (lb / (la + lb)) + b / lb * (la / (la + lb)))
}

/// From the place of the way that is a blade's width behind, between two points of the trace, to the leading end.
fn chord(stroke: &Stroke, behind: usize, i: usize, width: f64) -> Option<Vector> {
    let (here, from, to) = (stroke.trace[i + 1], stroke.trace[behind], *stroke.trace.get(behind + 1)?);
    let (a, d) = (from - here, to - from);
    let (square, half, rest) = (d.norm_squared(), a.dot(&d), a.norm_squared() - width * width);
    if square == 0.0 {
        return (rest.abs() < 1e-3).then(|| here - from);
    }
    let root = half * half - square * rest;
    let x = (-half - root.max(0.0).sqrt()) / square;
    let x = if (0.0..=1.0).contains(&x) { x } else { (-half + root.max(0.0).sqrt()) / square };
    Some(here - (from + d * x.clamp(0.0, 1.0)))
}
