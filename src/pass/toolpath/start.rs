//! Where a run begins on a curve beside which the plunged blade would lie too far.

use super::stretch::{REJOINED, Way};
use crate::analysis::cloth::Surroundings;
use crate::analysis::plunge::{Deviation, REACH};
use crate::analysis::tight::{TightCurve, least_radius, radius};
use crate::ir::toolpath::{Run, Shape};

/// A run that begins on a curve which the blade that plunges there lies too far beside.
#[derive(Debug)]
pub(super) struct CurvedStart {
    /// How that blade lies.
    pub(super) deviation: Deviation,
    /// The curve: up to the vertex from which on a blade could plunge well.
    pub(super) curve: TightCurve,
}

/// How an open run begins on a curve that the plunged blade cannot enter, or would lie more than `knife.max_bow_mm` beside,
/// or more than its tolerance when it covers all of it; `None` when it does not.
pub(super) fn curved_start(run: &Run, around: &Surroundings) -> Option<CurvedStart> {
    let is_bad = |deviation: &Deviation| deviation.is_curve && !deviation.is_good(around);
    if run.shape == Shape::Ring {
        return None;
    }
    // Nearly always that is all.
    Deviation::of(run, around).filter(is_bad)?;
    let way = Way::new(run);
    let from = |vertex: usize| {
        let station = way.station(vertex.cast_signed());
        let to = station + REACH * around.knife.width_mm;
        let start = if vertex == 0 { run.ends[0] } else { REJOINED };
        let end = if to < way.length() { REJOINED } else { run.ends[1] };
        let deviation = Deviation::of(&way.part(station, to.min(way.length()), [start, end]), around)?;
        Some(Deviation { covers_all: deviation.covers_all && to >= way.length(), ..deviation }).filter(is_bad)
    };
    let deviation = from(0)?;
    let end = (1..way.chords()).find(|&vertex| from(vertex).is_none()).unwrap_or(way.chords());
    let radius = |vertex: usize| radius(&run.points, vertex);
    let under = 1..=end.saturating_sub(1).max(1);
    let at = under.clone().min_by(|&a, &b| radius(a).total_cmp(&radius(b)))?;
    let radius = least_radius(&run.points, under, around.knife.width_mm);
    Some(CurvedStart { deviation, curve: TightCurve { vertices: 0..=end, radius, at } })
}
