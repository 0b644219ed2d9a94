//! The path of the axes as arcs and lines, untimed: the form for controllers that plan their motion themselves.
//!
//! Each [`Piece`] is one block of a program: X and Y go along an arc or a line, C turns evenly with the way. Lengths are in
//! mm, angles in rad, speeds in mm/s.

use super::toolpath::Pose;
use crate::geom::Point;
use crate::source::Span;

/// What the axes do along a toolpath with the knife down: a path for each run and each plunge cut, in order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Arcs {
    /// One for each.
    pub paths: Vec<Path>,
}

/// The path of the axes from a plunge to the lift.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    /// Where the axes plunge.
    pub start: Pose,
    /// From there on, each from where the one before it ends; none for a plunge cut.
    pub pieces: Vec<Piece>,
    /// From the C axis to the tip of the blade, mm.
    pub radius: f64,
    /// By how much C stands askew to the direction from the C axis to the tip, rad.
    pub yaw: f64,
    /// How far a chord that stands for an arc may leave it.
    pub chord: Deviation,
}

/// A piece of a path: X and Y along an arc or a line, C linear along it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Where it ends.
    pub to: Pose,
    /// Its arc; `None` = straight.
    pub arc: Option<Arc>,
    /// Way of the C axis, mm.
    pub length: f64,
    /// Greatest speed of the C axis that lets the tip keep its own, mm/s; infinite when nothing caps it.
    pub speed: f64,
    /// Greatest speed of the tip, mm/s.
    pub feed: f64,
}

/// The arc of a piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// Its centre.
    pub centre: Point,
    /// How far it turns, left positive, rad.
    pub turn: f64,
}

/// A permitted deviation from an arc.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Deviation {
    /// Of places, mm.
    pub distance: f64,
    /// Of directions, rad.
    pub angle: f64,
}

/// How a controller can be told a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interpolation {
    /// Whether it knows arcs along which C turns; otherwise chords stand for them.
    pub circular: bool,
    /// Step of the last decimal of X and Y, mm.
    pub step: f64,
    /// How far a chord may leave its arc, mm.
    pub chord_tolerance: f64,
    /// How far the blade may be turned from its orientation because C turns evenly on a piece, rad.
    pub heading_tolerance: f64,
}

/// A run without a path of arcs and lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unfit {
    /// Where it begins in the source.
    pub span: Span,
    /// Why there is none.
    pub reason: Reason,
}

/// Why a run has no path of arcs and lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reason {
    /// From this point on no arc or line stays inside the tolerance band.
    Band(Point),
    /// The blade would be a chord of a curve: along a piece it lies along the tangent only.
    Chord,
}

impl Path {
    /// That of a plunge without motion.
    pub fn plunge(start: Pose) -> Self {
        Self { start, pieces: Vec::new(), radius: 0.0, yaw: 0.0, chord: Deviation::default() }
    }

    /// The same with C corrected by an angle, rad.
    #[must_use]
    pub fn turned(mut self, by: f64) -> Self {
        for pose in std::iter::once(&mut self.start).chain(self.pieces.iter_mut().map(|piece| &mut piece.to)) {
            pose.c.0 += by;
        }
        self.yaw += by;
        self
    }
}
