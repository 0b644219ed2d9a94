//! A second, small reading of a plot: where the pen goes while it is down, by other means than the reader's.
//!
//! The census knows nothing of what is cut: a marker of a plot keeps account of what it leaves aside, and both together
//! must be what the pen draws. Holes are deduced from shapes, so their number is not in the bytes. `outermost` judges
//! by the same strokes whether the right lines are cut: `around` whether others go around these, `cloth` whether the edge of
//! the cloth is cut, whose rectangles `rectangle` finds, `slits` whether slits are lost.

mod around;
mod cloth;
mod curve;
mod encoded;
mod figure;
mod frame;
mod instruction;
mod outermost;
mod rectangle;
mod scan;
mod slits;

use self::instruction::ETX;
pub use self::outermost::{PlotCuts, plot_audit};
use self::scan::{Pen, Scan};
use crate::geom::Point;
use crate::geom::moments::Moments;
use crate::machine::MachineProfile;
use crate::verify::source::census::ARC_SAGITTA;
use crate::verify::source::census::Census;
use crate::verify::source::census::Slack;

/// Scans a plot.
pub(super) fn scan(bytes: &[u8], profile: &MachineProfile) -> (Census, Slack) {
    let scan = scanned(bytes, profile, None);
    (scan.census, scan.slack)
}

/// The strokes of a plot: the places between two lifts, mm.
fn strokes(bytes: &[u8], profile: &MachineProfile) -> Vec<Vec<Point>> {
    scanned(bytes, profile, Some(Vec::new())).strokes.unwrap_or_default()
}

fn scanned<'a>(bytes: &'a [u8], profile: &MachineProfile, strokes: Option<Vec<Vec<Point>>>) -> Scan<'a> {
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
        strokes,
        is_up: true,
    };
    scan.run();
    scan.end_stroke();
    scan
}
