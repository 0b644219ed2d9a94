//! Shapes bounded by rings: their box and a point well inside.

use super::{Extent, Point};

/// Height of the scan line for a point inside, as a fraction of the height of the shape; seldom the height of an edge.
const LEVEL: f64 = 0.381_966;

/// Box and inner point of a shape that rings bound by the even-odd rule.
#[derive(Debug, Clone)]
pub struct Shape {
    extent: Extent,
    /// A point well inside; `None` when the shape has no interior.
    inner: Option<Point>,
}

impl Shape {
    /// The shape bounded by the rings, which may repeat their first points or not.
    pub fn new<R: AsRef<[Point]>>(rings: &[R]) -> Self {
        let mut extent = Extent::EMPTY;
        rings.iter().flat_map(AsRef::as_ref).for_each(|&point| extent.add(point));
        Self { extent, inner: inner_point(rings, extent) }
    }

    /// Bounding box.
    pub fn extent(&self) -> Extent {
        self.extent
    }

    /// A point well inside; `None` when the shape has no interior.
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
