//! What the codes mean: the table of the family, as its vendors and the files of real machines agree on it.

use super::syntax::Code;
use crate::machine::FileUnit;

/// What a code asks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Meaning {
    /// Knife down.
    Down,
    /// Knife up.
    Up,
    /// A piece begins; its number.
    Piece,
    /// The unit of all numbers.
    Unit(FileUnit),
    /// A hole, with this drill.
    Drill(u8),
    /// The next block is a message to the operator.
    Message,
    /// The next text block is a label.
    Label,
    /// With the knife down a slit begins; with the knife up neither full advance nor overcut.
    Slit,
    /// The next plunge goes without heel overlap.
    FullAdvance,
    /// The next lift goes without front overlap.
    NoOvercut,
    /// The knife is lifted at the next corner.
    CornerLift,
    /// End of the file, unless cuts follow.
    End,
    /// The coordinates of the block are a place to park or a size, not a move.
    Park,
    /// Length of a bite of the conveyor, along X.
    BiteSize,
    /// An arc, clockwise or not.
    Arc,
    /// Known, changes the cut, and is not obeyed; its name in words.
    NotObeyed(&'static str),
    /// Known, and of no consequence for the cut.
    Housekeeping,
    /// Not known.
    Unknown,
}

/// The meaning of a code.
pub(super) fn meaning(code: Code) -> Meaning {
    let number = match code.number {
        None => None,
        Some(number) if number >= 0.0 && number.fract() == 0.0 => Some(number as u32),
        Some(_) => return Meaning::Unknown,
    };
    match (code.letter, number) {
        (b'M', Some(number)) => m_code(number),
        (b'A', None) => Meaning::Up,
        (b'B', None) => Meaning::Down,
        (b'N', _) => Meaning::Piece,
        (b'G', Some(91)) => Meaning::Unit(FileUnit::HundredthInch),
        (b'G', Some(70)) => Meaning::Unit(FileUnit::ThousandthInch),
        (b'G', Some(71)) => Meaning::Unit(FileUnit::TenthMm),
        (b'G', Some(2 | 3)) => Meaning::Arc,
        (b'G', Some(1 | 4 | 90)) | (b'H', _) | (b'D', Some(1 | 2 | 4)) | (b'O', None) => Meaning::Housekeeping,
        (b'Q', None) => Meaning::Park,
        (b'R', None) => Meaning::Drill(1),
        (b'E', None) => Meaning::NotObeyed("flick notch"),
        (b'L', None) => Meaning::NotObeyed("slow"),
        (b'F', _) => Meaning::NotObeyed("feed"),
        (b'Z', _) => Meaning::BiteSize,
        _ => Meaning::Unknown,
    }
}

fn m_code(number: u32) -> Meaning {
    match number {
        0 => Meaning::End,
        1 => Meaning::NotObeyed("optional stop"),
        14 => Meaning::Down,
        15 => Meaning::Up,
        17 => Meaning::FullAdvance,
        18 => Meaning::NoOvercut,
        19 => Meaning::Slit,
        20 => Meaning::Message,
        23 => Meaning::NotObeyed("edge clip"),
        25 => Meaning::NotObeyed("slow"),
        31 => Meaning::Label,
        43 => Meaning::Drill(1),
        44 => Meaning::Drill(2),
        45 | 72 => Meaning::Drill(3),
        73 => Meaning::Drill(4),
        46 => Meaning::CornerLift,
        60..=67 => Meaning::NotObeyed("speed of the piece"),
        68 => Meaning::NotObeyed("flick notch"),
        69 => Meaning::NotObeyed("conveyor bite"),
        // Normal speed, rewind, sharpening, knife intelligence, origin.
        26 | 30 | 40..=42 | 47 | 48 | 51 | 70 => Meaning::Housekeeping,
        _ => Meaning::Unknown,
    }
}

/// The code without its number where that is a value and not a part of the name.
pub(super) fn kind(code: Code) -> Code {
    let number = if matches!(code.letter, b'F' | b'H' | b'N' | b'Z') { None } else { code.number };
    Code { number, ..code }
}

/// The code as the profile and messages name it: without leading zeros.
pub(super) fn name(code: Code) -> String {
    match kind(code).number {
        None => char::from(code.letter).to_string(),
        Some(number) => format!("{}{number}", char::from(code.letter)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_mean_the_same_with_leading_zeros_and_in_both_spellings() {
        let of = |letter, number| meaning(Code { letter, number });
        assert_eq!(of(b'M', Some(14.0)), of(b'B', None));
        assert_eq!(of(b'M', Some(15.0)), of(b'A', None));
        assert_eq!(of(b'M', Some(43.0)), of(b'R', None));
        assert_eq!(of(b'M', Some(45.0)), of(b'M', Some(72.0)));
        assert_eq!(of(b'M', Some(14.5)), Meaning::Unknown);
        assert_eq!(name(Code { letter: b'M', number: Some(0.0) }), "M0");
        assert_eq!(name(Code { letter: b'F', number: Some(12.0) }), "F");
    }
}
