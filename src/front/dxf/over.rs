//! Pieces that the file puts on others: no cloth has room for both.

use super::lay::Laid;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::shape::Shape;
use crate::geom::{Extent, Point, ring};
use crate::source::Span;

/// A piece where it lies: its outline, and the cut-outs in it.
struct Cloth {
    span: Span,
    outline: Vec<Point>,
    cut_outs: Vec<Vec<Point>>,
}

impl Cloth {
    fn of(Laid { piece, motion }: &Laid) -> Self {
        let moved = |points: Vec<Point>| points.into_iter().map(|at| motion.place(at)).collect();
        Self {
            span: piece.span,
            outline: moved(piece.plain.points()),
            cut_outs: piece.inner.iter().map(|line| moved(line.points())).collect(),
        }
    }

    /// A place in its cloth, far from all edges.
    fn middle(&self) -> Option<Point> {
        let rings: Vec<&Vec<Point>> = std::iter::once(&self.outline).chain(&self.cut_outs).collect();
        Shape::new(&rings).inner()
    }

    fn has(&self, at: Point, work: &mut Budget) -> bool {
        let rings = || std::iter::once(&self.outline).chain(&self.cut_outs);
        let vertices = rings().map(Vec::len).sum();
        work.spend(vertices) && rings().filter(|points| ring::contains(points, at)).count() == 1
    }
}

/// Those whose middle lies in the cloth of another, as far as there is work left to find out.
pub(super) fn on_others(laid: &[Laid], work: &mut Budget) -> Vec<Span> {
    let all: Vec<Cloth> = laid.iter().map(Cloth::of).collect();
    let boxes = Boxes::new(all.iter().map(|cloth| Extent::of(&cloth.outline)).collect());
    let is_on_another = |(i, cloth): &(usize, &Cloth)| {
        let Some(middle) = cloth.middle() else { return false };
        boxes.at(middle).any(|k| k != *i && all[k].has(middle, work))
    };
    all.iter().enumerate().filter(is_on_another).map(|(_, cloth)| cloth.span).collect()
}
