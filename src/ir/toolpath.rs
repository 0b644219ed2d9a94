//! Work of the knife, untimed: a sequence of steps.
//!
//! A toolpath holds the steps of one contour, notch or drill. The pipeline makes, plans and emits toolpaths one by one, so that
//! a program of any length needs little memory. Toolpaths hold polylines; smooth curves belong to `plan`.

use super::list::Joint;
use crate::geom::{Point, Rotation, Vector, polyline};
use crate::source::Span;

/// Pose of the axes: the position of the C axis over the table, and of C.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Position of the C axis, mm.
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
    /// Number of its piece.
    pub piece: u32,
    /// Index of that piece in the marker, from 0; piece numbers may repeat.
    pub part: u32,
    /// Permitted deviation of the tip, mm.
    pub tolerance: f64,
    /// Pose before the first step, as far as it is known before planning.
    pub entry: Pose,
    /// The steps.
    pub steps: Vec<Step>,
}

impl Toolpath {
    /// Nominal pose after the last step, in coordinates of the cloth, as far as it is known before planning. An advance of the
    /// cloth moves it on along the cloth by the same length.
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

/// One action of the machine.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// Plunge, follow a path with the knife down, lift.
    Run(Run),
    /// One plunge without motion.
    PlungeCut(PlungeCut),
    /// Knife up, at a corner inside a contour: C to the next heading and the C axis to the next start.
    Turn(Air),
    /// Knife up, between any two poses.
    Travel(Air),
    /// A hole.
    Drill(Drill),
    /// A signal to the controller or the operator.
    Event(Event),
}

/// A move with the knife up. Its ends are nominal: `plan` moves between the actual states of the runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Air {
    /// Start.
    pub from: Pose,
    /// End.
    pub to: Pose,
}

/// A path between two corners, cut without lifting.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The polyline as given by the file, mm, without overlaps. A closed run ends with its first point.
    pub points: Vec<Point>,
    /// Source block of each chord; one fewer than points.
    pub spans: Vec<Span>,
    /// Requests of the file at each point.
    pub joints: Vec<Joint>,
    /// Open, or a ring.
    pub shape: Shape,
    /// Orientation of the blade on curves.
    pub orientation: OrientationMode,
    /// Length of the tip's path past the end, mm.
    pub front: f64,
    /// Distance of the heel before the start, mm; unused on a closed run.
    pub heel: f64,
    /// Speed cap of the tip on each chord, mm/s; infinite without a cap.
    pub feeds: Vec<f64>,
    /// True for each chord near which the run crosses cuts of other parts; the tip keeps closer to these chords. Empty = none.
    pub junctions: Vec<bool>,
    /// Its start and its end.
    pub ends: [End; 2],
    /// True if it is cut in reverse to the file.
    pub turned: bool,
    /// Leading edge of the blade; `place` chooses it.
    pub edge: Edge,
    /// Nominal pose at the plunge, from the polyline; smoothing moves it slightly.
    pub start: Pose,
    /// Nominal pose at the lift.
    pub end: Pose,
}

impl Run {
    /// The polyline of an open run with its overlaps: the heel straight back along the first chord, the front straight on along
    /// the last. The heel plunges at its first point, the tip is lifted at its last.
    pub fn extended(&self) -> Vec<Point> {
        self.extended_by([self.heel, self.front])
    }

    /// The polyline of an open run with overlaps of other lengths at its start and its end, mm.
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

/// Orientation of the blade on a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OrientationMode {
    /// Tip on the path, blade along the tangent.
    Tangent,
    /// Tip and heel on the path: the blade is a chord of it.
    Chord,
}

/// A cutting edge of the blade. A blade with a sharp back may be rotated by half a turn. Its heel then leads, and the roles of
/// tip and heel are exchanged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Edge {
    /// The edge at the tip.
    #[default]
    Front,
    /// The edge at the heel.
    Back,
}

impl Edge {
    /// Angle from the direction of the cut to C, rad.
    pub fn turn(self) -> f64 {
        match self {
            Self::Front => 0.0,
            Self::Back => std::f64::consts::PI,
        }
    }

    /// Distance from the C axis to the leading end of the blade, mm, given the distances of tip and heel.
    pub fn lead(self, [tip, heel]: [f64; 2]) -> f64 {
        match self {
            Self::Front => tip,
            Self::Back => heel,
        }
    }
}

/// Shape of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// From one point to another, or around a contour with a corner at its start.
    Open,
    /// Around a smooth closed contour, without a corner at its ends.
    Ring,
}

/// Properties of the end of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct End {
    /// True at a corner inside a contour; otherwise the contour starts or ends here.
    pub corner: bool,
    /// True if there is no overlap here: the file forbids it (M17, M18, M19, a slit), or the contour continues.
    pub bare: bool,
    /// Direction of the overlap.
    pub side: Side,
}

/// Direction of an overlap that continues straight beyond an end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Side {
    /// Into the waste, at the length set by the profile.
    #[default]
    Waste,
    /// Into the part itself, at the length set by the profile for parts.
    Part,
    /// Into a gap that is narrower than the overlap: the overlap is shortened.
    Gap,
    /// Along the contour: the knife is lifted in the middle of it and continues there.
    Contour,
}

/// Depth of a plunge cut in parts beyond one of its ends, mm, when the blade is longer than the cut and has no room. The depth
/// of a place is its distance from the edges of the part, but at most its distance from the cut.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Overcut {
    /// Depth in the part to which the cut belongs.
    pub own: f64,
    /// Depth in another part.
    pub other: f64,
}

impl Overcut {
    /// The greater depth, mm.
    pub fn deepest(self) -> f64 {
        self.own.max(self.other)
    }

    /// The greater depths of two, separately for own and other parts.
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Self { own: self.own.max(other.own), other: self.other.max(other.other) }
    }
}

/// A plunge without motion: the blade is at least as long as its cut.
#[derive(Debug, Clone, PartialEq)]
pub struct PlungeCut {
    /// The line to cut, as given by the file, mm.
    pub points: Vec<Point>,
    /// Source block of each chord.
    pub spans: Vec<Span>,
    /// Direction of the blade, unit vector from heel to tip.
    pub along: Vector,
    /// Distance of the tip past the end, mm.
    pub front: f64,
    /// Distance of the heel before the start, mm.
    pub heel: f64,
    /// The start and the end of the cut.
    pub ends: [End; 2],
    /// True if it is cut in reverse to the file.
    pub turned: bool,
    /// Edge of the blade at the end of the cut; `place` chooses it.
    pub edge: Edge,
    /// Depth of the blade in parts before the start and past the end.
    pub overcut: [Overcut; 2],
    /// Pose of the axes at the plunge; `place` turns C.
    pub pose: Pose,
}

/// A hole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drill {
    /// Position, mm.
    pub at: Point,
    /// Number of the drill, 1 to 4.
    pub tool: u8,
    /// Source block.
    pub span: Span,
}

/// A signal to the controller or the operator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// Wait for the operator.
    Stop,
    /// Advance of the cloth by a length known to the controller.
    Advance,
    /// Advance of the cloth by a length in mm, to the next bite of a conveyor.
    AdvanceBy(u32),
}

impl Event {
    /// Advance of the cloth, mm; 0 where the event gives no length.
    pub fn advance_mm(self) -> u32 {
        if let Self::AdvanceBy(mm) = self { mm } else { 0 }
    }
}
