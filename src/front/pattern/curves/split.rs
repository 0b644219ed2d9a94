//! Split of the curve of a run at the vertices that it passes.

use super::drafting::Drafting;
use super::knots::{self, Fit};
use super::leg::Leg;
use super::run::Run;
use crate::geom::budget::Budget;
use crate::ir::drawing::Vertex;

/// Distributes the curve of a run over the legs of its vertices; false if it needs too many points.
pub(super) fn lay(run: &Run, drafting: &mut Drafting, work: &mut Budget, legs: &mut [Leg]) -> bool {
    let Some(Fit { knots, spans }) = knots::fit(run, drafting, work) else { return false };
    let count = run.places.len();
    for (k, span) in spans.iter().enumerate() {
        let from = knots[k];
        let to = knots.get(k + 1).copied().unwrap_or(knots[0] + count);
        // Vertices on the curve split its span at the nearest point.
        let nearest = |i: usize| {
            let distance = |k: &usize| (span[*k] - run.at(i)).norm();
            (0..span.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
        };
        let mut cuts: Vec<usize> = (from + 1..to).map(nearest).collect();
        cuts.sort_unstable();
        let bounds: Vec<usize> = std::iter::once(0).chain(cuts).chain([span.len()]).collect();
        for (edge, part) in (from..to).zip(bounds.windows(2)) {
            let next = run.line.vertices[run.places[(edge + 1) % count]].span;
            let leg = &mut legs[run.places[edge % count]];
            if edge > from {
                leg.clear();
            }
            leg.extend(span[part[0]..part[1]].iter().map(|&at| Vertex { at, span: next }));
        }
    }
    true
}
