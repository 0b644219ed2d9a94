//! Values for the keys of a profile: legal ones, some beside the ends of ranges, and some of every other type.

use cutc::machine::keys::{self, KEYS, Key, Takes, Within};
use toml::Value;

/// A value for a key.
pub(crate) struct Sample {
    pub(crate) key: &'static Key,
    /// The key's own name; of a family that of one of its keys.
    pub(crate) name: String,
    pub(crate) value: Value,
}

/// What no key, or not every one, takes.
fn of_all_types() -> Vec<Value> {
    let list = |numbers: &[f64]| Value::Array(numbers.iter().map(|&number| number.into()).collect());
    let mut values = vec![list(&[]), list(&[0.0]), list(&[0.0, 90.0]), list(&[0.0, 2.0e6]), list(&[90.0, 0.0])];
    values.extend([list(&[1.0, 2.0, 3.0]), list(&[1.0, 2.0, -3.0e6]), list(&[1.0; 4])]);
    values.push(Value::Array(vec![1.into(), 2.into(), "far".into()]));
    values.extend(["", "no such word", "6,6", "\u{e9}", "a\tb"].map(Value::from));
    values.extend([Value::from(true), 0.into(), 1.into(), 7.into(), (-1).into(), 0.5.into(), 1.0e13.into()]);
    values.push(Value::Table(toml::Table::from_iter([("a".to_owned(), 1.into())])));
    values
}

/// Steps of controllers, and texts that are none.
#[rustfmt::skip] // short texts, many to a line
const STEPS: &[&str] = &[
    "M0", "M-0", "m.0", "M00.", "m65p#", "M64 P0", "M64P0.0", "M3", "M3 S#", "M03 s1000.", "M66 P1 L3 Q2", "m66q2l3p#", "M68 E0 Q-5", "G4 P.5",
    "G00 Z-02.50", "g00Z+05", "G1 F300 Z5", "G01z-2.0f300.", " G0 Z1 ", "", "Z-2", "P0 M64", "G1 Z-2", "G1 Z-2 Z5",
    "G0 Z-2 F300", "G0", "G0 C5", "G0 Z#", "G10 Z1", "G33", "G55", "M2", "M71", "M101", "M62 P0", "M64", "M64 P",
    "M64 P0 P1", "M64 P0 M65", "M3 X5", "M3 S1 S2", "M3 S1e3", "M66 P0 L3", "M66 P0 P1 Q2", "M3 (on)", "M 3", "M3.5",
];

/// Numbers at the ends of a range and beside them.
fn around(within: Within) -> Vec<Value> {
    let end = |bound: std::ops::Bound<f64>| match bound {
        std::ops::Bound::Included(end) | std::ops::Bound::Excluded(end) => end,
        std::ops::Bound::Unbounded => panic!("ranges have ends"),
    };
    let (least, greatest) = (end(within.least), end(within.greatest));
    let beside = 1e-3 * (greatest - least);
    let numbers = [least - beside, least, least + beside, f64::midpoint(least, greatest), greatest - beside, greatest];
    numbers.into_iter().chain([greatest + beside, greatest * 1e3]).map(Value::from).collect()
}

/// What is about right for a key.
fn of_its_type(key: &Key) -> Vec<Value> {
    let mut values: Vec<Value> = keys::default_of(key).into_iter().collect();
    match key.takes {
        Takes::Number(within) | Takes::Length(within) => values.extend(around(within)),
        Takes::NumberOr(within, word) => {
            values.extend(around(within));
            values.push(word.into());
        }
        Takes::NumberOrWord(within, words) => {
            values.extend(around(within));
            values.extend(words().iter().map(|&word| Value::from(word)));
        }
        Takes::Whole(numbers) => values.extend((-1..=10).chain(numbers.iter().copied()).map(Value::from)),
        Takes::Percent => values.extend([0.0, 1.0, 74.0, 74.5, 100.0, 101.0].map(Value::from)),
        Takes::Count(most) => values.extend([0, 1, 2, i64::from(most), i64::from(most) + 1].map(Value::from)),
        Takes::PointOr(word) | Takes::PoseOr(word) | Takes::RangeOr(word) => values.push(word.into()),
        Takes::Word(words) => {
            values.extend(words().iter().map(|&word| Value::from(word)));
            values.extend(words().iter().map(|word| format!("{word}s").into()));
        }
        Takes::Encoding => values.extend(["latin1", "Windows-1251", "utf-16", "windos-1251"].map(Value::from)),
        Takes::Steps => {
            values.extend(STEPS.iter().map(|&step| Value::Array(vec!["M9".into(), step.into()])));
            values.extend([Value::Array(vec!["M0".into(), 5.into()]), "M0".into()]);
        }
        Takes::Pairs(first, second) => {
            let pairs = around(first).into_iter().zip(around(second)).map(|(a, b)| Value::Array(vec![a, b]));
            let pairs: Vec<Value> = pairs.collect();
            values.extend(pairs.iter().map(|pair| Value::Array(vec![pair.clone()])));
            values.push(Value::Array(pairs));
            values.push(Value::Array(vec![Value::Array(vec![1.into()])]));
        }
        Takes::Text => values.extend(["(a)\nM2", "M2\u{e9}"].map(Value::from)),
        Takes::Point | Takes::Pose | Takes::Flag => {}
    }
    if let Takes::Length(_) = key.takes {
        values.extend(["1/40 mm", "1/40", " 600dpi", "1/1000 in", "0.1 mm", "1/40 km", "-1 mm", "mm"].map(Value::from));
    }
    values
}

/// Values for every key.
pub(crate) fn samples() -> Vec<Sample> {
    let of_key = |key: &'static Key| {
        let name = key.name.replace("<code>", "M19").replace("<pen>", "2");
        let values = of_its_type(key).into_iter().chain(of_all_types());
        values.map(move |value| Sample { key, name: name.clone(), value })
    };
    KEYS.iter().flat_map(of_key).collect()
}
