//! Kind of finding.

use super::telling::{Fault, Harm, Severity, Telling};

/// Kind of finding.
#[derive(Debug, PartialEq, Eq)]
pub struct Code {
    /// Stable name, `stage/kebab-case`.
    pub name: &'static str,
    /// Severity, always the same.
    pub severity: Severity,
    /// Possible harm to parts. After an error nothing is cut.
    pub harm: Harm,
    /// Cause.
    pub fault: Fault,
    /// Meaning, in a sentence or two.
    pub about: &'static str,
    /// Relevance in a cutting room, and remedy: each line is a paragraph, each indented line an example.
    pub more: &'static str,
}

impl Code {
    /// Selection of its findings to report.
    pub fn telling(&self) -> Telling {
        match (self.severity, self.fault) {
            (Severity::Error, Fault::Text | Fault::Shape) => Telling::Each,
            (Severity::Warning, Fault::Text) => Telling::Few,
            (Severity::Warning, Fault::Shape) => Telling::Worst,
        }
    }
}

/// Kind of error.
pub(super) const fn error(fault: Fault, name: &'static str, about: &'static str, more: &'static str) -> Code {
    Code { name, severity: Severity::Error, harm: Harm::Spares, fault, about, more }
}

/// Kind of warning.
pub(super) const fn warning(
    harm: Harm,
    fault: Fault,
    name: &'static str,
    about: &'static str,
    more: &'static str,
) -> Code {
    Code { name, severity: Severity::Warning, harm, fault, about, more }
}

/// Declares each code, and the table of them in the order of the manual.
macro_rules! codes {
    ($($(#[$about:meta])* $name:ident = $code:expr;)*) => {
        $($(#[$about])* pub static $name: Code = $code;)*

        /// Codes of this file, in the order of the manual.
        pub(super) static CODES: &[&Code] = &[$(&$name),*];
    };
}
pub(super) use codes;
