//! Near: finds cuts of two parts that run beside each other, not cut as one, with only a thin strip of cloth or none between
//! them.
//!
//! Needs: the cuts of the pieces. Leaves true: `near` holds the stretches of cuts around parts beside which a cut around
//! another part runs at a distance of at most `common.near_mm`, outside of their own part or over its edge by at most the band.

use super::pass::MarkerPass;
use super::search::search_ended;
use crate::diagnostic::Diagnostics;
use crate::geom::boxes::Boxes;
use crate::geom::budget::Budget;
use crate::geom::{Extent, Point, cross, polyline};
use crate::ir::marker::{Cut, CutKind, Marker, NearEdge};
use crate::machine::Job;

pub(super) const PASS: MarkerPass = MarkerPass { name: "near", about: "finds thin strips between two cuts", run };

/// Least cosine of the angle between two edges that run beside each other (30 degrees): lines of a few units have no direction.
const ALONG: f64 = 0.866;
/// Length below which a stretch counts as empty, mm: rounding.
const LEAST: f64 = 1e-6;
/// Cost of two edges beside each other besides the comparison of their boxes: they are stored.
const HIT: usize = 200;

/// Chord of a cut around a part.
struct Chord {
    piece: u32,
    /// Part that the cut bounds.
    part: u32,
    /// True if the part is on its left.
    is_part_left: bool,
    ends: [Point; 2],
}

fn run(marker: &mut Marker, job: &Job, diagnostics: &mut Diagnostics) {
    let most = job.profile.common.near_mm;
    marker.near.clear();
    if most == 0.0 {
        return;
    }
    let over = job.profile.band(marker.unit);
    let chords = chords(marker, most);
    match near(&chords, [-over, most], &mut Budget::of_lines(chords.len())) {
        Some(mut near) => {
            leave_out_crossings(&mut near, most);
            marker.near = near;
        }
        None => diagnostics.push(search_ended("edges that run beside another part's are not found")),
    }
}

/// Chords of cuts around parts that are within a distance of those around others, mm.
fn chords(marker: &Marker, distance: f64) -> Vec<Chord> {
    let around = |cut: &&Cut| match cut.kind {
        CutKind::Outline | CutKind::Inner | CutKind::Edge => true,
        CutKind::Slit | CutKind::Line => false,
    };
    let cuts: Vec<(&Cut, Extent)> =
        marker.cuts.iter().filter(around).map(|cut| (cut, Extent::of(&marker.list.points(cut.range)))).collect();
    let boxes = Boxes::new(cuts.iter().map(|(_, extent)| *extent).collect());
    let part = |cut: &Cut| cut.sides[0].or(cut.sides[1]);
    let mut chords = Vec::new();
    for &(cut, extent) in &cuts {
        let mut beside = boxes.near(extent.grown(distance));
        let Some(of) = part(cut).filter(|_| beside.any(|other| part(cuts[other].0) != part(cut))) else { continue };
        let is_part_left = cut.sides[0].is_some();
        let of_cut = |ends: &[Point]| Chord { piece: cut.piece, part: of, is_part_left, ends: [ends[0], ends[1]] };
        chords.extend(marker.list.points(cut.range).windows(2).map(of_cut));
    }
    chords
}

/// Removes crossings and contacts of cuts: a strip is longer than it is wide, mm.
fn leave_out_crossings(near: &mut Vec<NearEdge>, wide: f64) {
    let goes_on = |a: &NearEdge, b: &NearEdge| a.piece == b.piece && (b.ends[0] - a.ends[1]).norm() <= LEAST;
    let length = |edge: &NearEdge| (edge.ends[1] - edge.ends[0]).norm();
    let strips = near.chunk_by(goes_on).filter(|strip| strip.iter().map(length).sum::<f64>() > wide);
    *near = strips.flatten().copied().collect();
}

/// Stretches of chords beside which others run within the given distances; `None` if the budget is spent.
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

/// Stretch of a chord beside which another edge runs, outside of its part.
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
    } else if away[0] < least || away[0] > most {
        return None;
    }
    (high - low > LEAST).then_some([low, high])
}
