//! Values that are something or a word: `"off"`, `"auto"`, `"unlimited"` stand for "no value" in the profile.

use std::marker::PhantomData;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A word that stands for "no value".
pub(super) trait Word {
    /// The word as it is typed.
    const WORD: &'static str;
}

/// For `#[serde(with = "OrWord::<Off>")]` on an `Option`: the value, or the word.
pub(super) struct OrWord<W>(PhantomData<W>);

/// What TOML may hold where a word is allowed.
#[derive(Deserialize)]
#[serde(untagged)]
enum Typed<T> {
    Value(T),
    Word(String),
}

impl<W: Word> OrWord<W> {
    /// `None` for the word; any other word is an error.
    pub(super) fn deserialize<'de, D: Deserializer<'de>, T: Deserialize<'de>>(input: D) -> Result<Option<T>, D::Error> {
        let expected = || serde::de::Error::custom(format!("expected a value or \"{}\"", W::WORD));
        match Typed::<T>::deserialize(input).map_err(|_| expected())? {
            Typed::Value(value) => Ok(Some(value)),
            Typed::Word(text) if text == W::WORD => Ok(None),
            Typed::Word(_) => Err(expected()),
        }
    }

    /// The word for `None`.
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
/// `"as-drawn"`: what the file says.
pub(super) struct AsDrawn;
/// `"auto"`: found from other values.
pub(super) struct Auto;
/// `"stay"`: no move.
pub(super) struct Stay;
/// `"unbounded"`: an axis without ends.
pub(super) struct Unbounded;
/// `"same"`: what holds otherwise.
pub(super) struct Same;
/// `"unlimited"`: a table without edges.
pub(super) struct Unlimited;

impl Word for AsDrawn {
    const WORD: &'static str = "as-drawn";
}

impl Word for Off {
    const WORD: &'static str = "off";
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
