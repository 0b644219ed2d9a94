//! Verifier of a head at a distance: checks from the emitted bytes where the head is, which way it points and what it sprays.
//!
//! Input: the bytes of a program, the marker as read, and the profile. It shares no code with offsetting, timing and fitting:
//! it measures from the chords as drawn. Nothing is repaired.

mod axes;
mod coat;
mod dwell;
mod ground;
mod jet;
mod rows;
pub(crate) mod rules;

pub use ground::Ground;
pub use rules::RULES;

use std::io::{self, BufRead};

use self::jet::Jet;
use crate::ir::verdict::{Verdict, WorstByRule};
use crate::machine::Job;
use crate::units::columns::Unread;

/// True if bytes begin like a program of a head.
pub fn begins(bytes: &[u8]) -> bool {
    bytes.starts_with(rows::HEADER.as_bytes())
}

/// Verifies a program from its bytes.
pub fn judge(input: &mut dyn BufRead, ground: &Ground, job: &Job) -> io::Result<Verdict> {
    let mut worst = WorstByRule::default();
    let read = rows::read(input);
    worst.see_under(&rules::FORMAT, f64::from(u8::from(read.is_err())), 0.0, None);
    let unread = match read {
        Ok(rows) => {
            axes::judge(&rows, job, &mut worst);
            Jet::new(&rows, ground, job).judge(&mut worst);
            None
        }
        Err(Unread::Io(error)) => return Err(error),
        Err(Unread::Row(what)) => Some(what),
    };
    Ok(Verdict { findings: worst.findings(), unread, ..Verdict::default() })
}
