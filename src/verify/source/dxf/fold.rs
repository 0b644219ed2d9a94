//! Folds of half pieces, found anew: edges on the fold, and mirror images of places.

use super::lines::{MEETS, Path, Round};
use crate::geom::{Point, Vector, cross, left};

/// A fold line as drawn, and the axis of the mirror.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fold {
    drawn: Axis,
    length: f64,
    about: Axis,
}

/// A place on a straight line, and its direction.
#[derive(Debug, Clone, Copy)]
struct Axis {
    from: Point,
    along: Vector,
}

impl Axis {
    fn between(from: Point, to: Point) -> Self {
        Self { from, along: (to - from) / (to - from).norm() }
    }

    fn off(&self, at: Point) -> f64 {
        cross(self.along, at - self.from)
    }

    fn station(&self, at: Point) -> f64 {
        (at - self.from).dot(&self.along)
    }
}

impl Fold {
    /// Fold from the first point of a line to its last; `None` if it has no length.
    pub(super) fn of(path: &Path) -> Option<Self> {
        let (first, last) = (path.points.first()?, path.points.last()?);
        let length = (last - first).norm();
        let drawn = Axis::between(*first, *last);
        (length > MEETS).then_some(Self { drawn, length, about: drawn })
    }

    /// True if the line between two places lies on the fold: it is collinear with the fold and overlaps it.
    fn has(&self, ends: [Point; 2]) -> bool {
        let [a, b] = ends.map(|end| self.drawn.station(end));
        let both = a.max(b).min(self.length) - a.min(b).max(0.0);
        ends.iter().all(|end| self.drawn.off(*end).abs() <= MEETS) && both >= (a - b).abs().min(MEETS)
    }

    /// True if an edge lies on it; for a curve its middle must lie on it, too.
    pub(super) fn has_edge(&self, ends: [Point; 2], curve: Option<Round>) -> bool {
        let middle = curve.map_or(ends[0], |round| round.at(0.5));
        self.has(ends) && self.drawn.off(middle).abs() <= MEETS
    }

    pub(super) fn off(&self, at: Point) -> f64 {
        self.about.off(at)
    }

    /// Neighbours of a vertex on the whole outline: those on the half, but a neighbour along the fold is replaced by the mirror
    /// image of the other one.
    pub(super) fn neighbours(&self, at: Point, [before, behind]: [Point; 2]) -> [Point; 2] {
        match [before, behind].map(|end| self.has_edge([end, at], None)) {
            [true, false] => [self.across(behind), behind],
            [false, true] => [before, self.across(before)],
            _ => [before, behind],
        }
    }

    /// Place on the other half.
    pub(super) fn across(&self, at: Point) -> Point {
        at - left(self.about.along) * (2.0 * self.off(at))
    }

    /// True if lines lie on one side of the fold and not all of them on the fold itself: then they are half of an outline.
    pub(super) fn halves(&self, paths: &[Path]) -> bool {
        let middles = |path: &Path| path.curves.iter().flatten().map(|round| round.at(0.5)).collect::<Vec<_>>();
        let places = || paths.iter().flat_map(|path| path.points.iter().copied().chain(middles(path)));
        let offs = || places().map(|at| self.drawn.off(at));
        offs().any(|off| off > MEETS) != offs().any(|off| off < -MEETS)
    }

    /// Fold of a half piece: if an edge of the outline is at least as long on the fold line as the line itself, the longest
    /// such edge is the axis.
    pub(super) fn of_half(self, outlines: &[Path]) -> Self {
        let edges = outlines.iter().flat_map(|path| (0..path.curves.len()).map(|k| (path.edge(k), path.curves[k])));
        let mut longest = self.length - 2.0 * MEETS;
        let mut fold = self;
        for (ends, _) in edges.filter(|(ends, curve)| self.has_edge(*ends, *curve)) {
            let length = (ends[1] - ends[0]).norm();
            if length > longest || (length >= longest && fold.about.from == self.about.from) {
                (longest, fold.about) = (length, Axis::between(ends[0], ends[1]));
            }
        }
        fold
    }
}

impl Round {
    /// Arc on the other half.
    pub(super) fn across(&self, fold: Fold) -> Self {
        let start = fold.across(self.at(0.0)) - fold.across(self.centre);
        Self { centre: fold.across(self.centre), start: start.y.atan2(start.x), sweep: -self.sweep, ..*self }
    }
}
