//! Half pieces: lines on one side of a fold line also exist on the other side; the fold itself is not a line of the piece.

use super::chain::{Chain, REACH};
use super::tally::{Tally, Thing};
use super::text::{Facts, is_text};
use crate::front::dxf::entity::{Block, Entity, TEXT};
use crate::geom::{Point, Vector, cross, left};
use crate::ir::drawing::Vertex;
use crate::machine::letters::Letters;

/// Minimum number of vertices of a chain from fold to fold with an interior.
const LEAST_HALF: usize = 3;

/// Minimum ratio of the narrower to the wider side of a whole piece at its fold. Below it the fold line was meant to lie on the
/// edge.
const LEAST_SIDE: f64 = 0.1;

/// Layer of fold lines.
const LAYER: u16 = 6;
/// Phrases for a piece that is cut on the fold, in capitals.
#[rustfmt::skip] // a table: a few languages per row
const WORDS: [&str; 14] = [
    "ON FOLD", "ON THE FOLD", "STOFFBRUCH", "IM BRUCH", "AU PLI", "SUR LE PLI", "PLIURE", "SULLA PIEGA", "AL DOBLEZ",
    "EN DOBLEZ", "NA DOBRA", "STOFVOUW", "AAN DE VOUW", "НА СГИБЕ",
];

/// Words with that meaning if they stand alone.
const ALONE: [&str; 7] = ["FOLD", "BRUCH", "PLI", "PIEGA", "DOBLEZ", "DOBRA", "VOUW"];

/// Counts blocks that a text marks as cut on the fold but that have no fold line.
pub(super) fn see_missing_lines(blocks: &[(&Block, &Facts)], letters: &Letters, tally: &mut Tally) {
    let is_fold = |entity: &Entity| entity.layer() == Some(LAYER);
    let says = |entity: &&Entity| is_text(entity) && is_said(&letters.text(entity.bytes(TEXT)));
    for (block, _) in blocks.iter().filter(|(block, _)| !block.entities.iter().any(is_fold)) {
        if let Some(text) = block.entities.iter().find(says) {
            tally.add(Thing::NoFoldLine, text.span());
        }
    }
}

/// True if a text marks its piece as cut on the fold.
fn is_said(text: &str) -> bool {
    let words = text.to_uppercase();
    let words = words.split(|letter: char| !letter.is_alphanumeric()).filter(|word| !word.is_empty());
    let text = words.collect::<Vec<_>>().join(" ");
    ALONE.contains(&text.as_str()) || WORDS.iter().any(|words| format!(" {text} ").contains(&format!(" {words} ")))
}

/// A fold line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fold {
    /// The line as drawn.
    drawn: Axis,
    /// Length of the drawn line, mm.
    length: f64,
    /// Mirror axis: the drawn line, or the edge of the half along it.
    axis: Axis,
}

/// An infinite straight line.
#[derive(Debug, Clone, Copy)]
struct Axis {
    from: Point,
    /// Unit vector.
    along: Vector,
}

impl Axis {
    /// Signed distance of a point from the axis, positive to the left, mm.
    fn offset(&self, at: Point) -> f64 {
        cross(self.along, at - self.from)
    }
}

/// Reason why an outline is not unfolded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Refusal {
    /// The outline lies on both sides: both halves are drawn.
    Across,
    /// The outline lies on both sides, but with less than [`LEAST_SIDE`] of it on one.
    Lopsided,
    /// No edge of the outline lies on the fold.
    Beside,
    /// Several separate edges of the outline lie on the fold.
    Several,
}

impl Fold {
    /// The fold from the first of some vertices to the last; `None` if it has no length.
    pub(super) fn of(line: &[Vertex]) -> Option<Self> {
        let [first, .., last] = line else { return None };
        let way = last.at - first.at;
        let length = way.norm();
        let drawn = Axis { from: first.at, along: way / length };
        (length > REACH).then_some(Self { drawn, length, axis: drawn })
    }

    /// Moves the axis to the longest edge along the fold, among the drawn edges of an outline. The cloth is folded at the end
    /// of the half, and CAD systems round the fold line or draw it slightly skewed. An edge shorter than the fold line is less
    /// reliable and ignored.
    pub(super) fn about_longest(self, edges: impl Iterator<Item = [Vertex; 2]>) -> Self {
        let along = edges.filter(|edge| self.is_along(edge.map(|vertex| vertex.at)));
        let folds = along.filter_map(|edge| Self::of(&edge));
        let longest = folds.reduce(|longest, next| if next.length > longest.length { next } else { longest });
        let edge = longest.filter(|edge| edge.length >= self.length - 2.0 * REACH);
        edge.map_or(self, |edge| Self { axis: edge.axis, ..self })
    }

    /// True if another fold line coincides with it.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        let ends = [other.drawn.from, other.drawn.from + other.drawn.along * other.length];
        (other.length - self.length).abs() <= REACH
            && ends
                .into_iter()
                .all(|end| self.is_in_line(end) && (-REACH..=self.length + REACH).contains(&self.station(end)))
    }

    /// Station of a point along the drawn line, mm from its start.
    fn station(&self, at: Point) -> f64 {
        self.drawn.along.dot(&(at - self.drawn.from))
    }

    /// True if a point lies on the fold or its extension.
    fn is_in_line(&self, at: Point) -> bool {
        self.drawn.offset(at).abs() <= REACH
    }

    /// True if an edge lies along the fold, at least in part. A slit that continues beyond the fold does not.
    fn is_along(&self, [from, to]: [Point; 2]) -> bool {
        let [from_station, to_station] = [from, to].map(|at| self.station(at));
        let [least, most] = [from_station.min(to_station), from_station.max(to_station)];
        let shared = most.min(self.length) - least.max(0.0);
        self.is_in_line(from) && self.is_in_line(to) && shared >= REACH.min(most - least)
    }

    /// True if a point lies on the axis and has no mirror image.
    pub(super) fn is_middle(&self, at: Point) -> bool {
        self.axis.offset(at).abs() <= REACH
    }

    /// Mirror image of a point.
    pub(super) fn mirror(&self, at: Point) -> Point {
        at - left(self.axis.along) * (2.0 * self.axis.offset(at))
    }

    /// Mirror image of a direction.
    pub(super) fn mirror_way(&self, way: Vector) -> Vector {
        way - left(self.axis.along) * (2.0 * cross(self.axis.along, way))
    }

    fn is_across(&self, line: &Chain) -> bool {
        self.sides(line)[0] > REACH
    }

    /// Extents of a line on both sides of the fold, mm, the smaller first.
    fn sides(&self, line: &Chain) -> [f64; 2] {
        let offsets = line.vertices.iter().map(|vertex| self.drawn.offset(vertex.at));
        let [left, right] = offsets.fold([0.0, 0.0_f64], |[left, right], off| [left.max(off), right.max(-off)]);
        [left.min(right), left.max(right)]
    }

    /// The whole outline from a drawn half, which may be open at the fold.
    pub(super) fn unfold_outline(&self, outline: &Chain) -> Result<Chain, Refusal> {
        if self.is_across(outline) {
            let [less, more] = self.sides(outline);
            return Err(if less < LEAST_SIDE * more { Refusal::Lopsided } else { Refusal::Across });
        }
        let halves: Vec<Vec<Vertex>> =
            self.halves(outline).into_iter().filter(|half| half.len() >= LEAST_HALF).collect();
        match &halves[..] {
            [half] if self.ends_on(half) == [true; 2] && self.is_parted_well(half) => Ok(self.whole(half)),
            [] | [_] => Err(Refusal::Beside),
            [..] => Err(Refusal::Several),
        }
    }

    /// True if stretches in line with the fold begin at its ends. Beside a fold drawn shorter than its edge a slit cannot be
    /// distinguished from more of the fold.
    fn is_parted_well(&self, half: &[Vertex]) -> bool {
        let is_well = |end: Point, next: Point| {
            let station = self.station(end);
            !self.is_in_line(next) || station.abs() <= REACH || (station - self.length).abs() <= REACH
        };
        let count = half.len();
        is_well(half[0].at, half[1].at) && is_well(half[count - 1].at, half[count - 2].at)
    }

    /// The images of an inner line of a half piece on both sides: one line if it meets the fold, otherwise two.
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

    /// True if a chain starts on the fold, and true if it ends there.
    fn ends_on(&self, half: &[Vertex]) -> [bool; 2] {
        [half.first(), half.last()].map(|vertex| vertex.is_some_and(|vertex| self.is_in_line(vertex.at)))
    }

    /// The parts of a line without its edges on the fold.
    fn halves(&self, line: &Chain) -> Vec<Vec<Vertex>> {
        let vertices = &line.vertices;
        let count = vertices.len();
        let edges = if line.is_closed { count } else { count - 1 };
        let is_fold = |edge: usize| self.is_along([vertices[edge].at, vertices[(edge + 1) % count].at]);
        // A ring is traversed from after an edge on the fold.
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

    /// Closes a chain from fold to fold by its mirror image.
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
            // The result is independent of the overlap between the fold line and its edge.
            let short = Fold::of(&line(&[[30.0, 0.0], [80.0, 0.0]], false).vertices).expect("it has a length");
            let unfolded = short.unfold_outline(&drawn).expect("it has an edge on the fold");
            assert_eq!(places(&unfolded), whole);
            let unfolded = fold().unfold_outline(&drawn).expect("it has an edge on the fold");
            assert!(unfolded.is_closed);
            assert_eq!(places(&unfolded), whole);
        }
    }

    #[test]
    fn a_half_is_mirrored_about_its_edge_where_the_fold_line_is_drawn_beside_it() {
        let drawn = [[0.0, 0.1], [100.0, -0.1], [100.0, 50.0], [0.0, 50.0]];
        let outline = line(&drawn, true);
        let around: Vec<Vertex> = outline.round().collect();
        let about = fold().about_longest(around.windows(2).map(|edge| [edge[0], edge[1]]));
        let whole = about.unfold_outline(&outline).expect("it has an edge along the fold");
        let edge = Fold::of(&line(&drawn[..2], false).vertices).expect("it has a length");
        let lengths = |places: &[[f64; 2]]| {
            let points: Vec<Point> = places.iter().map(|&[x, y]| Point::new(x, y)).collect();
            crate::geom::polyline::length(&points)
        };
        let half = lengths(&[drawn[1], drawn[2], drawn[3], drawn[0]]);
        let around: Vec<[f64; 2]> = whole.round().map(|vertex| [vertex.at.x, vertex.at.y]).collect();
        assert!((lengths(&around) - 2.0 * half).abs() < 1e-9);
        let at = Point::new(30.0, 20.0);
        assert!((about.mirror(at) - edge.mirror(at)).norm() < 1e-9);
    }

    #[test]
    fn a_slit_in_line_with_the_fold_is_cut_and_what_may_be_either_is_refused() {
        let drawn = line(&[[0.0, 0.0], [60.0, 0.0], [100.0, 0.0], [100.0, 50.0], [0.0, 50.0]], true);
        let fold = |from: f64, to: f64| Fold::of(&line(&[[from, 0.0], [to, 0.0]], false).vertices).expect("a length");
        let unfolded = |from, to| fold(from, to).unfold_outline(&drawn).map(|whole| whole.vertices.len());
        assert_eq!([unfolded(0.0, 100.0), unfolded(0.0, 60.0)], [Ok(6), Ok(8)]);
        assert_eq!(unfolded(0.0, 40.0), Err(Refusal::Beside));
    }

    #[test]
    fn an_outline_that_is_no_half_is_not_unfolded() {
        let refused = |places: &[[f64; 2]]| fold().unfold_outline(&line(places, true)).err();
        assert_eq!(refused(&[[0.0, -9.0], [100.0, -9.0], [50.0, 50.0]]), Some(Refusal::Across));
        assert_eq!(refused(&[[0.0, -1.0], [100.0, -1.0], [100.0, 50.0], [0.0, 50.0]]), Some(Refusal::Lopsided));
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
