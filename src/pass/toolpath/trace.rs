//! Conversion of the marker into raw toolpaths: for each piece events, then drills, then cuts, in cut order.
//!
//! The speeds in the file become the caps of a run, chord by chord.

use crate::ir::Marker;
use crate::ir::list::{FULL_SPEED, Joint, Segment};
use crate::ir::marker::{Cut, Event, Piece};
use crate::ir::toolpath::{Drill, Edge, End, OrientationMode, Pose, Run, Shape, Step, Toolpath};
use crate::machine::{Follow, Job};

/// Raw toolpath of each drill and cut, in cut order. A cut is one run, not yet split, without overlaps and poses. An event is a
/// toolpath of its own, between pieces or after the last.
pub fn trace<'a>(marker: &'a Marker, job: &'a Job) -> impl Iterator<Item = Toolpath> + 'a {
    let tolerance = job.profile.tolerance(marker.unit);
    let last = marker.pieces.iter().zip(0..).last().map_or([0; 2], |(piece, part)| [piece.number, part]);
    let pieces = marker.pieces.iter().zip(0..).flat_map(move |(piece, part)| {
        let events = piece.events.iter().map(event);
        let drills = piece.drills.iter().map(|d| Step::Drill(Drill { at: d.at, tool: d.tool, span: d.span }));
        let cuts = marker.cuts_of(part).iter().map(move |cut| Step::Run(run(marker, piece, cut, job)));
        events.chain(drills).chain(cuts).map(move |step| toolpath([piece.number, part], tolerance, step))
    });
    pieces.chain(marker.closing.iter().map(move |closing| toolpath(last, tolerance, event(closing))))
}

fn event(event: &Event) -> Step {
    Step::Event(event.kind)
}

/// Toolpath with one step, of the piece with this number and index in the marker.
fn toolpath([piece, part]: [u32; 2], tolerance: f64, step: Step) -> Toolpath {
    Toolpath { piece, part, tolerance, entry: Pose::default(), steps: vec![step] }
}

/// Speed cap of a cut, mm/s. A percentage needs a speed to refer to: without a feed that is the speed of the slower of the two
/// axes, which the tip can always reach.
fn feed(piece: &Piece, percent: u8, job: &Job) -> f64 {
    let profile = &job.profile;
    let feed = profile.knife.feed_mm_s.unwrap_or(f64::INFINITY).min(piece.feed.unwrap_or(f64::INFINITY));
    if percent >= FULL_SPEED {
        return feed;
    }
    let [x, y, _] = profile.axes.limits();
    feed.min(x.speed).min(y.speed) * f64::from(percent) / f64::from(FULL_SPEED)
}

/// Run of a cut, with the greatest speed of each segment.
fn run(marker: &Marker, piece: &Piece, cut: &Cut, job: &Job) -> Run {
    let segments: Vec<Segment> = marker.list.walk(cut.range).map(|(_, segment)| segment).collect();
    let mut points = vec![segments[0].from];
    points.extend(segments.iter().map(|segment| segment.to));
    let mut joints: Vec<Joint> = segments.iter().map(|segment| segment.joint).collect();
    let closed = cut.kind.is_closed();
    // The end of a cut, closed or not, shares the joint of its first segment: no segment follows it.
    joints.push(Joint { no_overcut: joints[0].no_overcut, ..if closed { joints[0] } else { Joint::default() } });
    Run {
        points,
        spans: segments.iter().map(|segment| segment.span).collect(),
        joints,
        feeds: segments.iter().map(|segment| feed(piece, segment.percent, job)).collect(),
        ..raw(if closed { Shape::Ring } else { Shape::Open }, job)
    }
}

fn raw(shape: Shape, job: &Job) -> Run {
    Run {
        points: Vec::new(),
        spans: Vec::new(),
        joints: Vec::new(),
        shape,
        orientation: match job.profile.knife.follow {
            // A blade of zero width cannot be a chord.
            Follow::Chord if job.profile.knife.width_mm > 0.0 => OrientationMode::Chord,
            Follow::Chord | Follow::Tangent => OrientationMode::Tangent,
        },
        front: 0.0,
        heel: 0.0,
        feeds: Vec::new(),
        junctions: Vec::new(),
        ends: [End::default(); 2],
        turned: false,
        edge: Edge::Front,
        start: Pose::default(),
        end: Pose::default(),
    }
}
