//! The path of the axes as arcs and lines, untimed: the form for controllers that plan their motion themselves.
//!
//! Each [`Piece`] is one block of a program: X and Y move along an arc or a line, and C turns uniformly along it. Lengths are
//! in mm, angles in rad, speeds in mm/s.

use super::toolpath::Pose;
use crate::geom::Point;
use crate::source::Span;

/// Paths of the axes with the knife down, along one toolpath.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Arcs {
    /// The path of each run and each plunge cut, in order.
    pub paths: Vec<Path>,
}

/// The path of the axes from a plunge to the lift.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    /// Pose of the axes at the plunge.
    pub start: Pose,
    /// Pieces in order, each from the end of the previous one; empty for a plunge cut.
    pub pieces: Vec<Piece>,
    /// Distance from the C axis to the tip of the blade, mm.
    pub radius: f64,
    /// Angle between C and the direction from the C axis to the tip, rad.
    pub yaw: f64,
    /// Permitted deviation of a chord from the arc that it approximates.
    pub chord: Deviation,
}

/// A piece of a path: X and Y along an arc or a line, C linear along it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Pose at its end.
    pub to: Pose,
    /// Arc of X and Y; `None` = straight.
    pub arc: Option<Arc>,
    /// Length of the path of the C axis, mm.
    pub length: f64,
    /// Maximum speed of the C axis that keeps the tip at or below `feed`, mm/s; infinite without a cap.
    pub speed: f64,
    /// Maximum speed of the tip, mm/s.
    pub feed: f64,
}

/// The arc of a piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// Centre of the arc.
    pub centre: Point,
    /// Turn, left positive, rad.
    pub turn: f64,
}

/// A permitted deviation from an arc.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Deviation {
    /// Deviation of position, mm.
    pub distance: f64,
    /// Deviation of direction, rad.
    pub angle: f64,
}

/// Capabilities and tolerances of a controller for paths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interpolation {
    /// True if the controller supports arcs along which C turns; otherwise chords replace them.
    pub circular: bool,
    /// Step of the last decimal of X and Y, mm.
    pub step: f64,
    /// Maximum deviation of a chord from its arc, mm.
    pub chord_tolerance: f64,
    /// Maximum deviation of the blade from its orientation due to the uniform turning of C on a piece, rad.
    pub heading_tolerance: f64,
}

/// A run without a path of arcs and lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unfit {
    /// Start of the run in the source.
    pub span: Span,
    /// Reason.
    pub reason: Reason,
}

/// Reason why a run has no path of arcs and lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reason {
    /// No arc or line stays inside the tolerance band from this point on.
    Band(Point),
    /// The blade would have to be a chord of a curve, but along a piece it can only be tangent.
    Chord,
}

impl Path {
    /// The path of a plunge without motion.
    pub fn plunge(start: Pose) -> Self {
        Self { start, pieces: Vec::new(), radius: 0.0, yaw: 0.0, chord: Deviation::default() }
    }

    /// The path with an angle added to C, rad.
    #[must_use]
    pub fn turned(mut self, by: f64) -> Self {
        for pose in std::iter::once(&mut self.start).chain(self.pieces.iter_mut().map(|piece| &mut piece.to)) {
            pose.c.0 += by;
        }
        self.yaw += by;
        self
    }
}
