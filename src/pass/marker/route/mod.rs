//! Route: the order of pieces, notches and starts in which the knife travels least.
//!
//! Needs: all pieces with their notches, what lies within a part before it. Leaves true: with `order.policy` `"file"`
//! everything; else the same pieces, each whole, what lies within a part before that still, events between the same pieces;
//! slits on the way round, closed contours begun as they are drawn or at a corner, either way round, open ones from either
//! end, unless the file asks for something on them. Where parts have edges in common the order goes by the cuts that the pass
//! `cut` makes of them. With `"steady"` no piece lies farther behind the foremost so far
//! than `order.window_mm`, but where something within it does; small pieces come before the larger ones next to them; and each
//! piece ends towards the cloth that is still uncut, if one of its ways does.

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

/// Orders pieces by the policy of a job in a part of the time, and not as well where parts have edges in common.
pub(super) fn roughly(marker: &mut Marker, job: &Job) {
    let as_filed = as_filed(marker, job);
    once(marker, job);
    if let Some(as_filed) = as_filed {
        again::ordered(marker, as_filed, job);
    }
}

/// The marker in the order of the file, where parts may have edges in common.
fn as_filed(marker: &Marker, job: &Job) -> Option<Marker> {
    job.profile.common(marker.unit).is_some().then(|| marker.clone())
}

/// Orders pieces as they are drawn, whatever common lines leave of them.
fn once(marker: &mut Marker, job: &Job) {
    let measures = Measures::new(job, marker);
    let of = |piece: usize, marker: &Marker| Cuts::drawn(&marker.pieces[piece], &marker.list, &measures);
    order(marker, job, &of, Search::Whole);
}
