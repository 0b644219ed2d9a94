//! Numbers of parameters of instructions. One with more of them than it takes is another instruction with a changed letter,
//! mostly a line of the pen: the places of a whole outline would be lost.

use super::count::Count;
use super::plotter::MOST_PENS;
use super::reader::Reader;
use crate::diagnostic::{Diagnostic, code};
use crate::source::Span;

/// An instruction that takes a limited number of parameters.
#[derive(Debug)]
struct Arity {
    mnemonic: &'static [u8; 2],
    /// Its meaning, in a word.
    about: &'static str,
    /// Greatest number of its parameters.
    most: usize,
}

/// The instructions with a limited number of parameters, in alphabetical order. (Hewlett-Packard, "HP-GL/2 and HP RTL Reference
/// Guide" and "HP 7550A Interfacing and Programming Manual".) Where the two differ, the greater number stands. Lists without a
/// limit have no row, such as those of PU, PE, UC and RF.
#[rustfmt::skip] // a table: one row per line
const ROWS: &[Arity] = &[
    Arity { mnemonic: b"AA", about: "an arc", most: 4 },
    Arity { mnemonic: b"AC", about: "anchor of fills", most: 2 },
    Arity { mnemonic: b"AD", about: "alternate font", most: 14 },
    Arity { mnemonic: b"AF", about: "page feed", most: 1 },
    Arity { mnemonic: b"AH", about: "page feed", most: 1 },
    Arity { mnemonic: b"AP", about: "automatic pen", most: 1 },
    Arity { mnemonic: b"AR", about: "an arc", most: 4 },
    Arity { mnemonic: b"AS", about: "acceleration", most: 2 },
    Arity { mnemonic: b"AT", about: "an arc", most: 6 },
    Arity { mnemonic: b"CA", about: "alternate characters", most: 2 },
    Arity { mnemonic: b"CF", about: "fill of characters", most: 2 },
    Arity { mnemonic: b"CI", about: "a circle", most: 2 },
    Arity { mnemonic: b"CM", about: "mode of characters", most: 2 },
    Arity { mnemonic: b"CP", about: "a move by characters", most: 2 },
    Arity { mnemonic: b"CR", about: "range of colours", most: 6 },
    Arity { mnemonic: b"CS", about: "set of characters", most: 2 },
    Arity { mnemonic: b"CT", about: "tolerance of chords", most: 1 },
    Arity { mnemonic: b"CV", about: "curved lines", most: 2 },
    Arity { mnemonic: b"DC", about: "digitising ends", most: 1 },
    Arity { mnemonic: b"DI", about: "direction of texts", most: 2 },
    Arity { mnemonic: b"DP", about: "digitising", most: 1 },
    Arity { mnemonic: b"DR", about: "direction of texts", most: 2 },
    Arity { mnemonic: b"DV", about: "direction of texts", most: 2 },
    Arity { mnemonic: b"EA", about: "a rectangle", most: 2 },
    Arity { mnemonic: b"EC", about: "the cutter", most: 1 },
    Arity { mnemonic: b"EP", about: "a polygon is drawn", most: 1 },
    Arity { mnemonic: b"ER", about: "a rectangle", most: 2 },
    Arity { mnemonic: b"ES", about: "space of characters", most: 2 },
    Arity { mnemonic: b"EW", about: "a wedge", most: 5 },
    Arity { mnemonic: b"FI", about: "a font", most: 1 },
    Arity { mnemonic: b"FN", about: "a font", most: 1 },
    Arity { mnemonic: b"FP", about: "a filled polygon", most: 1 },
    Arity { mnemonic: b"FR", about: "a frame of paper", most: 1 },
    Arity { mnemonic: b"FS", about: "force", most: 2 },
    Arity { mnemonic: b"FT", about: "a fill pattern", most: 3 },
    Arity { mnemonic: b"GC", about: "a group", most: 1 },
    Arity { mnemonic: b"GM", about: "memory", most: 5 },
    Arity { mnemonic: b"IM", about: "masks of errors", most: 3 },
    Arity { mnemonic: b"IP", about: "corners of the scale", most: 4 },
    Arity { mnemonic: b"IR", about: "corners of the scale", most: 4 },
    Arity { mnemonic: b"IW", about: "a window", most: 4 },
    Arity { mnemonic: b"LA", about: "ends of lines", most: 6 },
    Arity { mnemonic: b"LM", about: "mode of labels", most: 2 },
    Arity { mnemonic: b"LO", about: "origin of labels", most: 1 },
    Arity { mnemonic: b"LT", about: "line type", most: 3 },
    Arity { mnemonic: b"MC", about: "merging of colours", most: 2 },
    Arity { mnemonic: b"MT", about: "medium", most: 1 },
    Arity { mnemonic: b"NP", about: "number of pens", most: 1 },
    Arity { mnemonic: b"NR", about: "a pause", most: 1 },
    Arity { mnemonic: b"OA", about: "a question", most: 0 },
    Arity { mnemonic: b"OC", about: "a question", most: 0 },
    Arity { mnemonic: b"OD", about: "a question", most: 0 },
    Arity { mnemonic: b"OE", about: "a question", most: 0 },
    Arity { mnemonic: b"OF", about: "a question", most: 0 },
    Arity { mnemonic: b"OH", about: "a question", most: 0 },
    Arity { mnemonic: b"OI", about: "a question", most: 0 },
    Arity { mnemonic: b"OO", about: "a question", most: 0 },
    Arity { mnemonic: b"OP", about: "a question", most: 0 },
    Arity { mnemonic: b"OS", about: "a question", most: 0 },
    Arity { mnemonic: b"OT", about: "a question", most: 0 },
    Arity { mnemonic: b"OW", about: "a question", most: 0 },
    Arity { mnemonic: b"PB", about: "a kept text is drawn", most: 0 },
    Arity { mnemonic: b"PC", about: "colour of a pen", most: 4 },
    Arity { mnemonic: b"PG", about: "end of a page", most: 1 },
    Arity { mnemonic: b"PM", about: "a polygon", most: 1 },
    Arity { mnemonic: b"PP", about: "placing of pixels", most: 1 },
    Arity { mnemonic: b"PS", about: "size of the page", most: 2 },
    Arity { mnemonic: b"PT", about: "thickness of a pen", most: 1 },
    Arity { mnemonic: b"PW", about: "width of a pen", most: 2 },
    Arity { mnemonic: b"QL", about: "quality", most: 1 },
    Arity { mnemonic: b"RA", about: "a filled rectangle", most: 2 },
    Arity { mnemonic: b"RO", about: "a turn", most: 1 },
    Arity { mnemonic: b"RP", about: "copies", most: 1 },
    Arity { mnemonic: b"RR", about: "a filled rectangle", most: 2 },
    Arity { mnemonic: b"RT", about: "an arc", most: 6 },
    Arity { mnemonic: b"SA", about: "alternate characters", most: 1 },
    Arity { mnemonic: b"SB", about: "kind of font", most: 1 },
    Arity { mnemonic: b"SC", about: "a scale", most: 7 },
    Arity { mnemonic: b"SD", about: "standard font", most: 14 },
    Arity { mnemonic: b"SI", about: "size of characters", most: 2 },
    Arity { mnemonic: b"SL", about: "slant of characters", most: 1 },
    Arity { mnemonic: b"SP", about: "a pen", most: 2 },
    Arity { mnemonic: b"SR", about: "size of characters", most: 2 },
    Arity { mnemonic: b"SS", about: "standard characters", most: 1 },
    Arity { mnemonic: b"ST", about: "sorting", most: 1 },
    Arity { mnemonic: b"SV", about: "screened lines", most: 3 },
    Arity { mnemonic: b"TD", about: "mode of texts", most: 1 },
    Arity { mnemonic: b"TL", about: "length of ticks", most: 2 },
    Arity { mnemonic: b"TR", about: "transparency", most: 1 },
    Arity { mnemonic: b"UL", about: "a line type", most: 21 },
    Arity { mnemonic: b"VA", about: "speed", most: 1 },
    Arity { mnemonic: b"VN", about: "speed", most: 1 },
    Arity { mnemonic: b"VS", about: "speed", most: 2 },
    Arity { mnemonic: b"WG", about: "a filled wedge", most: 5 },
    Arity { mnemonic: b"WU", about: "unit of widths", most: 1 },
    Arity { mnemonic: b"XT", about: "a tick", most: 0 },
    Arity { mnemonic: b"YT", about: "a tick", most: 0 },
];

/// Place of an instruction.
#[derive(Debug, Clone, Copy)]
pub(super) struct Amid {
    /// True amid a stroke that the pen draws.
    pub(super) stroke: bool,
    /// True on a page on which something was drawn.
    pub(super) page: bool,
}

/// Instructions with more numbers than they take, with those of a place, or with a pen that no plotter has.
#[derive(Debug, Default)]
pub(super) struct Surplus {
    count: Count,
    first: Option<(&'static Arity, usize)>,
    pens: Count,
    /// Instructions with pairs of numbers that they cannot have.
    places: Count,
    first_place: Option<&'static Arity>,
    /// True behind a CR, which gives colours a range of their own.
    has_range: bool,
}

impl Surplus {
    /// Counts the numbers that follow an instruction.
    pub(super) fn see(&mut self, mnemonic: [u8; 2], span: Span, amid: Amid, reader: &Reader<'_>) {
        if let [b'P', b'U' | b'D' | b'A' | b'R'] = mnemonic {
            return; // nearly all: moves, without a limit
        }
        self.has_range |= mnemonic == *b"CR";
        let Ok(row) = ROWS.binary_search_by(|row| row.mnemonic.cmp(&mnemonic)) else { return };
        let arity = &ROWS[row];
        let numbers = reader.numbers_ahead();
        if numbers > arity.most {
            self.count.add(span);
            self.first.get_or_insert((arity, numbers));
        } else if mnemonic == *b"PW" && reader.second_ahead().is_some_and(|pen| pen > MOST_PENS) {
            self.pens.add(span);
        } else if numbers > 0
            && numbers.is_multiple_of(2)
            && !(mnemonic == *b"PC" && self.has_range)
            && arity.may_be_place(amid, reader)
        {
            self.places.add(span);
            self.first_place.get_or_insert(arity);
        }
    }

    /// The findings on them.
    pub(super) fn findings(&self) -> impl Iterator<Item = Diagnostic> {
        let surplus = self.first.map(|(arity, numbers)| {
            let follow = if numbers == 1 { "number follows" } else { "numbers follow" };
            let most = if arity.most == 0 { "none".to_owned() } else { format!("at most {}", arity.most) };
            let (name, times) = (arity.name(), self.count.times());
            let message = format!("{numbers} {follow} {name}, which takes {most}; this happens {times}");
            arity.hint(self.count.diagnostic(&code::HPGL_NUMBERS, message))
        });
        let width = ROWS.iter().find(|row| row.mnemonic == b"PW").filter(|_| self.pens.count > 0);
        let pens = width.map(|arity| {
            let message = format!("PW names a pen that no plotter has; this happens {}", self.pens.times());
            arity.hint(self.pens.diagnostic(&code::HPGL_NUMBERS, message))
        });
        let places = self.first_place.map(|arity| {
            let message = format!(
                "{} has numbers that only a place can have; this happens {}",
                arity.name(),
                self.places.times()
            );
            arity.hint(self.places.diagnostic(&code::HPGL_NUMBERS, message))
        });
        surplus.into_iter().chain(pens).chain(places)
    }
}

/// Greatest number of a kind of lines (LA), of a kind of letters (AD, SD), of a set of letters (CA), of a part of a colour (PC)
/// and of a size in per cent (SR). (The same references.)
const MOST_KINDS_OF_LINES: f64 = 3.0;
const MOST_KINDS_OF_LETTERS: f64 = 9.0;
const MOST_SETS: f64 = 99.0;
const MOST_COLOURS: f64 = 255.0;
const MOST_PERCENT: f64 = 1000.0;
/// Number of numbers of CR: a range for each of three colours.
const NUMBERS_OF_COLOURS: usize = 6;

impl Arity {
    /// True if its pairs of numbers can only be places: it is a move with a changed letter.
    fn may_be_place(&self, amid: Amid, reader: &Reader<'_>) -> bool {
        let numbers = &reader.first_ahead();
        let is_within = || amid.stroke && reader.is_led_on();
        let is_beyond = |most: f64| numbers.iter().any(|number| number.abs() > most);
        let has_kind_beyond = |most: f64| numbers.iter().step_by(2).any(|kind| !(0.0..=most).contains(kind));
        match self.mnemonic {
            b"AD" | b"SD" => has_kind_beyond(MOST_KINDS_OF_LETTERS),
            b"LA" => has_kind_beyond(MOST_KINDS_OF_LINES),
            b"CA" => has_kind_beyond(MOST_SETS),
            b"CR" => numbers.len() != NUMBERS_OF_COLOURS,
            b"PC" => is_within() || is_beyond(MOST_COLOURS),
            b"SR" => is_within() || is_beyond(MOST_PERCENT),
            b"PS" => amid.page,
            b"DR" | b"EA" | b"ER" => is_within(),
            _ => false,
        }
    }

    fn name(&self) -> String {
        String::from_utf8_lossy(self.mnemonic).into_owned()
    }

    /// A finding with the hint that names the moves with a mnemonic like this one.
    fn hint(&self, finding: Diagnostic) -> Diagnostic {
        let alike = match self.mnemonic {
            [b'P', _] => "PD, PU or PA",
            [_, b'D'] => "PD",
            [_, b'U'] => "PU",
            [_, b'A'] => "PA",
            [_, b'R'] => "PR",
            _ => return finding.hint("a character before the numbers may be lost; transfer the file again"),
        };
        let (name, about) = (self.name(), self.about);
        finding.hint(format!("{name} ({about}) may be {alike} with a changed letter; transfer it again"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::front::hpgl::instruction::{Instruction, instruction};

    #[test]
    fn rows_are_in_order_and_of_known_instructions() {
        assert!(ROWS.is_sorted_by_key(|row| row.mnemonic));
        for row in ROWS {
            assert_ne!(instruction(*row.mnemonic), Instruction::Unknown, "{}", row.about);
        }
    }
}
