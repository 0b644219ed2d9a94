//! The verifier of sewn patterns: checks the motions of needle, cloth and motors, as decoded from the bytes.
//!
//! Receives the bytes of a program, the required stitches, the pattern and the profile. Shares no code with the modules that
//! lay, plan and write: it counts pulses, measures intervals and decodes records itself. Never repairs anything.

mod clock;
mod curve;
mod decoders;
mod events;
mod ground;
mod laid;
mod order;
mod original;
mod placed;
mod pulse_records;
mod pulse_rows;
mod pulses;
mod queue;
mod records;
mod rules;
mod satin;
mod spindle;
mod stitch_file;

pub use ground::{Ground, Original};
pub use rules::RULES;

use std::io::{self, BufRead};

use crate::ir::Finding;
use crate::ir::verdict::{Verdict, WorstByRule};
use crate::units::columns::Unread;

/// Kind of the bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bytes {
    /// Pulses as rows of text.
    PulseRows,
    /// Pulses as records of an array.
    PulseRecords,
    /// Entries of a queue as rows of text.
    QueueRows,
    /// Entries of a queue as JSON.
    QueueJson,
    /// A DST file.
    Dst,
    /// An EXP file.
    Exp,
    /// A PES file.
    Pes,
    /// A JEF file.
    Jef,
}

/// Verifies a program from its bytes.
pub fn judge(input: &mut dyn BufRead, bytes: Bytes, ground: &Ground) -> io::Result<Verdict> {
    let mut worst = WorstByRule::default();
    laid::judge(ground, &mut worst);
    original::judge(ground, &mut worst);
    placed::judge(ground, &mut worst);
    if let Some(drawn) = ground.drawn {
        curve::judge(drawn, ground.profile.tolerance(0.0), &mut worst);
    }
    let read = match bytes {
        Bytes::PulseRows => {
            pulses::judge(|each| pulse_rows::read(input, each), pulse_rows::TICK_US, ground, &mut worst)
        }
        Bytes::PulseRecords => {
            pulses::judge(|each| pulse_records::read(input, each), pulse_records::TICK_US, ground, &mut worst)
        }
        Bytes::QueueRows => queue::judge(input, queue::ROWS, ground, &mut worst),
        Bytes::QueueJson => queue::judge(input, queue::JSON, ground, &mut worst),
        Bytes::Dst => stitch_file::judge(input, records::dst, ground, &mut worst),
        Bytes::Exp => stitch_file::judge(input, records::exp, ground, &mut worst),
        Bytes::Pes => stitch_file::judge(input, decoders::pec, ground, &mut worst),
        Bytes::Jef => stitch_file::judge(input, decoders::jef, ground, &mut worst),
    };
    let unread = match read {
        Ok(()) => None,
        Err(Unread::Io(error)) => return Err(error),
        Err(Unread::Row(message)) => Some(message),
    };
    worst.see(&rules::FORMAT, f64::from(u8::from(unread.is_some())), None);
    let limited = |finding: Finding| Finding { limit: Some(rules::limit(finding.rule, ground.sewing)), ..finding };
    let findings = worst.findings().into_iter().map(limited).collect();
    Ok(Verdict { findings, unread, ..Verdict::default() })
}
