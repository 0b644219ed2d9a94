//! Target `halrun`: the `.hal` file that plays the rows of the target `hal` on `LinuxCNC`'s real-time layer.
//!
//! It expects the rows beside it under their default name. The `.hal` file of the machine connects the signals `x-pos`,
//! `y-pos`, `c-pos`, `knife`, `drill`, `event` and `block`, and `advance-mm` on a conveyor, to its drives and outputs.

use std::io;
use std::path::Path;

use super::target::{Context, Emit, Outcome, Output, Parts, Target, nothing};
use crate::ir::Motion;
use crate::ir::motion::Kind;
use crate::units::NS_PER_S;

pub(super) const TARGET: Target = Target {
    name: "halrun",
    about: "the .hal file that plays the rows of hal",
    extension: "hal",
    emit: Emit::Motion(Parts { refusals: nothing, head, body, tail }),
    proof: None,
};

/// Greatest number of rows that the streamer holds: a longer program is topped up while it plays.
const DEPTH_MAX: u64 = 1_000_000;
/// Spare rows, so that a whole program fits.
const DEPTH_SPARE: u64 = 2;

#[allow(clippy::unnecessary_wraps, reason = "the signature is that of every target")]
fn head(_: &Context, _: &mut dyn Output) -> io::Result<()> {
    Ok(())
}

/// Writes everything at the end of the program, when its length is known.
fn body(motion: &Motion, context: &Context, out: &mut dyn Output) -> io::Result<()> {
    if !motion.phases.iter().any(|phase| phase.kind == Kind::Rest) {
        return Ok(());
    }
    let rows = motion.first_tick + motion.ticks();
    let period = (context.job.profile.time.period() * NS_PER_S).round() as u64;
    let depth = (rows + DEPTH_SPARE).min(DEPTH_MAX);
    let stem = Path::new(context.source.name()).file_stem().map_or("program".into(), |stem| stem.to_string_lossy());
    // With -w all rows are in the streamer before the first is played.
    let wait = if rows <= depth { "-w " } else { "" };
    let [also, config, net] =
        if context.has_bites() { [", advance-mm", "u", "net advance-mm streamer.0.pin.7\n"] } else { [""; 3] };
    let text = format!(
        "# Plays the {rows} rows of `{stem}.hal.txt`, one every {period} ns: `halrun -I {stem}.hal` in its folder.\n\
         # Connect x-pos, y-pos, c-pos (mm, degrees), knife, drill, event and block{also} to the machine before `start`.\n\
         loadrt threads name1=servo period1={period}\n\
         loadrt streamer depth={depth} cfg=fffbuuu{config}\n\
         addf streamer.0 servo\n\
         net x-pos streamer.0.pin.0\n\
         net y-pos streamer.0.pin.1\n\
         net c-pos streamer.0.pin.2\n\
         net knife streamer.0.pin.3\n\
         net drill streamer.0.pin.4\n\
         net event streamer.0.pin.5\n\
         net block streamer.0.pin.6\n\
         {net}\
         setp streamer.0.enable 0\n\
         start\n\
         loadusr {wait}halstreamer {stem}.hal.txt\n\
         setp streamer.0.enable 1\n"
    );
    out.write_all(text.as_bytes())
}

#[allow(clippy::unnecessary_wraps, reason = "the signature is that of every target")]
fn tail(_: &Context, _: Outcome, _: &mut dyn Output) -> io::Result<()> {
    Ok(())
}
