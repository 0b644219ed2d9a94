//! The carriage that follows the centre of a moving cloth: ruler readings to commands, and to the line that the cloth took.
//!
//! A small pipeline of the shape of the cutter's:
//!
//! ```text
//! bytes -> log      -> Rows -> replay   -> Commands, centre line -> write -> bytes
//! bytes -> scenario ->         simulate -> the same, with others beside, measured
//! ```
//!
//! `verify` reads the written commands back. `controller` is the part that runs as firmware; `law` derives its constants from
//! the profile. `drive`, `rulers` and `rivals` are the plant of the simulation. `centre` reads and writes centre lines, which
//! `compile --centre` takes, too.

pub mod centre;
mod chart;
pub mod controller;
mod drive;
mod even;
pub mod law;
mod log;
pub mod measure;
mod replay;
mod rivals;
mod row;
mod rulers;
pub mod scenario;
pub mod simulate;
mod tracked;
pub mod verify;
mod write;

pub use replay::Replay;
pub use row::Row;
pub use tracked::{Needs, Tracked};
pub use write::{Reader, TARGETS, Target, Writer};
