//! Loading of a profile: TOML text, overridden by `--set` arguments. Every fault is reported at its place.

use std::ops::Range;

use serde::Deserialize as _;
use toml::de::{DeTable, DeValue, ValueDeserializer};

use super::codes::{self, CODES};
use super::gcode::{Flaw, Step};
use super::key::{Key, Takes};
use super::keys;
use super::measured::{self, Mismeasured};
use super::near;
use super::origin;
use super::plot;
use super::profile::MachineProfile;
use super::validate::validate;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::source::{Source, Span};

/// Faults of a profile; at least one of the two has errors.
#[derive(Debug, Default)]
pub struct Faults {
    /// Faults in the file.
    pub file: Diagnostics,
    /// Faults in the `--set` arguments; each names its argument.
    pub arguments: Diagnostics,
}

/// Reads a profile: the defaults, overridden by the file, then by `key=value` arguments in their order.
pub fn load(file: Option<&Source>, sets: &[String]) -> Result<MachineProfile, Faults> {
    load_given(file, sets).map(|(profile, _)| profile)
}

/// Reads a profile like [`load`], and tells its origin.
pub fn load_given(file: Option<&Source>, sets: &[String]) -> Result<(MachineProfile, origin::Origin), Faults> {
    if file.is_none() && sets.is_empty() {
        // The defaults have no faults.
        return Ok((MachineProfile::default(), origin::Origin::default()));
    }
    let mut draft = Draft::default();
    if let Some(file) = file {
        draft.read(file);
    }
    for argument in sets {
        draft.set(argument);
    }
    let name = file.map(|file| file.name().rsplit(['/', '\\']).next().unwrap_or_default().to_owned());
    let given = draft.given.iter().map(|(key, _)| key.clone()).collect();
    let set = |(key, origin): &(String, Origin)| match origin {
        Origin::Argument(argument) => Some((key.clone(), argument.split_once('=')?.1.trim().to_owned())),
        Origin::File(_) => None,
    };
    let set = draft.given.iter().filter_map(set).collect();
    let origin = origin::Origin { file: name, set, given };
    Ok((draft.finish()?, origin))
}

/// Origin of a value.
#[derive(Debug, Clone)]
enum Origin {
    File(Span),
    Argument(String),
}

/// Profile under construction.
#[derive(Debug, Default)]
struct Draft {
    /// Values with the types of their keys.
    values: toml::Table,
    /// Their keys, the one given last at the end.
    given: Vec<(String, Origin)>,
    /// Keys with unusable values, whose defaults must not be checked against others.
    broken: Vec<String>,
    faults: Vec<(Origin, Diagnostic)>,
}

/// Value with the place of its key and its own text.
struct Entry<'a> {
    name: String,
    origin: Origin,
    text: &'a str,
}

impl Draft {
    fn read(&mut self, file: &Source) {
        let bytes = file.bytes();
        let text = match std::str::from_utf8(bytes) {
            Ok(text) => text,
            Err(error) => {
                let at = error.valid_up_to();
                let fault = Diagnostic::new(&code::PROFILE_SYNTAX, "the profile is not UTF-8 text");
                return self.fault(span(at..at + 1), fault.hint("save it as plain UTF-8 text"));
            }
        };
        let (root, errors) = DeTable::parse_recoverable(text);
        for error in &errors {
            let at = error.span().unwrap_or(0..0);
            self.fault(span(at), Diagnostic::new(&code::PROFILE_SYNTAX, error.message().replace('\n', ", ")));
        }
        // Parts of broken TOML are unreliable: their keys would only cause spurious faults.
        if errors.is_empty() {
            self.walk("", root.get_ref(), text);
        }
    }

    /// Adds every key of a table.
    fn walk(&mut self, prefix: &str, table: &DeTable<'_>, text: &str) {
        for (key, value) in table {
            let name =
                if prefix.is_empty() { key.get_ref().to_string() } else { format!("{prefix}.{}", key.get_ref()) };
            let origin = span(key.span());
            match value.get_ref() {
                DeValue::Table(inner) if keys::is_section(&name) => self.walk(&name, inner, text),
                DeValue::Table(_) if keys::find(&name).is_some() => self.mistyped(&name, origin, "a table"),
                DeValue::Table(_) => self.unknown(&name, origin),
                DeValue::String(_)
                | DeValue::Integer(_)
                | DeValue::Float(_)
                | DeValue::Boolean(_)
                | DeValue::Datetime(_)
                | DeValue::Array(_) => {
                    let text = text.get(value.span()).unwrap_or_default();
                    self.take(Entry { name, origin, text });
                }
            }
        }
    }

    /// Adds a `key=value` argument; a value that is not TOML is a bare word.
    fn set(&mut self, argument: &str) {
        let origin = Origin::Argument(argument.to_owned());
        let Some((name, text)) = argument.split_once('=') else {
            let fault = Diagnostic::new(&code::PROFILE_SYNTAX, "it is no key=value");
            return self.fault(origin, fault.hint("write it as in `--set knife.width_mm=6.6`"));
        };
        let (name, text) = (name.trim().to_owned(), text.trim());
        if DeValue::parse(text).is_ok() {
            return self.take(Entry { name, origin, text });
        }
        let text = match text.strip_prefix('[').and_then(|list| list.strip_suffix(']')) {
            // Items of a list need no quotes either.
            Some(list) => {
                format!("[{}]", list.split(',').map(|item| quoted(item.trim())).collect::<Vec<_>>().join(", "))
            }
            None => quoted(text),
        };
        self.take(Entry { name, origin, text: &text });
    }

    /// Adds a value if its key exists and allows it.
    fn take(&mut self, entry: Entry<'_>) {
        let Entry { name, origin, text } = entry;
        let name = codes::canonical(&name);
        let Some(key) = keys::find(&name) else {
            if keys::is_section(&name) {
                let fault = Diagnostic::new(&code::PROFILE_TYPE, format!("`{name}` is a table of keys, not a key"));
                return self.fault(origin, fault.hint(format!("write `[{name}]`, and its keys below it")));
            }
            return self.unknown(&name, origin);
        };
        let value = ValueDeserializer::parse(text).and_then(toml::Value::deserialize).ok();
        let value = match value.map(|value| measured::plain(key, value)).transpose() {
            Ok(value) => value,
            Err(wrong) => return self.mismeasured(&name, origin, text, key, &wrong),
        };
        if let Some(flaw) = value.as_ref().and_then(|value| flaw_of_steps(key, value)) {
            let fault = Diagnostic::new(&code::PROFILE_RANGE, format!("`{name}` has {}", flaw.has));
            self.broken.push(name);
            return self.fault(origin, fault.hint(flaw.hint));
        }
        let typed = value.filter(|value| MachineProfile::deserialize(nested(&name, value.clone())).is_ok());
        match typed {
            Some(value) => {
                merge(&mut self.values, nested(&name, value));
                self.given.retain(|(other, _)| *other != name);
                self.given.push((name, origin));
            }
            None => self.mistyped(&name, origin, &shortened(text)),
        }
    }

    /// Reports a value of the wrong type.
    fn mistyped(&mut self, name: &str, origin: Origin, found: &str) {
        let expected = keys::find(name).map(Key::expects).unwrap_or_default();
        let message = format!("`{name}` must be {expected}, but is {found}");
        self.broken.push(name.to_owned());
        self.fault(origin, Diagnostic::new(&code::PROFILE_TYPE, message));
    }

    /// Reports a number with a unit of another kind than the key's.
    fn mismeasured(&mut self, name: &str, origin: Origin, text: &str, key: &Key, wrong: &Mismeasured) {
        let measures =
            wrong.measures.map_or_else(|| ", whose unit is not known".to_owned(), |what| format!(", {what}"));
        let message = format!("`{name}` must be {}, but is {}{measures}", key.expects(), shortened(text));
        let fault = Diagnostic::new(&code::PROFILE_TYPE, message);
        self.fault(origin, wrong.hint().into_iter().fold(fault, Diagnostic::hint));
    }

    fn unknown(&mut self, name: &str, origin: Origin) {
        let hint = match codes::near_codes(name).as_deref() {
            Some([code]) => format!("it is spelled `{code}`"),
            Some(codes) => format!("near ones are `{}`; `cutc manual inputs` lists all codes", codes.join("`, `")),
            None if name == "table.strict" => {
                "leave it out: what leaves the table by more than a millimetre is an error now, anyway".to_owned()
            }
            None if name == plot::NO_PEN => "pen 0 is none: plotters draw nothing with it, nor is it cut".to_owned(),
            None => {
                let near = near::nearest(name);
                let takes = keys::find(&near).map_or_else(String::new, |key| format!(" ({})", key.expects()));
                format!("the nearest is `{near}`{takes}; `cutc profile init` lists all keys")
            }
        };
        let fault = Diagnostic::new(&code::PROFILE_UNKNOWN_KEY, format!("there is no key `{name}`"));
        self.fault(origin, fault.hint(hint));
    }

    fn fault(&mut self, origin: Origin, diagnostic: Diagnostic) {
        let diagnostic = match &origin {
            Origin::File(span) => diagnostic.at(*span),
            Origin::Argument(argument) => {
                let message = format!("--set {argument}: {}", diagnostic.message);
                Diagnostic { message, ..diagnostic }
            }
        };
        self.faults.push((origin, diagnostic));
    }

    /// Profile, or all its faults.
    fn finish(mut self) -> Result<MachineProfile, Faults> {
        let mut profile = MachineProfile::deserialize(std::mem::take(&mut self.values))
            .expect("values that fit the profile one by one fit it together");
        let given = std::mem::take(&mut self.given);
        let faults = validate(&profile, &|key| given.iter().any(|(name, _)| name == key));
        let broken = std::mem::take(&mut self.broken);
        for fault in faults.into_iter().filter(|fault| !fault.keys.iter().any(|key| broken.contains(key))) {
            // The key given last is the one that broke the rule.
            let origin =
                given.iter().rev().find(|(name, _)| fault.keys.contains(name)).map(|(_, origin)| origin.clone());
            let origin = origin.unwrap_or(Origin::File(Span::default()));
            let diagnostic = Diagnostic::new(fault.code, fault.message);
            self.fault(origin, fault.hint.into_iter().fold(diagnostic, Diagnostic::hint));
        }
        if self.faults.is_empty() {
            profile.tool.kind.fit(&mut profile.knife);
            return Ok(profile);
        }
        // First in the order of the file, then in that of the arguments.
        self.faults.sort_by_key(|(origin, _)| if let Origin::File(span) = origin { span.start } else { u32::MAX });
        let mut faults = Faults::default();
        for (origin, diagnostic) in self.faults {
            match origin {
                Origin::File(_) => faults.file.push(diagnostic),
                Origin::Argument(_) => faults.arguments.push(diagnostic),
            }
        }
        Err(faults)
    }
}

/// Flaw of the first invalid step in a list.
fn flaw_of_steps(key: &Key, value: &toml::Value) -> Option<Flaw> {
    let texts = value.as_array().filter(|_| matches!(key.takes, Takes::Steps))?.iter().filter_map(toml::Value::as_str);
    texts.map(Step::read).find_map(Result::err)
}

/// Value in TOML: unchanged if valid, else as a string.
fn quoted(text: &str) -> String {
    if DeValue::parse(text).is_ok() { text.to_owned() } else { toml::Value::String(text.to_owned()).to_string() }
}

fn span(bytes: Range<usize>) -> Origin {
    // A `Source` is below 4 GiB.
    Origin::File(Span { start: bytes.start as u32, end: bytes.end as u32, block: 0 })
}

/// Greatest length of a quoted value in a message, characters.
const QUOTED_CHARS: usize = 40;

fn shortened(text: &str) -> String {
    if text.chars().count() <= QUOTED_CHARS {
        return text.replace('\n', " ");
    }
    let start: String = text.chars().take(QUOTED_CHARS).collect();
    format!("{}...", start.replace('\n', " "))
}

/// Nested tables with one value under a dotted name.
fn nested(name: &str, value: toml::Value) -> toml::Table {
    let (head, rest) = name.split_once('.').map_or((name, None), |(head, rest)| (head, Some(rest)));
    let value = match rest {
        // A code of the cutter file is one word, even with dots.
        Some(rest) if head != CODES => toml::Value::Table(nested(rest, value)),
        Some(rest) => toml::Value::Table(toml::Table::from_iter([(rest.to_owned(), value)])),
        None => value,
    };
    toml::Table::from_iter([(head.to_owned(), value)])
}

/// Overrides the values of one table by those of another.
fn merge(base: &mut toml::Table, over: toml::Table) {
    for (key, value) in over {
        match (base.get_mut(&key), value) {
            (Some(toml::Value::Table(inner)), toml::Value::Table(value)) => merge(inner, value),
            (_, value) => {
                base.insert(key, value);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::render;
    use crate::machine::Axis;

    fn source(text: &str) -> Source {
        Source::new("machine.toml", text.as_bytes().to_vec()).expect("small")
    }

    fn profile(text: &str, sets: &[&str]) -> MachineProfile {
        let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
        let source = source(text);
        load(Some(&source), &sets).map_err(|faults| render(&faults.file, &source)).expect("a legal profile")
    }

    fn messages(text: &str, sets: &[&str]) -> Vec<String> {
        let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
        let faults = load(Some(&source(text)), &sets).expect_err("a faulty profile");
        faults.file.iter().chain(&faults.arguments).map(|d| format!("{}: {}", d.code.name, d.message)).collect()
    }

    #[test]
    fn arguments_override_the_file_and_the_file_the_defaults() {
        let text = "[knife]\nwidth_mm = 8.89\nfeed_mm_s = 500\n[codes]\nM19 = \"ignore\"";
        let read =
            profile(text, &["knife.width_mm=7", "axes.c.speed_deg_s = 720", "knife.feed_mm_s=off", "units=mm/10"]);
        assert_eq!((read.knife.width_mm, read.knife.feed_mm_s, read.axes.c.speed_deg_s), (7.0, None, 720.0));
        assert_eq!(read.units.mm(), Some(0.1));
        assert!(!read.obeys("M19") && read.obeys("M14"));
        assert_eq!(profile("", &[]), MachineProfile::default());
    }

    #[test]
    fn a_point_needs_no_other_key() {
        let knife = profile("knife.width_mm = 0", &[]).knife;
        assert_eq!((knife.radius(), knife.back()), (0.0, 0.0));
        let knife = profile("", &["knife.width_mm=3"]).knife;
        assert_eq!((knife.radius(), knife.back()), (0.0, 3.0));
    }

    #[test]
    fn a_value_may_have_another_unit_than_its_key() {
        let text = "knife.width_mm = \"0.25 in\"\ntable.x_mm = [\"0 m\", 10000]\nhome = [\"1 cm\", 2, \"0.25 rev\"]";
        let sets = ["knife.feed_mm_s=\"45 m/min\"", "axes.c.speed_deg_s=2 rev/s", "knife.plunge_ms=0.05 s"];
        let read = profile(text, &[&sets[..], &["table.y_mm=[0, 1.8 m]", "knife.slow_percent=60 %"]].concat());
        assert_eq!((read.knife.width_mm, read.knife.feed_mm_s), (6.35, Some(750.0)));
        assert_eq!((read.axes.c.speed_deg_s, read.knife.plunge_ms, read.knife.slow_percent), (720.0, 50.0, 60.0));
        assert_eq!((read.table.x_mm, read.table.y_mm), (Some([0.0, 10_000.0]), Some([0.0, 1800.0])));
        assert_eq!(read.home, [10.0, 2.0, 90.0]);
    }

    #[test]
    fn a_unit_of_something_else_is_a_fault_that_says_what_is_wanted() {
        let text = "knife.width_mm = \"45 m/min\"\nknife.plunge_ms = \"50 msec\"\nhome = [0, 0, \"1 m\"]";
        let faults = load(Some(&source(text)), &["knife.edges=2 mm".to_owned()]).expect_err("a faulty profile");
        let found: Vec<_> = faults.file.iter().map(|d| (d.message.as_str(), d.hints[0].as_str())).collect();
        assert_eq!(
            found,
            [
                (
                    "`knife.width_mm` must be a number from 0 to 1000 mm, but is \"45 m/min\", a speed",
                    "it is a length: a plain number of mm, or a text such as \"6.35 mm\" or \"0.25 in\"",
                ),
                (
                    "`knife.plunge_ms` must be a number from 0 to 10000 ms, but is \"50 msec\", whose unit is not known",
                    "it is a time: a plain number of ms, or a text such as \"50 ms\" or \"0.05 s\"",
                ),
                (
                    "`home` must be three numbers [x_mm, y_mm, c_deg], but is [0, 0, \"1 m\"], a length",
                    "it is an angle: a plain number of degrees, or a text such as \"45 deg\" or \"0.125 rev\"",
                ),
            ]
        );
        assert_eq!(faults.arguments.iter().count(), 1);
    }

    #[test]
    fn a_profile_knows_where_it_came_from() {
        let file = Source::new("cutters/left.toml", b"knife.width_mm = 7\nknife.back_mm = 5".to_vec()).expect("small");
        let (_, from) = load_given(Some(&file), &["knife.width_mm=6".to_owned()]).expect("legal");
        assert_eq!((from.name(), from.described().as_str()), ("left.toml", "left.toml, with knife.width_mm set"));
        assert_eq!(from.axis(), Axis::Told);
        let (_, from) = load_given(None, &["knife.width_mm=7".to_owned()]).expect("legal");
        assert_eq!((from.name(), from.axis()), ("default machine", Axis::Assumed));
        assert_eq!(load_given(None, &[]).expect("legal").1, origin::Origin::default());
    }

    #[test]
    fn every_fault_of_a_file_comes_in_one_run_in_its_order() {
        let found = messages("knive = 3\n[knife]\nwidth_mm = \"6,6\"\nedges = 3\n[time]\nperiod_ms = 0\n", &[]);
        assert_eq!(
            found,
            [
                "profile/unknown-key: there is no key `knive`",
                "profile/type: `knife.width_mm` must be a number from 0 to 1000 mm, but is \"6,6\"",
                "profile/range: `knife.edges` must be 1 or 2, but is 3",
                "profile/range: `time.period_ms` must be a number from 0.1 to 100 ms, but is 0",
            ]
        );
    }

    #[test]
    fn a_code_that_no_file_has_is_a_fault() {
        let text = "[codes]\nX = \"ignore\"\nM99 = \"use\"\n";
        let faults = load(Some(&source(text)), &["codes.m19=ignore".to_owned()]).expect_err("a faulty profile");
        let hints: Vec<&str> = faults.file.iter().chain(&faults.arguments).map(|d| d.hints[0].as_str()).collect();
        assert_eq!(
            hints,
            [
                "near ones are `codes.A`, `codes.B`, `codes.E`; `cutc manual inputs` lists all codes",
                "near ones are `codes.M19`, `codes.M69`, `codes.G90`; `cutc manual inputs` lists all codes",
                "it is spelled `codes.M19`",
            ]
        );
    }

    #[test]
    fn a_code_may_be_spelled_as_files_spell_it() {
        let profile = load(None, &["codes.M01=ignore".to_owned(), "codes.G091=ignore".to_owned()]).expect("two codes");
        assert!(!profile.obeys("M1") && !profile.obeys("G91") && profile.obeys("M19"));
    }

    #[test]
    fn a_fault_of_an_argument_names_it() {
        assert_eq!(
            messages("", &["knife.width_mm=nan", "c.range_deg=[0, 90]", "knife", "park=home"]),
            [
                "profile/syntax: --set knife: it is no key=value",
                "profile/type: --set park=home: `park` must be three numbers [x_mm, y_mm, c_deg], or \"stay\", but is \"home\"",
                "profile/range: --set knife.width_mm=nan: `knife.width_mm` must be a number from 0 to 1000 mm, but is NaN",
                "profile/range: --set c.range_deg=[0, 90]: `c.range_deg` spans 90 degrees, less than 370",
            ]
        );
    }

    #[test]
    fn limits_must_be_positive_numbers() {
        for value in ["0", "-1", "nan", "inf", "-inf", "1e-300"] {
            for key in keys::KEYS.iter().filter(|key| key.name.starts_with("axes.")) {
                let found = messages("", &[&format!("{}={value}", key.name)]);
                assert!(found.len() == 1 && found[0].starts_with("profile/range"), "{found:?}");
            }
        }
    }

    #[test]
    fn back_and_radius_make_the_width() {
        let check = |text: &str, expected: &str| assert_eq!(messages(text, &[]), [expected]);
        check(
            "knife = { width_mm = 6, back_mm = 7 }",
            "profile/range: `knife.back_mm` is 7 mm, more than `knife.width_mm`, 6 mm",
        );
        check(
            "knife = { width_mm = 6, radius_mm = 7 }",
            "profile/range: `knife.radius_mm` is 7 mm, more than `knife.width_mm`, 6 mm",
        );
        check(
            "knife = { width_mm = 6, back_mm = 2, radius_mm = 3 }",
            "profile/range: `knife.back_mm` and `knife.radius_mm` disagree: 2 mm and 3 mm are not the 6 mm of `knife.width_mm`",
        );
        assert!(
            (profile("knife = { width_mm = 6, back_mm = 2, radius_mm = 4 }", &[]).knife.radius() - 4.0).abs() < 1e-12
        );
        assert!((profile("knife = { width_mm = 6, radius_mm = 4 }", &[]).knife.back() - 2.0).abs() < 1e-12);
    }

    #[test]
    fn keys_of_g_code_that_contradict_each_other_are_a_fault() {
        let check = |sets: &[&str], expected: &str| assert_eq!(messages("", sets), [expected]);
        check(
            &["gcode.wrapped=true", "c.range_deg=[-400, 400]"],
            "profile/range: --set c.range_deg=[-400, 400]: `gcode.wrapped` is true, but `c.range_deg` gives the axis ends",
        );
        check(
            &["gcode.heading_tolerance_deg=1"],
            "profile/range: --set gcode.heading_tolerance_deg=1: `gcode.heading_tolerance_deg` is 1 degrees, more than \
             `verify.max_heading_deg`, 0.5 degrees",
        );
        check(
            &["gcode.feed_counts=all", "gcode.feed_mode=G93"],
            "profile/range: --set gcode.feed_mode=G93: `gcode.feed_mode` is \"G93\" with arcs, which the grbl family \
             mistimes",
        );
        profile("", &["gcode.feed_counts=all", "gcode.feed_mode=G93", "gcode.arcs=false"]);
        let hasty = "gcode.advance=[\"G0 Z9\", \"M64 P5\"]";
        profile("", &[hasty]);
        check(
            &[hasty, "gcode.outputs=immediate"],
            "profile/range: --set gcode.outputs=immediate: `gcode.advance` has M64 P5 behind G0 Z9, for which it does not \
             wait",
        );
        // Its default was not asked for.
        let strict = profile("", &["verify.max_heading_deg=0.05"]);
        assert!((strict.blade_tolerance() - 0.05_f64.to_radians()).abs() < 1e-12);
    }

    #[test]
    fn no_text_makes_it_panic() {
        for text in
            ["\u{feff}", "=", "[[knife]]", "[knife.width_mm]", "[codes.M1]\nx=1", "a.b.c.d=1", "\"\"=1", "home=[1,2]"]
        {
            let _ = load(Some(&source(text)), &[]);
            let _ = load(None, &[text.to_owned(), format!("{text}=1"), format!("home={text}")]);
        }
        let junk: Vec<u8> = (0..4096_u32).map(|i| ((i * 7919) >> 3) as u8).collect();
        assert!(load(Some(&Source::new("junk", junk).expect("small")), &[]).is_err());
    }
}
