//! From the marker to raw toolpaths: drills, then notches, then contours of each piece, in cut order.

use crate::ir::Marker;
use crate::ir::list::Joint;
use crate::ir::marker::{Contour, Notch, Piece};
use crate::ir::toolpath::{Drill, End, Law, Pose, Run, Shape, Step, Toolpath};
use crate::machine::{Follow, Job};

/// The raw toolpath of each drill, notch and contour, in cut order: a contour is one run, not yet split, without
/// overlaps and without poses.
pub fn trace<'a>(marker: &'a Marker, job: &'a Job) -> impl Iterator<Item = Toolpath> + 'a {
    let tolerance = job.profile.tolerance(marker.unit);
    marker.pieces.iter().flat_map(move |piece| {
        let drills = piece.drills.iter().map(|d| Step::Drill(Drill { at: d.at, tool: d.tool, span: d.span }));
        let notches = piece.notches.iter().map(move |notch| Step::Run(notch_run(notch, job)));
        let contours = piece.contours.iter().map(move |contour| Step::Run(contour_run(marker, contour, job)));
        drills.chain(notches).chain(contours).map(move |step| toolpath(piece, tolerance, step))
    })
}

fn toolpath(piece: &Piece, tolerance: f64, step: Step) -> Toolpath {
    Toolpath { piece: piece.number, tolerance, entry: Pose::default(), steps: vec![step] }
}

/// A slit is cut from the edge inwards, without overlap at either end.
fn notch_run(notch: &Notch, job: &Job) -> Run {
    let bare = Joint { lift: true, full_advance: true, no_overcut: true };
    Run { points: vec![notch.root, notch.tip], spans: vec![notch.span], joints: vec![bare; 2], ..raw(Shape::Open, job) }
}

fn contour_run(marker: &Marker, contour: &Contour, job: &Job) -> Run {
    let (mut spans, mut joints) = (Vec::new(), Vec::new());
    for (_, segment) in marker.list.walk(contour.range) {
        spans.push(segment.span);
        joints.push(segment.joint);
    }
    // The end of a contour, closed or not, shares the joint of its first segment: there is no segment behind it.
    joints
        .push(Joint { no_overcut: joints[0].no_overcut, ..if contour.closed { joints[0] } else { Joint::default() } });
    let shape = if contour.closed { Shape::Ring } else { Shape::Open };
    Run { points: marker.points(contour), spans, joints, ..raw(shape, job) }
}

fn raw(shape: Shape, job: &Job) -> Run {
    Run {
        points: Vec::new(),
        spans: Vec::new(),
        joints: Vec::new(),
        shape,
        law: match job.profile.knife.follow {
            Follow::Tangent => Law::Tangent,
            Follow::Chord => Law::Chord,
        },
        front: 0.0,
        heel: 0.0,
        feed: job.profile.knife.feed_mm_s.unwrap_or(f64::INFINITY),
        ends: [End::default(); 2],
        start: Pose::default(),
        end: Pose::default(),
    }
}
