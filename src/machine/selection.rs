//! Choice of the pieces of a marker for one compile, and the mode of the knife.

use std::fmt;

use thiserror::Error;

/// Choice of pieces; all by default.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Selection {
    /// Pieces to cut exclusively; `None` = every piece.
    pub pieces: Option<Numbers>,
    /// Pieces to leave out.
    pub skip: Option<Numbers>,
    /// Place in the cut order where cutting begins.
    pub resume_from: Option<Start>,
    /// Windows of a conveyor to cut, from 1; `None` = every window.
    pub bites: Option<Numbers>,
}

impl Selection {
    /// True if every piece is cut.
    pub fn is_all(&self) -> bool {
        *self == Self::default()
    }

    /// True if a run may begin amid the marker.
    pub fn begins_amid(&self) -> bool {
        self.resume_from.is_some() || self.bites.is_some()
    }

    /// True if a piece of this number is cut, regardless of its place in the cut order.
    pub fn has(&self, number: u32) -> bool {
        self.pieces.as_ref().is_none_or(|only| only.has(number))
            && !self.skip.as_ref().is_some_and(|skipped| skipped.has(number))
    }
}

/// Place where a run begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Start {
    /// Piece, as in `3`, or `3/2` for that of the second copy.
    Piece {
        /// Number; it means the first piece with it.
        number: u32,
        /// Copy of the marker, from 1.
        copy: u32,
    },
    /// Window of a conveyor, from 1, as in `bite:3`.
    Bite(u32),
}

/// Prefix of the number of a window.
const BITE: &str = "bite:";

impl Start {
    /// Reads a number, a number and a copy, or the number of a window.
    pub fn parse(text: &str) -> Result<Self, NotStart> {
        if let Some(number) = text.strip_prefix(BITE) {
            let number = Numbers::parse(number).ok().and_then(|numbers| numbers.only()).filter(|&number| number > 0);
            return number.map(Self::Bite).ok_or_else(|| NotStart(text.to_owned()));
        }
        let (number, copy) = text.split_once('/').unwrap_or((text, "1"));
        let whole = |word: &str| Numbers::parse(word).ok()?.only();
        let start = whole(number).zip(whole(copy)).map(|(number, copy)| Self::Piece { number, copy });
        start.ok_or_else(|| NotStart(text.to_owned()))
    }
}

/// Text as typed.
impl fmt::Display for Start {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Piece { number, copy: 1 } => write!(out, "{number}"),
            Self::Piece { number, copy } => write!(out, "{number}/{copy}"),
            Self::Bite(number) => write!(out, "{BITE}{number}"),
        }
    }
}

/// Error of a text that is not a place to begin.
#[derive(Debug, Error, PartialEq, Eq)]
#[error(
    "`{0}` names no piece; give its number, and its copy behind a stroke if there are several, as in 3 or 3/2, or bite:3"
)]
pub struct NotStart(String);

/// Numbers of pieces, as in `3,7-12`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Numbers {
    /// First and last of each range, as given.
    ranges: Vec<[u32; 2]>,
}

/// Error in a list of numbers.
#[derive(Debug, Error, PartialEq, Eq)]
pub enum NotNumbers {
    /// A word that is not a whole number.
    #[error("`{0}` is no number; give numbers and ranges, as in 3,7-12")]
    Word(String),
    /// A descending range.
    #[error("the range {0}-{1} runs backward; did you mean {1}-{0}?")]
    Backward(u32, u32),
}

impl Numbers {
    /// Reads comma-separated numbers and ranges.
    pub fn parse(text: &str) -> Result<Self, NotNumbers> {
        let number = |word: &str| {
            let digits = word.trim();
            let is_number = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
            digits.parse().ok().filter(|_| is_number).ok_or_else(|| NotNumbers::Word(word.trim().to_owned()))
        };
        let range = |part: &str| {
            let [first, last] = match part.split_once('-') {
                Some((first, last)) => [number(first)?, number(last)?],
                None => [number(part)?; 2],
            };
            if last < first { Err(NotNumbers::Backward(first, last)) } else { Ok([first, last]) }
        };
        Ok(Self { ranges: text.split(',').map(range).collect::<Result<_, _>>()? })
    }

    /// Single number, if only one was given.
    fn only(&self) -> Option<u32> {
        match self.ranges[..] {
            [[first, last]] if first == last => Some(first),
            _ => None,
        }
    }

    /// True if a number is among them.
    pub fn has(&self, number: u32) -> bool {
        self.ranges.iter().any(|&[first, last]| (first..=last).contains(&number))
    }

    /// Numbers as written: both ends of each range.
    pub fn written(&self) -> impl Iterator<Item = u32> + '_ {
        self.ranges.iter().flat_map(|&[first, last]| std::iter::once(first).chain((last != first).then_some(last)))
    }
}

/// Text as typed.
impl fmt::Display for Numbers {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, &[first, last]) in self.ranges.iter().enumerate() {
            let comma = if i == 0 { "" } else { "," };
            if first == last { write!(out, "{comma}{first}")? } else { write!(out, "{comma}{first}-{last}")? }
        }
        Ok(())
    }
}

/// Mode of the knife in a program.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Mode {
    /// Normal cutting.
    #[default]
    Cut,
    /// Same motion with knife and drills up.
    Dry,
    /// One round along the bounding box of the marker with the knife up, from home and back.
    Frame,
}

impl Mode {
    /// True if knife and drills work.
    pub fn cuts(self) -> bool {
        match self {
            Self::Cut => true,
            Self::Dry | Self::Frame => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_people_write_them() {
        let numbers = Numbers::parse("3, 7-12,20").expect("numbers");
        let found: Vec<u32> = (0..30).filter(|&number| numbers.has(number)).collect();
        assert_eq!(found, [3, 7, 8, 9, 10, 11, 12, 20]);
        assert_eq!(numbers.written().collect::<Vec<_>>(), [3, 7, 12, 20]);
        assert_eq!(numbers.to_string(), "3,7-12,20");
        let wide = Numbers::parse("0-4294967295").expect("numbers");
        assert!(wide.has(0) && wide.has(u32::MAX));
    }

    #[test]
    fn what_is_no_number_is_named() {
        for (text, word) in [("", ""), ("3,", ""), ("a", "a"), ("-3", ""), ("3-", ""), ("+3", "+3"), ("1.5", "1.5")] {
            assert_eq!(Numbers::parse(text), Err(NotNumbers::Word(word.to_owned())), "{text}");
        }
        assert_eq!(Numbers::parse("4294967296"), Err(NotNumbers::Word("4294967296".to_owned())));
        assert_eq!(Numbers::parse("12-7"), Err(NotNumbers::Backward(12, 7)));
    }

    #[test]
    fn a_run_begins_with_a_piece_of_a_copy() {
        for (text, number, copy) in [("3", 3, 1), ("3/2", 3, 2), ("0/1", 0, 1)] {
            let start = Start::parse(text).expect("a piece");
            assert_eq!(start, Start::Piece { number, copy });
            assert_eq!(start.to_string(), text.trim_end_matches("/1"));
        }
        let bite = Start::parse("bite:2").expect("a window");
        assert_eq!((bite, bite.to_string().as_str()), (Start::Bite(2), "bite:2"));
        let others =
            ["", "3/", "/2", "3-4", "3,4", "3/2/1", "x", "-1", "bite:", "bite:0", "bite:1-2", "bite:x", "bite"];
        assert!(others.iter().all(|text| Start::parse(text).is_err()));
    }

    #[test]
    fn skipping_wins_over_choosing() {
        let of = |text| Some(Numbers::parse(text).expect("numbers"));
        let selection = Selection { pieces: of("1-5"), skip: of("3"), ..Selection::default() };
        assert!(selection.has(2) && !selection.has(3) && !selection.has(6) && !selection.is_all());
        assert!(Selection::default().has(7) && Selection::default().is_all());
    }
}
