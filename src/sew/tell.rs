//! Messages on the speeds of a program: runs slowed down by a stitch, runs without a possible speed, patterns that are slow as
//! a whole, and changed speeds of a queue.

use super::pace;
use super::program::Program;
use super::read::Speed;
use super::speed::{self, Limit, Run};
use super::stitches::Op;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Point;
use crate::machine::Sewing;
use crate::machine::sewing::Spindle;
use crate::units::number::{exact, fixed};

/// Relative additional time of a run, compared with the median speed of its stitches, above which it is reported.
const TOLD_COST: f64 = 0.1;
/// Fraction of the maximum spindle speed; a pattern whose fastest run is below it is reported.
const TOLD_SPEED: f64 = 0.25;

/// Reports all findings on speeds.
pub(super) fn tell(program: &Program, speeds: &[Speed], sewing: &Sewing, out: &mut Diagnostics) {
    slowed(program, sewing, out);
    slow(program, sewing, out);
    others(program, speeds, out);
}

/// Reports runs that a stitch slows down, the most costly first, and runs without a possible speed.
fn slowed(program: &Program, sewing: &Sewing, out: &mut Diagnostics) {
    let Program { stitches, runs, record_word, .. } = program;
    let mut costly: Vec<(usize, &Run)> = Vec::new();
    let is_uniform = sewing.spindle == Spindle::Uniform;
    let which = |i: usize| {
        let step = &stitches.steps[i];
        let from = if i == 0 { Point::origin() } else { stitches.steps[i - 1].to };
        let pitch = fixed((step.to - from).norm(), 3);
        (step, format!("the stitch of {record_word} {}, {pitch} mm long,", step.record))
    };
    for (run, number) in runs.iter().zip(1..) {
        let (Limit::Stitch(i) | Limit::User(i)) = run.limit else { continue };
        if run.rpm <= 0.0 {
            let (step, which) = which(i);
            let message = format!("{which} fits at no speed of the grid, {} rpm", sewing.grid_rpm);
            let hint = "split it with `--on-long split`, or look at window, acceleration and grid of the profile";
            out.push(Diagnostic::new(&code::SEW_NO_SPEED, message).on_cloth(step.to).hint(hint));
        } else if is_uniform && run.cost > TOLD_COST * (pace::duration(&run.speeds, sewing) - run.cost) {
            costly.push((number, run));
        }
    }
    costly.sort_by(|(_, a), (_, b)| b.cost.total_cmp(&a.cost));
    for (number, run) in costly {
        let (Limit::Stitch(i) | Limit::User(i)) = run.limit else { continue };
        let (step, which) = which(i);
        let message = format!(
            "run {number} of {} stitches is sewn at {} rpm: {which} allows no more; that costs {} s",
            run.steps.len(),
            exact(run.rpm),
            fixed(run.cost, 2)
        );
        let hint = "`--on-long split` makes it several stitches; `sewing.spindle = \"eased\"` slows down for it alone";
        out.push(Diagnostic::new(&code::SEW_SLOWED, message).on_cloth(step.to).hint(hint));
    }
}

/// Reports a pattern in which no run comes near the spindle speed.
fn slow(program: &Program, sewing: &Sewing, out: &mut Diagnostics) {
    let Some(fastest) = program.runs.iter().max_by(|a, b| a.rpm.total_cmp(&b.rpm)) else { return };
    let is_slow = fastest.rpm > 0.0 && fastest.rpm < TOLD_SPEED * sewing.max_rpm;
    if !is_slow || !matches!(fastest.limit, Limit::Stitch(_)) {
        return;
    }
    let message = format!(
        "no run is sewn faster than {} rpm, of {} that the spindle has: the window from {} to {} degrees is {} degrees wide",
        exact(fastest.rpm),
        exact(sewing.max_rpm),
        exact(sewing.feed_start_deg),
        exact(sewing.feed_end_deg),
        fixed(sewing.window_deg(), 1),
    );
    let hint = "look at `sewing.feed_start_deg`, `sewing.feed_end_deg`, `sewing.step_mm` and the rates of the motors";
    out.push(Diagnostic::new(&code::SEW_SLOW, message).hint(hint));
}

/// Reports speeds of a queue that are not kept.
fn others(program: &Program, speeds: &[Speed], out: &mut Diagnostics) {
    let Program { stitches, runs, record_word, .. } = program;
    let mut next = speeds.iter().peekable();
    let (mut asked, mut count, mut first) = (None, 0, None);
    for (step, rpm) in stitches.steps.iter().zip(speed::speeds(stitches, runs)) {
        while let Some(speed) = next.next_if(|speed| speed.record <= step.record) {
            asked = Some(speed.rpm);
        }
        if let Some(asked) = asked.filter(|&asked| step.op == Op::Stitch && asked != rpm) {
            count += 1;
            first.get_or_insert((step, rpm, asked));
        }
    }
    if let Some((step, rpm, asked)) = first {
        let message = format!(
            "{count} stitches are sewn at other speeds than the file asks for: that of {record_word} {} at {} rpm instead of {} rpm",
            step.record,
            exact(rpm),
            exact(asked)
        );
        let hint = "speeds are computed from the profile; limit them by `sewing.max_rpm` or `sewing.speeds`";
        out.push(Diagnostic::new(&code::SEW_SPEEDS, message).on_cloth(step.to).hint(hint));
    }
}
