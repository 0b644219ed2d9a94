//! Findings as they are told: whether a program is forbidden, what may be spoilt, what is at fault, and how many are told.

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

/// Whether what a warning is about may spoil parts: such findings are told before others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Harm {
    /// Cloth may be cut where it must not be, or at another size: that can't be mended.
    Spoils,
    /// Nothing, or something that is seen and mended.
    Spares,
}

/// What is at fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// What stands in the file: its bytes are shown.
    Text,
    /// What the file draws, or what is made of it: no byte of it tells anything.
    Shape,
}

/// How findings of a code are told to people; programs get each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Telling {
    /// One by one: each must be mended.
    Each,
    /// A few of them: each says something else.
    Few,
    /// How many there are, and the worst: they are alike but for place and measure.
    Worst,
}
