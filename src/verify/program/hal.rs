//! Reader of timed setpoints as rows of `LinuxCNC`'s halstreamer: `x_mm y_mm c_deg knife drill event block`, followed by
//! `advance_mm` with a conveyor.

use std::io::BufRead;

use super::number::{decimal, whole};
use super::row::{FIRST_LINE, Row};
use crate::geom::Point;
use crate::machine::MachineProfile;

/// First line of such a program, and its addition with a conveyor.
pub(super) const HEADER: &[u8] = b"# cutc hal: x_mm y_mm c_deg knife drill event block";
pub(super) const ADVANCE: &[u8] = b" advance_mm";

/// True if the program has this format.
pub(in crate::verify) fn begins(input: &mut dyn BufRead) -> bool {
    input.fill_buf().is_ok_and(|bytes| bytes.starts_with(b"# cutc hal"))
}

/// Row of a line; `has_advance` if the line ends with the advance of the cloth. Rows have no time: each is one period.
pub(in crate::verify) fn row(line: &[u8], tick: u64, has_advance: bool, profile: &MachineProfile) -> Option<Row> {
    let mut fields = line.split(|&byte| byte == b' ');
    let mut field = || fields.next();
    let (x, y, shown) = (decimal(field()?)?, decimal(field()?)?, decimal(field()?)?);
    let (knife, drill, event, block) = (whole(field()?)?, whole(field()?)?, whole(field()?)?, whole(field()?)?);
    let station = if has_advance { whole(field()?)? } else { 0 };
    let legal = knife <= 1 && drill <= 4 && event <= 2 && field().is_none();
    let c = &profile.c;
    legal.then(|| Row {
        tick,
        t: tick as f64 * profile.time.period(),
        centre: Point::new(x, y),
        c_deg: c.offset_deg + if c.reverse { -shown } else { shown },
        knife: knife == 1,
        drill: drill as u8,
        event: event as u8,
        block,
        station,
        line: tick + FIRST_LINE,
    })
}
