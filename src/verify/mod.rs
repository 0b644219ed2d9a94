//! Verification: the emitted bytes are read back and checked against the marker and the profile.
//!
//! Input: bytes, the final marker and the profile. Output: a verdict with the worst value of every rule, whether the rule holds
//! or not. A checker must not share the fault that it looks for, so it uses no code of the reader, the passes, the planner or
//! the emitters: it reads the rows, finds the corners, lays the tolerance band and simulates the blade independently.
//!
//! Data flow: `program` reads rows; `axes` checks them as they come; the rows between a plunge and a lift form a stroke, which
//! `cut` follows along the lines of the `reference` and verifies; `source` compares the marker with the bytes that it came
//! from. Heads over a conveyor and at a distance have separate rules and rows, in [`flow`] and [`spray`].

mod axes;
mod cut;
mod declared;
pub mod flow;
mod program;
mod reference;
pub(crate) mod rules;
mod simulate;
mod source;
pub mod spray;
#[cfg(test)]
mod testing;

pub use declared::Declared;
pub use program::cutter_file::cutter_file;
pub use reference::ground::Ground;
pub use reference::inside::Inside;
pub use reference::required::{Capped, Required, RequiredCut, required};
pub use rules::RULES;
pub use source::audit::source_audit;
pub use source::census::Census;
pub use source::drawing::{DrawingCuts, drawing_audit};
pub use source::dxf::{CutPlaces, pattern_audit};
pub use source::kept::Works;
pub use source::sheet::Drawn;

use std::io::BufRead;

use self::cut::stroke::Judge;
use self::program::gcode::{self, Places};
use self::program::rows::Rows;
use self::program::{counts, cutter_file, hal, npy, rows};
use self::simulate::simulate;
use crate::ir::Finding;
use crate::ir::verdict::{Verdict, sort};
use crate::machine::{Job, MachineProfile};

/// Format of a program, recognised by its first bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Timed setpoints, verified by [`setpoints`].
    Setpoints,
    /// Positions without time, verified by [`positions`].
    Positions,
    /// Cut file that was written from a marker, verified by [`cutter_file()`].
    CutterFile,
}

/// Format of a program for a machine, even a damaged one; `None` for other bytes.
pub fn kind(bytes: &mut dyn BufRead, profile: &MachineProfile) -> Option<Kind> {
    if rows::begins(bytes) || npy::begins(bytes) || counts::begins(bytes) || hal::begins(bytes) {
        return Some(Kind::Setpoints);
    }
    let bytes = bytes.fill_buf().unwrap_or_default();
    if gcode::begins(bytes, profile.gcode.dialect) {
        return Some(Kind::Positions);
    }
    cutter_file::begins(bytes).then_some(Kind::CutterFile)
}

/// True if the bytes are a program for a machine that consists of lines, not of records.
pub fn has_lines(bytes: &mut dyn BufRead, profile: &MachineProfile) -> bool {
    kind(bytes, profile).is_some() && !npy::begins(bytes) && !counts::begins(bytes)
}

/// Reason why bytes do not begin like a program for a machine that can be verified, and advice; `None` when they do.
pub fn foreign(bytes: &mut dyn BufRead, profile: &MachineProfile) -> std::io::Result<Option<[String; 2]>> {
    if kind(bytes, profile).is_some() {
        return Ok(None);
    }
    let bytes = bytes.fill_buf()?;
    Ok(gcode::foreign(bytes, profile.gcode.dialect).or_else(|| rows::foreign(bytes)))
}

/// Verifies timed setpoints of the targets `csv`, `npy`, `counts` and `hal` against the required cuts.
pub fn setpoints(program: &mut dyn BufRead, declared: Option<&Declared>, ground: &Ground, job: &Job) -> Verdict {
    let mut rows = Rows::new(program, &job.profile);
    let rounding = rows.rounding();
    let judge = Judge::new(ground, declared, &job.profile, rounding);
    let (mut findings, uncut) = simulate(|| Some((rows.next()?, None)), &judge, job);
    let is_broken = rows.is_broken();
    let (format, unread) = rows.findings();
    if is_broken {
        return Verdict { findings: vec![format], unread, ..Verdict::default() };
    }
    findings.push(format);
    sort(&mut findings);
    Verdict { findings, uncut, ..Verdict::default() }
}

/// Verifies positions without time, of the target `gcode`, against the required cuts.
pub fn positions(program: &mut dyn BufRead, declared: Option<&Declared>, ground: &Ground, job: &Job) -> Verdict {
    let mut places = Places::new(program, ground.reference.marker.moved_on, &job.profile);
    let rounding = Places::rounding(&job.profile);
    let judge = Judge::new(ground, declared, &job.profile, rounding).with_exact_directions(&job.profile);
    let next = || places.next().map(|(row, going)| (row, Some(going)));
    let (mut findings, uncut) = simulate(next, &judge, job);
    let is_broken = places.is_broken();
    let ([format, dwell], unread) = places.findings();
    if is_broken {
        return Verdict { findings: vec![gcode::timeless(&format)], unread, ..Verdict::default() };
    }
    // The program states the length of each rest, so the reader's finding replaces this one.
    findings.retain(|finding| finding.rule != dwell.rule);
    findings.extend([format, dwell]);
    let untimed = |finding: &Finding| finding.rule.needs_time;
    let (left, judged): (Vec<Finding>, Vec<Finding>) = findings.into_iter().partition(untimed);
    let mut findings: Vec<Finding> = judged.iter().map(gcode::timeless).collect();
    sort(&mut findings);
    Verdict { findings, uncut, untimed: left.iter().map(|finding| finding.rule).collect(), ..Verdict::default() }
}
