//! Something that a profile may not say.

use crate::diagnostic::{Code, code};

/// Something that a profile may not say.
#[derive(Debug, PartialEq)]
pub(super) struct Fault {
    /// What it is a fault of.
    pub(super) code: &'static Code,
    /// The keys that it concerns; a message stands at the one that the user gave.
    pub(super) keys: Vec<String>,
    /// What is wrong.
    pub(super) message: String,
    /// What to do.
    pub(super) hint: Option<String>,
}

impl Fault {
    /// A value, or several together, out of their range.
    pub(super) fn of_range(keys: &[&str], message: String, hint: &str) -> Self {
        let keys = keys.iter().map(|&key| key.to_owned()).collect();
        Self { code: &code::PROFILE_RANGE, keys, message, hint: Some(hint.to_owned()) }
    }
}
