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

impl Dialect {
    /// Both dialects.
    pub(super) const ALL: &[Self] = &[Self::Rs274, Self::Reprap];

    /// Name in a sentence.
    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Rs274 => "RS274/NGC",
            Self::Reprap => "RepRapFirmware",
        }
    }

    /// Codes that end a program.
    pub(super) fn ends(self) -> &'static [&'static str] {
        match self {
            Self::Rs274 => &["M2", "M30"],
            Self::Reprap => &["M2"],
        }
    }

    /// Effect of a code that does something else in it than in other dialects, continuing "M0, by which".
    pub(super) fn other_effect(self, code: &str) -> Option<&'static str> {
        match (self, code) {
            (Self::Reprap, "M0" | "M1") => Some("RepRapFirmware ends the job"),
            (Self::Reprap, "M30") => Some("RepRapFirmware deletes a file"),
            (Self::Rs274 | Self::Reprap, _) => None,
        }
    }
}
