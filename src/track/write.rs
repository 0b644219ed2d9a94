//! Writing: what a log came to, as the bytes of a target, a row of [`TARGETS`] each.

use std::io::{self, Write};

use super::centre;
use super::chart;
use super::controller::{Command, Status};
use super::tracked::{Needs, Tracked};
use crate::units::number::{push_fixed, push_integer};

/// What is written of a log: a row of [`TARGETS`].
#[derive(Debug)]
pub struct Target {
    /// Name, as `-t` takes it.
    pub name: &'static str,
    /// What it is, in a line.
    pub about: &'static str,
    /// What its files end in, without the first dot.
    pub extension: &'static str,
    /// What must be known for it.
    pub needs: Needs,
    /// Whether it is read back and judged before it takes its place.
    pub is_judged: bool,
    /// Writes it.
    pub write: fn(&Tracked, &mut dyn Write) -> io::Result<()>,
}

/// Every target; the first is the default.
pub const TARGETS: &[Target] = &[
    Target {
        name: "commands",
        about: "what the controller makes of each row: `t_s,i,j,status,direction,v_mm_s`",
        extension: "commands.csv",
        needs: Needs::Commands,
        is_judged: true,
        write: commands,
    },
    Target {
        name: "centre",
        about: "the centre line of the cloth by the place of the conveyor: `conv_mm,centre_mm`",
        extension: "centre.csv",
        needs: Needs::Centre,
        is_judged: false,
        write: |tracked, out| centre::write(&tracked.centre, out),
    },
    Target {
        name: "log",
        about: "the log, with the places of conveyor and carriage: `t_s,i,j,conv_mm,carriage_mm`",
        extension: "log.csv",
        needs: Needs::Places,
        is_judged: false,
        write: log,
    },
    Target {
        name: "svg",
        about: "a picture: positions, error and speed over time",
        extension: "svg",
        needs: Needs::Centre,
        is_judged: false,
        write: chart::write,
    },
];

/// Decimals of times, s, places, mm, and speeds, mm/s.
const TIME_DECIMALS: u32 = 6;
const PLACE_DECIMALS: u32 = 6;
const SPEED_DECIMALS: u32 = 3;
/// Bytes that are collected before they are written.
const BLOCK_BYTES: usize = 1 << 16;

impl Status {
    /// As rows have it.
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

/// Rows of time, and what is pushed behind it of each sample.
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
