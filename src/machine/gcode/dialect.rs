//! Dialects of G-code.

use serde::{Deserialize, Serialize};

/// Rules of spelling of a program: its first line, and G4.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Dialect {
    /// RS274/NGC, as `LinuxCNC` and the grbl family read it.
    Rs274,
    /// `RepRapFirmware`.
    Reprap,
}
