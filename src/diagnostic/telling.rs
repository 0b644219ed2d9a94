//! Properties of findings: severity, harm to parts, the thing at fault, and the number that is told.

use serde::Serialize;

/// Whether a finding forbids a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// No program is written.
    Error,
    /// A program is written; somebody should look.
    Warning,
}

/// Harm to parts. Findings that may spoil some are told before others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Harm {
    /// Cloth may be cut where it must not be, or at another size: that can't be mended.
    Spoils,
    /// Nothing, or something that is seen and mended.
    Spares,
}

/// The thing at fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// The text of the file: its bytes are shown.
    Text,
    /// The drawing, or something made of it: no byte of the file tells anything.
    Shape,
}

/// Selection of the findings of a code that people are told; programs get each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Telling {
    /// One by one: each must be mended.
    Each,
    /// A few of them: each says something else.
    Few,
    /// Their number, and the worst: they are alike but for place and measure.
    Worst,
}
