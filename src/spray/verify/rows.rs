//! Rows of a program, read from its bytes.

use std::io::{self, BufRead};

use crate::geom::Point;
use crate::ir::verdict::Sighting;

/// How a program begins.
pub(super) const HEADER: &str = "t_s,x_mm,y_mm,c_deg,vx_mm_s,vy_mm_s,jet,block";
/// Half of the last decimal of positions (mm, degrees), times (s) and speeds (mm/s).
pub(super) const POSITION_ROUNDING: f64 = 0.5e-6;
pub(super) const TIME_ROUNDING: f64 = 0.5e-6;
pub(super) const SPEED_ROUNDING: f64 = 0.5e-4;
/// Rounding of computations with them, mm, degrees and s.
pub(super) const EPSILON: f64 = 1e-6;
/// Way of the jet over which its speed is measured, mm: less than any jet is wide.
pub(super) const WAY: f64 = 10.0;

/// A row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Row {
    /// Its line, the first being 1.
    pub(super) line: u64,
    /// s.
    pub(super) time: f64,
    /// The head, mm.
    pub(super) head: Point,
    /// C, degrees.
    pub(super) c_deg: f64,
    /// Speeds of X and Y, mm/s.
    pub(super) velocity: [f64; 2],
    /// Whether the jet is on.
    pub(super) jet: bool,
    /// The block.
    pub(super) block: u32,
}

impl Row {
    /// Place and time of the row.
    pub(super) fn sighting(&self) -> Sighting {
        Sighting { line: Some(self.line), ..Sighting::at(self.time, self.head, self.block) }
    }
}

/// All rows; or what cannot be read, with its line.
pub(super) fn read(input: &mut dyn BufRead) -> io::Result<Result<Vec<Row>, String>> {
    let mut rows = Vec::new();
    let mut text = Vec::new();
    let mut line = 0;
    loop {
        text.clear();
        if input.read_until(b'\n', &mut text)? == 0 {
            break;
        }
        line += 1;
        let Some(whole) = text.strip_suffix(b"\n") else {
            return Ok(Err(format!("line {line} has no end")));
        };
        let whole = std::str::from_utf8(whole).unwrap_or("?").trim_end_matches('\r');
        if line == 1 {
            if whole != HEADER {
                return Ok(Err(format!("line 1 is not `{HEADER}`")));
            }
            continue;
        }
        match row(whole, line) {
            Some(row) => rows.push(row),
            None => return Ok(Err(format!("line {line} is not eight numbers, the jet 0 or 1"))),
        }
    }
    Ok(if rows.is_empty() { Err("there are no rows".to_owned()) } else { Ok(rows) })
}

/// The row of a line.
fn row(text: &str, line: u64) -> Option<Row> {
    let fields: Vec<&str> = text.split(',').collect();
    let [time, x, y, c, vx, vy, jet, block] = fields[..] else { return None };
    let number = |text: &str| text.parse::<f64>().ok().filter(|value| value.is_finite());
    Some(Row {
        line,
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
