//! Places where ends of strokes meet: ends of one pen within reach of the first of them.

use std::collections::BTreeMap;

use crate::geom::Point;

/// For each end, given with its pen, the first one that is at its place: itself where no earlier one is. `reach` is the
/// farthest that ends at one place lie apart along an axis, mm.
pub(super) fn places(ends: &[(u16, Point)], reach: f64) -> Vec<usize> {
    let cell = |at: Point| [at.x, at.y].map(|mm| (mm / reach).floor() as i64);
    // First ends alone: in a cell there are few, as they lie apart.
    let mut first: BTreeMap<(u16, [i64; 2]), Vec<usize>> = BTreeMap::new();
    let mut places = Vec::with_capacity(ends.len());
    for (end, &(pen, at)) in ends.iter().enumerate() {
        let [x, y] = cell(at);
        let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (pen, [x, y])));
        let mut known = around.filter_map(|cell| first.get(&cell)).flatten();
        let place = known.find(|&&known| (ends[known].1 - at).amax() <= reach).copied().unwrap_or(end);
        if place == end {
            first.entry((pen, [x, y])).or_default().push(end);
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
        // The third lies within reach of the second alone, and the last is of another pen.
        let ends = [at(1, 0.0), at(1, 0.15), at(1, 0.3), at(1, -0.2), at(2, 0.0)];
        assert_eq!(places(&ends, 0.2), [0, 0, 2, 0, 4]);
    }
}
