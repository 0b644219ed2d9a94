//! Parts of a curve between one vertex and the next.

use crate::geom::Point;
use crate::ir::drawing::Vertex;

/// Places of a curve between two vertices.
pub(super) type Stretch = Vec<Point>;
/// Vertices of a line from one vertex of the coarse line on, before the next.
pub(super) type Leg = Vec<Vertex>;
