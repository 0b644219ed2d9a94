//! Half pieces: what is drawn on one side of a fold line is on the other, too, and the fold itself is no line.

use super::chain::{Chain, REACH};
use crate::geom::{Point, Vector, cross, left};
use crate::ir::drawing::Vertex;

/// Vertices of a chain from fold to fold that has an inside.
const LEAST_HALF: usize = 3;

/// A fold line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fold {
    from: Point,
    /// Unit vector.
    along: Vector,
    /// mm.
    length: f64,
}

/// Why an outline is not unfolded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Refusal {
    /// It lies on both sides: both halves are drawn.
    Across,
    /// Not one of its edges lies on the fold.
    Beside,
    /// Several of its edges do, with others between them.
    Several,
}

impl Fold {
    /// The line from the first of some places to the last; `None` when it has no length.
    pub(super) fn of(line: &[Vertex]) -> Option<Self> {
        let [first, .., last] = line else { return None };
        let way = last.at - first.at;
        let length = way.norm();
        (length > REACH).then(|| Self { from: first.at, along: way / length, length })
    }

    /// Whether another line is drawn over it.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        let ends = [other.from, other.from + other.along * other.length];
        (other.length - self.length).abs() <= REACH && ends.into_iter().all(|end| self.has(end))
    }

    /// How far a place lies to the left of the line, mm.
    fn offset(&self, at: Point) -> f64 {
        cross(self.along, at - self.from)
    }

    /// Whether a place lies on the fold itself.
    fn has(&self, at: Point) -> bool {
        let station = self.along.dot(&(at - self.from));
        self.offset(at).abs() <= REACH && (-REACH..=self.length + REACH).contains(&station)
    }

    /// Whether a place has none on the other side.
    pub(super) fn is_middle(&self, at: Point) -> bool {
        self.offset(at).abs() <= REACH
    }

    /// The same place on the other side.
    pub(super) fn mirror(&self, at: Point) -> Point {
        at - left(self.along) * (2.0 * self.offset(at))
    }

    /// The same direction on the other side.
    pub(super) fn mirror_way(&self, way: Vector) -> Vector {
        way - left(self.along) * (2.0 * cross(self.along, way))
    }

    fn is_across(&self, line: &Chain) -> bool {
        let offsets = || line.vertices.iter().map(|vertex| self.offset(vertex.at));
        offsets().any(|offset| offset > REACH) && offsets().any(|offset| offset < -REACH)
    }

    /// The whole of an outline of which half is drawn; it may be open where the fold is.
    pub(super) fn unfold_outline(&self, outline: &Chain) -> Result<Chain, Refusal> {
        if self.is_across(outline) {
            return Err(Refusal::Across);
        }
        let halves: Vec<Vec<Vertex>> =
            self.halves(outline).into_iter().filter(|half| half.len() >= LEAST_HALF).collect();
        match &halves[..] {
            [half] if self.ends_on(half) == [true; 2] => Ok(self.whole(half)),
            [] | [_] => Err(Refusal::Beside),
            [..] => Err(Refusal::Several),
        }
    }

    /// A line inside a half piece, on both sides: one line where it meets the fold, else two.
    pub(super) fn unfold(&self, line: &Chain) -> Vec<Chain> {
        if self.is_across(line) {
            return vec![line.clone()];
        }
        let mut lines = Vec::new();
        for half in self.halves(line) {
            let mirrored = || half.iter().map(|vertex| Vertex { at: self.mirror(vertex.at), ..*vertex });
            if half.iter().all(|vertex| self.is_middle(vertex.at)) {
                lines.extend(Chain::of(half, false));
                continue;
            }
            let is_ring = line.is_closed && half.len() == line.vertices.len() && self.ends_on(&half) != [true; 2];
            match self.ends_on(&half) {
                _ if is_ring => {
                    lines.push(line.clone());
                    lines.extend(Chain::of(
                        line.vertices.iter().map(|v| Vertex { at: self.mirror(v.at), ..*v }).collect(),
                        true,
                    ));
                }
                [true, true] if half.len() >= LEAST_HALF => lines.push(self.whole(&half)),
                [_, true] => {
                    let there_and_on = half.iter().copied().chain(mirrored().rev().skip(1));
                    lines.extend(Chain::of(there_and_on.collect(), false));
                }
                [true, false] => {
                    let there_and_on = mirrored().rev().chain(half.iter().copied().skip(1));
                    lines.extend(Chain::of(there_and_on.collect(), false));
                }
                [false, false] => {
                    lines.extend(Chain::of(mirrored().collect(), false));
                    lines.extend(Chain::of(half, false));
                }
            }
        }
        lines
    }

    /// Whether a chain starts and whether it ends on the fold.
    fn ends_on(&self, half: &[Vertex]) -> [bool; 2] {
        [half.first(), half.last()].map(|vertex| vertex.is_some_and(|vertex| self.has(vertex.at)))
    }

    /// What is left of a line without its edges on the fold.
    fn halves(&self, line: &Chain) -> Vec<Vec<Vertex>> {
        let vertices = &line.vertices;
        let count = vertices.len();
        let edges = if line.is_closed { count } else { count - 1 };
        let is_fold = |edge: usize| self.has(vertices[edge].at) && self.has(vertices[(edge + 1) % count].at);
        // A ring is walked from behind an edge on the fold.
        let first = if line.is_closed {
            (0..count).find(|&edge| is_fold(edge)).map(|edge| (edge + 1) % count)
        } else {
            Some(0)
        };
        let Some(first) = first else { return vec![vertices.clone()] };
        let mut halves: Vec<Vec<Vertex>> = Vec::new();
        let mut goes_on = false;
        for edge in (0..edges).map(|k| (first + k) % count) {
            if is_fold(edge) {
                goes_on = false;
                continue;
            }
            if !goes_on {
                halves.push(vec![vertices[edge]]);
            }
            halves.last_mut().into_iter().for_each(|half| half.push(vertices[(edge + 1) % count]));
            goes_on = true;
        }
        if halves.is_empty() {
            halves.push(vertices.clone()); // all of it lies on the fold
        }
        halves
    }

    /// A chain from fold to fold, and back on the other side.
    fn whole(&self, half: &[Vertex]) -> Chain {
        let inner = &half[1..half.len() - 1];
        let back = inner.iter().rev().map(|vertex| Vertex { at: self.mirror(vertex.at), ..*vertex });
        Chain { vertices: half.iter().copied().chain(back).collect(), is_closed: true }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Span;

    fn line(places: &[[f64; 2]], is_closed: bool) -> Chain {
        let vertex = |&[x, y]: &[f64; 2]| Vertex { at: Point::new(x, y), span: Span::default() };
        Chain::of(places.iter().map(vertex).collect(), is_closed).expect("it has a length")
    }

    /// A fold along X, from 0 to 100.
    fn fold() -> Fold {
        Fold::of(&line(&[[0.0, 0.0], [100.0, 0.0]], false).vertices).expect("it has a length")
    }

    fn places(chain: &Chain) -> Vec<[f64; 2]> {
        chain.vertices.iter().map(|vertex| [vertex.at.x, vertex.at.y]).collect()
    }

    #[test]
    fn half_a_piece_becomes_a_whole_one_without_the_fold() {
        let whole = [[100.0, 0.0], [100.0, 50.0], [0.0, 50.0], [0.0, 0.0], [0.0, -50.0], [100.0, -50.0]];
        for drawn in [
            line(&[[0.0, 0.0], [100.0, 0.0], [100.0, 50.0], [0.0, 50.0]], true),
            line(&[[0.0, 0.0], [40.0, 0.0], [100.0, 0.0], [100.0, 50.0], [0.0, 50.0]], true),
            line(&[[100.0, 0.0], [100.0, 50.0], [0.0, 50.0], [0.0, 0.0]], false),
            line(&[[40.0, 0.0], [100.0, 0.0], [100.0, 50.0], [0.0, 50.0], [0.0, 0.0]], true),
        ] {
            let unfolded = fold().unfold_outline(&drawn).expect("it has an edge on the fold");
            assert!(unfolded.is_closed);
            assert_eq!(places(&unfolded), whole);
        }
    }

    #[test]
    fn an_outline_that_is_no_half_is_not_unfolded() {
        let refused = |places: &[[f64; 2]]| fold().unfold_outline(&line(places, true)).err();
        assert_eq!(refused(&[[0.0, -5.0], [100.0, -5.0], [50.0, 50.0]]), Some(Refusal::Across));
        assert_eq!(refused(&[[0.0, 5.0], [100.0, 5.0], [50.0, 50.0]]), Some(Refusal::Beside));
        let twice = [[0.0, 0.0], [20.0, 0.0], [30.0, 9.0], [40.0, 0.0], [100.0, 0.0], [100.0, 50.0], [0.0, 50.0]];
        assert_eq!(refused(&twice), Some(Refusal::Several));
    }

    #[test]
    fn lines_inside_are_on_both_sides_and_one_where_they_meet() {
        let unfolded = |places: &[[f64; 2]], is_closed| {
            let lines = fold().unfold(&line(places, is_closed));
            lines.iter().map(|line| (line.vertices.len(), line.is_closed)).collect::<Vec<_>>()
        };
        assert_eq!(unfolded(&[[10.0, 10.0], [20.0, 10.0]], false), [(2, false), (2, false)]);
        assert_eq!(unfolded(&[[10.0, 0.0], [20.0, 10.0]], false), [(3, false)]);
        assert_eq!(unfolded(&[[10.0, 9.0], [20.0, 0.0]], false), [(3, false)]);
        assert_eq!(unfolded(&[[10.0, 0.0], [15.0, 10.0], [20.0, 0.0]], false), [(4, true)]);
        assert_eq!(unfolded(&[[10.0, 0.0], [15.0, 10.0], [20.0, 0.0]], true), [(4, true)]);
        assert_eq!(unfolded(&[[10.0, 5.0], [15.0, 10.0], [20.0, 5.0]], true), [(3, true), (3, true)]);
        assert_eq!(unfolded(&[[10.0, -5.0], [15.0, 10.0], [20.0, -5.0]], true), [(3, true)]);
        assert_eq!(unfolded(&[[10.0, 0.0], [30.0, 0.0]], false), [(2, false)]);
    }
}
