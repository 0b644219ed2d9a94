//! Target `csv`: timed setpoints with velocities, a row a period.
//!
//! `t_s,x_mm,y_mm,c_deg,vx_mm_s,vy_mm_s,jet,block`: x, y the head, c its direction, unwrapped; jet 1 while it sprays; block the
//! number of the source block beside which it runs. Six decimals of positions, as a jerk limit asks for.

use std::io::{self, Write};

use super::target::{Target, Writer};
use crate::spray::program::Program;
use crate::units::{deg, number};
use crate::verify::spray::judge;

pub(super) const TARGET: Target = Target {
    name: "csv",
    about: "timed setpoints of X, Y and C with the velocities of X and Y, a row a period",
    extension: "csv",
    emit: Writer { compares: false, write },
    proof: Some(judge),
};

/// Decimals of positions (mm, degrees), of speeds (mm/s) and of times (s).
const POSITION_DECIMALS: u32 = 6;
const SPEED_DECIMALS: u32 = 4;
const TIME_DECIMALS: u32 = 6;

fn write(program: &Program, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "t_s,x_mm,y_mm,c_deg,vx_mm_s,vy_mm_s,jet,block")?;
    let legs: Vec<u32> = program.passes.iter().flatten().map(|leg| leg.block).collect();
    let mut text = Vec::new();
    for (tick, row) in program.rows.iter().enumerate() {
        text.clear();
        number::push_fixed(&mut text, tick as f64 * program.period, TIME_DECIMALS);
        for place in [row.pose.centre.x, row.pose.centre.y, deg(row.pose.c.0)] {
            text.push(b',');
            number::push_fixed(&mut text, place, POSITION_DECIMALS);
        }
        for speed in row.velocity {
            text.push(b',');
            number::push_fixed(&mut text, speed, SPEED_DECIMALS);
        }
        text.extend_from_slice(if row.jet { b",1," } else { b",0," });
        let block = row.leg.filter(|_| row.jet).map_or(0, |leg| legs[leg]);
        number::push_integer(&mut text, u64::from(block));
        text.push(b'\n');
        out.write_all(&text)?;
    }
    Ok(())
}
