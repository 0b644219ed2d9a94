//! Values that are a number or a word: `"off"`, `"auto"`, `"unlimited"` stand for "no value" in the profile.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// What TOML may hold where a word is allowed.
#[derive(Deserialize)]
#[serde(untagged)]
enum Typed<T> {
    Value(T),
    Word(String),
}

fn read<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    input: D,
    word: &str,
    what: &str,
) -> Result<Option<T>, D::Error> {
    let expected = || serde::de::Error::custom(format!("expected {what} or \"{word}\""));
    match Typed::<T>::deserialize(input).map_err(|_| expected())? {
        Typed::Value(value) => Ok(Some(value)),
        Typed::Word(text) if text == word => Ok(None),
        Typed::Word(_) => Err(expected()),
    }
}

fn write<S: Serializer, T: Serialize>(value: &Option<T>, output: S, word: &str) -> Result<S::Ok, S::Error> {
    match value {
        Some(value) => value.serialize(output),
        None => output.serialize_str(word),
    }
}

pub(super) mod off {
    use super::{Deserializer, Serializer};

    pub(in crate::machine) fn deserialize<'de, D: Deserializer<'de>>(input: D) -> Result<Option<f64>, D::Error> {
        super::read(input, "off", "a number")
    }

    pub(in crate::machine) fn serialize<S: Serializer>(value: &Option<f64>, output: S) -> Result<S::Ok, S::Error> {
        super::write(value, output, "off")
    }
}

pub(super) mod auto {
    use super::{Deserializer, Serializer};

    pub(in crate::machine) fn deserialize<'de, D: Deserializer<'de>>(input: D) -> Result<Option<f64>, D::Error> {
        super::read(input, "auto", "a number")
    }

    pub(in crate::machine) fn serialize<S: Serializer>(value: &Option<f64>, output: S) -> Result<S::Ok, S::Error> {
        super::write(value, output, "auto")
    }
}

pub(super) mod stay {
    use super::{Deserializer, Serializer};

    pub(in crate::machine) fn deserialize<'de, D: Deserializer<'de>>(input: D) -> Result<Option<[f64; 3]>, D::Error> {
        super::read(input, "stay", "a pose [x_mm, y_mm, c_deg]")
    }

    pub(in crate::machine) fn serialize<S: Serializer>(value: &Option<[f64; 3]>, output: S) -> Result<S::Ok, S::Error> {
        super::write(value, output, "stay")
    }
}

pub(super) mod unbounded {
    use super::{Deserializer, Serializer};

    pub(in crate::machine) fn deserialize<'de, D: Deserializer<'de>>(input: D) -> Result<Option<[f64; 2]>, D::Error> {
        super::read(input, "unbounded", "a range [least, greatest]")
    }

    pub(in crate::machine) fn serialize<S: Serializer>(value: &Option<[f64; 2]>, output: S) -> Result<S::Ok, S::Error> {
        super::write(value, output, "unbounded")
    }
}

pub(super) mod unlimited {
    use super::{Deserializer, Serializer};

    pub(in crate::machine) fn deserialize<'de, D: Deserializer<'de>>(input: D) -> Result<Option<[f64; 2]>, D::Error> {
        super::read(input, "unlimited", "a range [least, greatest]")
    }

    pub(in crate::machine) fn serialize<S: Serializer>(value: &Option<[f64; 2]>, output: S) -> Result<S::Ok, S::Error> {
        super::write(value, output, "unlimited")
    }
}
