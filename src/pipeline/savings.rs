//! Possible savings of a program: time that other settings than those of its profile would save.

use serde::Serialize;

use super::rounded::{micro, micro_known};
use crate::analysis::air;
use crate::ir::Marker;
use crate::machine::{Job, OrderPolicy};
use crate::pass::marker::saved_by;

/// Usual share of the rest after the lift command until the blade is clear of the cloth: a third.
pub(super) const CLEAR_SHARE: f64 = 1.0 / 3.0;

/// Possible savings of a program.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Savings {
    /// Approximate lower bound of the time of the moves from cut to cut in any order, s.
    #[serde(serialize_with = "micro")]
    pub least_travel_s: f64,
    /// Approximate saving by the order `steady`, s; `None` unless the order of the file is used.
    #[serde(serialize_with = "micro_known")]
    pub steady_s: Option<f64>,
    /// Saving by `knife.clear_ms` at a third of `knife.lift_ms`, s; `None` if it is set.
    #[serde(serialize_with = "micro_known")]
    pub clear_s: Option<f64>,
}

impl Savings {
    /// Savings for a marker with its cuts made, without those that depend on the planned motion.
    pub(super) fn of(marker: &Marker, job: &Job) -> Self {
        // A program that is resumed must keep its order.
        let is_as_filed =
            !job.selection.begins_amid() && job.profile.order.policy(marker.drawing.is_some()) == OrderPolicy::File;
        let (least_travel_s, steady_s) =
            rayon::join(|| air::least(marker, job), || is_as_filed.then(|| saved_by(OrderPolicy::Steady, marker, job)));
        Self { least_travel_s, steady_s, clear_s: None }
    }
}
