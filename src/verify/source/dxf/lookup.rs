//! Point lookup by position, in a grid.

use crate::geom::Point;

/// Points in cells as wide as the search radius, each with its original index.
#[derive(Debug)]
pub(super) struct Lookup {
    reach: f64,
    places: Vec<([i64; 2], Point, usize)>,
}

impl Lookup {
    /// Lookup of points within `reach` mm.
    pub(super) fn of(points: impl Iterator<Item = Point>, reach: f64) -> Self {
        let mut lookup = Self { reach, places: Vec::new() };
        lookup.places = points.zip(0..).map(|(point, k)| (lookup.cell(point), point, k)).collect();
        lookup.places.sort_by_key(|&(cell, _, k)| (cell, k));
        lookup
    }

    fn cell(&self, at: Point) -> [i64; 2] {
        [at.x, at.y].map(|value| (value / self.reach).floor() as i64)
    }

    /// Indices of the points within reach of a point.
    pub(super) fn near(&self, at: Point) -> impl Iterator<Item = usize> + '_ {
        let [x, y] = self.cell(at);
        let column = move |x: i64| {
            let first = self.places.partition_point(|(cell, ..)| *cell < [x, y - 1]);
            self.places[first..].iter().take_while(move |(cell, ..)| *cell <= [x, y + 1])
        };
        let around = (x - 1..=x + 1).flat_map(column);
        around.filter(move |(_, point, _)| (point - at).norm() <= self.reach).map(|&(.., k)| k)
    }

    /// True if a point is within reach.
    pub(super) fn has(&self, at: Point) -> bool {
        self.near(at).next().is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn those_within_reach_are_found_whatever_cells_they_are_in() {
        let lookup = Lookup::of([[0.0, 0.0], [0.9, 0.0], [1.1, 0.0], [-0.9, -0.1]].map(Point::from).into_iter(), 1.0);
        let mut found: Vec<usize> = lookup.near(Point::new(0.05, 0.0)).collect();
        found.sort_unstable();
        assert_eq!(found, [0, 1, 3]);
        assert!(lookup.has(Point::new(2.0, 0.2)) && !lookup.has(Point::new(2.2, 0.0)));
    }
}
