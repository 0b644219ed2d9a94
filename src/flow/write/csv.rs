//! Target `csv`: timed setpoints of a head, a row a period.
//!
//! `t_s,conv_mm,x_mm,y_mm,c_deg,knife,block`: the position of the conveyor, the head along the feed from its station and
//! across, c unwrapped, block the number of the source block being cut. Six decimals, as a jerk limit needs them.

use std::io::{self, Write};

use super::target::{Kind, Target};
use crate::flow::program::{Head, Program};
use crate::flow::verify::Bytes;
use crate::units::{deg, number};

pub(super) const TARGET: Target = Target {
    name: "csv",
    about: "timed setpoints of each head, a row a period, against time and conveyor position",
    extension: "csv",
    kind: Kind::Heads { write, bytes: Bytes::Rows },
};

/// Decimals of every number.
const DECIMALS: u32 = 6;
/// Bytes that are gathered before they are written.
const BLOCK: usize = 1 << 16;

fn write(program: &Program, head: &Head, out: &mut dyn Write) -> io::Result<()> {
    let mut rows = b"t_s,conv_mm,x_mm,y_mm,c_deg,knife,block\n".to_vec();
    for setpoint in program.setpoints(head) {
        let conveyor = program.conveyor(setpoint.tick);
        let state = setpoint.state;
        number::push_fixed(&mut rows, setpoint.tick as f64 * program.period(), DECIMALS);
        for value in [conveyor, state.xi, state.y, deg(state.c)] {
            rows.push(b',');
            number::push_fixed(&mut rows, value, DECIMALS);
        }
        rows.push(b',');
        number::push_integer(&mut rows, u64::from(setpoint.knife));
        rows.push(b',');
        number::push_integer(&mut rows, u64::from(setpoint.block));
        rows.push(b'\n');
        if rows.len() > BLOCK {
            out.write_all(&rows)?;
            rows.clear();
        }
    }
    out.write_all(&rows)
}
