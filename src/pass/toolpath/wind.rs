//! Pass `wind`: a run that winds C past `c.range_deg` is lifted where it would, and goes on with C unwound in the air.
//!
//! Needs runs split at corners. Leaves runs of which every chord can be cut at one equivalent of C inside the range,
//! wherever the run starts; as few of them as that takes. A run is parted at a vertex, like at a corner, but its overlaps
//! there are only so long that, straight on, they stay within a part of the tolerance of the path.

use super::ToolpathPass;
use super::scene::Scene;
use crate::diagnostic::Diagnostics;
use crate::geom::{Heading, Point, polyline};
use crate::ir::toolpath::{End, Run, Shape, Side, Step, Toolpath};
use crate::machine::Knife;

pub(super) const PASS: ToolpathPass =
    ToolpathPass { name: "wind", about: "lifts runs that wind C past its range, to unwind in the air", run };

/// How far C stays away from the ends of its range where a run is parted, rad (5 degrees): smoothing turns the blade a
/// little beyond the direction of its last chord. A range that is too narrow for that is used up to its ends.
const MARGIN: f64 = 0.087_266_462_599_716_47;
/// Part of the tolerance by which an overlap may leave the path; smoothing moves the tip by up to the rest.
const SHARE: f64 = 0.4;
/// Rounding of an angle, rad.
const ANGLE_EPSILON: f64 = 1e-9;
/// Where a run is parted: its overlap is drawn already.
const PARTED: End = End { corner: true, bare: true, side: Side::Waste };

fn run(toolpath: &mut Toolpath, scene: &Scene, _: &mut Diagnostics) {
    let Some(range) = scene.job.profile.blade_range() else { return };
    let (knife, allowance) = (&scene.job.profile.knife, SHARE * toolpath.tolerance);
    for step in std::mem::take(&mut toolpath.steps) {
        match step {
            Step::Run(run) => {
                let cuts = parts(&run, range);
                if let [_] = cuts[..] {
                    toolpath.steps.push(Step::Run(run));
                } else {
                    let part = |ends: &[usize; 2]| Step::Run(part(&run, *ends, &Overlap { knife, allowance }));
                    toolpath.steps.extend(cuts.iter().map(part));
                }
            }
            Step::Stab(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {
                toolpath.steps.push(step);
            }
        }
    }
}

/// The directions of the chords, unwrapped, rad.
fn headings(run: &Run) -> Vec<f64> {
    let mut heading = Heading::of(run.points[1] - run.points[0]).radians();
    let turns = run.points.windows(3).map(|w| polyline::turn_at(w[0], w[1], w[2]));
    let mut headings = vec![heading];
    headings.extend(turns.map(|turn| {
        heading += turn;
        heading
    }));
    headings
}

/// The first chord of each part and the one behind its last; one part when the run need not be parted, or cannot.
fn parts(run: &Run, range: [f64; 2]) -> Vec<[usize; 2]> {
    let headings = headings(run);
    let count = headings.len();
    // Round a ring the last chord turns on to the first one.
    let lap = usize::from(run.shape == Shape::Ring);
    let closing = polyline::turn_at(run.points[count - 1], run.points[0], run.points[1]);
    let whole = [&headings[..], &[headings[count - 1] + closing][..lap]].concat();
    if reach(&whole, range) == Some(whole.len()) {
        return vec![[0, count]];
    }
    let [least, greatest] = range;
    let inner = [least + MARGIN, greatest - MARGIN];
    let mut parts = Vec::new();
    let mut from = 0;
    while from < count {
        let Some(chords) = reach(&headings[from..], inner).or_else(|| reach(&headings[from..], range)) else {
            return vec![[0, count]];
        };
        parts.push([from, from + chords]);
        from += chords;
    }
    parts
}

/// How many chords can be cut before C leaves its range, from the equivalent of the first that goes on longest; `None` when
/// not even the first is in the range.
fn reach(headings: &[f64], [least, greatest]: [f64; 2]) -> Option<usize> {
    let turn = std::f64::consts::TAU;
    let first = ((least - headings[0]) / turn - ANGLE_EPSILON).ceil();
    let last = ((greatest - headings[0]) / turn + ANGLE_EPSILON).floor();
    let is_in = |c: f64| (least - ANGLE_EPSILON..=greatest + ANGLE_EPSILON).contains(&c);
    // Of all equivalents the first or the last goes on longest, unless the way swings both ways; few are legal at all.
    let turns = (0..=(last - first).max(-1.0) as i64).filter(|_| first <= last).map(|k| first + k as f64);
    turns.map(|k| headings.iter().take_while(|&&heading| is_in(heading + k * turn)).count()).max()
}

/// How long overlaps are where a run is parted.
struct Overlap<'a> {
    knife: &'a Knife,
    /// How far they may leave the path, mm.
    allowance: f64,
}

impl Overlap<'_> {
    /// The end of an overlap of `wanted` mm, straight on from `from` over `at`, where the path turns by `turn`.
    fn beyond(&self, [from, at]: [Point; 2], turn: f64, wanted: f64) -> Option<Point> {
        let length = wanted.min(self.allowance / turn.abs().sin());
        let along = polyline::direction(from, at).filter(|_| length > 0.0);
        along.map(|along| at + along * length)
    }
}

/// The chords from one to another of a run.
fn part(run: &Run, [from, to]: [usize; 2], overlap: &Overlap) -> Run {
    let chords = run.points.len() - 1;
    let is_ring = run.shape == Shape::Ring;
    let turn = |vertex: usize| {
        let before = if vertex == 0 { chords - 1 } else { vertex - 1 };
        let behind = vertex % chords;
        polyline::turn_at(run.points[before], run.points[behind], run.points[behind + 1])
    };
    let parted = [from > 0 || is_ring, to < chords || is_ring];
    let mut part = Run {
        points: run.points[from..=to].to_vec(),
        spans: run.spans[from..to].to_vec(),
        joints: run.joints[from..=to].to_vec(),
        feeds: run.feeds[from..to].to_vec(),
        shape: Shape::Open,
        ends: [0, 1].map(|end| if parted[end] { PARTED } else { run.ends[end] }),
        ..*run
    };
    let n = part.points.len();
    let knife = overlap.knife;
    if parted[1]
        && let Some(tip) =
            overlap.beyond([part.points[n - 2], part.points[n - 1]], turn(to), knife.corner_front_overlap_mm)
    {
        part.points.push(tip);
        part.spans.push(part.spans[n - 2]);
        part.feeds.push(part.feeds[n - 2]);
        part.joints.push(part.joints[n - 1]);
    }
    if parted[0]
        && let Some(tail) = overlap.beyond([part.points[1], part.points[0]], turn(from), knife.corner_heel_overlap_mm)
    {
        part.points.insert(0, tail);
        part.spans.insert(0, part.spans[0]);
        part.feeds.insert(0, part.feeds[0]);
        part.joints.insert(0, part.joints[0]);
    }
    part
}
