//! Checks of the spindle speed: its limits, and its constancy within a run or the rate of its changes.

use std::collections::BTreeMap;

use super::clock;
use super::ground::{Ground, sighting};
use super::rules::{self, PLACE_EPSILON};
use crate::geom::Point;
use crate::ir::verdict::WorstByRule;
use crate::machine::sewing::Spindle as Eased;
use crate::sew::stitches::Op;

/// State of the spindle from entry to entry.
#[derive(Debug, Default)]
pub(super) struct Spindle {
    /// Number of stitches of the run so far.
    stitches: u32,
    /// Speed of the run after its soft start, stitches per minute.
    rpm: Option<f64>,
    /// Speed of its soft start, stitches per minute.
    soft: Option<f64>,
    /// Speed of the stitch before, if it belongs to the run, stitches per minute.
    last: Option<f64>,
    /// Limits of the seams, by the record where each begins; the highest of one record.
    seams: BTreeMap<u32, f64>,
}

impl Spindle {
    /// State before the first entry.
    pub(super) fn new(ground: &Ground) -> Self {
        let mut seams = BTreeMap::new();
        for seam in ground.pattern.iter().flat_map(|pattern| &pattern.seams) {
            let limit = seam.rpm.unwrap_or(f64::INFINITY);
            let most = seams.entry(seam.span.block).or_insert(limit);
            *most = f64::max(*most, limit);
        }
        seams.retain(|_, limit| limit.is_finite());
        Self { seams, ..Self::default() }
    }

    /// Checks the speed of the entry at index `i`; 0 if the spindle stands.
    pub(super) fn see(&mut self, i: usize, rpm: f64, ground: &Ground, worst: &mut WorstByRule) {
        let Some(step) = ground.stitches.steps.get(i) else { return };
        let place = sighting(i as u32 + 1, step.to);
        match step.op {
            Op::Stitch => {}
            Op::Jump | Op::Trim | Op::Stop | Op::Color(_) => {
                *self = Self { seams: std::mem::take(&mut self.seams), ..Self::default() };
                worst.see(&rules::SPEED, rpm, place);
                return;
            }
        }
        let sewing = ground.sewing;
        let from = if i == 0 { Point::origin() } else { ground.stitches.steps[i - 1].to };
        let pitch = (step.to.x - from.x).hypot(step.to.y - from.y);
        let mut limit = sewing.max_rpm;
        for [from, rpm] in &sewing.speeds {
            if pitch >= *from + PLACE_EPSILON {
                limit = limit.min(*rpm);
            }
        }
        if let Some(rpm) = self.seams.get(&step.record) {
            limit = limit.min(*rpm);
        }
        let is_soft = self.stitches < sewing.soft_start_stitches && sewing.soft_start_rpm.is_some();
        self.stitches += 1;
        match sewing.spindle {
            Eased::Uniform => {
                let steady = if is_soft { &mut self.soft } else { &mut self.rpm };
                let usual = *steady.get_or_insert(rpm);
                worst.see(&rules::STEADY_SPEED, (rpm - usual).abs(), place);
            }
            Eased::Eased => {
                let last = self.last.replace(rpm).unwrap_or(rpm);
                worst.see(&rules::SPINDLE, clock::change_rpm_s(sewing, [last, rpm]), place);
            }
        }
        if let Some(soft) = sewing.soft_start_rpm.filter(|_| is_soft) {
            limit = limit.min(soft);
        }
        worst.see(&rules::SPEED, if rpm > 0.0 { rpm - limit } else { limit }, place);
    }
}
