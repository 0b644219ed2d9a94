//! What the knife does, untimed: a sequence of steps.
//!
//! A toolpath holds the steps of one contour, notch or drill: the pipeline makes, plans and emits them one after the
//! other, so that a program of any length needs little memory. It holds polylines; smooth curves belong to `plan`.

use super::list::Joint;
use crate::geom::{Point, Rotation, Vector, polyline};
use crate::source::Span;

/// Where the axes stand: the C axis over the table, and its position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// The C axis, mm.
    pub centre: Point,
    /// Position of C.
    pub c: Rotation,
}

impl Pose {
    /// The pose at x, y (mm) and c (rad).
    pub fn new(x: f64, y: f64, c: f64) -> Self {
        Self { centre: Point::new(x, y), c: Rotation(c) }
    }

    /// The point `reach` mm in front of the C axis along the blade: the tip at `radius`, the heel at `-back`.
    pub fn ahead(&self, reach: f64) -> Point {
        self.centre + self.c.unit() * reach
    }
}

impl Default for Pose {
    fn default() -> Self {
        Self::new(0.0, 0.0, 0.0)
    }
}

/// The steps of one contour, notch or drill, in order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Toolpath {
    /// The number of the piece that it belongs to.
    pub piece: u32,
    /// The place of that piece in the marker, from 0: numbers may come again.
    pub part: u32,
    /// Permitted deviation of the tip, mm.
    pub tolerance: f64,
    /// Where the axes stand before the first step, as far as it is known before planning.
    pub entry: Pose,
    /// The steps.
    pub steps: Vec<Step>,
}

impl Toolpath {
    /// Where the axes stand behind the last step over the cloth, as far as it is known before planning: where that is moved
    /// on, they come to stand as much farther on it.
    pub fn exit(&self) -> Pose {
        let mut advance = 0;
        let end = |step: &Step| match step {
            Step::Run(run) => Some(run.end),
            Step::PlungeCut(plunge_cut) => Some(plunge_cut.pose),
            Step::Turn(air) | Step::Travel(air) => Some(air.to),
            Step::Event(event) => {
                advance += event.advance_mm();
                None
            }
            Step::Drill(_) => None,
        };
        let pose = self.steps.iter().rev().find_map(end).unwrap_or(self.entry);
        Pose { centre: pose.centre + Vector::new(f64::from(advance), 0.0), ..pose }
    }

    /// Its runs, in order.
    pub fn runs(&self) -> impl Iterator<Item = &Run> {
        self.steps.iter().filter_map(|step| match step {
            Step::Run(run) => Some(run),
            Step::PlungeCut(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => None,
        })
    }
}

/// One thing that the machine does.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// Plunge, follow a path with the knife down, lift.
    Run(Run),
    /// One plunge without motion.
    PlungeCut(PlungeCut),
    /// Knife up, C to the next heading and the centre to the next start, at a corner inside a contour.
    Turn(Air),
    /// Knife up, from anywhere to anywhere.
    Travel(Air),
    /// A hole.
    Drill(Drill),
    /// Something for the controller or the operator.
    Event(Event),
}

/// A move with the knife up. Its ends are nominal: `plan` goes between the states that the runs really have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Air {
    /// Where it starts.
    pub from: Pose,
    /// Where it ends.
    pub to: Pose,
}

/// A path between two corners, cut without lifting.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The polyline as the file has it, mm: no overlaps. A closed run ends with its first point.
    pub points: Vec<Point>,
    /// The block of each chord: one less than points.
    pub spans: Vec<Span>,
    /// What the file asks for at each point.
    pub joints: Vec<Joint>,
    /// How it begins and ends.
    pub shape: Shape,
    /// How the blade lies on curves.
    pub orientation: OrientationMode,
    /// How far the tip goes past the end, mm.
    pub front: f64,
    /// How far the heel starts before the start, mm; without meaning on a closed run.
    pub heel: f64,
    /// Greatest speed of the tip on each chord, mm/s; infinite when nothing caps it.
    pub feeds: Vec<f64>,
    /// The chords about which it crosses cuts of other parts; the tip keeps nearer to these. Empty = none.
    pub junctions: Vec<bool>,
    /// What its two ends are.
    pub ends: [End; 2],
    /// Whether it is cut the other way round than the file has it.
    pub turned: bool,
    /// The edge that goes first; `place` chooses.
    pub edge: Edge,
    /// Where the axes stand at the plunge, as the polyline has it; smoothing moves it a little.
    pub start: Pose,
    /// Where they stand at the lift.
    pub end: Pose,
}

impl Run {
    /// The polyline of an open run with its overlaps: the heel straight back along the first chord, the front straight on
    /// along the last. The heel plunges at its first point, the tip is lifted at its last.
    pub fn extended(&self) -> Vec<Point> {
        self.extended_by([self.heel, self.front])
    }

    /// The same with overlaps of other lengths at its start and its end, mm.
    pub fn extended_by(&self, [heel, front]: [f64; 2]) -> Vec<Point> {
        let n = self.points.len();
        let direction = |a: Point, b: Point| polyline::direction(a, b).expect("no chord of a run has length zero");
        let mut points = Vec::with_capacity(n + 2);
        if heel > 0.0 {
            points.push(self.points[0] - direction(self.points[0], self.points[1]) * heel);
        }
        points.extend_from_slice(&self.points);
        if front > 0.0 {
            points.push(self.points[n - 1] + direction(self.points[n - 2], self.points[n - 1]) * front);
        }
        points
    }
}

/// How the blade lies on a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OrientationMode {
    /// Tip on the path, blade along the tangent.
    Tangent,
    /// Tip and heel on the path: the blade is a chord of it.
    Chord,
}

/// An edge of the blade. One that is sharp at its back may be turned by half a turn: then its heel goes first, and what is
/// said of tip and heel holds the other way round.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Edge {
    /// The one at the tip.
    #[default]
    Front,
    /// The one at the heel.
    Back,
}

impl Edge {
    /// How far C is ahead of the way that the blade cuts, rad.
    pub fn turn(self) -> f64 {
        match self {
            Self::Front => 0.0,
            Self::Back => std::f64::consts::PI,
        }
    }

    /// From the centre to the end of the blade that goes first, mm, of one whose tip and heel are so far from it.
    pub fn lead(self, [tip, heel]: [f64; 2]) -> f64 {
        match self {
            Self::Front => tip,
            Self::Back => heel,
        }
    }
}

/// Whether a run closes on itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// From one point to another, or around a contour that has a corner where it starts.
    Open,
    /// Around a smooth closed contour: no end has a corner.
    Ring,
}

/// What the end of a run is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct End {
    /// A corner inside a contour; otherwise the contour begins or ends here.
    pub corner: bool,
    /// No overlap goes here: the file forbids it (M17, M18, M19, a slit), or the contour itself goes on.
    pub bare: bool,
    /// Where its overlap goes.
    pub side: Side,
}

/// Where an overlap goes that leads straight on beyond an end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Side {
    /// Into the waste, as far as the profile wants it.
    #[default]
    Waste,
    /// Into the part itself: only as far as the profile wants it there.
    Part,
    /// Into a gap that is narrower than the overlap: it is shortened.
    Gap,
    /// Along the contour: the knife is lifted amid it, and goes on there.
    Contour,
}

/// How deep a blade that never moves cuts into parts beyond one of its ends, mm: it is longer than its cut, and there is
/// no room. A place is as deep in a part as it is far from its edges, and no deeper than it is far from the cut.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Overcut {
    /// Into the part to which the cut belongs.
    pub own: f64,
    /// Into another one.
    pub other: f64,
}

impl Overcut {
    /// Into either, mm.
    pub fn deepest(self) -> f64 {
        self.own.max(self.other)
    }

    /// The deeper of two, part by part.
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Self { own: self.own.max(other.own), other: self.other.max(other.other) }
    }
}

/// One plunge without motion: the blade is as long as what it has to cut, or longer.
#[derive(Debug, Clone, PartialEq)]
pub struct PlungeCut {
    /// What it cuts, as the file has it, mm.
    pub points: Vec<Point>,
    /// The block of each chord.
    pub spans: Vec<Span>,
    /// Direction of the blade, unit vector from heel to tip.
    pub along: Vector,
    /// How far the tip stands past the end, mm.
    pub front: f64,
    /// How far the heel stands before the start, mm.
    pub heel: f64,
    /// What the two ends of the cut are.
    pub ends: [End; 2],
    /// Whether it is cut the other way round than the file has it.
    pub turned: bool,
    /// The edge that stands at the end of the cut; `place` chooses.
    pub edge: Edge,
    /// How deep the blade cuts into parts before the start and past the end.
    pub overcut: [Overcut; 2],
    /// Where the axes stand at the plunge; `place` turns C.
    pub pose: Pose,
}

/// A hole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drill {
    /// Its place, mm.
    pub at: Point,
    /// Which drill, 1 to 4.
    pub tool: u8,
    /// Its block.
    pub span: Span,
}

/// Something for the controller or the operator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// Wait for the operator.
    Stop,
    /// Advance the cloth, as far as the controller knows.
    Advance,
    /// Advance of the cloth by a length in mm, to the next bite of a conveyor.
    AdvanceBy(u32),
}

impl Event {
    /// Way of the cloth that it tells, mm; 0 where it tells none.
    pub fn advance_mm(self) -> u32 {
        if let Self::AdvanceBy(mm) = self { mm } else { 0 }
    }
}
