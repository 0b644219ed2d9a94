//! The verifier of a head at a distance: judges from the bytes where the head is, which way it looks and what it sprays.
//!
//! Receives the bytes of a program, the marker as read and the profile. Shares no code with what offsets, times and fits: it
//! measures from the chords as drawn. Never repairs anything.

mod axes;
mod coat;
mod dwell;
mod ground;
mod jet;
mod rows;
mod rules;
mod worst;

pub use ground::Ground;
pub use rules::{RULES, Row, Rule, rule};

use std::io::{self, BufRead};

use self::jet::Jet;
use self::worst::Worst;
use crate::ir::Finding;
use crate::machine::Job;

/// What a program is worth.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// The worst value under each rule that says something of it, in the order of [`RULES`].
    pub findings: Vec<Finding>,
    /// What cannot be read, when something cannot: then nothing else is said.
    pub unread: Option<String>,
}

/// Whether bytes begin as a program of a head does.
pub fn begins(bytes: &[u8]) -> bool {
    bytes.starts_with(rows::HEADER.as_bytes())
}

/// Judges a program from its bytes.
pub fn judge(input: &mut dyn BufRead, ground: &Ground, job: &Job) -> io::Result<Verdict> {
    let mut worst = Worst::default();
    let read = rows::read(input)?;
    worst.see(Rule::Format, f64::from(u8::from(read.is_err())), Some(0.0), None);
    let unread = match read {
        Ok(rows) => {
            axes::judge(&rows, job, &mut worst);
            Jet::new(&rows, ground, job).judge(&mut worst);
            None
        }
        Err(unread) => Some(unread),
    };
    Ok(Verdict { findings: worst.findings(), unread })
}
