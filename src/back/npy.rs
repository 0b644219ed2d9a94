//! Target `npy`: timed setpoints as a `NumPy` array of records, a record a period.
//!
//! The fields are those of the target `csv` in its order, little-endian and packed: four `f8` (time and pose, as they
//! were planned, not rounded to decimals), three `u1` (outputs), one `u4` (block). The header has a fixed length, so that
//! the number of records can be filled in when it is known; `numpy.load(file, mmap_mode="r")` opens a program of any
//! length at once. Format: <https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>, version 1.0.

use std::io::{self, SeekFrom};

use super::target::{Context, Emit, Outcome, Output, Parts, Proof, Target, nothing};
use crate::ir::Motion;
use crate::units::deg;

pub(super) const TARGET: Target = Target {
    name: "npy",
    about: "the setpoints of csv as a NumPy array of records, unrounded",
    extension: "npy",
    emit: Emit::Motion(Parts { refusals: nothing, head, body, tail }),
    proof: Proof::Setpoints,
};

/// Bytes before the first record: a multiple of 64, so that memory maps are aligned.
const HEADER_BYTES: usize = 256;
/// Magic string, version 1.0.
const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";
/// Bytes of a record.
const RECORD_BYTES: usize = 4 * 8 + 3 + 4;

/// The header of an array of `count` records: a Python literal, padded with blanks and ended by a line feed.
fn header(count: u64) -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    let length = HEADER_BYTES - MAGIC.len() - 2;
    bytes.extend_from_slice(&(length as u16).to_le_bytes());
    let fields = "('t_s', '<f8'), ('x_mm', '<f8'), ('y_mm', '<f8'), ('c_deg', '<f8'), \
                  ('knife', '|u1'), ('drill', '|u1'), ('event', '|u1'), ('block', '<u4')";
    let text = format!("{{'descr': [{fields}], 'fortran_order': False, 'shape': ({count},), }}");
    bytes.extend_from_slice(text.as_bytes());
    debug_assert!(bytes.len() < HEADER_BYTES, "a count has 20 digits at most");
    bytes.resize(HEADER_BYTES - 1, b' ');
    bytes.push(b'\n');
    bytes
}

fn head(_: &Context, out: &mut dyn Output) -> io::Result<()> {
    out.write_all(&header(0))
}

fn body(motion: &Motion, context: &Context, out: &mut dyn Output) -> io::Result<()> {
    let period = context.job.profile.time.period();
    let mut records = Vec::with_capacity(RECORD_BYTES * motion.ticks() as usize);
    let mut tick = motion.first_tick;
    for phase in &motion.phases {
        let outputs = [phase.kind.knife_down().into(), phase.kind.drill(), phase.kind.event()];
        for (pose, block) in phase.setpoints() {
            for value in [tick as f64 * period, pose.centre.x, pose.centre.y, deg(pose.c.0)] {
                records.extend_from_slice(&value.to_le_bytes());
            }
            records.extend_from_slice(&outputs);
            records.extend_from_slice(&block.to_le_bytes());
            tick += 1;
        }
    }
    out.write_all(&records)
}

/// Fills in the number of records that were written.
fn tail(_: &Context, _: Outcome, out: &mut dyn Output) -> io::Result<()> {
    let end = out.stream_position()?;
    let count = (end - HEADER_BYTES as u64) / RECORD_BYTES as u64;
    out.seek(SeekFrom::Start(0))?;
    out.write_all(&header(count))?;
    out.seek(SeekFrom::Start(end))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_header_has_one_length_whatever_the_count() {
        for count in [0, 1, u64::MAX] {
            let header = header(count);
            assert_eq!(header.len(), HEADER_BYTES);
            assert_eq!(HEADER_BYTES % 64, 0);
            assert_eq!(usize::from(u16::from_le_bytes([header[8], header[9]])), HEADER_BYTES - 10);
            assert!(header.ends_with(b" \n"));
        }
    }
}
