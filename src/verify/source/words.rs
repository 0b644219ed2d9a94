//! Blocks of a cut file and their words, for the scan of the source: divided and read by other means than the reader's.

/// Maximum number of digits of an integer that `f64` represents exactly.
const EXACT_DIGITS: usize = 15;
/// Maximum number of digits of an integer that stays within [`GREATEST`].
const SHORT_DIGITS: usize = 8;
/// Maximum number of codes of a block and of significant decimals, and the greatest number: anything beyond is an error in the
/// file.
const MOST_CODES: usize = 6;
const MOST_DECIMALS: usize = 6;
const GREATEST: f64 = 1e8;
/// Letters with a number that is a value and not part of the code's name.
const VALUED: &str = "FHNZ";

/// Code: a letter, usually with a number.
#[derive(Debug, Clone, Copy)]
pub(in crate::verify) struct Word {
    pub(in crate::verify) letter: char,
    pub(in crate::verify) number: Option<f64>,
}

impl Word {
    /// Code as the profile names it.
    pub(in crate::verify) fn name(self) -> String {
        match self.number.filter(|_| !VALUED.contains(self.letter)) {
            Some(number) => format!("{}{}", self.letter, number + 0.0), // zero has no sign
            None => self.letter.to_string(),
        }
    }
}

/// Contents of a block.
#[derive(Debug, Clone, Default)]
pub(in crate::verify) struct Block {
    pub(in crate::verify) codes: Vec<Word>,
    /// X, Y, I and J, in units of the file.
    pub(in crate::verify) place: [Option<f64>; 4],
}

impl Block {
    /// True if it has a coordinate.
    pub(in crate::verify) fn has_place(&self) -> bool {
        self.place.iter().any(Option::is_some)
    }

    /// True if it has X and Y, and no centre.
    pub(in crate::verify) fn is_whole_place(&self) -> bool {
        self.place.map(|number| number.is_some()) == [true, true, false, false]
    }

    /// Reads a block without blanks; `None` for a text or a damaged block.
    fn read(text: &[u8]) -> Option<Self> {
        let mut block = Self::default();
        let mut rest = text;
        let mut last_was_coordinate = false;
        while let [letter, behind @ ..] = rest {
            let end = behind.iter().position(u8::is_ascii_uppercase).unwrap_or(behind.len());
            let number = if end == 0 { None } else { Some(number(&behind[..end])?) };
            last_was_coordinate = block.take(*letter, number, last_was_coordinate)?;
            rest = &behind[end..];
        }
        (block.codes.len() <= MOST_CODES).then_some(block)
    }

    /// Reads a block of places in short integers, the usual case, and returns it with its length including the asterisk; `None`
    /// for any other block.
    fn read_place(text: &[u8]) -> Option<(Self, usize)> {
        let mut block = Self::default();
        let mut at = 0;
        while let Some(&letter @ b'X'..=b'Y') = text.get(at) {
            at += 1;
            let is_negative = text.get(at) == Some(&b'-');
            at += usize::from(is_negative);
            let (start, mut value) = (at, 0);
            while let Some(digit @ b'0'..=b'9') = text.get(at) {
                value = value * 10 + u32::from(digit - b'0');
                at += 1;
                if at - start > SHORT_DIGITS {
                    return None;
                }
            }
            let number = (at > start).then_some(f64::from(value));
            block.take(letter, number.map(|number| if is_negative { -number } else { number }), true)?;
        }
        (text.get(at) == Some(&b'*')).then_some((block, at + 1))
    }

    /// Adds a letter with its number; `last_was_coordinate` tells whether the one before was a coordinate. Returns true if this
    /// one is; `None` if it is not allowed here.
    fn take(&mut self, letter: u8, number: Option<f64>, last_was_coordinate: bool) -> Option<bool> {
        if !letter.is_ascii_uppercase() {
            return None;
        }
        if let Some(axis) = b"XYIJ".iter().position(|&axis| axis == letter) {
            if self.place[axis].is_some() || number.is_none() || (self.has_place() && !last_was_coordinate) {
                return None;
            }
            self.place[axis] = number;
            return Some(true);
        }
        self.codes.push(Word { letter: char::from(letter), number });
        Some(false)
    }
}

/// Number with or without sign and decimals.
fn number(text: &[u8]) -> Option<f64> {
    let (is_negative, digits) = match text {
        [b'-', digits @ ..] => (true, digits),
        digits => (false, digits),
    };
    if (1..=EXACT_DIGITS).contains(&digits.len()) && digits.iter().all(u8::is_ascii_digit) {
        let value = digits.iter().fold(0, |value, digit| value * 10 + u64::from(digit - b'0')) as f64;
        return (value <= GREATEST).then_some(if is_negative { -value } else { value });
    }
    let text = std::str::from_utf8(text).ok()?;
    let unsigned = text.strip_prefix(['-', '+']).unwrap_or(text);
    let (whole, decimals) = unsigned.split_once('.').unwrap_or((unsigned, ""));
    if whole.is_empty() || !whole.bytes().chain(decimals.bytes()).all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let kept = &decimals[..decimals.len().min(MOST_DECIMALS)];
    let value: f64 = format!("{whole}.{kept}0").parse().ok()?;
    (value <= GREATEST).then_some(if text.starts_with('-') { -value } else { value })
}

/// Error for a damaged block or a text in place of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::verify) struct Unsound;

/// Capacity, bytes, that is sufficient for most blocks.
const BLOCK_ROOM: usize = 32;

/// Iterator over the blocks of a file. A clone looks ahead.
#[derive(Debug, Clone)]
pub(in crate::verify) struct Blocks<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Blocks<'a> {
    pub(in crate::verify) fn new(bytes: &'a [u8]) -> Self {
        // A byte order mark and lines of percent signs are skipped.
        let leader = bytes.iter().position(|&byte| byte != 0).unwrap_or(0);
        let bytes = bytes[leader..].strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let frame = |byte: &u8| is_blank(*byte) || *byte == b'%';
        let start = bytes.iter().position(|byte| !frame(byte)).unwrap_or(bytes.len());
        let end = bytes.iter().rposition(|byte| !frame(byte)).map_or(start, |last| last + 1);
        Self { bytes: &bytes[start..end], at: 0 }
    }

    /// Next block. Text between two slashes is deleted.
    pub(in crate::verify) fn next(&mut self) -> Option<Result<Block, Unsound>> {
        if self.at >= self.bytes.len() {
            return None;
        }
        let rest = &self.bytes[self.at..];
        if let Some((block, length)) = Block::read_place(rest) {
            self.at += length;
            return Some(Ok(block));
        }
        let end = memchr::memchr(b'*', rest).unwrap_or(rest.len());
        if !rest[..end].iter().any(|&byte| byte == b'/' || is_blank(byte)) {
            // The usual case.
            self.at += (end + 1).min(rest.len());
            return Some(Block::read(&rest[..end]).ok_or(Unsound));
        }
        let mut text = Vec::with_capacity(BLOCK_ROOM);
        let mut sound = true;
        // Blanks and marks since the last other byte; line breaks are allowed anywhere.
        let (mut has_blank, mut has_mark) = (false, false);
        while let Some(&byte) = self.bytes.get(self.at) {
            self.at += 1;
            if byte != b'/' && !is_blank(byte) {
                let is_in_number = |byte: &u8| byte.is_ascii_digit() || b"+-.".contains(byte);
                let is_parted = has_blank && text.last().is_some_and(is_in_number) && is_in_number(&byte);
                sound &= text.is_empty() || !has_mark && !is_parted;
                (has_blank, has_mark) = (false, false);
            }
            match byte {
                b'*' => break,
                b'/' => match self.bytes[self.at..].iter().position(|&byte| byte == b'/') {
                    Some(length) => self.at += length + 1,
                    None => sound = false,
                },
                b'\r' | b'\n' => {}
                b' ' | b'\t' => has_blank = true,
                _ if is_blank(byte) => has_mark = true,
                _ => text.push(byte),
            }
        }
        Some(Block::read(&text).filter(|_| sound).ok_or(Unsound))
    }

    /// Skips a text, in which nothing is deleted.
    pub(in crate::verify) fn skip_text(&mut self) {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        self.at += rest.iter().position(|&byte| byte == b'*').map_or(rest.len(), |length| length + 1);
    }

    /// Skips the next block if `wanted` is true for it.
    pub(in crate::verify) fn skip_if(&mut self, wanted: impl Fn(&Block) -> bool) -> bool {
        let mut ahead = self.clone();
        let is_wanted = ahead.next().is_some_and(|next| next.is_ok_and(|block| wanted(&block)));
        if is_wanted {
            *self = ahead;
        }
        is_wanted
    }
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b'\r' | b'\n' | b' ' | b'\t' | 0 | 0x1a | 0x02 | 0x03 | 0x11 | 0x13)
}
