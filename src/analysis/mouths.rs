//! Places of the notches in an outline.

use std::collections::BTreeMap;

use crate::geom::{Point, bits};
use crate::ir::marker::OutlineNotch;

/// Notches of an outline with these edges, each with the index of its first edge, in the order of the edges. Of nested notches
/// only the first is included.
pub fn mouths<'a>(edges: &[[Point; 2]], notches: &'a [OutlineNotch]) -> Vec<(usize, &'a OutlineNotch)> {
    let mut at: BTreeMap<[u64; 2], Vec<&OutlineNotch>> = BTreeMap::new();
    for notch in notches {
        at.entry(bits(notch.mouth[0])).or_default().push(notch);
    }
    let count = edges.len();
    let mut found: Vec<(usize, &OutlineNotch)> = Vec::new();
    let mut is_gone = vec![false; count];
    for (i, [from, _]) in edges.iter().enumerate() {
        let opens = at.get(&bits(*from)).map_or(&[][..], Vec::as_slice);
        let ends = |notch: &OutlineNotch| edges[(i + notch.segments as usize - 1) % count][1];
        let fits = |notch: &&&OutlineNotch| (notch.segments as usize) < count && ends(notch) == notch.mouth[1];
        let Some(&notch) = opens.iter().find(fits).filter(|_| !is_gone[i]) else { continue };
        (1..notch.segments as usize).for_each(|k| is_gone[(i + k) % count] = true);
        found.push((i, notch));
    }
    // A notch that begins inside another one across the end of the list does not count.
    found.retain(|(i, _)| !is_gone[*i]);
    found
}

/// Points of a ring, which ends with its first, without those of its notches: the ring runs straight over their mouths.
pub fn bridged(points: &[Point], notches: &[OutlineNotch]) -> Vec<Point> {
    let edges: Vec<[Point; 2]> = points.windows(2).map(|ends| [ends[0], ends[1]]).collect();
    let count = edges.len();
    let mut is_gone = vec![false; count];
    for (first, notch) in mouths(&edges, notches) {
        (1..notch.segments as usize).for_each(|k| is_gone[(first + k) % count] = true);
    }
    let mut left: Vec<Point> =
        points.iter().zip(&is_gone).filter(|(_, gone)| !**gone).map(|(&point, _)| point).collect();
    left.extend(left.first().copied());
    left
}
