//! Chains of vertices: the path of the knife between interruptions, and across them.

use super::vertex::Vertices;
use crate::geom::Point;
use crate::ir::list::{Range, SegmentList};
use crate::ir::marker::Notch;
use crate::source::Span;

/// Maximum number of vertices of a stroke; one that reverses more often is not a slit.
const STROKE_VERTICES: usize = 8;

/// Permission of overcut at the lift that ends a chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Overcut {
    /// Overcut as at any end.
    Usual,
    /// No overcut: M18, M19 or a slit.
    Forbidden,
}

/// A cut that begins at a plunge and may continue after interruptions.
#[derive(Debug)]
pub(super) struct Chain {
    /// Index of the piece. In a file without N, a stroke has none until a contour claims it.
    pub(super) piece: Option<usize>,
    pub(super) vertices: Vertices,
    /// True for a slit, which is cut before the outlines.
    pub(super) slit: bool,
    /// Overcut of the lift at its end; `None` if the knife left it for a slit.
    pub(super) lift: Option<Overcut>,
}

impl Chain {
    /// The points of the chain.
    pub(super) fn points(&self) -> &[Point] {
        self.vertices.points()
    }

    /// Location of its start in the source.
    pub(super) fn start(&self) -> Span {
        self.vertices.get(0).expect("a chain has a vertex").span
    }

    /// True if all of its points are equal.
    pub(super) fn is_point(&self) -> bool {
        self.points().iter().all(|&at| at == self.points()[0])
    }

    pub(super) fn ends(&self) -> (Point, Point) {
        let points = self.points();
        (points[0], points[points.len() - 1])
    }

    /// True if it runs only between two near points, as slits and crossbars do.
    pub(super) fn is_stroke(&self) -> bool {
        if self.points().len() > STROKE_VERTICES {
            return false;
        }
        let first = self.points()[0];
        let Some(second) = self.points().iter().copied().find(|&at| at != first) else { return false };
        (second - first).norm() <= Notch::LONGEST && self.points().iter().all(|&at| at == first || at == second)
    }

    /// Writes the chain into a list. The joint of its first segment holds the flags of the plunge at the start and of the lift
    /// at the end.
    pub(super) fn write(&mut self, list: &mut SegmentList) -> Option<Range> {
        if self.lift == Some(Overcut::Forbidden) {
            self.vertices.joint_mut(0).no_overcut = true;
        }
        self.vertices.write(list)
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostic::Diagnostics;
    use crate::machine::Job;
    use crate::source::Source;

    #[test]
    fn what_is_cut_through_plain_blocks_is_cut_as_through_any() {
        let plain = "F90*X0Y0*M14*X90Y0*X90Y90*M46*X0Y90*X5Y95*X9Y99*M25*F30*X7Y7*X6Y6*X5Y0*M15*M0*";
        let [(plain, feed), signed] = [plain, &plain.replace('X', "X+")].map(|text| {
            let source = Source::new("a", text.as_bytes().to_vec()).expect("small");
            let marker = crate::front::iso::lower::lower(&source, &Job::default(), &mut Diagnostics::default());
            let segments = marker.contours().flat_map(|(_, contour)| marker.list.walk(contour.range));
            let cut: Vec<_> = segments.map(|(_, s)| (s.to, s.joint, s.percent, s.span.block)).collect();
            (cut, marker.pieces[0].feed)
        });
        assert!(plain.iter().any(|segment| segment.1.lift) && plain.iter().any(|segment| segment.2 < 100));
        assert_eq!((plain, feed), signed);
    }
}
