//! A profile as TOML text: with every key explained, or only the values.

use std::fmt::Write as _;

use super::keys::{CODES, KEYS};
use super::profile::{CodeUse, MachineProfile};

/// Whether the keys are explained.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comments {
    /// A comment above every key.
    Explained,
    /// Values only.
    Plain,
}

/// Decimals of the back that the width leaves, mm: what the subtraction adds is smaller.
const BACK_DECIMALS: f64 = 1e9;

impl MachineProfile {
    /// The same profile with what the blade really has in place of what follows from it.
    #[must_use]
    pub fn effective(&self) -> Self {
        let mut profile = self.clone();
        profile.knife.back_mm = Some((self.knife.back() * BACK_DECIMALS).round() / BACK_DECIMALS);
        profile.knife.radius_mm = None;
        profile.codes.retain(|_, used| *used == CodeUse::Ignore);
        profile
    }

    /// The profile as TOML, every key in the order of [`KEYS`]; it loads back as the same profile.
    pub fn to_toml(&self, comments: Comments) -> String {
        let table = toml::Value::try_from(self).expect("a profile holds numbers, words and named tables");
        let mut out = String::new();
        let mut section = "";
        // Writing into a `String` cannot fail, so the results of `writeln!` are dropped throughout.
        for key in KEYS {
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
            let of = |name: &str| name.split('.').try_fold(&table, |inner, part| inner.get(part));
            if key.is_family() {
                let family = of(section).and_then(toml::Value::as_table).expect("a family of keys is a table");
                for (name, value) in family {
                    let _ = writeln!(out, "{name} = {value}");
                }
                if family.is_empty() && comments == Comments::Explained {
                    let example = if section == CODES { "M19 = \"ignore\"" } else { "1 = \"knife\"" };
                    let _ = writeln!(out, "# {example}");
                }
                continue;
            }
            let value = of(key.name);
            let name = key.name.rsplit('.').next().unwrap_or(key.name);
            let _ = writeln!(out, "{name} = {}", value.expect("a test compares the table with the profile"));
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
