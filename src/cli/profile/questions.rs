//! Questions about a machine, and how the answer to each becomes values of keys.

use crate::machine::MachineProfile;

/// A question about a machine. Its answer has one part for each key, divided by commas.
#[derive(Debug)]
pub(super) struct Question {
    /// The question.
    pub(super) asks: &'static str,
    /// Instructions for finding the answer, one line or several.
    pub(super) how: &'static str,
    /// Keys that the answer sets.
    pub(super) keys: &'static [Key],
}

/// A key, and the words that stand for its values.
type Key = (&'static str, &'static [(&'static str, &'static str)]);

/// All questions but the first, which chooses the controller.
pub(super) const QUESTIONS: &[Question] = &[
    Question {
        asks: "Where does the table begin and end: along X, along Y?",
        how: "Least and greatest position of each axis over the cloth in mm, as in `0 1800, 0 1200`;\n\
              or `unlimited, unlimited`.",
        keys: &[("table.x_mm", &[]), ("table.y_mm", &[])],
    },
    Question {
        asks: "How wide is the blade, from its rear edge to its tip?",
        how: "Measure the knife as it is today: sharpening takes from it. 0 for a pen or a wheel.",
        keys: &[("knife.width_mm", &[])],
    },
    Question {
        asks: "How far is it from the axis that turns the blade back to its rear edge?",
        how: "Press the blade into paper and lift it; turn the axis by half a turn without moving X or Y, and\n\
              press again. Half of the whole length of both slits is the longer way from the axis to an edge.\n\
              If the tip is the nearer edge, as on most cutters, that is the answer; otherwise it is the width\n\
              less that half.",
        keys: &[("knife.back_mm", &[])],
    },
    Question {
        asks: "How fast may the tip cut?",
        how: "In mm/s; write another unit behind the number, as in `45 m/min`. `off`: as fast as the axes can.",
        keys: &[("knife.feed_mm_s", &[])],
    },
    Question {
        asks: "How fast are the axes at most: X, Y, and the blade's turn?",
        how: "In mm/s and degrees/s, as the controller is set: `$110`, `$111` and `$113` of grbl count a minute,\n\
              and are 60 times as large.",
        keys: &[("axes.x.speed_mm_s", &[]), ("axes.y.speed_mm_s", &[]), ("axes.c.speed_deg_s", &[])],
    },
    Question {
        asks: "How hard may they accelerate: X, Y, and the blade's turn?",
        how: "In mm/s2 and degrees/s2, as the controller is set (`$120`, `$121`, `$123` of grbl).",
        keys: &[
            ("axes.x.acceleration_mm_s2", &[]),
            ("axes.y.acceleration_mm_s2", &[]),
            ("axes.c.acceleration_deg_s2", &[]),
        ],
    },
    Question {
        asks: "How far may the blade's axis turn?",
        how: "Least and greatest position in degrees, as in `-360 360`, if a cable or a hose goes to the blade;\n\
              or `unbounded`.",
        keys: &[("c.range_deg", &[])],
    },
    Question {
        asks: "Which way does the blade turn when its position grows?",
        how: "Seen from above: `counter-clockwise` or `clockwise`.",
        keys: &[("c.reverse", &[("counter-clockwise", "false"), ("clockwise", "true")])],
    },
    Question {
        asks: "Where does the tip point when the axis of the blade is at 0?",
        how: "Degrees from +X, counter-clockwise: 0 along +X, 90 along +Y.",
        keys: &[("c.offset_deg", &[])],
    },
    Question {
        asks: "What puts the knife down, and what lifts it?",
        how: "Blocks for the controller, with `;` between several: `G0 Z-2, G0 Z5` moves Z, `M64 P0, M65 P0`\n\
              switches an output.",
        keys: &[("gcode.knife_down", &[]), ("gcode.knife_up", &[])],
    },
    Question {
        asks: "How long does the knife take to go down, and to come up?",
        how: "In ms: the axes rest meanwhile.",
        keys: &[("knife.plunge_ms", &[]), ("knife.lift_ms", &[])],
    },
];

impl Question {
    /// `key=value` arguments of an answer; `None` if it has not as many parts as there are keys.
    pub(super) fn arguments(&self, answer: &str) -> Option<Vec<String>> {
        let parts: Vec<&str> = answer.split(',').map(str::trim).collect();
        let argument = |(&(key, words), part): (&Key, &&str)| {
            let known = words.iter().find(|(word, _)| word.eq_ignore_ascii_case(part));
            let value = known.map_or_else(|| value(key, part), |(_, value)| (*value).to_owned());
            format!("{key}={value}")
        };
        (parts.len() == self.keys.len()).then(|| self.keys.iter().zip(&parts).map(argument).collect())
    }

    /// The answer that a profile gives.
    pub(super) fn answer(&self, profile: &MachineProfile) -> String {
        let part = |&(key, words): &Key| {
            let value = profile.value(key).expect("a test finds every key of a question");
            let word = words.iter().find(|(_, known)| *known == value.to_string());
            word.map_or_else(|| plain(&value), |(word, _)| (*word).to_owned())
        };
        self.keys.iter().map(part).collect::<Vec<_>>().join(", ")
    }
}

/// A part of an answer as a value: several numbers, or several steps of a controller, are a list.
fn value(key: &str, part: &str) -> String {
    let numbers: Vec<&str> = part.split_whitespace().collect();
    if key.starts_with("gcode.") {
        let steps: Vec<String> = part.split(';').map(|step| format!("{:?}", step.trim())).collect();
        return format!("[{}]", steps.join(", "));
    }
    let is_list = numbers.len() > 1 && numbers.iter().all(|number| number.parse::<f64>().is_ok());
    if is_list { format!("[{}]", numbers.join(", ")) } else { part.to_owned() }
}

/// A value as a part of an answer.
fn plain(value: &toml::Value) -> String {
    match value {
        toml::Value::String(text) => text.clone(),
        toml::Value::Array(items) => {
            let divider = if items.iter().all(toml::Value::is_str) { "; " } else { " " };
            items.iter().map(plain).collect::<Vec<_>>().join(divider)
        }
        toml::Value::Float(number) => crate::units::number::exact(*number),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{SHIPPED, load};

    #[test]
    fn the_answer_of_each_profile_is_taken_and_changes_nothing() {
        for shipped in SHIPPED {
            let source = shipped.source();
            let profile = load(Some(&source), &[]).expect("a legal profile");
            for question in QUESTIONS {
                let answer = question.answer(&profile);
                let sets = question.arguments(&answer).unwrap_or_else(|| panic!("{answer}"));
                let again = load(Some(&source), &sets).unwrap_or_else(|_| panic!("{sets:?}"));
                assert_eq!(again.digest(), profile.digest(), "{sets:?}");
            }
        }
    }

    #[test]
    fn answers_become_values() {
        let find = |key: &str| QUESTIONS.iter().find(|question| question.keys[0].0 == key).expect("a question");
        let table = find("table.x_mm").arguments("0 1800, 0 1200");
        assert_eq!(table, Some(vec!["table.x_mm=[0, 1800]".to_owned(), "table.y_mm=[0, 1200]".to_owned()]));
        assert_eq!(find("table.x_mm").arguments("0 1800"), None);
        assert_eq!(find("c.reverse").arguments("Clockwise"), Some(vec!["c.reverse=true".to_owned()]));
        assert_eq!(find("knife.feed_mm_s").arguments("45 m/min"), Some(vec!["knife.feed_mm_s=45 m/min".to_owned()]));
        let steps = find("gcode.knife_down").arguments("M64 P0; G4 P0.05, M65 P0");
        let steps = steps.expect("two parts");
        assert_eq!(steps, ["gcode.knife_down=[\"M64 P0\", \"G4 P0.05\"]", "gcode.knife_up=[\"M65 P0\"]"]);
    }
}
