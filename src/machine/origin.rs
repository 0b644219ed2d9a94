//! Where a profile came from, as reports and programs name it, and what the user said of the knife in it.

use std::collections::BTreeSet;

/// What stands for a machine of which no file was given.
const DEFAULT: &str = "default machine";

/// Where a profile came from.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Origin {
    /// Name of its file, without the directory; `None` = none was given.
    pub file: Option<String>,
    /// Keys that arguments set over it.
    pub set: BTreeSet<String>,
    /// Keys that were given at all, by the file or by arguments.
    pub given: BTreeSet<String>,
}

/// Who says where the axis stands in the blade.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// The user, or the default blade as a whole.
    Told,
    /// Nobody: the user gave a width only, and the back of the default blade holds.
    Assumed,
}

impl Origin {
    /// The name of the machine: that of its file, or that of the default.
    pub fn name(&self) -> &str {
        self.file.as_deref().unwrap_or(DEFAULT)
    }

    /// The name, and which keys were changed, as in `machine.toml, with knife.width_mm set`.
    pub fn described(&self) -> String {
        if self.set.is_empty() {
            return self.name().to_owned();
        }
        let keys: Vec<_> = self.set.iter().map(String::as_str).collect();
        format!("{}, with {} set", self.name(), keys.join(", "))
    }

    /// Who says where the axis stands in the blade: a width alone does not.
    pub fn axis(&self) -> Axis {
        let has = |key: &str| self.given.contains(key);
        if has("knife.width_mm") && !has("knife.back_mm") && !has("knife.radius_mm") {
            Axis::Assumed
        } else {
            Axis::Told
        }
    }
}
