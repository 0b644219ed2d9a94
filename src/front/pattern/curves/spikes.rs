//! Spikes: stretches of a line that go out and return on themselves. Curves are laid without them, so spikes are removed before
//! and restored after.

use std::collections::BTreeMap;

use super::leg::Leg;
use crate::front::pattern::chain::Chain;
use crate::geom::bits;
use crate::ir::drawing::Vertex;

/// Minimum number of vertices of a ring.
const LEAST_RING: usize = 3;

/// A line without its spikes.
#[derive(Debug)]
pub(super) struct Base {
    pub(super) line: Chain,
    /// Spike at each vertex, out and back; empty for most.
    spikes: Vec<Leg>,
}

/// Removes the spikes of a line.
pub(super) fn without(line: &Chain) -> Base {
    let mut vertices = line.vertices.clone();
    let count = vertices.len();
    // A ring that begins inside a spike is rotated to begin at a point that occurs once.
    let is_tip = |k: usize| vertices[(k + count - 1) % count].at == vertices[(k + 1) % count].at;
    if line.is_closed && (0..count).any(is_tip) {
        let mut times: BTreeMap<[u64; 2], usize> = BTreeMap::new();
        for vertex in &vertices {
            *times.entry(bits(vertex.at)).or_default() += 1;
        }
        let start = (0..count).find(|&k| !is_tip(k) && times.get(&bits(vertices[k].at)) == Some(&1));
        vertices.rotate_left(start.unwrap_or(0));
    }
    let mut kept: Vec<(Vertex, Leg)> = Vec::with_capacity(count);
    for vertex in vertices {
        match &kept[..] {
            [.., (root, _), _] if root.at == vertex.at => {
                let (tip, beyond) = kept.pop().unwrap_or((vertex, Leg::new()));
                if let Some((_, spike)) = kept.last_mut() {
                    spike.push(tip);
                    spike.extend(beyond);
                    spike.push(vertex);
                }
            }
            _ => kept.push((vertex, Leg::new())),
        }
    }
    if kept.len() < if line.is_closed { LEAST_RING } else { 2 } {
        return Base { line: line.clone(), spikes: vec![Leg::new(); count] };
    }
    let (vertices, spikes) = kept.into_iter().unzip();
    Base { line: Chain { vertices, is_closed: line.is_closed }, spikes }
}

impl Base {
    /// Restores the spikes between the legs of a curve.
    pub(super) fn put_back(&self, legs: &mut [Leg]) {
        for ((leg, spike), root) in legs.iter_mut().zip(&self.spikes).zip(&self.line.vertices) {
            if spike.is_empty() {
                continue;
            }
            let is_there = leg.first().is_some_and(|first| first.at == root.at);
            let rest = leg.split_off(usize::from(is_there));
            leg.splice(.., std::iter::once(*root).chain(spike.iter().copied()).chain(rest));
        }
    }
}
