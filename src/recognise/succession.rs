//! Rings that strokes draw in succession, each from the end of the previous one.
//!
//! Parts that share an edge may both draw it. At its ends the straightest continuation leads into the other part; the order of
//! the strokes distinguishes the parts. An edge that is drawn once for two parts leaves one of them without a ring: therefore a
//! ring that meets a stroke outside of all rings is dropped, and so is each ring that meets it.

use std::ops::RangeInclusive;

use super::chains::End;

/// Ends of strokes, and the places where they meet.
pub(super) struct Ends<'a> {
    pub(super) nodes: &'a [Vec<End>],
    /// Node of each end.
    pub(super) node: &'a [Option<u32>],
    /// Dead ends.
    pub(super) is_dead: &'a [bool],
}

impl Ends<'_> {
    /// Rings that meet others, each by its first and last stroke.
    pub(super) fn rings(&self) -> Vec<RangeInclusive<usize>> {
        let mut rings = self.in_succession();
        let mut ring_of = vec![None; self.is_dead.len()];
        for (k, ring) in rings.iter().enumerate() {
            ring.clone().for_each(|stroke| ring_of[stroke] = Some(k));
        }
        // A ring that meets a stroke outside of all rings is dropped, then every ring that meets it.
        let mut is_left_out = vec![false; rings.len()];
        let is_bare = |end: &End| ring_of[end / 2].is_none() && !self.is_dead[end / 2];
        let mut queue: Vec<&[End]> =
            self.nodes.iter().map(Vec::as_slice).filter(|ends| ends.iter().any(is_bare)).collect();
        while let Some(ends) = queue.pop() {
            for ring in ends.iter().filter_map(|end| ring_of[end / 2]) {
                if !std::mem::replace(&mut is_left_out[ring], true) {
                    queue.extend(rings[ring].clone().map(|stroke| self.beside(2 * stroke)));
                }
            }
        }
        let mut left_out = is_left_out.into_iter();
        rings.retain(|ring| {
            left_out.next() == Some(false) && ring.clone().any(|stroke| self.beside(2 * stroke).len() > 2)
        });
        rings
    }

    /// Consecutive strokes that return to the start of the first.
    fn in_succession(&self) -> Vec<RangeInclusive<usize>> {
        let (mut rings, mut first) = (Vec::new(), 0);
        for last in 0..self.is_dead.len() {
            if last > first && !self.meet([2 * last - 1, 2 * last]) {
                first = last;
            }
            if self.is_dead[last] {
                first = last + 1;
            } else if last > first && self.meet([2 * last + 1, 2 * first]) {
                rings.push(first..=last);
                first = last + 1;
            }
        }
        rings
    }

    /// Ends at the place of one of them.
    fn beside(&self, end: End) -> &[End] {
        self.node[end].map_or(&[], |node| &self.nodes[node as usize])
    }

    fn meet(&self, [a, b]: [End; 2]) -> bool {
        self.node[a].is_some() && self.node[a] == self.node[b]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rings of strokes between numbered places.
    fn rings(strokes: &[[usize; 2]]) -> Vec<RangeInclusive<usize>> {
        let ends = strokes.as_flattened();
        let mut nodes = vec![Vec::new(); ends.iter().max().expect("strokes") + 1];
        ends.iter().enumerate().for_each(|(end, &place)| nodes[place].push(end));
        let node: Vec<Option<u32>> = ends.iter().map(|&place| Some(place as u32)).collect();
        Ends { nodes: &nodes, node: &node, is_dead: &vec![false; strokes.len()] }.rings()
    }

    #[test]
    fn rings_that_draw_an_edge_twice_are_found_and_those_that_draw_it_once_are_not() {
        // Two squares side by side, with the places 1 and 2 in common.
        let first = [[0, 1], [1, 2], [2, 3], [3, 0]];
        let both = [&first[..], &[[1, 4], [4, 5], [5, 2], [2, 1]]].concat();
        assert_eq!(rings(&both), [0..=3, 4..=7]);
        assert_eq!(rings(&[&first[..], &[[1, 4], [4, 5], [5, 2]]].concat()), []);
        // A ring that meets no other needs no order.
        assert_eq!(rings(&first), []);
    }
}
