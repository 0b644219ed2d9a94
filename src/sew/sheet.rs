//! Sheet: places a pattern, or needle points, in the field of the machine as the keys `sheet.*` ask.
//!
//! The lower left corner of the box of all seams or stitches stays where it is, except for `sheet.origin`; in the corner of the
//! field a seam leaves room for its width. Seams are copied along X; a file of stitches is placed once.

use super::pattern::{Element, Seam};
use super::read::Input;
use super::stitches::{Op, Step, Stitches};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Extent, Point};
use crate::machine::{AffineMap, Job, MachineProfile, Sewing};
use crate::units::number::fixed;

/// Decimals of lengths in messages, mm.
const DECIMALS: u32 = 1;
/// Distance by which a needle point may be outside the field, mm: rounding.
const FIELD_EPSILON: f64 = 1e-6;

/// Places seams or stitches; adds an error if they cannot be placed.
pub(super) fn place(input: &mut Input, job: &Job, out: &mut Diagnostics) {
    let (profile, drawn) = (&job.profile, extent(input));
    if drawn.is_empty() || profile.sheet.is_plain() {
        return;
    }
    if matches!(input, Input::Stitches(..)) && profile.sheet.copies > 1 {
        let message = format!("a file of stitches cannot be copied {} times", profile.sheet.copies);
        let hint = "repeat the design in the program that made it, or sew the file again";
        out.push(Diagnostic::new(&code::SHEET_COPIES, message).hint(hint));
        return;
    }
    lay(input, drawn, profile);
}

/// Box of all seams, or of all stitches.
fn extent(input: &Input) -> Extent {
    match input {
        Input::Pattern(pattern) => {
            let points: Vec<Point> = pattern.seams.iter().flat_map(|seam| seam.points.iter().copied()).collect();
            Extent::of(&points)
        }
        Input::Stitches(stitches, _) => of_needle(stitches),
    }
}

/// Box of all needle points.
fn of_needle(stitches: &Stitches) -> Extent {
    let pierced = stitches.steps.iter().filter(|step| step.op == Op::Stitch);
    Extent::of(&pierced.map(|step| step.to).collect::<Vec<_>>())
}

fn lay(input: &mut Input, drawn: Extent, profile: &MachineProfile) {
    let sheet = &profile.sheet;
    let turned = sheet.turned();
    move_points(input, &turned);
    let laid = extent(input);
    let corner = if let Some([x, y]) = sheet.origin {
        [drawn.min.x + x, drawn.min.y + y]
    } else {
        let room = room(input, &profile.sewing);
        [profile.table.x_mm, profile.table.y_mm].map(|ends| ends.map_or(0.0, |[least, _]| least) + room)
    };
    let by = [corner[0] - laid.min.x, corner[1] - laid.min.y];
    move_points(input, &AffineMap { axes: [[1.0, 0.0], [0.0, 1.0]], by });
    match input {
        Input::Pattern(pattern) => {
            let pitch = laid.size().0 + sheet.copies_gap_mm;
            let first = pattern.seams.clone();
            for copy in 1..sheet.copies {
                let map = AffineMap { axes: [[1.0, 0.0], [0.0, 1.0]], by: [f64::from(copy) * pitch, 0.0] };
                pattern
                    .seams
                    .extend(first.iter().map(|seam| Seam { points: moved(&seam.points, &map), ..seam.clone() }));
            }
        }
        Input::Stitches(stitches, _) => start_at(stitches, AffineMap { by, ..turned }.place([0.0; 2])),
    }
}

/// Greatest distance of a needle point from its seam, mm; 0 for a file of stitches.
fn room(input: &Input, sewing: &Sewing) -> f64 {
    let Input::Pattern(pattern) = input else { return 0.0 };
    let width = |seam: &Seam| match seam.element {
        Element::Straight | Element::BoxX | Element::Satin => 0.0,
        Element::Zigzag => seam.width.unwrap_or(sewing.zigzag_width_mm),
        Element::BarTack | Element::Eyelet => seam.width.unwrap_or(sewing.tack_width_mm),
    };
    pattern.seams.iter().map(|seam| width(seam) / 2.0).fold(0.0, f64::max)
}

/// Moves the needle to the image of the origin first if the file begins with a stitch, whose length it keeps.
fn start_at(stitches: &mut Stitches, [x, y]: [f64; 2]) {
    let to = Point::new(x, y);
    if let Some(first) = stitches.steps.first().filter(|first| first.op == Op::Stitch && to != Point::origin()) {
        stitches.steps.insert(0, Step { op: Op::Jump, to, is_tie: false, record: first.record });
    }
}

fn move_points(input: &mut Input, map: &AffineMap) {
    match input {
        Input::Pattern(pattern) => pattern.seams.iter_mut().for_each(|seam| seam.points = moved(&seam.points, map)),
        Input::Stitches(stitches, _) => stitches.steps.iter_mut().for_each(|step| step.to = image(step.to, map)),
    }
}

fn moved(points: &[Point], map: &AffineMap) -> Vec<Point> {
    points.iter().map(|&point| image(point, map)).collect()
}

fn image(point: Point, map: &AffineMap) -> Point {
    let [x, y] = map.place([point.x, point.y]);
    Point::new(x, y)
}

/// Adds an error for needle points outside the field, or farther apart than the clamp is wide.
pub(super) fn hold_against_field(stitches: &Stitches, profile: &MachineProfile, out: &mut Diagnostics) {
    let laid = of_needle(stitches);
    let corners = [laid.min, laid.max].map(|corner| [corner.x, corner.y]);
    let off = corners.map(|corner| profile.table.off(corner)).into_iter().fold(f64::NEG_INFINITY, f64::max);
    if off > FIELD_EPSILON {
        let [from, to] = corners.map(|[x, y]| format!("{}, {}", fixed(x, DECIMALS), fixed(y, DECIMALS)));
        let message = format!("the pattern lies from {from} to {to} mm, {} mm outside the field", fixed(off, DECIMALS));
        let hint = "`--set sheet.origin=corner` moves it into the field (`table.x_mm`, `table.y_mm`)";
        out.push(Diagnostic::new(&code::SEW_FIELD, message).hint(hint));
    }
    let (width, height) = laid.size();
    if let Some([x, y]) = profile.sewing.field_mm.filter(|[x, y]| (width - x).max(height - y) > FIELD_EPSILON) {
        let [width, height, x, y] = [width, height, x, y].map(|mm| fixed(mm, DECIMALS));
        let message = format!("the pattern of {width} x {height} mm is larger than the clamp of {x} x {y} mm");
        let hint = "turn it (`sheet.rotate_deg`), or sew it in parts; `sewing.field_mm` is the opening of the clamp";
        out.push(Diagnostic::new(&code::SEW_FIELD, message).hint(hint));
    }
}
