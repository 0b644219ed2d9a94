//! Parts of a curve between one vertex and the next.

use crate::geom::Point;
use crate::ir::drawing::Vertex;

/// Points of a curve strictly between two vertices.
pub(super) type Stretch = Vec<Point>;
/// Vertices of a line from one vertex of the coarse line up to, but excluding, the next.
pub(super) type Leg = Vec<Vertex>;
