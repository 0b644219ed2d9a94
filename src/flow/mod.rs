//! Flow cutting: heads in rows over a conveyor cut cloth while it moves.
//!
//! A small pipeline of the shape of the cutter's, the listing in its order:
//!
//! ```text
//! Marker -> chains -> stroke (pace) -> heads -> rows -> Program -> write -> bytes -> verify
//! ```
//!
//! A *chain* is a stretch of a cut that one head makes, with x falling on the whole; a *stroke* is a chain with its motion over
//! the cloth, which `plan` computes under the limits that remain in the moving frame; a *Program* has for each head its row and
//! its strokes in time. Closed forms without accelerations (`bound`) give the best possible values. `verify` knows nothing of
//! the planner: it maps the bytes of all heads back to the cloth.

mod asked;
mod attempt;
mod bound;
mod chains;
mod heads;
mod join;
mod link;
mod moving;
mod pace;
mod placing;
mod program;
mod ramp;
mod rows;
mod search;
mod stroke;
mod track;
mod write;
mod yielding;

/// Verifier of programs.
pub use crate::verify::flow as verify;
pub use asked::Speed;
pub use bound::Bounds;
pub use heads::Start;
pub use link::{State, Wait};
pub use program::{Head, Program, Setpoint};
pub use search::plan;
pub use stroke::{Lag, Stroke};
pub use write::{Emit, File, Plan, TARGETS, Target, describe};

use serde::Serialize;

/// Figures of a program beyond the motion of its heads.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Figures {
    /// Stretches of cuts that one head makes.
    pub chains: usize,
    /// Heads in use.
    pub heads: usize,
    /// Lower bound on the number of heads: the largest set of chains no two of which one head can cut in sequence.
    pub heads_bound: usize,
    /// Greatest number of chains at one place along the feed: the number of heads needed without travel along the feed.
    pub chains_abreast: usize,
    /// Rows in use.
    pub rows: usize,
    /// True if fewer rows are provably impossible for these heads.
    pub rows_exact: bool,
    /// Greatest travel along the feed that a chain takes, its ramps included, mm.
    pub travel_mm: f64,
    /// Least travel that the paths of the chains take, without accelerations and ramps, mm.
    pub travel_bound_mm: f64,
    /// Greatest speed of the conveyor at which that travel fits, mm/s.
    pub speed_bound_mm_s: f64,
    /// Length of all cuts, without overlaps, m.
    pub cut_m: f64,
    /// Time of the program, s.
    pub time_s: f64,
    /// Part of the time that heads in use have their knife on a chain, 0 to 1.
    pub busy: f64,
}
