//! Target `counts`: encoder counts of X, Y and C, a record a cycle, for drives in cyclic synchronous position mode.
//!
//! A header of one JSON line, padded with blanks to [`HEADER_BYTES`] bytes, then records of five little-endian `i32`: X, Y, C,
//! outputs, block. A count is the absolute position times the scale, plus the offset, rounded: rounding errors do not
//! accumulate. Counts wrap as the 32-bit registers of drives do. C is that of the controller (`c.offset_deg`, `c.reverse`). In
//! the outputs bit 0 is the knife, bits 4 to 6 are the drill (0 to 4), bits 8 and 9 the event. On a conveyor a sixth number is
//! the advance of the cloth so far, mm.
//!
//! `numpy.memmap(file, "<i4", "r", 1024).reshape(-1, 5)` opens a program of any length at once.

use std::io::{self, SeekFrom};

use super::target::{Context, Emit, Outcome, Output, Parts, Proof, Target};
use crate::diagnostic::{Diagnostic, code};
use crate::ir::Motion;
use crate::units::number::{exact, fixed, up};

pub(super) const TARGET: Target = Target {
    name: "counts",
    about: "encoder counts of X, Y and C as 32-bit integers, a record a cycle",
    extension: "counts",
    emit: Emit::Motion(Parts { refusals, head, body, tail }),
    proof: Some(Proof::Setpoints),
};

/// Bytes before the first record.
const HEADER_BYTES: usize = 1024;
/// Bytes of a number.
const NUMBER_BYTES: usize = 4;

/// Bytes of a record.
fn record_bytes(context: &Context) -> usize {
    NUMBER_BYTES * if context.has_bites() { 6 } else { 5 }
}

/// First bits of drill and event in the outputs.
const DRILL_BIT: u32 = 4;
const EVENT_BIT: u32 = 8;

/// Greatest fraction of the tolerance by which half a count of each axis may move an end of the blade; the rest is for the
/// path.
const ROUNDING_SHARE: f64 = 0.25;

/// Refusal of counts that are too coarse for the tolerance.
fn refusals(context: &Context) -> Vec<Diagnostic> {
    let Context { marker, job, .. } = *context;
    let (counts, knife) = (&job.profile.counts, &job.profile.knife);
    let reach = knife.ends().into_iter().fold(0.0, f64::max);
    let turned = reach * (0.5 / counts.c.per_deg).to_radians();
    let moved = (0.5 / counts.x.per_mm).hypot(0.5 / counts.y.per_mm) + turned;
    let tolerance = job.profile.tolerance(marker.unit);
    if moved <= ROUNDING_SHARE * tolerance {
        return Vec::new();
    }
    let (moved, most) = (up(moved, 4), fixed(ROUNDING_SHARE * tolerance, 4));
    let message = format!(
        "counts are too coarse: rounding to them moves the blade by {moved} mm, a quarter of the tolerance, {most} mm, is the most"
    );
    let refused = Diagnostic::new(&code::TARGET_REFUSED, message);
    vec![refused.hint(
        "more counts (`counts.x.per_mm`, `counts.y.per_mm`, `counts.c.per_deg`), or a larger `path.tolerance_mm`",
    )]
}

/// The header of a program of `count` records.
fn header(context: &Context, count: u64) -> Vec<u8> {
    let profile = &context.job.profile;
    let [x, y] = [&profile.counts.x, &profile.counts.y]
        .map(|axis| format!("{{\"per_mm\": {}, \"offset\": {}}}", exact(axis.per_mm), exact(axis.offset)));
    let c = &profile.counts.c;
    let advance = if context.has_bites() { ", \"advance_mm\"" } else { "" };
    let text = format!(
        "{{\"format\": \"cutc-counts\", \"version\": 1, \"rows\": {count}, \"period_s\": {}, \"type\": \"<i4\", \
         \"columns\": [\"x\", \"y\", \"c\", \"outputs\", \"block\"{advance}], \"x\": {x}, \"y\": {y}, \
         \"c\": {{\"per_deg\": {}, \"offset\": {}, \"zero_deg\": {}, \"reverse\": {}}}, \
         \"outputs\": {{\"knife_bit\": 0, \"drill_bit\": {DRILL_BIT}, \"drill_bits\": 3, \"event_bit\": {EVENT_BIT}, \
         \"event_bits\": 2}}}}",
        exact(profile.time.period()),
        exact(c.per_deg),
        exact(c.offset),
        exact(profile.c.offset_deg),
        profile.c.reverse,
    );
    debug_assert!(text.len() < HEADER_BYTES, "numbers of a profile are short");
    let mut bytes = text.into_bytes();
    bytes.resize(HEADER_BYTES - 1, b' ');
    bytes.push(b'\n');
    bytes
}

fn head(context: &Context, out: &mut dyn Output) -> io::Result<()> {
    out.write_all(&header(context, 0))
}

fn body(motion: &Motion, context: &Context, out: &mut dyn Output) -> io::Result<()> {
    let profile = &context.job.profile;
    let (scales, turn) = (&profile.counts, &profile.c);
    let has_bites = context.has_bites();
    let mut records = Vec::with_capacity(record_bytes(context) * motion.ticks() as usize);
    for phase in &motion.phases {
        let outputs = u32::from(phase.kind.knife_down())
            | u32::from(phase.kind.drill()) << DRILL_BIT
            | u32::from(phase.kind.event()) << EVENT_BIT;
        for (pose, block) in phase.setpoints() {
            let counts = [
                wrapped(pose.centre.x * scales.x.per_mm + scales.x.offset),
                wrapped(pose.centre.y * scales.y.per_mm + scales.y.offset),
                wrapped(turn.shown_deg(pose.c.0) * scales.c.per_deg + scales.c.offset),
            ];
            for count in &counts {
                records.extend_from_slice(&count.to_le_bytes());
            }
            records.extend_from_slice(&outputs.to_le_bytes());
            records.extend_from_slice(&block.to_le_bytes());
            if has_bites {
                records.extend_from_slice(&phase.station.to_le_bytes());
            }
        }
    }
    out.write_all(&records)
}

/// Nearest whole number, wrapped to 32 bits.
fn wrapped(counts: f64) -> i32 {
    counts.round() as i64 as i32
}

/// Fills in the number of records that were written.
fn tail(context: &Context, _: Outcome, out: &mut dyn Output) -> io::Result<()> {
    let end = out.stream_position()?;
    let count = (end - HEADER_BYTES as u64) / record_bytes(context) as u64;
    out.seek(SeekFrom::Start(0))?;
    out.write_all(&header(context, count))?;
    out.seek(SeekFrom::Start(end))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_rounded_and_wrap_as_registers_do() {
        assert_eq!([0.4, 0.5, -0.5, -0.4].map(wrapped), [0, 1, -1, 0]);
        assert_eq!(wrapped(2_147_483_648.0), i32::MIN);
        assert_eq!(wrapped(-2_147_483_649.0), i32::MAX);
    }
}
