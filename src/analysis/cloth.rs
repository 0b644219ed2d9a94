//! The cloth around a cut: the parts on it, and the distance that a blade may go before it enters one.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::mouths::bridged;
use super::nesting::Nesting;
use crate::geom::boxes::Boxes;
use crate::geom::region::{Ray, Regions, Room};
use crate::geom::{Extent, Point, polyline};
use crate::ir::marker::{Contour, CutKind};
use crate::ir::toolpath::Overcut;
use crate::ir::{Marker, Toolpath};
use crate::machine::{Knife, MachineProfile, NotchStyle};

/// Fraction of the tolerance by which a straight extension may be in a part: then it runs along an edge that is cut anyway. The
/// rest is for deviations of the tip.
const SLACK_SHARE: f64 = 0.9;
/// Distance of the samples of a segment, mm.
const STEP: f64 = 0.1;
/// Length within which an extension that enters the part counts as beginning in it, mm: rounding.
const INSIDE_EPSILON: f64 = 1e-6;

/// The parts that lie on the cloth.
#[derive(Debug)]
pub struct Cloth<'a> {
    /// Interiors of the outlines as they are cut, without the cut-outs, in either orientation.
    parts: Regions<'a>,
    /// Slits that are cut, and their boxes: places on them are cut anyway.
    slits: Vec<[Point; 2]>,
    slit_boxes: Boxes,
    /// The part to which each piece belongs: a piece in another one is a cut-out of that.
    part_of: Vec<u32>,
    /// Overlap up to which parts only touch, mm.
    band: f64,
    /// Length up to which the blade plunges once instead of moving, mm: half of it stays uncut at either end.
    least_way: f64,
}

/// Shortest motion that counts as a cut, in multiples of `max_uncut`: less than two, since half of it is left at either end.
const LEAST_WAY_SHARE: f64 = 1.5;

impl<'a> Cloth<'a> {
    /// The cloth under a marker. Contours that do not close bound nothing.
    pub fn new(marker: &'a Marker, profile: &MachineProfile) -> Self {
        let nesting = Nesting::of(marker, profile.band(marker.unit));
        let contours: Vec<&Contour> = marker.contours().map(|(_, contour)| contour).collect();
        // The closed lines of each part, by the piece of its outline.
        let mut lines: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for line in (0..contours.len()).filter(|&line| contours[line].closed) {
            let outline = nesting.outline(line).unwrap_or(line);
            lines.entry(nesting.lines()[outline].group).or_default().push(line);
        }
        let style = profile.notch.style;
        let points = |&line: &usize| {
            let points = marker.list.points(contours[line].range);
            let notches = &marker.pieces[nesting.lines()[line].group as usize].outline_notches;
            // The cloth of a notch that is cut as a slit, or not at all, stays with its part.
            let is_as_drawn = style == NotchStyle::AsDrawn || notches.is_empty();
            if is_as_drawn { points } else { Cow::Owned(bridged(&points, notches)) }
        };
        let parts = Regions::new(lines.keys().copied(), |part| lines[&part].iter().map(points).collect());
        let owners = marker.owners().into_iter();
        let part_of = owners.map(|piece| nesting.part_of(piece).unwrap_or(piece) as u32).collect();
        let least_way = LEAST_WAY_SHARE * profile.verify.max_uncut_mm;
        let cuts = marker.cuts.iter().filter(|cut| cut.kind == CutKind::Slit);
        let slits: Vec<[Point; 2]> = cuts.flat_map(|cut| marker.list.lines(cut.range)).collect();
        let slit_boxes = Boxes::new(slits.iter().map(|ends| Extent::between(ends[0], ends[1])).collect());
        Self { parts, slits, slit_boxes, part_of, band: profile.band(marker.unit), least_way }
    }

    /// True if a place is in the part to which a piece belongs; the piece is given by its index.
    pub fn is_in_part(&self, piece: usize, place: Point) -> bool {
        self.parts.owners_at(place).contains(&self.part_of[piece])
    }

    /// The part in which a place lies; `None` in the waste.
    pub fn part_at(&self, place: Point) -> Option<u32> {
        self.parts.owners_at(place).into_iter().next()
    }

    /// The part in which a segment lies deepest, except for the part of the given piece; `None` when it is in none.
    pub fn deepest_other(&self, piece: usize, [from, to]: [Point; 2]) -> Option<u32> {
        let own = self.part_of.get(piece).copied().unwrap_or(piece as u32);
        let length = (to - from).norm();
        let steps = (length / STEP).ceil().max(1.0) as usize;
        let places = (0..=steps).map(|i| from + (to - from) * (i as f64 / steps as f64));
        let depths = places.flat_map(|place| self.parts.depths_at(place, length));
        depths.filter(|(part, _)| *part != own).reduce(|a, b| if b.1 > a.1 { b } else { a }).map(|deepest| deepest.0)
    }

    /// True if a place is at most `slack` mm from a slit that is cut.
    fn is_on_slit(&self, place: Point, slack: f64) -> bool {
        let mut near = self.slit_boxes.near(Extent::between(place, place).grown(slack)).map(|i| self.slits[i]);
        near.any(|[from, to]| polyline::distance_to_segment(place, from, to) <= slack)
    }

    /// The cloth as seen from the cuts of a toolpath.
    pub fn around(&'a self, toolpath: &Toolpath, knife: &'a Knife) -> Surroundings<'a> {
        let part = self.part_of.get(toolpath.part as usize).copied().unwrap_or(toolpath.part);
        Surroundings { knife, tolerance: toolpath.tolerance, least_way: self.least_way, cloth: self, part }
    }
}

/// Surroundings of the cuts of one piece: the blade, its tolerance, and the cloth as seen from the part of that piece.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings<'a> {
    /// The blade, with its overlaps at the ends of cuts.
    pub knife: &'a Knife,
    /// Permitted deviation of the tip, mm.
    pub tolerance: f64,
    /// Length up to which the blade plunges once instead of moving, mm.
    pub least_way: f64,
    cloth: &'a Cloth<'a>,
    part: u32,
}

impl Surroundings<'_> {
    /// Distance that a straight extension goes before it enters a part.
    pub fn room(&self, ray: &Ray) -> Room {
        self.cloth.parts.room(ray, self.part, [SLACK_SHARE * self.tolerance, self.cloth.band])
    }

    /// Depths of a place in parts, mm, at most `reach`: its distance from their edges. A place in the band at an edge, or in
    /// the outer quarter of a strip, is not in the part, and a place on any slit is cut anyway.
    pub fn depths(&self, place: Point, reach: f64) -> Overcut {
        let mut depths = Overcut::default();
        if self.cloth.is_on_slit(place, SLACK_SHARE * self.tolerance) {
            return depths;
        }
        for (part, depth) in self.cloth.parts.deep_at(place, reach, self.cloth.band) {
            let deepest = if part == self.part { &mut depths.own } else { &mut depths.other };
            *deepest = deepest.max(depth);
        }
        depths
    }

    /// Depth up to which a place in a part counts as on its edge, mm.
    pub fn band(&self) -> f64 {
        self.cloth.band
    }

    /// True if a straight extension leads into the part of the piece from its start.
    pub fn leads_inside(&self, ray: &Ray) -> bool {
        begins_inside(self.room(ray))
    }
}

/// True if an extension with this room begins in the part of its piece.
pub fn begins_inside(room: Room) -> bool {
    room.own <= INSIDE_EPSILON
}
