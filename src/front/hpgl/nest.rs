//! Which outline lies in which, and which rectangle is the frame around all of them.

use super::drawing::Drawing;
use super::shape::{Class, Shape, Wanted};
use crate::geom::{Extent, Point, ring};

/// Comparisons of boxes and visits of vertices that one plot may cost: some hundred times what the largest real ones
/// need. Drawings made to be slow are not searched to the end.
const MOST_WORK: usize = 400_000_000;
/// Places of an outline that are tried for lying in another: the most of them decide, since outlines that lie edge to
/// edge share some.
const PROBES: usize = 7;
/// A rectangle whose area is that of its box, but for rounding.
const BOX_EPSILON: f64 = 1e-6;
/// Share of a frame that the outlines in it fill at least: less, and it is a part with holes.
pub(super) const LEAST_FILL: f64 = 0.2;
/// Frames in frames that are looked for.
const MOST_FRAMES: usize = 3;

/// Marks the frames among the shapes whose outlines decide, outermost first: rectangles that hold all others, around two
/// parts at least. A rectangle around one outline alone may as well be a part with a cut-out.
pub(super) fn frames(shapes: &mut [Shape], slack: f64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..shapes.len()).filter(|&i| shapes[i].is_outline()).collect();
    order.sort_by(|&a, &b| shapes[b].area.abs().total_cmp(&shapes[a].area.abs()));
    // Rectangles that hold all the outlines behind them.
    let holds = |outer: usize, inner: &[usize]| {
        inner.iter().all(|&i| is_within(shapes[i].extent(), shapes[outer].extent(), slack))
    };
    let may_be = |k: usize| {
        let shape = &shapes[order[k]];
        shape.wanted == Wanted::Guess && is_rectangle(shape) && holds(order[k], &order[k + 1..])
    };
    let count = (0..order.len().min(MOST_FRAMES)).take_while(|&k| may_be(k)).count();
    let (frames, inner) = order.split_at(count);
    let (Some(&frame), [largest, others @ ..]) = (frames.last(), inner) else { return Vec::new() };
    let filled: f64 = inner.iter().map(|&i| shapes[i].area.abs()).sum();
    if holds(*largest, others) || filled < LEAST_FILL * shapes[frame].area.abs() {
        return Vec::new();
    }
    let frames = frames.to_vec();
    for &frame in &frames {
        shapes[frame].class = Class::Frame;
    }
    frames
}

/// Whether an outline is its own box.
pub(super) fn is_rectangle(shape: &Shape) -> bool {
    let (width, height) = shape.extent().size();
    shape.area.abs() >= (1.0 - BOX_EPSILON) * width * height
}

fn is_within(inner: &Extent, outer: &Extent, slack: f64) -> bool {
    inner.min.x >= outer.min.x - slack
        && inner.min.y >= outer.min.y - slack
        && inner.max.x <= outer.max.x + slack
        && inner.max.y <= outer.max.y + slack
}

/// For each of some outlines the index in the list of the least one that holds it.
pub(super) struct Nest {
    pub(super) parents: Vec<Option<usize>>,
    /// Whether the search ended before its time.
    pub(super) is_cut_short: bool,
}

/// Nests outlines, given as indices of shapes.
pub(super) fn nest(drawing: &Drawing, shapes: &[Shape], outlines: &[usize], slack: f64) -> Nest {
    let mut nest = Nest { parents: vec![None; outlines.len()], is_cut_short: false };
    let shape = |k: usize| &shapes[outlines[k]];
    let mut order: Vec<usize> = (0..outlines.len()).collect();
    order.sort_by(|&a, &b| shape(a).extent().min.x.total_cmp(&shape(b).extent().min.x));
    let mut rings: Vec<Vec<Point>> = vec![Vec::new(); outlines.len()];
    let mut work = MOST_WORK;
    // Outlines whose box may still hold one that starts farther along X.
    let mut active: Vec<usize> = Vec::new();
    let mut first = 0;
    for (n, &inner) in order.iter().enumerate() {
        let extent = *shape(inner).extent();
        // Those whose box starts within rounding of this one may hold it as well.
        while first < order.len() && (first <= n || shape(order[first]).extent().min.x <= extent.min.x + slack) {
            active.push(order[first]);
            first += 1;
        }
        active.retain(|&outer| shape(outer).extent().max.x + slack >= extent.min.x);
        let Some(left) = work.checked_sub(active.len()) else {
            nest.is_cut_short = true;
            return nest;
        };
        work = left;
        let mut best: Option<usize> = None;
        for &outer in &active {
            let is_larger = shape(outer).area.abs() > shape(inner).area.abs();
            let is_better = best.is_none_or(|best| shape(outer).area.abs() < shape(best).area.abs());
            if outer == inner || !is_larger || !is_better || !is_within(&extent, shape(outer).extent(), slack) {
                continue;
            }
            if rings[outer].is_empty() {
                rings[outer] = shape(outer).vertices(drawing).iter().map(|vertex| vertex.at).collect();
            }
            work = work.saturating_sub(PROBES * rings[outer].len());
            if lies_in(shape(inner), &rings[outer], drawing) {
                best = Some(outer);
            }
            if work == 0 {
                nest.is_cut_short = true;
                return nest;
            }
        }
        nest.parents[inner] = best;
    }
    nest
}

/// Whether most of some places of an outline lie in a ring.
fn lies_in(inner: &Shape, ring: &[Point], drawing: &Drawing) -> bool {
    let vertices = inner.vertices(drawing);
    let middle = |k: usize| vertices[k].at + (vertices[k + 1].at - vertices[k].at) / 2.0;
    let inside = (0..PROBES).filter(|k| ring::contains(ring, middle(k * (vertices.len() - 1) / PROBES))).count();
    2 * inside > PROBES
}
