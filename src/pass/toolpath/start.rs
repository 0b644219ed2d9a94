//! Starts of runs on curves from which the plunged blade deviates too far.

use super::stretch::{REJOINED, Way};
use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::{Deviation, Leeway, REACH};
use crate::analysis::tight::{TightCurve, least_radius, radius};
use crate::ir::toolpath::{Run, Shape};

/// Start of a run on a curve from which the plunged blade deviates too far.
#[derive(Debug)]
pub(super) struct CurvedStart {
    /// Deviation of the plunged blade.
    pub(super) deviation: Deviation,
    /// Curve up to the first vertex at which the blade could plunge well.
    pub(super) curve: TightCurve,
}

/// Start of an open run on a curve that the plunged blade cannot enter, or from which it would deviate by more than
/// `knife.max_bow_mm`, or by more than its tolerance if it covers all of the run; `None` if the run starts well.
pub(super) fn curved_start(run: &Run, around: &Surroundings) -> Option<CurvedStart> {
    let is_bad = |deviation: &Deviation| deviation.is_curve && !deviation.is_good(around);
    if run.shape == Shape::Ring {
        return None;
    }
    // Nearly all runs end here.
    Deviation::of(run, around).filter(is_bad)?;
    let way = Way::new(run);
    let from = |vertex: usize| {
        let station = way.station(vertex.cast_signed());
        let to = station + REACH * around.knife.width_mm;
        let start = if vertex == 0 { run.ends[0] } else { REJOINED };
        let end = if to < way.length() { REJOINED } else { run.ends[1] };
        let deviation = Deviation::of(&way.part(station, to.min(way.length()), [start, end]), around)?;
        let leeway = if to >= way.length() { deviation.leeway } else { Leeway::Free };
        Some(Deviation { leeway, ..deviation }).filter(is_bad)
    };
    let deviation = from(0)?;
    let end = (1..way.chords()).find(|&vertex| from(vertex).is_none()).unwrap_or(way.chords());
    let radius = |vertex: usize| radius(&run.points, vertex);
    let under = 1..=end.saturating_sub(1).max(1);
    let at = under.clone().min_by(|&a, &b| radius(a).total_cmp(&radius(b)))?;
    let radius = least_radius(&run.points, under, around.knife.width_mm);
    Some(CurvedStart { deviation, curve: TightCurve { vertices: 0..=end, radius, at } })
}
