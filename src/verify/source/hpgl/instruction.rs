//! Instructions, escape sequences and labels of a plot.

use super::scan::{Pen, Place, Scan};

/// Terminator of labels by default: ETX.
pub(super) const ETX: u8 = 3;
/// Number of places behind PD, after a PU with a place, from which a label is not a text: its terminator is lost, and it
/// contains an outline.
const DRAWN_PLACES: usize = 3;
/// End bytes of a text without quotes behind CO, MG or BP.
const END_OF_WORDS: &[u8] = b";\r\n\x03";
/// Longest label, bytes; in a longer one the terminator counts as lost.
const LABEL_BYTES: usize = 1024;

impl Scan<'_> {
    pub(super) fn run(&mut self) {
        while let Some(&byte) = self.bytes.get(self.at) {
            let next = self.bytes.get(self.at + 1).copied().unwrap_or(0);
            if byte == 0x1b {
                self.escape();
            } else if self.bytes[self.at..].starts_with(b"@PJL") {
                self.at += self.until(b"\n", usize::MAX);
            } else if byte == b'"' && self.quote() {
                // Text without an instruction.
            } else if byte.is_ascii_alphabetic() && next.is_ascii_alphabetic() {
                self.at += 2;
                self.instruction([byte.to_ascii_uppercase(), next.to_ascii_uppercase()]);
            } else {
                self.at += 1;
            }
        }
    }

    /// Number of bytes up to one of `ends`, the end of the file or `most`.
    pub(super) fn until(&self, ends: &[u8], most: usize) -> usize {
        let rest = &self.bytes[self.at..];
        rest.iter().take(most).position(|byte| ends.contains(byte)).unwrap_or(rest.len().min(most))
    }

    pub(super) fn escape(&mut self) {
        let rest = &self.bytes[self.at + 1..];
        let after = |skip: usize, is: &dyn Fn(u8) -> bool| {
            skip + rest[skip..].iter().position(|&byte| !is(byte)).unwrap_or(rest.len() - skip)
        };
        let length = match rest {
            [b'E', ..] => {
                self.reset();
                1
            }
            [b'.', letter, ..] if letter.is_ascii_graphic() => {
                let end = after(2, &|byte| byte.is_ascii_digit() || byte == b';' || byte == b',');
                if rest.get(end) == Some(&b':') { end + 1 } else { 2 }
            }
            [b';', b'@', b':', settings @ ..] => settings_behind(settings).map_or(0, |length| 3 + length),
            [b'%', first, ..] => {
                let digits = 1 + usize::from(matches!(first, b'+' | b'-'));
                let end = after(digits, &|byte| byte.is_ascii_digit());
                let ends_well = end > digits && rest.get(end).is_some_and(u8::is_ascii_alphabetic);
                if ends_well { end + 1 } else { 0 }
            }
            [mark, ..] if b"!\"#$&'()*+,/".contains(mark) => {
                let end = after(1, &|b| b.is_ascii_digit() || b.is_ascii_lowercase() || b"+-.".contains(&b));
                let ends_well = rest.get(end).is_some_and(|b| b.is_ascii_uppercase() || *b == b'@');
                // Data beyond the end of the file invalidate the sequence.
                let length = end + 1 + if ends_well { data_behind(&rest[..=end]) } else { 0 };
                if ends_well && length <= rest.len() { length } else { 0 }
            }
            [other, ..] if other.is_ascii_alphanumeric() || *other == b'=' => 1,
            _ => 0,
        };
        self.at += 1 + length;
    }

    /// IN: resets everything; DF in contrast keeps the pen, the corners and the rotation.
    pub(super) fn reset(&mut self) {
        self.pen = Pen::default();
        self.is_up = true;
        (self.corners, self.scale, self.quarters, self.part) = (None, None, 0, None);
        (self.terminator, self.is_fresh) = (ETX, false);
        (self.polygon, self.curves) = (Vec::new(), Vec::new());
    }

    pub(super) fn instruction(&mut self, mnemonic: [u8; 2]) {
        let cause = self.at;
        match &mnemonic {
            b"IN" => self.reset(),
            b"BP" => {
                self.title();
                self.reset();
            }
            b"DF" => (self.pen.is_relative, self.scale, self.terminator) = (false, None, ETX),
            b"PU" | b"PD" | b"PA" | b"PR" => {
                match &mnemonic {
                    b"PU" => self.lift(),
                    b"PD" => self.pen.is_down = true,
                    other => self.pen.is_relative = other[1] == b'R',
                }
                self.places();
            }
            b"PE" => self.encoded(),
            b"SP" => {
                self.pen.cause = None;
                self.is_up = true;
                let pen = self.number();
                self.pen.is_away = pen.is_none_or(|pen| pen == 0.0);
            }
            b"WD" if self.is_quoted_alone() => _ = self.quote(),
            b"LB" | b"BL" | b"WD" => {
                let window = &self.bytes[self.at..self.bytes.len().min(self.at + LABEL_BYTES)];
                match memchr::memchr(self.terminator, window) {
                    Some(length) if !draws(&window[..length]) => self.at += length + 1,
                    _ => self.at += self.until(b";\r\n", LABEL_BYTES),
                }
            }
            b"DT" => {
                let given = self.bytes.get(self.at).copied().filter(|&byte| byte != b';');
                self.terminator = given.unwrap_or(ETX);
                self.at += usize::from(given.is_some());
            }
            b"CO" | b"MG" => {
                if !self.quote() {
                    self.at += self.until(END_OF_WORDS, usize::MAX);
                }
            }
            b"SM" => self.at += usize::from(!matches!(self.bytes.get(self.at), Some(b';') | None)),
            _ => {
                let numbers = match &mnemonic {
                    b"BZ" | b"BR" => return self.beziers(mnemonic == *b"BR"),
                    _ => self.numbers(),
                };
                self.figure(mnemonic, &numbers, cause);
                self.frame(mnemonic, &numbers);
            }
        }
    }

    /// True if nothing follows a text in quotes.
    fn is_quoted_alone(&mut self) -> bool {
        let start = self.at;
        let is_alone = self.quote() && matches!(self.bytes.get(self.at), None | Some(&(b';' | b'\r' | b'\n' | ETX)));
        self.at = start;
        is_alone
    }

    /// Skips a text in quotes; quotes inside it are doubled. `false` without a text, with a single quote, or with an outline
    /// between two quotes.
    fn quote(&mut self) -> bool {
        let blanks = self.bytes[self.at..].iter().take_while(|&&byte| byte == b' ').count();
        let mut at = self.at + blanks;
        if self.bytes.get(at) != Some(&b'"') {
            return false;
        }
        let end = self.bytes.len().min(at + LABEL_BYTES);
        at += 1;
        while at < end {
            let is_quote = self.bytes[at] == b'"';
            if is_quote && self.bytes.get(at + 1) != Some(&b'"') {
                let is_text = !draws(&self.bytes[self.at + blanks + 1..at]);
                if is_text {
                    self.at = at + 1;
                }
                return is_text;
            }
            at += 1 + usize::from(is_quote);
        }
        false
    }

    /// BP: numbers with texts in between. A text without quotes, behind a comma, extends to the semicolon.
    fn title(&mut self) {
        while self.number().is_some() || {
            let before = self.bytes[self.at..].iter().take_while(|&&byte| matches!(byte, b',' | b' ')).count();
            let next = self.at + before;
            let has_comma = self.bytes[self.at..next].contains(&b',');
            match self.bytes.get(next) {
                Some(b'"') => {
                    self.at = next;
                    self.quote() || {
                        self.at += self.until(END_OF_WORDS, usize::MAX);
                        true
                    }
                }
                Some(byte) if has_comma && !matches!(*byte, b';' | 0x1b) => {
                    self.at += self.until(END_OF_WORDS, usize::MAX);
                    true
                }
                _ => false,
            }
        } {}
    }

    /// Places behind PU, PD, PA and PR. A plotter takes a sequence for its interface (`ESC.B`) out of its input, here too.
    pub(super) fn places(&mut self) {
        loop {
            let cause = self.at;
            let (Some(x), Some(y)) = (self.number(), self.number()) else { return };
            let to = self.target([x, y], self.pen.is_relative);
            self.lead(to, cause);
            let comma = usize::from(self.bytes.get(self.at) == Some(&b','));
            if self.bytes[self.at + comma..].starts_with(b"\x1b.") {
                self.at += comma;
                self.escape();
            }
        }
    }

    /// Leads the pen to a place of the file; the first place behind PM 1 starts a part without drawing.
    pub(super) fn lead(&mut self, to: Place, cause: usize) {
        let starts = self.part.is_some() && std::mem::take(&mut self.is_fresh);
        if starts {
            self.part = Some(self.polygon.len());
        }
        self.go(to, cause, self.pen.is_down && !starts);
    }
}

/// Number of data bytes behind a sequence: the number before its last letter, if that is W, V for raster rows, or X for texts
/// printed verbatim.
fn data_behind(sequence: &[u8]) -> usize {
    let [mark, group, .., last] = *sequence else { return 0 };
    if !matches!([mark, group, last], [_, _, b'W'] | [b'*', b'b', b'V'] | [b'&', b'p', b'X']) {
        return 0;
    }
    let mut count = 0_usize;
    let mut weight = 1_usize;
    for &byte in sequence[..sequence.len() - 1].iter().rev() {
        match byte {
            b'0'..=b'9' => count = count.saturating_add(usize::from(byte - b'0').saturating_mul(weight)),
            b'-' | b'+' | b'.' => return 0,
            _ => break,
        }
        weight = weight.saturating_mul(10);
    }
    count
}

/// Number of bytes of the settings of a Summa cutter: lines, the last one of which is `END` or `END.`; `None` if none is.
fn settings_behind(bytes: &[u8]) -> Option<usize> {
    let mut lines = bytes.split_inclusive(|byte| matches!(byte, b'\r' | b'\n'));
    let end = lines.position(|line| matches!(line.trim_ascii(), b"END" | b"END."))?;
    let lines = bytes.split_inclusive(|byte| matches!(byte, b'\r' | b'\n'));
    Some(lines.take(end + 1).map(<[u8]>::len).sum())
}

/// True if a label draws, judged by the commas between PD and the next letter.
fn draws(label: &[u8]) -> bool {
    let starts = |mnemonic: &[u8]| {
        let places: Vec<usize> = memchr::memmem::find_iter(label, mnemonic).collect();
        places.into_iter().filter(|&at| at == 0 || matches!(label[at - 1], b';' | b'\r' | b'\n'))
    };
    let commas = |at: usize| {
        let numbers = &label[at + 2..];
        let end = numbers.iter().position(|byte| byte.is_ascii_alphabetic() || *byte == b';').unwrap_or(numbers.len());
        memchr::memchr_iter(b',', &numbers[..end]).count()
    };
    let Some(first) = starts(b"PU").find(|&at| commas(at) > 0) else { return false };
    starts(b"PD").filter(|&at| at > first).map(|at| commas(at).div_ceil(2)).sum::<usize>() >= DRAWN_PLACES
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_stand_behind_the_sequences_that_count_them() {
        let check = |sequence: &str, count: usize| assert_eq!(data_behind(sequence.as_bytes()), count, "{sequence}");
        check("*b26W", 26);
        check("*b0m26W", 26);
        check("*b26V", 26);
        check("(s9W", 9);
        check("&p6X", 6);
        check("*bW", 0);
        check("*b-2W", 0);
        check("*t300R", 0);
        check("&l1x0O", 0);
        check("*b99999999999999999999999W", usize::MAX);
    }
}
