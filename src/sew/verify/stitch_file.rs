//! Checks of stitch files: their records must match the pattern.

use std::io::BufRead;

use super::ground::{Ground, sighting};
use super::records::{Decoded, File, Kind, Record};
use super::rules;
use crate::geom::Point;
use crate::ir::verdict::WorstByRule;
use crate::sew::stitches::Op;
use crate::units::TENTHS_PER_MM;
use crate::units::columns::Unread;

/// Length below which rounding cannot split the move of a record into two, mm.
const LONGEST: f64 = 12.0;

/// The events between two stitches or stops, and the stitch or stop that follows.
#[derive(Debug, Default, Clone, Copy)]
struct Gap {
    /// True if the thread is cut.
    is_cut: bool,
    /// Number of jumps: those in the file, or the maximum needed by the pattern.
    jumps: usize,
    /// The stitch (true) or stop (false) at its end, and its position, mm.
    end: Option<(bool, Point)>,
}

/// Verifies a file with the decoder of its format.
pub(super) fn judge(
    input: &mut dyn BufRead,
    decode: fn(&[u8]) -> Decoded,
    ground: &Ground,
    worst: &mut WorstByRule,
) -> Result<(), Unread> {
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes)?;
    let File { records, header, has_no_end, has_more, has_odd_end, trim_jumps, .. } =
        decode(&bytes).map_err(Unread::Row)?;
    if has_no_end || has_more || has_odd_end {
        let what = match (has_no_end, has_more) {
            (true, _) => "the end is missing",
            (false, true) => "bytes stand behind the end",
            (false, false) => "the end is none that every machine knows",
        };
        return Err(Unread::Row(what.to_owned()));
    }
    if let Some(wrong) = header {
        worst.see(&rules::HEADER, wrong.into(), None);
    }
    let (planned, found) = (planned(ground), found(&records));
    worst.count(&rules::ENTRIES, planned.len().abs_diff(found.len()), None);
    for ((planned, entry), found) in planned.iter().zip(&found) {
        let place = planned.end.map(|(_, point)| sighting(*entry, point));
        match (planned.end, found.end) {
            (Some((is_stitch, asked)), Some((is, point))) => {
                worst.count(&rules::ENTRIES, usize::from(is_stitch != is), place);
                let off = (point.x - asked.x).abs().max((point.y - asked.y).abs());
                worst.see(&rules::NEEDLE_POINT, off, place);
            }
            (None, None) => {}
            (Some(_), None) | (None, Some(_)) => worst.count(&rules::ENTRIES, 1, place),
        }
        // Jumps that stand for a trim may also be a long move.
        let is_trim = |jumps: usize| trim_jumps.is_some_and(|least| jumps >= least);
        let is_cut = found.is_cut || is_trim(found.jumps);
        let wrong = if planned.is_cut { !is_cut } else { is_cut && !is_trim(planned.jumps) };
        worst.count(&rules::COMMANDS, usize::from(wrong), place);
    }
    Ok(())
}

/// The required gaps, each with the entry at its end, from 1.
fn planned(ground: &Ground) -> Vec<(Gap, u32)> {
    let mut gaps = Vec::new();
    let mut gap = Gap::default();
    let mut at = Point::origin();
    for (step, entry) in ground.stitches.steps.iter().zip(1..) {
        let way = (step.to.x - at.x).abs().max((step.to.y - at.y).abs());
        let records = (way / LONGEST).ceil() as usize;
        at = step.to;
        match step.op {
            Op::Jump => gap.jumps += records.max(1),
            Op::Trim => gap.is_cut = true,
            Op::Stitch | Op::Stop | Op::Color(_) => {
                // The last of its records is not a jump.
                gap.jumps += records.saturating_sub(1);
                gap.end = Some((step.op == Op::Stitch, step.to));
                gaps.push((std::mem::take(&mut gap), entry));
            }
        }
    }
    gaps.push((gap, ground.stitches.steps.len() as u32));
    gaps
}

/// The gaps in a file.
fn found(records: &[Record]) -> Vec<Gap> {
    let mut gaps = Vec::new();
    let mut gap = Gap::default();
    for record in records {
        match record.kind {
            Kind::Jump => gap.jumps += 1,
            Kind::Trim => {
                gap.is_cut = true;
                gap.jumps += 1;
            }
            Kind::Stitch | Kind::Stop | Kind::Needle(_) | Kind::Halt => {
                let at = Point::new(record.at[0] as f64 / TENTHS_PER_MM, record.at[1] as f64 / TENTHS_PER_MM);
                gap.end = Some((record.kind == Kind::Stitch, at));
                gaps.push(std::mem::take(&mut gap));
            }
        }
    }
    gaps.push(gap);
    gaps
}
