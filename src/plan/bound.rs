//! What keeps a cut from being faster, tick by tick.

use crate::ir::motion::{BOUNDS, Bound, Shares};
use crate::ir::toolpath::Pose;
use crate::machine::Limits;

/// Relative change of speed from tick to tick that is none.
const SPEED_EPSILON: f64 = 1e-6;

/// How many ticks of a cut each limit decides. From rest up to where the tip is first as fast as it gets there, and from
/// its last such place down to rest, the cut is bound by its start and its stop; in between by the limit that is used up
/// most. `ways` (mm) and `feeds` (mm/s) are those from each pose to the next.
pub(super) fn shares(poses: &[Pose], ways: &[f64], feeds: &[f64], period: f64, limits: &[Limits; 3]) -> Shares {
    let mut shares = Shares::default();
    let rises = |w: &[f64]| w[1] > w[0] * (1.0 + SPEED_EPSILON);
    let start = ways.windows(2).take_while(|w| rises(w)).count();
    let stop = ways.windows(2).rev().take_while(|w| rises(&[w[1], w[0]])).count();
    let cruise = start..ways.len().saturating_sub(stop).max(start);
    shares.add(Bound::Ends, (ways.len() - cruise.len()) as u64);
    let at = |i: usize| {
        let pose = poses[i.min(poses.len() - 1)];
        [pose.centre.x, pose.centre.y, pose.c.0]
    };
    for i in cruise {
        let mut worst = (ways[i] / (feeds[i] * period), Bound::Feed);
        let [a, b, c, d] = [i.saturating_sub(1), i, i + 1, i + 2].map(at);
        for axis in 0..3 {
            let [a, b, c, d] = [a[axis], b[axis], c[axis], d[axis]];
            let parts = [
                (c - b).abs() / (period * limits[axis].speed),
                (c - 2.0 * b + a).abs() / (period.powi(2) * limits[axis].acceleration),
                (d - 3.0 * c + 3.0 * b - a).abs() / (period.powi(3) * limits[axis].jerk),
            ];
            for (order, part) in parts.into_iter().enumerate() {
                if part > worst.0 {
                    worst = (part, BOUNDS[2 + 3 * axis + order]);
                }
            }
        }
        shares.add(worst.1, 1);
    }
    shares
}
