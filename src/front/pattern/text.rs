//! Texts: facts about a pattern set and its pieces, written as `KEY: value`.

use std::ops::Range;

use super::key::{Key, key};
use super::markup;
use super::quantity::quantity;
use crate::front::dxf::entity::{Entity, NAME, TEXT};
use crate::machine::letters::Letters;
use crate::source::{Source, Span};

/// Code of all parts except the last of a text of more than 250 bytes.
const PART: i32 = 3;
/// The full-width colon of ideographic texts: in UTF-8, in GBK and EUC-KR, in Big5, and in Shift-JIS.
const WIDE_COLONS: [&[u8]; 4] = ["：".as_bytes(), b"\xa3\xba", b"\xa1\x47", b"\x81\x46"];
/// Words that indicate a fact in a text.
const FACTS: [&str; 4] = ["SIZE", "UNIT", "QUANTITY", "QTY"];

/// Facts from the texts of a block or of the file.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Facts {
    /// Size of the block.
    pub(super) size: Said,
    /// Sample size: the size in which the set was drawn.
    pub(super) sample_size: Said,
    /// Unit of all numbers.
    pub(super) units: Said,
    /// Quantity of a piece: as drawn, and mirrored.
    pub(super) quantity: Said,
    /// Name of a piece, the same for all its sizes.
    pub(super) name: Said,
    /// The CAD system that wrote the file.
    pub(super) author: Said,
    /// A text that gives one of these facts but is unreadable: it has several parts, or formatting codes inside.
    pub(super) unread: Option<Span>,
}

/// Values under one key.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Said {
    /// The first value.
    pub(super) first: Option<Span>,
    /// The first value of another meaning, which makes the fact ambiguous.
    pub(super) other: Option<Span>,
}

impl Said {
    /// Adds the value of the next text under the same key. `is_same` compares values.
    fn and(self, next: Option<Span>, is_same: &impl Fn(Span, Span) -> bool) -> Self {
        let (Some(first), Some(next)) = (self.first, next) else {
            return Self { first: self.first.or(next), ..self };
        };
        Self { other: self.other.or(if is_same(first, next) { None } else { Some(next) }), ..self }
    }

    /// Adds the values of a second source after those of the first.
    fn and_all(self, those: Self, is_same: &impl Fn(Span, Span) -> bool) -> Self {
        self.and(those.first, is_same).and(those.other, is_same)
    }
}

/// Comparison of the values of texts.
#[derive(Clone, Copy)]
struct Values<'a> {
    source: &'a Source,
    letters: &'a Letters,
}

impl Values<'_> {
    /// True if two values are the same text.
    fn are_same(self, one: Span, other: Span) -> bool {
        self.source.slice(one).eq_ignore_ascii_case(self.source.slice(other))
    }

    /// True if two quantities ask for the same pieces, as `2` and `2 ON FOLD` do.
    fn are_same_quantity(self, one: Span, other: Span) -> bool {
        let times = |span| Some(quantity(&self.letters.text(self.source.slice(span)))?.times);
        self.are_same(one, other) || times(one).is_some_and(|one| times(other) == Some(one))
    }
}

/// True if an entity is a text.
pub(super) fn is_text(entity: &Entity) -> bool {
    ["TEXT", "ATTDEF", "ATTRIB", "MTEXT"].iter().any(|kind| entity.is(kind))
}

impl Facts {
    /// Facts from the texts among entities.
    pub(super) fn of<'e, 'a: 'e>(
        entities: impl IntoIterator<Item = &'e Entity<'a>>,
        source: &'a Source,
        letters: &Letters,
    ) -> Self {
        let values = Values { source, letters };
        let mut facts = Self::default();
        for entity in entities.into_iter().filter(|entity| is_text(entity)) {
            facts.unread = facts.unread.or(long(entity, source));
            for Fact { key, value, .. } in said(entity, source, letters) {
                let fact = match key {
                    Key::Size => &mut facts.size,
                    Key::SampleSize => &mut facts.sample_size,
                    Key::Units => &mut facts.units,
                    Key::Quantity => &mut facts.quantity,
                    Key::PieceName => &mut facts.name,
                    Key::Author => &mut facts.author,
                };
                if entity.is("MTEXT") && markup::has_codes(source.slice(value)) {
                    facts.unread = facts.unread.or(Some(value));
                }
                *fact = match key {
                    Key::Quantity => fact.and(Some(value), &|one, other| values.are_same_quantity(one, other)),
                    _ => fact.and(Some(value), &|one, other| values.are_same(one, other)),
                };
            }
        }
        facts
    }

    /// True if any fact of the convention is given.
    pub(super) fn says_anything(&self) -> bool {
        let all = [self.size, self.sample_size, self.units, self.quantity, self.name];
        all.iter().any(|said| said.first.is_some())
    }

    /// Adds the facts of a second source after those of the first.
    pub(super) fn and(self, those: Self, source: &Source, letters: &Letters) -> Self {
        let values = Values { source, letters };
        let is_same = |one, other| values.are_same(one, other);
        let is_same_quantity = |one, other| values.are_same_quantity(one, other);
        Self {
            size: self.size.and_all(those.size, &is_same),
            sample_size: self.sample_size.and_all(those.sample_size, &is_same),
            units: self.units.and_all(those.units, &is_same),
            quantity: self.quantity.and_all(those.quantity, &is_same_quantity),
            name: self.name.and_all(those.name, &is_same),
            author: self.author.and_all(those.author, &is_same),
            unread: self.unread.or(those.unread),
        }
    }

    /// Replaces size and quantity by those from the attributes of insertions, if these give them.
    pub(super) fn under_attributes(self, attributes: &Self) -> Self {
        let before = |told: Said, own: Said| if told.first.is_some() { told } else { own };
        let (size, quantity) = (before(attributes.size, self.size), before(attributes.quantity, self.quantity));
        Self { size, quantity, ..self }
    }
}

/// The first part of a text of several parts, as DXF has for more than 250 bytes, if it may give a fact.
fn long(entity: &Entity, source: &Source) -> Option<Span> {
    let parts = || entity.groups().iter().filter(|group| group.code == PART || group.code == TEXT);
    let says = |part: &[u8]| {
        let part = part.to_ascii_uppercase();
        FACTS.iter().any(|fact| memchr::memmem::find(&part, fact.as_bytes()).is_some())
    };
    let is_long = entity.is("MTEXT") && entity.value(PART).is_some();
    entity.value(PART).filter(|_| is_long && parts().any(|part| says(source.slice(part.value))))
}

/// The non-ASCII keys of the facts in a text, decoded with an encoding.
pub(super) fn keys(entity: &Entity, source: &Source, letters: &Letters) -> Vec<Key> {
    let said = said(entity, source, letters);
    said.into_iter().filter(|said| !said.name.is_ascii()).map(|said| said.key).collect()
}

/// True if a text has undecodable bytes before a colon, or before a number that follows a blank or `=`.
pub(super) fn has_unread_key(entity: &Entity, letters: &Letters) -> bool {
    let line = entity.bytes(TEXT);
    let number = || (1..line.len()).find(|&at| line[at].is_ascii_digit() && matches!(line[at - 1], b' ' | b'='));
    let end = memchr::memchr(b':', line).or_else(number);
    end.is_some_and(|end| letters.text(&line[..end]).contains(char::REPLACEMENT_CHARACTER))
}

/// A fact from a text.
struct Fact<'a> {
    key: Key,
    /// The key, as written.
    name: &'a [u8],
    value: Span,
}

/// Facts in the lines of a text.
fn said<'a>(entity: &Entity<'a>, source: &'a Source, letters: &Letters) -> Vec<Fact<'a>> {
    if !is_text(entity) {
        return Vec::new();
    }
    let known = |(name, value)| Some(Fact { key: key(&letters.text(name))?, name, value });
    pairs(entity, source, letters).into_iter().filter_map(known).collect()
}

/// Names and values in the lines of a text, known or not. The name of an attribute without a colon is its tag.
pub(super) fn pairs<'a>(entity: &Entity<'a>, source: &'a Source, letters: &Letters) -> Vec<(&'a [u8], Span)> {
    let Some(span) = entity.value(TEXT) else { return Vec::new() };
    let part = |range: Range<usize>| {
        let [start, end] = [range.start, range.end].map(|at| span.start + at as u32);
        Span { start, end, ..span }
    };
    let lines: Vec<Span> =
        if entity.is("MTEXT") { markup::lines(source.slice(span)).map(part).collect() } else { vec![span] };
    let line = |line: Span| {
        let text = source.slice(line);
        let Some((name, behind)) = split(text, letters) else {
            let tag = entity.bytes(NAME);
            return (!entity.is("TEXT") && !tag.is_empty()).then_some((tag, line));
        };
        let value = &text[behind..];
        let blanks =
            if entity.is("MTEXT") { markup::codes_before(value) } else { value.len() - value.trim_ascii_start().len() };
        Some((name, Span { start: line.start + (behind + blanks) as u32, ..line }))
    };
    lines.into_iter().filter_map(line).filter(|(_, value)| value.start < value.end).collect()
}

/// The name before the colon of a line, and the offset of the value after it. A full-width colon only counts after a known key,
/// and a number after a quantity key needs no colon.
fn split<'a>(line: &'a [u8], letters: &Letters) -> Option<(&'a [u8], usize)> {
    let is_key = |name: &[u8]| key(&letters.text(name)).is_some();
    let wide = WIDE_COLONS.iter().find_map(|colon| {
        let at = memchr::memmem::find_iter(line, colon).find(|&at| is_key(&line[..at]))?;
        Some((&line[..at], at + colon.len()))
    });
    let colon = || memchr::memchr(b':', line).map(|at| (&line[..at], at + 1));
    wide.or_else(colon).or_else(|| counted(line, letters)).or_else(|| sized(line, letters))
}

/// The name of a size before `=`, or before a single word that begins with a digit, and the offset of the size.
fn sized<'a>(line: &'a [u8], letters: &Letters) -> Option<(&'a [u8], usize)> {
    let (end, from) = if let Some(sign) = memchr::memchr(b'=', line) {
        (sign, sign + 1)
    } else {
        let last = line.trim_ascii_end().iter().rposition(u8::is_ascii_whitespace)?;
        (last, line.get(last + 1).filter(|byte| byte.is_ascii_digit()).map(|_| last + 1)?)
    };
    let name = line[..end].trim_ascii_end();
    let name = name.strip_suffix(b"-").map_or(name, <[u8]>::trim_ascii_end);
    let at = from + line[from..].iter().position(|byte| !byte.is_ascii_whitespace())?;
    matches!(key(&letters.text(name)), Some(Key::Size | Key::SampleSize)).then_some((name, at))
}

/// The name of a quantity before a number after a blank or `=`, with an optional `=` or `-` between, and the offset of the
/// number.
fn counted<'a>(line: &'a [u8], letters: &Letters) -> Option<(&'a [u8], usize)> {
    let is_start = |at: &usize| line[*at].is_ascii_digit() && matches!(line[at - 1], b' ' | b'=');
    let at = (1..line.len()).find(is_start)?;
    let before = line[..at].trim_ascii_end();
    let is_sign = |byte: &u8| matches!(byte, b'=' | b'-');
    let name = before.split_last().filter(|(last, _)| is_sign(last)).map_or(before, |(_, name)| name).trim_ascii_end();
    (key(&letters.text(name)) == Some(Key::Quantity)).then_some((name, at))
}
