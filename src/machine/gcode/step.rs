//! Step: an instruction to a controller about one of its outputs, written as its line of G-code.
//!
//! Steps in a profile are texts as in the manual of a controller and in the program: `knife_down = ["M64 P0"]`. Each is one
//! code that every interpreter of RS274/NGC accepts and that acts at once, with its words. A step changes nothing about the
//! meaning of the lines around it.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use super::dialect::Dialect;
pub use super::words::Number;
use super::words::{Flaw, Word, words};

/// Single action of a controller in a program.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// Switches a digital output: `M64 P0` on, `M65 P0` off.
    Output {
        /// Number of the output, from 0 on.
        pin: Number,
        /// New state.
        on: bool,
    },
    /// Moves Z: `G0 Z-2` at full speed, `G1 Z-2 F600` at a given one.
    Z {
        /// Target, mm.
        to_mm: f64,
        /// Speed, mm/min; `None` = full speed.
        feed_mm_min: Option<f64>,
    },
    /// Rests the axes: `G4 P0.5`.
    Dwell {
        /// Duration, s.
        time: f64,
    },
    /// M code that switches or waits: `M3 S1000`.
    Code {
        /// Number of the code.
        m: u8,
        /// Words after it.
        parameters: Vec<Parameter>,
    },
}

/// Word after a code.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// Letter, not that of an axis.
    pub letter: char,
    /// Number.
    pub number: Number,
}

/// Code that steps may have, and the letters of its words.
#[derive(Clone, Copy)]
pub(super) struct Form {
    pub(super) code: &'static str,
    /// Letters of required words, and of optional ones.
    pub(super) needs: &'static str,
    pub(super) takes: &'static str,
    /// Complete example.
    pub(super) example: &'static str,
    /// Effect.
    pub(super) about: &'static str,
    /// Dialects that have the code with this effect.
    dialects: &'static [Dialect],
}

const fn form(code: &'static str, needs: &'static str, example: &'static str, about: &'static str) -> Form {
    Form { code, needs, takes: "", example, about, dialects: Dialect::ALL }
}

/// Code of one dialect only.
const fn only(dialects: &'static [Dialect], form: Form) -> Form {
    Form { dialects, ..form }
}

const RS274: &[Dialect] = &[Dialect::Rs274];
const REPRAP: &[Dialect] = &[Dialect::Reprap];

/// All codes that steps may have. Modes, outputs that wait for the next move and codes specific to one controller are excluded.
pub(super) const FORMS: &[Form] = &[
    form("G0", "Z", "G0 Z-2", "Z moves as fast as it can, mm"),
    form("G1", "ZF", "G1 Z-2 F600", "Z moves at a speed, mm and mm/min"),
    form("G4", "P", "G4 P0.5", "the axes rest, s"),
    only(RS274, form("M0", "", "M0", "the operator is waited for")),
    only(RS274, form("M1", "", "M1", "the operator is waited for where optional stops are on")),
    Form { takes: "S", ..form("M3", "", "M3 S1000", "the spindle turns clockwise, S = its speed") },
    Form { takes: "S", ..form("M4", "", "M4 S1000", "the spindle turns counter-clockwise, S = its speed") },
    form("M5", "", "M5", "the spindle stops"),
    only(RS274, form("M7", "", "M7", "mist coolant goes on")),
    only(RS274, form("M8", "", "M8", "flood coolant goes on")),
    only(RS274, form("M9", "", "M9", "all coolant goes off")),
    only(REPRAP, form("M42", "PS", "M42 P0 S1", "an output is set, P = its number, S = its value, 0 to 1")),
    only(RS274, form("M60", "", "M60", "pallets are changed, and the operator is waited for")),
    only(RS274, form("M64", "P", "M64 P0", "a digital output goes on, P = its number")),
    only(RS274, form("M65", "P", "M65 P0", "a digital output goes off, P = its number")),
    only(
        RS274,
        form("M66", "PLQ", "M66 P0 L3 Q10", "an input is waited for, P = its number, L = how, Q = s at the most"),
    ),
    only(REPRAP, form("M226", "", "M226", "the operator is waited for")),
    only(RS274, form("M68", "EQ", "M68 E0 Q5", "an analog output is set, E = its number, Q = its value")),
];

/// Hint for a list of steps for a tool without any that acts.
pub(super) const WHAT_ACTS: &str =
    "what acts is M64 P, M65 P, M68 E Q, M42 P S, M3 to M5 with S, M7 to M9, G0 Z and G1 Z F";
/// Codes that switch outputs only at the start of the next move: the knife would come down while it moves on.
const LATE: &[&str] = &["M62", "M63", "M67"];
/// Codes that run programs of the controller's own.
const OWN: std::ops::RangeInclusive<f64> = 100.0..=199.0;
/// Greatest number of an output or input: controllers have at most 64 (`LinuxCNC`, motion module, `num_dio`).
const PIN_MAX: f64 = 63.0;
/// Greatest mode of a wait for an input.
const WAIT_MAX: f64 = 4.0;
/// Shortest rest after which the axes surely stand, s: `FluidNC` takes G4 in whole ms and does not wait for 0.
pub const SETTLE: f64 = 0.01;
/// Greatest number in other words; it exceeds every position, speed and time of a machine.
pub(super) const NUMBER_MAX: f64 = 1e6;

impl Step {
    /// Step with a number in place of `#`: that of a drill, or the advance of the cloth in mm.
    #[must_use]
    pub fn filled(&self, blank: f64) -> Self {
        let number = |number: Number| Number::Plain(number.of(blank));
        match self {
            Self::Output { pin, on } => Self::Output { pin: number(*pin), on: *on },
            Self::Z { .. } | Self::Dwell { .. } => self.clone(),
            Self::Code { m, parameters } => {
                let parameters = parameters.iter().map(|word| Parameter { number: number(word.number), ..*word });
                Self::Code { m: *m, parameters: parameters.collect() }
            }
        }
    }

    /// True if some controllers obey it when they read it, before the moves that they have planned are over: M42, M64 to M66,
    /// M68.
    pub(super) fn acts_when_read(&self) -> bool {
        matches!(self, Self::Output { .. } | Self::Code { m: 42 | 66 | 68, .. })
    }

    /// True if it moves Z at a speed, which is an F.
    pub(super) fn has_feed(&self) -> bool {
        matches!(self, Self::Z { feed_mm_min: Some(_), .. })
    }

    /// True if it switches an output when some controllers read it; the moves before it go on.
    pub fn switches_when_read(&self) -> bool {
        matches!(self, Self::Output { .. } | Self::Code { m: 42 | 68, .. })
    }

    /// Text as in a program of a dialect.
    pub fn in_dialect(&self, dialect: Dialect) -> String {
        match (self, dialect) {
            (Self::Dwell { time }, Dialect::Reprap) => format!("G4 S{}", Number::Plain(*time)),
            _ => self.to_string(),
        }
    }

    /// Flaw of a step that a dialect does not have.
    pub(super) fn foreign_to(&self, dialect: Dialect) -> Option<Flaw> {
        let code = match self {
            Self::Output { on: true, .. } => "M64".to_owned(),
            Self::Output { on: false, .. } => "M65".to_owned(),
            Self::Z { feed_mm_min: None, .. } => "G0".to_owned(),
            Self::Z { feed_mm_min: Some(_), .. } => "G1".to_owned(),
            Self::Dwell { .. } => "G4".to_owned(),
            Self::Code { m, .. } => format!("M{m}"),
        };
        let is_known = FORMS.iter().any(|form| form.code == code && form.dialects.contains(&dialect));
        (!is_known).then(|| {
            let has = match dialect.other_effect(&code) {
                Some(effect) => format!("{self}, by which {effect}"),
                None => format!("{self}, which {} does not know", dialect.title()),
            };
            Flaw::new(has, other_codes(dialect))
        })
    }

    /// True if it contains `#`.
    pub fn has_blank(&self) -> bool {
        self.filled(1.0) != self.filled(2.0)
    }

    /// Reads a line that is one step.
    pub(in crate::machine) fn read(line: &str) -> Result<Self, Flaw> {
        let words = words(line)?;
        let Some((code, others)) = words.split_first().filter(|(code, _)| code.is_code()) else {
            let has = words
                .first()
                .map_or_else(|| "a step that is blank".to_owned(), |word| format!("{word} without its code"));
            return Err(Flaw::new(has, "each step begins with its code, as in M64 P0, G0 Z-2 or G4 P0.5"));
        };
        let form = FORMS.iter().find(|form| code.is(form.code)).ok_or_else(|| unknown(*code))?;
        for word in others {
            checked(*word, form)?;
        }
        if let Some(letter) = form.needs.chars().find(|letter| others.iter().all(|word| word.letter != *letter)) {
            return Err(Flaw::new(
                format!("{} without {letter}", form.code),
                format!("complete it, as in {}", form.example),
            ));
        }
        Ok(Self::of(*code, others))
    }

    /// Step of a code with checked words.
    fn of(code: Word, others: &[Word]) -> Self {
        let find = |letter: char| others.iter().find(|word| word.letter == letter).map(|word| word.number);
        // Only P, S, E, L and Q may contain `#`, and not in G codes.
        let plain = |letter: char| find(letter).map(|number| number.of(0.0));
        let needed = "a form says what a code needs";
        match (code.letter, code.number.of(0.0) as u8) {
            ('G', 4) => Self::Dwell { time: plain('P').expect(needed) },
            ('G', _) => Self::Z { to_mm: plain('Z').expect(needed), feed_mm_min: plain('F') },
            (_, m @ (64 | 65)) => Self::Output { pin: find('P').expect(needed), on: m == 64 },
            (_, m) => {
                let parameters = others.iter().map(|word| Parameter { letter: word.letter, number: word.number });
                Self::Code { m, parameters: parameters.collect() }
            }
        }
    }
}

/// Checks that a word with its number may follow a code.
fn checked(word: Word, form: &Form) -> Result<(), Flaw> {
    let flaw = |why: &str, hint: &str| Err(Flaw::new(format!("{word}{why}"), hint));
    let is = |code: &str| form.code == code;
    if word.is_code() {
        return Err(Flaw::new(format!("{} and {word} in a step", form.code), "write two steps"));
    }
    if !form.needs.contains(word.letter) && !form.takes.contains(word.letter) {
        let why = format!(", which {} does not take", form.code);
        return match word.letter {
            'F' if is("G0") => flaw(" beside G0", "G0 goes as fast as it can; G1 Z-2 F600 has a speed"),
            'A'..='C' | 'U'..='Z' => flaw(&why, "steps move Z only, as in G0 Z-2"),
            _ => flaw(&why, &format!("a step is complete as in {}", form.example)),
        };
    }
    let Number::Plain(number) = word.number else {
        let is_moving = form.code.starts_with('G');
        return if is_moving {
            flaw(", which is no place or time", "# numbers outputs and speeds of drills")
        } else {
            Ok(())
        };
    };
    match word.letter {
        'F' if number <= 0.0 => flaw(", which is no speed", "F is above 0, in mm/min"),
        'S' if is("M42") && !(0.0..=1.0).contains(&number) => flaw(", which is no value", "S of M42 is from 0 to 1"),
        'S' if number < 0.0 => flaw(", which is no speed", "S is from 0 on"),
        'P' if is("G4") && number < 0.0 => flaw(", which is no time", "P of G4 is from 0 on, in seconds"),
        'P' | 'E' if !is("G4") && !is_whole(number, PIN_MAX) => {
            flaw(", which is no output", &format!("outputs and inputs are counted from 0 to {PIN_MAX}"))
        }
        'L' if number < 1.0 || !is_whole(number, WAIT_MAX) => {
            flaw(", which is no way to wait", "L of M66 is 1 to 4: for an edge up or down, a level high or low")
        }
        'Q' if is("M66") && number <= 0.0 => flaw(", which is no time", "Q of M66 is above 0, in seconds"),
        _ if number.abs() > NUMBER_MAX => flaw(", which is beyond every machine", "is it mistyped?"),
        _ => Ok(()),
    }
}

/// Hint for a code of another dialect.
fn other_codes(dialect: Dialect) -> &'static str {
    match dialect {
        Dialect::Rs274 => {
            "M64 P and M65 P switch an output, M0 waits for the operator; M42 and M226 need `gcode.dialect = \"reprap\"`"
        }
        Dialect::Reprap => {
            "M42 P S sets an output, M226 waits for the operator; other codes need `gcode.dialect = \"rs274\"`"
        }
    }
}

fn is_whole(number: f64, most: f64) -> bool {
    (0.0..=most).contains(&number) && number.fract() == 0.0
}

/// Flaw for a code that no step has.
fn unknown(code: Word) -> Flaw {
    if LATE.iter().any(|late| code.is(late)) {
        let hint = "M64, M65 and M68 act at once, before the rest that the knife is given";
        return Flaw::new(format!("{code}, which acts only where the next move begins"), hint);
    }
    if code.letter == 'M' && OWN.contains(&code.number.of(0.0)) {
        let hint =
            "the interpreter knows none of those by itself, nor what they do: M64 P0 and M65 P0 switch an output";
        return Flaw::new(format!("{code}, which runs a program of the controller's own"), hint);
    }
    Flaw::new(format!("{code}, which is no code of a step"), format!("{WHAT_ACTS}; what rests is G4 P, M66 P L Q"))
}

/// Text as in a profile; as in a program if there is no `#`.
impl fmt::Display for Step {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Output { pin, on: true } => write!(out, "M64 P{pin}"),
            Self::Output { pin, on: false } => write!(out, "M65 P{pin}"),
            Self::Z { to_mm, feed_mm_min: None } => write!(out, "G0 Z{}", Number::Plain(*to_mm)),
            Self::Z { to_mm, feed_mm_min: Some(feed) } => {
                write!(out, "G1 Z{} F{}", Number::Plain(*to_mm), Number::Plain(*feed))
            }
            Self::Dwell { time } => write!(out, "G4 P{}", Number::Plain(*time)),
            Self::Code { m, parameters } => {
                write!(out, "M{m}")?;
                parameters.iter().try_for_each(|word| write!(out, " {}{}", word.letter, word.number))
            }
        }
    }
}

impl FromStr for Step {
    type Err = String;

    /// Reads a step; the error tells what in the text no step may have.
    fn from_str(text: &str) -> Result<Self, String> {
        Self::read(text).map_err(|flaw| flaw.has)
    }
}

impl<'de> Deserialize<'de> for Step {
    fn deserialize<D: Deserializer<'de>>(input: D) -> Result<Self, D::Error> {
        String::deserialize(input)?.parse().map_err(de::Error::custom)
    }
}

impl Serialize for Step {
    fn serialize<S: Serializer>(&self, output: S) -> Result<S::Ok, S::Error> {
        output.collect_str(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_printed_as_it_is_read() {
        for (text, printed) in [
            ("M64 P0", "M64 P0"),
            ("m65p#", "M65 P#"),
            ("G00 Z-02.50", "G0 Z-2.5"),
            ("G1 F300 Z5", "G1 Z5 F300"),
            ("G4 P0.5", "G4 P0.5"),
            ("M3 S#", "M3 S#"),
            ("M68 E0 Q-5", "M68 E0 Q-5"),
            ("M66 P1 L3 Q2", "M66 P1 L3 Q2"),
            ("M0", "M0"),
        ] {
            assert_eq!(text.parse::<Step>().expect("a step").to_string(), printed, "{text}");
        }
    }

    #[test]
    fn what_is_no_step_is_named() {
        for (text, expected) in [
            ("", "a step that is blank"),
            ("Z-2", "Z-2 without its code"),
            ("P0 M64", "P0 without its code"),
            ("G1 Z-2", "G1 without F"),
            ("G1 Z-2 F0", "F0, which is no speed"),
            ("G0 Z-2 F300", "F300 beside G0"),
            ("G0", "G0 without Z"),
            ("G0 C5", "C5, which G0 does not take"),
            ("G0 Z#", "Z#, which is no place"),
            ("G33", "G33, which is no code of a step"),
            ("G55", "G55, which is no code of a step"),
            ("M2", "M2, which is no code of a step"),
            ("M71", "M71, which is no code of a step"),
            ("M101", "M101, which runs a program of the controller's own"),
            ("m62 p0", "M62, which acts only where the next move begins"),
            ("M64", "M64 without P"),
            ("M64 P64", "P64, which is no output"),
            ("M64 P0.5", "P0.5, which is no output"),
            ("M64 P0 P1", "two words P on a line"),
            ("M64 P0 M65", "M64 and M65 in a step"),
            ("M3 X5", "X5, which M3 does not take"),
            ("M3 S-1", "S-1, which is no speed"),
            ("M66 P0 L3", "M66 without Q"),
            ("M66 P0 L3 Q0", "Q0, which is no time"),
            ("G4 P-1", "P-1, which is no time"),
            ("M3 (on)", "`(`, which is of a comment"),
            ("M3\u{7}", "the character U+0007, which is no word of G-code"),
        ] {
            let found = text.parse::<Step>().expect_err(text);
            assert!(found.starts_with(expected), "{text}: {found}");
        }
    }
}
