//! Meanings of the codes: the table of the family, as agreed by its vendors and the files of real machines.

use super::arc::Turn;
use super::syntax::Code;
use crate::ir::toolpath::Event;
use crate::machine::FileUnit;

/// Meaning of a code.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Meaning {
    /// Knife down.
    Down,
    /// Knife up.
    Up,
    /// A piece begins, with its number.
    Piece,
    /// The unit of all numbers.
    Unit(FileUnit),
    /// A hole, by its drill number.
    Drill(u8),
    /// The next block is a message to the operator.
    Message,
    /// The next text block is a label.
    Label,
    /// With the knife down, a slit begins; with the knife up, full advance and no overcut.
    Slit,
    /// The next plunge has no heel overlap.
    FullAdvance,
    /// The next lift has no front overlap.
    NoOvercut,
    /// The knife is lifted at the next corner.
    CornerLift,
    /// End of the file, unless cuts follow.
    End,
    /// The coordinates of the block are a park position or a size, not a move.
    Park,
    /// Length of a bite of the conveyor, along X.
    BiteSize,
    /// An arc.
    Arc(Turn),
    /// Straight lines again.
    Line,
    /// Straight lines at rapid speed. Only the knife state decides whether a move cuts.
    Rapid,
    /// Reduced cutting speed until normal speed or the next piece.
    Slow,
    /// Normal speed.
    Normal,
    /// Speed of the piece, percent.
    SpeedOfPiece(u8),
    /// Maximum speed of the tip from here on, inches per minute.
    Feed,
    /// An event for the operator or the controller.
    Event(Event),
    /// The origin of all numbers.
    Origin,
    /// A known code that changes the cut but is not obeyed, with a description.
    NotObeyed(&'static str),
    /// A known code without effect on the cut.
    Housekeeping,
    /// An unknown code.
    Unknown,
}

/// The meaning of a code.
pub(super) fn meaning(code: Code) -> Meaning {
    let number = match kind(code).number {
        None => None,
        Some(number) => match whole(number) {
            None => return Meaning::Unknown,
            whole => whole,
        },
    };
    match (code.letter, number) {
        (b'M', Some(number)) => m_code(number),
        (b'A', None) => Meaning::Up,
        (b'B', None) => Meaning::Down,
        (b'N', _) => Meaning::Piece,
        (b'G', Some(91)) => Meaning::Unit(FileUnit::HundredthInch),
        (b'G', Some(70)) => Meaning::Unit(FileUnit::ThousandthInch),
        (b'G', Some(71)) => Meaning::Unit(FileUnit::TenthMm),
        (b'G', Some(0)) => Meaning::Rapid,
        (b'G', Some(1)) => Meaning::Line,
        (b'G', Some(2)) => Meaning::Arc(Turn::Clockwise),
        (b'G', Some(3)) => Meaning::Arc(Turn::Counterclockwise),
        (b'G', Some(4)) => Meaning::Origin,
        (b'G', Some(90)) | (b'H', _) | (b'D', Some(1 | 2 | 4)) => Meaning::Housekeeping,
        (b'O', None) => Meaning::Normal,
        (b'Q', None) => Meaning::Park,
        (b'R', None) => Meaning::Drill(1),
        (b'E', None) => Meaning::NotObeyed("flick notch"),
        (b'L', None) => Meaning::Slow,
        (b'F', _) => Meaning::Feed,
        (b'Z', _) => Meaning::BiteSize,
        _ => Meaning::Unknown,
    }
}

/// Converts a number that is whole and not negative; `None` for any other.
pub(super) fn whole(number: f64) -> Option<u32> {
    let whole = number as u32;
    (f64::from(whole) == number).then_some(whole)
}

fn m_code(number: u32) -> Meaning {
    match number {
        0 => Meaning::End,
        1 => Meaning::Event(Event::Stop),
        14 => Meaning::Down,
        15 => Meaning::Up,
        17 => Meaning::FullAdvance,
        18 => Meaning::NoOvercut,
        19 => Meaning::Slit,
        20 => Meaning::Message,
        23 => Meaning::NotObeyed("edge clip"),
        25 => Meaning::Slow,
        26 => Meaning::Normal,
        31 => Meaning::Label,
        43 => Meaning::Drill(1),
        44 => Meaning::Drill(2),
        45 | 72 => Meaning::Drill(3),
        73 => Meaning::Drill(4),
        46 => Meaning::CornerLift,
        60..=67 => Meaning::SpeedOfPiece(95 - 5 * (number - 60) as u8),
        68 => Meaning::NotObeyed("flick notch"),
        69 => Meaning::Event(Event::Advance),
        70 => Meaning::Origin,
        30 => Meaning::Housekeeping, // rewind
        40 => Meaning::NotObeyed("sharpening on"),
        41 => Meaning::NotObeyed("sharpening off"),
        42 => Meaning::NotObeyed("sharpen now"),
        47 => Meaning::NotObeyed("knife intelligence off"),
        48 => Meaning::NotObeyed("knife intelligence on"),
        51 => Meaning::NotObeyed("knife intelligence reset"),
        _ => Meaning::Unknown,
    }
}

/// The code, without its number if the number is a value and not part of the name.
pub(super) fn kind(code: Code) -> Code {
    let is_value = matches!(code.letter, b'F' | b'H' | b'N' | b'Z');
    let number = if is_value { None } else { code.number };
    Code { number, ..code }
}

/// Name of the code in the profile and in messages: without leading zeros.
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
        assert_eq!(of(b'F', Some(12.5)), Meaning::Feed);
        assert_eq!(of(b'N', Some(-1.0)), Meaning::Piece);
        assert_eq!(name(Code { letter: b'M', number: Some(0.0) }), "M0");
        assert_eq!(name(Code { letter: b'F', number: Some(12.0) }), "F");
    }

    #[test]
    fn the_profile_can_switch_every_code_that_has_a_meaning_and_no_other() {
        let mut known: Vec<String> = Vec::new();
        for letter in b'A'..=b'Z' {
            for number in std::iter::once(None).chain((0..=200_u8).map(|number| Some(f64::from(number)))) {
                let code = Code { letter, number };
                if meaning(code) != Meaning::Unknown && !known.contains(&name(code)) {
                    known.push(name(code));
                }
            }
        }
        known.sort();
        let mut switches = crate::machine::keys::CODE_NAMES.to_vec();
        switches.sort_unstable();
        assert_eq!(known, switches);
    }
}
