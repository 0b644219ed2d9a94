//! The controller that reads the programs of the target `gcode`: the keys `gcode.*`.
//!
//! What it does with knife, drills, operator and cloth are lists of [`Step`]s; only the head and the end of a program are
//! free text, which may choose and switch but not move (`text`). `rules` holds them against each other.

mod keys;
mod rules;
mod spelling;
mod step;
mod text;
mod words;

use serde::{Deserialize, Serialize};

pub(super) use self::keys::KEYS;
pub(super) use self::rules::faults;
pub(super) use self::spelling::spellings;
pub use self::step::{Number, Parameter, Step};
pub(super) use self::words::Flaw;
use super::word::{Off, OrWord};

/// A controller that reads G-code, for the target `gcode`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Gcode {
    /// The axis that turns the blade.
    pub letter: Letter,
    /// That axis counts within a turn.
    pub wrapped: bool,
    /// It turns on arcs, too.
    pub arcs: bool,
    /// What F says.
    pub feed_mode: FeedMode,
    /// P of G64.
    #[serde(with = "OrWord::<Off>")]
    pub blend_mm: Option<f64>,
    /// Most moves a second that it plans; `None` = as many as are written.
    #[serde(with = "OrWord::<Off>")]
    pub max_blocks_s: Option<f64>,
    /// Of positions.
    pub decimals: u32,
    /// Lines have N.
    pub line_numbers: bool,
    /// The blade from where its orientation mode has it.
    pub heading_tolerance_deg: f64,
    /// A straight piece from its arc.
    pub chord_mm: f64,
    /// Lines at the start.
    pub header: String,
    /// Lines at the end.
    pub footer: String,
    /// The knife goes down.
    pub knife_down: Vec<Step>,
    /// It is lifted.
    pub knife_up: Vec<Step>,
    /// A drill goes down.
    pub drill_down: Vec<Step>,
    /// It is lifted.
    pub drill_up: Vec<Step>,
    /// The operator is waited for.
    pub stop: Vec<Step>,
    /// The cloth advances.
    pub advance: Vec<Step>,
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
            max_blocks_s: None,
            decimals: 4,
            line_numbers: false,
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
