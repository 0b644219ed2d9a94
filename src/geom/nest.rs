//! What lies in what: whose cut-out a shape is.

use rayon::prelude::*;

use super::{Extent, Point};

/// Where between the bottom and the top of a shape a point inside it is looked for: seldom at the height of an edge.
const LEVEL: f64 = 0.381_966;

/// A shape: what there is to know of the rings that bound it by the even-odd rule.
#[derive(Debug, Clone)]
pub struct Shape {
    extent: Extent,
    /// A point well inside; `None` when there is no inside.
    inner: Option<Point>,
}

impl Shape {
    /// The shape that rings bound; whether they repeat their first points does not matter.
    pub fn new<R: AsRef<[Point]>>(rings: &[R]) -> Self {
        let mut extent = Extent::EMPTY;
        rings.iter().flat_map(AsRef::as_ref).for_each(|&point| extent.add(point));
        Self { extent, inner: inner_point(rings, extent) }
    }

    /// A point well inside; `None` when there is no inside.
    pub fn inner(&self) -> Option<Point> {
        self.inner
    }
}

fn inner_point<R: AsRef<[Point]>>(rings: &[R], extent: Extent) -> Option<Point> {
    let (_, height) = extent.size();
    let y = extent.min.y + LEVEL * height;
    let rings = rings.iter().map(AsRef::as_ref);
    let edges = rings.flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
    let crossing = edges.filter(|(a, b)| (a.y > y) != (b.y > y));
    let mut crossings: Vec<f64> = crossing.map(|(a, b)| a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y)).collect();
    crossings.sort_by(f64::total_cmp);
    let inside = crossings.chunks_exact(2).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
    Some(Point::new(f64::midpoint(inside[0], inside[1]), y))
}

/// For each shape the one to whose region it belongs: itself, or, when it lies in one other or in three, the smallest of
/// these, of which it is a cut-out. A shape in a cut-out is a region of its own. `holders` names the shapes in whose rings a
/// point lies.
pub fn regions(shapes: &[Shape], holders: impl Fn(Point) -> Vec<u32> + Sync) -> Vec<u32> {
    let area = |shape: u32| {
        let (width, height) = shapes[shape as usize].extent.size();
        width * height
    };
    let holder = |own: u32| {
        let shape = &shapes[own as usize];
        let mut holders = holders(shape.inner?);
        holders.retain(|&other| other != own && shapes[other as usize].extent.covers(&shape.extent));
        let smallest = holders.iter().copied().min_by(|&a, &b| area(a).total_cmp(&area(b)).then(a.cmp(&b)));
        smallest.filter(|_| holders.len() % 2 == 1)
    };
    let count = shapes.len() as u32;
    let mut regions: Vec<u32> = (0..count).collect();
    // The largest first: what holds a shape is larger than it, and settled before.
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
        regions(&shapes, |point| index.owners_at(point))
    }

    #[test]
    fn what_lies_in_a_part_is_its_cut_out_and_what_lies_in_that_a_part_again() {
        let shapes = [square(40.0, 60.0), square(0.0, 100.0), square(20.0, 80.0), square(45.0, 50.0)];
        assert_eq!(nested(&shapes), [0, 1, 1, 0]);
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
