//! Melco EXP: pairs of signed bytes, tenths of a millimetre, without a header; 0x80 begins a command.

use std::io::{self, Write};

use super::stitch_file::{Record, records};
use super::target::{Target, Writer};
use crate::machine::Job;
use crate::sew::program::Program;
use crate::sew::verify::Bytes;

pub(super) const TARGET: Target = Target {
    name: "exp",
    about: "a stitch file of Melco machines, which have their own speeds",
    extension: "exp",
    emit: Writer::of_all(write),
    proof: Some(Bytes::Exp),
};

/// The longest move of a record, tenths of a millimetre: -128 is the byte that begins commands.
const LONGEST: i64 = 127;
/// Commands, before their move.
const JUMP: [u8; 2] = [0x80, 0x04];
const STOP: [u8; 2] = [0x80, 0x01];
/// Thread cut, with the filler that machines expect.
const TRIM: [u8; 4] = [0x80, 0x80, 0x07, 0x00];

fn write(program: &Program, _: &Job, out: &mut dyn Write) -> io::Result<()> {
    let mut body: Vec<u8> = Vec::with_capacity(2 * program.stitches.steps.len() + 64);
    records(program, LONGEST, |kind, way| {
        let bytes = way.map(|way| i8::try_from(way).expect("a record is no longer than its bytes").cast_unsigned());
        match kind {
            Record::Stitch => body.extend_from_slice(&bytes),
            Record::Jump => body.extend(JUMP.into_iter().chain(bytes)),
            Record::Trim => body.extend_from_slice(&TRIM),
            Record::Stop | Record::Thread(_) => body.extend(STOP.into_iter().chain(bytes)),
        }
    });
    out.write_all(&body)
}
