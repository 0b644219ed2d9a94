//! Target `hal`: timed setpoints as the text that `LinuxCNC`'s `halstreamer` takes, a row a servo period.
//!
//! `x_mm y_mm c_deg knife drill event block`, for `loadrt streamer cfg=fffbuuu`. C is that of the controller (`c.offset_deg`,
//! `c.reverse`). Nine decimals: with three, an axis that keeps its limits lags by micrometres. On a conveyor an eighth field,
//! `advance_mm`, is the advance of the cloth so far, for `cfg=fffbuuuu`. halstreamer skips a bad row silently and loses a last
//! one without its line feed; a comment starts in column 0.
//!
//! Target [`halrun`](super::halrun) is the `.hal` file that plays it.

use std::io;

use super::target::{Context, Emit, Outcome, Output, Parts, Proof, Target, nothing};
use crate::ir::Motion;
use crate::units::number;

pub(super) const TARGET: Target = Target {
    name: "hal",
    about: "timed setpoints for LinuxCNC's halstreamer, a row a servo period",
    extension: "hal.txt",
    emit: Emit::Motion(Parts { refusals: nothing, head, body, tail }),
    proof: Some(Proof::Setpoints),
};

/// Decimals of positions, in mm and degrees.
const DECIMALS: u32 = 9;

fn head(context: &Context, out: &mut dyn Output) -> io::Result<()> {
    let advance = if context.has_bites() { " advance_mm" } else { "" };
    writeln!(out, "# cutc hal: x_mm y_mm c_deg knife drill event block{advance}")
}

fn body(motion: &Motion, context: &Context, out: &mut dyn Output) -> io::Result<()> {
    let (turn, has_bites) = (&context.job.profile.c, context.has_bites());
    let mut rows = Vec::new();
    for phase in &motion.phases {
        rows.clear();
        let outputs = [phase.kind.knife_down().into(), phase.kind.drill(), phase.kind.event()];
        for (pose, block) in phase.setpoints() {
            for value in [pose.centre.x, pose.centre.y, turn.shown_deg(pose.c.0)] {
                number::push_fixed(&mut rows, value, DECIMALS);
                rows.push(b' ');
            }
            for output in outputs {
                number::push_integer(&mut rows, u64::from(output));
                rows.push(b' ');
            }
            number::push_integer(&mut rows, u64::from(block));
            if has_bites {
                rows.push(b' ');
                number::push_integer(&mut rows, phase.station.into());
            }
            rows.push(b'\n');
        }
        out.write_all(&rows)?;
    }
    Ok(())
}

#[allow(clippy::unnecessary_wraps, reason = "the signature is that of every target")]
fn tail(_: &Context, _: Outcome, _: &mut dyn Output) -> io::Result<()> {
    Ok(())
}
