//! Nesting of shapes: assigns cut-outs to their parts.

use std::cmp::Ordering;

use rayon::prelude::*;

use crate::geom::Point;
use crate::geom::shape::Shape;

/// Region of each shape: the shape itself, or, if it lies in an odd number of others, the region of the smallest of these, as
/// its cut-out. A shape in a cut-out is a region of its own. `holders` returns the shapes whose rings contain a point;
/// `lies_in` is true if the first shape, or most of it, lies in the second.
pub(super) fn regions(
    shapes: &[Shape],
    holders: impl Fn(Point) -> Vec<u32> + Sync,
    lies_in: impl Fn(u32, u32) -> bool + Sync,
) -> Vec<u32> {
    let area = |shape: u32| {
        let (width, height) = shapes[shape as usize].extent().size();
        width * height
    };
    let holder = |own: u32| {
        let shape = &shapes[own as usize];
        let mut holders = holders(shape.inner()?);
        // A shape inside another is the smaller one, so that two shapes never lie in each other.
        let is_larger = |other: u32| (area(other), own).partial_cmp(&(area(own), other)).is_some_and(Ordering::is_gt);
        holders.retain(|&other| is_larger(other) && lies_in(own, other));
        let smallest = holders.iter().copied().min_by(|&a, &b| area(a).total_cmp(&area(b)).then(a.cmp(&b)));
        smallest.filter(|_| holders.len() % 2 == 1)
    };
    let count = shapes.len() as u32;
    let mut regions: Vec<u32> = (0..count).collect();
    // Largest first: a shape that contains another is larger and is settled before.
    let mut by_size: Vec<u32> = (0..count).collect();
    by_size.sort_by(|&a, &b| area(b).total_cmp(&area(a)).then(a.cmp(&b)));
    let held: Vec<Option<u32>> = by_size.par_iter().map(|&own| holder(own)).collect();
    for (own, holder) in by_size.into_iter().zip(held) {
        if let Some(holder) = holder {
            regions[own as usize] = regions[holder as usize];
        }
    }
    regions
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::region::Regions;

    fn square(low: f64, high: f64) -> Vec<Point> {
        [(low, low), (high, low), (high, high), (low, high)].map(|(x, y)| Point::new(x, y)).to_vec()
    }

    fn nested(rings: &[Vec<Point>]) -> Vec<u32> {
        let index = Regions::new(0..rings.len() as u32, |owner| vec![rings[owner as usize][..].into()]);
        let shapes: Vec<Shape> = rings.iter().map(|ring| Shape::new(std::slice::from_ref(ring))).collect();
        regions(&shapes, |point| index.owners_at(point), |_, _| true)
    }

    #[test]
    fn what_lies_in_a_part_is_its_cut_out_and_what_lies_in_that_a_part_again() {
        let shapes = [square(40.0, 60.0), square(0.0, 100.0), square(20.0, 80.0), square(45.0, 50.0)];
        assert_eq!(nested(&shapes), [0, 1, 1, 0]);
    }

    #[test]
    fn a_shape_that_lies_in_no_other_is_none_of_its_cut_outs() {
        let shapes = [square(0.0, 100.0), square(20.0, 80.0)].map(|ring| Shape::new(&[ring]));
        assert_eq!(regions(&shapes, |_| vec![0, 1], |_, _| true), [0, 0]);
        assert_eq!(regions(&shapes, |_| vec![0, 1], |_, _| false), [0, 1]);
    }

    #[test]
    fn neighbours_are_regions_of_their_own_even_in_a_bay_or_edge_to_edge() {
        let bay = [
            (0.0, 0.0),
            (90.0, 0.0),
            (90.0, 90.0),
            (60.0, 90.0),
            (60.0, 30.0),
            (30.0, 30.0),
            (30.0, 90.0),
            (0.0, 90.0),
        ];
        let bay = bay.map(|(x, y)| Point::new(x, y)).to_vec();
        assert_eq!(nested(&[bay, square(30.0, 60.0), square(90.0, 120.0)]), [0, 1, 2]);
    }
}
