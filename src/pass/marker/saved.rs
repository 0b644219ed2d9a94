//! What another order of the pieces would save.

use super::{cut, route};
use crate::analysis::air;
use crate::diagnostic::Diagnostics;
use crate::ir::Marker;
use crate::machine::{Job, OrderPolicy};

/// The time of moves with the knife up that an order by a policy would save a marker whose cuts are made, s, as far as they
/// take less then: at the least, as it is not looked for as long as where it is asked for. The order decides which edges are
/// cut with which part, so that the cuts are made anew.
pub fn saved_by(policy: OrderPolicy, marker: &Marker, job: &Job) -> f64 {
    let mut job = job.clone();
    job.profile.order.policy = policy;
    let (mut other, mut unsaid) = (marker.clone(), Diagnostics::default());
    route::once(&mut other, &job);
    (cut::PASS.run)(&mut other, &job, &mut unsaid);
    (air::spent(marker, &job) - air::spent(&other, &job)).max(0.0)
}
