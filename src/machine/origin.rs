//! Origin of a profile as named by reports and programs, and the keys that the user gave.

use std::collections::{BTreeMap, BTreeSet};

/// Name of the machine if no file was given.
const DEFAULT: &str = "default machine";

/// Origin of a profile.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Origin {
    /// Name of its file, without the directory; `None` if none was given.
    pub file: Option<String>,
    /// Keys set by arguments, with their values as they were typed.
    pub set: BTreeMap<String, String>,
    /// Keys given by the file or by arguments.
    pub given: BTreeSet<String>,
}

/// Source of the position of the axis in the blade.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// The user, or the default blade as a whole.
    Told,
    /// Unknown: the user gave only a width, and the back of the default blade is assumed.
    Assumed,
}

impl Origin {
    /// Name of the machine: that of its file, or that of the default.
    pub fn name(&self) -> &str {
        self.file.as_deref().unwrap_or(DEFAULT)
    }

    /// Name and changed keys, as in `machine.toml, with knife.width_mm set`.
    pub fn described(&self) -> String {
        if self.set.is_empty() {
            return self.name().to_owned();
        }
        let keys: Vec<_> = self.set.keys().map(String::as_str).collect();
        format!("{}, with {} set", self.name(), keys.join(", "))
    }

    /// True if it gives keys of a controller that reads G-code.
    pub fn is_for_gcode(&self) -> bool {
        self.given.iter().any(|key| key.starts_with("gcode."))
    }

    /// Source of the position of the axis in the blade; a width alone does not determine it.
    pub fn axis(&self) -> Axis {
        let has = |key: &str| self.given.contains(key);
        if has("knife.width_mm") && !has("knife.back_mm") && !has("knife.radius_mm") {
            Axis::Assumed
        } else {
            Axis::Told
        }
    }
}
