//! Writing: the result of a log, as the bytes of a target, a row of [`TARGETS`] each.

use std::io::{self, BufRead, Write};

use super::centre;
use super::chart;
use super::controller::{Command, Status};
use super::row::Row;
use super::tracked::{Needs, Tracked};
use super::verify;
use crate::ir;
use crate::machine::Tracking;
use crate::units::number::{push_fixed, push_integer};

/// Output format of a log: a row of [`TARGETS`].
pub type Target = ir::Target<Writer, Reader>;

/// Writer of a log.
#[derive(Debug)]
pub struct Writer {
    /// Knowledge that it takes.
    pub needs: Needs,
    /// Writes it.
    pub write: fn(&Tracked, &mut dyn Write) -> io::Result<()>,
}

/// Judge of written bytes, by the readings of the log: the first fault, in words.
pub type Reader = fn(&mut dyn BufRead, &[Row], &Tracking) -> io::Result<Option<String>>;

/// Every target; the first is the default.
pub const TARGETS: &[Target] = &[
    Target {
        name: "commands",
        about: "what the controller makes of each row: `t_s,i,j,status,direction,v_mm_s`",
        extension: "commands.csv",
        emit: Writer { needs: Needs::Commands, write: commands },
        proof: Some(verify::commands),
    },
    Target {
        name: "centre",
        about: "the centre line of the cloth by the place of the conveyor: `conv_mm,centre_mm`",
        extension: "centre.csv",
        emit: Writer { needs: Needs::Centre, write: |tracked, out| centre::write(&tracked.centre, out) },
        proof: None,
    },
    Target {
        name: "log",
        about: "the log, with the places of conveyor and carriage: `t_s,i,j,conv_mm,carriage_mm`",
        extension: "log.csv",
        emit: Writer { needs: Needs::Places, write: log },
        proof: None,
    },
    Target {
        name: "svg",
        about: "a picture: positions, error and speed over time",
        extension: "svg",
        emit: Writer { needs: Needs::Centre, write: chart::write },
        proof: None,
    },
];

/// Decimals of times, s, places, mm, and speeds, mm/s.
const TIME_DECIMALS: u32 = 6;
const PLACE_DECIMALS: u32 = 6;
const SPEED_DECIMALS: u32 = 3;
/// Bytes that are collected before they are written.
const BLOCK_BYTES: usize = 1 << 16;

impl Status {
    /// Name in rows.
    pub fn name(self) -> &'static str {
        match self {
            Self::Centred => "centred",
            Self::Waiting => "waiting",
            Self::Driving => "driving",
            Self::LostCovered => "lost-covered",
            Self::LostOpen => "lost-open",
            Self::Width => "width",
        }
    }
}

/// Writes rows of time with the columns that `push` adds for each sample.
fn rows(tracked: &Tracked, header: &str, out: &mut dyn Write, push: impl Fn(&mut Vec<u8>, usize)) -> io::Result<()> {
    let mut block = header.as_bytes().to_vec();
    for (i, row) in tracked.replay.rows.iter().enumerate() {
        push_fixed(&mut block, row.time, TIME_DECIMALS);
        push(&mut block, i);
        block.push(b'\n');
        if block.len() >= BLOCK_BYTES {
            out.write_all(&block)?;
            block.clear();
        }
    }
    out.write_all(&block)
}

fn push_counts(block: &mut Vec<u8>, counts: impl IntoIterator<Item = u16>) {
    for count in counts {
        block.push(b',');
        push_integer(block, count.into());
    }
}

fn commands(tracked: &Tracked, out: &mut dyn Write) -> io::Result<()> {
    rows(tracked, "t_s,i,j,status,direction,v_mm_s\n", out, |block, i| {
        let Command { status, velocity } = tracked.replay.commands[i];
        push_counts(block, tracked.replay.rows[i].covered);
        block.push(b',');
        block.extend_from_slice(status.name().as_bytes());
        block.extend_from_slice(match velocity.total_cmp(&0.0) {
            std::cmp::Ordering::Less => b",-1,",
            std::cmp::Ordering::Equal => b",0,",
            std::cmp::Ordering::Greater => b",1,",
        });
        push_fixed(block, velocity.abs(), SPEED_DECIMALS);
    })
}

fn log(tracked: &Tracked, out: &mut dyn Write) -> io::Result<()> {
    let has_upstream = tracked.replay.rows.iter().any(|row| row.upstream.is_some());
    let header = if has_upstream { "t_s,i,j,up_i,up_j,conv_mm,carriage_mm\n" } else { "t_s,i,j,conv_mm,carriage_mm\n" };
    rows(tracked, header, out, |block, i| {
        let row = &tracked.replay.rows[i];
        push_counts(block, row.covered.into_iter().chain(row.upstream.into_iter().flatten()));
        for place in [tracked.conveyor[i], tracked.carriage[i]] {
            block.push(b',');
            push_fixed(block, place, PLACE_DECIMALS);
        }
    })
}
