//! The check that no sample leaves without: finite differences of the setpoints against the limits of the axes.
//!
//! A finite difference of order k, divided by h^k, is a weighted mean of the k-th derivative over its support, so a
//! motion that keeps its limits between the samples also keeps them here, and stretching time by rho lowers the k-th
//! difference by rho^k.

use crate::ir::toolpath::Pose;
use crate::machine::Limits;

/// Greatest speed, acceleration and jerk of x, y (mm) and c (rad).
pub type Peaks = [[f64; 3]; 3];

/// Relative excess over a limit that is rounding of the differences themselves.
pub(super) const EXCESS_EPSILON: f64 = 1e-6;

/// Follows setpoints and keeps the greatest differences. Before the first setpoint the axes rest.
#[derive(Debug, Clone)]
pub(super) struct Differences {
    period: f64,
    /// The last setpoint and its differences of order 1 and 2.
    last: Option<[[f64; 3]; 3]>,
    /// Greatest differences of order 1 to 3, axis by axis, not yet divided by the period.
    greatest: Peaks,
}

impl Differences {
    pub(super) fn new(period: f64) -> Self {
        Self { period, last: None, greatest: [[0.0; 3]; 3] }
    }

    /// Takes the next setpoint.
    pub(super) fn push(&mut self, pose: Pose) {
        let here = [pose.centre.x, pose.centre.y, pose.c.0];
        let Some(last) = &mut self.last else {
            self.last = Some([here, [0.0; 3], [0.0; 3]]);
            return;
        };
        for axis in 0..3 {
            let d1 = here[axis] - last[0][axis];
            let d2 = d1 - last[1][axis];
            let d3 = d2 - last[2][axis];
            let greatest = &mut self.greatest[axis];
            *greatest = [greatest[0].max(d1.abs()), greatest[1].max(d2.abs()), greatest[2].max(d3.abs())];
            last[0][axis] = here[axis];
            last[1][axis] = d1;
            last[2][axis] = d2;
        }
    }

    /// Takes the last setpoint: behind it the axes rest.
    pub(super) fn rest(&mut self, pose: Pose) {
        for _ in 0..3 {
            self.push(pose);
        }
    }

    /// The greatest speed, acceleration and jerk so far.
    pub(super) fn peaks(&self) -> Peaks {
        let h = self.period;
        self.greatest.map(|[d1, d2, d3]| [d1 / h, d2 / (h * h), d3 / (h * h * h)])
    }
}

/// By how much time must be stretched for `peaks` to keep `limits`: 1 or less when they do.
pub(super) fn excess(peaks: &Peaks, limits: &[Limits; 3]) -> f64 {
    let of_axis = |([speed, acceleration, jerk], limits): (&[f64; 3], &Limits)| {
        let square = (acceleration / limits.acceleration).sqrt();
        let cube = (jerk / limits.jerk).cbrt();
        (speed / limits.speed).max(square).max(cube)
    };
    peaks.iter().zip(limits).map(of_axis).fold(0.0, f64::max)
}

/// The greatest differences of a motion from rest to rest.
pub(super) fn peaks_of(poses: &[Pose], period: f64) -> Peaks {
    let mut differences = Differences::new(period);
    for &pose in poses {
        differences.push(pose);
    }
    if let Some(&last) = poses.last() {
        differences.rest(last);
    }
    differences.peaks()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::MachineProfile;

    #[test]
    fn a_jump_breaks_every_limit_by_its_own_order() {
        let limits = MachineProfile::default().axes.limits();
        let poses = [Pose::new(0.0, 0.0, 0.0), Pose::new(1.3, 0.0, 0.0)];
        let peaks = peaks_of(&poses, 1e-3);
        assert!((peaks[0][0] - 1300.0).abs() < 1e-6);
        assert!((peaks[0][2] - 2.6e9).abs() < 1.0);
        assert!(excess(&peaks, &limits) > 10.0);
        assert_eq!(peaks[2], [0.0; 3]);
    }
}
