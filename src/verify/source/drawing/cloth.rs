//! The edge of the cloth among the lines of a plot: a rectangle around parts beside each other is not cut in their place,
//! and nothing outside such rectangles is cut.

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, ring};

/// Share of a rectangle that outlines in it fill which are not cut: then it is the edge of the cloth.
const FILLED: f64 = 0.6;
/// Share of the area of one outline that another one beside it has, at the least: less is a mark.
const LEAST_BESIDE: f64 = 0.15;
/// Largest outlines in a rectangle among which two beside each other are looked for.
const MOST_BESIDE: usize = 512;
/// Greatest length by which outlines stand over the edge that they touch, mm.
const OVER: f64 = 0.5;

/// An outline of a plot.
pub(super) struct Outline<'a> {
    pub(super) stroke: &'a [Point],
    pub(super) is_rectangle: bool,
    pub(super) is_cut: bool,
}

/// A rectangle that is cut though outlines beside each other fill it that are not: it is around nearly all of the plot.
/// Open lines may be outlines that hold others: where one lies in it beside those outlines nothing is known.
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
    // Those like the largest one are many where it is the edge of the cloth.
    let mut by_size: Vec<&(Extent, f64)> = tops.iter().collect();
    by_size.sort_by(|a, b| b.1.total_cmp(&a.1));
    by_size.truncate(MOST_BESIDE);
    let is_beside_another = by_size.iter().enumerate().any(|(k, a)| by_size[k + 1..].iter().any(|b| are_beside(a, b)));
    let filled: f64 = tops.iter().map(|(_, area)| area).sum();
    (is_known && is_beside_another && filled >= FILLED * area(edge)).then(|| edge.stroke[0])
}

/// Starts of closed lines that are cut outside all edges of the cloth: rectangles that are not cut, around cuts beside each
/// other.
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
