//! Entries of the queue from which the motion part takes its stitches: rows of text, or JSON a line each.
//!
//! Increments are multiples of the step to four decimals: whoever divides them by it and rounds has the pulses, and no sum
//! of these drifts away.

use std::io::{self, Write};

use super::target::{Proof, Target, nothing};
use crate::machine::Job;
use crate::sew::program::Program;
use crate::sew::stitches::Op;
use crate::units::number::{push_fixed, push_integer};

pub(super) const ROWS: Target = Target {
    name: "queue",
    about: "entries of a stitch queue: `op,dx_mm,dy_mm,value`, STITCH, JUMP, TRIM, STOP, COLOR, SPEED, END",
    extension: "queue.csv",
    refusals: nothing,
    write: |program, job, out| write(program, job, out, push_row, b"op,dx_mm,dy_mm,value\n"),
    proof: Proof::QueueRows,
};

pub(super) const JSON: Target = Target {
    name: "jsonl",
    about: "the same entries as JSON, a line each",
    extension: "queue.jsonl",
    refusals: nothing,
    write: |program, job, out| write(program, job, out, push_json, b""),
    proof: Proof::QueueJson,
};

/// Decimals of increments, mm: a tenth of the finest step.
const DECIMALS: u32 = 4;
/// Their unit, in a millimetre.
const PER_MM: f64 = 1e4;
/// Bytes that are collected before they are written.
const BLOCK_BYTES: usize = 1 << 16;

/// An entry as it is written.
#[derive(Clone, Copy)]
enum Entry {
    /// Its word and increments, in units of the last decimal.
    Way(&'static str, [f64; 2]),
    /// Its word and value.
    Value(&'static str, u64),
    /// Its word alone.
    Word(&'static str),
}

fn write(
    program: &Program,
    job: &Job,
    out: &mut dyn Write,
    push: fn(&mut Vec<u8>, Entry),
    head: &[u8],
) -> io::Result<()> {
    let mut block = head.to_vec();
    let step = job.profile.sewing.step_mm;
    let (mut speed, mut steps, mut written) = (0.0, [0_i64; 2], [0.0; 2]);
    for entry in program.moves(job) {
        if entry.rpm > 0.0 && entry.rpm != speed {
            speed = entry.rpm;
            push(&mut block, Entry::Value("SPEED", speed as u64));
        }
        steps = [steps[0] + entry.pulses[0], steps[1] + entry.pulses[1]];
        let now = steps.map(|steps| (steps as f64 * step * PER_MM).round());
        let way = [now[0] - written[0], now[1] - written[1]];
        written = now;
        push(
            &mut block,
            match entry.step.op {
                Op::Stitch => Entry::Way("STITCH", way),
                Op::Jump => Entry::Way("JUMP", way),
                Op::Trim => Entry::Word("TRIM"),
                Op::Stop => Entry::Word("STOP"),
                Op::Color(thread) => Entry::Value("COLOR", thread.into()),
            },
        );
        if block.len() >= BLOCK_BYTES {
            out.write_all(&block)?;
            block.clear();
        }
    }
    push(&mut block, Entry::Word("END"));
    out.write_all(&block)
}

fn push_row(block: &mut Vec<u8>, entry: Entry) {
    match entry {
        Entry::Way(word, [dx, dy]) => {
            block.extend_from_slice(word.as_bytes());
            block.push(b',');
            push_fixed(block, dx / PER_MM, DECIMALS);
            block.push(b',');
            push_fixed(block, dy / PER_MM, DECIMALS);
            block.push(b',');
        }
        Entry::Value(word, value) => {
            block.extend_from_slice(word.as_bytes());
            block.extend_from_slice(b",,,");
            push_integer(block, value);
        }
        Entry::Word(word) => {
            block.extend_from_slice(word.as_bytes());
            block.extend_from_slice(b",,,");
        }
    }
    block.push(b'\n');
}

fn push_json(block: &mut Vec<u8>, entry: Entry) {
    block.extend_from_slice(b"{\"op\":\"");
    match entry {
        Entry::Way(word, [dx, dy]) => {
            block.extend_from_slice(word.as_bytes());
            block.extend_from_slice(b"\",\"dx_mm\":");
            push_fixed(block, dx / PER_MM, DECIMALS);
            block.extend_from_slice(b",\"dy_mm\":");
            push_fixed(block, dy / PER_MM, DECIMALS);
        }
        Entry::Value(word, value) => {
            block.extend_from_slice(word.as_bytes());
            block.extend_from_slice(b"\",\"value\":");
            push_integer(block, value);
        }
        Entry::Word(word) => {
            block.extend_from_slice(word.as_bytes());
            block.push(b'"');
        }
    }
    block.extend_from_slice(b"}\n");
}
