//! The blade and what it does at the ends of a cut.

use serde::{Deserialize, Serialize};

use super::word::{Auto, Off, OrWord};
use crate::units::{MS_PER_S, rad};

/// The blade: a segment from tail to tip in the plane; the C axis passes through its centre, `radius` behind the tip.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Knife {
    /// Tail to tip, mm; 0 = a point.
    pub width_mm: f64,
    /// Tail to centre, mm; what is left of the width is the radius. [`Knife::back`] is what the blade really has.
    #[serde(with = "OrWord::<Auto>")]
    pub back_mm: Option<f64>,
    /// Centre to tip, mm; may be given instead of `back_mm`, and then decides.
    #[serde(with = "OrWord::<Auto>")]
    pub radius_mm: Option<f64>,
    /// How far the tip goes past the end of a path, mm.
    pub front_overlap_mm: f64,
    /// The same at a corner inside a path, mm.
    pub corner_front_overlap_mm: f64,
    /// How far the tail starts before the start of a path, mm.
    pub heel_overlap_mm: f64,
    /// The same at a corner inside a path, mm.
    pub corner_heel_overlap_mm: f64,
    /// Front overlap at corners whose extension lies inside the part, mm.
    pub reflex_front_overlap_mm: f64,
    /// Heel overlap at corners whose extension lies inside the part, mm.
    pub reflex_heel_overlap_mm: f64,
    /// How far overlaps stay away from the next part, mm.
    pub clearance_mm: f64,
    /// Greatest speed of the tip while cutting, mm/s.
    #[serde(with = "OrWord::<Off>")]
    pub feed_mm_s: Option<f64>,
    /// Speed after L or M25, percent of the feed, a whole number.
    pub slow_percent: f64,
    /// From the plunge command until the blade is through, ms; the axes rest.
    pub plunge_ms: f64,
    /// From the lift command until the blade is up, ms; the axes rest.
    pub lift_ms: f64,
    /// From the lift command until the blade is clear of the cloth and C may turn, ms.
    #[serde(with = "OrWord::<Off>")]
    pub clear_ms: Option<f64>,
    /// Longest run with the knife down, mm; a longer one is lifted there and rejoined with overlap.
    #[serde(with = "OrWord::<Off>")]
    pub max_down_mm: Option<f64>,
    /// How the blade lies on curves.
    pub follow: Follow,
    /// What is done about curves that are tighter than the blade.
    pub tight_curves: TightCurves,
    /// How far the body of a plunged blade may cut beside a curve that begins there, mm, before it is worth a word.
    pub max_bow_mm: f64,
    /// Number of cutting edges: a blade with two may run either way round.
    pub edges: u32,
    /// Constant correction added to the blade's angle, degrees: how far the axis stands ahead of the blade.
    pub yaw_deg: f64,
}

/// How the blade lies on a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Follow {
    /// Tip on the path, blade along the tangent.
    Tangent,
    /// Tip and tail on the path: the blade is a chord of it.
    Chord,
}

/// What is done about a curve on which the blade, as a chord of it, would stand across: an arc of less than 0.55 blade
/// widths, a right angle that is rounded with less than 0.4.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TightCurves {
    /// It is cut without a lift, the blade along the tangent.
    Follow,
    /// It is cut by plunges without motion that overlap.
    Nibble,
    /// It is an error.
    Refuse,
}

/// Width of the default blade, mm, and its back: a 6.6 mm knife, worn from 8.89 mm.
const DEFAULT_WIDTH_MM: f64 = 6.6;
const DEFAULT_BACK_MM: f64 = 6.35;

impl Knife {
    /// How far the blade may go beyond both ends of a cut together, mm.
    pub fn overlaps(&self) -> f64 {
        let heel = self.heel_overlap_mm.max(self.corner_heel_overlap_mm);
        heel + self.front_overlap_mm.max(self.corner_front_overlap_mm)
    }

    /// Longest cut that need not be lifted amid it, mm: with its overlaps it is no longer than the knife may stay down;
    /// `None` = any.
    pub fn longest_cut(&self) -> Option<f64> {
        self.max_down_mm.map(|longest| longest - self.overlaps())
    }

    /// Speed of slowed cuts, percent: whole, and from 1 to 100 by its key.
    pub fn slow(&self) -> u8 {
        self.slow_percent.clamp(1.0, 100.0) as u8
    }

    /// Centre to tip, mm. A blade narrower than its back (the back is often left at its default) has the C axis at
    /// its tip; that covers the point, of width 0.
    pub fn radius(&self) -> f64 {
        self.radius_mm.unwrap_or_else(|| (self.width_mm - self.back_mm.unwrap_or(DEFAULT_BACK_MM)).max(0.0))
    }

    /// Tail to centre, mm.
    pub fn back(&self) -> f64 {
        self.width_mm - self.radius()
    }

    /// Centre to tip and tail to centre, mm.
    pub fn ends(&self) -> [f64; 2] {
        [self.radius(), self.back()]
    }

    /// The turn after which the blade cuts the same again, rad: half of one with two edges.
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / f64::from(self.edges.clamp(1, 2))
    }

    /// Correction added to the blade's angle, rad.
    pub fn yaw(&self) -> f64 {
        rad(self.yaw_deg)
    }

    /// Length of the rest between the plunge command and the first motion, s.
    pub fn plunge(&self) -> f64 {
        self.plunge_ms / MS_PER_S
    }

    /// From the lift command until the blade is all the way up, s.
    pub fn lift(&self) -> f64 {
        self.lift_ms / MS_PER_S
    }

    /// Length of the rest after the lift command, s: until the blade is clear of the cloth.
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
            plunge_ms: 80.0,
            lift_ms: 60.0,
            clear_ms: None,
            max_down_mm: None,
            follow: Follow::Tangent,
            tight_curves: TightCurves::Follow,
            max_bow_mm: 0.5,
            edges: 1,
            yaw_deg: 0.0,
        }
    }
}
