//! Scenarios: what a moving cloth does, as TOML.

use serde::Deserialize;
use toml::de::{DeTable, DeValue, ValueDeserializer};

use crate::diagnostic::{Diagnostic, Diagnostics, Severity, code};
use crate::machine::Tracking;
use crate::source::{Source, Span};

/// What a cloth does, and for how long it is looked at.
#[derive(Debug, Clone, PartialEq)]
pub struct Scenario {
    /// How long it lasts, s.
    pub duration: f64,
    /// From when on the error counts, s.
    pub measured_from: f64,
    /// The cloth jumps to one side by so much, mm, at a time, s.
    pub offset: [f64; 2],
    /// It wanders from side to side by so much, mm, in so many s there and back.
    pub wander: [f64; 2],
    /// It drifts to one side, mm/s.
    pub drift: f64,
    /// Its width, mm.
    pub width: f64,
    /// Damage of its edges.
    pub damage: Vec<Damage>,
}

/// A nick or a flap of an edge.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Damage {
    /// When it begins to pass the rulers of the carriage, s.
    pub at_s: f64,
    /// For how long it does, s.
    pub for_s: f64,
    /// How much cloth is missing there, mm; less than nothing = a flap sticks out.
    pub depth_mm: f64,
    /// Which edge it is on.
    pub edge: Edge,
}

/// An edge of the cloth, seen along the feed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Edge {
    /// Under ruler A.
    Left,
    /// Under ruler B.
    Right,
}

/// A key of a scenario: its name, range and what it is.
struct Key {
    name: &'static str,
    within: [f64; 2],
    set: fn(&mut Scenario, f64),
}

/// Every key but `damage`.
const KEYS: &[Key] = &[
    Key { name: "duration_s", within: [0.1, 3600.0], set: |scenario, value| scenario.duration = value },
    Key { name: "measured_from_s", within: [0.0, 3600.0], set: |scenario, value| scenario.measured_from = value },
    Key { name: "offset_mm", within: [-1000.0, 1000.0], set: |scenario, value| scenario.offset[0] = value },
    Key { name: "offset_at_s", within: [0.0, 3600.0], set: |scenario, value| scenario.offset[1] = value },
    Key { name: "wander_mm", within: [0.0, 1000.0], set: |scenario, value| scenario.wander[0] = value },
    Key { name: "wander_s", within: [0.01, 3600.0], set: |scenario, value| scenario.wander[1] = value },
    Key { name: "drift_mm_s", within: [-1000.0, 1000.0], set: |scenario, value| scenario.drift = value },
    Key { name: "width_mm", within: [1.0, 20_000.0], set: |scenario, value| scenario.width = value },
];
const DAMAGE: &str = "damage";
/// What a row of damage is.
const DAMAGE_ROW: &str =
    "write a list of tables: damage = [{ at_s = 1, for_s = 0.05, depth_mm = 10, edge = \"left\" }]";
/// The most that one may last and hold, so that a slip of a digit ends soon.
const MOST_SAMPLES: f64 = 1e7;

impl Scenario {
    /// A cloth that lies still in the middle, for a while. It is half a pitch wider than the nominal width, so that the rulers
    /// count in turn and know the centre to half a pitch.
    pub fn still(track: &Tracking) -> Self {
        Self {
            duration: 5.0,
            measured_from: 0.0,
            offset: [0.0, 0.1],
            wander: [0.0, 5.0],
            drift: 0.0,
            width: track.width_mm + track.pitch_mm / 2.0,
            damage: Vec::new(),
        }
    }

    /// Where the centre of the cloth is under the carriage, mm to the right, at a time, s.
    pub fn centre(&self, time: f64) -> f64 {
        let [amplitude, period] = self.wander;
        let [offset, from] = self.offset;
        let jumped = if time >= from { offset } else { 0.0 };
        jumped + self.drift * time.max(0.0) + amplitude * (time / period * std::f64::consts::TAU).sin()
    }

    /// How much of the left and of the right edge is missing, mm, at a time, s.
    pub fn missing(&self, time: f64) -> [f64; 2] {
        let mut missing = [0.0; 2];
        for damage in &self.damage {
            if (damage.at_s..damage.at_s + damage.for_s).contains(&time) {
                match damage.edge {
                    Edge::Left => missing[0] += damage.depth_mm,
                    Edge::Right => missing[1] += damage.depth_mm,
                }
            }
        }
        missing
    }

    /// Reads a scenario; `None` when it has faults, which are diagnostics.
    pub fn read(source: &Source, track: &Tracking, out: &mut Diagnostics) -> Option<Self> {
        let Ok(text) = std::str::from_utf8(source.bytes()) else {
            out.push(Diagnostic::new(&code::TRACK_SCENARIO, "the scenario is not UTF-8 text"));
            return None;
        };
        let known = out.count(Severity::Error);
        let mut scenario = Self::still(track);
        let (root, errors) = DeTable::parse_recoverable(text);
        for error in &errors {
            let fault = Diagnostic::new(&code::TRACK_SCENARIO, error.message().replace('\n', ", "));
            let hint = "a row is `key = value`; numbers begin with a digit, as in 0.05";
            out.push(fault.at(span(error.span().unwrap_or(0..0))).hint(hint));
        }
        if errors.is_empty() {
            for (key, value) in root.get_ref() {
                let at = span(key.span());
                let text = text.get(value.span()).unwrap_or_default();
                let taken = scenario.take(key.get_ref(), value.get_ref(), text);
                if let Err([message, hint]) = taken {
                    out.push(Diagnostic::new(&code::TRACK_SCENARIO, message).at(at).hint(hint));
                }
            }
        }
        if out.count(Severity::Error) > known {
            return None;
        }
        if let Some([message, hint]) = scenario.fault(track) {
            out.push(Diagnostic::new(&code::TRACK_SCENARIO, message).hint(hint));
            return None;
        }
        Some(scenario)
    }

    /// What is wrong with its values together, and what to do.
    fn fault(&self, track: &Tracking) -> Option<[String; 2]> {
        let Self { duration, measured_from, .. } = self;
        if duration / track.period() > MOST_SAMPLES {
            let message = format!("{duration} s are more than {MOST_SAMPLES:e} periods");
            return Some([message, "take a shorter `duration_s`".to_owned()]);
        }
        if measured_from >= duration {
            let message =
                format!("nothing is measured: `measured_from_s` is {measured_from}, `duration_s` {duration} s");
            return Some([message, "take a smaller `measured_from_s`, or a longer duration".to_owned()]);
        }
        let jump = Some(self.offset[1]).filter(|_| self.offset[0] != 0.0).map(|time| ("offset_at_s", time));
        let damage = self.damage.iter().map(|damage| ("damage.at_s", damage.at_s));
        let (key, time) = jump.into_iter().chain(damage).find(|(_, time)| time >= duration)?;
        let message = format!("`{key}` = {time} never comes: `duration_s` is {duration} s");
        Some([message, "take an earlier time, or a longer duration".to_owned()])
    }

    /// Takes a key in; or what is wrong with it, and what to do.
    fn take(&mut self, name: &str, value: &DeValue, text: &str) -> Result<(), [String; 2]> {
        let plain = || ValueDeserializer::parse(text).ok();
        if name == DAMAGE {
            let faulty = |message: String| [message, DAMAGE_ROW.to_owned()];
            let value = plain().ok_or_else(|| faulty(format!("`{DAMAGE}` is no list of tables")))?;
            let damage = Vec::<Damage>::deserialize(value)
                .map_err(|error| faulty(format!("`{DAMAGE}`: {}", error.message().replace('\n', ", "))))?;
            for Damage { at_s, for_s, depth_mm, .. } in &damage {
                let ranged = [
                    ("at_s", at_s, 0.0, 3600.0),
                    ("for_s", for_s, 0.0, 3600.0),
                    ("depth_mm", depth_mm, -1000.0, 1000.0),
                ];
                if let Some((key, _, least, most)) =
                    ranged.into_iter().find(|(_, value, least, most)| !(*least..=*most).contains(*value))
                {
                    return Err(faulty(format!("`{DAMAGE}.{key}` must be a number from {least} to {most}")));
                }
            }
            self.damage = damage;
            return Ok(());
        }
        let Some(key) = KEYS.iter().find(|key| key.name == name) else {
            let names: Vec<&str> = KEYS.iter().map(|key| key.name).chain([DAMAGE]).collect();
            return Err([
                format!("there is no key `{}`", name.escape_debug()),
                format!("the keys are {}", names.join(", ")),
            ]);
        };
        let [least, most] = key.within;
        let number = match value {
            DeValue::Integer(_) | DeValue::Float(_) => plain().and_then(|value| f64::deserialize(value).ok()),
            DeValue::String(_) | DeValue::Boolean(_) | DeValue::Datetime(_) | DeValue::Array(_) | DeValue::Table(_) => {
                None
            }
        };
        let number = number.filter(|number| (least..=most).contains(number));
        let number = number.ok_or_else(|| {
            [format!("`{name}` must be a number from {least} to {most}"), "its unit stands in its name".to_owned()]
        })?;
        (key.set)(self, number + 0.0);
        Ok(())
    }
}

fn span(bytes: std::ops::Range<usize>) -> Span {
    // A `Source` is below 4 GiB.
    Span { start: bytes.start as u32, end: bytes.end as u32, block: 0 }
}
