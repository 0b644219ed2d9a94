//! Sections: the open cuts of a cut file that stand in place of an outline that windows of a conveyor split.
//!
//! They are judged by the blocks of the file and by the outline as drawn, not by the cuts that the compiler made: together they
//! cut all of the outline, run `bite.overlap_mm` past each border from both sides, end in the waste, and cross wherever the
//! conveyor brings the cloth.

use super::said::{Cut, Said};
use crate::geom::{Point, Vector, polyline, ring};
use crate::ir::verdict::{Sighting, Worst};
use crate::ir::{Finding, Marker};
use crate::machine::{Bite, MachineProfile};
use crate::verify::rules;

/// Steps of the conveyor's tolerance, in X and in Y, in which the cloth may lie beside its place.
const STEPS: [f64; 3] = [-1.0, 0.0, 1.0];
/// Distance around the end of a cut, in addition to its distance from the start of the next one, in which both are compared, mm.
const ROUND: f64 = 1.0;
/// Roundings of places that a distance along an outline consists of.
const ROUNDINGS: f64 = 4.0;

/// An open cut along an outline.
struct Section {
    /// Number of advances before it.
    window: usize,
    /// Stations of the outline at which it comes onto the line and leaves it, mm.
    ends: [f64; 2],
    /// Length between them along the cut, mm.
    length: f64,
    points: Vec<Point>,
}

/// The outline of a piece, closed.
struct Outline {
    points: Vec<Point>,
    stations: Vec<f64>,
    /// Block of the piece.
    block: u32,
}

/// Worst places of all split pieces.
struct Worsts {
    complete: Worst,
    overlap: Worst,
    joint: Worst,
    part: Worst,
}

/// Findings about split pieces, for places that are rounded by `place` mm; none if no piece is split.
pub(super) fn check(found: &[Said], marker: &Marker, profile: &MachineProfile, place: f64) -> Vec<Finding> {
    let rounding = ROUNDINGS * place;
    let uncut = profile.verify.max_uncut_mm + rounding;
    let mut worsts = Worsts {
        complete: Worst::new(&rules::COMPLETE, Some(uncut)),
        overlap: Worst::new(&rules::OVERLAP, Some(rounding)),
        joint: Worst::new(&rules::JOINT, Some(uncut)),
        part: Worst::new(&rules::OVERCUT_PART, Some(rounding)),
    };
    let mut is_split = false;
    for (part, piece) in marker.pieces.iter().enumerate() {
        let Some(contour) = marker.split_outline(part) else { continue };
        is_split = true;
        let points = marker.points(&piece.contours[contour]);
        let outline = Outline { stations: polyline::stations(&points), points, block: piece.span.block };
        let sections = outline.sections(open_cuts(found, piece.number), rounding);
        outline.judge(&sections, &profile.bite, &mut worsts);
    }
    if !is_split {
        return Vec::new();
    }
    let Worsts { complete, overlap, joint, part } = worsts;
    [complete, overlap, joint, part].into_iter().map(Worst::finding).collect()
}

/// Open cuts of a piece by its number, each with the number of advances before it.
fn open_cuts(found: &[Said], piece: u32) -> Vec<(usize, &Cut)> {
    let (mut window, mut number, mut cuts) = (0, 0, Vec::new());
    for said in found {
        match said {
            Said::Piece(other) => number = *other,
            Said::Advance(_) => window += 1,
            Said::Contour(cut) if number == piece && cut.points.first() != cut.points.last() => {
                cuts.push((window, cut));
            }
            Said::Contour(_)
            | Said::Event(_)
            | Said::Hole(..)
            | Said::Label { .. }
            | Said::Slit(_)
            | Said::Bar(_)
            | Said::Field(..) => {}
        }
    }
    cuts
}

impl Outline {
    fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// Station of a place, mm; `None` if it is farther than `near` mm from the line.
    fn station(&self, at: Point, near: f64) -> Option<f64> {
        let lines = self.points.windows(2).zip(&self.stations);
        let away = lines.map(|(ends, start)| (polyline::distance_to_segment(at, ends[0], ends[1]), ends, *start));
        let (away, ends, start) = away.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (away <= near).then(|| start + (at - ends[0]).norm())
    }

    /// The cuts all of whose points lie on the line, except for the first and the last one, in the order of the line.
    fn sections(&self, cuts: Vec<(usize, &Cut)>, near: f64) -> Vec<Section> {
        let mut sections: Vec<Section> =
            cuts.into_iter().filter_map(|(window, cut)| self.section(window, cut.points.clone(), near)).collect();
        sections.sort_by(|a, b| a.ends[0].total_cmp(&b.ends[0]));
        sections
    }

    fn section(&self, window: usize, mut points: Vec<Point>, near: f64) -> Option<Section> {
        let inner = points.get(1..points.len() - 1).filter(|inner| inner.len() > 1)?;
        let stations: Option<Vec<f64>> = inner.iter().map(|&at| self.station(at, near)).collect();
        let (mut stations, total) = (stations?, self.length());
        let length = polyline::length(inner);
        let step = (stations[1] - stations[0]).rem_euclid(total);
        if step > total / 2.0 {
            points.reverse();
            stations.reverse();
        }
        let (from, to) = (stations[0], stations[stations.len() - 1]);
        let turns = ((from + length - to) / total).round();
        Some(Section { window, ends: [from, to + turns * total], length, points })
    }

    fn judge(&self, sections: &[Section], bite: &Bite, worsts: &mut Worsts) {
        let nowhere = || Sighting::missing(self.points[0], self.block);
        if sections.is_empty() {
            worsts.complete.see(self.length(), nowhere);
        }
        let next = sections.iter().cycle().skip(1);
        for (i, (section, next)) in sections.iter().zip(next).enumerate() {
            let at = || Sighting::missing(section.points[section.points.len() - 1], self.block);
            let round = if i + 1 == sections.len() { self.length() } else { 0.0 };
            let lap = section.ends[1] - next.ends[0] - round;
            worsts.complete.see((-lap).max(section.ends[1] - section.ends[0] - section.length), at);
            worsts.overlap.see(2.0 * bite.overlap_mm - lap, at);
            // Each advance between both may be off.
            let shift = section.window.abs_diff(next.window) as f64 * bite.match_mm;
            for step in STEPS.iter().flat_map(|x| STEPS.map(|y| Vector::new(*x, y))) {
                worsts.joint.see(gap(&section.points, &next.points, step * shift), at);
            }
            for end in [section.points[0], section.points[section.points.len() - 1]] {
                let is_inside = ring::contains(&self.points, end);
                let deep = if is_inside { polyline::distance(end, &self.points) } else { 0.0 };
                worsts.part.see(deep, || Sighting::missing(end, self.block));
            }
        }
    }
}

/// Distance of the end of a cut from the start of the next one where the cloth lies beside its place, mm; 0 where they cross.
fn gap(one: &[Point], next: &[Point], shift: Vector) -> f64 {
    let (end, start) = (one[one.len() - 1], next[0]);
    let reach = (end - start).norm() + shift.norm() + ROUND;
    let is_near = |ends: &&[Point]| polyline::distance_to_segment(end, ends[0], ends[1]) <= reach;
    let ends: Vec<&[Point]> = one.windows(2).filter(is_near).collect();
    let starts = next.windows(2).filter(is_near);
    let apart = starts.flat_map(|ahead| {
        let moved = [ahead[0] + shift, ahead[1] + shift];
        ends.iter().map(move |behind| polyline::distance_of_segments([behind[0], behind[1]], moved))
    });
    apart.fold(f64::INFINITY, f64::min)
}
