//! Target `csv`: timed setpoints, a row a period.
//!
//! `t_s,x_mm,y_mm,c_deg,knife,drill,event,block`: x, y the C axis, c unwrapped, block the number of the source block
//! being cut. Six decimals: with four, a jerk limit could not be judged (a jerk of 2e5 mm/s3 moves 2e-4 mm in a
//! millisecond).

use std::io;

use super::target::{Context, Emit, Outcome, Output, Parts, Proof, Target, nothing};
use crate::ir::Motion;
use crate::units::{deg, number};

pub(super) const TARGET: Target = Target {
    name: "csv",
    about: "timed setpoints of X, Y and C, a row a period",
    extension: "csv",
    emit: Emit::Motion(PARTS),
    proof: Proof::Setpoints,
};

pub(super) const PARTS: Parts<Motion> = Parts { refusals: nothing, head, body, tail };

/// Decimals of positions, in mm and degrees.
const POSITION_DECIMALS: u32 = 6;
/// Decimals of the time, in s: a hundredth of the shortest legal period.
const TIME_DECIMALS: u32 = 6;

fn head(_: &Context, out: &mut dyn Output) -> io::Result<()> {
    out.write_all(b"t_s,x_mm,y_mm,c_deg,knife,drill,event,block\n")
}

fn body(motion: &Motion, context: &Context, out: &mut dyn Output) -> io::Result<()> {
    let period = context.job.profile.time.period();
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
