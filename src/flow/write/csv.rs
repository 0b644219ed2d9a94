//! Target `csv`: timed setpoints of a head, a row a period.
//!
//! `t_s,conv_mm,x_mm,y_mm,c_deg,knife,block`: the position of the conveyor, the head along the feed from its station and
//! across, c unwrapped, block the number of the source block being cut. Six decimals, as a jerk limit needs them.

use std::io::{self, Write};

use super::target::{Emit, Target};
use crate::flow::program::{Head, Program, Setpoint};
use crate::units::{deg, number};
use crate::verify::flow::Bytes;

pub(super) const TARGET: Target = Target {
    name: "csv",
    about: "timed setpoints of each head, a row a period, against time and conveyor position",
    extension: "csv",
    emit: Emit::Heads(write),
    proof: Some(Bytes::Rows),
};

/// Decimals of every number.
const DECIMALS: u32 = 6;
/// Bytes that are gathered before they are written.
const BLOCK: usize = 1 << 16;

fn write(program: &Program, head: &Head, out: &mut dyn Write) -> io::Result<()> {
    let mut rows = b"t_s,conv_mm,x_mm,y_mm,c_deg,knife,block\n".to_vec();
    // A head that waits has the same fields behind time and conveyor for long: they are printed once.
    let (mut rest, mut last) = (Vec::new(), None);
    for setpoint in program.setpoints(head) {
        number::push_fixed(&mut rows, setpoint.tick as f64 * program.period(), DECIMALS);
        rows.push(b',');
        number::push_fixed(&mut rows, program.conveyor(setpoint.tick), DECIMALS);
        let Setpoint { state, knife, block, .. } = setpoint;
        if last != Some((state, knife, block)) {
            last = Some((state, knife, block));
            fields(&setpoint, &mut rest);
        }
        rows.extend_from_slice(&rest);
        if rows.len() > BLOCK {
            out.write_all(&rows)?;
            rows.clear();
        }
    }
    out.write_all(&rows)
}

/// The fields of a row behind time and conveyor.
fn fields(setpoint: &Setpoint, rest: &mut Vec<u8>) {
    rest.clear();
    for value in [setpoint.state.xi, setpoint.state.y, deg(setpoint.state.c)] {
        rest.push(b',');
        number::push_fixed(rest, value, DECIMALS);
    }
    for value in [u64::from(setpoint.knife), u64::from(setpoint.block)] {
        rest.push(b',');
        number::push_integer(rest, value);
    }
    rest.push(b'\n');
}
