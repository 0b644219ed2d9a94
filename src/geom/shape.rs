//! Shapes that rings bound: where they lie, and a place well inside.

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

    /// The box around it.
    pub fn extent(&self) -> Extent {
        self.extent
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
