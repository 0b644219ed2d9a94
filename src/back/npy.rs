//! Target `npy`: timed setpoints as a `NumPy` array of records, a record a period.
//!
//! The fields are those of the target `csv` in its order, little-endian and packed: four `f8` (time and pose, as planned, not
//! rounded to decimals), three `u1` (outputs), one `u4` (block). The header has a fixed length, so that the number of records
//! can be filled in when it is known; `numpy.load(file, mmap_mode="r")` opens a program of any length at once. On a conveyor a
//! last `u4` is the advance of the cloth so far, mm.

use std::io::{self, SeekFrom};

use super::target::{Context, Emit, Outcome, Output, Parts, Proof, Target, nothing};
use crate::ir::Motion;
use crate::units::array::{HEADER_BYTES, header};
use crate::units::deg;

pub(super) const TARGET: Target = Target {
    name: "npy",
    about: "the setpoints of csv as a NumPy array of records, unrounded",
    extension: "npy",
    emit: Emit::Motion(Parts { refusals: nothing, head, body, tail }),
    proof: Some(Proof::Setpoints),
};

/// Bytes of a record, and of the advance of the cloth.
const RECORD_BYTES: usize = 4 * 8 + 3 + 4;
const ADVANCE_BYTES: usize = 4;

/// Names and types of the fields.
const FIELDS: &str = "('t_s', '<f8'), ('x_mm', '<f8'), ('y_mm', '<f8'), ('c_deg', '<f8'), \
                      ('knife', '|u1'), ('drill', '|u1'), ('event', '|u1'), ('block', '<u4')";

/// Field of the advance of the cloth.
const ADVANCE_FIELD: &str = ", ('advance_mm', '<u4')";

/// Names and types of the fields of a program, and the bytes of its records.
fn fields(context: &Context) -> (String, usize) {
    if context.has_bites() {
        (format!("{FIELDS}{ADVANCE_FIELD}"), RECORD_BYTES + ADVANCE_BYTES)
    } else {
        (FIELDS.to_owned(), RECORD_BYTES)
    }
}

fn head(context: &Context, out: &mut dyn Output) -> io::Result<()> {
    out.write_all(&header(&fields(context).0, 0))
}

fn body(motion: &Motion, context: &Context, out: &mut dyn Output) -> io::Result<()> {
    let period = context.job.profile.time.period();
    let has_bites = context.has_bites();
    let mut records = Vec::with_capacity(fields(context).1 * motion.ticks() as usize);
    let mut tick = motion.first_tick;
    for phase in &motion.phases {
        let outputs = [phase.kind.knife_down().into(), phase.kind.drill(), phase.kind.event()];
        for (pose, block) in phase.setpoints() {
            for value in [tick as f64 * period, pose.centre.x, pose.centre.y, deg(pose.c.0)] {
                records.extend_from_slice(&value.to_le_bytes());
            }
            records.extend_from_slice(&outputs);
            records.extend_from_slice(&block.to_le_bytes());
            if has_bites {
                records.extend_from_slice(&phase.station.to_le_bytes());
            }
            tick += 1;
        }
    }
    out.write_all(&records)
}

/// Fills in the number of records that were written.
fn tail(context: &Context, _: Outcome, out: &mut dyn Output) -> io::Result<()> {
    let (fields, bytes) = fields(context);
    let end = out.stream_position()?;
    let count = (end - HEADER_BYTES as u64) / bytes as u64;
    out.seek(SeekFrom::Start(0))?;
    out.write_all(&header(&fields, count))?;
    out.seek(SeekFrom::Start(end))?;
    Ok(())
}
