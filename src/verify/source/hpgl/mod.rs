//! Second, minimal reading of a plot by other means than the reader's: the path of the pen while it is down.
//!
//! `instruction` executes the instructions that move the pen of [`Scan`]; `curve` and `figure` draw; `encoded` reads PE,
//! `frame` SC and RO.

mod curve;
mod encoded;
mod figure;
mod frame;
mod instruction;
mod scan;

use std::collections::BTreeSet;

use self::instruction::ETX;
use self::scan::{Pen, Scan};
use crate::geom::Point;
use crate::geom::moments::Moments;
use crate::machine::MachineProfile;
use crate::verify::source::census::ARC_SAGITTA;
use crate::verify::source::census::Census;
use crate::verify::source::census::Slack;
use crate::verify::source::drawing::drawn::Drawn;

/// Statistics of a plot.
pub(super) fn scan(bytes: &[u8], profile: &MachineProfile) -> (Census, Slack) {
    let scan = scanned(bytes, profile, None);
    (scan.census, scan.slack)
}

/// Strokes of a plot.
pub(super) fn drawn(bytes: &[u8], profile: &MachineProfile) -> Drawn {
    let strokes = scanned(bytes, profile, Some(Vec::new())).strokes.unwrap_or_default();
    Drawn { strokes, unit: profile.hpgl.unit.mm(), layers: BTreeSet::new() }
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
