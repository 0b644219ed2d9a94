//! Checks of a satin: its stitches lie between its rails, and pierce both closely enough.

use super::ground::{Ground, sighting};
use super::rules;
use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, cross};
use crate::ir::verdict::WorstByRule;
use crate::sew::pattern::{Element, Pattern, Seam};
use crate::sew::stitches::Op;

/// Number of places within a pitch at which a rail is looked at.
const LOOKS: f64 = 4.0;
/// Search distance for needle points beyond the permitted one, mm. Farther ones are reported at it.
const LOOK: f64 = 1.0;

/// The areas between neighbouring rungs, with the corners in the order of the file.
pub(super) fn areas(seam: &Seam) -> impl Iterator<Item = &[Point]> {
    seam.points.windows(4).step_by(2)
}

/// True if a point lies in the convex hull of four others: in one of the triangles that they form.
pub(super) fn is_within(point: Point, area: &[Point]) -> bool {
    let is_in = |corners: [usize; 3]| {
        let sides = [0, 1, 2].map(|i| {
            let (from, to) = (area[corners[i]], area[corners[(i + 1) % 3]]);
            cross(to - from, point - from)
        });
        sides.iter().all(|&side| side >= 0.0) || sides.iter().all(|&side| side <= 0.0)
    };
    // A triangle without area holds all points of its line: distances tell whether those lie on its sides.
    let is_flat = |[a, b, c]: [usize; 3]| cross(area[b] - area[a], area[c] - area[a]) == 0.0;
    [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]].into_iter().any(|corners| !is_flat(corners) && is_in(corners))
}

/// Checks that no place of a rail is farther from a needle point than the advance of a stitch.
pub(super) fn judge(pattern: &Pattern, ground: &Ground, worst: &mut WorstByRule) {
    for seam in pattern.seams.iter().filter(|seam| seam.element == Element::Satin) {
        let pitch = seam.pitch.unwrap_or(ground.sewing.tack_pitch_mm);
        let reach = pitch + ground.sewing.min_pitch_mm + LOOK;
        let own = |op: Op, record: u32| op == Op::Stitch && record == seam.span.block;
        let needles = ground.stitches.steps.iter().filter(|step| own(step.op, step.record)).map(|step| step.to);
        let needles: Vec<Point> = needles.collect();
        let boxes = Boxes::new(needles.iter().map(|&at| Extent { min: at, max: at }.grown(reach)).collect());
        for rail in areas(seam).flat_map(|area| [[area[0], area[2]], [area[1], area[3]]]) {
            let way = rail[1] - rail[0];
            let looks = (way.norm() / pitch * LOOKS).ceil();
            for i in 0..=looks as usize {
                let place = rail[0] + way * (i as f64 / looks.max(1.0));
                let nearest = boxes.at(place).map(|i| (needles[i] - place).norm()).fold(reach, f64::min);
                worst.see(&rules::COVER, nearest - pitch, sighting(0, place));
            }
        }
    }
}
