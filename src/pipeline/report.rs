//! What a compile has to tell about its input and its program: the figures of the summary.

use serde::Serialize;

use crate::ir::Marker;
use crate::ir::marker::NotchKind;
use crate::machine::Limits;
use crate::units::{MM_PER_M, deg};

/// The figures of one file; `None` is what only planning knows.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Name of the dialect that was read.
    pub dialect: &'static str,
    /// What the numbers of the file are multiples of, mm; 0 when they are not rounded.
    pub unit_mm: f64,
    /// Width and height of everything that is cut or drilled, mm.
    pub extent_mm: [f64; 2],
    /// Pieces.
    pub pieces: usize,
    /// Contours, closed and open.
    pub contours: usize,
    /// Contours that end where they start.
    pub closed_contours: usize,
    /// Notches by kind.
    pub notches: Notches,
    /// Holes.
    pub drills: usize,
    /// Texts.
    pub labels: usize,
    /// Length of contours and slits, without overlaps, m.
    pub cut_m: f64,
    /// What planning adds.
    #[serde(flatten)]
    pub program: Program,
}

/// Notches by kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Notches {
    /// One straight cut from the edge inwards.
    pub slit: usize,
    /// Two legs that meet inside.
    pub v: usize,
}

/// The figures of a program.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Program {
    /// Way of the C axis with the knife up, m.
    pub travel_m: Option<f64>,
    /// Times that the knife goes down: runs and stabs.
    pub runs: Option<usize>,
    /// Plunges without motion.
    pub stabs: Option<usize>,
    /// Times that the knife goes up.
    pub lifts: Option<usize>,
    /// Duration of the program, s.
    pub time_s: Option<f64>,
    /// The greatest speed, acceleration and jerk of each axis beside its limit.
    pub axes: Option<Axes>,
}

/// Peaks of the three axes; mm for x and y, degrees for c.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Axes {
    /// Along the table.
    pub x: Peaks,
    /// Across the table.
    pub y: Peaks,
    /// The blade's turn.
    pub c: Peaks,
}

/// The greatest values of one axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Peaks {
    /// Per s.
    pub speed: Peak,
    /// Per s2.
    pub acceleration: Peak,
    /// Per s3.
    pub jerk: Peak,
}

/// A greatest value and its limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Peak {
    /// The greatest value of the program, by finite differences of its setpoints.
    pub worst: f64,
    /// What the profile allows.
    pub limit: f64,
}

impl Axes {
    /// Peaks (mm, rad) beside limits (mm, rad), in mm and degrees.
    pub fn new(peaks: &crate::plan::Peaks, limits: &[Limits; 3]) -> Self {
        let axis = |i: usize, unit: fn(f64) -> f64| {
            let [speed, acceleration, jerk] = peaks[i].map(unit);
            Peaks {
                speed: Peak { worst: speed, limit: unit(limits[i].speed) },
                acceleration: Peak { worst: acceleration, limit: unit(limits[i].acceleration) },
                jerk: Peak { worst: jerk, limit: unit(limits[i].jerk) },
            }
        };
        Self { x: axis(0, |v| v), y: axis(1, |v| v), c: axis(2, deg) }
    }
}

impl Report {
    /// What is in a marker, before any planning.
    pub fn of(marker: &Marker, dialect: &'static str) -> Self {
        let (width, height) = marker.extent().size();
        let slit = marker.pieces.iter().flat_map(|p| &p.notches).filter(|n| n.kind == NotchKind::Slit).count();
        Self {
            dialect,
            unit_mm: marker.unit,
            extent_mm: [width, height],
            pieces: marker.pieces.len(),
            contours: marker.contours().count(),
            closed_contours: marker.contours().filter(|(_, c)| c.closed).count(),
            notches: Notches { slit, v: 0 },
            drills: marker.pieces.iter().map(|p| p.drills.len()).sum(),
            labels: marker.pieces.iter().map(|p| p.labels.len()).sum(),
            cut_m: marker.cut_length() / MM_PER_M,
            program: Program::default(),
        }
    }
}
