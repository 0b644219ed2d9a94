//! Scenarios: motions of a cloth, as TOML.

use serde::Deserialize;
use toml::de::{DeTable, DeValue, ValueDeserializer};

use crate::diagnostic::{Diagnostic, Diagnostics, Severity, code};
use crate::machine::Tracking;
use crate::source::{Source, Span};

/// Motion and damage of a cloth, and the duration of its simulation.
#[derive(Debug, Clone, PartialEq)]
pub struct Scenario {
    /// Duration, s.
    pub duration: f64,
    /// Time from which the error is measured, s.
    pub measured_from: f64,
    /// Lateral jump of the cloth, mm, and its time, s.
    pub offset: [f64; 2],
    /// Lateral oscillation of the cloth: amplitude, mm, and period, s.
    pub wander: [f64; 2],
    /// Lateral drift, mm/s.
    pub drift: f64,
    /// Width, mm.
    pub width: f64,
    /// Damage of its edges.
    pub damage: Vec<Damage>,
}

/// A nick or a flap of an edge.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Damage {
    /// Time at which it reaches the rulers of the carriage, s.
    pub at_s: f64,
    /// Duration of its passage, s.
    pub for_s: f64,
    /// Depth of the missing cloth, mm; negative for a flap.
    pub depth_mm: f64,
    /// The damaged edge.
    pub edge: Edge,
}

/// An edge of the cloth, seen along the feed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Edge {
    /// The edge under ruler A.
    Left,
    /// The edge under ruler B.
    Right,
}

/// A key of a scenario: its name, its range, and the setter of its value.
struct Key {
    name: &'static str,
    within: [f64; 2],
    set: fn(&mut Scenario, f64),
}

/// All keys except `damage`.
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
/// Hint on the format of damage.
const DAMAGE_ROW: &str =
    "write a list of tables: damage = [{ at_s = 1, for_s = 0.05, depth_mm = 10, edge = \"left\" }]";
/// Maximum number of samples, so that a wrong digit does not make the simulation endless.
const MOST_SAMPLES: f64 = 1e7;

impl Scenario {
    /// A cloth at rest in the middle. It is half a pitch wider than the nominal width, so that the rulers count alternately and
    /// resolve the centre to half a pitch.
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

    /// Position of the cloth's centre under the carriage at a time, s; mm to the right.
    pub fn centre(&self, time: f64) -> f64 {
        let [amplitude, period] = self.wander;
        let [offset, from] = self.offset;
        let jumped = if time >= from { offset } else { 0.0 };
        jumped + self.drift * time.max(0.0) + amplitude * (time / period * std::f64::consts::TAU).sin()
    }

    /// Missing cloth at the left and the right edge at a time, s; mm.
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

    /// Reads a scenario; `None` if there are faults, which are diagnostics.
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

    /// Message and hint on values that contradict each other; `None` if they are consistent.
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

    /// Sets the value of a key. The error is a message and a hint.
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
    // A `Source` is smaller than 4 GiB.
    Span { start: bytes.start as u32, end: bytes.end as u32, block: 0 }
}
