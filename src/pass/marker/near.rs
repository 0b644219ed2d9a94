//! Near: where edges of two parts run beside each other, too far apart to be cut as one and so near that a thin strip of
//! cloth stands between the two cuts.
//!
//! Needs: pieces in cut order, only those that this run cuts. Leaves true: `near` holds the stretches of closed lines beside
//! which, outside of their own part, an edge of another part runs at more than `common.lines` and at most `common.near_mm`.

use super::pass::MarkerPass;
use super::search::search_ended;
use crate::analysis::nesting::Nesting;
use crate::diagnostic::Diagnostics;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, cross, polyline, ring};
use crate::ir::marker::{Marker, NearEdge};
use crate::machine::Job;

pub(super) const PASS: MarkerPass = MarkerPass { name: "near", about: "finds thin strips between two cuts", run };

/// Least cosine between two edges that run beside each other (30 degrees): lines of a few units tell no direction.
const ALONG: f64 = 0.866;
/// Shorter stretches are none, mm: rounding.
const LEAST: f64 = 1e-6;
/// What two edges beside each other cost beside the comparison of their boxes: they are kept.
const HIT: usize = 200;

/// A chord of a closed line.
struct Chord {
    piece: u32,
    /// The part that the line bounds.
    part: u32,
    /// Whether that lies on its left.
    is_part_left: bool,
    ends: [Point; 2],
}

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    let least = job.profile.common(marker.unit).unwrap_or(0.0);
    let most = job.profile.common.near_mm;
    marker.near.clear();
    if most <= least {
        return;
    }
    let chords = chords(marker, most);
    match near(&chords, [least, most], &mut Budget::of_a_marker()) {
        Some(near) => marker.near = near,
        None => diagnostics.push(search_ended("edges that run beside another part's are not found")),
    }
}

/// The chords of the closed lines that lie near other parts, mm.
fn chords(marker: &Marker, distance: f64) -> Vec<Chord> {
    let nesting = Nesting::of(marker);
    let part = |line: usize| nesting.outline(line).map(|outline| nesting.lines()[outline].group);
    let boxes = Boxes::new(nesting.lines().iter().map(|line| line.extent).collect());
    let is_near = |line: usize| boxes.near(boxes.all()[line].grown(distance)).any(|other| part(other) != part(line));
    let mut chords = Vec::new();
    for (line, (piece, contour)) in marker.contours().enumerate() {
        let Some(part) = part(line).filter(|_| contour.closed && is_near(line)) else { continue };
        let points = marker.list.points(contour.range);
        let is_part_left = (ring::area(&points) > 0.0) != nesting.is_inner(line);
        let of_line = |ends: &[Point]| Chord { piece: piece as u32, part, is_part_left, ends: [ends[0], ends[1]] };
        chords.extend(points.windows(2).map(of_line));
    }
    chords
}

/// The stretches of chords beside which others run so near; `None` when the search has no end.
fn near(chords: &[Chord], [least, most]: [f64; 2], work: &mut Budget) -> Option<Vec<NearEdge>> {
    let boxes = Boxes::new(chords.iter().map(|chord| Extent::between(chord.ends[0], chord.ends[1])).collect());
    let mut found = Vec::new();
    for (i, chord) in chords.iter().enumerate() {
        let around = boxes.all()[i].grown(most);
        if !work.spend(boxes.cost_near(&around)) {
            return None;
        }
        let mut beside: Vec<[f64; 2]> = Vec::new();
        for other in boxes.near(around).map(|k| &chords[k]).filter(|other| other.part != chord.part) {
            if let Some(stretch) = stretch(chord, other.ends, [least, most]) {
                beside.push(stretch);
                if !work.spend(HIT) {
                    return None;
                }
            }
        }
        beside.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let [from, to] = chord.ends;
        let along = (to - from) / (to - from).norm();
        let mut open: Option<[f64; 2]> = None;
        for next in beside.into_iter().map(Some).chain([None]) {
            match (&mut open, next) {
                (Some(open), Some(next)) if next[0] <= open[1] + LEAST => open[1] = open[1].max(next[1]),
                _ => {
                    let ends = std::mem::replace(&mut open, next).map(|ends| ends.map(|way| from + along * way));
                    found.extend(ends.map(|ends| NearEdge { piece: chord.piece, ends }));
                }
            }
        }
    }
    Some(found)
}

/// From where to where on a chord another edge runs beside it, outside of its part.
fn stretch(chord: &Chord, other: [Point; 2], [least, most]: [f64; 2]) -> Option<[f64; 2]> {
    let [from, to] = chord.ends;
    let along = polyline::direction(from, to)?;
    if polyline::direction(other[0], other[1])?.dot(&along).abs() < ALONG {
        return None;
    }
    let outward = if chord.is_part_left { -1.0 } else { 1.0 };
    let at = other.map(|end| (end - from).dot(&along));
    let away = other.map(|end| outward * cross(along, end - from));
    let (mut low, mut high) = (at[0].min(at[1]).max(0.0), at[0].max(at[1]).min((to - from).norm()));
    let slope = (away[1] - away[0]) / (at[1] - at[0]);
    if slope != 0.0 {
        let limits = [least, most].map(|limit| at[0] + (limit - away[0]) / slope);
        (low, high) = (low.max(limits[0].min(limits[1])), high.min(limits[0].max(limits[1])));
    } else if away[0] <= least || away[0] > most {
        return None;
    }
    (high - low > LEAST).then_some([low, high])
}
