//! Texts: what a set of patterns and its pieces say of themselves, as `KEY: value`.

use super::entity::{Entity, NAME, TEXT};
use crate::source::{Source, Span};

/// What the texts of a block, or of the file, say. The first text of a key holds.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Facts {
    /// The size that a block is of.
    pub(super) size: Option<Span>,
    /// The size that the set was drawn in.
    pub(super) sample_size: Option<Span>,
    /// Another one that it was drawn in: then nobody knows which is meant.
    pub(super) other_sample: Option<Span>,
    /// Unit of all numbers.
    pub(super) units: Option<Span>,
    /// How often a piece is cut: as it is drawn, and mirrored.
    pub(super) quantity: Option<Span>,
}

/// Whether an entity is a text.
pub(super) fn is_text(entity: &Entity) -> bool {
    ["TEXT", "ATTDEF", "ATTRIB", "MTEXT"].iter().any(|kind| entity.is(kind))
}

impl Facts {
    /// What texts say.
    pub(super) fn of<'a>(entities: impl IntoIterator<Item = &'a Entity<'a>>, source: &Source) -> Self {
        let mut facts = Self::default();
        for entity in entities.into_iter().filter(|entity| is_text(entity)) {
            let Some((key, value)) = said(entity, source) else { continue };
            let fact = match key.as_str() {
                "SIZE" => &mut facts.size,
                "SAMPLE SIZE" => &mut facts.sample_size,
                "UNITS" | "UNIT" => &mut facts.units,
                "QUANTITY" => &mut facts.quantity,
                _ => continue,
            };
            let first = *fact.get_or_insert(value);
            if key == "SAMPLE SIZE" {
                facts.see_sample(first, value, source);
            }
        }
        facts
    }

    /// Notes a sample size that is not the first.
    fn see_sample(&mut self, first: Span, next: Span, source: &Source) {
        if !source.slice(first).eq_ignore_ascii_case(source.slice(next)) {
            self.other_sample.get_or_insert(next);
        }
    }

    /// These, and where they say nothing those.
    pub(super) fn or(mut self, other: Self, source: &Source) -> Self {
        if let (Some(first), Some(next)) = (self.sample_size, other.sample_size) {
            self.see_sample(first, next, source);
        }
        Self {
            other_sample: self.other_sample.or(other.other_sample),
            size: self.size.or(other.size),
            sample_size: self.sample_size.or(other.sample_size),
            units: self.units.or(other.units),
            quantity: self.quantity.or(other.quantity),
        }
    }
}

/// The key of a text, in capitals with one blank between its words, and the bytes of its value; of an attribute without
/// a colon its tag is the key.
fn said(entity: &Entity, source: &Source) -> Option<(String, Span)> {
    let span = entity.value(TEXT)?;
    let text = source.slice(span);
    let Some(colon) = memchr::memchr(b':', text) else {
        let tag = entity.bytes(NAME);
        return (!entity.is("TEXT") && !tag.is_empty()).then(|| (key(tag), span));
    };
    let blanks = text[colon + 1..].len() - text[colon + 1..].trim_ascii_start().len();
    let start = span.start + (colon + 1 + blanks) as u32;
    (start < span.end).then(|| (key(&text[..colon]), Span { start, ..span }))
}

/// A key however it is written.
fn key(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes).to_uppercase();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
