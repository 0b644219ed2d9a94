//! Profile as TOML text, with or without an explanation of every key.

use std::fmt::Write as _;

use super::codes::CodeUse;
use super::keys::{self, KEYS};
use super::profile::MachineProfile;

/// Comments in the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comments {
    /// A comment above every key.
    Explained,
    /// Values only.
    Plain,
}

/// Rounding of the back derived from the width, steps per mm: the subtraction adds less.
const BACK_DECIMALS: f64 = 1e9;

impl MachineProfile {
    /// Profile with the effective blade in place of derived values.
    #[must_use]
    pub fn effective(&self) -> Self {
        let mut profile = self.clone();
        profile.knife.back_mm = Some((self.knife.back() * BACK_DECIMALS).round() / BACK_DECIMALS);
        profile.knife.radius_mm = None;
        profile.codes.retain(|_, used| *used == CodeUse::Ignore);
        profile
    }

    /// Value of a key, as in a profile; `None` if there is no such key.
    pub fn value(&self, name: &str) -> Option<toml::Value> {
        let table = self.to_table();
        KEYS.iter().find(|key| key.name == name)?.value_in(&table).cloned()
    }

    /// Profile as TOML, with every key in the order of [`KEYS`]; it loads back as the same profile.
    pub fn to_toml(&self, comments: Comments) -> String {
        self.toml_of(comments, &|_| true)
    }

    /// Profile as TOML, with the keys whose names are to be kept, in the order of [`KEYS`].
    pub(super) fn toml_of(&self, comments: Comments, keep: &dyn Fn(&str) -> bool) -> String {
        let table = self.to_table();
        let mut out = String::new();
        let mut section = "";
        // Writing into a `String` cannot fail, so the results of `writeln!` are dropped throughout.
        for key in KEYS.iter().filter(|key| keep(key.name)) {
            if key.section() != section {
                section = key.section();
                let gap = if out.is_empty() { "" } else { "\n" };
                let _ = writeln!(out, "{gap}[{section}]");
            }
            if comments == Comments::Explained {
                if !out.is_empty() && !out.ends_with("]\n") {
                    out.push('\n');
                }
                for line in key.about.lines() {
                    let _ = writeln!(out, "# {line}");
                }
                let _ = writeln!(out, "# {}", key.expects());
            }
            if let Some(family) = keys::family(section) {
                let values = key.values_in(&table).expect("a family of keys is a table");
                for (name, value) in values {
                    let _ = writeln!(out, "{name} = {value}");
                }
                if values.is_empty() && comments == Comments::Explained {
                    let _ = writeln!(out, "# {}", family.example);
                }
                continue;
            }
            let value = key.value_in(&table).expect("a test compares the table with the profile");
            let name = key.name.rsplit('.').next().unwrap_or(key.name);
            let _ = writeln!(out, "{name} = {value}");
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::load;
    use crate::source::Source;

    #[test]
    fn what_is_shown_loads_back() {
        let mut profile = MachineProfile { park: Some([1.0, -2.5, 90.0]), ..MachineProfile::default() };
        profile.codes.insert("M19".to_owned(), CodeUse::Ignore);
        profile.knife.feed_mm_s = None;
        for profile in [MachineProfile::default(), profile] {
            for comments in [Comments::Explained, Comments::Plain] {
                let text = profile.to_toml(comments);
                let source = Source::new("shown", text.into_bytes()).expect("small");
                assert_eq!(load(Some(&source), &[]).expect("legal"), profile);
            }
        }
    }

    #[test]
    fn comments_fit_a_terminal() {
        let text = MachineProfile::default().to_toml(Comments::Explained);
        for line in text.lines() {
            assert!(line.len() <= 100, "{line}");
        }
    }
}
