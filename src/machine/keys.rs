//! Every key of the profile: what it takes and what it means in a cutting room.
//!
//! The commented profile, the messages about wrong values, the help and the manual come from this one table.

use std::fmt;
use std::ops::{Bound, RangeBounds as _};

use super::encoding;
use super::plot::{GREATEST_UNIT_MM, LEAST_UNIT_MM, PlotUnit};
use crate::units::number::exact;

/// A key of the profile: a row of [`KEYS`].
#[derive(Debug)]
pub struct Key {
    /// Its dotted name; `codes.<code>` stands for a key a code.
    pub name: &'static str,
    /// What may stand there.
    pub takes: Takes,
    /// What it means, in a line or two.
    pub about: &'static str,
}

/// The legal values of a key.
#[derive(Debug, Clone, Copy)]
pub enum Takes {
    /// A number in a range.
    Number(Within),
    /// A number in a range, or a word.
    NumberOr(Within, &'static str),
    /// One of some whole numbers.
    Whole(&'static [i64]),
    /// A whole number of percent, from 1 to 100.
    Percent,
    /// Two numbers, `[x, y]`.
    Point,
    /// Three numbers, `[x_mm, y_mm, c_deg]`.
    Pose,
    /// Three numbers or a word.
    PoseOr(&'static str),
    /// Two numbers, the first one smaller, or a word.
    RangeOr(&'static str),
    /// A number in a range, or a text that stands for one, such as "1/40 mm".
    Length(Within),
    /// One of some words.
    Word(&'static [&'static str]),
    /// The name of an encoding of texts.
    Encoding,
    /// Lines of text.
    Text,
    /// A list of steps of a controller.
    Steps,
    /// True or false.
    Flag,
}

/// A range of numbers.
#[derive(Debug, Clone, Copy)]
pub struct Within(Bound<f64>, Bound<f64>);

const fn from(least: f64, greatest: f64) -> Within {
    Within(Bound::Included(least), Bound::Included(greatest))
}

const fn between(least: f64, greatest: f64) -> Within {
    Within(Bound::Excluded(least), Bound::Excluded(greatest))
}

/// Blades and what belongs to them, mm: longer ones are a slip of the unit.
const BLADE: Within = from(0.0, 1000.0);
/// Depths of notches, mm: deeper ones would cut into the part.
const DEPTH: Within = from(0.5, 15.0);
/// Rests of the axes, ms: longer ones are a slip of the unit.
const REST: Within = from(0.0, 10_000.0);
/// Greatest speeds, per s: slower axes would make programs of astronomic length.
const SPEED: Within = from(1.0, 1.0e6);
/// Greatest accelerations, per s2.
const ACCELERATION: Within = from(1.0, 1.0e9);
/// Greatest jerks, per s3.
const JERK: Within = from(1.0, 1.0e12);
/// Places on a table and positions of C: farther ones would make programs of astronomic length, mm and degrees.
const PLACE: Within = from(-1.0e6, 1.0e6);
/// Encoder counts of a mm or a degree.
const COUNTS: Within = from(1.0, 1.0e7);
/// What a register of 32 bits holds, counts.
const REGISTER: Within = from(-2_147_483_648.0, 2_147_483_647.0);
/// Speeds as parts of others: those of single segments are kept in whole percent.
const PERCENT: Within = from(1.0, 100.0);
/// Angles that may be anywhere within a turn, degrees.
const TURN: Within = from(-360.0, 360.0);

impl Within {
    /// Whether the number lies in the range; never for NaN.
    fn holds(self, value: f64) -> bool {
        (self.0, self.1).contains(&value)
    }
}

impl Takes {
    /// Whether a value is legal.
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
            Self::Whole(numbers) => value.as_integer().is_some_and(|v| numbers.contains(&v)),
            Self::Percent => number(value).is_some_and(|v| PERCENT.holds(v) && v.fract() == 0.0),
            Self::Point => places(2),
            Self::Pose => places(3),
            Self::PoseOr(word) => is(word) || places(3),
            Self::RangeOr(word) => is(word) || (places(2) && list(2).is_some_and(|ends| ends[0] < ends[1])),
            Self::Length(within) => {
                let text = value.as_str().and_then(PlotUnit::parse).map(|unit| unit.mm());
                text.or_else(|| number(value)).is_some_and(|v| within.holds(v))
            }
            Self::Word(words) => words.iter().any(|word| is(word)),
            Self::Encoding => value.as_str().is_some_and(|name| encoding::find(name).is_some()),
            Self::Text => {
                value.as_str().is_some_and(|text| text.chars().all(|c| c == '\n' || (' '..='~').contains(&c)))
            }
            Self::Steps => value.as_array().is_some(),
            Self::Flag => value.is_bool(),
        }
    }
}

fn number(value: &toml::Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

/// From this magnitude on a number is shown with an exponent: nobody counts more zeros.
const EXPONENT_FROM: f64 = 1.0e7;

/// Units of the numbers of a pose.
const POSE_UNITS: [&str; 3] = ["mm", "mm", "degrees"];

/// A number as people write it.
fn shown(value: f64) -> String {
    if value.abs() >= EXPONENT_FROM { format!("{value:e}") } else { exact(value) }
}

/// A value as people write it: `6.6`, `1e12`, `[0, 90]`, `"off"`.
pub fn shown_value(value: &toml::Value) -> String {
    match (value.as_array(), value.as_float()) {
        (Some(items), _) => format!("[{}]", items.iter().map(shown_value).collect::<Vec<_>>().join(", ")),
        (None, Some(number)) => shown(number),
        (None, None) => value.to_string(),
    }
}

impl fmt::Display for Within {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.0, self.1) {
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
    /// The unit of its numbers, from the end of its name; empty when they have none.
    pub fn unit(&self) -> &'static str {
        const UNITS: [(&str, &str); 12] = [
            ("per_mm", "counts/mm"),
            ("per_deg", "counts/degree"),
            (".offset", "counts"),
            ("_mm", "mm"),
            ("_mm_s", "mm/s"),
            ("_mm_s2", "mm/s2"),
            ("_mm_s3", "mm/s3"),
            ("_deg", "degrees"),
            ("_deg_s", "degrees/s"),
            ("_deg_s2", "degrees/s2"),
            ("_deg_s3", "degrees/s3"),
            ("_ms", "ms"),
        ];
        let percent = self.name.ends_with("_percent").then_some("percent");
        UNITS.iter().find(|(end, _)| self.name.ends_with(end)).map(|&(_, unit)| unit).or(percent).unwrap_or("")
    }

    /// The unit of its n-th number, which may be given in others; empty where it has none.
    pub fn unit_of(&self, n: usize) -> &'static str {
        match self.takes {
            Takes::Number(_) | Takes::NumberOr(..) | Takes::Percent | Takes::Point | Takes::RangeOr(_) => self.unit(),
            Takes::Pose | Takes::PoseOr(_) => POSE_UNITS.get(n).copied().unwrap_or(""),
            // A length of a plot's unit is a text of its own kind.
            Takes::Length(_)
            | Takes::Whole(_)
            | Takes::Word(_)
            | Takes::Encoding
            | Takes::Text
            | Takes::Steps
            | Takes::Flag => "",
        }
    }

    /// What it takes, as a message says it: `a number from 0 to 1000 mm, or "off"`.
    pub fn expects(&self) -> String {
        let unit = if self.unit().is_empty() { String::new() } else { format!(" {}", self.unit()) };
        match self.takes {
            Takes::Number(within) => format!("a number {within}{unit}"),
            Takes::NumberOr(within, word) => format!("a number {within}{unit}, or \"{word}\""),
            Takes::Percent => "a whole number from 1 to 100 percent".to_owned(),
            Takes::Whole(numbers) => numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(" or "),
            Takes::Point => format!("two numbers [x, y]{unit}"),
            Takes::Pose => "three numbers [x_mm, y_mm, c_deg]".to_owned(),
            Takes::PoseOr(word) => format!("three numbers [x_mm, y_mm, c_deg], or \"{word}\""),
            Takes::RangeOr(word) => format!("two numbers [least, greatest]{unit}, or \"{word}\""),
            Takes::Length(within) => {
                format!("a number {within} mm, or a text such as \"1/40 mm\", \"1/1000 in\", \"600 dpi\"")
            }
            Takes::Word([words @ .., last]) if !words.is_empty() => {
                let words: Vec<_> = words.iter().map(|word| format!("\"{word}\"")).collect();
                format!("{} or \"{last}\"", words.join(", "))
            }
            Takes::Word(words) => format!("\"{}\"", words.concat()),
            Takes::Encoding => "the name of an encoding, such as \"windows-1251\"".to_owned(),
            Takes::Text => "text, a line or several".to_owned(),
            Takes::Steps => "a list of steps, such as [\"M64 P0\", \"G4 P0.05\"]".to_owned(),
            Takes::Flag => "true or false".to_owned(),
        }
    }

    /// Whether it stands for a key a code or a pen.
    pub fn is_family(&self) -> bool {
        self.name.ends_with('>')
    }

    /// The part of its name before the last dot; empty for the keys at the top.
    pub fn section(&self) -> &'static str {
        self.name.rsplit_once('.').map_or("", |(section, _)| section)
    }
}

/// The start of the names of the keys that switch a code of the cutter file.
pub const CODES: &str = "codes";

/// The start of the names of the keys that say what a pen of a plot stands for.
pub const PENS: &str = "hpgl.pens";
/// What some take for such a key: with pen 0 plotters draw nothing.
pub const NO_PEN: &str = "hpgl.pens.0";

/// The key of that dotted name.
pub fn find(name: &str) -> Option<&'static Key> {
    let of = |family: &str| name.strip_prefix(family).and_then(|rest| rest.strip_prefix('.'));
    let name = match (of(CODES), of(PENS)) {
        (Some(code), _) if is_code(code) => "codes.<code>",
        (_, Some(pen)) if is_pen(pen) => "hpgl.pens.<pen>",
        _ => name,
    };
    KEYS.iter().find(|key| key.name == name)
}

/// Every code of cutter files that may be switched, without leading zeros, and without the number where that is a value.
#[rustfmt::skip] // a table: one row a letter
pub const CODE_NAMES: &[&str] = &[
    "A", "B", "E", "F", "H", "L", "N", "O", "Q", "R", "Z",
    "D1", "D2", "D4",
    "G0", "G1", "G2", "G3", "G4", "G70", "G71", "G90", "G91",
    "M0", "M1", "M14", "M15", "M17", "M18", "M19", "M20", "M23", "M25", "M26", "M30", "M31", "M40", "M41", "M42", "M43",
    "M44", "M45", "M46", "M47", "M48", "M51", "M60", "M61", "M62", "M63", "M64", "M65", "M66", "M67", "M68", "M69", "M70",
    "M72", "M73",
];

/// Codes that are named when somebody writes one that does not exist.
const NEAR_CODES: usize = 3;

fn is_code(word: &str) -> bool {
    CODE_NAMES.contains(&word)
}

/// The name of a key as the table has it: a code is spelled without the leading zeros that files write (`M01` is `M1`).
pub(super) fn canonical(name: &str) -> String {
    let plain = || {
        let code = name.strip_prefix(CODES)?.strip_prefix('.')?;
        let digits = code.find(|c: char| c.is_ascii_digit())?;
        let (letter, number) = code.split_at(digits);
        let number: u32 = number.parse().ok()?;
        Some(format!("{CODES}.{letter}{number}"))
    };
    plain().filter(|name| find(name).is_some()).unwrap_or_else(|| name.to_owned())
}

/// The keys of the codes that may be meant by one that does not exist, the likeliest first; `None` when the name is no
/// code's.
pub fn near_codes(name: &str) -> Option<Vec<String>> {
    let typed = name.strip_prefix(CODES)?.strip_prefix('.')?.to_uppercase();
    let digits = typed.find(|c: char| c.is_ascii_digit()).unwrap_or(typed.len());
    let (letter, number) = typed.split_at(digits);
    // Spelled as files spell them: M01 is M1, F300 is F.
    let significant = match number.trim_start_matches('0') {
        "" if !number.is_empty() => "0",
        significant => significant,
    };
    let spelled = [format!("{letter}{significant}"), letter.to_owned()];
    let mut codes: Vec<&str> = match CODE_NAMES.iter().find(|code| spelled.iter().any(|word| word == *code)) {
        Some(code) => vec![*code],
        None => CODE_NAMES.to_vec(),
    };
    codes.sort_by_key(|code| strsim::damerau_levenshtein(&typed, code)); // stable: the table's order among equals
    Some(codes.into_iter().take(NEAR_CODES).map(|code| format!("{CODES}.{code}")).collect())
}

/// Whether a word is the number of a pen: up to three digits, written in one way only. Pen 0 is none.
fn is_pen(word: &str) -> bool {
    let is_number = !word.is_empty() && word.len() <= 3 && word.bytes().all(|byte| byte.is_ascii_digit());
    is_number && !word.starts_with('0')
}

/// Whether the name is that of a table of keys, such as `axes.x`.
pub fn is_section(name: &str) -> bool {
    KEYS.iter().any(|key| key.name.strip_prefix(name).is_some_and(|rest| rest.starts_with('.')))
}

/// Every key, in the order in which a profile is written.
#[rustfmt::skip] // a table: one row a key
pub const KEYS: &[Key] = &[
    Key { name: "version", takes: Takes::Whole(&[1]), about: "Version of this format." },
    Key { name: "units", takes: Takes::Word(&["auto", "mm/10", "in/100", "in/1000"]), about: "Unit of the coordinates in cut files. \"auto\" believes the file (G70, G71, G91); set it for a\nfile that is drawn in another unit than it says." },
    Key { name: "home", takes: Takes::Pose, about: "Where the axes stand when a program starts." },
    Key { name: "park", takes: Takes::PoseOr("stay"), about: "Where the axes go when a program ends; \"stay\" = they stay over the last cut." },

    Key { name: "knife.width_mm", takes: Takes::Number(BLADE), about: "Knife width: the blade from heel to tip as it is today, worn by sharpening. 0 = a point." },
    Key { name: "knife.back_mm", takes: Takes::NumberOr(BLADE, "auto"), about: "From the C axis back to the heel (the advance of M17). Sharpening takes the front, so it stays\nwhile the width shrinks. \"auto\" = what radius_mm leaves." },
    Key { name: "knife.radius_mm", takes: Takes::NumberOr(BLADE, "auto"), about: "From the C axis forward to the tip. Give this or back_mm; \"auto\" = what back_mm leaves." },
    Key { name: "knife.front_overlap_mm", takes: Takes::Number(BLADE), about: "Overcut: how far the tip cuts past the end of a line." },
    Key { name: "knife.corner_front_overlap_mm", takes: Takes::Number(BLADE), about: "Corner overcut: the same before the knife is lifted at a corner." },
    Key { name: "knife.heel_overlap_mm", takes: Takes::Number(BLADE), about: "How far the heel plunges before the start of a line (back_mm less the advance before plunge)." },
    Key { name: "knife.corner_heel_overlap_mm", takes: Takes::Number(BLADE), about: "The same where the knife plunges again at a corner (back_mm less the corner advance)." },
    Key { name: "knife.reflex_front_overlap_mm", takes: Takes::Number(BLADE), about: "Overcut at the ends of lines and at corners where it would run into the part." },
    Key { name: "knife.reflex_heel_overlap_mm", takes: Takes::Number(BLADE), about: "Heel overlap at the ends of lines and at corners where it would run into the part." },
    Key { name: "knife.clearance_mm", takes: Takes::Number(BLADE), about: "How far overlaps stay away from the next part; in a narrower gap they are shortened." },
    Key { name: "knife.feed_mm_s", takes: Takes::NumberOr(SPEED, "off"), about: "Maximum cutting velocity of the tip; \"off\" = whatever the axes can do." },
    Key { name: "knife.slow_percent", takes: Takes::Percent, about: "Speed of slowed cuts (M25), a part of the cutting velocity." },
    Key { name: "knife.plunge_ms", takes: Takes::Number(REST), about: "How long the axes rest while the knife goes down." },
    Key { name: "knife.lift_ms", takes: Takes::Number(REST), about: "How long the axes rest while the knife comes up." },
    Key { name: "knife.clear_ms", takes: Takes::NumberOr(REST, "off"), about: "How long after the lift command the blade is clear of the cloth, so that the axes may move\nbefore it is all the way up; \"off\" = they wait for lift_ms." },
    Key { name: "knife.max_down_mm", takes: Takes::NumberOr(from(1.0, 1.0e6), "off"), about: "Maximum distance with the knife down: a longer cut is lifted there and rejoined with overlap." },
    Key { name: "knife.follow", takes: Takes::Word(&["tangent", "chord"]), about: "How the blade lies on curves: \"tangent\" = the tip on the line, the blade along it; \"chord\" =\ntip and heel both on the line." },
    Key { name: "knife.tight_curves", takes: Takes::Word(&["follow", "nibble", "refuse"]), about: "Curves tighter than the blade, on which it would stand across as a chord (an arc of less than 0.55\nblade widths, a right angle rounded with less than 0.4): \"follow\" = cut along the tangent,\n\"nibble\" = by overlapping plunges within the tolerance, \"refuse\" = an error." },
    Key { name: "knife.max_bow_mm", takes: Takes::Number(BLADE), about: "How far a blade that plunges on a curve may lie beside it: it is straight. Beyond that it is as\n`knife.tight_curves` says: a warning, nibbled, or an error." },
    Key { name: "knife.edges", takes: Takes::Whole(&[1, 2]), about: "Cutting edges: a blade with 2 may run either way round, heel first where C then turns less." },
    Key { name: "knife.yaw_deg", takes: Takes::Number(from(-45.0, 45.0)), about: "C yaw: a constant correction of the blade's angle, which is added to C in every cut." },

    Key { name: "notch.style", takes: Takes::Word(&["as-drawn", "slit", "skip"]), about: "How notches of all kinds, inwards and outwards, are cut: \"as-drawn\"; \"slit\" = each by one\nstraight cut into the part, as deep as the notch is high; \"skip\" = none. The outline then runs\nstraight over their mouths." },
    Key { name: "notch.depth_mm", takes: Takes::NumberOr(DEPTH, "as-drawn"), about: "How deep slits go into the part, also those that notches of another kind become; V, castle and U\nnotches that are cut as drawn keep their depth." },
    Key { name: "notch.box_max_mm", takes: Takes::Number(from(0.0, 2.0)), about: "A notch that the outline draws as a box or needle up to so wide is a slit along its middle." },
    Key { name: "drill.dwell_ms", takes: Takes::Number(REST), about: "Time for one drill hole; the axes rest." },
    Key { name: "drill.offset_mm", takes: Takes::Point, about: "Where the drill stands, seen from the C axis." },

    Key { name: "corner.angle_deg", takes: Takes::Number(between(0.0, 75.0)), about: "Lift and plunge corner angle: where the line turns by more than this the knife is lifted and\nturned in the air; a blade in the cloth cannot follow sharper ones." },

    Key { name: "slow.before_corner_mm", takes: Takes::NumberOr(from(0.1, 1000.0), "off"), about: "How far before a corner the knife slows down." },
    Key { name: "slow.before_corner_percent", takes: Takes::Number(from(1.0, 100.0)), about: "Speed of the knife there, a part of what it would be." },

    Key { name: "path.tolerance_mm", takes: Takes::NumberOr(from(0.001, 10.0), "auto"), about: "How far the tip may leave the line; \"auto\" = 0.05 mm, or what the unit of the file resolves if\nthat is more." },
    Key { name: "path.fit", takes: Takes::Word(&["curve", "polygon"]), about: "What the straight pieces of a file stand for: \"curve\" = a curve that the CAD system cut into\npieces, \"polygon\" = exactly what they are." },
    Key { name: "path.chord_sag_max_mm", takes: Takes::Number(from(0.0, 10.0)), about: "With fit = \"curve\": how far the curve may bulge beyond a straight piece." },

    Key { name: "axes.x.speed_mm_s", takes: Takes::Number(SPEED), about: "Greatest speed along the table." },
    Key { name: "axes.x.acceleration_mm_s2", takes: Takes::Number(ACCELERATION), about: "Greatest acceleration along the table." },
    Key { name: "axes.x.jerk_mm_s3", takes: Takes::Number(JERK), about: "Greatest jerk along the table." },
    Key { name: "axes.y.speed_mm_s", takes: Takes::Number(SPEED), about: "Greatest speed across the table." },
    Key { name: "axes.y.acceleration_mm_s2", takes: Takes::Number(ACCELERATION), about: "Greatest acceleration across the table." },
    Key { name: "axes.y.jerk_mm_s3", takes: Takes::Number(JERK), about: "Greatest jerk across the table." },
    Key { name: "axes.c.speed_deg_s", takes: Takes::Number(SPEED), about: "Greatest speed of the blade's turn." },
    Key { name: "axes.c.acceleration_deg_s2", takes: Takes::Number(ACCELERATION), about: "Greatest acceleration of the blade's turn." },
    Key { name: "axes.c.jerk_deg_s3", takes: Takes::Number(JERK), about: "Greatest jerk of the blade's turn." },
    Key { name: "axes.x.travel.speed_mm_s", takes: Takes::NumberOr(SPEED, "same"), about: "Greatest speed along the table while the knife is up; \"same\" = as in cutting." },
    Key { name: "axes.x.travel.acceleration_mm_s2", takes: Takes::NumberOr(ACCELERATION, "same"), about: "Greatest acceleration along the table while the knife is up; \"same\" = as in cutting." },
    Key { name: "axes.x.travel.jerk_mm_s3", takes: Takes::NumberOr(JERK, "same"), about: "Greatest jerk along the table while the knife is up; \"same\" = as in cutting." },
    Key { name: "axes.y.travel.speed_mm_s", takes: Takes::NumberOr(SPEED, "same"), about: "Greatest speed across the table while the knife is up; \"same\" = as in cutting." },
    Key { name: "axes.y.travel.acceleration_mm_s2", takes: Takes::NumberOr(ACCELERATION, "same"), about: "Greatest acceleration across the table while the knife is up; \"same\" = as in cutting." },
    Key { name: "axes.y.travel.jerk_mm_s3", takes: Takes::NumberOr(JERK, "same"), about: "Greatest jerk across the table while the knife is up; \"same\" = as in cutting." },
    Key { name: "axes.c.travel.speed_deg_s", takes: Takes::NumberOr(SPEED, "same"), about: "Greatest speed of the blade's turn while the knife is up; \"same\" = as in cutting." },
    Key { name: "axes.c.travel.acceleration_deg_s2", takes: Takes::NumberOr(ACCELERATION, "same"), about: "Greatest acceleration of the blade's turn while the knife is up; \"same\" = as in cutting." },
    Key { name: "axes.c.travel.jerk_deg_s3", takes: Takes::NumberOr(JERK, "same"), about: "Greatest jerk of the blade's turn while the knife is up; \"same\" = as in cutting." },

    Key { name: "c.range_deg", takes: Takes::RangeOr("unbounded"), about: "Least and greatest position of the C axis, when its cables do not let it turn for ever." },
    Key { name: "c.offset_deg", takes: Takes::Number(TURN), about: "Where the machine's zero of C points, seen from +X." },
    Key { name: "c.reverse", takes: Takes::Flag, about: "Whether the machine counts C clockwise." },

    Key { name: "table.x_mm", takes: Takes::RangeOr("unlimited"), about: "Where the table begins and ends along X." },
    Key { name: "table.y_mm", takes: Takes::RangeOr("unlimited"), about: "Where the table begins and ends along Y." },

    Key { name: "time.period_ms", takes: Takes::Number(from(0.1, 100.0)), about: "Time between two setpoints: the cycle of the controller." },
    Key { name: "counts.x.per_mm", takes: Takes::Number(COUNTS), about: "Target counts: encoder counts of a millimetre along the table." },
    Key { name: "counts.x.offset", takes: Takes::Number(REGISTER), about: "Target counts: what the encoder shows at X 0." },
    Key { name: "counts.y.per_mm", takes: Takes::Number(COUNTS), about: "Target counts: encoder counts of a millimetre across the table." },
    Key { name: "counts.y.offset", takes: Takes::Number(REGISTER), about: "Target counts: what the encoder shows at Y 0." },
    Key { name: "counts.c.per_deg", takes: Takes::Number(COUNTS), about: "Target counts: encoder counts of a degree of the blade's turn." },
    Key { name: "counts.c.offset", takes: Takes::Number(REGISTER), about: "Target counts: what the encoder shows at C 0 of the controller." },

    Key { name: "gcode.letter", takes: Takes::Word(&["A", "B", "C"]), about: "Target gcode: letter of the axis that turns the blade." },
    Key { name: "gcode.wrapped", takes: Takes::Flag, about: "Whether that axis counts from 0 to 360 degrees only; a negative number then means to turn back." },
    Key { name: "gcode.arcs", takes: Takes::Flag, about: "Whether the controller knows arcs (G2, G3) on which that axis turns, too." },
    Key { name: "gcode.feed_mode", takes: Takes::Word(&["G93", "G94"]), about: "What F says: the speed of X and Y (G94), or one over the time of each move (G93), for controllers\nthat would count degrees as mm." },
    Key { name: "gcode.blend_mm", takes: Takes::NumberOr(from(0.001, 10.0), "off"), about: "How far the controller may leave the path to keep its speed (G64 P), beside path.tolerance_mm;\n\"off\" = no G64 is written: the controller does as it was set." },
    Key { name: "gcode.decimals", takes: Takes::Whole(&[3, 4, 5, 6]), about: "Decimals of positions." },
    Key { name: "gcode.line_numbers", takes: Takes::Flag, about: "Whether lines are numbered (N)." },
    Key { name: "gcode.heading_tolerance_deg", takes: Takes::Number(from(0.001, 10.0)), about: "How far the blade may be turned from its law where the axis turns evenly along a piece." },
    Key { name: "gcode.chord_mm", takes: Takes::Number(from(0.0001, 1.0)), about: "Without arcs: how far a straight piece may leave its arc." },
    Key { name: "gcode.header", takes: Takes::Text, about: "Lines behind the first one, which chooses mm and absolute positions: a coordinate system (G54), a\ntool (T1 M6), what is switched. They move nothing." },
    Key { name: "gcode.footer", takes: Takes::Text, about: "Lines at the end, the last one M2 or M30. They move nothing: park says where the axes end." },
    Key { name: "gcode.knife_down", takes: Takes::Steps, about: "Steps that put the knife down: a digital output (M64 P0 on, M65 P0 off), a move of Z (G0 Z-2,\nG1 Z-2 F600), a rest (G4 P0.05, in s), or M3 to M5 with S, M7 to M9, M68 E Q, M66 P L Q." },
    Key { name: "gcode.knife_up", takes: Takes::Steps, about: "Steps that lift it: they undo those of knife_down." },
    Key { name: "gcode.drill_down", takes: Takes::Steps, about: "Steps that put a drill down; # stands for its number, 1 to 4." },
    Key { name: "gcode.drill_up", takes: Takes::Steps, about: "Steps that lift it." },
    Key { name: "gcode.stop", takes: Takes::Steps, about: "Steps that wait for the operator (event 1): M0, M1 or M60." },
    Key { name: "gcode.advance", takes: Takes::Steps, about: "Steps that advance the cloth (event 2)." },

    Key { name: "verify.max_uncut_mm", takes: Takes::Number(from(0.0, 10.0)), about: "Longest stretch that may be left uncut: what the rounding of setpoints can leave." },
    Key { name: "verify.max_heading_deg", takes: Takes::Number(from(0.01, 45.0)), about: "Greatest angle between the blade and its law while it cuts." },
    Key { name: "verify.max_body_mm", takes: Takes::NumberOr(from(0.0, 1000.0), "off"), about: "Farthest that the blade's body may leave the path on curves." },
    Key { name: "verify.max_overcut_part_mm", takes: Takes::NumberOr(from(0.0, 1000.0), "off"), about: "Farthest overcut into the part itself, beside the tolerance and what the compile warned of." },
    Key { name: "verify.max_overcut_neighbour_mm", takes: Takes::NumberOr(from(0.0, 1000.0), "off"), about: "Farthest overcut into another part, beside what the compile warned of." },
    Key { name: "verify.max_overcut_waste_mm", takes: Takes::NumberOr(from(0.0, 1000.0), "off"), about: "Farthest overcut into waste." },

    Key { name: "hpgl.unit", takes: Takes::Length(from(LEAST_UNIT_MM, GREATEST_UNIT_MM)), about: "Unit of the numbers in plots, mm. Plotters count 1/40 mm; other programs write 0.0254, 0.1, 0.01\nor the dots of a printer. The extent is always printed: compare it with the cloth." },
    Key { name: "hpgl.drill_max_mm", takes: Takes::NumberOr(from(0.0, 1000.0), "off"), about: "Closed squares and circles of a plot up to this size are holes to drill; \"off\" = none is." },
    Key { name: "hpgl.inner", takes: Takes::Word(&["ignore", "cut", "all"]), about: "Which closed lines inside parts are cut: \"ignore\" = none, but those of a pen that is a knife;\n\"cut\" = all that are no seam lines and take no more than half of their part;\n\"all\" = seam lines, too." },
    Key { name: "hpgl.frame", takes: Takes::Word(&["auto", "none", "outermost"]), about: "Whether a frame is drawn around the parts: \"auto\" = a rectangle around two parts or more is one;\n\"none\" = there is none; \"outermost\" = the largest closed line is one." },
    Key { name: "hpgl.pens.<pen>", takes: Takes::Word(&["knife", "pen", "ignore"]), about: "What a pen of a plot stands for: its outermost and inner lines are cut (\"knife\"), its lines are\ndrawn only, but for notches on cut edges (\"pen\"), or do not matter (\"ignore\"). Of pens without a\nkey shapes decide." },
    Key { name: "labels.encoding", takes: Takes::Encoding, about: "Encoding of label texts that are no UTF-8: \"windows-1251\" (Cyrillic), \"latin1\", \"gbk\" (Chinese),\n\"big5\", \"shift_jis\", \"euc-kr\" and more. What is no text in it is shown as \u{fffd}." },

    Key { name: "codes.<code>", takes: Takes::Word(&["use", "ignore"]), about: "A code of the cutter file to obey or to skip, as the USE/IGNORE switches of a cutter." },
];

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
    fn a_mistyped_code_has_its_near_ones() {
        let check =
            |typed: &str, expected: &[&str]| assert_eq!(near_codes(typed).expect("a code"), expected, "{typed}");
        check("codes.m19", &["codes.M19"]);
        check("codes.M001", &["codes.M1"]);
        check("codes.M00", &["codes.M0"]);
        check("codes.F300", &["codes.F"]);
        check("codes.M91", &["codes.G91", "codes.M1", "codes.M19"]);
        check("codes.X", &["codes.A", "codes.B", "codes.E"]);
        assert_eq!(near_codes("knife.width"), None);
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
