//! Chains of vertices: what the knife cuts between two interruptions, and beyond them.

use crate::geom::Point;
use crate::ir::list::{Joint, Segment};
use crate::ir::marker::Notch;
use crate::source::Span;

/// Most vertices of a stroke: one that goes to and fro more often is no slit.
const STROKE_VERTICES: usize = 8;

/// A place that the knife comes to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vertex {
    pub(super) at: Point,
    pub(super) span: Span,
    pub(super) joint: Joint,
    /// Speed of the way to it, percent.
    pub(super) percent: u8,
}

/// A cut that was begun, with what codes ask for in force.
#[derive(Debug)]
pub(super) struct Cutting<'a> {
    pub(super) vertices: &'a mut Vec<Vertex>,
    /// Where the knife is, mm.
    pub(super) at: &'a mut Point,
    pub(super) percent: u8,
}

impl Cutting<'_> {
    /// A move, mm, behind another one.
    pub(super) fn go(&mut self, to: Point, span: Span) {
        self.vertices.push(Vertex { at: to, span, joint: Joint::default(), percent: self.percent });
        *self.at = to;
    }
}

/// Whether the lift at the end of a chain goes past it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Overcut {
    /// As at any end.
    Usual,
    /// Not: M18, M19 or a slit.
    Forbidden,
}

/// What is cut from a plunge on, and gone on with behind interruptions.
#[derive(Debug)]
pub(super) struct Chain {
    /// In a file without N, a stroke has none before a contour claims it.
    pub(super) piece: Option<usize>,
    pub(super) vertices: Vec<Vertex>,
    /// Whether it is a slit: those are cut before the outlines.
    pub(super) slit: bool,
    /// The lift at its end, if it was left by one that is meant, not for a slit.
    pub(super) lift: Option<Overcut>,
}

impl Chain {
    /// Whether it has no extent: all of its points are equal.
    pub(super) fn is_point(&self) -> bool {
        self.vertices.iter().all(|vertex| vertex.at == self.vertices[0].at)
    }

    pub(super) fn ends(&self) -> (Point, Point) {
        (self.vertices[0].at, self.vertices[self.vertices.len() - 1].at)
    }

    /// Whether it goes between two near places only, as slits and crossbars do.
    pub(super) fn is_stroke(&self) -> bool {
        if self.vertices.len() > STROKE_VERTICES {
            return false;
        }
        let first = self.vertices[0].at;
        let Some(second) = self.vertices.iter().map(|vertex| vertex.at).find(|&at| at != first) else { return false };
        (second - first).norm() <= Notch::LONGEST
            && self.vertices.iter().all(|vertex| vertex.at == first || vertex.at == second)
    }

    /// Its segments. The joint of the first one speaks for the plunge at the start and for the lift at the end.
    pub(super) fn segments(&mut self) -> impl Iterator<Item = Segment> + Clone {
        self.vertices[0].joint.no_overcut |= self.lift == Some(Overcut::Forbidden);
        self.vertices.windows(2).map(|pair| Segment {
            from: pair[0].at,
            to: pair[1].at,
            span: pair[1].span,
            joint: pair[0].joint,
            percent: pair[1].percent,
        })
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
