//! Reader of the rows of a program.

use std::io::BufRead;

use crate::geom::Point;
use crate::ir::verdict::Sighting;
use crate::units::columns::{Lines, Unread};

/// First line of a program.
pub(super) const HEADER: &str = "t_s,x_mm,y_mm,c_deg,vx_mm_s,vy_mm_s,jet,block";
/// Half of the last decimal of positions (mm, degrees), times (s) and speeds (mm/s).
pub(super) const POSITION_ROUNDING: f64 = 0.5e-6;
pub(super) const TIME_ROUNDING: f64 = 0.5e-6;
pub(super) const SPEED_ROUNDING: f64 = 0.5e-4;
/// Rounding error of computations with these values, mm, degrees and s.
pub(super) const EPSILON: f64 = 1e-6;
/// Path length of the jet over which its speed is measured, mm: less than the width of any jet.
pub(super) const WAY: f64 = 10.0;

/// Row of a program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Row {
    /// Line number, from 1.
    pub(super) line: u64,
    /// Time, s.
    pub(super) time: f64,
    /// Position of the head, mm.
    pub(super) head: Point,
    /// Position of C, degrees.
    pub(super) c_deg: f64,
    /// Velocities of X and Y, mm/s.
    pub(super) velocity: [f64; 2],
    /// True if the jet is on.
    pub(super) jet: bool,
    /// Source block; 0 = none.
    pub(super) block: u32,
}

impl Row {
    /// Sighting of the row.
    pub(super) fn sighting(&self) -> Sighting {
        Sighting { line: Some(self.line), ..Sighting::at(self.time, self.head, self.block) }
    }
}

/// Reads all rows.
pub(super) fn read(input: &mut dyn BufRead) -> Result<Vec<Row>, Unread> {
    let (mut rows, mut lines) = (Vec::new(), Lines::default());
    lines.header(input, HEADER)?;
    while let Some(line) = lines.next(input)? {
        let row = row(line);
        let row = row.ok_or_else(|| lines.is("it is not eight numbers, the jet 0 or 1"))?;
        rows.push(Row { line: lines.number(), ..row });
    }
    if rows.is_empty() { Err(lines.is("there is no row")) } else { Ok(rows) }
}

/// Row of a line, without its line number; `None` when the line is malformed.
fn row(text: &str) -> Option<Row> {
    let fields: Vec<&str> = text.split(',').collect();
    let [time, x, y, c, vx, vy, jet, block] = fields[..] else { return None };
    let number = |text: &str| text.parse::<f64>().ok().filter(|value| value.is_finite());
    Some(Row {
        line: 0,
        time: number(time)?,
        head: Point::new(number(x)?, number(y)?),
        c_deg: number(c)?,
        velocity: [number(vx)?, number(vy)?],
        jet: match jet {
            "0" => false,
            "1" => true,
            _ => return None,
        },
        block: block.parse().ok()?,
    })
}
