//! The layer of the knife: for each toolpath a group of cuts, overlaps, plunges, lifts, holes and travels.

use super::markup::{PathData, blocks, escape};
use crate::geom::{Point, Vector, left, polyline};
use crate::ir::toolpath::{Edge, Event, OrientationMode, Overcut, Pose, Run, Shape, Step, Toolpath};
use crate::machine::Knife;
use crate::source::Span;
use crate::units::number::fixed;

/// Radii of symbols, in blade widths: small enough to keep a corner with two plunges readable.
const PLUNGE_RADIUS: f64 = 0.05;
const LIFT_RADIUS: f64 = 0.03;
const DRILL_RADIUS: f64 = 0.5;
const EVENT_RADIUS: f64 = 0.6;
/// Half the thickness of a blade and of an overlap, in blade widths: visible when zoomed, otherwise a line.
const BLADE_HALF_THICKNESS: f64 = 0.02;
const OVERLAP_HALF_THICKNESS: f64 = 0.012;
/// Minimum width for sizing symbols, mm; a narrower blade, or a point, gets symbols of this size.
const LEAST_WIDTH: f64 = 3.0;
/// Length below which an overlap is rounding, mm: far below the visible.
const OVERLAP_EPSILON: f64 = 1e-6;

/// Width that the symbols are scaled by, mm.
pub(super) fn symbol_width(knife: &Knife) -> f64 {
    knife.width_mm.max(LEAST_WIDTH)
}

/// The paths drawn once for a whole toolpath, and the single cuts.
struct Group<'a> {
    knife: &'a Knife,
    unit: f64,
    cuts: String,
    air: PathData,
    over: PathData,
    overcut: PathData,
    blade: PathData,
    plunge: PathData,
    lift: PathData,
}

/// The group of a toolpath.
pub(super) fn group(toolpath: &Toolpath, knife: &Knife) -> String {
    let mut group = Group {
        knife,
        unit: symbol_width(knife),
        cuts: String::new(),
        air: PathData::default(),
        over: PathData::default(),
        overcut: PathData::default(),
        blade: PathData::default(),
        plunge: PathData::default(),
        lift: PathData::default(),
    };
    let mut pose = toolpath.entry;
    for step in &toolpath.steps {
        group.step(step, pose);
        pose = match step {
            Step::Run(run) => run.end,
            Step::PlungeCut(plunge_cut) => plunge_cut.pose,
            Step::Turn(air) | Step::Travel(air) => air.to,
            Step::Drill(_) | Step::Event(_) => pose,
        };
    }
    let name = format!("piece {} {}", toolpath.piece, kind(toolpath));
    let title = format!("{name}{}{}", blocks(toolpath.steps.iter().flat_map(spans).copied()), count(toolpath));
    let mut text = format!(
        "<g class=\"n{}\" inkscape:label=\"{}\"><title>{}</title>\n",
        toolpath.piece,
        escape(&name),
        escape(&title)
    );
    text.push_str(&group.air.element("air"));
    text.push_str(&group.cuts);
    for (data, class) in [
        (&group.over, "over"),
        (&group.overcut, "harm"),
        (&group.blade, "blade"),
        (&group.plunge, "plunge"),
        (&group.lift, "lift"),
    ] {
        text.push_str(&data.element(class));
    }
    text.push_str("</g>\n");
    text
}

impl Group<'_> {
    fn step(&mut self, step: &Step, pose: Pose) {
        match step {
            Step::Run(run) => self.run(run),
            Step::PlungeCut(plunge_cut) => {
                let (heel, tip) = self.ends(&plunge_cut.pose, plunge_cut.edge);
                let mut data = PathData::default();
                data.polygon(self.blade_outline(&plunge_cut.pose));
                let length = polyline::length(&plunge_cut.points);
                let title = cut_title("stab", length, &plunge_cut.spans)
                    + &way_round(plunge_cut.turned)
                    + by_edge(plunge_cut.edge)
                    + &overcut(plunge_cut.overcut);
                self.cuts.push_str(&data.titled("stab", &title));
                let half = OVERLAP_HALF_THICKNESS * self.unit;
                let last = plunge_cut.points[plunge_cut.points.len() - 1];
                let ends = [([heel, plunge_cut.points[0]], plunge_cut.heel), ([last, tip], plunge_cut.front)];
                for ((way, length), overcut) in ends.into_iter().zip(plunge_cut.overcut) {
                    let class = if overcut.deepest() > 0.0 { &mut self.overcut } else { &mut self.over };
                    overlap(class, &way, [length, half]);
                }
                self.plunge.circle(tip, PLUNGE_RADIUS * self.unit);
                self.lift.circle(tip, LIFT_RADIUS * self.unit);
            }
            Step::Turn(air) | Step::Travel(air) => self.air.line([air.from.centre, air.to.centre]),
            Step::Drill(drill) => {
                let radius = DRILL_RADIUS * self.unit;
                let mut data = PathData::default();
                data.circle(drill.at, radius);
                for arm in [Vector::new(1.6 * radius, 0.0), Vector::new(0.0, 1.6 * radius)] {
                    data.line([drill.at - arm, drill.at + arm]);
                }
                let title = format!("drill {}{}", drill.tool, blocks([drill.span]));
                self.cuts.push_str(&data.titled("drill", &title));
            }
            Step::Event(event) => {
                let (at, r) = (pose.centre, EVENT_RADIUS * self.unit);
                let mut data = PathData::default();
                data.polygon([(r, 0.0), (0.0, r), (-r, 0.0), (0.0, -r)].map(|(x, y)| at + Vector::new(x, y)));
                let title = match event {
                    Event::Stop => "stop: wait for the operator".to_owned(),
                    Event::Advance => "advance the cloth".to_owned(),
                    Event::AdvanceBy(mm) => format!("advance the cloth by {mm} mm"),
                };
                self.cuts.push_str(&data.titled("event", &title));
            }
        }
    }

    fn run(&mut self, run: &Run) {
        let mut data = PathData::default();
        match run.shape {
            Shape::Open => data.line(run.points.iter().copied()),
            Shape::Ring => data.polygon(run.points[..run.points.len() - 1].iter().copied()),
        }
        let length = polyline::length(&run.points);
        let title =
            cut_title("cut", length, &run.spans) + &way_round(run.turned) + by_edge(run.edge) + chord(run.orientation);
        self.cuts.push_str(&data.titled("run", &title));
        let (start, end) = (self.ends(&run.start, run.edge), self.ends(&run.end, run.edge));
        if self.knife.width_mm > 0.0 {
            for pose in [&run.start, &run.end] {
                self.blade.polygon(self.blade_outline(pose));
            }
        }
        match run.shape {
            Shape::Open => {
                let points = run.extended();
                let (first, last) = (points[0], points[points.len() - 1]);
                self.overlap(&[first, run.points[0]], run.heel);
                self.overlap(&[run.points[run.points.len() - 1], last], run.front);
            }
            Shape::Ring => self.overlap(&along(&run.points, run.front), run.front),
        }
        self.plunge.circle(start.1, PLUNGE_RADIUS * self.unit);
        self.lift.circle(end.1, LIFT_RADIUS * self.unit);
    }

    /// Trailing and leading end of the blade, for the edge that cuts: heel and tip, or tip and heel.
    fn ends(&self, pose: &Pose, edge: Edge) -> (Point, Point) {
        let (heel, tip) = (pose.ahead(-self.knife.back()), pose.ahead(self.knife.radius()));
        match edge {
            Edge::Front => (heel, tip),
            Edge::Back => (tip, heel),
        }
    }

    /// The blade from above: a slender kite, widest at the C axis, pointed at heel and tip.
    fn blade_outline(&self, pose: &Pose) -> [Point; 4] {
        let (heel, tip) = self.ends(pose, Edge::Front);
        let side = left(pose.c.unit()) * (BLADE_HALF_THICKNESS * self.unit);
        [heel, pose.centre + side, tip, pose.centre - side]
    }

    /// The band along an overlap of `length` mm.
    fn overlap(&mut self, points: &[Point], length: f64) {
        overlap(&mut self.over, points, [length, OVERLAP_HALF_THICKNESS * self.unit]);
    }
}

/// Adds the band along an overlap, given its length and half its thickness, mm.
fn overlap(data: &mut PathData, points: &[Point], [length, half]: [f64; 2]) {
    if length > OVERLAP_EPSILON {
        data.polygon(band(points, half));
    }
}

/// Remark on a cut in reverse to the file.
fn way_round(turned: bool) -> String {
    if turned { ", turned round".to_owned() } else { String::new() }
}

/// Remark on a cut by the back edge of the blade.
fn by_edge(edge: Edge) -> &'static str {
    match edge {
        Edge::Front => "",
        Edge::Back => ", by the back edge",
    }
}

/// Remark on a cut in the chord mode.
fn chord(orientation: OrientationMode) -> &'static str {
    match orientation {
        OrientationMode::Tangent => "",
        OrientationMode::Chord => ", the blade as a chord",
    }
}

/// Remark on a plunge cut that reaches into a part.
fn overcut(overcut: [Overcut; 2]) -> String {
    let into = |depth: f64, part: &str, end: &str| {
        if depth > 0.0 { format!(", {} mm into {part} {end}", fixed(depth, 2)) } else { String::new() }
    };
    let ends = overcut.into_iter().zip(["before its start", "past its end"]);
    ends.map(|(Overcut { own, other }, end)| into(own, "its part", end) + &into(other, "another part", end)).collect()
}

/// The outline of a band along a polyline: its left side forwards, its right side back.
fn band(points: &[Point], half: f64) -> Vec<Point> {
    let last = points.len() - 1;
    // Perpendicular to the chord between the neighbours; zero at a hairpin.
    let across = |i: usize| {
        let along = polyline::direction(points[i.saturating_sub(1)], points[(i + 1).min(last)]);
        along.map_or_else(Vector::zeros, |along| left(along) * half)
    };
    let forth = (0..=last).map(|i| points[i] + across(i));
    forth.chain((0..=last).rev().map(|i| points[i] - across(i))).collect()
}

/// The first `length` mm of a polyline; all of it when it is shorter, empty when `length` is 0.
fn along(points: &[Point], length: f64) -> Vec<Point> {
    if length <= OVERLAP_EPSILON {
        return Vec::new();
    }
    let mut rest = length;
    let mut part = vec![points[0]];
    for ends in points.windows(2) {
        let chord = ends[1] - ends[0];
        if chord.norm() >= rest {
            part.push(ends[0] + chord * (rest / chord.norm()));
            break;
        }
        rest -= chord.norm();
        part.push(ends[1]);
    }
    part
}

/// Kind of a toolpath: a hole if it drills, a slit if the file forbids all overlap.
fn kind(toolpath: &Toolpath) -> &'static str {
    let cuts = toolpath.steps.iter().filter_map(|step| match step {
        Step::Run(run) => Some((run.points.len(), run.ends)),
        Step::PlungeCut(plunge_cut) => Some((plunge_cut.points.len(), plunge_cut.ends)),
        Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => None,
    });
    let cuts: Vec<_> = cuts.collect();
    match cuts.as_slice() {
        [] if toolpath.steps.iter().any(|step| matches!(step, Step::Drill(_))) => "hole",
        [] => "event",
        [(2, ends)] if ends.iter().all(|end| end.bare && !end.corner) => "slit",
        _ => "contour",
    }
}

fn spans(step: &Step) -> &[Span] {
    match step {
        Step::Run(run) => &run.spans,
        Step::PlungeCut(plunge_cut) => &plunge_cut.spans,
        Step::Drill(drill) => std::slice::from_ref(&drill.span),
        Step::Turn(_) | Step::Travel(_) | Step::Event(_) => &[],
    }
}

fn count(toolpath: &Toolpath) -> String {
    let runs = toolpath.steps.iter().filter(|step| matches!(step, Step::Run(_))).count();
    let plunge_cuts = toolpath.steps.iter().filter(|step| matches!(step, Step::PlungeCut(_))).count();
    let some = |n: usize, what: &str| match n {
        0 => String::new(),
        1 => format!(", 1 {what}"),
        n => format!(", {n} {what}s"),
    };
    some(runs, "run") + &some(plunge_cuts, "stab")
}

fn cut_title(what: &str, length: f64, of: &[Span]) -> String {
    format!("{what} {} mm{}", fixed(length, 2), blocks(of.iter().copied()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_has_its_line_in_its_middle() {
        let line = [Point::new(0.0, 0.0), Point::new(2.0, 0.0)];
        let corners = [(0.0, 0.5), (2.0, 0.5), (2.0, -0.5), (0.0, -0.5)];
        assert_eq!(band(&line, 0.5), corners.map(|(x, y)| Point::new(x, y)));
    }

    #[test]
    fn the_overlap_of_a_ring_lies_along_it() {
        let corner = [Point::new(0.0, 0.0), Point::new(3.0, 0.0), Point::new(3.0, 9.0)];
        assert_eq!(along(&corner, 5.0), [corner[0], corner[1], Point::new(3.0, 2.0)]);
        assert_eq!(along(&corner, 50.0), corner);
        assert!(along(&corner, 0.0).is_empty());
    }
}
