//! Points, angles, polylines and splines of the plane, in mm and rad. The only home of nalgebra.
//!
//! The module works on plain numbers, follows exact conventions (which angle is wrapped, which end of a segment is included)
//! and does not know what the geometry is for.

pub mod affine;
pub mod again;
pub mod along;
pub mod angle;
pub mod boxes;
pub mod budget;
pub mod closing;
pub mod corner;
pub mod fade;
pub mod moments;
pub mod monotone;
pub mod near;
pub mod polyline;
pub mod region;
pub mod ring;
pub mod shape;
pub mod slots;
pub mod spline;

pub use angle::{Heading, Rotation};

/// A point of the plane, mm.
pub type Point = nalgebra::Point2<f64>;
/// A displacement in the plane, mm, or a unit vector.
pub type Vector = nalgebra::Vector2<f64>;

/// z component of the cross product: positive when `b` lies to the left of `a`.
pub fn cross(a: Vector, b: Vector) -> f64 {
    a.x * b.y - a.y * b.x
}

/// The vector rotated by a quarter turn to the left.
pub fn left(v: Vector) -> Vector {
    Vector::new(-v.y, v.x)
}

/// Bit patterns of a point's coordinates. Equal points have equal bits, since both zeros map to one.
pub fn bits(point: Point) -> [u64; 2] {
    [(point.x + 0.0).to_bits(), (point.y + 0.0).to_bits()]
}

/// The lesser of two coordinates. For numbers, which coordinates always are, it compiles to one instruction; `f64::min` takes
/// four.
fn lesser(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// The greater of two coordinates, in one instruction.
fn greater(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

/// An axis-parallel box, mm. The empty box has `min > max`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Lower left corner.
    pub min: Point,
    /// Upper right corner.
    pub max: Point,
}

impl Extent {
    /// The empty box.
    pub const EMPTY: Self =
        Self { min: Point::new(f64::INFINITY, f64::INFINITY), max: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY) };

    /// Bounding box of some points.
    pub fn of(points: &[Point]) -> Self {
        // Four boxes at once: with a single box each point waits for the one before.
        let (fours, rest) = points.as_chunks::<4>();
        let mut boxes = [Self::EMPTY; 4];
        for four in fours {
            boxes.iter_mut().zip(four).for_each(|(extent, &point)| extent.add(point));
        }
        boxes.iter_mut().zip(rest).for_each(|(extent, &point)| extent.add(point));
        let [mut all, others @ ..] = boxes;
        for other in &others {
            all.join(other);
        }
        all
    }

    /// The box with two opposite corners.
    pub fn between(a: Point, b: Point) -> Self {
        Self {
            min: Point::new(lesser(a.x, b.x), lesser(a.y, b.y)),
            max: Point::new(greater(a.x, b.x), greater(a.y, b.y)),
        }
    }

    /// Grows the box to hold `point`.
    pub fn add(&mut self, point: Point) {
        self.min = Point::new(lesser(self.min.x, point.x), lesser(self.min.y, point.y));
        self.max = Point::new(greater(self.max.x, point.x), greater(self.max.y, point.y));
    }

    /// Grows the box to hold another.
    pub fn join(&mut self, other: &Self) {
        self.min = Point::new(lesser(self.min.x, other.min.x), lesser(self.min.y, other.min.y));
        self.max = Point::new(greater(self.max.x, other.max.x), greater(self.max.y, other.max.y));
    }

    /// The box enlarged by `reach` on all sides, mm.
    #[must_use]
    pub fn grown(&self, reach: f64) -> Self {
        let reach = Vector::new(reach, reach);
        Self { min: self.min - reach, max: self.max + reach }
    }

    /// True if the two boxes share more than parts of their edges. Only then can a line in one cross a line in the other: lines
    /// in boxes that touch at an edge can only meet along it.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.min.x < other.max.x && other.min.x < self.max.x && self.min.y < other.max.y && other.min.y < self.max.y
    }

    /// True if the two boxes share a point, edges included.
    pub fn meets(&self, other: &Self) -> bool {
        self.min.x <= other.max.x && other.min.x <= self.max.x && self.min.y <= other.max.y && other.min.y <= self.max.y
    }

    /// True if the box of a segment shares a point with the box, edges included.
    pub fn meets_box_of(&self, [a, b]: [Point; 2]) -> bool {
        let meets = |a: f64, b: f64, low: f64, high: f64| (a <= high || b <= high) && (a >= low || b >= low);
        meets(a.x, b.x, self.min.x, self.max.x) && meets(a.y, b.y, self.min.y, self.max.y)
    }

    /// True if another box lies within this one.
    pub fn covers(&self, other: &Self) -> bool {
        self.holds(other.min) && self.holds(other.max)
    }

    /// True if a point lies in the box or on its edge.
    pub fn holds(&self, point: Point) -> bool {
        (self.min.x..=self.max.x).contains(&point.x) && (self.min.y..=self.max.y).contains(&point.y)
    }

    /// The part of a segment inside the box, in its direction; `None` when there is none.
    pub fn clip(&self, [from, to]: [Point; 2]) -> Option<[Point; 2]> {
        let way = to - from;
        let (mut low, mut high) = (0.0, 1.0);
        for axis in 0..2 {
            let [near, far] = [self.min, self.max].map(|corner| corner[axis] - from[axis]);
            if way[axis] == 0.0 {
                if near > 0.0 || far < 0.0 {
                    return None;
                }
                continue;
            }
            let [a, b] = [near, far].map(|away| away / way[axis]);
            (low, high) = (greater(low, lesser(a, b)), lesser(high, greater(a, b)));
        }
        // Keep an end inside the box bit for bit.
        let place = |share: f64| if share == 1.0 { to } else { from + way * share };
        (low <= high).then(|| [place(low), place(high)])
    }

    /// True if nothing has been added yet.
    pub fn is_empty(&self) -> bool {
        self.min.x > self.max.x
    }

    /// Width and height, mm; zero when empty.
    pub fn size(&self) -> (f64, f64) {
        if self.is_empty() { (0.0, 0.0) } else { (self.max.x - self.min.x, self.max.y - self.min.y) }
    }
}
