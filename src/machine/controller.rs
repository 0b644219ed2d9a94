//! What targets that address a controller need to know of it: keys of the profile.

use serde::{Deserialize, Serialize};

use super::word::{Off, OrWord};

/// The encoders of the drives, for the target `counts`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Counts {
    /// Along the table.
    pub x: LinearCounts,
    /// Across the table.
    pub y: LinearCounts,
    /// The blade's turn.
    pub c: RotaryCounts,
}

/// The encoder of a linear axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LinearCounts {
    /// Counts per mm.
    pub per_mm: f64,
    /// Counts at 0 mm.
    pub offset: f64,
}

/// The encoder of the rotary axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RotaryCounts {
    /// Counts per degree.
    pub per_deg: f64,
    /// Counts at 0 degrees of the controller.
    pub offset: f64,
}

impl Default for LinearCounts {
    fn default() -> Self {
        Self { per_mm: 10_000.0, offset: 0.0 }
    }
}

impl Default for RotaryCounts {
    fn default() -> Self {
        Self { per_deg: 10_000.0, offset: 0.0 }
    }
}

/// A controller that reads G-code, for the target `gcode`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Gcode {
    /// Letter of the axis that turns the blade.
    pub letter: Letter,
    /// Whether the axis counts from 0 to 360 degrees only.
    pub wrapped: bool,
    /// Whether the controller knows arcs with a rotary axis.
    pub arcs: bool,
    /// What F says.
    pub feed_mode: FeedMode,
    /// How far the controller may leave the path to round it, mm.
    #[serde(with = "OrWord::<Off>")]
    pub blend_mm: Option<f64>,
    /// Decimals of positions.
    pub decimals: u32,
    /// Whether lines are numbered.
    pub line_numbers: bool,
    /// Greatest angle of the blade from its law that straight pieces of C may leave, degrees.
    pub heading_tolerance_deg: f64,
    /// Without arcs: how far a chord may leave its arc, mm.
    pub chord_mm: f64,
    /// Lines behind the units at the start.
    pub header: String,
    /// Lines at the end.
    pub footer: String,
    /// Lines that put the knife down.
    pub knife_down: String,
    /// Lines that lift it.
    pub knife_up: String,
    /// Lines that put a drill down; `#` is its number.
    pub drill_down: String,
    /// Lines that lift it.
    pub drill_up: String,
    /// Lines that wait for the operator.
    pub stop: String,
    /// Lines that advance the cloth.
    pub advance: String,
}

impl Gcode {
    /// The step of the last decimal, mm and degrees.
    pub fn step(&self) -> f64 {
        10_f64.powi(-self.decimals.cast_signed())
    }
}

/// Letter of a rotary axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Letter {
    /// A.
    A,
    /// B.
    B,
    /// C.
    C,
}

impl Letter {
    /// As it stands in words.
    pub fn byte(self) -> u8 {
        match self {
            Self::A => b'A',
            Self::B => b'B',
            Self::C => b'C',
        }
    }
}

/// What F says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum FeedMode {
    /// Inverse time: one over the minutes that a move takes.
    G93,
    /// Speed, mm a minute.
    G94,
}

impl FeedMode {
    /// The code that chooses it.
    pub fn code(self) -> &'static str {
        match self {
            Self::G93 => "G93",
            Self::G94 => "G94",
        }
    }
}

impl Default for Gcode {
    fn default() -> Self {
        Self {
            letter: Letter::C,
            wrapped: false,
            arcs: true,
            feed_mode: FeedMode::G94,
            blend_mm: Some(0.05),
            decimals: 4,
            line_numbers: false,
            heading_tolerance_deg: 0.1,
            chord_mm: 0.002,
            header: String::new(),
            footer: "M2".to_owned(),
            knife_down: "M64 P0".to_owned(),
            knife_up: "M65 P0".to_owned(),
            drill_down: "M64 P#".to_owned(),
            drill_up: "M65 P#".to_owned(),
            stop: "M0".to_owned(),
            advance: "M1".to_owned(),
        }
    }
}
