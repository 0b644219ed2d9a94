//! All keys of the profile, with their values and their meanings in a cutting room.
//!
//! The commented profile, the messages about wrong values, the schema, the help and the manual derive from this one table. Its
//! rows are next to the options that they describe.

use super::codes;
pub use super::codes::{CODE_NAMES, CODES, near_codes};
use super::key::Family;
pub use super::key::{Key, Takes, Within, shown_value};
use super::plot;
use super::profile::{self, MachineProfile};
use super::{
    axes, bite, common, counts, drawings, drill, flow, gcode, knife, labels, layers, marks, nest, notches, order, path,
    patterns, sewing, sheet, table, time, tool, tracking, verify,
};

/// Rows of each section, in the order of a written profile.
const SECTIONS: &[&[Key]] = &[
    profile::KEYS,
    knife::KEYS,
    notches::KEYS,
    nest::KEYS,
    common::KEYS,
    order::KEYS,
    sheet::KEYS,
    marks::KEYS,
    drill::KEYS,
    path::KEYS,
    axes::KEYS,
    table::KEYS,
    bite::KEYS,
    time::KEYS,
    counts::KEYS,
    gcode::KEYS,
    verify::KEYS,
    drawings::KEYS,
    plot::KEYS,
    patterns::KEYS,
    labels::KEYS,
    sewing::KEYS,
    tracking::KEYS,
    flow::KEYS,
    tool::KEYS,
    codes::KEYS,
];

/// Number of keys.
const COUNT: usize = {
    let (mut count, mut section) = (0, 0);
    while section < SECTIONS.len() {
        count += SECTIONS[section].len();
        section += 1;
    }
    count
};

/// All keys, in the order of a written profile.
pub const KEYS: &[Key] = &{
    let mut keys = [SECTIONS[0][0]; COUNT];
    let (mut at, mut section) = (0, 0);
    while section < SECTIONS.len() {
        let mut row = 0;
        while row < SECTIONS[section].len() {
            keys[at] = SECTIONS[section][row];
            at += 1;
            row += 1;
        }
        section += 1;
    }
    keys
};

/// Families of keys.
const FAMILIES: [Family; 3] = [codes::FAMILY, plot::PENS, layers::LAYERS];

/// Family with a prefix.
pub(super) fn family(start: &str) -> Option<&'static Family> {
    FAMILIES.iter().find(|family| family.start == start)
}

/// Key with a dotted name.
pub fn find(name: &str) -> Option<&'static Key> {
    let is_of = |family: &&Family| {
        let word = name.strip_prefix(family.start).and_then(|rest| rest.strip_prefix('.'));
        word.is_some_and(family.has)
    };
    let family = FAMILIES.iter().find(is_of);
    let is_meant = |key: &Key| family.map_or(key.name == name, |family| key.section() == family.start);
    KEYS.iter().find(|key| is_meant(key))
}

/// True if the name is that of a table of keys, such as `axes.x`.
pub fn is_section(name: &str) -> bool {
    KEYS.iter().any(|key| key.name.strip_prefix(name).is_some_and(|rest| rest.starts_with('.')))
}

/// Default value of a key; `None` for the keys of a family.
pub fn default_of(key: &Key) -> Option<toml::Value> {
    key.value_in(&MachineProfile::default().to_table()).cloned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::MachineProfile;

    fn leaves(prefix: &str, table: &toml::Table, out: &mut Vec<String>) {
        for (name, value) in table {
            let name = if prefix.is_empty() { name.clone() } else { format!("{prefix}.{name}") };
            match value.as_table() {
                Some(inner) => leaves(&name, inner, out),
                None => out.push(name),
            }
        }
    }

    #[test]
    fn the_table_and_the_profile_have_the_same_keys() {
        let mut typed = Vec::new();
        leaves("", &toml::Table::try_from(MachineProfile::default()).expect("serialises"), &mut typed);
        typed.sort();
        let mut listed: Vec<_> = KEYS.iter().map(|key| key.name).filter(|name| !name.contains('<')).collect();
        listed.sort_unstable();
        assert_eq!(typed, listed);
    }

    #[test]
    fn codes_are_those_of_cutter_files() {
        assert!(find("codes.M19").is_some() && find("codes.A").is_some());
        assert!(["codes.", "codes.X", "codes.M019", "codes.F300", "codes.m19"].iter().all(|name| find(name).is_none()));
        assert!(is_section("codes") && is_section("axes.x") && !is_section("knife.width_mm") && !is_section("kni"));
    }

    #[test]
    fn what_a_key_expects_has_its_unit() {
        let expects = |name: &str| find(name).expect("a key").expects();
        assert_eq!(expects("knife.width_mm"), "a number from 0 to 1000 mm");
        assert_eq!(expects("knife.feed_mm_s"), "a number from 1 to 1000000 mm/s, or \"off\"");
        assert_eq!(expects("corner.angle_deg"), "a number between 0 and 75 degrees");
        assert_eq!(expects("knife.edges"), "1 or 2");
        assert_eq!(expects("knife.follow"), "\"tangent\" or \"chord\"");
        assert_eq!(expects("c.range_deg"), "two numbers [least, greatest] degrees, or \"unbounded\"");
    }
}
