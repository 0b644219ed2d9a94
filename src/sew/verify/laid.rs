//! Checks that the machine can make the stitches, and that they lie on the lines of the pattern.

use std::collections::BTreeMap;

use super::ground::{Ground, sighting};
use super::{order, rules, satin};
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, Vector};
use crate::ir::verdict::WorstByRule;
use crate::machine::Sewing;
use crate::sew::pattern::{Element, Pattern, Seam};
use crate::sew::stitches::Op;

/// Distance beyond the permitted one within which needle points are searched, mm. Points farther away are reported at the
/// search distance.
const LOOK: f64 = 1.0;

/// Checks all stitches.
pub(super) fn judge(ground: &Ground, worst: &mut WorstByRule) {
    pitches(ground, worst);
    if let Some(pattern) = ground.pattern {
        corners(pattern, ground, worst);
        on_seam(pattern, ground, worst);
        satin::judge(pattern, ground, worst);
        order::judge(pattern, ground, worst);
    }
}

fn pitches(ground: &Ground, worst: &mut WorstByRule) {
    let mut at = Point::origin();
    let asked = asked_pitches(ground);
    for (step, entry) in ground.stitches.steps.iter().zip(1..) {
        if step.op == Op::Stitch {
            let pitch = (step.to - at).norm();
            let place = sighting(entry, step.to);
            worst.see(&rules::LONG_PITCH, pitch - ground.sewing.max_pitch_mm, place);
            if let Some(asked) = asked.get(&step.record) {
                // A short stitch that is merged makes the next one longer.
                worst.see(&rules::LONG_PITCH, pitch - asked - ground.sewing.min_pitch_mm, place);
            }
            if !step.is_tie {
                worst.see(&rules::SHORT_PITCH, ground.sewing.min_pitch_mm - pitch, place);
            }
        }
        at = step.to;
    }
}

/// Stitch length of each seam along whose line stitches are sewn, by the record where it begins; the greatest of one record.
fn asked_pitches(ground: &Ground) -> BTreeMap<u32, f64> {
    let mut pitches = BTreeMap::new();
    for seam in ground.pattern.iter().flat_map(|pattern| &pattern.seams) {
        let pitch = match seam.element {
            Element::Straight | Element::BoxX => seam.pitch.unwrap_or(ground.sewing.pitch_mm),
            Element::Zigzag | Element::BarTack | Element::Satin | Element::Eyelet => f64::INFINITY,
        };
        let most = pitches.entry(seam.span.block).or_insert(pitch);
        *most = f64::max(*most, pitch);
    }
    pitches
}

/// Half the width of a seam, mm.
pub(super) fn half_width(seam: &Seam, sewing: &Sewing) -> f64 {
    match seam.element {
        Element::Straight | Element::BoxX | Element::Satin => 0.0,
        Element::Zigzag => seam.width.unwrap_or(sewing.zigzag_width_mm) / 2.0,
        Element::BarTack | Element::Eyelet => seam.width.unwrap_or(sewing.tack_width_mm) / 2.0,
    }
}

/// Search distance for needle points around a line of a half width, mm.
fn reach(width: f64, sewing: &Sewing) -> f64 {
    width + sewing.min_pitch_mm + LOOK
}

/// Checks that each corner of a seam has a needle point near it.
fn corners(pattern: &Pattern, ground: &Ground, worst: &mut WorstByRule) {
    let mut corners: Vec<(Point, f64)> = Vec::new();
    // The rails of a satin are pierced in turn, not at each point.
    for seam in pattern.seams.iter().filter(|seam| seam.element != Element::Satin) {
        let mut points = seam.points.clone();
        points.dedup();
        let width = half_width(seam, ground.sewing);
        for i in 0..points.len() {
            let is_end = i == 0 || i + 1 == points.len();
            let turn = || turn(points[i] - points[i - 1], points[i + 1] - points[i]).to_degrees();
            if is_end || turn() >= ground.sewing.corner_deg {
                corners.push((points[i], width));
            }
        }
    }
    let around = |&(corner, width): &(Point, f64)| square(corner, reach(width, ground.sewing));
    let boxes = Boxes::new(corners.iter().map(around).collect());
    let mut nearest: Vec<f64> = corners.iter().map(|&(_, width)| reach(width, ground.sewing)).collect();
    for step in ground.stitches.steps.iter().filter(|step| step.op == Op::Stitch) {
        for i in boxes.at(step.to) {
            nearest[i] = nearest[i].min((step.to - corners[i].0).norm());
        }
    }
    for ((corner, width), nearest) in corners.into_iter().zip(nearest) {
        worst.see(&rules::CORNER, nearest - width, sighting(0, corner));
    }
}

/// The square around a point; `reach` is half its side, mm.
fn square(middle: Point, reach: f64) -> Extent {
    Extent { min: middle, max: middle }.grown(reach)
}

/// Angle between two directions, rad.
fn turn(before: Vector, behind: Vector) -> f64 {
    (before.dot(&behind) / (before.norm() * behind.norm())).clamp(-1.0, 1.0).acos()
}

fn on_seam(pattern: &Pattern, ground: &Ground, worst: &mut WorstByRule) {
    let mut lines: Vec<(Vec<Point>, f64)> = Vec::new();
    for seam in &pattern.seams {
        let width = half_width(seam, ground.sewing);
        if seam.element == Element::Satin {
            lines.extend(satin::areas(seam).map(|area| (area.to_vec(), width)));
            continue;
        }
        lines.extend(seam.points.windows(2).map(|pair| (pair.to_vec(), width)));
        if seam.element == Element::BoxX && seam.points.len() >= 4 {
            let p = &seam.points;
            lines.extend([[p[0], p[2]], [p[1], p[3]], [p[3], p[0]]].map(|ends| (ends.to_vec(), width)));
        }
    }
    let around = |(line, width): &(Vec<Point>, f64)| Extent::of(line).grown(reach(*width, ground.sewing));
    let boxes = Boxes::new(lines.iter().map(around).collect());
    for (step, entry) in ground.stitches.steps.iter().zip(1..).filter(|(step, _)| step.op == Op::Stitch) {
        let beside = |i: usize| beside(step.to, &lines[i].0) - lines[i].1;
        let off = boxes.at(step.to).map(beside).fold(reach(0.0, ground.sewing), f64::min);
        worst.see(&rules::ON_SEAM, off, sighting(entry, step.to));
    }
}

/// Distance of a point from a line segment, or from the area between four corners, mm.
fn beside(point: Point, corners: &[Point]) -> f64 {
    if let [a, b] = *corners {
        return beside_segment(point, [a, b]);
    }
    if satin::is_within(point, corners) {
        return 0.0;
    }
    let pairs = (0..corners.len()).flat_map(|i| (0..i).map(move |k| [corners[i], corners[k]]));
    pairs.map(|ends| beside_segment(point, ends)).fold(f64::INFINITY, f64::min)
}

/// Distance of a point from a line segment, mm.
fn beside_segment(point: Point, [a, b]: [Point; 2]) -> f64 {
    let (way, to) = (b - a, point - a);
    let along = (to.dot(&way) / way.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (to - way * along).norm()
}
