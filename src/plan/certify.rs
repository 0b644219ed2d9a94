//! Certification: finite differences of the setpoints against the limits of the axes. Every emitted sample passes this check.
//!
//! A finite difference of order k, divided by h^k, is a weighted mean of the k-th derivative over its support. So a motion that
//! keeps its limits between the samples also keeps them here, and stretching time by rho lowers the k-th difference by rho^k.
//!
//! For the same reason a motion in closed form with known peak derivatives needs samples only where it meets other motions.

use crate::ir::motion::{Derivatives, Phase, Poses};
use crate::ir::toolpath::Pose;
use crate::machine::Limits;

/// Relative excess over a limit that is rounding of the differences.
pub(super) const EXCESS_EPSILON: f64 = 1e-6;

/// Peak speed, acceleration or jerk of an axis and its limit, in mm or rad, and s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Peak {
    /// Peak value.
    pub worst: f64,
    /// Limit in force at the peak.
    pub limit: f64,
}

/// Peak speed, acceleration and jerk of x, y and c, each where it comes nearest to its limit.
pub type Peaks = [[Peak; 3]; 3];

/// Set of limits in force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Regime {
    /// Limits of cutting: the knife is commanded down.
    Cut,
    /// Limits of travel.
    Rapid,
}

/// Limits of x, y and c in both regimes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Allowed {
    pub(super) cut: [Limits; 3],
    pub(super) rapid: [Limits; 3],
}

/// Number of setpoints in a third difference.
const SUPPORT: u32 = 4;

/// Maximum differences of order 1 to 3 of each axis.
type Rows = [[f64; 3]; 3];

/// Tracks setpoints and records the peak differences. Before the first setpoint the axes are at rest.
#[derive(Debug, Clone)]
pub(super) struct Differences {
    period: f64,
    /// Permitted differences in a cut, in a rapid, and in the transition between the two at rest, where the wider limits hold.
    allowed: [Rows; 3],
    /// Last setpoint of each axis, with its differences of order 1 and 2.
    last: Option<Rows>,
    /// Regimes of the last three setpoints.
    regimes: [Regime; 3],
    /// Peak differences relative to the permitted ones, each with its index into `allowed`.
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

    /// Adds the next setpoint.
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

    /// Adds a phase. For a phase in closed form the setpoints at both ends are added, because they meet other phases; in
    /// between, its peak derivatives bound all differences.
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

    /// Adds the peak derivatives of a stretch in one regime.
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

    /// Adds the last setpoint, after which the axes are at rest.
    pub(super) fn rest(&mut self, pose: Pose, regime: Regime) {
        for _ in 0..3 {
            self.push(pose, regime);
        }
    }

    /// Peak speed, acceleration and jerk so far.
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

    /// Factor by which time must be stretched to permit all differences so far; at most 1 when they are permitted.
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

/// Factor by which time must be stretched for a cut in closed form to keep its limits; at most 1 when it keeps them.
pub(super) fn excess_of_derivatives(bounds: &Derivatives, limits: &[Limits; 3]) -> f64 {
    let of_axis = |(&[speed, acceleration, jerk], limits): (&[f64; 3], &Limits)| {
        let (second, third) = (acceleration / limits.acceleration, jerk / limits.jerk);
        (speed / limits.speed).max(second.sqrt()).max(third.cbrt())
    };
    bounds.iter().zip(limits).map(of_axis).fold(0.0, f64::max)
}

/// Factor by which time must be stretched for a cut from rest to rest to keep its limits; at most 1 when it keeps them.
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
