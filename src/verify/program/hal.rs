//! Reads timed setpoints from the rows of `LinuxCNC`'s halstreamer: `x_mm y_mm c_deg knife drill event block`, on a conveyor
//! with `advance_mm` behind.

use std::io::BufRead;

use super::number::{decimal, whole};
use super::row::{FIRST_LINE, Row};
use crate::geom::Point;
use crate::machine::MachineProfile;

/// The first line of such a program, and what a conveyor adds to it.
pub(super) const HEADER: &[u8] = b"# cutc hal: x_mm y_mm c_deg knife drill event block";
pub(super) const ADVANCE: &[u8] = b" advance_mm";

/// Whether a program is one of these.
pub(in crate::verify) fn begins(input: &mut dyn BufRead) -> bool {
    input.fill_buf().is_ok_and(|bytes| bytes.starts_with(b"# cutc hal"))
}

/// The row on a line, which may tell the way of the cloth; halstreamer has no time, a row is a period.
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
