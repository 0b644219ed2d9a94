//! The pattern-sewing machine.

use std::io::{self, BufReader};

use super::machine::{Checked, Claim, Machine, Written, listed};
use crate::diagnostic::Diagnostics;
use crate::ir::Finding;
use crate::machine::Job;
use crate::pipeline::{Explained, Line, Told};
use crate::sew::{self, Asked, Made, TARGETS, Target, verify};
use crate::source::Source;

/// Bytes that are read back at a time.
const BLOCK_BYTES: usize = 1 << 17;

pub(super) const MACHINE: Machine = Machine {
    name: "sew",
    about: "a machine that sews patterns: cloth under a needle, fed by pulses",
    works: "sews",
    tool: None,
    targets: || listed(TARGETS),
    rules: verify::RULES,
    is_sewn: true,
    claims: |claim| target(claim).is_some(),
    refusal: |_| None,
    parts: None,
    check: |source, asked, job, out| {
        let program = sew::plan(source, asked, job, out)?;
        Some(Checked { format: program.format, pieces: None, cut_m: None })
    },
    judge: Some(judge),
};

/// The target of a program by its provenance or else its name, if programs of it are judged.
fn target(claim: Claim) -> Option<&'static Target> {
    let found = match claim.target {
        Some(told) => TARGETS.iter().find(|target| target.name == told),
        None => TARGETS.iter().find(|target| claim.name.ends_with(&format!(".{}", target.extension))),
    };
    found.filter(|target| target.proof.is_some())
}

/// Judges a program by what must be sewn of a source.
fn judge(
    program: &mut Written,
    source: &Source,
    asked: &Asked,
    job: &Job,
    out: &mut Diagnostics,
) -> io::Result<Option<Explained>> {
    let Some(planned) = sew::plan(source, asked, job, out) else { return Ok(None) };
    let bytes = target(program.claim).and_then(|target| target.proof).expect("a program that it claims");
    program.bytes.rewind()?;
    let mut input = BufReader::with_capacity(BLOCK_BYTES, &mut *program.bytes);
    let verdict = Made { program: &planned, source, job }.judge(bytes, &mut input)?;
    let told = |finding: &Finding| {
        let entry = finding.place.and_then(|place| place.line);
        Told { line: entry.map(Line::Entry), ..Told::default() }
    };
    let told = verdict.broken().map(told).collect();
    Ok(Some(Explained { verdict, told }))
}
