//! The rules between the values of a profile, and each value's own range.

use super::encoding;
use super::keys::{KEYS, Key, Takes, shown_value};
use super::lines;
use super::profile::MachineProfile;
use crate::diagnostic::{Code, code};

/// Something that a profile may not say.
#[derive(Debug)]
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

/// How much `back_mm` and `radius_mm` together may miss the width, mm: they are read off a gauge in hundredths.
const BLADE_EPSILON: f64 = 0.005;
/// A whole turn, degrees.
const TURN_DEG: f64 = 360.0;
/// How much more than all headings C must reach, degrees: on curves it stays clear of the ends of its range.
const REACH_DEG: f64 = 10.0;

/// All faults of a profile. `is_given` tells the keys that the user gave: only those can contradict each other.
pub(super) fn validate(profile: &MachineProfile, is_given: &dyn Fn(&str) -> bool) -> Vec<Fault> {
    let mut faults = ranges(profile);
    let broken: Vec<String> = faults.iter().flat_map(|fault| fault.keys.clone()).collect();
    // A rule between two values says nothing new about one that is out of its own range.
    let further = rules(profile, is_given).into_iter();
    faults.extend(further.filter(|fault| !fault.keys.iter().any(|key| broken.contains(key))));
    faults
}

/// Each value by itself.
fn ranges(profile: &MachineProfile) -> Vec<Fault> {
    let table = toml::Value::try_from(profile).expect("a profile holds numbers, words and named tables");
    let fault = |key: &Key| {
        let value = key.name.split('.').try_fold(&table, |inner, part| inner.get(part))?;
        (!key.takes.allows(value)).then(|| Fault {
            code: &code::PROFILE_RANGE,
            keys: vec![key.name.to_owned()],
            message: format!("`{}` must be {}, but is {}", key.name, key.expects(), shown_value(value)),
            hint: hint(key, value),
        })
    };
    // A family of keys holds words, which reading has checked.
    KEYS.iter().filter(|key| !key.is_family()).filter_map(fault).collect()
}

/// What to do about a value that is out of its range, where more can be said than what the key takes.
fn hint(key: &Key, value: &toml::Value) -> Option<String> {
    let name = value.as_str().filter(|_| matches!(key.takes, Takes::Encoding))?;
    let near: Vec<String> = encoding::nearest(name).iter().map(|name| format!("\"{name}\"")).collect();
    Some(format!("the nearest are {}", near.join(", ")))
}

/// One value against another.
fn rules(profile: &MachineProfile, is_given: &dyn Fn(&str) -> bool) -> Vec<Fault> {
    let mut faults = Vec::new();
    let mut broken = |keys: &[&str], message: String, hint: &str| {
        let keys = keys.iter().map(|&key| key.to_owned()).collect();
        faults.push(Fault { code: &code::PROFILE_RANGE, keys, message, hint: Some(hint.to_owned()) });
    };
    let knife = &profile.knife;
    let width = knife.width_mm;
    let given_back = knife.back_mm.filter(|_| is_given("knife.back_mm") && width > 0.0);
    if let Some(back) = given_back.filter(|&back| back > width) {
        let message = format!("`knife.back_mm` is {back} mm, more than `knife.width_mm`, {width} mm");
        broken(&["knife.back_mm", "knife.width_mm"], message, "the width is the blade from heel to tip, back included");
    }
    match (knife.radius_mm, given_back) {
        (Some(radius), _) if radius > width => {
            let message = format!("`knife.radius_mm` is {radius} mm, more than `knife.width_mm`, {width} mm");
            let hint = "the width is the blade from heel to tip, radius included";
            broken(&["knife.radius_mm", "knife.width_mm"], message, hint);
        }
        (Some(radius), Some(back)) if back <= width && (back + radius - width).abs() > BLADE_EPSILON => {
            let message = format!(
                "`knife.back_mm` and `knife.radius_mm` disagree: {back} mm and {radius} mm are not the {width} mm of `knife.width_mm`"
            );
            broken(&["knife.radius_mm", "knife.back_mm", "knife.width_mm"], message, "give only one of the two");
        }
        (Some(_) | None, _) => {}
    }
    if let Some(clear) = knife.clear_ms.filter(|&clear| clear > knife.lift_ms) {
        let message = format!("`knife.clear_ms` is {clear} ms, more than `knife.lift_ms`, {} ms", knife.lift_ms);
        broken(&["knife.clear_ms", "knife.lift_ms"], message, "the blade is clear before it is all the way up");
    }
    if let Some(longest) = knife.max_down_mm.filter(|&longest| longest <= knife.overlaps()) {
        let message =
            format!("`knife.max_down_mm` is {longest} mm, no more than the overlaps, {} mm", knife.overlaps());
        broken(&["knife.max_down_mm"], message, "a cut is rejoined with its overlaps, which count");
    }
    let reach = TURN_DEG / f64::from(knife.edges.clamp(1, 2)) + REACH_DEG;
    if let Some([least, greatest]) = profile.c.range_deg.filter(|[least, greatest]| greatest - least < reach) {
        let message = format!("`c.range_deg` spans {} degrees, less than {reach}", greatest - least);
        broken(&["c.range_deg"], message, "the blade must reach every heading, and go on from it a little either way");
    }
    for (key, c) in [("home", Some(profile.home[2])), ("park", profile.park.map(|park| park[2]))] {
        let outside = |[least, greatest]: &[f64; 2]| c.is_some_and(|c| c < *least || c > *greatest);
        if let (Some([least, greatest]), Some(c)) = (profile.c.range_deg.filter(outside), c) {
            let message = format!("C of `{key}` is {c} degrees, outside `c.range_deg`, {least} to {greatest}");
            broken(&[key, "c.range_deg"], message, "C stands there, too");
        }
    }
    let gcode = &profile.gcode;
    if gcode.wrapped && profile.c.range_deg.is_some() {
        let message = "`gcode.wrapped` is true, but `c.range_deg` gives the axis ends".to_owned();
        let hint = "an axis that counts from 0 to 360 degrees goes round without end: leave one of the two out";
        broken(&["gcode.wrapped", "c.range_deg"], message, hint);
    }
    let (askew, judged) = (gcode.heading_tolerance_deg, profile.verify.max_heading_deg);
    if is_given("gcode.heading_tolerance_deg") && askew > judged {
        let message = format!(
            "`gcode.heading_tolerance_deg` is {askew} degrees, more than `verify.max_heading_deg`, {judged} degrees"
        );
        let hint = "the program would be refused by what it is judged by";
        broken(&["gcode.heading_tolerance_deg", "verify.max_heading_deg"], message, hint);
    }
    for fault in lines::faults(profile) {
        broken(&fault.keys, fault.message, &fault.hint);
    }
    faults
}
