//! Slits that meet across their part, which comes apart there.

use crate::analysis::outlines::Outlines;
use crate::geom::budget::Budget;
use crate::geom::polyline::{distance_of_segments, distance_to_segment};
use crate::geom::{Extent, Point, cross};
use crate::ir::marker::{Notch, Piece};

/// Width of cloth between two cuts below which it tears at the next touch, mm.
const LEAST_BRIDGE: f64 = 0.5;
/// Distance from the start of a slit within which edges and slits are those on which it begins, mm.
const AT_ROOT: f64 = 1.0;

/// Slit of a piece that reaches another one, or another edge through the part; `None` if there is none, or if the budget is
/// spent.
pub(super) fn severing(piece: &Piece, part: &Outlines, work: &mut Budget) -> Option<Notch> {
    let slits = &piece.notches;
    let deepest = slits.iter().map(Notch::depth).fold(0.0, f64::max);
    (0..slits.len())
        .find(|&i| {
            let others = Others { slits: &slits[..i], deepest, part };
            others.meet(&slits[i], work) || meets_edge(slits, i, part, work)
        })
        .map(|i| slits[i])
}

fn ends(slit: &Notch) -> [Point; 2] {
    [slit.root, slit.tip]
}

/// Other slits of a part.
struct Others<'a> {
    slits: &'a [Notch],
    /// Depth of the deepest one, mm.
    deepest: f64,
    part: &'a Outlines<'a>,
}

impl Others<'_> {
    /// True if a slit reaches one of them. Strokes from one place are one notch, and so are a slit and its branch.
    fn meet(&self, slit: &Notch, work: &mut Budget) -> bool {
        let reach = 2.0 * self.deepest + LEAST_BRIDGE;
        let mut meets = |other: &Notch| {
            let apart = (other.root - slit.root).norm_squared();
            apart < reach * reach
                && apart > AT_ROOT * AT_ROOT
                && distance_of_segments(ends(slit), ends(other)) < LEAST_BRIDGE
                && !self.is_branch(slit, other, work)
                && !self.is_branch(other, slit, work)
        };
        let met = self.slits.iter().any(&mut meets);
        work.spend(self.slits.len()) && met
    }

    /// True if a slit begins on another one, and not on the edge.
    fn is_branch(&self, slit: &Notch, other: &Notch, work: &mut Budget) -> bool {
        let around = Extent::between(slit.root, slit.root).grown(AT_ROOT);
        let is_near = |[from, to]: [Point; 2]| distance_to_segment(slit.root, from, to) <= AT_ROOT;
        begins_on_slit(slit, other) && !self.part.edges_near(around).any(|edge| work.spend(1) && is_near(edge))
    }
}

/// True if a slit begins on another one.
fn begins_on_slit(slit: &Notch, other: &Notch) -> bool {
    distance_to_segment(slit.root, other.root, other.tip) < LEAST_BRIDGE
}

/// True if a slit reaches an edge besides the one on which it begins. A slit that begins neither on an edge nor on another slit
/// is taken to begin where it first passes an edge, unless it is too long for a notch and leads out of the part.
fn meets_edge(slits: &[Notch], place: usize, part: &Outlines, work: &mut Budget) -> bool {
    let slit = &slits[place];
    let around = Extent::of(&ends(slit)).grown(LEAST_BRIDGE);
    let begins_on = |at: Point| move |edge: &[Point; 2]| distance_to_segment(at, edge[0], edge[1]) <= AT_ROOT;
    let comes_to = |edge: [Point; 2]| distance_of_segments(ends(slit), edge) < LEAST_BRIDGE;
    let is_across = |root: Point| move |edge: [Point; 2]| !begins_on(root)(&edge) && comes_to(edge);
    let mut edges = part.edges_near(around);
    if !edges.any(|edge| work.spend(1) && is_across(slit.root)(edge)) {
        return false; // the usual case
    }
    let is_branch = |work: &mut Budget| {
        let mut others = slits.iter().enumerate().filter(|(k, _)| *k != place);
        work.spend(slits.len()) && others.any(|(_, other)| begins_on_slit(slit, other))
    };
    let near: Vec<[Point; 2]> = part.edges_near(around).take_while(|_| work.spend(1)).collect();
    if near.iter().any(begins_on(slit.root)) || is_branch(work) {
        return true;
    }
    if slit.depth() > Notch::LONGEST && part.holds(slit.root) {
        return true;
    }
    let root = first_passed(slit, &near);
    near.into_iter().any(is_across(root))
}

/// Place where a slit first passes an edge; its root if it passes none.
fn first_passed(slit: &Notch, edges: &[[Point; 2]]) -> Point {
    let way = slit.tip - slit.root;
    let share = |[a, b]: &[Point; 2]| {
        let across = cross(way, b - a);
        let [share, place] = [b - a, way].map(|line| cross(a - slit.root, line) / across);
        [share, place].iter().all(|share| (0.0..=1.0).contains(share)).then_some(share)
    };
    let first = edges.iter().filter_map(share).min_by(f64::total_cmp);
    slit.root + way * first.unwrap_or(0.0)
}
