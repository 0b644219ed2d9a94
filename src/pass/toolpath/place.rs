//! Pass `place`: poses of the axes at the ends of each step, and the moves through the air between them.
//!
//! Needs runs with overlaps, and plunge cuts with their positions. Leaves every step with its nominal poses: C unwrapped, each
//! plunge at the equivalent of its heading that is nearest to the current C, inside `c.range_deg`. A turn or a travel precedes
//! each step that starts elsewhere. Smoothing changes the headings of runs a little; `plan` uses the actual ones.

use super::lap::{Lap, SLIM_MARGIN, Winding, half_turn};
use super::pass::ToolpathPass;
use super::scene::Scene;
use super::stretch::{REJOINED, Way};
use super::wind;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::{Heading, Point, Rotation, Vector, angle, polyline};
use crate::ir::toolpath::{Air, Edge, OrientationMode, PlungeCut, Pose, Run, Shape, Step, Toolpath};
use crate::machine::{Job, Knife};
use crate::units::{deg, number::fixed};

pub(super) const PASS: ToolpathPass =
    ToolpathPass { name: "place", about: "gives steps their poses and joins them through the air", run, chained: true };

fn run(toolpath: &mut Toolpath, scene: &Scene, diagnostics: &mut Diagnostics) {
    let job = scene.job;
    let mut pose = toolpath.entry;
    let mut at_corner = false;
    let mut placed = Vec::with_capacity(2 * toolpath.steps.len());
    for mut step in std::mem::take(&mut toolpath.steps) {
        let (start, end, corner) = match &mut step {
            Step::Run(run) => {
                place_run(run, pose.c, job, diagnostics);
                (run.start, run.end, run.ends[1].corner)
            }
            Step::PlungeCut(plunge_cut) => {
                place_plunge_cut(plunge_cut, pose.c, job, diagnostics);
                (plunge_cut.pose, plunge_cut.pose, plunge_cut.ends[1].corner)
            }
            Step::Drill(drill) => {
                let [x, y] = job.profile.drill.offset_mm;
                let there = Pose::new(drill.at.x - x, drill.at.y - y, pose.c.0);
                (there, there, false)
            }
            Step::Turn(_) | Step::Travel(_) => continue,
            Step::Event(_) => (pose, pose, false),
        };
        if start != pose {
            let air = Air { from: pose, to: start };
            placed.push(if at_corner { Step::Turn(air) } else { Step::Travel(air) });
        }
        placed.push(step);
        (pose, at_corner) = (end, corner);
    }
    toolpath.steps = placed;
}

/// Pose in which an edge of the blade cuts along a unit vector with its tip at a point.
fn pose_at(tip: Point, along: Vector, c: Rotation, edge: Edge, knife: &Knife) -> Pose {
    Pose { centre: tip - along * edge.lead(knife.ends()), c }
}

fn place_plunge_cut(plunge_cut: &mut PlungeCut, before: Rotation, job: &Job, diagnostics: &mut Diagnostics) {
    let heading = Heading::of(plunge_cut.along);
    let knife = &job.profile.knife;
    let tip = plunge_cut.pose.centre + plunge_cut.along * knife.radius();
    let (c, edge) = equivalent(before, heading, [0.0, 0.0], job).unwrap_or_else(|| {
        diagnostics.push(out_of_range(plunge_cut.spans[0]));
        (before.nearest(heading), Edge::Front)
    });
    (plunge_cut.pose, plunge_cut.edge) = (pose_at(tip, plunge_cut.along, c, edge, knife), edge);
}

fn place_run(run: &mut Run, before: Rotation, job: &Job, diagnostics: &mut Diagnostics) {
    let knife = &job.profile.knife;
    let n = run.points.len();
    let first = direction(run.points[0], run.points[1]);
    let last = direction(run.points[n - 2], run.points[n - 1]);
    // Angle of C at the plunge against the first chord.
    let plunge = match (run.shape, run.orientation) {
        (Shape::Ring, OrientationMode::Tangent) => -angle::turn(last, first) / 2.0,
        (Shape::Ring, OrientationMode::Chord) => chord_lag_back(&run.points, knife) - angle::turn(last, first),
        (Shape::Open, _) => chord_lag(&run.extended(), knife),
    };
    let Turned { all: turned, range } = Turned::along(run, plunge, knife);
    let heading = Heading::new(Heading::of(first).radians() + plunge);
    let (c, edge) = equivalent(before, heading, range.map(|r| r - plunge), job).unwrap_or_else(|| {
        let wound = fixed(deg(range[1] - range[0]), 1);
        let found = out_of_range(run.spans[0]).hint(format!("the run turns C through {wound} degrees"));
        diagnostics.push(match run.shape {
            Shape::Open => found,
            Shape::Ring => found.hint("a small hole is better drilled"),
        });
        (before.nearest(heading), Edge::Front)
    });
    run.edge = edge;
    let end_c = match (run.shape, run.orientation) {
        (_, OrientationMode::Tangent) => Rotation(c.0 - plunge + turned),
        (Shape::Ring, OrientationMode::Chord) => {
            let path = once_round(run);
            let turned: f64 = path.windows(3).map(|w| polyline::turn_at(w[0], w[1], w[2])).sum();
            Rotation(c.0 - plunge + turned + chord_lag_back(&path, knife))
        }
        (Shape::Open, OrientationMode::Chord) => {
            Rotation(c.0 - plunge + turned + chord_lag_back(&run.extended(), knife))
        }
    };
    let (tip, end) = match (run.shape, run.orientation) {
        (Shape::Ring, OrientationMode::Tangent) => (run.points[0], run.points[0] + first * run.front),
        (Shape::Ring, OrientationMode::Chord) => {
            let path = once_round(run);
            (run.points[0], path[path.len() - 1])
        }
        (Shape::Open, _) => {
            let extended = run.extended();
            let tip = polyline::first_at_distance(&extended, knife.width_mm)
                .map_or(extended[extended.len() - 1], |(point, _)| point);
            (tip, run.points[n - 1] + last * run.front)
        }
    };
    run.start = pose_at(tip, heading.unit(), c, edge, knife);
    run.end = pose_at(end, Rotation(end_c.0 - edge.turn()).unit(), end_c, edge, knife);
}

/// Rotation of C along a run, measured from its first chord, rad.
struct Turned {
    /// Total rotation at the lift.
    all: f64,
    /// Least and greatest rotation along the run.
    range: [f64; 2],
}

impl Turned {
    /// Rotation along a run whose plunge has C turned by `plunge`.
    fn along(run: &Run, plunge: f64, knife: &Knife) -> Self {
        let (mut all, mut range) = (0.0, [plunge.min(0.0), plunge.max(0.0)]);
        let mut last = 0.0;
        for w in run.points.windows(3) {
            last = polyline::turn_at(w[0], w[1], w[2]);
            all += last;
            range = [range[0].min(all), range[1].max(all)];
        }
        match run.shape {
            Shape::Open if run.ends[1] == REJOINED => {
                let beyond = all + half_turn(last);
                Self { all, range: [range[0].min(beyond), range[1].max(beyond)] }
            }
            Shape::Open => Self { all, range },
            Shape::Ring => {
                let n = run.points.len();
                let way = Way::new(run);
                let winding = Winding::new(run, &way, knife);
                let [low, high] = Lap { way: &way, winding: &winding, knife, orientation: run.orientation }.reach(0.0);
                let range = [low - winding.at(0) - SLIM_MARGIN, high - winding.at(0) + SLIM_MARGIN];
                Self { all: all + polyline::turn_at(run.points[n - 2], run.points[0], run.points[1]), range }
            }
        }
    }
}

/// Points of a ring from its start round to the end of its overlap.
fn once_round(run: &Run) -> Vec<Point> {
    let way = Way::new(run);
    way.part(0.0, way.length() + run.front, run.ends).points
}

fn direction(a: Point, b: Point) -> Vector {
    polyline::direction(a, b).expect("no chord of a run has length zero")
}

/// Angle between the chord of a blade whose tip is at the end of a path and the last chord of the path, rad, unwrapped.
fn chord_lag_back(path: &[Point], knife: &Knife) -> f64 {
    let back: Vec<Point> = path.iter().rev().copied().collect();
    chord_lag(&back, knife)
}

/// Angle between the chord of a blade whose heel is at the start of a path and the first chord of the path, rad, unwrapped.
fn chord_lag(path: &[Point], knife: &Knife) -> f64 {
    let Some((tip, chord)) = polyline::first_at_distance(path, knife.width_mm) else { return 0.0 };
    let first = direction(path[0], path[1]);
    let mut lag = 0.0;
    for &point in path[1..=chord].iter().chain(std::iter::once(&tip)) {
        if let Some(along) = polyline::direction(path[0], point) {
            lag += angle::wrap(angle::turn(first, along) - lag);
        }
    }
    lag
}

/// Position of C nearest to `before` at which an edge of the blade has `heading` and from which C may move through `range`
/// (rad) inside `c.range_deg`, if possible with a margin when it turns; `None` if there is none.
fn equivalent(before: Rotation, heading: Heading, range: [f64; 2], job: &Job) -> Option<(Rotation, Edge)> {
    let edges = if job.profile.knife.edges == 1 { &[Edge::Front][..] } else { &[Edge::Front, Edge::Back] };
    let [low, high] = range;
    let nearest = |range: [f64; 2]| {
        let of_edge = |&edge: &Edge| {
            let nearest = before.nearest(Heading::new(heading.radians() + edge.turn()));
            let found = match job.profile.blade_range() {
                Some(ends) => whole_turns(nearest, range, ends)?,
                None => nearest,
            };
            Some((found, edge))
        };
        let away = |found: &(Rotation, Edge)| (found.0.0 - before.0).abs();
        edges.iter().filter_map(of_edge).reduce(|a, b| if away(&b) + SAME_TURN < away(&a) { b } else { a })
    };
    let wide = [low - wind::MARGIN, high + wind::MARGIN];
    (high > low).then(|| nearest(wide)).flatten().or_else(|| nearest(range))
}

/// Equivalent of C by the fewest whole turns from which it can move through `range` between two ends, rad; `None` if there is
/// none.
fn whole_turns(nearest: Rotation, range: [f64; 2], [least, greatest]: [f64; 2]) -> Option<Rotation> {
    let turn = std::f64::consts::TAU;
    let up = ((least - range[0] - nearest.0) / turn - RANGE_EPSILON).ceil();
    let down = ((greatest - range[1] - nearest.0) / turn + RANGE_EPSILON).floor();
    (up <= down).then(|| Rotation(nearest.0 + turn * 0.0_f64.clamp(up, down)))
}

/// Difference of rotations that count as equal, rad; the front edge cuts then.
const SAME_TURN: f64 = 1e-9;
/// Share of a turn by which C may exceed its range through rounding.
const RANGE_EPSILON: f64 = 1e-9;

fn out_of_range(span: crate::source::Span) -> Diagnostic {
    Diagnostic::new(&code::PATH_C_RANGE, "no position of C inside c.range_deg lets the blade follow this run").at(span)
}
