//! From the marker to raw toolpaths: events, then drills, then cuts of each piece, in cut order.
//!
//! The file's speeds become the caps of a run, chord by chord.

use crate::ir::Marker;
use crate::ir::list::{FULL_SPEED, Joint, Segment};
use crate::ir::marker::{Cut, Event, Piece};
use crate::ir::toolpath::{Drill, Edge, End, OrientationMode, Pose, Run, Shape, Step, Toolpath};
use crate::machine::{Follow, Job};

/// The raw toolpath of each drill and cut, in cut order: a cut is one run, not yet split, without overlaps and without
/// poses. An event stands alone, between the pieces or behind the last.
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

/// The toolpath of a piece, by its number and its place in the marker.
fn toolpath([piece, part]: [u32; 2], tolerance: f64, step: Step) -> Toolpath {
    Toolpath { piece, part, tolerance, entry: Pose::default(), steps: vec![step] }
}

/// The cap of a cut, mm/s. A slowed cut needs something to be slower than: without any feed that is the slower of the two
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

/// The run of a cut, each segment with its greatest speed.
fn run(marker: &Marker, piece: &Piece, cut: &Cut, job: &Job) -> Run {
    let segments: Vec<Segment> = marker.list.walk(cut.range).map(|(_, segment)| segment).collect();
    let mut points = vec![segments[0].from];
    points.extend(segments.iter().map(|segment| segment.to));
    let mut joints: Vec<Joint> = segments.iter().map(|segment| segment.joint).collect();
    let closed = cut.kind.is_closed();
    // The end of a cut, closed or not, shares the joint of its first segment: there is no segment behind it.
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
            // A point is no chord of anything.
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
