//! Bytes of a plot as statements: instructions with their numbers, texts, escape sequences, and junk between them.

use super::encoded::{self, Body};
use super::escape::{Escape, escape, job};
use super::instruction::{Instruction, Tail, instruction};
use super::label::{self, Terminator};
use super::syntax::{self, Fault};
use crate::source::Span;

/// Next statement of a plot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Statement {
    /// An instruction; its numbers are taken with [`Reader::pair`] and [`Reader::value`], its text by the other methods.
    Instruction(Instruction, [u8; 2]),
    /// The plotter is reset from outside.
    Reset,
    /// Bytes that begin no statement.
    Junk,
}

/// Two numbers, and their place.
pub(super) type Pair = ([f64; 2], Span);

/// Next item of a list of numbers.
#[derive(Debug, PartialEq)]
pub(super) enum Next<T> {
    /// A value.
    Some(T),
    /// End of the list.
    End,
    /// A value that is not written as digits and a comma alone: with a decimal point, a blank or a plus sign.
    Unusual(T),
    /// A value before which a number is missing: two commas follow each other.
    Gap(Span),
    /// An unpaired number.
    Odd(Span),
    /// A number beyond any table.
    Overflow(Span),
}

/// Fault after a mnemonic, and its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Flaw {
    /// A number beyond any table.
    Overflow(Span),
    /// An encoded polyline holds an invalid byte.
    Damaged(Span),
    /// An encoded polyline has no semicolon.
    Open(Span),
}

/// Reads statement after statement.
#[derive(Debug)]
pub(super) struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Number of the instruction, from 1: the block of its spans.
    block: u32,
    terminator: Terminator,
    /// True if the file is text in UTF-8; computed at first use.
    paired: Option<bool>,
    /// Place of the sequence that enters HP-GL/2, as long as none leaves it.
    language: Option<Span>,
}

/// Number of numbers after an instruction that are looked at.
const MOST_AHEAD: usize = 22;
/// Least number of numbers that make an outline.
const NUMBERS_OF_A_LINE: usize = 6;
/// First byte of the sequences of [`super::escape`].
const ESCAPE: u8 = 0x1b;
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Number of bytes after a torn mnemonic that are looked at, and least number of last digits among them.
const LOOKED_AT: usize = 12;
const LAST_DIGITS: usize = 3;

impl<'a> Reader<'a> {
    /// Starts at the first statement.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        let at = if bytes.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK.len() } else { 0 };
        Self { bytes, at, block: 0, terminator: Terminator::new(), paired: None, language: None }
    }

    /// The next statement and the place of its first bytes.
    pub(super) fn next(&mut self) -> Option<(Statement, Span)> {
        self.finish();
        loop {
            while let Some(b';' | b' ' | b'\t' | b'\r' | b'\n' | 0 | 3 | 0x1a) = self.bytes.get(self.at) {
                self.at += 1;
            }
            let start = self.at;
            let i = &self.bytes[start..];
            let &first = i.first()?;
            let mut passed_over = false;
            let (statement, next) = if let Ok((rest, mnemonic)) = syntax::mnemonic(i) {
                (Statement::Instruction(instruction(mnemonic), mnemonic), rest)
            } else if let Ok((rest, sequence)) = if first == ESCAPE { escape(i) } else { job(i) } {
                passed_over = sequence == Escape::Other;
                (Statement::Reset, rest)
            } else {
                let begun = || i[1..].iter().position(|&byte| begins(byte)).unwrap_or(i.len() - 1);
                // Words of a text are never run as instructions.
                let length = label::in_quotes(i, 0).unwrap_or_else(|| 1 + begun());
                (Statement::Junk, &i[length..])
            };
            self.at = self.bytes.len() - next.len();
            if statement == Statement::Reset {
                self.follow_language(start);
            }
            if !passed_over {
                if matches!(
                    statement,
                    Statement::Reset
                        | Statement::Instruction(
                            Instruction::Initialize | Instruction::Begin | Instruction::Default,
                            _
                        )
                ) {
                    self.terminator = Terminator::new();
                }
                self.block += 1;
                return Some((statement, self.span(start)));
            }
        }
    }

    /// Follows sequences that enter a language (`%0B`, `%1B`), leave it (`%0A`, `%-12345X`) or reset the plotter. The one that
    /// makes a printer a plotter (`%-1B`) needs no end.
    fn follow_language(&mut self, start: usize) {
        self.language = match &self.bytes[start..self.at] {
            [ESCAPE, b'%', b'0' | b'1', b'B'] => Some(self.span(start)),
            [ESCAPE, b'%', .., b'A' | b'X'] | [ESCAPE, b'E'] => None,
            _ => self.language,
        };
    }

    /// Place of the sequence that has entered HP-GL/2, if none has left it.
    pub(super) fn language(&self) -> Option<Span> {
        self.language
    }

    /// Consumes the rest of an instruction's numbers, and its end.
    fn finish(&mut self) {
        if self.block == 0 {
            return;
        }
        while let Ok((rest, _)) = syntax::parameter(&self.bytes[self.at..]) {
            self.at = self.bytes.len() - rest.len();
        }
        if let Ok((rest, ())) = syntax::end(&self.bytes[self.at..]) {
            self.at = self.bytes.len() - rest.len();
        }
    }

    /// True if the last byte of the file belongs to a number.
    pub(super) fn ends_with_digit(&self) -> bool {
        self.bytes.last().is_some_and(|byte| byte.is_ascii_digit() || *byte == b'.')
    }

    /// True if the file ends with a number.
    pub(super) fn ends_with(&self, number: Span) -> bool {
        number.end as usize >= self.bytes.len()
    }

    /// Span from `start` to the next byte.
    fn span(&self, start: usize) -> Span {
        // A `Source` is below 4 GiB.
        Span { start: start as u32, end: self.at as u32, block: self.block }
    }

    /// The next number of the instruction.
    pub(super) fn value(&mut self) -> Next<f64> {
        let start = self.at;
        match syntax::parameter(&self.bytes[start..]) {
            Ok((rest, value)) => {
                self.at = self.bytes.len() - rest.len();
                Next::Some(value)
            }
            Err(nom::Err::Failure(Fault::Overflow)) => {
                let rest = syntax::behind_number(&self.bytes[start..]);
                self.at = self.bytes.len() - rest.len();
                Next::Overflow(self.span(start))
            }
            Err(_) => Next::End,
        }
    }

    /// The next two numbers of the instruction.
    pub(super) fn pair(&mut self) -> Next<Pair> {
        self.unusual_pair(self.pair_start())
    }

    /// The next two numbers of the instruction if they are whole and parted by a single comma, as nearly all are.
    #[inline]
    pub(super) fn plain_pair(&mut self) -> Option<Pair> {
        let start = self.pair_start();
        let (rest, pair) = syntax::plain_pair(&self.bytes[self.at..])?;
        self.at = self.bytes.len() - rest.len();
        Some((pair, self.span(start)))
    }

    /// Start of the next pair: the comma before it does not belong to its place.
    #[inline]
    fn pair_start(&self) -> usize {
        self.at + usize::from(self.bytes.get(self.at) == Some(&b','))
    }

    /// The next two numbers, not both whole or not parted by a single comma.
    fn unusual_pair(&mut self, start: usize) -> Next<Pair> {
        let i = &self.bytes[self.at..];
        let both = syntax::parameter(i).ok().and_then(|(second, x)| {
            let (rest, y) = syntax::parameter(second).ok()?;
            Some((second, rest, [x, y]))
        });
        if let Some((second, rest, pair)) = both {
            let has_gap = syntax::has_gap(i) || syntax::has_gap(second);
            self.at = self.bytes.len() - rest.len();
            let span = self.span(start);
            return if has_gap {
                Next::Gap(span)
            } else if self.slice(span).iter().any(|byte| b". \t+".contains(byte)) {
                Next::Unusual((pair, span))
            } else {
                Next::Some((pair, span))
            };
        }
        let start = self.at;
        match self.value() {
            Next::Some(_) | Next::Unusual(_) => match self.value() {
                Next::Overflow(span) => Next::Overflow(span),
                _ => Next::Odd(self.span(start)),
            },
            Next::Overflow(span) => {
                // The second number is consumed too, so that the following places stay pairs.
                self.value();
                Next::Overflow(span)
            }
            Next::Odd(_) | Next::Gap(_) | Next::End => Next::End,
        }
    }

    /// A comma that is next, and its place.
    pub(super) fn comma(&mut self) -> Option<Span> {
        let start = self.at;
        (self.bytes.get(start) == Some(&b',')).then(|| {
            self.at += 1;
            self.span(start)
        })
    }

    /// The comma behind the last number, or the blank before its semicolon, and its place.
    pub(super) fn end_of_list(&mut self) -> Option<Span> {
        let start = self.at;
        matches!(self.bytes[start..], [b',', ..] | [b' ' | b'\t', b';', ..]).then(|| {
            self.at += 1;
            self.span(start)
        })
    }

    /// Passes over a sequence for the interface (`ESC.B`) amid a list of places: the plotter takes it out of its input.
    pub(super) fn pass_query(&mut self) -> bool {
        let behind = self.bytes[self.at..].starts_with(b"\x1b.").then(|| escape(&self.bytes[self.at..]).ok());
        let Some((rest, _)) = behind.flatten() else { return false };
        let goes_on = matches!(rest, [b',', next, ..] | [next, ..] if next.is_ascii_digit() || b"+-".contains(next));
        if goes_on {
            self.at = self.bytes.len() - rest.len();
        }
        goes_on
    }

    /// The bytes of a span.
    pub(super) fn slice(&self, span: Span) -> &'a [u8] {
        &self.bytes[span.start as usize..span.end as usize]
    }

    /// Up to `MOST` numbers; fewer if the instruction has fewer.
    pub(super) fn values<const MOST: usize>(&mut self) -> Result<arrayvec::ArrayVec<f64, MOST>, Span> {
        let mut values = arrayvec::ArrayVec::new();
        while !values.is_full() {
            match self.value() {
                Next::Some(value) | Next::Unusual(value) => values.push(value),
                Next::Overflow(span) => return Err(span),
                Next::End | Next::Odd(_) | Next::Gap(_) => break,
            }
        }
        Ok(values)
    }

    /// LB: the place of its text, and true if its terminator is missing.
    pub(super) fn text(&mut self) -> (Span, bool) {
        let start = self.at;
        let text = self.terminator.text(self.bytes, start);
        self.at = text.next;
        (Span { end: text.end as u32, ..self.span(start) }, text.is_open)
    }

    /// DT.
    pub(super) fn define_terminator(&mut self) {
        self.at = self.terminator.define(self.bytes, self.at);
    }

    /// CO, MG.
    pub(super) fn quoted(&mut self) {
        self.at = label::quoted(self.bytes, self.at);
    }

    /// Skips the text of WD, which programs write in quotes or like a label. Returns true if its terminator is missing.
    pub(super) fn display(&mut self) -> bool {
        match label::in_quotes(self.bytes, self.at) {
            Some(next) if self.bytes.get(next).is_none_or(|byte| b";\r\n\x03".contains(byte)) => {
                self.at = next;
                false
            }
            Some(_) | None => self.text().1,
        }
    }

    /// SM: a character, unless the instruction ends.
    fn character(&mut self) {
        self.at += usize::from(self.bytes.get(self.at).is_some_and(|byte| *byte != b';'));
    }

    /// BP: numbers and texts, in quotes or up to the end of the instruction.
    fn texts_among_values(&mut self) {
        loop {
            while let Ok((rest, _)) = syntax::parameter(&self.bytes[self.at..]) {
                self.at = self.bytes.len() - rest.len();
            }
            let separators = syntax::separators(&self.bytes[self.at..]);
            let between = &self.bytes[self.at..][..separators];
            let is_value = between.contains(&b',') && !between.contains(&b'\n');
            match self.bytes.get(self.at + separators) {
                Some(b'"') => {}
                // The words of a title without quotes are not run as instructions.
                Some(byte) if is_value && !matches!(*byte, b';' | ESCAPE) => {}
                Some(_) | None => return,
            }
            self.at += separators;
            self.quoted();
        }
    }

    /// Offset of the next byte.
    pub(super) fn at(&self) -> usize {
        self.at
    }

    /// True if a move follows the numbers that are next, so that a stroke goes on behind them.
    pub(super) fn is_led_on(&self) -> bool {
        let rest = &self.bytes[self.at..];
        let Some(end) = memchr::memchr(b';', rest) else { return false };
        let next = rest[end + 1..].trim_ascii_start();
        [b"PD", b"PA", b"PR"].iter().any(|mnemonic| next.starts_with(*mnemonic))
    }

    /// True if a number is next.
    pub(super) fn number_follows(&self) -> bool {
        syntax::parameter(&self.bytes[self.at..]).is_ok()
    }

    /// Number of numbers that are next.
    pub(super) fn numbers_ahead(&self) -> usize {
        let (mut rest, mut count) = (&self.bytes[self.at..], 0);
        while let Ok((after, _)) = syntax::parameter(rest) {
            (rest, count) = (after, count + 1);
        }
        count
    }

    /// The numbers that are next, up to as many as an instruction with a limited number of them takes.
    pub(super) fn first_ahead(&self) -> arrayvec::ArrayVec<f64, MOST_AHEAD> {
        let (mut rest, mut numbers) = (&self.bytes[self.at..], arrayvec::ArrayVec::new());
        while !numbers.is_full()
            && let Ok((after, number)) = syntax::parameter(rest)
        {
            numbers.push(number);
            rest = after;
        }
        numbers
    }

    /// The second of the numbers that are next.
    pub(super) fn second_ahead(&self) -> Option<f64> {
        let (rest, _) = syntax::parameter(&self.bytes[self.at..]).ok()?;
        syntax::parameter(rest).ok().map(|(_, second)| second)
    }

    /// The mnemonic of an instruction, by its span.
    pub(super) fn mnemonic_at(&self, span: Span) -> String {
        String::from_utf8_lossy(self.slice(span)).to_ascii_uppercase()
    }

    /// The numbers of an instruction, by its span, as they are written.
    fn numbers_behind(&self, span: Span) -> &'a [u8] {
        let rest = &self.bytes[span.end as usize..];
        let is_number = |byte: &u8| byte.is_ascii_digit() || b"+-., \t\r\n".contains(byte);
        &rest[..rest.iter().position(|byte| !is_number(byte)).unwrap_or(rest.len())]
    }

    /// True if the file ends amid an instruction: at its letters, a digit or a comma, where a semicolon ends the one before it.
    pub(super) fn lacks_semicolon(&self, span: Span) -> bool {
        let ends = span.end as usize + self.numbers_behind(span).len() == self.bytes.len();
        let is_amid = !self.bytes.last().is_some_and(u8::is_ascii_whitespace);
        ends && is_amid && self.bytes[..span.start as usize].trim_ascii_end().ends_with(b";")
    }

    /// True if an instruction has numbers, by its span.
    pub(super) fn has_numbers(&self, span: Span) -> bool {
        self.numbers_behind(span).iter().any(u8::is_ascii_digit)
    }

    /// Number of numbers within a span.
    pub(super) fn numbers_within(&self, span: Span) -> usize {
        let bytes = &self.bytes[span.start as usize..span.end as usize];
        bytes.chunk_by(|a, b| a.is_ascii_digit() == b.is_ascii_digit()).filter(|run| run[0].is_ascii_digit()).count()
    }

    /// True if a span directly follows a number.
    pub(super) fn follows_number(&self, span: Span) -> bool {
        span.start > 0 && self.bytes[span.start as usize - 1].is_ascii_digit()
    }

    /// True if a span is a text in quotes.
    pub(super) fn is_quoted(&self, span: Span) -> bool {
        label::in_quotes(self.bytes, span.start as usize) == Some(span.end as usize)
    }

    /// True if a span holds an instruction that draws, with enough places for a line.
    pub(super) fn draws(&self, span: Span) -> bool {
        let bytes = &self.bytes[span.start as usize..span.end as usize];
        let instructions = bytes.split(|byte| b";\r\n\"".contains(byte)).map(<[u8]>::trim_ascii);
        let numbers = instructions.filter_map(|text| {
            let (mnemonic, numbers) = text.split_first_chunk()?;
            let draws = [*b"PD", *b"PA", *b"PR", *b"AA", *b"AR"].contains(&mnemonic.map(|c| c.to_ascii_uppercase()));
            let runs = numbers.chunk_by(|a, b| a.is_ascii_digit() == b.is_ascii_digit());
            draws.then(|| runs.filter(|run| run[0].is_ascii_digit()).count())
        });
        numbers.sum::<usize>() >= NUMBERS_OF_A_LINE
    }

    /// True if a span may be PU or PD with a lost letter.
    pub(super) fn is_torn_pen(&self, span: Span) -> bool {
        matches!(self.bytes[span.start as usize].to_ascii_uppercase(), b'P' | b'U' | b'D')
    }

    /// True if a span may be an encoded polyline whose mnemonic has lost a letter: flags follow, or numbers of eight bits.
    pub(super) fn is_torn_encoded(&self, span: Span) -> bool {
        let bytes = &self.bytes[span.start as usize..span.end as usize];
        matches!(bytes, [b'P' | b'p' | b'E' | b'e', b'<' | b'=' | b'>' | b':' | b'7', ..])
            || matches!(bytes, [b'P' | b'p' | b'E' | b'e', ..]) && self.is_encoded_behind(span)
            || memchr::memmem::find(bytes, b"<=").is_some()
    }

    /// True if numbers of the eight-bit encoding begin within a span: no text has so many of these bytes.
    fn is_encoded_behind(&self, span: Span) -> bool {
        let bytes = &self.bytes[span.start as usize + 1..];
        let body = bytes.iter().take(LOOKED_AT).take_while(|byte| **byte != b';');
        body.filter(|byte| **byte >= encoded::LAST_DIGIT).count() >= LAST_DIGITS
    }

    /// Skips the rest of an instruction, and returns a fault in it.
    pub(super) fn pass_over(&mut self, tail: Tail) -> Option<Flaw> {
        match tail {
            Tail::Text => _ = self.text(),
            Tail::Display => _ = self.display(),
            Tail::Terminator => self.define_terminator(),
            Tail::Quoted => self.quoted(),
            Tail::Character => self.character(),
            Tail::Values => self.texts_among_values(),
            Tail::Numbers => loop {
                match self.value() {
                    Next::Some(_) | Next::Unusual(_) => {}
                    Next::Overflow(span) => return Some(Flaw::Overflow(span)),
                    Next::End | Next::Odd(_) | Next::Gap(_) => return None,
                }
            },
            Tail::Encoded => {
                let mut body = self.body();
                while body.next().is_some() {}
                self.behind(&body);
                let end = self.within(body.at.saturating_sub(1), body.at);
                return match body.ending {
                    encoded::Ending::Damaged => Some(Flaw::Damaged(end)),
                    encoded::Ending::Open => Some(Flaw::Open(end)),
                    encoded::Ending::More | encoded::Ending::Done | encoded::Ending::Next => None,
                };
            }
        }
        None
    }

    /// The body of PE; hand it back with [`Reader::behind`].
    pub(super) fn body(&mut self) -> Body<'a> {
        let paired = *self.paired.get_or_insert_with(|| encoded::is_paired(self.bytes));
        Body::new(self.bytes, self.at, paired)
    }

    /// Continues after a body, or after the semicolon that follows a damaged one.
    pub(super) fn behind(&mut self, body: &Body<'a>) {
        self.at = match body.ending {
            encoded::Ending::Damaged => {
                memchr::memchr(b';', &self.bytes[body.at..]).map_or(self.bytes.len(), |length| body.at + length)
            }
            encoded::Ending::More | encoded::Ending::Done | encoded::Ending::Open | encoded::Ending::Next => body.at,
        };
    }

    /// The span of an item of a body that started at `start`.
    pub(super) fn within(&self, start: usize, end: usize) -> Span {
        Span { start: start as u32, end: end as u32, block: self.block }
    }
}

/// True if a byte may begin a statement.
fn begins(byte: u8) -> bool {
    byte.is_ascii_alphabetic() || matches!(byte, b';' | ESCAPE | b'@' | b'"')
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The statements of a text: mnemonics with their numbers, `!` for junk.
    fn check(text: &[u8], expected: &str) {
        let mut reader = Reader::new(text);
        let mut found = Vec::new();
        while let Some((statement, _)) = reader.next() {
            found.push(match statement {
                Statement::Instruction(instruction, mnemonic) => {
                    let mut word = String::from_utf8_lossy(&mnemonic).into_owned();
                    match instruction {
                        Instruction::Label => word = format!("{word}[{:?}]", reader.text().0),
                        Instruction::Terminator => reader.define_terminator(),
                        Instruction::Comment | Instruction::Begin | Instruction::Symbol => {
                            _ = reader.pass_over(instruction.tail());
                        }
                        _ => {
                            while let Next::Some(value) = reader.value() {
                                word = format!("{word} {value}");
                            }
                        }
                    }
                    word
                }
                Statement::Reset => "reset".to_owned(),
                Statement::Junk => "!".to_owned(),
            });
        }
        assert_eq!(found.join("|"), expected, "{}", text.escape_ascii());
    }

    #[test]
    fn statements_end_in_many_ways() {
        check(b"IN;SP1;PU0,0;PD4,5;", "IN|SP 1|PU 0 0|PD 4 5");
        check(b"INSP1PU0,0PD4 5pu", "IN|SP 1|PU 0 0|PD 4 5|PU");
        check(b";PD7,4\r\n;PD8,4\r\n", "PD 7 4|PD 8 4");
        check(b"!PG;PU1-2;", "!|PG|PU 1 -2");
        check(b"\xef\xbb\xbf\x1bE\x1b%0BIN;CO\"PU1,2\";DT#,1;PU;", "reset|IN|CO|DT|PU");
        check(b"@PJL ENTER LANGUAGE=HPGL2\nIN;", "IN");
        check(b"P;PU3;", "!|PU 3");
        check(b"MG\"SPORT\";BP1,\"PRESS\",5,1;SMP;PU3;SM;PU4", "MG|BP|SM|PU 3|SM|PU 4");
        check(b"BP1,RO 90;PU3;BP5,1PU4;MT\"RO 90\";PU5;\"PU6;", "BP|PU 3|BP|PU 4|MT|!|PU 5|!|PU 6");
        check(
            b"DT#;LBa#IN;LBb#\x03PU;",
            "DT|LB[Span { start: 6, end: 7, block: 2 }]|IN|LB[Span { start: 13, end: 15, block: 4 }]|PU",
        );
        check(b"\x1b", "!");
    }

    #[test]
    fn places_count_instructions_and_pairs() {
        let mut reader = Reader::new(b"IN;PD10,20,30,40,5;");
        reader.next();
        reader.next();
        assert_eq!(reader.pair(), Next::Some(([10.0, 20.0], Span { start: 5, end: 10, block: 2 })));
        assert_eq!(reader.pair(), Next::Some(([30.0, 40.0], Span { start: 11, end: 16, block: 2 })));
        assert_eq!(reader.pair(), Next::Odd(Span { start: 16, end: 18, block: 2 }));
        assert_eq!(reader.pair(), Next::End);
        let mut reader = Reader::new(b"PD2147483648,1,3,4;PU");
        reader.next();
        assert_eq!(reader.pair(), Next::Overflow(Span { start: 2, end: 12, block: 1 }));
        assert_eq!(reader.pair(), Next::Some(([3.0, 4.0], Span { start: 15, end: 18, block: 1 })));
    }

    #[test]
    fn a_number_beyond_any_table_is_passed_over_once_whatever_stands_before_it() {
        for number in ["99999999999", "-99999999999", " 99999999999", "  +99999999999.5", "-999999999999999999999."] {
            for numbers in [format!("{number},2"), format!("1,{number}")] {
                let text = format!("PD{numbers},3,4;PU");
                let mut reader = Reader::new(text.as_bytes());
                reader.next();
                assert!(matches!(reader.pair(), Next::Overflow(_)), "{text}");
                assert!(matches!(reader.pair(), Next::Some(([3.0, 4.0], _))), "{text}");
                assert_eq!(reader.pair(), Next::End, "{text}");
            }
        }
    }
}
