//! Route: orders pieces, notches and starts for the least travel.
//!
//! Needs: all pieces with their notches, the contents of a part before it. Leaves true: with `order.policy` `"file"`
//! everything. Otherwise the same pieces, each whole, the contents of a part still before it, events between the same pieces;
//! slits on the way round; closed contours started as drawn or at a corner, either way round, open ones at either end, unless
//! the file has codes on them. If parts have common edges, the order considers the cuts that the pass `cut` makes of them. With
//! `"steady"` no piece lies farther behind the foremost so far than `order.window_mm`, except where a piece inside it does;
//! small pieces come before the larger ones next to them; and each piece ends towards the uncut cloth, if one of its visits
//! does.

mod again;
mod block;
mod near;
mod rules;
mod sequence;
mod small;
mod times;
mod tour;
mod tours;

use self::block::{Search, order};
use super::pass::MarkerPass;
use super::visit::{Cuts, Measures};
use crate::diagnostic::Diagnostics;
use crate::ir::marker::Marker;
use crate::machine::{Job, OrderPolicy};

pub(super) const PASS: MarkerPass = MarkerPass {
    name: "route",
    about: "orders pieces and notches and chooses starts and directions for the shortest travel",
    run,
};

fn run(marker: &mut Marker, job: &Job, _: &mut Diagnostics) {
    if job.profile.order.policy(marker.drawing.is_some()) == OrderPolicy::File {
        return;
    }
    let as_filed = as_filed(marker, job);
    once(marker, job);
    if let Some(as_filed) = as_filed {
        again::improve(marker, as_filed, job);
    }
}

/// Orders pieces by the policy of a job in a fraction of the time, with a worse result if parts have common edges.
pub(super) fn roughly(marker: &mut Marker, job: &Job) {
    let as_filed = as_filed(marker, job);
    once(marker, job);
    if let Some(as_filed) = as_filed {
        again::ordered(marker, as_filed, job);
    }
}

/// Marker in the order of the file, if parts may have common edges.
fn as_filed(marker: &Marker, job: &Job) -> Option<Marker> {
    job.profile.common(marker.unit).is_some().then(|| marker.clone())
}

/// Orders pieces as drawn, regardless of common lines.
fn once(marker: &mut Marker, job: &Job) {
    let measures = Measures::new(job, marker);
    let of = |piece: usize, marker: &Marker| Cuts::drawn(&marker.pieces[piece], &marker.list, &measures);
    order(marker, job, &of, Search::Whole);
}
