//! Numbers with a unit, as people write them: `45 m/min`, `0.25 in`, `2 rev/s`, `50 ms`.
//!
//! A unit is a length, an angle, a time or a share; lengths and angles may be divided by a power of time. All factors are
//! quotients of two numbers, exact wherever the definition is exact, and a value is multiplied and divided only once. So 0.25
//! in is the product of 0.25 and 127/5, and 45 m/min is 750 mm/s, without a rounding remainder.

use std::f64::consts::PI;

/// Measured quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Base {
    Length,
    Angle,
    Time,
    Share,
}

/// A unit: its quantity, the power of time in its denominator, and its size in mm, degrees, s or percent as a quotient.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Unit {
    base: Base,
    per: i32,
    times: f64,
    over: f64,
}

/// Names of units, their quantity, and their size as a quotient: mm, degrees, s, percent.
const UNITS: &[(&[&str], Base, f64, f64)] = &[
    (&["mm", "millimetre", "millimetres", "millimeter", "millimeters"], Base::Length, 1.0, 1.0),
    (&["cm"], Base::Length, 10.0, 1.0),
    (&["m", "metre", "metres", "meter", "meters"], Base::Length, 1000.0, 1.0),
    (&["um", "\u{b5}m", "\u{3bc}m"], Base::Length, 1.0, 1000.0),
    (&["in", "inch", "inches", "\""], Base::Length, 127.0, 5.0),
    (&["mil", "thou"], Base::Length, 127.0, 5000.0),
    (&["ft", "foot", "feet"], Base::Length, 1524.0, 5.0),
    (&["deg", "degree", "degrees", "\u{b0}"], Base::Angle, 1.0, 1.0),
    (&["rev", "turn", "turns"], Base::Angle, 360.0, 1.0),
    (&["rad"], Base::Angle, 180.0, PI),
    (&["s", "sec", "second", "seconds"], Base::Time, 1.0, 1.0),
    (&["ms"], Base::Time, 1.0, 1000.0),
    (&["min", "minute", "minutes"], Base::Time, 60.0, 1.0),
    (&["percent", "%"], Base::Share, 1.0, 1.0),
];

/// Abbreviations of compound units.
const SHORT: &[(&str, &str)] = &[("rpm", "rev/min"), ("ipm", "in/min"), ("ips", "in/s"), ("fpm", "ft/min")];

/// Greatest power of time in a denominator: that of a jerk.
const GREATEST_POWER: i32 = 3;

/// Reason why a text is not a value in the requested unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NotQuantity {
    /// It does not start with a number, or has no unit after it.
    NoQuantity,
    /// The text after the number is not a unit.
    NoUnit,
    /// It measures another quantity, which is named, such as `a speed`.
    Measures(&'static str),
}

/// The value of a text such as `45 m/min` in the requested unit, such as `mm/s`.
pub fn value_in(text: &str, wanted: &str) -> Result<f64, NotQuantity> {
    let (number, unit) = parted(text.trim()).ok_or(NotQuantity::NoQuantity)?;
    let given = Unit::parse(unit).ok_or(NotQuantity::NoUnit)?;
    let Some(wanted) = Unit::parse(wanted) else { return Err(NotQuantity::Measures(given.measures())) };
    if (given.base, given.per) != (wanted.base, wanted.per) {
        return Err(NotQuantity::Measures(given.measures()));
    }
    let value = number * (given.times * wanted.over) / (given.over * wanted.times);
    if value.is_finite() { Ok(value) } else { Err(NotQuantity::NoQuantity) }
}

/// Name of the quantity of a unit, such as `a speed`, and example values in other units of the kind; `None` for a text that is
/// not a unit.
pub fn kind(unit: &str) -> Option<(&'static str, &'static str)> {
    let unit = Unit::parse(unit)?;
    Some((unit.measures(), unit.examples()))
}

impl Unit {
    /// Reads a unit: `mm`, `m/min`, `deg/s2`, `mm/s^2`, `rev/s/s`, `rpm`.
    fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        let text = SHORT.iter().find(|(short, _)| *short == text).map_or(text, |(_, long)| long);
        let mut parts = text.split('/').map(str::trim);
        let mut unit = Self::named(parts.next()?)?;
        for part in parts {
            let (name, power) = powered(part);
            let time = Self::named(name).filter(|time| time.base == Base::Time)?;
            unit.per += power;
            unit.times *= time.over.powi(power);
            unit.over *= time.times.powi(power);
        }
        let is_moved = matches!(unit.base, Base::Length | Base::Angle);
        (unit.per == 0 || (is_moved && unit.per <= GREATEST_POWER)).then_some(unit)
    }

    fn named(name: &str) -> Option<Self> {
        let (_, base, times, over) = *UNITS.iter().find(|(names, ..)| names.contains(&name))?;
        Some(Self { base, per: 0, times, over })
    }

    fn measures(self) -> &'static str {
        match (self.base, self.per) {
            (Base::Length, 0) => "a length",
            (Base::Length, 1) => "a speed",
            (Base::Length, 2) => "an acceleration",
            (Base::Length, _) => "a jerk",
            (Base::Angle, 0) => "an angle",
            (Base::Angle, 1) => "a speed of turning",
            (Base::Angle, 2) => "an acceleration of turning",
            (Base::Angle, _) => "a jerk of turning",
            (Base::Time, _) => "a time",
            (Base::Share, _) => "a share",
        }
    }

    fn examples(self) -> &'static str {
        match (self.base, self.per) {
            (Base::Length, 0) => "\"6.35 mm\" or \"0.25 in\"",
            (Base::Length, 1) => "\"750 mm/s\" or \"45 m/min\"",
            (Base::Length, 2) => "\"8000 mm/s2\" or \"8 m/s2\"",
            (Base::Length, _) => "\"200000 mm/s3\" or \"200 m/s3\"",
            (Base::Angle, 0) => "\"45 deg\" or \"0.125 rev\"",
            (Base::Angle, 1) => "\"720 deg/s\" or \"2 rev/s\"",
            (Base::Angle, 2) => "\"18000 deg/s2\" or \"50 rev/s2\"",
            (Base::Angle, _) => "\"1000000 deg/s3\" or \"2500 rev/s3\"",
            (Base::Time, _) => "\"50 ms\" or \"0.05 s\"",
            (Base::Share, _) => "\"75 %\"",
        }
    }
}

/// Splits a name from its power: `s`, `s2`, `s^2`.
fn powered(text: &str) -> (&str, i32) {
    for (ends, power) in [(["^2", "2", "\u{b2}"], 2), (["^3", "3", "\u{b3}"], 3)] {
        if let Some(name) = ends.iter().find_map(|end| text.strip_suffix(end)) {
            return (name.trim_end(), power);
        }
    }
    (text, 1)
}

/// Splits a text into its leading number, also a quotient such as `1/4`, and the rest; `None` when one of them is missing.
fn parted(text: &str) -> Option<(f64, &str)> {
    let bytes = text.as_bytes();
    // An e belongs to the number when it is between digits.
    let is_exponent = |at: usize| {
        let behind = bytes.get(at + 1).is_some_and(|&b| b.is_ascii_digit() || matches!(b, b'+' | b'-'));
        matches!(bytes[at], b'e' | b'E') && behind && at > 0 && matches!(bytes[at - 1], b'0'..=b'9' | b'.')
    };
    let of_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-' | '/' | ' ');
    let end = text.char_indices().find(|&(at, c)| !of_number(c) && !is_exponent(at)).map(|(at, _)| at)?;
    let (number, unit) = text.split_at(end);
    // A comma belongs neither to a number nor to a unit.
    if unit.starts_with(',') {
        return None;
    }
    let value = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
    let number = match number.split_once('/') {
        Some((above, below)) => value(above)? / value(below).filter(|&below| below > 0.0)?,
        None => value(number)?,
    };
    Some((number, unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_come_out_in_the_unit_that_is_wanted_and_nothing_is_left_over() {
        let check = |text: &str, wanted: &str, expected: f64| {
            assert_eq!(value_in(text, wanted), Ok(expected), "{text} in {wanted}");
        };
        check("0.25 in", "mm", 6.35);
        check("0.25in", "mm", 6.35);
        check("0.25\"", "mm", 6.35);
        check("1/4 in", "mm", 6.35);
        check("1.27 cm", "mm", 12.7);
        check("10 m", "mm", 10_000.0);
        check("250 um", "mm", 0.25);
        check("-1.5 m", "mm", -1500.0);
        check("6 ft", "mm", 1828.8);
        check("100 mil", "mm", 2.54);
        check("45 m/min", "mm/s", 750.0);
        check("1.2 m/s", "mm/s", 1200.0);
        check("600 in/min", "mm/s", 254.0);
        check("600 ipm", "mm/s", 254.0);
        check("8 m/s2", "mm/s2", 8000.0);
        check("8 m/s^2", "mm/s2", 8000.0);
        check("8 m/s/s", "mm/s2", 8000.0);
        check("0.2 m/s\u{b3}", "mm/s3", 200.0);
        check("2e5 mm/s3", "mm/s3", 200_000.0);
        check("2 rev/s", "degrees/s", 720.0);
        check("180 rpm", "degrees/s", 1080.0);
        check("45\u{b0}", "degrees", 45.0);
        check("50 ms", "ms", 50.0);
        check("70 ms", "ms", 70.0);
        check("0.07 s", "ms", 70.0);
        check("1 min", "ms", 60_000.0);
        check("75 %", "percent", 75.0);
        let quarter = value_in(&format!("{} rad", std::f64::consts::FRAC_PI_4), "degrees").expect("an angle");
        assert!((quarter - 45.0).abs() < 1e-12, "{quarter}");
    }

    #[test]
    fn what_is_no_value_in_the_unit_says_why() {
        let check = |text: &str, wanted: &str, expected| assert_eq!(value_in(text, wanted), Err(expected), "{text}");
        check("45 m/min", "mm", NotQuantity::Measures("a speed"));
        check("45 mm", "mm/s", NotQuantity::Measures("a length"));
        check("2 rev/s", "mm/s", NotQuantity::Measures("a speed of turning"));
        check("5 s", "", NotQuantity::Measures("a time"));
        check("45 furlongs", "mm", NotQuantity::NoUnit);
        check("1 mm/in", "mm", NotQuantity::NoUnit);
        check("1 s/s", "ms", NotQuantity::NoUnit);
        check("1 mm/s3/s", "mm", NotQuantity::NoUnit);
        for text in ["", "mm", "45", "off", "1/0 in", "nan mm", "1e999 mm", "--1 mm", ". mm", "6,6", "6,6 mm"] {
            check(text, "mm", NotQuantity::NoQuantity);
        }
    }

    #[test]
    fn every_example_is_a_value_of_its_kind() {
        for unit in
            ["mm", "mm/s", "mm/s2", "mm/s3", "degrees", "degrees/s", "degrees/s2", "degrees/s3", "ms", "percent"]
        {
            let (_, examples) = kind(unit).expect("a unit");
            for example in examples.split(" or ") {
                assert!(value_in(example.trim_matches('"'), unit).is_ok(), "{example} in {unit}");
            }
        }
        assert_eq!(kind("counts"), None);
    }
}
