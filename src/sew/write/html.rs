//! A page that plays a pattern: needle, cloth, angle of the spindle, window. It needs nothing but a browser.

use std::io::{self, Write};

use super::target::Target;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::machine::Job;
use crate::machine::sewing::Ramp;
use crate::sew::program::Program;
use crate::sew::stitches::Op;
use crate::units::number::{exact, fixed};

pub(super) const TARGET: Target = Target {
    name: "html",
    about: "a page that plays the pattern: needle, cloth, spindle angle, window",
    extension: "html",
    refusals,
    write,
    proof: None,
};

/// The page, without machine and entries.
const PAGE: &str = include_str!("player.html");
const MACHINE: &str = "/*MACHINE*/";
const ENTRIES: &str = "/*ENTRIES*/";
/// More entries no browser draws at every frame.
const MOST: usize = 50_000;
/// Decimals of places, mm.
const DECIMALS: u32 = 3;

fn refusals(program: &Program, _: &Job, out: &mut Diagnostics) {
    let count = program.stitches.steps.len();
    if count > MOST {
        let message = format!("the target html plays {MOST} entries at the most, and the pattern has {count}");
        out.push(Diagnostic::new(&code::TARGET_REFUSED, message).hint("`-t svg` draws any number"));
    }
}

fn write(program: &Program, job: &Job, out: &mut dyn Write) -> io::Result<()> {
    let (head, rest) = PAGE.split_once(MACHINE).expect("the page has a place for the machine");
    let (middle, tail) = rest.split_once(ENTRIES).expect("the page has a place for the entries");
    let sewing = &job.profile.sewing;
    let cap = sewing.max_hz.map_or_else(|| "Infinity".to_owned(), |_| exact(sewing.cap()));
    write!(
        out,
        "{head}{{start_deg:{},end_deg:{},step:{},start:{},acceleration:{},cap:{cap},fill:{},trim:{}}}{middle}[",
        exact(sewing.feed_start_deg),
        exact(sewing.feed_end_deg),
        exact(sewing.step_mm),
        exact(sewing.start()),
        exact(sewing.feed_acceleration_mm_s2),
        sewing.ramp == Ramp::Fill,
        exact(sewing.trim_time()),
    )?;
    for entry in program.moves(job) {
        let op = match entry.step.op {
            Op::Stitch => 0,
            Op::Jump => 1,
            Op::Trim => 2,
            Op::Stop => 3,
            Op::Color(_) => 4,
        };
        let [x, y] = [entry.step.to.x, entry.step.to.y].map(|value| fixed(value, DECIMALS));
        let [kx, ky] = entry.pulses;
        writeln!(out, "[{op},{x},{y},{},{kx},{ky}],", exact(entry.rpm))?;
    }
    write!(out, "]{tail}")
}
