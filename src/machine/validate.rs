//! Rules between the values of a profile, and the range of each value.

use super::encoding;
use super::fault::Fault;
use super::flow;
use super::gcode;
use super::key::{Key, Takes, shown_value};
use super::keys::KEYS;
use super::knife::Knife;
use super::profile::MachineProfile;
use super::tool::ToolKind;
use super::{sewing, tool, tracking};
use crate::diagnostic::code;

/// Permitted difference between the width and the sum of `back_mm` and `radius_mm`, mm: they are read off a gauge in
/// hundredths.
const BLADE_EPSILON: f64 = 0.005;
/// Full turn, degrees.
const TURN_DEG: f64 = 360.0;
/// Excess of the range of C over all headings, degrees: on curves C stays clear of the ends of its range.
const REACH_DEG: f64 = 10.0;

/// All faults of a profile. `is_given` selects the keys that the user gave: only those can contradict each other.
pub(super) fn validate(profile: &MachineProfile, is_given: &dyn Fn(&str) -> bool) -> Vec<Fault> {
    let mut faults = ranges(profile, is_given);
    let broken: Vec<String> = faults.iter().flat_map(|fault| fault.keys.clone()).collect();
    // A rule between two values says nothing new about one that is out of its own range.
    let further = rules(profile, is_given).into_iter();
    faults.extend(further.filter(|fault| !fault.keys.iter().any(|key| broken.contains(key))));
    faults
}

/// Faults of single values; defaults are in their ranges.
fn ranges(profile: &MachineProfile, is_given: &dyn Fn(&str) -> bool) -> Vec<Fault> {
    let table = profile.to_table();
    let fault = |key: &Key| {
        let value = key.value_in(&table)?;
        (!key.takes.allows(value)).then(|| Fault {
            code: &code::PROFILE_RANGE,
            keys: vec![key.name.to_owned()],
            message: format!("`{}` must be {}, but is {}", key.name, key.expects(), shown_value(value)),
            hint: hint(key, value),
        })
    };
    // Families of keys hold words, which loading has checked.
    KEYS.iter().filter(|key| is_given(key.name)).filter_map(fault).collect()
}

/// Hint for a value out of range, where there is more to say than the legal values.
fn hint(key: &Key, value: &toml::Value) -> Option<String> {
    let name = value.as_str().filter(|_| matches!(key.takes, Takes::Encoding))?;
    let near: Vec<String> = encoding::nearest(name).iter().map(|name| format!("\"{name}\"")).collect();
    Some(format!("the nearest are {}", near.join(", ")))
}

/// Faults of values against each other.
fn rules(profile: &MachineProfile, is_given: &dyn Fn(&str) -> bool) -> Vec<Fault> {
    let mut faults = blade(&profile.knife, is_given);
    faults.extend(times(&profile.knife));
    faults.extend(headings(profile, is_given));
    faults.extend(parked_off_table(profile));
    faults.extend(gcode::faults(profile));
    faults.extend(sewing::faults(&profile.sewing));
    faults.extend(tracking::faults(&profile.track));
    faults.extend(flow::faults(&profile.flow));
    faults.extend(tool::faults(&profile.tool, &profile.knife, is_given));
    faults.extend(bites(profile));
    faults
}

/// Fault of the window of a conveyor against the tool and the table.
fn bites(profile: &MachineProfile) -> Option<Fault> {
    let length = profile.bite.length_mm?;
    if profile.tool.kind == ToolKind::Spray {
        let message =
            "`bite.length_mm` is given, and `tool.kind` is \"spray\": a spray head goes over cloth that lies still";
        return Some(Fault::of_range(&["bite.length_mm"], message.to_owned(), "leave `bite.length_mm` out"));
    }
    let [start, end] = profile.table.x_mm?;
    (length > end - start).then(|| {
        let message = format!("`bite.length_mm` is {length} mm, more than `table.x_mm` has, {} mm", end - start);
        Fault::of_range(&["bite.length_mm", "table.x_mm"], message, "a bite is what lies on the table")
    })
}

/// Faults of the lengths of the blade.
fn blade(knife: &Knife, is_given: &dyn Fn(&str) -> bool) -> Vec<Fault> {
    let mut faults = Vec::new();
    let width = knife.width_mm;
    let given_back = knife.back_mm.filter(|_| is_given("knife.back_mm") && width > 0.0);
    if let Some(back) = given_back.filter(|&back| back > width) {
        let message = format!("`knife.back_mm` is {back} mm, more than `knife.width_mm`, {width} mm");
        let hint = "the width is the blade from heel to tip, back included";
        faults.push(Fault::of_range(&["knife.back_mm", "knife.width_mm"], message, hint));
    }
    match (knife.radius_mm, given_back) {
        (Some(radius), _) if radius > width => {
            let message = format!("`knife.radius_mm` is {radius} mm, more than `knife.width_mm`, {width} mm");
            let hint = "the width is the blade from heel to tip, radius included";
            faults.push(Fault::of_range(&["knife.radius_mm", "knife.width_mm"], message, hint));
        }
        (Some(radius), Some(back)) if back <= width && (back + radius - width).abs() > BLADE_EPSILON => {
            let message = format!(
                "`knife.back_mm` and `knife.radius_mm` disagree: {back} mm and {radius} mm are not the {width} mm of `knife.width_mm`"
            );
            let keys = ["knife.radius_mm", "knife.back_mm", "knife.width_mm"];
            faults.push(Fault::of_range(&keys, message, "give only one of the two"));
        }
        (Some(_) | None, _) => {}
    }
    faults
}

/// Faults of the times with the knife up, and of the length with the knife down.
fn times(knife: &Knife) -> Vec<Fault> {
    let mut faults = Vec::new();
    if let Some(clear) = knife.clear_ms.filter(|&clear| clear > knife.lift_ms) {
        let message = format!("`knife.clear_ms` is {clear} ms, more than `knife.lift_ms`, {} ms", knife.lift_ms);
        let hint = "the blade is clear before it is all the way up";
        faults.push(Fault::of_range(&["knife.clear_ms", "knife.lift_ms"], message, hint));
    }
    if let Some(longest) = knife.max_down_mm.filter(|&longest| longest <= knife.overlaps()) {
        let message =
            format!("`knife.max_down_mm` is {longest} mm, no more than the overlaps, {} mm", knife.overlaps());
        faults.push(Fault::of_range(
            &["knife.max_down_mm"],
            message,
            "a cut is rejoined with its overlaps, which count",
        ));
    }
    faults
}

/// Fault of a place to park that the axes cannot reach.
fn parked_off_table(profile: &MachineProfile) -> Option<Fault> {
    let [x, y, _] = profile.park?;
    let beyond = profile.table.off([x, y]);
    (beyond > 0.0).then(|| {
        let message = format!("`park` is {beyond} mm off the table, at {x}, {y} mm");
        Fault::of_range(&["park", "table.x_mm", "table.y_mm"], message, "the axes stay over the table: park there")
    })
}

/// Faults of the range of the C axis and of its accuracy.
fn headings(profile: &MachineProfile, is_given: &dyn Fn(&str) -> bool) -> Vec<Fault> {
    let mut faults = Vec::new();
    let reach = TURN_DEG / f64::from(profile.knife.edges.clamp(1, 2)) + REACH_DEG;
    if let Some([least, greatest]) = profile.c.range_deg {
        if greatest - least < reach {
            let message = format!("`c.range_deg` spans {} degrees, less than {reach}", greatest - least);
            let hint = "the blade must reach every heading, and go on from it a little either way";
            faults.push(Fault::of_range(&["c.range_deg"], message, hint));
        }
        for (key, pose) in [("home", Some(profile.home)), ("park", profile.park)] {
            if let Some([.., c]) = pose.filter(|[.., c]| *c < least || *c > greatest) {
                let message = format!("C of `{key}` is {c} degrees, outside `c.range_deg`, {least} to {greatest}");
                faults.push(Fault::of_range(&[key, "c.range_deg"], message, "C stands there, too"));
            }
        }
        if profile.gcode.wrapped {
            let message = "`gcode.wrapped` is true, but `c.range_deg` gives the axis ends".to_owned();
            let hint = "an axis that counts from 0 to 360 degrees goes round without end: leave one of the two out";
            faults.push(Fault::of_range(&["gcode.wrapped", "c.range_deg"], message, hint));
        }
    }
    let (askew, judged) = (profile.gcode.heading_tolerance_deg, profile.verify.max_heading_deg);
    if is_given("gcode.heading_tolerance_deg") && askew > judged {
        let message = format!(
            "`gcode.heading_tolerance_deg` is {askew} degrees, more than `verify.max_heading_deg`, {judged} degrees"
        );
        let hint = "the program would be refused by what it is judged by";
        faults.push(Fault::of_range(&["gcode.heading_tolerance_deg", "verify.max_heading_deg"], message, hint));
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_break_no_rule() {
        assert_eq!(validate(&MachineProfile::default(), &|_| true), []);
    }
}
