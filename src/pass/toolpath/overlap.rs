//! Pass `overlap`: how far the blade goes past the ends of each run.
//!
//! Needs runs split at corners. Leaves every run with its overlaps, each straight on beyond its end: as far as the profile
//! wants where that is waste, by `knife.reflex_front_overlap_mm` and `knife.reflex_heel_overlap_mm` where it is the part
//! itself (a reflex corner, the inner end of a slit), and shortened to the gap less `knife.clearance_mm` where a part lies
//! ahead. A run that begins on a curve has only as much of its heel overlap as keeps the plunged blade near its start. After
//! Wang, Zhang & Zhao, *Research on Cutter Knife Tangent Following and Compensating Algorithm*, 2013,
//! doi 10.7690/bgzdh.2013.02.026.

use super::ToolpathPass;
use super::scene::{Around, Scene};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::region::Ray;
use crate::geom::{Extent, Point, Vector, polyline};
use crate::ir::toolpath::{End, Run, Shape, Side, Step, Toolpath};
use crate::machine::Knife;
use crate::source::Span;
use crate::units::number::fixed;

pub(super) const PASS: ToolpathPass = ToolpathPass {
    name: "overlap",
    about: "gives runs their overlaps, as far as there is waste for them",
    run,
    chained: false,
};

/// A way that enters the part within this length begins in it, mm: rounding.
pub(super) const INSIDE_EPSILON: f64 = 1e-6;
/// Part of the tolerance by which the plunged blade may pass the start of its run.
const PASSING_SHARE: f64 = 0.9;
/// A shorter overlap is none, mm: rounding, which must not become a chord of the path.
const OVERLAP_EPSILON: f64 = 1e-6;

fn run(toolpath: &mut Toolpath, scene: &Scene, diagnostics: &mut Diagnostics) {
    let around = scene.around(toolpath);
    let mut shortened = Shortened::default();
    for step in &mut toolpath.steps {
        match step {
            Step::Run(run) => {
                let missing = give(run, &around);
                shortened.add(missing[0], run.spans[0]);
                shortened.add(missing[1], run.spans[run.spans.len() - 1]);
                if run.shape == Shape::Ring {
                    warn_if_tight(run, around.knife(), diagnostics);
                }
            }
            Step::Stab(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {}
        }
    }
    shortened.report(toolpath.piece, diagnostics);
}

/// Gives a run the overlaps that the profile has for its ends, as far as there is room; how much is missing at each, mm.
pub(super) fn give(run: &mut Run, around: &Around) -> [f64; 2] {
    let knife = around.knife();
    let [start, end] = run.ends;
    let heel = if start.corner { knife.corner_heel_overlap_mm } else { knife.heel_overlap_mm };
    let front = if end.corner { knife.corner_front_overlap_mm } else { knife.front_overlap_mm };
    if run.shape == Shape::Ring {
        // Once more round would cut nothing new.
        (run.heel, run.front) = (0.0, if end.bare { 0.0 } else { front.min(polyline::length(&run.points)) });
        return [0.0; 2];
    }
    let n = run.points.len();
    let direction = |a: usize, b: usize| {
        polyline::direction(run.points[a], run.points[b]).expect("no chord of a run has length zero")
    };
    let ahead = |end: End, wanted: Wanted, [at, before]: [usize; 2]| {
        if end.bare {
            return Given { side: end.side, ..Given::default() };
        }
        wanted.give(run.points[at], direction(before, at), around)
    };
    let heel = ahead(start, Wanted { waste: heel, part: knife.reflex_heel_overlap_mm }, [0, 1]);
    let front = ahead(end, Wanted { waste: front, part: knife.reflex_front_overlap_mm }, [n - 1, n - 2]);
    (run.heel, run.front) = (heel.length, front.length);
    (run.ends[0].side, run.ends[1].side) = (heel.side, front.side);
    run.heel *= heel_share(run, around);
    [heel.missing, front.missing]
}

/// The part of a heel overlap with which the plunged blade passes the start of its run within the tolerance. A curve turns the
/// blade away from its first chord, along which the overlap lies: with all of it the blade would cut into the corner.
fn heel_share(run: &Run, around: &Around) -> f64 {
    let (width, allowed) = (around.knife().width_mm, PASSING_SHARE * around.tolerance());
    // It turns the blade by no more than the run turns under it.
    if run.heel == 0.0 || run.heel >= width || run.heel * polyline::turn_within(&run.points, width) <= allowed {
        return 1.0;
    }
    let near = run.points.iter().position(|point| (point - run.points[0]).norm() > width);
    let under = &run.points[..near.map_or(run.points.len(), |near| near + 1)];
    let along = polyline::direction(run.points[0], run.points[1]).expect("no chord of a run has length zero");
    let path: Vec<Point> = std::iter::once(run.points[0] - along * run.heel).chain(under.iter().copied()).collect();
    let Some((tip, _)) = polyline::first_at_distance(&path, width) else { return 1.0 };
    (allowed / polyline::distance_to_segment(run.points[0], path[0], tip)).min(1.0)
}

/// How long an overlap should be, mm: in the waste and in the part.
struct Wanted {
    waste: f64,
    part: f64,
}

/// How long an overlap is, mm, where it goes, and how much is missing for want of room.
#[derive(Default)]
struct Given {
    length: f64,
    side: Side,
    missing: f64,
}

impl Wanted {
    fn give(&self, from: Point, along: Vector, around: &Around) -> Given {
        let clearance = around.knife().clearance_mm;
        let reach = self.waste.max(self.part) + clearance;
        if reach == 0.0 {
            return Given::default();
        }
        let room = around.room(&Ray { from, along, reach });
        let inside = room.own <= INSIDE_EPSILON;
        let (wanted, gap) = if inside { (self.part, room.other) } else { (self.waste, room.least()) };
        let length = wanted.min(gap - clearance);
        let length = if length > OVERLAP_EPSILON { length } else { 0.0 };
        let side = match (inside, length < wanted) {
            (true, _) => Side::Part,
            (false, true) => Side::Gap,
            (false, false) => Side::Waste,
        };
        Given { length, side, missing: wanted - length }
    }
}

/// The overlaps of a toolpath that are shorter than the profile wants them.
#[derive(Default)]
struct Shortened {
    count: usize,
    worst: f64,
    span: Span,
}

impl Shortened {
    fn add(&mut self, missing: f64, span: Span) {
        if missing > 0.0 {
            self.count += 1;
            if missing > self.worst {
                (self.worst, self.span) = (missing, span);
            }
        }
    }

    fn report(&self, piece: u32, diagnostics: &mut Diagnostics) {
        let by = fixed(self.worst, 2);
        let message = match self.count {
            0 => return,
            1 => format!("an overlap of piece {piece} is shortened by {by} mm: the next part is too near"),
            n => format!("{n} overlaps of piece {piece} are shortened, the most by {by} mm: the next part is too near"),
        };
        diagnostics.push(
            Diagnostic::new(&code::PATH_SHORTENED, message)
                .at(self.span)
                .by(self.worst)
                .hint("leave more room between the parts, or take smaller overlaps"),
        );
    }
}

fn warn_if_tight(run: &Run, knife: &Knife, diagnostics: &mut Diagnostics) {
    let (width, height) = Extent::of(&run.points).size();
    if width.max(height) < knife.width_mm {
        let size = format!("{} x {} mm", fixed(width, 2), fixed(height, 2));
        diagnostics.push(
            Diagnostic::new(
                &code::PATH_TIGHT,
                format!("a smooth contour of {size} is narrower than the blade of {} mm", fixed(knife.width_mm, 2)),
            )
            .at(run.spans[0])
            .hint("a hole of this size is better drilled; of a plot, `hpgl.drill_max_mm` in the profile asks for that"),
        );
    }
}
