//! Overcuts: cuts of the blade beyond the ends of its line, by their length in waste and their depth in parts.
//!
//! The depth of a place in a part is its distance from that part's edges. It is at most the distance from the end of the line,
//! which may be drawn amid a part. A depth below the band, or in a strip below a quarter of the strip's width, counts as zero.
//! A cut may go as deep into its own part as the profile allows at reflex corners, and not into another part. A plunge cut may
//! be longer than its line: its bound is the depth of the best position that covers the same stretch.

use super::body::Cut;
use super::heading::on_lap;
use super::trial::Trial;
use super::vicinity::Vicinity;
use super::worsts::{Overcuts, Worsts};
use crate::geom::{Point, Vector, polyline};
use crate::ir::declaration::{Declaration, Kind, Which};
use crate::ir::verdict::{Sighting, Worst};
use crate::machine::{MachineProfile, Spare};
use crate::verify::declared::{Declared, Stretch};
use crate::verify::reference::grid::{Grid, Run};
use crate::verify::reference::inside::Inside;
use crate::verify::reference::line::Line;
use crate::verify::reference::lines::Reference;

/// Distance between the positions of a blade that are tried, mm: the true best is at most this much shallower than the best of
/// them.
const SHIFT: f64 = 0.1;

/// Distance of the corners of two parallel outlines as a multiple of the distance of their edges.
const DIAGONAL: f64 = std::f64::consts::SQRT_2;
/// Depth in a strip up to which a place counts as on its edge, as a fraction of the strip's width.
const STRIP_SHARE: f64 = 0.25;
/// Least cosine between the two edges of a strip (8 degrees), and between the directions from a place to them.
const STRIP: f64 = 0.99;
/// Greatest depth that is measured, mm: far more than is allowed.
const ASIDE: f64 = 5.0;

/// Judges overcuts.
#[derive(Debug)]
pub(in crate::verify) struct Overcut<'a> {
    inside: &'a Inside<'a>,
    declared: Option<&'a Declared>,
    /// Rounding of a tip's place, mm.
    rounding: f64,
    tolerance: f64,
    width: f64,
    band: f64,
    /// Greatest distance of an edge from the cut of another part that stands for it, mm.
    shift: f64,
    /// Part that is spared by a plunge cut that finds no waste.
    spare: Spare,
    /// Depth to which the profile lets the blade cut into the part at a reflex corner, mm.
    reflex: f64,
    /// True if the blade is sharp at both ends.
    is_alike: bool,
    /// Greatest depth that the profile allows in the own part and in others, mm.
    caps: [Option<f64>; 2],
}

/// All lines, and those near a place.
#[derive(Clone, Copy)]
pub(in crate::verify) struct Lines<'a> {
    pub(in crate::verify) reference: &'a Reference<'a>,
    pub(in crate::verify) grid: &'a Grid,
}

/// A stroke on its line.
pub(in crate::verify) struct Ends<'a> {
    pub(in crate::verify) cut: &'a Cut,
    pub(in crate::verify) trial: &'a Trial,
    pub(in crate::verify) line: &'a Line<'a>,
    pub(in crate::verify) lines: Lines<'a>,
}

/// Depths of a place in its own part and in another, mm.
pub(super) type Depths = [f64; 2];

/// Deepest places in the own part and in another: depth, mm, and index.
type Deepest = [(f64, usize); 2];

impl<'a> Overcut<'a> {
    /// Judges with a tip that may leave its line by the tolerance, and places that are rounded to `rounding` mm.
    pub(in crate::verify) fn new(
        reference: &Reference,
        inside: &'a Inside<'a>,
        declared: Option<&'a Declared>,
        profile: &MachineProfile,
        rounding: f64,
    ) -> Self {
        let (knife, verify) = (&profile.knife, &profile.verify);
        Self {
            inside,
            declared,
            rounding,
            tolerance: reference.tolerance + rounding,
            width: knife.width_mm,
            band: reference.band,
            shift: reference.common.max(reference.band),
            spare: knife.spare,
            is_alike: knife.edges == 2,
            reflex: knife.reflex_front_overlap_mm.max(knife.reflex_heel_overlap_mm),
            caps: [verify.max_overcut_part_mm, verify.max_overcut_neighbour_mm],
        }
    }

    /// Distance of a place from all edges of parts, mm; exact only if less than `reach`.
    pub(super) fn distance_to_edges(&self, place: Point, reach: f64) -> f64 {
        self.inside.distance_to_edges(place, reach)
    }

    /// Judges the cuts of a stroke beyond the ends of its line, at the places `outer`, each with its distance, mm.
    pub(in crate::verify) fn see(
        &self,
        stroke: &Ends,
        outer: &[(usize, f64)],
        seen: &impl Fn(usize) -> Sighting,
        worsts: &mut Worsts,
    ) {
        let Worsts { overcuts, declared: undeclared, .. } = worsts;
        let Ends { cut, trial, .. } = *stroke;
        let mut ends = [[(0.0, 0); 2]; 2];
        self.see_aside(stroke, seen, overcuts);
        let Lines { reference, grid } = stroke.lines;
        let mut vicinity = Vicinity::new(reference, grid, self.tolerance);
        for &(i, beyond) in outer {
            if beyond <= self.rounding || trial.over.is_some_and(|over| over.spans(i)) {
                continue;
            }
            let is_cut_anyway = !vicinity.is_away(&cut.points[i..]);
            let depths = if is_cut_anyway { [0.0; 2] } else { self.depths(cut.points[i], beyond, stroke) };
            if depths == [0.0; 2] {
                overcuts.waste.see(beyond, || seen(i));
            }
            let end = match trial.end_at(i) {
                Which::Start => 0,
                Which::End => 1,
            };
            for (deepest, depth) in ends[end].iter_mut().zip(depths) {
                if depth > deepest.0 {
                    *deepest = (depth, i);
                }
            }
        }
        let [start, end] = ends;
        let deepest = [0, 1].map(|side| if end[side].0 > start[side].0 { end[side] } else { start[side] });
        if deepest.iter().all(|(depth, _)| *depth == 0.0) {
            return;
        }
        let least = if cut.is_plunge_cut() { self.least(stroke).map(|least| least + SHIFT) } else { [0.0; 2] };
        let bands = self.bands(deepest, stroke);
        let [own, other] = [0, 1].map(|k| least[k].max(bands[k]));
        let bounds = [own.max(self.reflex), other].map(|bound| bound + self.tolerance);
        let worsts = [&mut overcuts.part, &mut overcuts.neighbour];
        for (((depth, i), worst), (bound, cap)) in
            deepest.into_iter().zip(worsts).zip(bounds.into_iter().zip(self.caps))
        {
            if depth > 0.0 {
                worst.see_under(depth, cap.map_or(bound, |cap| bound.min(cap + self.tolerance)), || seen(i));
            }
        }
        if let Some(declared) = self.declared {
            self.hold(ends, stroke, declared, seen, undeclared);
        }
    }

    /// Greatest depths in its own part and in another that still count as on the edge, mm, by the deepest place of a stroke in
    /// each.
    fn bands(&self, deepest: Deepest, stroke: &Ends) -> Depths {
        deepest.map(|(depth, i)| match depth > self.band {
            true if Self::is_across(i, stroke) => self.shift,
            true => self.band,
            false => self.band_at(stroke.cut.points[i], stroke),
        })
    }

    /// Judges the cuts of a stroke along stretches of its line that are on no edge of its own part. There the line is on an
    /// edge of another part, which the profile lets stand for its own, or leads over to it and through it by the tolerance. The
    /// depth of a place is at most its distance from all edges: where parts overlap, the edge of one lies amid the other.
    fn see_aside(&self, stroke: &Ends, seen: &impl Fn(usize) -> Sighting, overcuts: &mut Overcuts) {
        let Ends { cut, trial, line, .. } = *stroke;
        if line.aside.is_empty() {
            return;
        }
        for i in trial.held.clone() {
            let station = trial.feet[i].station;
            if line.aside.iter().any(|&[from, to]| (from..=to).contains(&station)) {
                let away = self.inside.distance_to_edges(cut.points[i], ASIDE).min(ASIDE);
                let depths = self.depths(cut.points[i], away, stroke);
                for (depth, worst) in depths.into_iter().zip([&mut overcuts.part, &mut overcuts.neighbour]) {
                    worst.see_under(depth, DIAGONAL * self.shift + 2.0 * self.tolerance, || seen(i));
                }
            }
        }
    }

    /// Compares the depth of each end of a stroke in parts with the declarations for that end.
    fn hold(
        &self,
        ends: [Deepest; 2],
        stroke: &Ends,
        declared: &Declared,
        seen: &impl Fn(usize) -> Sighting,
        undeclared: &mut Worst,
    ) {
        let Ends { cut, trial, line, .. } = *stroke;
        let kind = if cut.is_plunge_cut() { Kind::Surplus } else { Kind::Overcut };
        let bands = ends.map(|deepest| self.bands(deepest, stroke));
        let excess = |is_turned: bool| {
            // At reflex corners the blade may enter its own part without a declaration.
            [(0, self.reflex), (1, 0.0)].map(|(side, unsaid)| {
                [(0, Which::Start), (1, Which::End)].map(|(end, which)| {
                    let which = if is_turned { which.other() } else { which };
                    let here = Stretch { line, stations: trial.reach, end: Some(which) };
                    let entries = declared.find(kind, here).filter(|entry| self.is_in(entry, side == 0, line));
                    let declared = entries.map(|entry| entry.magnitude_mm).fold(0.0, f64::max);
                    (ends[end][side].0 - declared.max(unsaid).max(bands[end][side]) - self.tolerance).max(0.0)
                })
            })
        };
        let most = |excess: &[[f64; 2]; 2]| excess.iter().flatten().copied().fold(0.0, f64::max);
        let mut found = excess(false);
        // The order of the ends of a plunged blade that is sharp at both ends is unknown.
        if self.is_alike && cut.is_plunge_cut() {
            let turned = excess(true);
            if most(&turned) < most(&found) {
                found = turned;
            }
        }
        for (side, ends_of) in found.into_iter().enumerate() {
            for (excess, deepest) in ends_of.into_iter().zip(ends) {
                undeclared.see(excess, || seen(deepest[side].1));
            }
        }
    }

    /// True if a declaration is about the own part of a line, or about another; one that names no part may be about either.
    pub(super) fn is_in(&self, entry: &Declaration, is_own: bool, line: &Line) -> bool {
        let own = self.inside.part_of(line.piece as usize);
        entry.part.is_none_or(|part| self.inside.find_part(part as usize).is_some_and(|part| (part == own) == is_own))
    }

    /// Depths of a place of a stroke in its own part and in another, mm.
    pub(super) fn depths_at(&self, place: usize, stroke: &Ends) -> Depths {
        self.depths(stroke.cut.points[place], stroke.trial.beyond(stroke.cut, place), stroke)
    }

    /// True if a straight segment leads into a part, however narrow that is.
    pub(in crate::verify) fn leads_into_part(&self, way: [Point; 2]) -> bool {
        self.inside.is_crossed(way)
    }

    /// Greatest depth of a place in any part, mm, for a place `away` mm from its own cut.
    pub(in crate::verify) fn deepest(&self, point: Point, away: f64, stroke: &Ends) -> f64 {
        self.depths(point, away, stroke).into_iter().fold(0.0, f64::max)
    }

    /// Depths in parts of a place `beyond` mm past an end of the stretch that a stroke cuts.
    fn depths(&self, point: Point, beyond: f64, &Ends { line, lines, .. }: &Ends) -> Depths {
        let mut depths = [0.0; 2];
        if beyond <= self.band {
            return depths;
        }
        let own = self.inside.part_of(line.piece as usize);
        for part in self.inside.pieces_at(point) {
            let is_of_part = |piece| self.inside.part_of(piece) == part;
            let depth = lines.distance_to_edges(point, beyond, is_of_part).min(beyond);
            let deepest = &mut depths[usize::from(part != own)];
            if depth > self.band || depth > STRIP_SHARE * lines.width_of_strip(point, self.strip(), is_of_part) {
                *deepest = f64::max(*deepest, depth);
            }
        }
        depths
    }

    /// True if the overlap at a place is no longer than needed to cross the cut of another part, which may lie as far away as
    /// the profile lets edges of two parts be apart.
    fn is_across(i: usize, &Ends { cut, trial, line, lines }: &Ends) -> bool {
        trial.beyond(cut, i) <= lines.reference.across(line.place(trial.feet[i].station))
    }

    /// Depth in a part up to which a place counts as on its edge, mm: the band, or less in a strip.
    fn band_at(&self, point: Point, &Ends { lines, .. }: &Ends) -> f64 {
        let parts = self.inside.pieces_at(point).into_iter();
        let widths =
            parts.map(|part| lines.width_of_strip(point, self.strip(), |piece| self.inside.part_of(piece) == part));
        widths.map(|width| STRIP_SHARE * width).fold(self.band, f64::min)
    }

    /// Greatest width of a strip, mm, in which the share of the width is below the band.
    fn strip(&self) -> f64 {
        self.band / STRIP_SHARE
    }

    /// Least depths of a plunge cut in its own part and in others over all positions along its line that cover the same
    /// stretch, mm. The parts that the profile spares come first.
    fn least(&self, stroke: &Ends) -> Depths {
        let Ends { trial, line, .. } = *stroke;
        let places = self.places(trial.core.map(|station| line.place(on_lap(line, station))), stroke);
        let weighed = |depths: &Depths| self.spare.weigh(*depths);
        let first = places.iter().map(|depths| weighed(depths)[0]).fold(f64::INFINITY, f64::min);
        if self.spare == Spare::Both {
            return [first; 2];
        }
        // Among positions that are equal in the spared part, the least depth in the other.
        let alike = places.iter().map(weighed).filter(|weighed| weighed[0] <= first + SHIFT);
        let then = alike.map(|weighed| weighed[1]).fold(f64::INFINITY, f64::min);
        if self.spare == Spare::Own { [first, then] } else { [then, first] }
    }

    /// Least depth in any part of a plunge cut that cuts a curve by its chords, mm: the greatest over the chords of the stretch
    /// that it cuts.
    pub(in crate::verify) fn of_chords(&self, stroke: &Ends) -> f64 {
        let Ends { trial, line, .. } = *stroke;
        let (low, high) = (trial.reach[0].min(trial.reach[1]), trial.reach[0].max(trial.reach[1]));
        let chords = line.chords_between([low, high]).map(|chord| chord % line.chords());
        let of_chord = |chord: usize| self.least_over([line.point(chord), line.point(chord + 1)], stroke);
        chords.map(of_chord).fold(0.0, f64::max)
    }

    /// Least depth in any part of a blade that covers the segment between two places, mm.
    fn least_over(&self, ends: [Point; 2], stroke: &Ends) -> f64 {
        let places = self.places(ends, stroke);
        places.iter().map(|[own, other]| own.max(*other)).fold(f64::INFINITY, f64::min)
    }

    /// Depths in parts of a blade that covers the segment between two places, for each of its positions.
    fn places(&self, [start, end]: [Point; 2], stroke: &Ends) -> Vec<Depths> {
        let Some(along) = polyline::direction(start, end) else { return vec![[0.0; 2]] };
        let surplus = (self.width - (end - start).norm()).max(0.0);
        // Depths of the deepest place up to each step, at either end.
        let count = (surplus / SHIFT).ceil() as usize;
        let deepest = |from: Point, along: Vector| -> Vec<Depths> {
            let mut deepest = [0.0_f64; 2];
            let mut all = vec![deepest];
            all.extend((1..=count).map(|i| {
                let way = surplus * i as f64 / count as f64;
                let depths = self.depths(from + along * way, way, stroke);
                deepest = [deepest[0].max(depths[0]), deepest[1].max(depths[1])];
                deepest
            }));
            all
        };
        let (before, behind) = (deepest(start, -along), deepest(end, along));
        let at = |i: usize| {
            let (before, behind) = (before[i], behind[count - i]);
            [before[0].max(behind[0]), before[1].max(behind[1])]
        };
        (0..=count).map(at).collect()
    }
}

impl Lines<'_> {
    /// Distance of a place from the edges of some pieces, mm; exact only if less than `reach`.
    fn distance_to_edges(self, point: Point, reach: f64, is_of: impl Fn(usize) -> bool) -> f64 {
        let is_edge = |run: &&Run| {
            let line = &self.reference.lines[run.line()];
            line.cut.bounds && is_of(line.piece as usize)
        };
        let edges = self.grid.near(point, reach).filter(is_edge);
        edges.map(|run| self.distance_to_run(run, point)).fold(f64::INFINITY, f64::min)
    }

    /// Width of some pieces at a place where they form a strip, mm: from the edge on one side to the edge on the other.
    /// Infinite where they form none, or one wider than `most`.
    fn width_of_strip(self, point: Point, most: f64, is_of: impl Fn(usize) -> bool) -> f64 {
        let mut edges: Vec<[Vector; 2]> = Vec::new();
        for run in self.grid.near(point, most) {
            let line = &self.reference.lines[run.line()];
            if !line.cut.bounds || !is_of(line.piece as usize) {
                continue;
            }
            for [a, b] in run.chords().map(|chord| [line.point(chord), line.point(chord + 1)]) {
                let way = a + (b - a) * polyline::foot(point, a, b) - point;
                if let Some(along) = polyline::direction(a, b).filter(|_| way.norm() <= most) {
                    edges.push([way, along]);
                }
            }
        }
        let Some(&[nearest, along]) = edges.iter().min_by(|a, b| a[0].norm().total_cmp(&b[0].norm())) else {
            return f64::INFINITY;
        };
        let is_across = |[way, direction]: &&[Vector; 2]| {
            direction.dot(&along).abs() >= STRIP && way.dot(&nearest) <= -STRIP * way.norm() * nearest.norm()
        };
        let widths = edges.iter().filter(is_across).map(|[way, _]| way.norm() + nearest.norm());
        widths.filter(|&width| width <= most && nearest.norm() > 0.0).fold(f64::INFINITY, f64::min)
    }

    fn distance_to_run(self, run: &Run, point: Point) -> f64 {
        let line = &self.reference.lines[run.line()];
        run.chords().map(|chord| line.distance_to_chord(chord, point)).fold(f64::INFINITY, f64::min)
    }
}
