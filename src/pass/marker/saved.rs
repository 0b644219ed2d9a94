//! Savings by another order of the pieces.

use super::{cut, route};
use crate::analysis::{air, duration};
use crate::diagnostic::Diagnostics;
use crate::ir::Marker;
use crate::machine::{Job, OrderPolicy};

/// Approximate time that an order by a policy would save for a marker with its cuts made, s. It is a lower bound, because the
/// search is shorter than for the actual order. The order determines with which part edges are cut, so that the cuts are made
/// anew.
pub fn saved_by(policy: OrderPolicy, marker: &Marker, job: &Job) -> f64 {
    let mut job = job.clone();
    job.profile.order.policy = policy;
    let (mut other, mut unsaid) = (marker.clone(), Diagnostics::default());
    route::roughly(&mut other, &job);
    (cut::PASS.run)(&mut other, &job, &mut unsaid);
    let time = |marker: &Marker| air::spent(marker, &job) + duration::of_cuts(marker, &job);
    (time(marker) - time(&other)).max(0.0)
}
