//! Decoders of further stitch files: PEC, alone or within PES, JEF, VP3, XXX and U01, from the descriptions of their formats.
//!
//! Y points upwards in what they return.

use super::records::{Decoded, File, Kind, Record};

/// Records so far, and the needle position, tenths of a millimetre.
#[derive(Default)]
struct Track {
    records: Vec<Record>,
    at: [i64; 2],
}

impl Track {
    fn add(&mut self, kind: Kind, x: i64, y: i64) {
        self.at = [self.at[0] + x, self.at[1] + y];
        self.records.push(Record { kind, at: self.at });
    }

    /// Corners of the box of all records: left and right, bottom and top.
    fn corners(&self) -> [[i64; 2]; 2] {
        [0, 1].map(|axis| {
            let along = || self.records.iter().map(|record| record.at[axis]);
            [along().min().unwrap_or(0), along().max().unwrap_or(0)]
        })
    }

    /// Extents to the right, left, up and down from the start.
    fn reach(&self) -> [i64; 4] {
        let far = |axis: usize, sign: i64| self.records.iter().map(|record| sign * record.at[axis]).max().unwrap_or(0);
        [far(0, 1), far(0, -1), far(1, 1), far(1, -1)].map(|reach| reach.max(0))
    }

    fn count(&self, is: impl Fn(Kind) -> bool) -> usize {
        self.records.iter().filter(|record| is(record.kind)).count()
    }

    /// Turns changes of thread into stops where `stops` is true, by their number in order.
    fn halt(&mut self, stops: impl Fn(usize) -> bool) {
        let changes = self.records.iter_mut().filter(|record| record.kind == Kind::Stop);
        changes.enumerate().filter(|(i, _)| stops(*i)).for_each(|(_, record)| record.kind = Kind::Halt);
    }

    /// Leaves out the place of the start that leads the stitches of PEC: a jump by its way from the left upper corner.
    fn without_start(self) -> Self {
        let [Record { kind: Kind::Jump, at: told }, rest @ ..] = &self.records[..] else { return self };
        let rest = rest.iter().map(|&Record { kind, at }| Record { kind, at: [at[0] - told[0], at[1] - told[1]] });
        let rest = Self { records: rest.collect(), at: [0; 2] };
        let [[left, _], [_, top]] = rest.corners();
        // Some programs leave it out.
        if !rest.records.is_empty() && *told == [-left, -top] { rest } else { self }
    }

    fn file(self) -> File {
        File { records: self.records, ..File::default() }
    }
}

fn signed(byte: u8) -> i64 {
    if byte < 128 { i64::from(byte) } else { i64::from(byte) - 256 }
}

fn integer(number: usize) -> i64 {
    i64::try_from(number).unwrap_or(i64::MAX)
}

/// A number of some bytes, the lowest first.
fn low(bytes: &[u8], at: usize, count: usize) -> Option<i64> {
    let bytes = bytes.get(at..at.checked_add(count)?)?;
    Some(bytes.iter().rev().fold(0, |sum, &byte| 256 * sum + i64::from(byte)))
}

/// A number of some bytes, the highest first.
fn high(bytes: &[u8], at: usize, count: usize) -> Option<i64> {
    let bytes = bytes.get(at..at.checked_add(count)?)?;
    Some(bytes.iter().fold(0, |sum, &byte| 256 * sum + i64::from(byte)))
}

/// Signed number of `bits` bits in two's complement.
fn with_sign(number: i64, bits: u32) -> i64 {
    if number >= 1 << (bits - 1) { number - (1 << bits) } else { number }
}

const CUT_OFF: &str = "the last record is cut off";

/// Decodes a PEC file, or the part PEC of a PES file.
pub(super) fn pec(bytes: &[u8]) -> Decoded {
    let is_alone = bytes.starts_with(b"#PEC");
    let start = if is_alone { Some(8) } else { low(bytes, 8, 4) };
    let start = usize::try_from(start.ok_or("the header is cut off")?).map_err(|_| "the part PEC is nowhere")?;
    let part = bytes.get(start..).filter(|part| part.len() >= 528).ok_or("the header is cut off")?;
    let mut track = Track::default();
    let mut at = 528;
    loop {
        match part[at..] {
            [0xFF, ..] => break,
            [0xFE, 0xB0, _, ..] => {
                track.add(Kind::Stop, 0, 0);
                at += 3;
                continue;
            }
            _ => {}
        }
        let mut flags = 0;
        let mut number = || {
            let first = *part.get(at)?;
            let (length, value) = if first < 128 {
                (1, with_sign(first.into(), 7))
            } else {
                flags |= first;
                (2, with_sign(high(part, at, 2)? % 4096, 12))
            };
            at += length;
            Some(value)
        };
        let x = number().ok_or(CUT_OFF)?;
        let y = number().ok_or(CUT_OFF)?;
        let kind = match (flags & 0x10 != 0, flags & 0x20 != 0) {
            (true, _) => Kind::Jump,
            (false, true) => Kind::Trim,
            (false, false) => Kind::Stitch,
        };
        track.add(kind, x, -y);
        if at >= part.len() {
            return Err("the end is missing".to_owned());
        }
    }
    track = track.without_start();
    let changes = track.count(|kind| kind == Kind::Stop);
    let threads = part[48].wrapping_add(1);
    let [[left, right], [bottom, top]] = track.corners();
    let told = [
        (i64::from(threads), integer(changes + 1)),
        (low(part, 514, 3).unwrap_or(0), integer(at + 1 - 512)),
        (low(part, 520, 2).unwrap_or(0), right - left),
        (low(part, 522, 2).unwrap_or(0), top - bottom),
    ];
    let wrong = told.iter().filter(|(told, is)| told != is).count() as u32;
    track.halt(|i| i + 1 < usize::from(threads) && part[49 + i] == part[50 + i]);
    // Pictures of the pattern follow: one of all and one of each thread.
    let pictures = 6 * 38 * (changes + 2);
    Ok(File { header: Some(wrong), has_more: part.len() != at + 1 + pictures, ..track.file() })
}

/// Decodes a JEF file.
pub(super) fn jef(bytes: &[u8]) -> Decoded {
    let number = |at: usize| low(bytes, at, 4).ok_or("the header is cut off");
    let (start, threads) = (number(0)? as usize, number(24)? as usize);
    let mut track = Track::default();
    let mut rest = bytes.get(start..).ok_or("the stitches are nowhere")?;
    let behind = loop {
        match *rest {
            [0x80, 0x10, ref behind @ ..] => break behind,
            [0x80, command, x, y, ref behind @ ..] => {
                let kind = match command {
                    1 => Kind::Stop,
                    // A jump that moves nothing cuts the thread.
                    2 => {
                        if [x, y] == [0, 0] {
                            Kind::Trim
                        } else {
                            Kind::Jump
                        }
                    }
                    _ => return Err(format!("command {command:02x} is none")),
                };
                track.add(kind, signed(x), signed(y));
                rest = behind;
            }
            [x, y, ref behind @ ..] if x != 0x80 => {
                track.add(Kind::Stitch, signed(x), signed(y));
                rest = behind;
            }
            _ => return Err("the end is missing".to_owned()),
        }
    };
    let thread = |i: usize| low(bytes, 116 + 4 * i, 4);
    let changes = track.count(|kind| kind == Kind::Stop);
    let [right, left, up, down] = track.reach();
    let wrong = [
        number(0)? != 116 + 8 * number(24)?,
        threads != changes + 1,
        number(28)? != integer(1 + track.records.len() + track.count(|kind| kind != Kind::Stitch)),
        [left, up, right, down].iter().zip(0..).any(|(&reach, i)| number(36 + 4 * i) != Ok(reach)),
    ];
    let wrong = wrong.into_iter().filter(|&is_wrong| is_wrong).count() as u32;
    track.halt(|i| i + 1 < threads && thread(i + 1) == Some(0));
    let has_more = !behind.is_empty();
    Ok(File { header: Some(wrong), has_more, trim_way: Some(30), ..track.file() })
}

/// Decodes a VP3 file.
pub(super) fn vp3(bytes: &[u8]) -> Decoded {
    blocks(bytes).ok_or_else(|| "a block is cut off".to_owned())?
}

/// The tree of a VP3 file; `None` if it is cut off.
fn blocks(bytes: &[u8]) -> Option<Decoded> {
    let text = |at: usize| Some(at + 2 + usize::try_from(high(bytes, at, 2)?).ok()?);
    let place = |at: usize| Some([with_sign(high(bytes, at, 4)?, 32), with_sign(high(bytes, at + 4, 4)?, 32)]);
    let design = text(text(6)? + 7)? + 32;
    let middle = place(design)?;
    let mut at = text(text(design + 8 + 27)? + 24)?;
    let count = high(bytes, at, 2)?;
    at += 2;
    let mut track = Track::default();
    let mut has_thread = false;
    for block in 0..count {
        let end = at + 7 + usize::try_from(high(bytes, at + 3, 4)?).ok()?;
        let start = place(at + 7)?;
        let to = [0, 1].map(|axis| ((middle[axis] + start[axis]) as f64 / 100.0).round() as i64);
        if block > 0 {
            track.add(Kind::Stop, 0, 0);
        }
        track.add(Kind::Jump, to[0] - track.at[0], to[1] - track.at[1]);
        let colors = usize::from(*bytes.get(at + 15)?);
        let mut next = text(text(text(at + 19 + 6 * colors)?)?)? + 18;
        while next + 1 < end {
            let (x, y) = (*bytes.get(next)?, *bytes.get(next + 1)?);
            next += 2;
            match (x, y) {
                (0x80, 1) => {
                    let [x, y] = [with_sign(high(bytes, next, 2)?, 16), with_sign(high(bytes, next + 2, 2)?, 16)];
                    next += 6;
                    // Ways that are longer, or begin without a thread, are moved with the needle up.
                    let is_move = !has_thread || x.abs().max(y.abs()) > 255;
                    track.add(if is_move { Kind::Jump } else { Kind::Stitch }, x, -y);
                    if is_move {
                        track.add(Kind::Stitch, 0, 0);
                    }
                    has_thread = true;
                }
                (0x80, 2) => {}
                (0x80, 3) => {
                    track.add(Kind::Trim, 0, 0);
                    has_thread = false;
                }
                (0x80, _) => return Some(Err(format!("command {y:02x} is none"))),
                _ => {
                    track.add(Kind::Stitch, signed(x), -signed(y));
                    has_thread = true;
                }
            }
        }
        bytes.get(..end)?;
        at = end;
    }
    Some(Ok(track.file()))
}

/// Decodes an XXX file.
pub(super) fn xxx(bytes: &[u8]) -> Decoded {
    let mut rest = bytes.get(256..).ok_or("the header is cut off")?;
    let mut track = Track::default();
    loop {
        rest = match *rest {
            [0x7F, 0x7F | 0x18, ..] => return Ok(track.file()),
            [0x7D | 0x7E, a, b, c, d, ref behind @ ..] => {
                let number = |low: u8, high: u8| i64::from(low) + 256 * signed(high);
                track.add(Kind::Jump, number(a, b), number(c, d));
                behind
            }
            [0x7F, command, x, y, ref behind @ ..] => {
                let kind = match command {
                    0x01 => Kind::Jump,
                    0x03 => Kind::Trim,
                    0x08 | 0x0A..=0x17 => Kind::Stop,
                    _ => return Err(format!("command {command:02x} is none")),
                };
                track.add(kind, signed(x), signed(y));
                behind
            }
            [x, y, ref behind @ ..] if !matches!(x, 0x7D..=0x7F) => {
                track.add(Kind::Stitch, signed(x), signed(y));
                behind
            }
            _ => return Err(CUT_OFF.to_owned()),
        };
    }
}

/// Decodes a U01 file.
pub(super) fn u01(bytes: &[u8]) -> Decoded {
    let (records, _) = bytes.get(256..).ok_or("the header is cut off")?.as_chunks::<3>();
    let mut track = Track::default();
    for &[first, y, x] in records {
        let x = i64::from(x) * if first >> 5 & 1 == 1 { -1 } else { 1 };
        let y = i64::from(y) * if first >> 6 & 1 == 1 { -1 } else { 1 };
        let kind = match first % 32 {
            0 => Kind::Stitch,
            2 | 4 if (x, y) != (0, 0) => Kind::Stitch,
            1..=5 => Kind::Jump,
            6 | 7 => Kind::Trim,
            8 => Kind::Halt,
            needle @ 9..=23 => Kind::Needle(u16::from(needle) - 8),
            24 => return Ok(track.file()),
            command => return Err(format!("command {command:02x} is none")),
        };
        track.add(kind, x, y);
    }
    Err("the end is missing".to_owned())
}
