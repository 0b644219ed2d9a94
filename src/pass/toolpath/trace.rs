//! From the marker to raw toolpaths: events, drills, then notches, then contours of each piece, in cut order.
//!
//! The file's speeds become the caps of a run, chord by chord.

use super::notches;
use crate::ir::Marker;
use crate::ir::list::{FULL_SPEED, Joint, Segment};
use crate::ir::marker::{Contour, Event, Notch, OutlineNotch, Piece, Stroke};
use crate::ir::toolpath::{Drill, Edge, End, Law, Pose, Run, Shape, Step, Toolpath};
use crate::machine::{Follow, Job, NotchStyle, Notches};

/// The raw toolpath of each drill, notch and contour, in cut order: a contour is one run, not yet split, without
/// overlaps and without poses. An event stands alone, between the pieces or behind the last.
pub fn trace<'a>(marker: &'a Marker, job: &'a Job) -> impl Iterator<Item = Toolpath> + 'a {
    let tolerance = job.profile.tolerance(marker.unit);
    let last = marker.pieces.last().map_or(0, |piece| piece.number);
    let pieces = marker.pieces.iter().zip(0..).flat_map(move |(piece, part)| {
        let events = piece.events.iter().map(event);
        let drills = piece.drills.iter().map(|d| Step::Drill(Drill { at: d.at, tool: d.tool, span: d.span }));
        let style = job.profile.notch;
        let strokes = move |notch: &Notch| {
            notches::strokes(notch, style).map({
                let percent = notch.percent;
                move |stroke| (percent, stroke)
            })
        };
        let drawn = piece.contours.iter().map(|contour| outline(marker, piece, contour, style));
        let (outlines, bridged): (Vec<_>, Vec<_>) = drawn.unzip();
        let slits = bridged.into_iter().flatten();
        let slits = slits.map(move |(notch, percent)| (percent, notches::slit(&notch, style)));
        let slits = slits.filter(move |_| style.style == NotchStyle::Slit);
        let notches = piece.notches.iter().flat_map(strokes).chain(slits);
        let notches =
            notches.map(move |(percent, stroke)| Step::Run(notch_run(&stroke, feed(piece, percent, job), job)));
        let contours = outlines.into_iter().zip(&piece.contours);
        let contours =
            contours.map(move |(outline, contour)| Step::Run(contour_run(&outline, contour.closed, piece, job)));
        events
            .chain(drills)
            .chain(notches)
            .chain(contours)
            .map(move |step| toolpath([piece.number, part], tolerance, step))
    });
    pieces.chain(marker.closing.iter().map(move |closing| toolpath([last, 0], tolerance, event(closing))))
}

fn event(event: &Event) -> Step {
    Step::Event(event.kind)
}

/// The toolpath of a piece, by its number and its place in the marker.
fn toolpath([piece, part]: [u32; 2], tolerance: f64, step: Step) -> Toolpath {
    Toolpath { piece, part, tolerance, entry: Pose::default(), steps: vec![step] }
}

/// A slit is cut from the edge inwards, its crossbar as it is written, both without overlap at either end.
fn notch_run(stroke: &Stroke, feed: f64, job: &Job) -> Run {
    let bare = Joint { lift: true, full_advance: true, no_overcut: true };
    let points = vec![stroke.from, stroke.to];
    Run { points, spans: vec![stroke.span], joints: vec![bare; 2], feeds: vec![feed], ..raw(Shape::Open, job) }
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

/// A contour in the style of the profile, with the notches that it no longer has and their speed in percent.
fn outline(
    marker: &Marker,
    piece: &Piece,
    contour: &Contour,
    style: Notches,
) -> (Vec<Segment>, Vec<(OutlineNotch, u8)>) {
    let mut outline: Vec<Segment> = marker.list.walk(contour.range).map(|(_, segment)| segment).collect();
    let bridged = match style.style {
        NotchStyle::AsDrawn => Vec::new(),
        NotchStyle::Slit | NotchStyle::Skip => notches::bridge(&mut outline, &piece.outline_notches),
    };
    (outline, bridged)
}

/// The run of a contour, each segment with its greatest speed.
fn contour_run(outline: &[Segment], closed: bool, piece: &Piece, job: &Job) -> Run {
    let mut points = vec![outline[0].from];
    points.extend(outline.iter().map(|segment| segment.to));
    let mut joints: Vec<Joint> = outline.iter().map(|segment| segment.joint).collect();
    // The end of a contour, closed or not, shares the joint of its first segment: there is no segment behind it.
    joints.push(Joint { no_overcut: joints[0].no_overcut, ..if closed { joints[0] } else { Joint::default() } });
    Run {
        points,
        spans: outline.iter().map(|segment| segment.span).collect(),
        joints,
        feeds: outline.iter().map(|segment| feed(piece, segment.percent, job)).collect(),
        ..raw(if closed { Shape::Ring } else { Shape::Open }, job)
    }
}

fn raw(shape: Shape, job: &Job) -> Run {
    Run {
        points: Vec::new(),
        spans: Vec::new(),
        joints: Vec::new(),
        shape,
        law: match job.profile.knife.follow {
            // A point is no chord of anything.
            Follow::Chord if job.profile.knife.width_mm > 0.0 => Law::Chord,
            Follow::Chord | Follow::Tangent => Law::Tangent,
        },
        front: 0.0,
        heel: 0.0,
        feeds: Vec::new(),
        ends: [End::default(); 2],
        turned: false,
        edge: Edge::Front,
        start: Pose::default(),
        end: Pose::default(),
    }
}
