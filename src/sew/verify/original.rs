//! The audit of the reader: what a stitch file says, decoded a second time, is what is sewn.
//!
//! Stitches may be left out where they are too short, and added on the way to one that is too long; nothing else.

use super::ground::{Ground, Original};
use super::records::{self, Kind};
use super::rules::Rule;
use super::worst::Worst;
use crate::geom::Point;
use crate::sew::stitches::Op;

/// Units of stitch files in a millimetre.
const PER_MM: f64 = 10.0;
/// Rounding of places, mm.
const PLACE_EPSILON: f64 = 1e-6;
/// Into how many stitches one is split at the most: the longest by the shortest.
const MOST_PARTS: usize = 1000;

/// Counts the stitches of the file that are not sewn, and those that are sewn and not in it.
pub(super) fn judge(ground: &Ground, worst: &mut Worst) {
    let decoded = match ground.original {
        Original::Dst(bytes) => records::dst(bytes),
        Original::Exp(bytes) => records::exp(bytes),
        Original::Other => return,
    };
    let Ok(file) = decoded else {
        worst.see(Rule::Source, f64::INFINITY, None);
        return;
    };
    let stitches = file.records.iter().filter(|record| record.kind == Kind::Stitch);
    let asked: Vec<Point> =
        stitches.map(|record| Point::new(record.at[0] as f64 / PER_MM, record.at[1] as f64 / PER_MM)).collect();
    let sewn: Vec<(Point, u32)> = (ground.stitches.steps.iter().zip(1..))
        .filter(|(step, _)| step.op == Op::Stitch)
        .map(|(step, entry)| (step.to, entry))
        .collect();
    let near = |a: Point, b: Point, reach: f64| (a - b).norm() <= reach;
    worst.count(Rule::Source, 0.0, None);
    let (mut next, mut last) = (0, None);
    for (i, &place) in asked.iter().enumerate() {
        let ahead = &sewn[next..sewn.len().min(next + MOST_PARTS)];
        let Some(found) = ahead.iter().position(|(point, _)| near(*point, place, PLACE_EPSILON)) else {
            // Merged with a neighbour that is too near.
            let is_short = |other: Option<&Point>| {
                other.is_some_and(|other| near(*other, place, ground.sewing.min_pitch_mm + PLACE_EPSILON))
            };
            let is_merged = is_short(i.checked_sub(1).map(|i| &asked[i]))
                || is_short(asked.get(i + 1))
                || last.is_some_and(|last| is_short(Some(&last)));
            worst.count(Rule::Source, f64::from(u8::from(!is_merged)), Some((0, place)));
            continue;
        };
        for &(point, entry) in &ahead[..found] {
            let is_between = last.is_some_and(|last| is_between(point, last, place));
            worst.count(Rule::Source, f64::from(u8::from(!is_between)), Some((entry, point)));
        }
        next += found + 1;
        last = Some(place);
    }
    for &(point, entry) in &sewn[next..] {
        worst.count(Rule::Source, 1.0, Some((entry, point)));
    }
}

/// Whether a point lies on the way from one place to another.
fn is_between(point: Point, from: Point, to: Point) -> bool {
    (point - from).norm() + (to - point).norm() <= (to - from).norm() + PLACE_EPSILON
}
