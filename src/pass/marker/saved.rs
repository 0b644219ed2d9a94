//! What another order of the pieces would save.

use super::{cut, route};
use crate::analysis::{air, duration};
use crate::diagnostic::Diagnostics;
use crate::ir::Marker;
use crate::machine::{Job, OrderPolicy};

/// About the time that an order by a policy would save a marker whose cuts are made, s: at the least, as it is not looked for as
/// long as where it is asked for. The order decides which edges are cut with which part, so that the cuts are made anew.
pub fn saved_by(policy: OrderPolicy, marker: &Marker, job: &Job) -> f64 {
    let mut job = job.clone();
    job.profile.order.policy = policy;
    let (mut other, mut unsaid) = (marker.clone(), Diagnostics::default());
    route::roughly(&mut other, &job);
    (cut::PASS.run)(&mut other, &job, &mut unsaid);
    let time = |marker: &Marker| air::spent(marker, &job) + duration::of_cuts(marker, &job);
    (time(marker) - time(&other)).max(0.0)
}
