//! Patterns that are placed in the field of the machine: by `sheet.*`, against `table.*` and the clamp.

use cutc::geom::{Extent, Point};
use cutc::machine::{Flip, Job, Mirror};
use cutc::sew::{Op, Program};

use super::{broken, fixture, plan, planned, written};

/// Box of the needle points.
fn extent(program: &Program) -> Extent {
    let pierced = program.stitches.steps.iter().filter(|step| step.op == Op::Stitch);
    Extent::of(&pierced.map(|step| step.to).collect::<Vec<_>>())
}

/// The points of the seams as they are sewn.
fn seams(program: &Program) -> Vec<Point> {
    let pattern = program.pattern.as_ref().expect("the file has seams");
    pattern.seams.iter().flat_map(|seam| seam.points.iter().copied()).collect()
}

#[test]
fn a_left_pocket_is_the_mirror_image_of_a_right_one() {
    let right = planned("sew/pocket.csv", &Job::default());
    let mut job = Job::default();
    job.profile.sheet.mirror = Mirror::Ends;
    let left = planned("sew/pocket.csv", &job);
    let [right, left] = [seams(&right), seams(&left)];
    let (drawn, laid) = (Extent::of(&right), Extent::of(&left));
    assert!((drawn.min - laid.min).norm().max((drawn.max - laid.max).norm()) < 1e-6, "{drawn:?} {laid:?}");
    let across = drawn.min.x + drawn.max.x;
    let away = right.iter().zip(&left).map(|(a, b)| (Point::new(across - a.x, a.y) - b).norm());
    assert!(away.fold(0.0, f64::max) < 1e-6);
}

#[test]
fn stitch_files_are_turned_moved_and_mirrored_and_proven() {
    for name in ["sew/seat.dst", "sew/three-seams.exp"] {
        let plain = extent(&planned(name, &Job::default()));
        let mut job = Job::default();
        (job.profile.sheet.rotate_deg, job.profile.sheet.origin) = (90.0, Some([5.0, 7.0]));
        job.profile.sheet.flip = Flip::Sides;
        let program = planned(name, &job);
        let laid = extent(&program);
        assert!((laid.min.x - plain.min.x - 5.0).abs().max((laid.min.y - plain.min.y - 7.0).abs()) < 1e-6, "{name}");
        let ((width, height), (long, wide)) = (plain.size(), laid.size());
        assert!((width - wide).abs().max((height - long).abs()) < 1e-6, "{name}");
        assert_eq!(broken(&program, &fixture(name), &job, ("exp", &written(&program, &job, "exp"))), [""; 0], "{name}");
        job.profile.sheet.copies = 2;
        let (none, said, _) = plan(name, fixture(name), &job);
        assert!(none.is_none() && said.contains("sheet/too-many-copies"), "{said}");
    }
}

#[test]
fn copies_of_a_pattern_lie_one_behind_the_other() {
    let once = planned("sew/pocket.csv", &Job::default());
    let mut job = Job::default();
    (job.profile.sheet.copies, job.profile.sheet.copies_gap_mm) = (3, 20.0);
    let program = planned("sew/pocket.csv", &job);
    assert_eq!(program.stitches.count(), 3 * once.stitches.count());
    let pitch = Extent::of(&seams(&once)).size().0 + 20.0;
    assert!((extent(&program).size().0 - extent(&once).size().0 - 2.0 * pitch).abs() < 1e-6);
    assert_eq!(broken(&program, &[], &job, ("dst", &written(&program, &job, "dst"))), [""; 0]);
}

#[test]
fn a_pattern_outside_the_field_or_larger_than_the_clamp_is_refused() {
    let (width, height) = extent(&planned("sew/pocket.csv", &Job::default())).size();
    let refused = |job: &Job| {
        let (program, said, _) = plan("sew/pocket.csv", fixture("sew/pocket.csv"), job);
        assert_eq!(program.is_none(), said.contains("sew/field"), "{said}");
        program.is_none()
    };
    let mut job = Job::default();
    job.profile.sewing.field_mm = Some([width, height]);
    assert!(!refused(&job));
    job.profile.sewing.field_mm = Some([width - 0.1, height]);
    assert!(refused(&job));
    let mut job = Job::default();
    job.profile.table.x_mm = Some([200.0, 205.0 + width]);
    assert!(refused(&job));
    job.profile.sheet.origin = None;
    assert!(!refused(&job));
}
