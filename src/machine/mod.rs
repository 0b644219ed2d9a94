//! The machine: its profile, what one compile is asked to do with it, and the closed forms of its axes.
//!
//! Receives TOML, promises validated numbers in mm, s and rad, never knows what is cut.

pub mod kinematics;
pub mod profile;
mod word;

pub use kinematics::Limits;
pub use profile::{FileUnit, Fit, Follow, Knife, MachineProfile};

/// What one compile is asked to do: the profile and the options of this run.
#[derive(Debug, Clone, Default)]
pub struct Job {
    /// The machine and the cutting room.
    pub profile: MachineProfile,
}
