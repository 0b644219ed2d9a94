//! Notches that are drawn as one open stroke from a place of an outline to another: V, castle and U, or several that touch each
//! other.

use super::line::{Class, ROUNDING, SHORTEST_NOTCH, is_straight};
use super::marks::{Candidate, Search, meet};
use crate::geom::budget::Budget;
use crate::geom::{Point, cross, polyline, ring};
use crate::ir::marker::Notch;

/// An open stroke that is a notch of an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stroke {
    /// Its line, and the outline that it stands on, as indices of lines.
    pub(super) line: usize,
    pub(super) outline: usize,
    /// Its place farthest from the mouth.
    pub(super) tip: Point,
    /// The greater distance of its ends from their edge, mm.
    pub(super) miss: f64,
}

/// Greatest fall of the depth of a notch between two deeper places, mm: strokes with a greater one are an M or a W.
const DENT: f64 = 0.7;

/// True if a stroke gets no shallower before its deepest place, and no deeper after it: depths, mm.
fn has_one_tip(depths: &[f64]) -> bool {
    let mut deepest = 0;
    for (k, depth) in depths.iter().enumerate() {
        if *depth > depths[deepest] {
            deepest = k;
        }
    }
    rises(depths[..=deepest].iter().copied()) && rises(depths[deepest..].iter().rev().copied())
}

fn rises(mut depths: impl Iterator<Item = f64>) -> bool {
    let mut most = 0.0_f64;
    depths.all(|depth| {
        most = most.max(depth);
        depth >= most - DENT
    })
}

/// The tip of a stroke with the shape of a notch, or of some that touch each other: the deepest place of the first one.
fn tip(places: &[Point]) -> Option<Point> {
    let [first, .., last] = places[..] else { return None };
    let depth = |at: &Point| polyline::distance_to_segment(*at, first, last);
    let side = |at: &Point| cross(last - first, at - first);
    let deepest = side(places.iter().max_by(|a, b| depth(a).total_cmp(&depth(b)))?);
    // An end past the edge lies on the other side.
    let is_near = |k: &usize| depth(&places[*k]) <= Notch::MISS || side(&places[*k]) * deepest < 0.0;
    let mut tips = Vec::new();
    let mut from = 0;
    while from + 1 < places.len() {
        let deep = (from + 1..places.len()).find(|k| !is_near(k))?;
        let back = (deep..places.len()).find(is_near)?;
        let again = (back..places.len()).find(|k| !is_near(k));
        let to = match again {
            Some(again) => (back..again).min_by(|&a, &b| depth(&places[a]).total_cmp(&depth(&places[b])))?,
            None => places.len() - 1,
        };
        let notch = &places[from..=to];
        let deepest = notch.iter().max_by(|a, b| depth(a).total_cmp(&depth(b)))?;
        let is_notch = (SHORTEST_NOTCH..=Notch::LONGEST).contains(&depth(deepest))
            && (notch[notch.len() - 1] - notch[0]).norm() <= Notch::WIDEST
            && polyline::length(notch) <= Notch::LONGEST_STROKE
            && has_one_tip(&notch.iter().map(depth).collect::<Vec<f64>>());
        tips.push(is_notch.then_some(*deepest)?);
        from = to;
    }
    tips.first().copied().filter(|_| tips.len() <= Notch::MOST_TOUCHING)
}

/// Notches among the open lines without a class.
pub(super) fn on_outlines(search: Search, work: &mut Budget) -> Vec<Stroke> {
    let Search { lines, vertices, unit, .. } = search;
    let may_be = |&i: &usize| {
        let line = &lines[i];
        let longest = Notch::MOST_TOUCHING as f64 * Notch::LONGEST_STROKE;
        !line.is_closed && line.is_open_question() && line.length <= longest
    };
    let mut tips = Vec::new();
    let mut candidates = Vec::new();
    for line in (0..lines.len()).filter(may_be) {
        let places = lines[line].points(vertices);
        let [first, .., last] = places[..] else { continue };
        let is_wide = (last - first).norm() > Notch::MOST_TOUCHING as f64 * Notch::WIDEST;
        if is_wide || first == last || is_straight(lines[line].vertices(vertices)) {
            continue;
        }
        if let Some(tip) = tip(&places) {
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
            other.map(|&(other, _)| ([near, other], outline))
        });
        // A notch leads into a part, and from a cut-out into the cloth around it.
        let leads_in = both.filter(|&(_, outline)| {
            let points = lines[outline].points(vertices);
            work.spend(points.len()) && ring::contains(&points, tip) == (lines[outline].class == Class::Part)
        });
        let sum = |[one, other]: [f64; 2]| one + other;
        let nearest = leads_in.min_by(|a, b| sum(a.0).total_cmp(&sum(b.0)).then(a.1.cmp(&b.1)));
        nearest.map(|([one, other], outline)| Stroke { line: *line, outline, tip, miss: one.max(other) })
    };
    candidates.iter().zip(tips).filter_map(stroke).collect()
}
