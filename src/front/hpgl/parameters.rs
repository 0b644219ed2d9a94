//! Numbers of parameters of instructions. One with more of them than it takes is another instruction with a changed letter,
//! mostly a line of the pen: the places of a whole outline would be lost.

use super::count::Count;
use super::instruction::Instruction;
use super::reader::Reader;
use crate::diagnostic::{Diagnostic, code};
use crate::source::Span;

/// Largest number of a pen: plotters have at most 256.
const MOST_PENS: f64 = 256.0;

/// An instruction that takes a limited number of parameters.
struct Row {
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
const ROWS: &[Row] = &[
    Row { mnemonic: b"AA", about: "an arc", most: 4 },
    Row { mnemonic: b"AC", about: "anchor of fills", most: 2 },
    Row { mnemonic: b"AD", about: "alternate font", most: 14 },
    Row { mnemonic: b"AF", about: "page feed", most: 1 },
    Row { mnemonic: b"AH", about: "page feed", most: 1 },
    Row { mnemonic: b"AP", about: "automatic pen", most: 1 },
    Row { mnemonic: b"AR", about: "an arc", most: 4 },
    Row { mnemonic: b"AS", about: "acceleration", most: 2 },
    Row { mnemonic: b"AT", about: "an arc", most: 6 },
    Row { mnemonic: b"CA", about: "alternate characters", most: 2 },
    Row { mnemonic: b"CF", about: "fill of characters", most: 2 },
    Row { mnemonic: b"CI", about: "a circle", most: 2 },
    Row { mnemonic: b"CM", about: "mode of characters", most: 2 },
    Row { mnemonic: b"CP", about: "a move by characters", most: 2 },
    Row { mnemonic: b"CR", about: "range of colours", most: 6 },
    Row { mnemonic: b"CS", about: "set of characters", most: 2 },
    Row { mnemonic: b"CT", about: "tolerance of chords", most: 1 },
    Row { mnemonic: b"CV", about: "curved lines", most: 2 },
    Row { mnemonic: b"DC", about: "digitising ends", most: 1 },
    Row { mnemonic: b"DI", about: "direction of texts", most: 2 },
    Row { mnemonic: b"DP", about: "digitising", most: 1 },
    Row { mnemonic: b"DR", about: "direction of texts", most: 2 },
    Row { mnemonic: b"DV", about: "direction of texts", most: 2 },
    Row { mnemonic: b"EA", about: "a rectangle", most: 2 },
    Row { mnemonic: b"EC", about: "the cutter", most: 1 },
    Row { mnemonic: b"EP", about: "a polygon is drawn", most: 1 },
    Row { mnemonic: b"ER", about: "a rectangle", most: 2 },
    Row { mnemonic: b"ES", about: "space of characters", most: 2 },
    Row { mnemonic: b"EW", about: "a wedge", most: 5 },
    Row { mnemonic: b"FI", about: "a font", most: 1 },
    Row { mnemonic: b"FN", about: "a font", most: 1 },
    Row { mnemonic: b"FP", about: "a filled polygon", most: 1 },
    Row { mnemonic: b"FR", about: "a frame of paper", most: 1 },
    Row { mnemonic: b"FS", about: "force", most: 2 },
    Row { mnemonic: b"FT", about: "a fill pattern", most: 3 },
    Row { mnemonic: b"GC", about: "a group", most: 1 },
    Row { mnemonic: b"GM", about: "memory", most: 5 },
    Row { mnemonic: b"IM", about: "masks of errors", most: 3 },
    Row { mnemonic: b"IP", about: "corners of the scale", most: 4 },
    Row { mnemonic: b"IR", about: "corners of the scale", most: 4 },
    Row { mnemonic: b"IW", about: "a window", most: 4 },
    Row { mnemonic: b"LA", about: "ends of lines", most: 6 },
    Row { mnemonic: b"LM", about: "mode of labels", most: 2 },
    Row { mnemonic: b"LO", about: "origin of labels", most: 1 },
    Row { mnemonic: b"LT", about: "line type", most: 3 },
    Row { mnemonic: b"MC", about: "merging of colours", most: 2 },
    Row { mnemonic: b"MT", about: "medium", most: 1 },
    Row { mnemonic: b"NP", about: "number of pens", most: 1 },
    Row { mnemonic: b"NR", about: "a pause", most: 1 },
    Row { mnemonic: b"OA", about: "a question", most: 0 },
    Row { mnemonic: b"OC", about: "a question", most: 0 },
    Row { mnemonic: b"OD", about: "a question", most: 0 },
    Row { mnemonic: b"OE", about: "a question", most: 0 },
    Row { mnemonic: b"OF", about: "a question", most: 0 },
    Row { mnemonic: b"OH", about: "a question", most: 0 },
    Row { mnemonic: b"OI", about: "a question", most: 0 },
    Row { mnemonic: b"OO", about: "a question", most: 0 },
    Row { mnemonic: b"OP", about: "a question", most: 0 },
    Row { mnemonic: b"OS", about: "a question", most: 0 },
    Row { mnemonic: b"OT", about: "a question", most: 0 },
    Row { mnemonic: b"OW", about: "a question", most: 0 },
    Row { mnemonic: b"PB", about: "a kept text is drawn", most: 0 },
    Row { mnemonic: b"PC", about: "colour of a pen", most: 4 },
    Row { mnemonic: b"PG", about: "end of a page", most: 1 },
    Row { mnemonic: b"PM", about: "a polygon", most: 1 },
    Row { mnemonic: b"PP", about: "placing of pixels", most: 1 },
    Row { mnemonic: b"PS", about: "size of the page", most: 2 },
    Row { mnemonic: b"PT", about: "thickness of a pen", most: 1 },
    Row { mnemonic: b"PW", about: "width of a pen", most: 2 },
    Row { mnemonic: b"QL", about: "quality", most: 1 },
    Row { mnemonic: b"RA", about: "a filled rectangle", most: 2 },
    Row { mnemonic: b"RO", about: "a turn", most: 1 },
    Row { mnemonic: b"RP", about: "copies", most: 1 },
    Row { mnemonic: b"RR", about: "a filled rectangle", most: 2 },
    Row { mnemonic: b"RT", about: "an arc", most: 6 },
    Row { mnemonic: b"SA", about: "alternate characters", most: 1 },
    Row { mnemonic: b"SB", about: "kind of font", most: 1 },
    Row { mnemonic: b"SC", about: "a scale", most: 7 },
    Row { mnemonic: b"SD", about: "standard font", most: 14 },
    Row { mnemonic: b"SI", about: "size of characters", most: 2 },
    Row { mnemonic: b"SL", about: "slant of characters", most: 1 },
    Row { mnemonic: b"SP", about: "a pen", most: 2 },
    Row { mnemonic: b"SR", about: "size of characters", most: 2 },
    Row { mnemonic: b"SS", about: "standard characters", most: 1 },
    Row { mnemonic: b"ST", about: "sorting", most: 1 },
    Row { mnemonic: b"SV", about: "screened lines", most: 3 },
    Row { mnemonic: b"TD", about: "mode of texts", most: 1 },
    Row { mnemonic: b"TL", about: "length of ticks", most: 2 },
    Row { mnemonic: b"TR", about: "transparency", most: 1 },
    Row { mnemonic: b"UL", about: "a line type", most: 21 },
    Row { mnemonic: b"VA", about: "speed", most: 1 },
    Row { mnemonic: b"VN", about: "speed", most: 1 },
    Row { mnemonic: b"VS", about: "speed", most: 2 },
    Row { mnemonic: b"WG", about: "a filled wedge", most: 5 },
    Row { mnemonic: b"WU", about: "unit of widths", most: 1 },
    Row { mnemonic: b"XT", about: "a tick", most: 0 },
    Row { mnemonic: b"YT", about: "a tick", most: 0 },
];

/// Instructions with more numbers than they take.
#[derive(Debug, Default)]
pub(super) struct Crowded {
    count: Count,
    first: Option<([u8; 2], usize)>,
}

impl Crowded {
    /// Counts the numbers that follow an instruction.
    pub(super) fn see(&mut self, (instruction, mnemonic): (Instruction, [u8; 2]), span: Span, reader: &Reader<'_>) {
        if matches!(instruction, Instruction::Up | Instruction::Down | Instruction::Absolute | Instruction::Relative) {
            return;
        }
        let Some(row) = ROWS.iter().find(|row| *row.mnemonic == mnemonic) else { return };
        let numbers = reader.numbers_ahead();
        let is_no_pen = || mnemonic == *b"PW" && reader.second_ahead().is_some_and(|pen| pen > MOST_PENS);
        if numbers > row.most || is_no_pen() {
            self.count.add(span);
            self.first.get_or_insert((mnemonic, numbers));
        }
    }

    /// The finding on them.
    pub(super) fn finding(&self) -> Option<Diagnostic> {
        let (mnemonic, numbers) = self.first?;
        let row = ROWS.iter().find(|row| *row.mnemonic == mnemonic)?;
        let (name, times) = (String::from_utf8_lossy(&mnemonic).into_owned(), self.count.times());
        let message = if numbers > row.most {
            let most = if row.most == 0 { "none".to_owned() } else { format!("at most {}", row.most) };
            format!("{name} ({}) takes {most}, not {numbers}; this happens {times}", row.about)
        } else {
            format!("{name} ({}) names a pen that no plotter has; this happens {times}", row.about)
        };
        let alike = match mnemonic {
            [b'P', _] => "PD, PU or PA",
            [_, b'D'] => "PD",
            [_, b'U'] => "PU",
            [_, b'A'] => "PA",
            [_, b'R'] => "PR",
            _ => "",
        };
        let finding = self.count.diagnostic(&code::HPGL_NUMBERS, message);
        Some(if alike.is_empty() {
            finding.hint("a character before the numbers may be lost; transfer the file again")
        } else {
            finding.hint(format!("a letter may be changed: most likely it was {alike}; transfer the file again"))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::front::hpgl::instruction::instruction;

    #[test]
    fn rows_are_in_order_and_of_known_instructions() {
        assert!(ROWS.is_sorted_by_key(|row| row.mnemonic));
        for row in ROWS {
            assert_ne!(instruction(*row.mnemonic), Instruction::Unknown, "{}", row.about);
        }
    }
}
