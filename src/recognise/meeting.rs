//! Places where ends of strokes meet: groups of ends of one pen within reach of the first of them.

use std::collections::BTreeMap;

use crate::geom::Point;

/// Index, for each end, of the nearest earlier end that is the first at its place; its own index if there is none. Ends are
/// given with their pens. `reach` is the greatest distance of an end from the first one at its place, along an axis, mm.
pub(super) fn places(ends: &[(u16, Point)], reach: f64) -> Vec<usize> {
    let cell = |at: Point| [at.x, at.y].map(|mm| (mm / reach).floor() as i64);
    // A cell is as wide as the reach, so it contains at most one first end of a pen.
    let mut first: BTreeMap<(u16, [i64; 2]), usize> = BTreeMap::new();
    let mut places = Vec::with_capacity(ends.len());
    for (end, &(pen, at)) in ends.iter().enumerate() {
        let [x, y] = cell(at);
        let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (pen, [x, y])));
        let known = around.filter_map(|cell| first.get(&cell)).map(|&known| ((ends[known].1 - at).amax(), known));
        let nearest = known.filter(|(apart, _)| *apart <= reach).min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let place = nearest.map_or(end, |(_, known)| known);
        if place == end {
            // Two ends of a cell may be an ulp farther apart than the reach.
            first.entry((pen, [x, y])).or_insert(end);
        }
        places.push(place);
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_of_one_pen_meet_within_reach_of_the_first() {
        let at = |pen: u16, x: f64| (pen, Point::new(x, 0.0));
        // The third is within reach of the second only, and the last has another pen.
        let ends = [at(1, 0.0), at(1, 0.15), at(1, 0.3), at(1, -0.2), at(2, 0.0)];
        assert_eq!(places(&ends, 0.2), [0, 0, 2, 0, 4]);
        assert_eq!(places(&[at(1, 0.0), at(1, 0.3), at(1, 0.16)], 0.2), [0, 1, 1], "the nearer one");
    }
}
