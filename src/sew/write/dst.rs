//! Tajima DST: a header of 512 bytes, then records of three bytes.
//!
//! A coordinate is a sum of 81, 27, 9, 3 and 1 with signs (balanced ternary), in tenths of a millimetre. A trim is three
//! jumps that come back to where they began; a stop and another thread are one and the same.

use std::io::{self, Write};

use super::stitch_file::{Extents, Record, records, told_cuts};
use super::target::{Target, Writer};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::machine::Job;
use crate::sew::program::Program;
use crate::sew::verify::Bytes;

pub(super) const TARGET: Target = Target {
    name: "dst",
    about: "a stitch file of Tajima machines, which have their own speeds",
    extension: "dst",
    emit: Writer { refusals, write },
    proof: Some(Bytes::Dst),
};

const HEADER_BYTES: usize = 512;
/// The longest move of a record, tenths of a millimetre: 81 + 27 + 9 + 3 + 1.
const LONGEST: i64 = 121;
const END: [u8; 3] = [0x00, 0x00, 0xF3];
const STITCH: u8 = 0x03;
const JUMP: u8 = 0x83;
const STOP: u8 = 0xC3;
/// Moves of the jumps that make a trim; none changes the place.
const TRIM_WAYS: [[i64; 2]; 3] = [[2, 2], [-4, -4], [2, 2]];

/// Weights, each with the byte and the bits for +x, -x, +y, -y.
const WEIGHTS: [(i64, usize, [u8; 4]); 5] = [
    (81, 2, [0x04, 0x08, 0x20, 0x10]),
    (27, 1, [0x04, 0x08, 0x20, 0x10]),
    (9, 0, [0x04, 0x08, 0x20, 0x10]),
    (3, 1, [0x01, 0x02, 0x80, 0x40]),
    (1, 0, [0x01, 0x02, 0x80, 0x40]),
];

/// A record of a move, with the flags of its last byte.
fn record([mut x, mut y]: [i64; 2], kind: u8) -> [u8; 3] {
    let mut bytes = [0, 0, kind];
    for (weight, byte, [x_up, x_down, y_up, y_down]) in WEIGHTS {
        // A remainder beyond the smaller weights needs this one.
        for (left, up, down) in [(&mut x, x_up, x_down), (&mut y, y_up, y_down)] {
            if *left > weight / 2 {
                bytes[byte] |= up;
                *left -= weight;
            } else if *left < -(weight / 2) {
                bytes[byte] |= down;
                *left += weight;
            }
        }
    }
    bytes
}

/// Totals of the records of a program.
#[derive(Debug, Default)]
struct Sums {
    records: i64,
    stops: i64,
    extents: Extents,
}

/// Writes each record, and returns their totals.
fn encode(program: &Program, mut put: impl FnMut([u8; 3])) -> Sums {
    let mut sums = Sums::default();
    records(program, LONGEST, |kind, way| {
        let mut move_by = |way: [i64; 2], kind: u8| {
            put(record(way, kind));
            sums.records += 1;
            sums.extents.add(way);
        };
        match kind {
            Record::Stitch => move_by(way, STITCH),
            Record::Jump => move_by(way, JUMP),
            Record::Trim => TRIM_WAYS.into_iter().for_each(|way| move_by(way, JUMP)),
            Record::Stop | Record::Thread(_) => {
                move_by(way, STOP);
                sums.stops += 1;
            }
        }
    });
    sums
}

fn refusals(program: &Program, _: &Job, out: &mut Diagnostics) {
    let sums = encode(program, |_| {});
    let reach = sums.extents.reach.into_iter().max().unwrap_or(0);
    for (what, value, digits) in
        [("records", sums.records, 7), ("stops", sums.stops, 3), ("tenths of a millimetre from the start", reach, 5)]
    {
        let most = 10_i64.pow(digits) - 1;
        if value > most {
            let message = format!("the header of a DST file has room for {most} {what}, and the pattern has {value}");
            let hint = "sew it in parts, or write EXP, which has no header";
            out.push(Diagnostic::new(&code::TARGET_REFUSED, message).hint(hint));
        }
    }
    let rule = format!("{} jumps or more", TRIM_WAYS.len());
    told_cuts(program, LONGEST, (&rule, "a DST"), |(jumps, _)| jumps >= TRIM_WAYS.len(), out);
}

fn write(program: &Program, _: &Job, out: &mut dyn Write) -> io::Result<()> {
    let mut body: Vec<u8> = Vec::with_capacity(3 * program.stitches.steps.len() + 64);
    let sums = encode(program, |record| body.extend_from_slice(&record));
    body.extend_from_slice(&END);
    out.write_all(&header(&sums))?;
    out.write_all(&body)
}

/// The header: number of records and stops, and extent of the pattern from its start, tenths of a millimetre.
fn header(sums: &Sums) -> Vec<u8> {
    let Sums { records, stops, extents: Extents { at, reach: [right, left, up, down] } } = sums;
    let signed = |value: i64| format!("{}{:5}", if value < 0 { '-' } else { '+' }, value.abs());
    let text = format!(
        "LA:{:<16}\rST:{records:7}\rCO:{stops:3}\r+X:{right:5}\r-X:{left:5}\r+Y:{up:5}\r-Y:{down:5}\rAX:{}\rAY:{}\rMX:{}\rMY:{}\rPD:******\r\u{1a}",
        "cutc",
        signed(at[0]),
        signed(at[1]),
        signed(0),
        signed(0),
    );
    let mut bytes = text.into_bytes();
    bytes.resize(HEADER_BYTES, b' ');
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_are_those_of_machines() {
        assert_eq!(record([25, 0], STITCH), [0x01, 0x06, 0x03]);
        assert_eq!(record([30, 0], STITCH), [0x00, 0x05, 0x03]);
        assert_eq!(record([-25, 30], STITCH), [0x02, 0xa9, 0x03]);
        assert_eq!(record([121, -121], STITCH), [0x55, 0x55, 0x17]);
        assert_eq!(TRIM_WAYS.iter().fold([0, 0], |at, way| [at[0] + way[0], at[1] + way[1]]), [0, 0]);
    }
}
