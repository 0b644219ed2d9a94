//! Edge of the cloth among the lines of a plot: a rectangle around several parts must not be cut instead of the parts, and
//! nothing outside such rectangles may be cut.

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, ring};

/// Fraction of a rectangle that uncut outlines in it must fill for it to be the edge of the cloth.
const FILLED: f64 = 0.6;
/// Smallest ratio of the areas of two adjacent outlines: a smaller one is a mark.
const LEAST_BESIDE: f64 = 0.15;
/// Maximum number of outlines in a rectangle, largest first, that are searched for two side by side.
const MOST_BESIDE: usize = 512;
/// Greatest overhang of outlines beyond the edge that they touch, mm.
const OVER: f64 = 0.5;

/// Outline of a plot.
pub(super) struct Outline<'a> {
    pub(super) stroke: &'a [Point],
    pub(super) is_rectangle: bool,
    pub(super) is_cut: bool,
}

/// Start of a rectangle that is cut although uncut outlines side by side fill it, and that surrounds nearly the whole plot.
/// Open lines may be outlines that contain others: with one inside the rectangle but outside these outlines, the result is
/// `None`.
pub(super) fn cut_edge(outlines: &[Outline], open: &[Extent]) -> Option<Point> {
    let area = |outline: &Outline| ring::area(outline.stroke).abs();
    let edge = outlines.iter().max_by(|a, b| area(a).total_cmp(&area(b))).filter(|edge| edge.is_rectangle)?;
    let reach = Extent::of(edge.stroke).grown(OVER);
    let is_in = |outline: &&Outline| area(outline) < area(edge) && reach.covers(&Extent::of(outline.stroke));
    let held: Vec<(Extent, f64)> = outlines
        .iter()
        .filter(|outline| is_in(outline) && !outline.is_cut)
        .map(|outline| (Extent::of(outline.stroke), area(outline)))
        .collect();
    let outside: f64 = outlines.iter().filter(|outline| !is_in(outline)).map(area).sum::<f64>() - area(edge);
    if !edge.is_cut || outside > area(edge) {
        return None;
    }
    let boxes = Boxes::new(held.iter().map(|(extent, _)| *extent).collect());
    let is_outermost = |k: &usize| {
        let (extent, area) = held[*k];
        let is_around = |other: usize| {
            let (around, larger) = held[other];
            other != *k && around.covers(&extent) && (larger > area || larger >= area && other < *k)
        };
        !boxes.at(extent.min).any(is_around)
    };
    let tops: Vec<(Extent, f64)> = (0..held.len()).filter(is_outermost).map(|k| held[k]).collect();
    let boxes = Boxes::new(tops.iter().map(|(extent, _)| extent.grown(OVER)).collect());
    let is_known = open.iter().filter(|one| reach.covers(one)).all(|one| {
        let holds = |top: usize| boxes.all()[top].covers(one);
        boxes.at(one.min).any(holds)
    });
    let are_beside = |(a, size): &(Extent, f64), (b, other): &(Extent, f64)| {
        !a.meets(b) && size.min(*other) >= LEAST_BESIDE * size.max(*other)
    };
    // At the edge of a cloth, outlines about as large as the largest one are many.
    let mut by_size: Vec<&(Extent, f64)> = tops.iter().collect();
    by_size.sort_by(|a, b| b.1.total_cmp(&a.1));
    by_size.truncate(MOST_BESIDE);
    let is_beside_another = by_size.iter().enumerate().any(|(k, a)| by_size[k + 1..].iter().any(|b| are_beside(a, b)));
    let filled: f64 = tops.iter().map(|(_, area)| area).sum();
    (is_known && is_beside_another && filled >= FILLED * area(edge)).then(|| edge.stroke[0])
}

/// Starts of closed lines that are cut outside all edges of the cloth: uncut rectangles around cuts that lie side by side.
pub(super) fn outside<'a>(edges: &[Extent], cuts: impl Iterator<Item = &'a Vec<Point>>) -> Vec<Point> {
    if edges.is_empty() {
        return Vec::new();
    }
    let is_closed = |cut: &&Vec<Point>| cut.len() > 3 && cut[0] == cut[cut.len() - 1];
    let is_outside = |cut: &&Vec<Point>| {
        let Extent { min, max } = Extent::of(cut);
        !edges.iter().any(|edge| edge.grown(OVER).holds(min + (max - min) / 2.0))
    };
    cuts.filter(is_closed).filter(is_outside).map(|cut| cut[0]).collect()
}
