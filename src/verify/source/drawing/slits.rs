//! Straight strokes of a plot at the edges of cuts: a slit that is drawn by itself must be cut; an arm of a cross or a barb of
//! an arrow must not.

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, cross, polyline};

/// Range of the lengths of slits, mm.
const LENGTH: [f64; 2] = [1.5, 14.5];
/// Greatest distance of the foot of a slit from the edge; then least distance of its tip, mm.
const FOOT: f64 = 0.05;
const DEPTH: f64 = 1.2;
/// Greatest distance of two ends that meet, mm.
const MEET: f64 = 0.25;
/// Positions of a crossing on both strokes, as fractions, that may make a cross; then those that certainly do.
const MAY_CROSS: [f64; 2] = [0.15, 0.85];
const CROSS: [f64; 2] = [0.42, 0.58];
/// Greatest ratio of the lengths of two strokes that may form a sign; then of two that certainly do.
const MAY_BE_LONGER: f64 = 1.3;
const LONGER: f64 = 1.2;
/// Range of the angle between a barb of an arrow and its stem, rad; then the tolerance between the two barbs.
const BARB: [f64; 2] = [0.15, 0.9];
const EVEN: f64 = 0.08;
/// Maximum number of strokes near one that are compared.
const MOST_NEAR: usize = 256;

/// Strokes of a plot indexed by their boxes.
pub(super) struct Strokes<'a> {
    all: &'a [Vec<Point>],
    boxes: Boxes,
}

impl<'a> Strokes<'a> {
    pub(super) fn of(all: &'a [Vec<Point>]) -> Self {
        Self { all, boxes: Boxes::new(all.iter().map(|stroke| Extent::of(stroke).grown(MEET)).collect()) }
    }

    /// Strokes near a box; `None` if there are too many.
    fn near(&self, extent: Extent) -> Option<Vec<&'a Vec<Point>>> {
        let near: Vec<&Vec<Point>> = self.boxes.near(extent).take(MOST_NEAR + 1).map(|k| &self.all[k]).collect();
        (near.len() <= MOST_NEAR).then_some(near)
    }

    /// Slits on an edge that are drawn by themselves: nothing continues from their tip, and no other stroke forms a sign with
    /// them. From foot to tip.
    pub(super) fn slits(&self, edge: &[Point]) -> Vec<[Point; 2]> {
        let around = Extent::of(edge).grown(MEET);
        let is_slit = |stroke: &&Vec<Point>| stroke.len() == 2 && (LENGTH[0]..=LENGTH[1]).contains(&length(stroke));
        let strokes = self.boxes.near(around).map(|k| &self.all[k]).filter(is_slit);
        let leads = strokes.flat_map(|stroke| [[stroke[0], stroke[1]], [stroke[1], stroke[0]]]);
        let leads: Vec<[Point; 2]> = leads.collect();
        if leads.is_empty() {
            return Vec::new(); // the usual case
        }
        let chords = Boxes::new(edge.windows(2).map(|ends| Extent::between(ends[0], ends[1])).collect());
        let is_within = |at: Point, reach: f64| {
            let mut near = chords.near(Extent::between(at, at).grown(reach));
            near.any(|k| polyline::distance_to_segment(at, edge[k], edge[k + 1]) <= reach)
        };
        let stands = leads.into_iter().filter(|[foot, tip]| is_within(*foot, FOOT) && !is_within(*tip, DEPTH));
        stands.filter(|slit| self.is_alone(*slit)).collect()
    }

    /// True if a box contains more than `most` strokes for which `goes_around` is true.
    pub(super) fn has_more_in(&self, extent: Extent, most: usize, goes_around: impl Fn(&[Point]) -> bool) -> bool {
        let is_in = |k: &usize| extent.grown(MEET).covers(&self.boxes.all()[*k]) && goes_around(&self.all[*k]);
        self.boxes.near(extent).filter(is_in).take(most + 1).count() > most
    }

    fn is_alone(&self, slit: [Point; 2]) -> bool {
        let [foot, tip] = slit;
        let is_own = |stroke: &[Point]| stroke.len() == 2 && slit.iter().all(|end| stroke.contains(end));
        let Some(near) = self.near(Extent::between(foot, tip)) else { return false };
        let ends = |stroke: &[Point]| [stroke[0], stroke[stroke.len() - 1]];
        let begins = |stroke: &&&Vec<Point>| ends(stroke).iter().any(|end| (end - foot).norm() <= MEET);
        let others = || near.iter().filter(|stroke| !is_own(stroke));
        // Three lines from one place may form an arrow.
        let is_arrow = others().filter(|stroke| stroke.len() == 2).filter(begins).count() > 1;
        !is_arrow
            && others().all(|stroke| {
                let ends = ends(stroke);
                let goes_on = ends.iter().any(|end| (end - tip).norm() <= MEET);
                let is_short = length(stroke) <= 4.0 * LENGTH[1];
                let is_at_foot =
                    stroke.len() > 2 && is_short || are_alike(length(stroke), length(&slit), MAY_BE_LONGER);
                let meets = ends.iter().any(|end| (end - foot).norm() <= MEET) && is_at_foot;
                let crosses = stroke.windows(2).filter_map(|ends| crossing(slit, [ends[0], ends[1]]));
                let is_crossed =
                    || is_short && crosses.into_iter().any(|[at, _]| (MAY_CROSS[0]..=MAY_CROSS[1]).contains(&at));
                !goes_on && !meets && !is_crossed()
            })
    }

    /// True if a leg that is cut, given from its root, is an arm of a cross or a barb of an arrow.
    pub(super) fn is_sign(&self, leg: [Point; 2]) -> bool {
        let [root, tip] = leg;
        let Some(near) = self.near(Extent::between(root, tip)) else { return false };
        let own = length(&leg);
        let is_half = |at: [f64; 2]| at.iter().all(|at| (CROSS[0]..=CROSS[1]).contains(at));
        let is_crossed = near.iter().filter(|stroke| stroke.len() == 2).any(|stroke| {
            are_alike(length(stroke), own, LONGER) && crossing(leg, [stroke[0], stroke[1]]).is_some_and(is_half)
        });
        // Direction of each stroke from the root, relative to the leg, and its length.
        let straight = near.iter().filter(|stroke| stroke.len() == 2);
        let ways: Vec<(f64, f64)> = straight
            .flat_map(|stroke| [[stroke[0], stroke[1]], [stroke[1], stroke[0]]])
            .filter(|[from, _]| (from - root).norm() <= FOOT)
            .map(|[from, to]| {
                let way = to - from;
                (cross(tip - root, way).atan2((tip - root).dot(&way)), way.norm())
            })
            .collect();
        let is_barb = |stem: f64| {
            let is_other =
                |(turn, length): &(f64, f64)| are_alike(*length, own, 1.0 + EVEN) && (turn - 2.0 * stem).abs() <= EVEN;
            (BARB[0]..=BARB[1]).contains(&stem.abs()) && ways.iter().any(is_other)
        };
        is_crossed || ways.iter().any(|&(turn, length)| length >= 2.0 * own && is_barb(turn))
    }
}

fn length(stroke: &[Point]) -> f64 {
    polyline::length(stroke)
}

fn are_alike(a: f64, b: f64, ratio: f64) -> bool {
    a.max(b) <= ratio * a.min(b)
}

/// Crossing of two straight strokes, as fractions of their lengths.
fn crossing([a, b]: [Point; 2], [c, d]: [Point; 2]) -> Option<[f64; 2]> {
    let (one, other) = (b - a, d - c);
    let turn = cross(one, other);
    let at = [cross(c - a, other) / turn, cross(c - a, one) / turn];
    (turn != 0.0 && at.iter().all(|at| (0.0..=1.0).contains(at))).then_some(at)
}
