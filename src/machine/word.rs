//! Words of the profile: those in place of a value, such as `"off"`, `"auto"`, `"unlimited"`, and the variants of an enum.

use std::fmt;
use std::marker::PhantomData;

use serde::{Deserialize, Deserializer, Serialize, Serializer, forward_to_deserialize_any};

/// Word in place of a value.
pub(super) trait Word {
    /// The word as it is typed.
    const WORD: &'static str;
}

/// Value or word, for `#[serde(with = "OrWord::<Off>")]` on an `Option`.
pub(super) struct OrWord<W>(PhantomData<W>);

/// Value or text in TOML where a word is allowed.
#[derive(Deserialize)]
#[serde(untagged)]
enum Typed<T> {
    Value(T),
    Word(String),
}

impl<W: Word> OrWord<W> {
    /// Reads a value, or `None` for the word; any other word is an error.
    pub(super) fn deserialize<'de, D: Deserializer<'de>, T: Deserialize<'de>>(input: D) -> Result<Option<T>, D::Error> {
        let expected = || serde::de::Error::custom(format!("expected a value or \"{}\"", W::WORD));
        match Typed::<T>::deserialize(input).map_err(|_| expected())? {
            Typed::Value(value) => Ok(Some(value)),
            Typed::Word(text) if text == W::WORD => Ok(None),
            Typed::Word(_) => Err(expected()),
        }
    }

    /// Writes a value, or the word for `None`.
    #[allow(clippy::ref_option, reason = "serde hands the field over by reference")]
    pub(super) fn serialize<S: Serializer, T: Serialize>(value: &Option<T>, output: S) -> Result<S::Ok, S::Error> {
        match value {
            Some(value) => value.serialize(output),
            None => output.serialize_str(W::WORD),
        }
    }
}

/// `"off"`: the feature is not used.
pub(super) struct Off;
/// `"as-drawn"`: the value of the file.
pub(super) struct AsDrawn;
/// `"auto"`: derived from other values.
pub(super) struct Auto;
/// `"corner"`: the corner of the table.
pub(super) struct Corner;
/// `"stay"`: no move.
pub(super) struct Stay;
/// `"unbounded"`: an axis without ends.
pub(super) struct Unbounded;
/// `"same"`: the value that holds otherwise.
pub(super) struct Same;
/// `"unlimited"`: a table without edges.
pub(super) struct Unlimited;

impl Word for AsDrawn {
    const WORD: &'static str = "as-drawn";
}

impl Word for Off {
    const WORD: &'static str = "off";
}

impl Word for Corner {
    const WORD: &'static str = "corner";
}

impl Word for Auto {
    const WORD: &'static str = "auto";
}

impl Word for Stay {
    const WORD: &'static str = "stay";
}

impl Word for Unbounded {
    const WORD: &'static str = "unbounded";
}

impl Word for Same {
    const WORD: &'static str = "same";
}

impl Word for Unlimited {
    const WORD: &'static str = "unlimited";
}

/// Words of the variants of an enum, as typed.
pub(super) fn words<T: Deserialize<'static>>() -> &'static [&'static str] {
    T::deserialize(Probe).err().map_or(&[], |Told(words)| words)
}

/// Deserializer without content: returns the words that a type knows as its error.
struct Probe;

/// Words that a type knows; empty if it is not an enum.
#[derive(Debug)]
struct Told(&'static [&'static str]);

impl fmt::Display for Told {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "expected one of {:?}", self.0)
    }
}

impl std::error::Error for Told {}

impl serde::de::Error for Told {
    fn custom<M: fmt::Display>(_: M) -> Self {
        Self(&[])
    }
}

impl<'de> Deserializer<'de> for Probe {
    type Error = Told;

    fn deserialize_any<V: serde::de::Visitor<'de>>(self, _: V) -> Result<V::Value, Told> {
        Err(Told(&[]))
    }

    fn deserialize_enum<V: serde::de::Visitor<'de>>(
        self,
        _: &'static str,
        words: &'static [&'static str],
        _: V,
    ) -> Result<V::Value, Told> {
        Err(Told(words))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map struct identifier ignored_any
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_type_tells_its_words_as_serde_has_them() {
        #[derive(Deserialize)]
        #[serde(rename_all = "kebab-case")]
        enum Style {
            AsDrawn,
            #[serde(rename = "in/10")]
            Tenth,
        }
        assert_eq!(words::<Style>(), ["as-drawn", "in/10"]);
        assert!(words::<String>().is_empty() && words::<Option<bool>>().is_empty());
    }
}
