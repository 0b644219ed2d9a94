//! Stitch files: what their records do is what the pattern says.

use std::io::BufRead;

use super::records::{Decoded, Kind, Record};
use super::rules::Rule;
use super::worst::Worst;
use super::{Ground, Unread};
use crate::geom::Point;
use crate::sew::stitches::Op;

/// Units of stitch files in a millimetre.
const PER_MM: f64 = 10.0;
/// Jumps in a row that machines take for a trim.
const TRIM_JUMPS: usize = 3;
/// The longest move of a record, mm.
const LONGEST: f64 = 12.1;

/// What lies between two stitches or stops, and the one that follows.
#[derive(Debug, Default, Clone, Copy)]
struct Gap {
    /// Whether the thread is cut.
    is_cut: bool,
    /// Jumps of the file in it.
    jumps: usize,
    /// The stitch or stop behind it: whether it is a stitch, and where, mm.
    end: Option<(bool, Point)>,
}

/// Judges a file that `decode` reads.
pub(super) fn judge(
    input: &mut dyn BufRead,
    decode: fn(&[u8]) -> Decoded,
    ground: &Ground,
    worst: &mut Worst,
) -> Result<(), Unread> {
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes)?;
    let (records, header) = decode(&bytes).map_err(Unread::Row)?;
    if let Some(wrong) = header {
        worst.see(Rule::Header, wrong.into(), None);
    }
    let (planned, found) = (planned(ground), found(&records));
    worst.count(Rule::Entries, planned.len().abs_diff(found.len()) as f64, None);
    let mut before = Point::origin();
    for ((planned, entry), found) in planned.iter().zip(&found) {
        let place = planned.end.map(|(_, point)| (*entry, point));
        match (planned.end, found.end) {
            (Some((is_stitch, asked)), Some((is, point))) => {
                worst.count(Rule::Entries, f64::from(u8::from(is_stitch != is)), place);
                let off = (point.x - asked.x).abs().max((point.y - asked.y).abs());
                worst.see(Rule::Decoded, off, place);
            }
            (None, None) => {}
            (Some(_), None) | (None, Some(_)) => worst.count(Rule::Entries, 1.0, place),
        }
        // Three jumps may also be a long way.
        let far = planned.end.map_or(0.0, |(_, to)| (to.x - before.x).abs().max((to.y - before.y).abs()));
        let is_cut = found.is_cut || found.jumps >= TRIM_JUMPS;
        let wrong = if planned.is_cut { !is_cut } else { is_cut && far <= (TRIM_JUMPS - 1) as f64 * LONGEST };
        worst.count(Rule::Commands, f64::from(u8::from(wrong)), place);
        before = planned.end.map_or(before, |(_, to)| to);
    }
    Ok(())
}

/// What the pattern asks for, each gap with the entry at its end, from 1.
fn planned(ground: &Ground) -> Vec<(Gap, u32)> {
    let mut gaps = Vec::new();
    let mut gap = Gap::default();
    for (step, entry) in ground.stitches.steps.iter().zip(1..) {
        match step.op {
            Op::Jump => {}
            Op::Trim => gap.is_cut = true,
            Op::Stitch | Op::Stop | Op::Color(_) => {
                gap.end = Some((step.op == Op::Stitch, step.to));
                gaps.push((std::mem::take(&mut gap), entry));
            }
        }
    }
    gaps.push((gap, ground.stitches.steps.len() as u32));
    gaps
}

/// What a file does.
fn found(records: &[Record]) -> Vec<Gap> {
    let mut gaps = Vec::new();
    let mut gap = Gap::default();
    for record in records {
        match record.kind {
            Kind::Jump => gap.jumps += 1,
            Kind::Trim => gap.is_cut = true,
            Kind::Stitch | Kind::Stop => {
                let at = Point::new(record.at[0] as f64 / PER_MM, record.at[1] as f64 / PER_MM);
                gap.end = Some((record.kind == Kind::Stitch, at));
                gaps.push(std::mem::take(&mut gap));
            }
        }
    }
    gaps.push(gap);
    gaps
}
