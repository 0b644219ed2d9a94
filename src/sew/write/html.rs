//! A page that plays a pattern: needle, cloth, angle of the spindle, window. It needs nothing but a browser.

use std::io::{self, Write};

use serde_json::json;

use super::target::{Target, Writer};
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::machine::Job;
use crate::machine::sewing::Ramp;
use crate::picture::{Columns, Page, Script};
use crate::sew::program::{Move, Program};
use crate::sew::stitches::Op;

pub(super) const TARGET: Target = Target {
    name: "html",
    about: "a page that plays the pattern: needle, cloth, spindle angle, window",
    extension: "html",
    emit: Writer { refusals, write },
    proof: None,
};

/// More entries no browser draws at every frame.
const MOST: usize = 50_000;
/// Units of places, mm, and of speeds, stitches a minute.
const UNIT: f64 = 1e-3;
const UNIT_RPM: f64 = 1e-3;

fn refusals(program: &Program, _: &Job, out: &mut Diagnostics) {
    let count = program.stitches.steps.len();
    if count > MOST {
        let message = format!("the target html plays {MOST} entries at the most, and the pattern has {count}");
        out.push(Diagnostic::new(&code::TARGET_REFUSED, message).hint("`-t svg` draws any number"));
    }
}

fn write(program: &Program, job: &Job, out: &mut dyn Write) -> io::Result<()> {
    let sewing = &job.profile.sewing;
    let facts = json!({
        "start_deg": sewing.feed_start_deg,
        "end_deg": sewing.feed_end_deg,
        "step": sewing.step_mm,
        "start": sewing.start(),
        "acceleration": sewing.feed_acceleration_mm_s2,
        "cap": sewing.max_hz.map(|_| sewing.cap()),
        "fill": sewing.ramp == Ramp::Fill,
        "trim": sewing.trim_time(),
    });
    let moves: Vec<Move> = program.moves(job).collect();
    let mut columns = Columns::default();
    columns.add("op", 1.0, moves.iter().map(|entry| number(entry.step.op)));
    columns.add("x", UNIT, moves.iter().map(|entry| in_units(entry.step.to.x, UNIT)));
    columns.add("y", UNIT, moves.iter().map(|entry| in_units(entry.step.to.y, UNIT)));
    columns.add("rpm", UNIT_RPM, moves.iter().map(|entry| in_units(entry.rpm, UNIT_RPM)));
    columns.add("pulses_x", 1.0, moves.iter().map(|entry| entry.pulses[0]));
    columns.add("pulses_y", 1.0, moves.iter().map(|entry| entry.pulses[1]));
    let (title, script) = ("Pattern".to_owned(), Script::Sewing);
    Page { title, body: script.markup().to_owned(), facts, columns, script }.write(out)
}

/// Number of an operation in the data of the page.
fn number(op: Op) -> i64 {
    match op {
        Op::Stitch => 0,
        Op::Jump => 1,
        Op::Trim => 2,
        Op::Stop => 3,
        Op::Color(_) => 4,
    }
}

fn in_units(value: f64, unit: f64) -> i64 {
    (value / unit).round() as i64
}
