//! Properties of findings: severity, harm to parts, cause, and selection for a report.

use serde::Serialize;

/// Severity of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// No program is written.
    Error,
    /// A program is written; somebody should look.
    Warning,
}

/// Harm to parts. Findings that may spoil parts are reported before others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Harm {
    /// Cloth may be cut in a wrong place or at a wrong size, which cannot be mended, or a part may be missing.
    Spoils,
    /// No harm, or harm that is seen and mended.
    Spares,
}

/// Cause of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// The text of the file: its bytes are shown.
    Text,
    /// The drawing, or something made of it: the bytes of the file explain nothing.
    Shape,
}

/// Selection of the findings of a code that are reported to people; programs get all of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Telling {
    /// All: each must be mended.
    Each,
    /// A few: each differs.
    Few,
    /// Their number and the worst one: they differ only in place and magnitude.
    Worst,
}
