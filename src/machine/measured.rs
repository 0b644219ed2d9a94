//! Values with units, as in `feed_mm_s = "45 m/min"`, converted to plain numbers in the unit of their key.

use super::key::Key;
use crate::units::quantity::{self, NotQuantity};

/// Error of a text that is not a number in a unit of its key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Mismeasured {
    /// Unit of the key.
    unit: &'static str,
    /// Kind of quantity given instead, such as `a speed`; `None` without a known unit.
    pub(super) measures: Option<&'static str>,
}

impl Mismeasured {
    /// Suggested replacement; `None` if the key has no other units.
    pub(super) fn hint(&self) -> Option<String> {
        let (kind, examples) = quantity::kind(self.unit)?;
        Some(format!("it is {kind}: a plain number of {}, or a text such as {examples}", self.unit))
    }
}

/// Value with every text that is a number with a unit converted to a number in the unit of the key. Other texts stay: they may
/// be words of the key.
pub(super) fn plain(key: &Key, value: toml::Value) -> Result<toml::Value, Mismeasured> {
    match value {
        toml::Value::String(text) => text_of(key, 0, text),
        toml::Value::Array(items) => {
            let item = |(n, item): (usize, toml::Value)| match item {
                toml::Value::String(text) => text_of(key, n, text),
                other => Ok(other),
            };
            items.into_iter().enumerate().map(item).collect::<Result<_, _>>().map(toml::Value::Array)
        }
        other => Ok(other),
    }
}

fn text_of(key: &Key, n: usize, text: String) -> Result<toml::Value, Mismeasured> {
    let unit = key.unit_of(n);
    if quantity::kind(unit).is_none() {
        return Ok(toml::Value::String(text));
    }
    match quantity::value_in(&text, unit) {
        Ok(value) => Ok(toml::Value::Float(value)),
        Err(NotQuantity::NoQuantity) => Ok(toml::Value::String(text)),
        Err(NotQuantity::NoUnit) => Err(Mismeasured { unit, measures: None }),
        Err(NotQuantity::Measures(measures)) => Err(Mismeasured { unit, measures: Some(measures) }),
    }
}
