//! Notches that are drawn as one open stroke from a place of an outline to another: V, castle and U.

use super::line::{Class, ROUNDING, SHORTEST_NOTCH, is_straight};
use super::marks::{Candidate, Search, meet};
use crate::geom::budget::Budget;
use crate::geom::{Point, polyline, ring};
use crate::ir::marker::Notch;

/// An open stroke that is a notch of an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stroke {
    /// The line that draws it, and the outline that it stands on, as indices of lines.
    pub(super) line: usize,
    pub(super) outline: usize,
    /// Its place farthest from the mouth.
    pub(super) tip: Point,
}

/// The notches among the open lines that were not taken for anything yet.
pub(super) fn on_outlines(search: Search, work: &mut Budget) -> Vec<Stroke> {
    let Search { lines, vertices, unit, .. } = search;
    let may_be = |&i: &usize| {
        let line = &lines[i];
        !line.is_closed && line.is_open_question() && line.length <= Notch::LONGEST_STROKE
    };
    let mut tips = Vec::new();
    let mut candidates = Vec::new();
    for line in (0..lines.len()).filter(may_be) {
        let places = lines[line].points(vertices);
        let [first, .., last] = places[..] else { continue };
        if is_straight(lines[line].vertices(vertices)) || first == last || (last - first).norm() > Notch::WIDEST {
            continue;
        }
        let depth = |at: &Point| polyline::distance_to_segment(*at, first, last);
        let deepest = places.iter().max_by(|a, b| depth(a).total_cmp(&depth(b)));
        if let Some(&tip) = deepest.filter(|tip| (SHORTEST_NOTCH..=Notch::LONGEST).contains(&depth(tip))) {
            candidates.push(Candidate::whole(line, [first, last]));
            tips.push(tip);
        }
    }
    if candidates.is_empty() {
        return Vec::new();
    }
    meet(&mut candidates, search, Notch::MISS + ROUNDING * unit, work);
    let stroke = |(Candidate { line, on, .. }, tip): (&Candidate, Point)| {
        let both = on[0].iter().filter_map(|&(near, outline)| {
            let other = on[1].iter().find(|(_, other)| *other == outline);
            other.map(|(other, _)| (near + other, outline))
        });
        // Into a part, and from a cut-out into what is around it.
        let leads_in = both.filter(|&(_, outline)| {
            let points = lines[outline].points(vertices);
            work.spend(points.len()) && ring::contains(&points, tip) == (lines[outline].class == Class::Part)
        });
        let nearest = leads_in.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        nearest.map(|(_, outline)| Stroke { line: *line, outline, tip })
    };
    candidates.iter().zip(tips).filter_map(stroke).collect()
}
