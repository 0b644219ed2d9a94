//! Blade and its actions at the ends of a cut: the keys `knife.*`.

use serde::{Deserialize, Serialize};

use super::key::{Key, REST, SPEED, Takes, Within, from};
use super::word::{Auto, Off, OrWord, Word as _, words};
use crate::units::{MS_PER_S, rad};

/// Lengths of blades and overlaps, mm: greater ones are a wrong unit.
const BLADE: Within = from(0.0, 1000.0);

/// The keys `knife.*`.
#[rustfmt::skip] // a table: one row a key
pub(super) const KEYS: &[Key] = &[
    Key { name: "knife.width_mm", takes: Takes::Number(BLADE), about: "Knife width: the blade from heel to tip as it is today, worn by sharpening. 0 = a point." },
    Key { name: "knife.back_mm", takes: Takes::NumberOr(BLADE, Auto::WORD), about: "From the C axis back to the rear edge of the blade (the advance of M17). Sharpening takes\nthe front, so it stays while the width shrinks. \"auto\" = what radius_mm leaves." },
    Key { name: "knife.radius_mm", takes: Takes::NumberOr(BLADE, Auto::WORD), about: "From the C axis forward to the tip. Give this or back_mm; \"auto\" = what back_mm leaves." },
    Key { name: "knife.front_overlap_mm", takes: Takes::Number(BLADE), about: "Overcut: how far the tip cuts past the end of a line." },
    Key { name: "knife.corner_front_overlap_mm", takes: Takes::Number(BLADE), about: "Corner overcut: the same before the knife is lifted at a corner." },
    Key { name: "knife.heel_overlap_mm", takes: Takes::Number(BLADE), about: "How far the heel plunges before the start of a line (back_mm less the advance before plunge)." },
    Key { name: "knife.corner_heel_overlap_mm", takes: Takes::Number(BLADE), about: "The same where the knife plunges again at a corner (back_mm less the corner advance)." },
    Key { name: "knife.reflex_front_overlap_mm", takes: Takes::Number(BLADE), about: "Overcut at the ends of lines and at corners where it would run into the part." },
    Key { name: "knife.reflex_heel_overlap_mm", takes: Takes::Number(BLADE), about: "Heel overlap at the ends of lines and at corners where it would run into the part." },
    Key { name: "knife.clearance_mm", takes: Takes::Number(BLADE), about: "How far overlaps stay away from the next part; in a narrower gap they are shortened." },
    Key { name: "knife.feed_mm_s", takes: Takes::NumberOr(SPEED, Off::WORD), about: "Maximum cutting velocity of the tip; \"off\" = whatever the axes can do." },
    Key { name: "knife.slow_percent", takes: Takes::Percent, about: "Speed of slowed cuts (M25), a part of the cutting velocity." },
    Key { name: "knife.near_percent", takes: Takes::Percent, about: "Speed along near lines (common.near_mm), a part of the speed that holds there." },
    Key { name: "knife.plunge_ms", takes: Takes::Number(REST), about: "How long the axes rest while the knife goes down." },
    Key { name: "knife.lift_ms", takes: Takes::Number(REST), about: "How long the axes rest while the knife comes up." },
    Key { name: "knife.clear_ms", takes: Takes::NumberOr(REST, Off::WORD), about: "How long after the lift command the blade is clear of the cloth, so that the axes may move\nbefore it is all the way up; \"off\" = they wait for lift_ms." },
    Key { name: "knife.max_down_mm", takes: Takes::NumberOr(from(1.0, 1.0e6), Off::WORD), about: "Maximum distance with the knife down: a longer cut is lifted there and rejoined with overlap." },
    Key { name: "knife.follow", takes: Takes::Word(words::<Follow>), about: "How the blade lies on curves: \"tangent\" = the tip on the line, the blade along it; \"chord\" =\ntip and heel both on the line." },
    Key { name: "knife.tight_curves", takes: Takes::Word(words::<TightCurves>), about: "Curves tighter than the blade, on which it would stand across as a chord (an arc of less than 0.55\nblade widths, a right angle rounded with less than 0.4): \"follow\" = cut along the tangent,\n\"nibble\" = by overlapping plunges within the tolerance, \"refuse\" = an error." },
    Key { name: "knife.max_swing_mm", takes: Takes::NumberOr(from(0.5, 1000.0), Off::WORD), about: "How far the heel may leave the line behind a bend; where it would leave it farther, the knife is\nlifted as at a corner. \"off\" = no limit, only a warning." },
    Key { name: "knife.spare", takes: Takes::Word(words::<Spare>), about: "Where a cut shorter than the blade finds no waste for the rest of that: \"both\" = it lies least\ndeep in any part, \"own\" = in the part that is cut, \"other\" = in its neighbours." },
    Key { name: "knife.max_bow_mm", takes: Takes::Number(BLADE), about: "How far a blade that plunges on a curve may lie beside it: it is straight. Beyond that it is as\n`knife.tight_curves` says: a warning, nibbled, or an error." },
    Key { name: "knife.edges", takes: Takes::Whole(&[1, 2]), about: "Cutting edges: a blade with 2 may run either way round, heel first where C then turns less." },
    Key { name: "knife.yaw_deg", takes: Takes::Number(from(-45.0, 45.0)), about: "C yaw: a constant correction of the blade's angle, which is added to C in every cut." },
];

/// Blade: a segment from heel to tip in the plane; the C axis passes through its centre, `radius` behind the tip.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Knife {
    /// Length from heel to tip.
    pub width_mm: f64,
    /// Distance from heel to C axis, as given; [`Knife::back`] is the effective one.
    #[serde(with = "OrWord::<Auto>")]
    pub back_mm: Option<f64>,
    /// Distance from C axis to tip, as given; it takes precedence over `back_mm`.
    #[serde(with = "OrWord::<Auto>")]
    pub radius_mm: Option<f64>,
    /// Overlap of the tip past the end of a run.
    pub front_overlap_mm: f64,
    /// Overlap of the tip past the end of a run at a corner.
    pub corner_front_overlap_mm: f64,
    /// Overlap of the heel before the start of a run.
    pub heel_overlap_mm: f64,
    /// Overlap of the heel before the start of a run at a corner.
    pub corner_heel_overlap_mm: f64,
    /// Overlap of the tip where the part itself lies ahead.
    pub reflex_front_overlap_mm: f64,
    /// Overlap of the heel where the part itself lies behind.
    pub reflex_heel_overlap_mm: f64,
    /// Distance of overlaps from the next part.
    pub clearance_mm: f64,
    /// Greatest speed of the tip.
    #[serde(with = "OrWord::<Off>")]
    pub feed_mm_s: Option<f64>,
    /// Speed of slowed cuts, a whole number.
    pub slow_percent: f64,
    /// Speed along near lines, relative to the speed that holds there.
    pub near_percent: f64,
    /// Time from the plunge command until the blade is through the cloth.
    pub plunge_ms: f64,
    /// Time from the lift command until the blade is up.
    pub lift_ms: f64,
    /// Time from the lift command until the blade is clear of the cloth and the axes may move.
    #[serde(with = "OrWord::<Off>")]
    pub clear_ms: Option<f64>,
    /// Greatest length of a run.
    #[serde(with = "OrWord::<Off>")]
    pub max_down_mm: Option<f64>,
    /// Orientation mode on curves.
    pub follow: Follow,
    /// Treatment of curves tighter than the blade.
    pub tight_curves: TightCurves,
    /// Greatest distance of the heel from the line behind a bend.
    #[serde(with = "OrWord::<Off>")]
    pub max_swing_mm: Option<f64>,
    /// Part that is spared where a plunge cut finds no waste.
    pub spare: Spare,
    /// Greatest distance of the blade from a curve on which it plunges.
    pub max_bow_mm: f64,
    /// Number of cutting edges, 1 or 2.
    pub edges: u32,
    /// Correction added to the angle of the blade.
    pub yaw_deg: f64,
}

/// Orientation of the blade on a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Follow {
    /// Tip on the path, blade along the tangent.
    Tangent,
    /// Tip and heel on the path: the blade is a chord of it.
    Chord,
}

/// Part that is spared by the surplus length of a blade that finds no waste.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Spare {
    /// All parts alike.
    Both,
    /// The part that is cut.
    Own,
    /// Other parts.
    Other,
}

impl Spare {
    /// Depths of a blade in the part that it cuts and in others, mm, ordered by weight: the first matters most.
    pub fn weigh(self, [own, other]: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Both => [own.max(other), other],
            Self::Own => [own, other],
            Self::Other => [other, own],
        }
    }
}

/// Treatment of a curve on which the blade, as a chord of it, would stand across.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TightCurves {
    /// Cut without a lift, with the blade along the tangent.
    Follow,
    /// Cut by overlapping plunges without motion.
    Nibble,
    /// Reported as an error.
    Refuse,
}

/// Width and back of the default blade, mm: a 6.6 mm knife, worn from 8.89 mm.
const DEFAULT_WIDTH_MM: f64 = 6.6;
const DEFAULT_BACK_MM: f64 = 6.35;

impl Knife {
    /// Greatest overlaps before the start and past the end of a cut, in waste or in the part, mm.
    pub fn most_overlaps(&self) -> [f64; 2] {
        let heel = self.heel_overlap_mm.max(self.corner_heel_overlap_mm).max(self.reflex_heel_overlap_mm);
        let front = self.front_overlap_mm.max(self.corner_front_overlap_mm).max(self.reflex_front_overlap_mm);
        [heel, front]
    }

    /// Sum of the greatest overlaps at both ends of a cut, mm.
    pub fn overlaps(&self) -> f64 {
        self.most_overlaps().iter().sum()
    }

    /// Greatest reach of the blade beyond a line that it cuts, in any direction at its end, mm.
    pub fn reach(&self) -> f64 {
        self.width_mm + self.front_overlap_mm.max(self.corner_front_overlap_mm)
    }

    /// Greatest length of a cut that is not lifted, so that the knife stays down within its limit, overlaps included, mm;
    /// `None` = any.
    pub fn longest_cut(&self) -> Option<f64> {
        self.max_down_mm.map(|longest| longest - self.overlaps())
    }

    /// Speed of slowed cuts, percent.
    pub fn slow(&self) -> u8 {
        self.slow_percent.clamp(1.0, 100.0) as u8
    }

    /// Speed along near lines, as a share of the speed that holds there; `None` if they are not slowed.
    pub fn near_share(&self) -> Option<f64> {
        (self.near_percent < 100.0).then_some(self.near_percent / 100.0)
    }

    /// Distance from the C axis to the tip, mm. It is 0 for a blade narrower than its back (the back is often left at its
    /// default), including a point of width 0.
    pub fn radius(&self) -> f64 {
        self.radius_mm.unwrap_or_else(|| (self.width_mm - self.back_mm.unwrap_or(DEFAULT_BACK_MM)).max(0.0))
    }

    /// Distance from the heel to the C axis, mm.
    pub fn back(&self) -> f64 {
        self.width_mm - self.radius()
    }

    /// Distances from the C axis to the tip and to the heel, mm.
    pub fn ends(&self) -> [f64; 2] {
        [self.radius(), self.back()]
    }

    /// Rotation after which the blade cuts the same line again, rad: half a turn with two edges.
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / f64::from(self.edges.clamp(1, 2))
    }

    /// Correction added to the blade's angle, rad.
    pub fn yaw(&self) -> f64 {
        rad(self.yaw_deg)
    }

    /// Duration of the rest between the plunge command and the first motion, s.
    pub fn plunge(&self) -> f64 {
        self.plunge_ms / MS_PER_S
    }

    /// Time from the lift command until the blade is all the way up, s.
    pub fn lift(&self) -> f64 {
        self.lift_ms / MS_PER_S
    }

    /// Duration of the rest after the lift command, s: until the blade is clear of the cloth.
    pub fn clear(&self) -> f64 {
        self.clear_ms.unwrap_or(self.lift_ms) / MS_PER_S
    }
}

impl Default for Knife {
    fn default() -> Self {
        Self {
            width_mm: DEFAULT_WIDTH_MM,
            back_mm: Some(DEFAULT_BACK_MM),
            radius_mm: None,
            front_overlap_mm: 0.8,
            corner_front_overlap_mm: 0.8,
            heel_overlap_mm: 0.5,
            corner_heel_overlap_mm: 0.5,
            reflex_front_overlap_mm: 0.0,
            reflex_heel_overlap_mm: 0.0,
            clearance_mm: 0.1,
            feed_mm_s: Some(760.0),
            slow_percent: 75.0,
            near_percent: 100.0,
            plunge_ms: 80.0,
            lift_ms: 60.0,
            clear_ms: None,
            max_down_mm: None,
            follow: Follow::Tangent,
            tight_curves: TightCurves::Follow,
            max_swing_mm: None,
            spare: Spare::Both,
            max_bow_mm: 0.5,
            edges: 1,
            yaw_deg: 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_radius_is_what_the_back_leaves_of_the_width() {
        let default = Knife::default();
        assert!((default.radius() - 0.25).abs() < 1e-12 && (default.back() - 6.35).abs() < 1e-12);
        let new = Knife { width_mm: 8.89, ..Knife::default() };
        assert!((new.radius() - 2.54).abs() < 1e-12);
        let eccentric = Knife { back_mm: None, radius_mm: Some(4.4), ..Knife::default() };
        assert!((eccentric.back() - 2.2).abs() < 1e-12);
    }

    #[test]
    fn a_narrow_blade_and_a_point_turn_about_their_tip() {
        for width_mm in [0.0, 3.0] {
            let knife = Knife { width_mm, ..Knife::default() };
            assert_eq!((knife.radius(), knife.back()), (0.0, width_mm));
        }
    }
}
