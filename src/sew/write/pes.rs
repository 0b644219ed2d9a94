//! Brother PES: a short header, and the part PEC, which machines sew: a table of threads, then pairs of numbers, tenths of a
//! millimetre, Y downwards.
//!
//! The part that embroidery programs edit is left empty, and so are the pictures of the threads. Two threads of the same number
//! in a row stand for a stop.

use std::io::{self, Write};

use super::stitch_file::{Record, records};
use super::target::{Target, Writer};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::machine::Job;
use crate::sew::program::Program;
use crate::sew::verify::Bytes;

pub(super) const TARGET: Target = Target {
    name: "pes",
    about: "a stitch file of Brother machines, which have their own speeds",
    extension: "pes",
    emit: Writer { refusals, write },
    proof: Some(Bytes::Pes),
};

/// Mark of the version, the offset of the part PEC, and nothing to edit.
const HEAD: &[u8; 22] = b"#PES0001\x16\0\0\0\0\0\0\0\0\0\0\0\0\0";
/// Longest move of a record, tenths of a millimetre: twelve bits.
const LONGEST: i64 = 2047;
/// Greatest number of threads in the table.
const MOST_THREADS: i64 = 255;
/// Threads that machines know, from number 1.
const THREADS: u16 = 64;
/// Room of the table of threads, with the number of changes before it.
const TABLE_BYTES: usize = 464;
/// Size of a picture: bytes a row, and rows.
const PICTURE: [u8; 2] = [6, 38];
/// Flags of a number in its long form.
const LONG: u16 = 0x8000;
const JUMP: u16 = 0x1000;
const TRIM: u16 = 0x2000;
const NEXT_THREAD: [u8; 2] = [0xFE, 0xB0];
const END: u8 = 0xFF;

/// Records of a program.
struct Body {
    bytes: Vec<u8>,
    threads: Vec<u8>,
    /// End of the last record, tenths of a millimetre.
    at: [i64; 2],
    /// Box of all ends: left and bottom, right and top.
    least: [i64; 2],
    most: [i64; 2],
    /// True if the next move begins with a cut of the thread.
    is_cut: bool,
}

impl Body {
    fn of(program: &Program) -> Self {
        let (least, most) = ([i64::MAX; 2], [i64::MIN; 2]);
        let mut body = Self { bytes: Vec::new(), threads: vec![1], at: [0; 2], least, most, is_cut: false };
        records(program, LONGEST, |kind, way| body.add(kind, way));
        body.cut();
        body.bytes.push(END);
        body
    }

    fn add(&mut self, kind: Record, way: [i64; 2]) {
        for (axis, way) in way.into_iter().enumerate() {
            self.at[axis] += way;
            self.least[axis] = self.least[axis].min(self.at[axis]);
            self.most[axis] = self.most[axis].max(self.at[axis]);
        }
        match kind {
            Record::Trim => self.is_cut = true,
            Record::Jump => {
                let flag = if std::mem::take(&mut self.is_cut) { TRIM } else { JUMP };
                self.pair(way, Some(flag));
            }
            Record::Stitch => {
                self.cut();
                self.pair(way, None);
            }
            Record::Stop | Record::Thread(_) => {
                self.cut();
                if way != [0, 0] {
                    self.pair(way, Some(JUMP));
                }
                let last = self.threads[self.threads.len() - 1];
                let next =
                    if let Record::Thread(thread) = kind { ((thread.max(1) - 1) % THREADS + 1) as u8 } else { last };
                self.bytes.extend(NEXT_THREAD);
                // Machines expect 2 and 1 in turns.
                self.bytes.push(if self.threads.len() % 2 == 1 { 2 } else { 1 });
                self.threads.push(next);
            }
        }
    }

    /// Cuts the thread, if it is to be cut and no move has come since.
    fn cut(&mut self) {
        if std::mem::take(&mut self.is_cut) {
            self.pair([0, 0], Some(TRIM));
        }
    }

    /// Place of the start, as the way from the left upper corner.
    fn start(&self) -> [i64; 2] {
        [-self.least[0], -self.most[1]]
    }

    fn size(&self) -> [i64; 2] {
        [0, 1].map(|axis| self.most[axis] - self.least[axis])
    }

    /// Adds the numbers of a move, in the long form if they have a flag.
    fn pair(&mut self, [x, y]: [i64; 2], flag: Option<u16>) {
        for value in [x, -y] {
            match flag {
                None if (-64..64).contains(&value) => self.bytes.push(value as u8 & 0x7F),
                _ => self.bytes.extend(long(value, flag.unwrap_or(0)).to_be_bytes()),
            }
        }
    }
}

/// A number in its long form.
fn long(value: i64, flag: u16) -> u16 {
    (value as u16 & 0x0FFF) | LONG | flag
}

fn refusals(program: &Program, _: &Job, out: &mut Diagnostics) {
    let body = Body::of(program);
    let far = body.start().map(i64::abs).into_iter().max().unwrap_or(0);
    let size = body.size().into_iter().max().unwrap_or(0);
    for (what, value, most, hint) in [
        (
            "threads and stops",
            i64::try_from(body.threads.len()).unwrap_or(i64::MAX),
            MOST_THREADS,
            "sew it in parts, or write DST",
        ),
        ("tenths of a millimetre to its corner", far, LONGEST, "`--set sheet.origin=corner` moves it to the start"),
        ("tenths of a millimetre of its size", size, u16::MAX.into(), "sew it in parts, or write DST"),
    ] {
        if value > most {
            let message = format!("a PES file has room for {most} {what}, and the pattern has {value}");
            out.push(Diagnostic::new(&code::TARGET_REFUSED, message).hint(hint));
        }
    }
}

fn write(program: &Program, _: &Job, out: &mut dyn Write) -> io::Result<()> {
    let body = Body::of(program);
    let mut head = HEAD.to_vec();
    head.extend(format!("LA:{:<16}\r{:12}", "cutc", "").bytes());
    head.extend([0xFF, 0x00]);
    head.extend(PICTURE);
    head.extend([b' '; 12]);
    let mut table = vec![(body.threads.len() - 1) as u8];
    table.extend(&body.threads);
    table.resize(TABLE_BYTES, b' ');
    head.extend(table);
    // The length from here on, then the size and two numbers that all files have.
    head.extend([0, 0]);
    let length = body.bytes.len() + 20;
    head.extend(&(length as u32).to_le_bytes()[..3]);
    head.extend([0x31, 0xFF, 0xF0]);
    let [width, height] = body.size();
    for number in [width, height, 0x1E0, 0x1B0] {
        head.extend((number as u16).to_le_bytes());
    }
    let [x, y] = body.start();
    for number in [x, -y] {
        head.extend(long(number, JUMP).to_be_bytes());
    }
    out.write_all(&head)?;
    out.write_all(&body.bytes)?;
    let picture = usize::from(PICTURE[0]) * usize::from(PICTURE[1]);
    out.write_all(&vec![0; picture * (body.threads.len() + 1)])
}
