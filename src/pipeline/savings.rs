//! What a program could save: the time that settings other than those of its profile would spare.

use serde::Serialize;

use super::rounded::{micro, micro_known};
use crate::analysis::air;
use crate::ir::Marker;
use crate::machine::{Job, OrderPolicy};
use crate::pass::marker::saved_by;

/// Of a rest after the lift command how much the blade takes until it is clear of the cloth, as a rule: a third.
pub(super) const CLEAR_SHARE: f64 = 1.0 / 3.0;

/// What a program could save.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Savings {
    /// About the time of the moves from cut to cut that no order of them can do without, s.
    #[serde(serialize_with = "micro")]
    pub least_travel_s: f64,
    /// What the order `steady` would save, s, about; none where another than the file's is asked for.
    #[serde(serialize_with = "micro_known")]
    pub steady_s: Option<f64>,
    /// What `knife.clear_ms` would save at a third of `knife.lift_ms`, s; none where it is set.
    #[serde(serialize_with = "micro_known")]
    pub clear_s: Option<f64>,
}

impl Savings {
    /// Those of a marker whose cuts are made, but for what hangs on the planned motion.
    pub(super) fn of(marker: &Marker, job: &Job) -> Self {
        // Who goes on with a program must go on in its order.
        let is_as_filed =
            !job.selection.begins_amid() && job.profile.order.policy(marker.drawing.is_some()) == OrderPolicy::File;
        let (least_travel_s, steady_s) =
            rayon::join(|| air::least(marker, job), || is_as_filed.then(|| saved_by(OrderPolicy::Steady, marker, job)));
        Self { least_travel_s, steady_s, clear_s: None }
    }
}
