//! Key of the profile: its name with the unit, its legal values and its meaning.
//!
//! The rows are next to the options that they describe; [`KEYS`](super::keys::KEYS) collects them.

use std::fmt;
use std::ops::{Bound, RangeBounds as _};

use super::encoding;
use super::gcode::Step;
use super::plot::unit::PlotUnit;
use crate::units::number::exact;

/// Key of the profile.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// Dotted name; `codes.<code>` stands for one key per code.
    pub name: &'static str,
    /// Legal values.
    pub takes: Takes,
    /// Meaning, in a line or two.
    pub about: &'static str,
}

/// Legal values of a key.
#[derive(Debug, Clone, Copy)]
pub enum Takes {
    /// A number in a range.
    Number(Within),
    /// A number in a range, or a word.
    NumberOr(Within, &'static str),
    /// A number in a range, or a word of a type.
    NumberOrWord(Within, fn() -> &'static [&'static str]),
    /// One of several whole numbers.
    Whole(&'static [i64]),
    /// A whole number from 1 to this one.
    Count(u32),
    /// A whole number of percent.
    Percent,
    /// Two numbers, `[x, y]`.
    Point,
    /// Two numbers or a word.
    PointOr(&'static str),
    /// Three numbers, `[x_mm, y_mm, c_deg]`.
    Pose,
    /// Three numbers or a word.
    PoseOr(&'static str),
    /// Two numbers, the first one smaller, or a word.
    RangeOr(&'static str),
    /// A number in a range, or a text that stands for one, such as "1/40 mm".
    Length(Within),
    /// A word of a type.
    Word(fn() -> &'static [&'static str]),
    /// The name of a text encoding.
    Encoding,
    /// Lines of text.
    Text,
    /// A list of steps of a controller.
    Steps,
    /// A list of pairs of numbers, each in its range.
    Pairs(Within, Within),
    /// True or false.
    Flag,
}

/// Range of numbers.
#[derive(Debug, Clone, Copy)]
pub struct Within {
    /// Lower end.
    pub least: Bound<f64>,
    /// Upper end.
    pub greatest: Bound<f64>,
}

/// Closed range.
pub(super) const fn from(least: f64, greatest: f64) -> Within {
    Within { least: Bound::Included(least), greatest: Bound::Included(greatest) }
}

/// Open range.
pub(super) const fn between(least: f64, greatest: f64) -> Within {
    Within { least: Bound::Excluded(least), greatest: Bound::Excluded(greatest) }
}

/// Rests of the axes, ms: longer ones are a wrong unit.
pub(super) const REST: Within = from(0.0, 10_000.0);
/// Greatest speeds, per s: slower axes would make programs of astronomic length.
pub(super) const SPEED: Within = from(1.0, 1.0e6);
/// Speeds as a percentage of others: those of single segments are stored in whole percent.
pub(super) const PERCENT: Within = from(1.0, 100.0);
/// Positions on a table and of C, mm and degrees: farther ones would make programs of astronomic length.
pub(super) const PLACE: Within = from(-1.0e6, 1.0e6);

impl Within {
    /// True if the number is in the range; false for NaN.
    fn holds(self, value: f64) -> bool {
        (self.least, self.greatest).contains(&value)
    }
}

impl Takes {
    /// True if a value is legal. Texts with units must already be numbers.
    pub fn allows(self, value: &toml::Value) -> bool {
        let is = |word: &str| value.as_str() == Some(word);
        let list = |n: usize| match value.as_array() {
            Some(items) if items.len() == n => items.iter().map(number).collect::<Option<Vec<f64>>>(),
            _ => None,
        };
        let places = |n: usize| list(n).is_some_and(|items| items.iter().all(|&v| PLACE.holds(v)));
        match self {
            Self::Number(within) => number(value).is_some_and(|v| within.holds(v)),
            Self::NumberOr(within, word) => is(word) || number(value).is_some_and(|v| within.holds(v)),
            Self::NumberOrWord(within, words) => {
                words().iter().any(|word| is(word)) || number(value).is_some_and(|v| within.holds(v))
            }
            Self::Whole(numbers) => value.as_integer().is_some_and(|v| numbers.contains(&v)),
            Self::Count(most) => value.as_integer().is_some_and(|v| (1..=i64::from(most)).contains(&v)),
            Self::Percent => number(value).is_some_and(|v| PERCENT.holds(v) && v.fract() == 0.0),
            Self::Point => places(2),
            Self::PointOr(word) => is(word) || places(2),
            Self::Pose => places(3),
            Self::PoseOr(word) => is(word) || places(3),
            Self::RangeOr(word) => is(word) || (places(2) && list(2).is_some_and(|ends| ends[0] < ends[1])),
            Self::Length(within) => {
                let text = value.as_str().and_then(PlotUnit::parse).map(|unit| unit.mm());
                text.or_else(|| number(value)).is_some_and(|v| within.holds(v))
            }
            Self::Word(words) => words().iter().any(|word| is(word)),
            Self::Encoding => value.as_str().is_some_and(|name| encoding::find(name).is_some()),
            Self::Text => {
                value.as_str().is_some_and(|text| text.chars().all(|c| c == '\n' || (' '..='~').contains(&c)))
            }
            Self::Steps => {
                let is_step = |step: &toml::Value| step.as_str().is_some_and(|text| Step::read(text).is_ok());
                value.as_array().is_some_and(|steps| steps.iter().all(is_step))
            }
            Self::Pairs(first, second) => {
                let is_pair = |pair: &toml::Value| match pair.as_array().map(Vec::as_slice) {
                    Some([a, b]) => {
                        number(a).is_some_and(|v| first.holds(v)) && number(b).is_some_and(|v| second.holds(v))
                    }
                    Some(_) | None => false,
                };
                value.as_array().is_some_and(|pairs| pairs.iter().all(is_pair))
            }
            Self::Flag => value.is_bool(),
        }
    }
}

fn number(value: &toml::Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

/// Words of a type, as listed in a message.
fn quoted(words: fn() -> &'static [&'static str]) -> String {
    let quoted: Vec<_> = words().iter().map(|word| format!("\"{word}\"")).collect();
    let (last, others) = quoted.split_last().expect("a type has words");
    if others.is_empty() { last.clone() } else { format!("{} or {last}", others.join(", ")) }
}

/// Table with a dotted name.
fn table_of<'t>(name: &str, profile: &'t toml::Table) -> Option<&'t toml::Table> {
    let mut names = name.split('.').filter(|name| !name.is_empty());
    names.try_fold(profile, |table, name| table.get(name)?.as_table())
}

/// Least magnitude shown with an exponent.
const EXPONENT_FROM: f64 = 1.0e7;

/// Units of the three numbers of a pose.
const POSE_UNITS: [&str; 3] = ["mm", "mm", "degrees"];

/// Readable text of a number.
fn shown(value: f64) -> String {
    if value.abs() >= EXPONENT_FROM { format!("{value:e}") } else { exact(value) }
}

/// Readable text of a value: `6.6`, `1e12`, `[0, 90]`, `"off"`.
pub fn shown_value(value: &toml::Value) -> String {
    match (value.as_array(), value.as_float()) {
        (Some(items), _) => format!("[{}]", items.iter().map(shown_value).collect::<Vec<_>>().join(", ")),
        (None, Some(number)) => shown(number),
        (None, None) => value.to_string(),
    }
}

impl fmt::Display for Within {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.least, self.greatest) {
            (Bound::Excluded(least), Bound::Excluded(greatest)) => {
                write!(f, "between {} and {}", shown(least), shown(greatest))
            }
            (
                Bound::Included(least) | Bound::Excluded(least),
                Bound::Included(greatest) | Bound::Excluded(greatest),
            ) => {
                write!(f, "from {} to {}", shown(least), shown(greatest))
            }
            (Bound::Unbounded, _) | (_, Bound::Unbounded) => write!(f, "without bounds"),
        }
    }
}

impl Key {
    /// Unit of its numbers, from the end of its name; empty if they have none.
    pub fn unit(&self) -> &'static str {
        const UNITS: [(&str, &str); 17] = [
            ("per_mm", "counts/mm"),
            ("per_deg", "counts/degree"),
            (".offset", "counts"),
            (".lines", "mm"),
            (".origin", "mm"),
            ("_mm", "mm"),
            ("_mm2", "mm2"),
            ("_mm_s", "mm/s"),
            ("_mm_s2", "mm/s2"),
            ("_mm_s3", "mm/s3"),
            ("_deg", "degrees"),
            ("_deg_s", "degrees/s"),
            ("_deg_s2", "degrees/s2"),
            ("_deg_s3", "degrees/s3"),
            ("_ms", "ms"),
            ("_hz", "Hz"),
            ("_rpm", "rpm"),
        ];
        let percent = self.name.ends_with("_percent").then_some("percent");
        UNITS.iter().find(|(end, _)| self.name.ends_with(end)).map(|&(_, unit)| unit).or(percent).unwrap_or("")
    }

    /// Unit of its n-th number if that may be given in other units; else empty.
    pub fn unit_of(&self, n: usize) -> &'static str {
        match self.takes {
            Takes::Number(_)
            | Takes::NumberOr(..)
            | Takes::NumberOrWord(..)
            | Takes::Percent
            | Takes::Point
            | Takes::PointOr(_)
            | Takes::RangeOr(_) => self.unit(),
            Takes::Pose | Takes::PoseOr(_) => POSE_UNITS.get(n).copied().unwrap_or(""),
            // A length of a plot's unit is a special text.
            Takes::Length(_)
            | Takes::Whole(_)
            | Takes::Count(_)
            | Takes::Word(_)
            | Takes::Encoding
            | Takes::Text
            | Takes::Steps
            | Takes::Pairs(..)
            | Takes::Flag => "",
        }
    }

    /// Description of its legal values for a message: `a number from 0 to 1000 mm, or "off"`.
    pub fn expects(&self) -> String {
        let unit = if self.unit().is_empty() { String::new() } else { format!(" {}", self.unit()) };
        match self.takes {
            Takes::Number(within) => format!("a number {within}{unit}"),
            Takes::NumberOr(within, word) => format!("a number {within}{unit}, or \"{word}\""),
            Takes::NumberOrWord(within, words) => format!("a number {within}{unit}, {}", quoted(words)),
            Takes::Percent => format!("a whole number {PERCENT}{unit}"),
            Takes::Whole(numbers) => numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(" or "),
            Takes::Count(most) => format!("a whole number from 1 to {most}"),
            Takes::Point => format!("two numbers [x, y]{unit}"),
            Takes::PointOr(word) => format!("two numbers [x, y]{unit}, or \"{word}\""),
            Takes::Pose => "three numbers [x_mm, y_mm, c_deg]".to_owned(),
            Takes::PoseOr(word) => format!("three numbers [x_mm, y_mm, c_deg], or \"{word}\""),
            Takes::RangeOr(word) => format!("two numbers [least, greatest]{unit}, or \"{word}\""),
            Takes::Length(within) => {
                format!("a number {within} mm, or a text such as \"1/40 mm\", \"1/1000 in\", \"600 dpi\"")
            }
            Takes::Word(words) => quoted(words),
            Takes::Encoding => "the name of an encoding, such as \"windows-1251\"".to_owned(),
            Takes::Text => "text, a line or several".to_owned(),
            Takes::Steps => "a list of steps, such as [\"M64 P0\", \"G4 P0.05\"]".to_owned(),
            Takes::Pairs(first, second) => {
                format!("a list of pairs, the first number of each {first}, the second {second}")
            }
            Takes::Flag => "true or false".to_owned(),
        }
    }

    /// Value of the key in a profile; `None` for a family of keys.
    pub(super) fn value_in<'t>(&self, profile: &'t toml::Table) -> Option<&'t toml::Value> {
        table_of(self.section(), profile)?.get(self.name.rsplit('.').next()?)
    }

    /// Values of all keys of a family in a profile.
    pub(super) fn values_in<'t>(&self, profile: &'t toml::Table) -> Option<&'t toml::Table> {
        table_of(self.section(), profile)
    }

    /// Part of its name before the last dot; empty for top-level keys.
    pub fn section(&self) -> &'static str {
        self.name.rsplit_once('.').map_or("", |(section, _)| section)
    }
}

/// Family of keys, as many as the profile likes: one per code or pen.
#[derive(Debug, Clone, Copy)]
pub(super) struct Family {
    /// Common prefix of their names, without the dot; also that of the one row that describes them.
    pub(super) start: &'static str,
    /// Test of the word after the dot.
    pub(super) has: fn(&str) -> bool,
    /// Regular expression for the word after the dot; it also accepts other spellings.
    pub(super) pattern: fn() -> String,
    /// Example line.
    pub(super) example: &'static str,
}
