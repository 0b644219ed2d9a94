//! Borders: places where one edge of a part is cut in two windows of a conveyor. The conveyor may bring the cloth a little
//! beside its place. For every offset within its tolerance the two cuts must still cross, or a thread of cloth is left.
//!
//! The later cut is shifted from its programmed place in eight directions and must meet the earlier one each time.

use rayon::prelude::*;

use crate::geom::boxes::Boxes;
use crate::geom::{Extent, Point, Vector, polyline};
use crate::ir::verdict::{Sighting, Worst};
use crate::verify::reference::common::Joint;
use crate::verify::reference::lines::Reference;

/// Steps of the conveyor's tolerance, in X and in Y, in which the cloth may lie beside its place.
const STEPS: [f64; 3] = [-1.0, 0.0, 1.0];

/// The blade's ways about the places where windows split edges.
#[derive(Debug)]
pub(in crate::verify) struct Borders<'a> {
    all: Vec<Border<'a>>,
    boxes: Boxes,
}

/// A place where a window splits an edge.
#[derive(Debug)]
struct Border<'a> {
    joint: &'a Joint,
    /// Greatest distance of the cloth from its place between the two cuts along either axis, mm.
    shift: f64,
    /// Segments of each of the two cuts there.
    ways: [Vec<[Point; 2]>; 2],
}

impl Default for Borders<'_> {
    fn default() -> Self {
        Self { all: Vec::new(), boxes: Boxes::new(Vec::new()) }
    }
}

impl<'a> Borders<'a> {
    /// Selects the joints whose cuts are of one part and lie in different windows; each advance may be `off` by so many mm.
    pub(in crate::verify) fn new(joints: &'a [Joint], reference: &Reference, off: f64) -> Self {
        let (marker, stations) = (reference.marker, reference.marker.stations());
        let piece = |cut: u32| marker.cuts.get(cut as usize).map(|cut| cut.piece as usize);
        let mut windows = stations.clone();
        windows.dedup();
        let window = |piece: usize| windows.partition_point(|way| *way < stations[piece]);
        let border = |joint: &'a Joint| {
            let [Some(one), Some(other)] = joint.cuts.map(piece) else { return None };
            let advances = window(one).abs_diff(window(other));
            let is_border = reference.owners[one] == reference.owners[other] && advances > 0;
            is_border.then(|| Border { joint, shift: advances as f64 * off, ways: [Vec::new(), Vec::new()] })
        };
        let all: Vec<Border> = joints.iter().filter_map(border).collect();
        let about = |border: &Border| {
            let mut about = Extent::EMPTY;
            border.joint.about.iter().for_each(|extent| about.join(extent));
            about.grown(2.0 * border.shift)
        };
        Self { boxes: Boxes::new(all.iter().map(about).collect()), all }
    }

    /// Records the places that a stroke cuts on a cut of the marker.
    pub(in crate::verify) fn see(&mut self, points: &[Point], cut: u32) {
        if self.all.is_empty() {
            return;
        }
        let near: Vec<usize> = self.boxes.near(Extent::of(points)).collect();
        for place in near {
            let about = self.boxes.all()[place];
            let border = &mut self.all[place];
            for (_, ways) in border.joint.cuts.into_iter().zip(&mut border.ways).filter(|(of, _)| *of == cut) {
                let chords = points.windows(2).map(|ends| [ends[0], ends[1]]);
                ways.extend(chords.filter(|ends| Extent::between(ends[0], ends[1]).meets(&about)));
            }
        }
    }

    /// Records the width of the thread at each border for the worst position of the cloth.
    pub(super) fn see_gaps(&self, worst: &mut Worst) {
        let gaps = self.all.par_iter().map(|border| (border.gap(), border));
        for (gap, Border { joint, .. }) in gaps.collect::<Vec<_>>() {
            worst.see(gap, || Sighting::missing(joint.at, joint.block));
        }
    }
}

impl Border<'_> {
    /// Widest gap between the two cuts over all positions of the cloth, mm; the size of the place if a cut is missing.
    fn gap(&self) -> f64 {
        let by = STEPS.iter().flat_map(|x| STEPS.iter().map(move |y| Vector::new(*x, *y) * self.shift));
        by.map(|by| self.gap_at(by)).fold(0.0, f64::max)
    }

    fn gap_at(&self, by: Vector) -> f64 {
        let [one, other] = &self.ways;
        let (width, height) = self.joint.about[0].size();
        let mut least = width.hypot(height);
        for ends in one {
            let about = Extent::between(ends[0], ends[1]).grown(least);
            for moved in other.iter().map(|ends| ends.map(|at| at + by)) {
                if Extent::between(moved[0], moved[1]).meets(&about) {
                    least = least.min(polyline::distance_of_segments(*ends, moved));
                }
            }
            if least == 0.0 {
                break;
            }
        }
        least
    }
}
