//! Curves of Gerber `AccuMark`: the middles of chords are moved according to the tangents at their ends until the chords are
//! flat.

use super::hermite::bowed;
use super::leg::Stretch;
use crate::geom::{Point, Vector, polyline};

/// Height above which a chord is divided, mm: the curve tolerance of 0.006 in stated in these files.
const DIVIDED: f64 = 0.1524;
/// Factor of the offset of the middle of a chord, relative to an eighth of the chord length times the difference of the
/// tangents.
const LIFT: f64 = 0.98;
/// Maximum number of rounds of division. Each shortens chords by at least a quarter, so the longest table needs fewer.
const MOST_ROUNDS: usize = 48;

/// A vertex of the current polyline.
#[derive(Debug, Clone, Copy)]
struct Node {
    at: Point,
    /// True if the chord from this vertex may still be divided.
    is_active: bool,
    is_knot: bool,
}

/// Points between consecutive knots, in chords within `sagitta` mm; `None` if more than `most` points are needed.
pub(super) fn spans(knots: &[Point], sagitta: f64, most: usize) -> Option<Vec<Stretch>> {
    let mut nodes: Vec<Node> = knots.iter().map(|&at| Node { at, is_active: true, is_knot: true }).collect();
    for _ in 0..MOST_ROUNDS {
        let tangents = tangents(&nodes);
        let mut next: Vec<Node> = Vec::with_capacity(2 * nodes.len());
        for (k, &node) in nodes.iter().enumerate() {
            let lifted = nodes.get(k + 1).filter(|_| node.is_active).map(|to| {
                let length = (to.at - node.at).norm();
                let middle = node.at + (to.at - node.at) / 2.0;
                let at = middle + (tangents[k] - tangents[k + 1]) * (LIFT * length / 8.0);
                (at, polyline::distance_to_segment(at, node.at, to.at))
            });
            match lifted {
                Some((at, height)) if height > DIVIDED => {
                    next.push(node);
                    next.push(Node { at, is_active: true, is_knot: false });
                }
                _ => next.push(Node { is_active: false, ..node }),
            }
        }
        let is_done = next.len() == nodes.len();
        nodes = next;
        if nodes.len() > most {
            return None;
        }
        if is_done {
            break;
        }
    }
    let tangents = tangents(&nodes);
    let mut spans: Vec<Stretch> = Vec::with_capacity(knots.len());
    for (pair, along) in nodes.windows(2).zip(tangents.windows(2)) {
        if pair[0].is_knot {
            spans.push(Vec::new());
        }
        let span = spans.last_mut()?;
        if !pair[0].is_knot {
            span.push(pair[0].at);
        }
        span.extend(bowed([pair[0].at, pair[1].at], [along[0], along[1]], sagitta));
    }
    Some(spans)
}

/// Tangent directions: the bisector of the chords at an inner vertex, the direction of the chord at an end.
fn tangents(nodes: &[Node]) -> Vec<Vector> {
    let chord = |k: usize| (nodes[k + 1].at - nodes[k].at).try_normalize(0.0).unwrap_or_default();
    let last = nodes.len() - 1;
    let tangent = |k: usize| match k {
        0 => chord(0),
        k if k == last => chord(last - 1),
        k => (chord(k - 1) + chord(k)).try_normalize(0.0).unwrap_or_else(|| chord(k)),
    };
    (0..nodes.len()).map(tangent).collect()
}
