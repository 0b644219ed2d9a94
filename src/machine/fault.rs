//! Fault of a profile.

use crate::diagnostic::{Code, code};

/// Fault of a profile.
#[derive(Debug, PartialEq)]
pub(super) struct Fault {
    /// Code of the diagnostic.
    pub(super) code: &'static Code,
    /// Keys concerned; the message is placed at the one that the user gave.
    pub(super) keys: Vec<String>,
    /// Description of the fault.
    pub(super) message: String,
    /// Suggestion for its correction.
    pub(super) hint: Option<String>,
}

impl Fault {
    /// Fault of one or several values out of range.
    pub(super) fn of_range(keys: &[&str], message: String, hint: &str) -> Self {
        let keys = keys.iter().map(|&key| key.to_owned()).collect();
        Self { code: &code::PROFILE_RANGE, keys, message, hint: Some(hint.to_owned()) }
    }
}
