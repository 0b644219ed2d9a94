//! A second, small reading of a plot: where the pen goes while it is down, by other means than the reader's.
//!
//! It knows nothing of what is cut: a marker of a plot keeps account of what it leaves aside, and both together must be
//! what the pen draws. Holes are deduced from shapes, so their number is not in the bytes.

mod curve;
mod encoded;
mod figure;
mod frame;
mod instruction;
mod scan;

use self::instruction::ETX;
use self::scan::{Pen, Scan};
use crate::geom::moments::Moments;
use crate::machine::MachineProfile;
use crate::verify::source::census::ARC_SAGITTA;
use crate::verify::source::census::Census;
use crate::verify::source::census::Slack;

/// Scans a plot.
pub(super) fn scan(bytes: &[u8], profile: &MachineProfile) -> (Census, Slack) {
    let unit = profile.hpgl.unit.mm();
    let sagitta = profile.tolerance(unit) * ARC_SAGITTA;
    let mut scan = Scan {
        bytes,
        at: if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 },
        is_text: !bytes.is_ascii() && std::str::from_utf8(bytes).map_or_else(|e| e.error_len().is_none(), |_| true),
        terminator: ETX,
        unit,
        sagitta: sagitta / unit,
        pen: Pen::default(),
        corners: None,
        page: None,
        scale: None,
        ranges: Vec::new(),
        quarters: 0,
        polygon: Vec::new(),
        part: None,
        is_fresh: false,
        census: Census::empty(unit),
        stroke: Moments::default(),
        slack: Slack { sagitta, length: 0.0, bounds: 0.0, moments: Moments::default() },
        curves: Vec::new(),
    };
    scan.run();
    scan.end_stroke();
    (scan.census, scan.slack)
}
