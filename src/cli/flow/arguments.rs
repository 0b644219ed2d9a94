//! The arguments of `cutc flow`.

use std::path::PathBuf;

use clap::Args;

use crate::cli::choices::{self, Format};
use crate::cli::options::{Choice, Messages, NO_HEADING, Reading};
use crate::flow::{Speed, TARGETS, Target};
use crate::units::quantity;

/// Arguments of `cutc flow`.
///
/// Cuts are parted into chains along which the cloth comes towards the head; each chain goes to a head, each head to a row;
/// one timed program a head is written, against time and against the position of the conveyor, beside the plan that tells
/// which head has which. What is written is read back, mapped to the cloth and judged first. `cutc manual flow` has the
/// equations, the keys and the rules.
#[derive(Debug, Args)]
pub(in crate::cli) struct Arguments {
    /// The marker, as for `cutc compile`; `-` for standard input
    #[arg(value_name = "MARKER")]
    pub(super) file: PathBuf,

    /// The folder for plan and programs; made when it is not there
    #[arg(short, long, value_name = "DIRECTORY")]
    pub(super) out: PathBuf,

    /// Speed of the conveyor in mm/s, as in `--speed 200` or `--speed "12 m/min"`, or `max` (overrides `flow.speed_mm_s`)
    #[arg(long, value_name = "SPEED", value_parser = speed)]
    pub(super) speed: Option<Speed>,

    /// What to write beside the plan, one or several as in `-t csv,svg`; csv without it
    #[arg(short, long = "target", value_name = "TARGET", value_parser = choices::targets(TARGETS), value_delimiter = ',')]
    pub(super) targets: Vec<&'static Target>,

    /// Overwrite a plan even if it was made from another input, or by somebody else
    #[arg(long)]
    pub(super) force: bool,

    #[command(flatten)]
    pub(super) reading: Reading,

    #[command(flatten)]
    pub(super) choice: Choice,

    /// How to give the figures
    #[arg(long, value_enum, default_value = "text", help_heading = NO_HEADING)]
    pub(super) format: Format,

    /// Do not read the programs back and judge them; summary and provenance say so
    #[arg(long, help_heading = NO_HEADING)]
    pub(super) no_verify: bool,

    #[command(flatten, next_help_heading = NO_HEADING)]
    pub(super) messages: Messages,
}

/// Greatest speed of a conveyor that is believed, mm/s.
const FASTEST: f64 = 10_000.0;

fn speed(text: &str) -> Result<Speed, String> {
    if text == "max" {
        return Ok(Speed::Most);
    }
    let value = text.parse::<f64>().ok().or_else(|| quantity::value_in(text, "mm/s").ok());
    match value {
        Some(value) if (1.0..=FASTEST).contains(&value) => Ok(Speed::Of(value)),
        Some(_) | None => Err(format!("expected `max` or a speed from 1 to {FASTEST} mm/s")),
    }
}
