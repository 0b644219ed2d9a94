//! The check that no sample leaves without: finite differences of the setpoints against the limits of the axes.
//!
//! A finite difference of order k, divided by h^k, is a weighted mean of the k-th derivative over its support, so a
//! motion that keeps its limits between the samples also keeps them here, and stretching time by rho lowers the k-th
//! difference by rho^k.
//!
//! Hence a motion in closed form, whose greatest derivatives are known, needs no samples but where it meets others.

use crate::ir::motion::{Derivatives, Phase, Poses};
use crate::ir::toolpath::Pose;
use crate::machine::Limits;

/// Relative excess over a limit that is rounding of the differences themselves.
pub(super) const EXCESS_EPSILON: f64 = 1e-6;

/// A greatest speed, acceleration or jerk of an axis beside its limit, in mm or rad, and s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Peak {
    /// The greatest value.
    pub worst: f64,
    /// What was allowed where it was seen.
    pub limit: f64,
}

/// The greatest speed, acceleration and jerk of x, y and c: of each the one that comes nearest to its limit.
pub type Peaks = [[Peak; 3]; 3];

/// Which limits hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Regime {
    /// Those of cutting: the knife is commanded down.
    Cut,
    /// Those of travel.
    Rapid,
}

/// Limits of x, y and c in both regimes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Allowed {
    pub(super) cut: [Limits; 3],
    pub(super) rapid: [Limits; 3],
}

/// Setpoints that a difference of order 3 joins.
const SUPPORT: u32 = 4;

/// Greatest differences of order 1 to 3 of each axis.
type Rows = [[f64; 3]; 3];

/// Follows setpoints and keeps the greatest differences. Before the first setpoint the axes rest.
#[derive(Debug, Clone)]
pub(super) struct Differences {
    period: f64,
    /// The greatest differences that are allowed in a cut, in a rapid, and where the one passes into the other at rest:
    /// there the wider of both hold.
    allowed: [Rows; 3],
    /// The last setpoint and its differences of order 1 and 2, axis by axis.
    last: Option<Rows>,
    /// The regimes of the last setpoints.
    regimes: [Regime; 3],
    /// Greatest differences in parts of what is allowed, and which of `allowed` that was.
    greatest: [[(f64, usize); 3]; 3],
}

impl Differences {
    pub(super) fn new(period: f64, allowed: &Allowed) -> Self {
        let rows = |limits: &[Limits; 3]| {
            limits.map(|l| [l.speed * period, l.acceleration * period.powi(2), l.jerk * period.powi(3)])
        };
        let (cut, rapid) = (rows(&allowed.cut), rows(&allowed.rapid));
        let wider = std::array::from_fn(|axis| std::array::from_fn(|k: usize| f64::max(cut[axis][k], rapid[axis][k])));
        Self {
            period,
            allowed: [cut, rapid, wider],
            last: None,
            regimes: [Regime::Rapid; 3],
            greatest: [[(0.0, 0); 3]; 3],
        }
    }

    /// Takes the next setpoint.
    pub(super) fn push(&mut self, pose: Pose, regime: Regime) {
        let here = row(pose);
        let Some(last) = &mut self.last else {
            self.last = Some(here.map(|value| [value, 0.0, 0.0]));
            self.regimes = [regime; 3];
            return;
        };
        let which = match (self.regimes == [regime; 3], regime) {
            (true, Regime::Cut) => 0,
            (true, Regime::Rapid) => 1,
            (false, _) => 2,
        };
        self.regimes = [self.regimes[1], self.regimes[2], regime];
        for axis in 0..3 {
            let of_axis = &mut last[axis];
            let d1 = here[axis] - of_axis[0];
            let d2 = d1 - of_axis[1];
            let d3 = d2 - of_axis[2];
            *of_axis = [here[axis], d1, d2];
            for (k, difference) in [d1, d2, d3].into_iter().enumerate() {
                let part = difference.abs() / self.allowed[which][axis][k];
                if part > self.greatest[axis][k].0 {
                    self.greatest[axis][k] = (part, which);
                }
            }
        }
    }

    /// Takes a phase. Of one in closed form the setpoints at both ends, because they meet what is before and behind, and
    /// between them its greatest derivatives, which no difference exceeds.
    pub(super) fn pass(&mut self, phase: &Phase, regime: Regime) {
        let bounds = phase.poses.derivatives(f64::from(phase.ticks) * self.period);
        let Some(bounds) = bounds.filter(|_| phase.ticks > 2 * SUPPORT) else {
            (0..phase.ticks).for_each(|i| self.push(phase.pose(i), regime));
            return;
        };
        (0..SUPPORT).for_each(|i| self.push(phase.pose(i), regime));
        let behind = phase.ticks - SUPPORT;
        if let Poses::StraightCut(_) | Poses::Glide(_) = phase.poses {
            self.cover(&bounds, regime);
            let [a, b, c] = [3, 2, 1].map(|back| row(phase.pose(behind - back)));
            self.last = Some(std::array::from_fn(|k| [c[k], c[k] - b[k], c[k] - 2.0 * b[k] + a[k]]));
            self.regimes = [regime; 3];
        }
        (behind..phase.ticks).for_each(|i| self.push(phase.pose(i), regime));
    }

    /// Takes the greatest derivatives of a stretch of one regime.
    fn cover(&mut self, bounds: &Derivatives, regime: Regime) {
        let which = match regime {
            Regime::Cut => 0,
            Regime::Rapid => 1,
        };
        let powers = [self.period, self.period.powi(2), self.period.powi(3)];
        for (axis, bounds) in bounds.iter().enumerate() {
            for (k, (bound, power)) in bounds.iter().zip(powers).enumerate() {
                let part = bound * power / self.allowed[which][axis][k];
                if part > self.greatest[axis][k].0 {
                    self.greatest[axis][k] = (part, which);
                }
            }
        }
    }

    /// Takes the last setpoint: behind it the axes rest.
    pub(super) fn rest(&mut self, pose: Pose, regime: Regime) {
        for _ in 0..3 {
            self.push(pose, regime);
        }
    }

    /// The greatest speed, acceleration and jerk so far.
    pub(super) fn peaks(&self) -> Peaks {
        let powers = [self.period, self.period.powi(2), self.period.powi(3)];
        std::array::from_fn(|axis| {
            std::array::from_fn(|k| {
                let (part, which) = self.greatest[axis][k];
                let limit = self.allowed[which][axis][k] / powers[k];
                Peak { worst: part * limit, limit }
            })
        })
    }

    /// By how much time must be stretched for all differences so far to be allowed: 1 or less when they are.
    pub(super) fn excess(&self) -> f64 {
        let of_axis =
            |[speed, acceleration, jerk]: &[(f64, usize); 3]| speed.0.max(acceleration.0.sqrt()).max(jerk.0.cbrt());
        self.greatest.iter().map(of_axis).fold(0.0, f64::max)
    }
}

/// x, y and c of a pose.
fn row(pose: Pose) -> [f64; 3] {
    [pose.centre.x, pose.centre.y, pose.c.0]
}

/// By how much time must be stretched for a cut in closed form to keep its limits: 1 or less when it does.
pub(super) fn excess_of_derivatives(bounds: &Derivatives, limits: &[Limits; 3]) -> f64 {
    let of_axis = |(&[speed, acceleration, jerk], limits): (&[f64; 3], &Limits)| {
        let (second, third) = (acceleration / limits.acceleration, jerk / limits.jerk);
        (speed / limits.speed).max(second.sqrt()).max(third.cbrt())
    };
    bounds.iter().zip(limits).map(of_axis).fold(0.0, f64::max)
}

/// By how much time must be stretched for a cut from rest to rest to keep its limits: 1 or less when it does.
pub(super) fn excess_of(poses: &[Pose], period: f64, limits: &[Limits; 3]) -> f64 {
    let mut differences = Differences::new(period, &Allowed { cut: *limits, rapid: *limits });
    for &pose in poses {
        differences.push(pose, Regime::Cut);
    }
    if let Some(&last) = poses.last() {
        differences.rest(last, Regime::Cut);
    }
    differences.excess()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::MachineProfile;

    fn jump(regimes: [Regime; 2]) -> Differences {
        let mut profile = MachineProfile::default();
        profile.axes.x.travel.speed_mm_s = Some(3000.0);
        let axes = &profile.axes;
        let mut differences = Differences::new(1e-3, &Allowed { cut: axes.limits(), rapid: axes.travel_limits() });
        differences.push(Pose::new(0.0, 0.0, 0.0), regimes[0]);
        differences.rest(Pose::new(1.3, 0.0, 0.0), regimes[1]);
        differences
    }

    #[test]
    fn a_jump_breaks_every_limit_by_its_own_order() {
        let differences = jump([Regime::Cut; 2]);
        let peaks = differences.peaks();
        assert!((peaks[0][0].worst - 1300.0).abs() < 1e-6 && (peaks[0][0].limit - 1200.0).abs() < 1e-9);
        assert!((peaks[0][2].worst - 2.6e9).abs() < 1.0);
        assert!(differences.excess() > 10.0);
        assert!(peaks[2].iter().all(|peak| peak.worst == 0.0));
    }

    #[test]
    fn the_limits_are_those_of_what_is_done_and_at_the_passage_the_wider_ones() {
        let speed = |regimes| jump(regimes).peaks()[0][0];
        assert!((speed([Regime::Rapid; 2]).limit - 3000.0).abs() < 1e-9);
        assert!((speed([Regime::Rapid, Regime::Cut]).limit - 3000.0).abs() < 1e-9);
    }
}
