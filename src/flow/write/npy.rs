//! Target `npy`: timed setpoints of a head as a `NumPy` array of records, a record a period.
//!
//! The fields are those of the target `csv` in its order, little-endian and packed: five `f8`, not rounded to decimals, a
//! `u1` and a `u4`. Format: <https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>, version 1.0.

use std::io::{self, Write};

use super::target::{Emit, Target};
use crate::flow::program::{Head, Program};
use crate::units::{array, deg};
use crate::verify::flow::Bytes;

pub(super) const TARGET: Target = Target {
    name: "npy",
    about: "the setpoints of csv as NumPy arrays of records, unrounded",
    extension: "npy",
    emit: Emit::Heads(write),
    proof: Some(Bytes::Records),
};

/// The fields of a record.
const FIELDS: &str = "('t_s', '<f8'), ('conv_mm', '<f8'), ('x_mm', '<f8'), ('y_mm', '<f8'), ('c_deg', '<f8'), \
                      ('knife', '|u1'), ('block', '<u4')";
/// Bytes that are gathered before they are written.
const BLOCK: usize = 1 << 16;

fn write(program: &Program, head: &Head, out: &mut dyn Write) -> io::Result<()> {
    let mut bytes = array::header(FIELDS, program.ticks);
    for setpoint in program.setpoints(head) {
        let conveyor = program.conveyor(setpoint.tick);
        let state = setpoint.state;
        let time = setpoint.tick as f64 * program.period();
        for value in [time, conveyor, state.xi, state.y, deg(state.c)] {
            bytes.extend_from_slice(&value.to_le_bytes());
        }
        bytes.push(u8::from(setpoint.knife));
        bytes.extend_from_slice(&setpoint.block.to_le_bytes());
        if bytes.len() > BLOCK {
            out.write_all(&bytes)?;
            bytes.clear();
        }
    }
    out.write_all(&bytes)
}
