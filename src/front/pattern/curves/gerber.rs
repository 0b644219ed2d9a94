//! Curves of Gerber `AccuMark`: the middles of chords are lifted by the tangents at their ends until the chords are flat.

use super::hermite::bowed;
use super::leg::Stretch;
use crate::geom::{Point, Vector, polyline};

/// Height at which a chord is divided, mm: the curve tolerance of 0.006 in that these files name.
const DIVIDED: f64 = 0.1524;
/// Part of an eighth of the chord by which a half is lifted for each unit of difference of the tangents.
const LIFT: f64 = 0.98;
/// Rounds of division: each makes chords shorter by a quarter at least, so the longest table needs fewer.
const MOST_ROUNDS: usize = 48;

/// A vertex of the curve so far.
#[derive(Debug, Clone, Copy)]
struct Node {
    at: Point,
    /// Whether the chord that begins here may still be divided.
    is_active: bool,
    is_knot: bool,
}

/// Places between each two neighbours of a run of knots, in chords within `sagitta` mm; `None` where that takes more than
/// `most` places.
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

/// Directions of the curve: at an inner vertex the bisector of its chords, at an end the direction of the chord there.
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
