//! The schema of profiles: a validator of others takes and refuses by it what loading takes and refuses.

use std::path::Path;
use std::process::Command;

use cutc::machine::keys::{CODE_NAMES, Key, Takes};
use cutc::machine::load;
use serde_json::{Value, json};

use crate::samples::samples;
use crate::{is_there, python};

/// Holds documents against the schema: each machine of the fixtures as it is and with one value after the other, each faulty
/// profile that is TOML, and the profile with every key. What it says: a line a difference, a line a faulty profile.
const SCRIPT: &str = r#"
import copy, json, pathlib, tomllib
from jsonschema import Draft202012Validator

schema = json.load(open("schema.json"))
Draft202012Validator.check_schema(schema)
validator = Draft202012Validator(schema)
fixtures = pathlib.Path(open("fixtures.txt").read())
machines = [tomllib.loads(path.read_text()) for path in sorted(fixtures.glob("machines/*.toml"))]
assert len(machines) >= 5
for whole in machines + [tomllib.loads(open("all.toml").read())]:
    for error in validator.iter_errors(whole):
        print("a machine is refused:", error.json_path, error.message)
for i, (name, value, taken) in enumerate(json.load(open("cases.json"))):
    profile = copy.deepcopy(machines[i % len(machines)])
    *sections, key = name.split(".")
    table = profile
    for section in sections:
        table = table.setdefault(section, {})
    table[key] = value
    if validator.is_valid(profile) != taken:
        print(f"{name} = {value!r} is", "refused" if taken else "taken")
for path in sorted(fixtures.glob("invalid/profile/*.toml")):
    try:
        profile = tomllib.loads(path.read_text(encoding="utf-8"))
    except ValueError:
        continue
    if validator.is_valid(profile):
        print("left to loading:", path.stem)
"#;

/// Faulty profiles that break no more than rules between keys, or that misspell an encoding.
const LEFT_TO_LOADING: [&str; 4] = ["back-against-radius", "back-over-width", "narrow-c-range", "unknown-encoding"];

/// Whether the schema says nothing of such a value.
fn is_left_to_loading(key: &Key, value: &toml::Value) -> bool {
    match key.takes {
        Takes::Encoding => value.is_str(),
        Takes::RangeOr(_) => value.as_array().is_some_and(|ends| {
            let ends: Vec<f64> = ends.iter().filter_map(toml::Value::as_float).collect();
            ends.len() == 2 && ends[0] >= ends[1]
        }),
        _ => false,
    }
}

/// Values with units and names of keys, which loading judges.
fn texts_and_names() -> Vec<(String, toml::Value)> {
    let mut cases: Vec<(String, toml::Value)> = [
        ("knife.feed_mm_s", "45 m/min"),
        ("knife.feed_mm_s", "6,6 m/min"),
        ("knife.width_mm", "1/4 in"),
        ("knife.width_mm", "0.25\""),
        ("knife.width_mm", "6.6"),
        ("knife.slow_percent", "75 %"),
        ("knife.plunge_ms", "5e-2 s"),
        ("axes.c.travel.jerk_deg_s3", "2500 rev/s3"),
        ("counts.x.per_mm", "45 m/min"),
        ("gcode.decimals", "4 mm"),
        ("hpgl.pens.12", "knife"),
        ("hpgl.pens.0", "knife"),
        ("hpgl.pens.01", "knife"),
        ("hpgl.pens.1000", "knife"),
        ("codes.M01", "ignore"),
        ("codes.M0019", "ignore"),
        ("codes.G00", "ignore"),
        ("codes.m19", "ignore"),
        ("codes.M190", "ignore"),
        ("codes.F300", "ignore"),
        ("codes.X", "ignore"),
        ("knife.widht_mm", "6 mm"),
        ("axis", "6 mm"),
    ]
    .map(|(name, text)| (name.to_owned(), text.into()))
    .into();
    cases.extend(CODE_NAMES.iter().map(|code| (format!("codes.{code}"), "use".into())));
    let pose = ["1 in", "0", "0.25 rev"].map(toml::Value::from).to_vec();
    let legal = ["1 in", "-2.5 mm", "0.25 rev"].map(toml::Value::from).to_vec();
    cases.extend([("home", pose), ("park", legal)].map(|(name, list)| (name.to_owned(), list.into())));
    cases
}

/// What a command on profiles prints.
fn printed(command: &str) -> String {
    let ran = Command::new(env!("CARGO_BIN_EXE_cutc")).args(["profile", command]).output().expect("the program starts");
    assert!(ran.status.success());
    String::from_utf8(ran.stdout).expect("UTF-8")
}

#[test]
fn a_validator_of_json_schemas_judges_profiles_as_loading_does() {
    let probe = "import jsonschema, tomllib; jsonschema.Draft202012Validator";
    if !is_there("jsonschema", Command::new("python3").args(["-c", probe])) {
        return;
    }
    let folder = tempfile::tempdir().expect("a directory");
    let write = |name: &str, text: &[u8]| std::fs::write(folder.path().join(name), text).expect("writable");
    write("schema.json", printed("schema").as_bytes());
    write("all.toml", printed("init").as_bytes());
    let samples = samples().into_iter().filter(|sample| !is_left_to_loading(sample.key, &sample.value));
    let mut cases: Vec<(String, Value, bool)> =
        samples.map(|sample| (sample.name, json!(sample.value), sample.key.takes.allows(&sample.value))).collect();
    for (name, value) in texts_and_names() {
        let is_taken = load(None, &[format!("{name}={value}")]).is_ok();
        cases.push((name, json!(value), is_taken));
    }
    write("cases.json", json!(cases).to_string().as_bytes());
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures");
    write("fixtures.txt", fixtures.to_str().expect("UTF-8").as_bytes());
    let ran = python(SCRIPT, folder.path());
    let said = String::from_utf8_lossy(&ran.stdout);
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    assert_eq!(said.lines().collect::<Vec<_>>(), LEFT_TO_LOADING.map(|name| format!("left to loading: {name}")));
}

#[test]
fn taplo_checks_a_profile_by_the_schema_that_its_first_line_names() {
    if !is_there("taplo", Command::new("taplo").arg("--version")) {
        return;
    }
    let folder = tempfile::tempdir().expect("a directory");
    std::fs::write(folder.path().join("cutc.schema.json"), printed("schema")).expect("writable");
    let lint = |profile: &str| {
        let text = format!("#:schema ./cutc.schema.json\n{profile}");
        std::fs::write(folder.path().join("machine.toml"), text).expect("writable");
        Command::new("taplo").args(["lint", "machine.toml"]).current_dir(folder.path()).output().expect("taplo starts")
    };
    let whole = printed("init");
    let taken = lint(&whole);
    assert!(taken.status.success(), "{}", String::from_utf8_lossy(&taken.stderr));
    let damages = [
        ("width_mm = 6.6", "width_mm = -1", "-1 is not valid"),
        ("width_mm = 6.6", "widht_mm = 6.6", "'widht_mm' was unexpected"),
        ("follow = \"tangent\"", "follow = \"line\"", "\"line\" is not one of"),
        ("stop = [\"M0\"]", "stop = [\"G1 Z-2\"]", "\"G1 Z-2\" is not valid"),
    ];
    for (right, wrong, expected) in damages {
        let refused = lint(&whole.replacen(&format!("\n{right}\n"), &format!("\n{wrong}\n"), 1));
        let said = String::from_utf8_lossy(&refused.stderr);
        assert!(!refused.status.success() && said.contains(expected), "{wrong}: {said}");
    }
}
