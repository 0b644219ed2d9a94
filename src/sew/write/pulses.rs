//! Every pulse of X and Y: rows of text, or records of a `NumPy` array.
//!
//! Times count from the moment at which the spindle passes the angle where the window begins, which its encoder tells; of
//! an entry with the needle up (speed 0) from its own start. An entry without pulses has one row, in which nothing moves.

use std::io::{self, Write};

use super::target::{Target, Writer};
use crate::machine::{Job, Sewing};
use crate::sew::program::{Move, Program};
use crate::sew::stitches::Op;
use crate::sew::verify::Bytes;
use crate::units::US_PER_S;
use crate::units::array::header;
use crate::units::number::{push_fixed, push_integer};

pub(super) const ROWS: Target = Target {
    name: "pulses",
    about: "every pulse of X and Y, timed from where the window of its stitch begins, a row each",
    extension: "pulses.csv",
    emit: Writer::of_all(rows),
    proof: Some(Bytes::PulseRows),
};

pub(super) const RECORDS: Target = Target {
    name: "pulses-npy",
    about: "the same as a NumPy array of records, unrounded",
    extension: "pulses.npy",
    emit: Writer::of_all(records),
    proof: Some(Bytes::PulseRecords),
};

/// Decimals of times, microseconds.
const DECIMALS: u32 = 3;
/// Bytes that are collected before they are written.
const BLOCK_BYTES: usize = 1 << 16;
/// Names and types of the fields of a record.
const FIELDS: &str = "('t_us', '<f8'), ('entry', '<u4'), ('rpm', '<u2'), ('thread', '<u2'), ('op', '|u1'), \
                      ('x', '|i1'), ('y', '|i1')";

/// A row: the time in microseconds, and the pulse of X and of Y, of which one is 0.
type Pulse = (f64, [i8; 2]);

/// The pulses of an entry in the order of their times, X before Y.
fn merged(entry: &Move, sewing: &Sewing) -> impl Iterator<Item = Pulse> + use<> {
    let [x, y] = entry.trains(sewing);
    let [sign_x, sign_y] = entry.pulses.map(|pulses| pulses.signum() as i8);
    let still = (x.pulses() + y.pulses() == 0).then_some((0.0, [0, 0]));
    let mut xs = x.times().map(|time| time * US_PER_S).peekable();
    let mut ys = y.times().map(|time| time * US_PER_S).peekable();
    let next = move || match (xs.peek().copied(), ys.peek().copied()) {
        (Some(x), Some(y)) if y < x => ys.next().map(|time| (time, [0, sign_y])),
        (Some(_), _) => xs.next().map(|time| (time, [sign_x, 0])),
        (None, _) => ys.next().map(|time| (time, [0, sign_y])),
    };
    std::iter::from_fn(next).chain(still)
}

/// The number of an operation in records, its word in rows.
fn op(op: Op) -> (u8, &'static [u8]) {
    match op {
        Op::Stitch => (0, b"STITCH"),
        Op::Jump => (1, b"JUMP"),
        Op::Trim => (2, b"TRIM"),
        Op::Stop => (3, b"STOP"),
        Op::Color(_) => (4, b"COLOR"),
    }
}

/// Writes all pulses, an entry at a time.
fn each(
    program: &Program,
    job: &Job,
    out: &mut dyn Write,
    push: fn(&mut Vec<u8>, &Move, u16, Pulse),
) -> io::Result<()> {
    let sewing = &job.profile.sewing;
    let (mut block, mut thread) = (Vec::with_capacity(2 * BLOCK_BYTES), 1);
    for entry in program.moves(job) {
        if let Op::Color(number) = entry.step.op {
            thread = number;
        }
        for pulse in merged(&entry, sewing) {
            push(&mut block, &entry, thread, pulse);
            // A jump may have more pulses than memory should hold.
            if block.len() >= BLOCK_BYTES {
                out.write_all(&block)?;
                block.clear();
            }
        }
    }
    out.write_all(&block)
}

fn rows(program: &Program, job: &Job, out: &mut dyn Write) -> io::Result<()> {
    out.write_all(b"entry,op,rpm,thread,t_us,x,y\n")?;
    each(program, job, out, |block, entry, thread, (time, [x, y])| {
        push_integer(block, entry.entry.into());
        block.push(b',');
        block.extend_from_slice(op(entry.step.op).1);
        block.push(b',');
        push_integer(block, entry.rpm as u64);
        block.push(b',');
        push_integer(block, thread.into());
        block.push(b',');
        push_fixed(block, time, DECIMALS);
        for pulse in [x, y] {
            block.extend_from_slice(match pulse {
                1 => b",1",
                -1 => b",-1",
                _ => b",0",
            });
        }
        block.push(b'\n');
    })
}

fn records(program: &Program, job: &Job, out: &mut dyn Write) -> io::Result<()> {
    let rows = |pulses: [i64; 2]| pulses.iter().map(|pulses| pulses.unsigned_abs()).sum::<u64>().max(1);
    out.write_all(&header(FIELDS, program.moves(job).map(|entry| rows(entry.pulses)).sum()))?;
    each(program, job, out, |block, entry, thread, (time, [x, y])| {
        block.extend_from_slice(&time.to_le_bytes());
        block.extend_from_slice(&entry.entry.to_le_bytes());
        block.extend_from_slice(&(entry.rpm as u16).to_le_bytes());
        block.extend_from_slice(&thread.to_le_bytes());
        block.extend_from_slice(&[op(entry.step.op).0, x.cast_unsigned(), y.cast_unsigned()]);
    })
}
