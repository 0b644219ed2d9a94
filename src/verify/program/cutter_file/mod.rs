//! Verification of a cut file that was written from a marker: read again, it must state the same as the marker.
//!
//! Both become lists of statements in file order and are compared one by one. The cuts of split pieces are also judged by
//! the outline as drawn. The reader knows only the spelling of our own writer; any other block is a bad block.

mod reader;
mod said;
mod sections;

use self::reader::Reader;
use self::said::expected;
use crate::geom::Point;
use crate::ir::Marker;
use crate::ir::verdict::{Sighting, Verdict, Worst, sort};
use crate::machine::Job;
use crate::source::Source;
use crate::verify::rules;

/// First bytes of every such file.
const HEAD: &[u8] = b"H1*\n";
/// Half of the last significant decimal, units of the file.
const ROUNDING: f64 = 0.5e-6;
/// Rounding error of the computation, mm.
const PLACE_EPSILON: f64 = 1e-9;

/// True if the bytes look like a cut file of our own writer.
pub(in crate::verify) fn begins(bytes: &[u8]) -> bool {
    bytes.starts_with(HEAD)
}

/// Verifies the bytes of a cut file against the marker that it was written from.
pub fn cutter_file(bytes: &[u8], marker: &Marker, source: &Source, job: &Job) -> Verdict {
    let mut format = Worst::new(&rules::FORMAT, Some(0.0)).in_unit("bad blocks");
    let mut same = Worst::new(&rules::SAME, Some(0.0));
    let mut reader = Reader::new(bytes, job);
    let found = reader.read();
    let unit = reader.unit;
    let mut place = Worst::new(&rules::SAME_PLACE, Some(ROUNDING * unit * 2.0_f64.sqrt() + PLACE_EPSILON));
    let nowhere = Sighting::missing(Point::origin(), 0);
    if found.is_none() {
        format.see(1.0, || Sighting::at(0.0, reader.at, 0));
    }
    let found = found.unwrap_or_default();
    let expected = expected(marker, source);
    let differing = expected.len().abs_diff(found.len());
    let mut wrong = differing as f64;
    same.see(wrong, || nowhere);
    for (told, meant) in found.iter().zip(&expected) {
        let sighting = meant.sighting().unwrap_or(nowhere);
        if let Some(away) = told.away(meant) {
            place.see(away, || sighting);
        } else {
            wrong += 1.0;
            same.see(wrong, || sighting);
        }
    }
    let mut findings = vec![format.finding(), same.finding(), place.finding()];
    findings.extend(sections::check(&found, marker, &job.profile, ROUNDING * unit * 2.0_f64.sqrt() + PLACE_EPSILON));
    sort(&mut findings);
    Verdict { findings, ..Verdict::default() }
}
