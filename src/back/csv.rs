//! Target `csv`: timed setpoints, a row a period.
//!
//! `t_s,x_mm,y_mm,c_deg,knife,drill,event,block`: x and y are those of the C axis, c is unwrapped, block is the number of the
//! source block that is being cut. Six decimals: with four, a jerk limit could not be judged (a jerk of 2e5 mm/s3 moves 2e-4 mm
//! in a millisecond).
//!
//! On a conveyor (`bite.length_mm`) a last field, `advance_mm`, is the advance of the cloth so far, whole mm: x is a place of
//! the table, x plus the advance that of the cloth. The row with the event has the new advance.

use std::io;

use super::target::{Context, Emit, Outcome, Output, Parts, Proof, Target, nothing};
use crate::ir::Motion;
use crate::units::{deg, number};

pub(super) const TARGET: Target = Target {
    name: "csv",
    about: "timed setpoints of X, Y and C, a row a period",
    extension: "csv",
    emit: Emit::Motion(PARTS),
    proof: Some(Proof::Setpoints),
};

pub(super) const PARTS: Parts<Motion> = Parts { refusals: nothing, head, body, tail };

/// Decimals of positions, in mm and degrees.
const POSITION_DECIMALS: u32 = 6;
/// Decimals of the time, in s: a hundredth of the shortest legal period.
const TIME_DECIMALS: u32 = 6;

fn head(context: &Context, out: &mut dyn Output) -> io::Result<()> {
    let advance = if context.has_bites() { ",advance_mm" } else { "" };
    writeln!(out, "t_s,x_mm,y_mm,c_deg,knife,drill,event,block{advance}")
}

fn body(motion: &Motion, context: &Context, out: &mut dyn Output) -> io::Result<()> {
    let (period, has_bites) = (context.job.profile.time.period(), context.has_bites());
    let mut rows = Vec::new();
    let mut tick = motion.first_tick;
    for phase in &motion.phases {
        rows.clear();
        for (pose, block) in phase.setpoints() {
            number::push_fixed(&mut rows, tick as f64 * period, TIME_DECIMALS);
            for value in [pose.centre.x, pose.centre.y, deg(pose.c.0)] {
                rows.push(b',');
                number::push_fixed(&mut rows, value, POSITION_DECIMALS);
            }
            let outputs = [phase.kind.knife_down().into(), phase.kind.drill(), phase.kind.event()];
            for output in outputs.map(u64::from).into_iter().chain([u64::from(block)]) {
                rows.push(b',');
                number::push_integer(&mut rows, output);
            }
            if has_bites {
                rows.push(b',');
                number::push_integer(&mut rows, phase.station.into());
            }
            rows.push(b'\n');
            tick += 1;
        }
        out.write_all(&rows)?;
    }
    Ok(())
}

#[allow(clippy::unnecessary_wraps, reason = "the signature is that of every target")]
fn tail(_: &Context, _: Outcome, _: &mut dyn Output) -> io::Result<()> {
    Ok(())
}
