//! JSON Schema (draft 2020-12) of the profile, derived from the table of keys alone: editors complete and check a profile with
//! it while it is written.
//!
//! Every profile that loads conforms to it. Some checks are left to loading: rules between keys, the order of two numbers,
//! ranges of values that are texts with a unit or words of a step, names of encodings, lines of text. In JSON 1.0 is a whole
//! number, in TOML it is not.

use std::ops::Bound;

use serde_json::{Map, Value, json};

use super::encoding;
use super::gcode::spellings;
use super::key::{Key, PERCENT, PLACE, Takes, Within};
use super::keys::{self, KEYS};
use super::plot::PlotUnit;
use crate::units::quantity;

/// References to definitions that several keys share.
const STEP: &str = "#/$defs/step";
const QUANTITY: &str = "#/$defs/quantity";

/// Number in a text, without its sign.
const NUMBER: &str = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?";

/// Schema of profiles.
pub fn schema() -> Value {
    let mut root = section();
    for key in KEYS {
        put(&mut root, key);
    }
    root.insert("$schema".to_owned(), "https://json-schema.org/draft/2020-12/schema".into());
    root.insert("$defs".to_owned(), json!({ "quantity": quantity_text(), "step": step() }));
    root.insert("title".to_owned(), "Machine profile of cutc".into());
    root.insert("description".to_owned(), "Keys that are left out have their default.".into());
    Value::Object(root)
}

/// Schema of a table without keys.
fn section() -> Map<String, Value> {
    let parts = [("type", "object".into()), ("additionalProperties", false.into())];
    parts.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// Inserts a key into the nested tables of its name.
fn put(root: &mut Map<String, Value>, key: &Key) {
    let mut at = root;
    for name in key.section().split('.').filter(|name| !name.is_empty()) {
        at = member(at, "properties", name, || Value::Object(section()));
    }
    let value = || described(key);
    match keys::family(key.section()) {
        Some(family) => member(at, "patternProperties", &format!("^{}$", (family.pattern)()), value),
        None => member(at, "properties", key.name.rsplit('.').next().unwrap_or(key.name), value),
    };
}

/// Schema under a name in a group of a table's schema, created if missing.
fn member<'s>(
    table: &'s mut Map<String, Value>,
    group: &str,
    name: &str,
    value: impl FnOnce() -> Value,
) -> &'s mut Map<String, Value> {
    let group = table.entry(group).or_insert_with(|| json!({})).as_object_mut().expect("a group is an object");
    group.entry(name).or_insert_with(value).as_object_mut().expect("a schema is an object")
}

/// Schema of a key, with its meaning and its default.
fn described(key: &Key) -> Value {
    let expects = key.expects();
    let (first, rest) = expects.split_at(1);
    let or = match key.takes {
        Takes::Point | Takes::PointOr(_) | Takes::Pose | Takes::PoseOr(_) | Takes::RangeOr(_) => "; each number may be",
        _ => ", or",
    };
    let texts = quantity::kind(key.unit_of(0)).map(|(_, examples)| format!("{or} a text such as {examples}"));
    let takes = format!("{}{rest}{}.", first.to_uppercase(), texts.unwrap_or_default());
    let mut value = values(key);
    value["description"] = format!("{} {takes}", key.about.replace('\n', " ")).into();
    if let Some(default) = keys::default_of(key) {
        value["default"] = plain(&default);
    }
    value
}

/// Schema of the values of a key.
fn values(key: &Key) -> Value {
    let mut ways = match key.takes {
        Takes::Number(within) | Takes::NumberOr(within, _) | Takes::NumberOrWord(within, _) => {
            quantities(numbers(within), &[key.unit()])
        }
        Takes::Whole(numbers) => vec![json!({ "type": "integer", "enum": numbers })],
        Takes::Count(most) => vec![json!({ "type": "integer", "minimum": 1, "maximum": most })],
        Takes::Percent => {
            let mut whole = numbers(PERCENT);
            whole["type"] = "integer".into();
            quantities(whole, &[key.unit()])
        }
        Takes::Point | Takes::PointOr(_) | Takes::RangeOr(_) => vec![places(key, 2)],
        Takes::Pose | Takes::PoseOr(_) => vec![places(key, 3)],
        Takes::Length(within) => vec![numbers(within), json!({ "type": "string", "pattern": PlotUnit::pattern() })],
        Takes::Word(words) => vec![json!({ "enum": words() })],
        // Only these are suggested; the standard has more.
        Takes::Encoding => vec![json!({ "enum": &encoding::NAMES[..] }), json!({ "type": "string" })],
        Takes::Text => vec![json!({ "type": "string", "pattern": r"^[\n -~]*$" })],
        Takes::Steps => vec![json!({ "type": "array", "items": { "$ref": STEP } })],
        Takes::Pairs(first, second) => {
            let pair = [numbers(first), numbers(second)];
            let pair = json!({ "type": "array", "minItems": 2, "maxItems": 2, "prefixItems": pair });
            vec![json!({ "type": "array", "items": pair })]
        }
        Takes::Flag => vec![json!({ "type": "boolean" })],
    };
    if let Takes::NumberOr(_, other) | Takes::PointOr(other) | Takes::PoseOr(other) | Takes::RangeOr(other) = key.takes
    {
        ways.push(json!({ "const": other }));
    }
    if let Takes::NumberOrWord(_, words) = key.takes {
        ways.push(json!({ "enum": words() }));
    }
    one_of(ways)
}

/// Single schema, or a choice of several.
fn one_of(mut ways: Vec<Value>) -> Value {
    if ways.len() == 1 { ways.remove(0) } else { json!({ "anyOf": ways }) }
}

/// Numbers in a range.
fn numbers(within: Within) -> Value {
    let mut schema = json!({ "type": "number" });
    for (end, included, excluded) in
        [(within.least, "minimum", "exclusiveMinimum"), (within.greatest, "maximum", "exclusiveMaximum")]
    {
        match end {
            Bound::Included(end) => schema[included] = number(end),
            Bound::Excluded(end) => schema[excluded] = number(end),
            Bound::Unbounded => {}
        }
    }
    schema
}

/// List of `count` positions.
fn places(key: &Key, count: usize) -> Value {
    let units: Vec<&str> = (0..count).map(|n| key.unit_of(n)).collect();
    let items = one_of(quantities(numbers(PLACE), &units));
    json!({ "type": "array", "minItems": count, "maxItems": count, "items": items })
}

/// Numbers, and texts of a number and a unit if one of the units has alternatives.
fn quantities(numbers: Value, units: &[&str]) -> Vec<Value> {
    let mut ways = vec![numbers];
    if units.iter().any(|unit| quantity::kind(unit).is_some()) {
        ways.push(json!({ "$ref": QUANTITY }));
    }
    ways
}

/// Text of a number and a unit; the units themselves are checked on loading.
fn quantity_text() -> Value {
    let pattern = format!(r"^\s*[+-]?{NUMBER}(?:\s*/\s*\+?{NUMBER})?\s*[^\s0-9,.+/-].*$");
    json!({ "description": "A number with a unit of the key's kind.", "type": "string", "pattern": pattern })
}

/// Step of a controller.
fn step() -> Value {
    let kinds = spellings().map(|kind| {
        json!({ "description": kind.about, "examples": [kind.example], "type": "string", "pattern": kind.pattern })
    });
    let kinds: Vec<Value> = kinds.collect();
    json!({ "description": "A step of the controller: a line of its program.", "anyOf": kinds })
}

/// Value of a profile in JSON.
fn plain(value: &toml::Value) -> Value {
    match value {
        toml::Value::Float(value) => number(*value),
        toml::Value::Array(items) => items.iter().map(plain).collect(),
        toml::Value::Table(table) => table.iter().map(|(name, value)| (name.clone(), plain(value))).collect(),
        toml::Value::Integer(value) => (*value).into(),
        toml::Value::Boolean(value) => (*value).into(),
        toml::Value::String(text) => text.clone().into(),
        toml::Value::Datetime(date) => date.to_string().into(),
    }
}

/// Limit below which every whole number is exact in floating point.
const WHOLE_MAX: f64 = 9.0e15;

/// Number, without a point if it is whole.
fn number(value: f64) -> Value {
    if value.fract() == 0.0 && value.abs() <= WHOLE_MAX { (value as i64).into() } else { value.into() }
}
