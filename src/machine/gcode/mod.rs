//! Controller that reads the programs of the target `gcode`: the keys `gcode.*`.
//!
//! Its actions on knife, drills, operator and cloth are lists of [`Step`]s. Only the head and the end of a program are free
//! text, which may choose and switch but not move (`text`). `rules` checks them against each other.

mod choices;
mod dialect;
mod keys;
mod rules;
mod spelling;
mod step;
mod text;
mod words;

use serde::{Deserialize, Serialize};

pub use self::dialect::Dialect;
pub(super) use self::keys::KEYS;
pub(super) use self::rules::faults;
pub(super) use self::spelling::spellings;
pub use self::step::{Number, Parameter, SETTLE, Step};
pub(super) use self::words::Flaw;
use super::word::{Off, OrWord};

/// Controller that reads G-code, for the target `gcode`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Gcode {
    /// Rules of spelling.
    pub dialect: Dialect,
    /// Letter of the axis that turns the blade.
    pub letter: Letter,
    /// True if that axis counts within one turn.
    pub wrapped: bool,
    /// Policy for arcs or lines, chord length and the meaning of F.
    pub moves: Moves,
    /// True if the axis may turn on arcs.
    pub arcs: bool,
    /// Greatest radius of an arc, mm; `None` = any.
    #[serde(with = "OrWord::<Off>")]
    pub max_radius_mm: Option<f64>,
    /// Meaning of F.
    pub feed_mode: FeedMode,
    /// Axes that F of G94 counts.
    pub feed_counts: FeedCounts,
    /// Tolerance in P of G64; `None` = no G64.
    #[serde(with = "OrWord::<Off>")]
    pub blend_mm: Option<f64>,
    /// Maximum number of moves a second that the controller plans; `None` = as many as are written.
    #[serde(with = "OrWord::<Off>")]
    pub max_blocks_s: Option<f64>,
    /// Planner by which the time of a program is estimated.
    pub planner: Planner,
    /// Maximum number of moves that it knows at once, with the running one.
    pub planner_blocks: u32,
    /// Junction deviation of a grbl planner.
    pub junction_deviation_mm: f64,
    /// Deviation of the chords into which it divides arcs.
    pub arc_tolerance_mm: f64,
    /// Greatest instantaneous change of speed of X, Y and Z in a `RepRapFirmware` planner.
    pub jump_mm_s: f64,
    /// Greatest instantaneous change of speed of the axis of the blade in it.
    pub jump_deg_s: f64,
    /// Maximum speed of Z; `None` = moves of Z are not counted.
    #[serde(with = "OrWord::<Off>")]
    pub z_speed_mm_s: Option<f64>,
    /// Maximum acceleration of Z; `None` = moves of Z are not counted.
    #[serde(with = "OrWord::<Off>")]
    pub z_acceleration_mm_s2: Option<f64>,
    /// Decimals of positions.
    pub decimals: u32,
    /// True if lines are numbered (N).
    pub line_numbers: bool,
    /// When outputs are switched.
    pub outputs: Outputs,
    /// Greatest angle of the blade from its orientation mode, where the axis turns evenly along a piece.
    pub heading_tolerance_deg: f64,
    /// Greatest deviation of a straight piece from its arc, without arcs.
    pub chord_mm: f64,
    /// Lines at the start of a program.
    pub header: String,
    /// Lines at the end of a program.
    pub footer: String,
    /// Steps that put the knife down.
    pub knife_down: Vec<Step>,
    /// Steps that lift the knife.
    pub knife_up: Vec<Step>,
    /// Steps that put a drill down.
    pub drill_down: Vec<Step>,
    /// Steps that lift a drill.
    pub drill_up: Vec<Step>,
    /// Steps that wait for the operator.
    pub stop: Vec<Step>,
    /// Steps that advance the cloth.
    pub advance: Vec<Step>,
}

impl Gcode {
    /// Resolution of positions, mm and degrees.
    pub fn step(&self) -> f64 {
        10_f64.powi(-self.decimals.cast_signed())
    }

    /// True if the axes must stand before steps: the controller obeys the first one when it reads it, even amid a move.
    pub fn must_stand(&self, steps: &[Step]) -> bool {
        self.outputs == Outputs::Immediate && steps.first().is_some_and(Step::acts_when_read)
    }
}

/// Policy for the moves of a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Moves {
    /// The keys of the profile are obeyed.
    Fixed,
    /// The fastest of [`Gcode::choices`], by the planner of the controller, is written.
    Auto,
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
    /// Letter as it stands in words.
    pub fn byte(self) -> u8 {
        match self {
            Self::A => b'A',
            Self::B => b'B',
            Self::C => b'C',
        }
    }
}

/// Meaning of F.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum FeedMode {
    /// Inverse time: reciprocal of the duration of a move in minutes.
    G93,
    /// Speed, mm/min.
    G94,
}

impl FeedMode {
    /// Both modes.
    pub const ALL: [Self; 2] = [Self::G93, Self::G94];

    /// Code that selects the mode.
    pub fn code(self) -> &'static str {
        match self {
            Self::G93 => "G93",
            Self::G94 => "G94",
        }
    }
}

/// Axes whose motion a speed in mm/min counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FeedCounts {
    /// X and Y.
    Linear,
    /// X, Y in mm and the axis of the blade in degrees: the length of the move is the norm of all three.
    All,
}

/// Planner of a controller.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Planner {
    /// `LinuxCNC`.
    Linuxcnc,
    /// grbl and its descendants: grbl-Mega-5X, grblHAL, `FluidNC`.
    Grbl,
    /// `RepRapFirmware` 3.5.
    Reprap,
}

impl Planner {
    /// Name in a sentence.
    pub fn title(self) -> &'static str {
        match self {
            Self::Linuxcnc => "LinuxCNC",
            Self::Grbl => "grbl",
            Self::Reprap => "RepRapFirmware",
        }
    }
}

/// Time at which a controller switches outputs (M64, M65, M68) and waits for inputs (M66).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Outputs {
    /// When the moves before them are over.
    Queued,
    /// When it reads them, even amid a move.
    Immediate,
}

impl Default for Gcode {
    fn default() -> Self {
        Self {
            dialect: Dialect::Rs274,
            letter: Letter::C,
            wrapped: false,
            moves: Moves::Fixed,
            arcs: true,
            max_radius_mm: None,
            feed_mode: FeedMode::G94,
            feed_counts: FeedCounts::Linear,
            blend_mm: Some(0.05),
            max_blocks_s: None,
            planner: Planner::Linuxcnc,
            planner_blocks: 15,
            junction_deviation_mm: 0.01,
            arc_tolerance_mm: 0.002,
            jump_mm_s: 15.0,
            jump_deg_s: 15.0,
            z_speed_mm_s: None,
            z_acceleration_mm_s2: None,
            decimals: 4,
            line_numbers: false,
            outputs: Outputs::Queued,
            heading_tolerance_deg: 0.1,
            chord_mm: 0.002,
            header: String::new(),
            footer: "M2".to_owned(),
            knife_down: vec![Step::Output { pin: Number::Plain(0.0), on: true }],
            knife_up: vec![Step::Output { pin: Number::Plain(0.0), on: false }],
            drill_down: vec![Step::Output { pin: Number::Blank, on: true }],
            drill_up: vec![Step::Output { pin: Number::Blank, on: false }],
            stop: vec![Step::Code { m: 0, parameters: Vec::new() }],
            advance: vec![Step::Code { m: 1, parameters: Vec::new() }],
        }
    }
}
