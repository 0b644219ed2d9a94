//! Entries of the queue from which the motion part takes its stitches: rows of text, or JSON a line each.
//!
//! Increments are multiples of the step to four decimals: divided by the step and rounded they are the pulses, and their sums
//! do not drift.

use std::io::{self, Write};

use super::target::{Target, Writer};
use crate::machine::Job;
use crate::sew::program::Program;
use crate::sew::stitches::Op;
use crate::sew::verify::Bytes;
use crate::units::number::{push_fixed, push_integer};

pub(super) const ROWS: Target = Target {
    name: "queue",
    about: "entries of a stitch queue: `op,dx_mm,dy_mm,value`, STITCH, JUMP, TRIM, STOP, COLOR, SPEED, END",
    extension: "queue.csv",
    emit: Writer::of_all(|program, job, out| write(program, job, out, &AS_ROWS)),
    proof: Some(Bytes::QueueRows),
};

pub(super) const JSON: Target = Target {
    name: "jsonl",
    about: "the same entries as JSON, a line each",
    extension: "queue.jsonl",
    emit: Writer::of_all(|program, job, out| write(program, job, out, &AS_JSON)),
    proof: Some(Bytes::QueueJson),
};

const AS_ROWS: Form = Form { head: b"op,dx_mm,dy_mm,value\n", push: push_row };
const AS_JSON: Form = Form { head: b"", push: push_json };

/// Decimals of increments, mm: a tenth of the finest step.
const DECIMALS: u32 = 4;
/// Their unit, in a millimetre.
const PER_MM: f64 = 1e4;
/// Bytes that are collected before they are written.
const BLOCK_BYTES: usize = 1 << 16;

/// An entry as it is written.
#[derive(Clone, Copy)]
struct Entry {
    word: &'static str,
    /// Increments, in units of the last decimal.
    way: Option<[f64; 2]>,
    value: Option<u64>,
}

impl Entry {
    fn word(word: &'static str) -> Self {
        Self { word, way: None, value: None }
    }

    fn way(word: &'static str, way: [f64; 2]) -> Self {
        Self { way: Some(way), ..Self::word(word) }
    }

    fn value(word: &'static str, value: u64) -> Self {
        Self { value: Some(value), ..Self::word(word) }
    }
}

/// Format of a queue.
struct Form {
    head: &'static [u8],
    push: fn(&mut Vec<u8>, Entry),
}

fn write(program: &Program, job: &Job, out: &mut dyn Write, form: &Form) -> io::Result<()> {
    let mut block = form.head.to_vec();
    let step = job.profile.sewing.step_mm;
    let (mut speed, mut steps, mut written) = (0.0, [0_i64; 2], [0.0; 2]);
    for entry in program.moves(job) {
        if entry.rpm > 0.0 && entry.rpm != speed {
            speed = entry.rpm;
            (form.push)(&mut block, Entry::value("SPEED", speed as u64));
        }
        steps = [steps[0] + entry.pulses[0], steps[1] + entry.pulses[1]];
        let now = steps.map(|steps| (steps as f64 * step * PER_MM).round());
        let way = [now[0] - written[0], now[1] - written[1]];
        written = now;
        let entry = match entry.step.op {
            Op::Stitch => Entry::way("STITCH", way),
            Op::Jump => Entry::way("JUMP", way),
            Op::Trim => Entry::word("TRIM"),
            Op::Stop => Entry::word("STOP"),
            Op::Color(thread) => Entry::value("COLOR", thread.into()),
        };
        (form.push)(&mut block, entry);
        if block.len() >= BLOCK_BYTES {
            out.write_all(&block)?;
            block.clear();
        }
    }
    (form.push)(&mut block, Entry::word("END"));
    out.write_all(&block)
}

fn push_row(block: &mut Vec<u8>, Entry { word, way, value }: Entry) {
    block.extend_from_slice(word.as_bytes());
    for axis in 0..2 {
        block.push(b',');
        if let Some(way) = way {
            push_fixed(block, way[axis] / PER_MM, DECIMALS);
        }
    }
    block.push(b',');
    if let Some(value) = value {
        push_integer(block, value);
    }
    block.push(b'\n');
}

fn push_json(block: &mut Vec<u8>, Entry { word, way, value }: Entry) {
    block.extend_from_slice(b"{\"op\":\"");
    block.extend_from_slice(word.as_bytes());
    block.push(b'"');
    if let Some([dx, dy]) = way {
        block.extend_from_slice(b",\"dx_mm\":");
        push_fixed(block, dx / PER_MM, DECIMALS);
        block.extend_from_slice(b",\"dy_mm\":");
        push_fixed(block, dy / PER_MM, DECIMALS);
    }
    if let Some(value) = value {
        block.extend_from_slice(b",\"value\":");
        push_integer(block, value);
    }
    block.extend_from_slice(b"}\n");
}
