//! One kind of finding.

use super::telling::{Fault, Harm, Severity, Telling};

/// One kind of finding.
#[derive(Debug, PartialEq, Eq)]
pub struct Code {
    /// Stable name, `stage/kebab-case`.
    pub name: &'static str,
    /// Its severity, the same wherever it is found.
    pub severity: Severity,
    /// Whether it may spoil parts. Of an error nothing is cut.
    pub harm: Harm,
    /// The thing at fault.
    pub fault: Fault,
    /// Meaning, in a sentence or two.
    pub about: &'static str,
    /// Why it matters in a cutting room, and what to do: a line a paragraph, an indented line an example.
    pub more: &'static str,
}

impl Code {
    /// How findings of it are told.
    pub fn telling(&self) -> Telling {
        match (self.severity, self.fault) {
            (Severity::Error, Fault::Text | Fault::Shape) => Telling::Each,
            (Severity::Warning, Fault::Text) => Telling::Few,
            (Severity::Warning, Fault::Shape) => Telling::Worst,
        }
    }
}

/// An error.
pub(super) const fn error(fault: Fault, name: &'static str, about: &'static str, more: &'static str) -> Code {
    Code { name, severity: Severity::Error, harm: Harm::Spares, fault, about, more }
}

/// A warning.
pub(super) const fn warning(
    harm: Harm,
    fault: Fault,
    name: &'static str,
    about: &'static str,
    more: &'static str,
) -> Code {
    Code { name, severity: Severity::Warning, harm, fault, about, more }
}

/// Declares each code, and the table of all of them in the order of the manual.
macro_rules! codes {
    ($($(#[$about:meta])* $name:ident = $code:expr;)*) => {
        $($(#[$about])* pub static $name: Code = $code;)*

        /// Every code, in the order of the manual.
        pub static ALL: &[&Code] = &[$(&$name),*];
    };
}
pub(super) use codes;
