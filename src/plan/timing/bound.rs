//! Limits that bind the speed of a cut, tick by tick.

use std::ops::Range;

use crate::geom::Rotation;
use crate::ir::motion::{BOUNDS, Bound, Shares};
use crate::ir::toolpath::Pose;
use crate::machine::Limits;

/// Relative change of speed per tick that still counts as constant.
const SPEED_EPSILON: f64 = 1e-6;
/// Number of ticks at each end of a cruise where a third difference also covers ticks outside it.
const SEAM: usize = 4;

/// A cut sampled in ticks.
pub(in crate::plan) struct Cutting<'a> {
    /// Number of periods.
    pub(in crate::plan) ticks: usize,
    /// Length of a period, s.
    pub(in crate::plan) period: f64,
    /// Limits of x, y, c.
    pub(in crate::plan) limits: &'a [Limits; 3],
    /// Pose at a tick, up to and including the last.
    pub(in crate::plan) pose: &'a dyn Fn(usize) -> Pose,
    /// Distance of the tip from a tick to the next, mm.
    pub(in crate::plan) way: &'a dyn Fn(usize) -> f64,
    /// Speed cap of the tip from a tick to the next, mm/s.
    pub(in crate::plan) feed: &'a dyn Fn(usize) -> f64,
}

impl Cutting<'_> {
    /// Number of ticks bound by each limit. While the tip speeds up from rest, and while it slows down to rest, the cut is
    /// bound by its ends; in between by the limit with the highest use.
    pub(in crate::plan) fn shares(&self) -> Shares {
        let pairs = self.ticks.saturating_sub(1);
        let start = (0..pairs).take_while(|&i| self.rises(i)).count();
        let stop = (0..pairs).take_while(|&i| self.falls(i)).count();
        let cruise = self.cruise(start, stop);
        let mut shares = self.shares_of_ends(&cruise);
        cruise.for_each(|i| shares.add(self.bound(i), 1));
        shares
    }

    /// As [`Cutting::shares`], but for a cut that accelerates, cruises and decelerates, without a look at each tick. `rise` is
    /// the approximate number of ticks of the acceleration and of the deceleration.
    pub(in crate::plan) fn shares_of_cruise(&self, rise: usize) -> Shares {
        let pairs = self.ticks.saturating_sub(1);
        let start = last_near(rise, pairs, |i| self.rises(i));
        let stop = last_near(rise, pairs, |i| self.falls(i));
        let cruise = self.cruise(start, stop);
        let mut shares = self.shares_of_ends(&cruise);
        let inner = (cruise.start + SEAM).min(cruise.end)..cruise.end.saturating_sub(SEAM);
        if inner.is_empty() {
            cruise.for_each(|i| shares.add(self.bound(i), 1));
        } else {
            // All ticks between the seams are equal.
            (cruise.start..inner.start).chain(inner.end..cruise.end).for_each(|i| shares.add(self.bound(i), 1));
            shares.add(self.bound(inner.start), inner.len() as u64);
        }
        shares
    }

    /// True if the tip is faster in the period after period `i`.
    fn rises(&self, i: usize) -> bool {
        (self.way)(i + 1) > (self.way)(i) * (1.0 + SPEED_EPSILON)
    }

    /// True if the tip is slower in the following period; `i` counts periods from the end.
    fn falls(&self, i: usize) -> bool {
        let last = self.ticks - 1;
        (self.way)(last - i - 1) > (self.way)(last - i) * (1.0 + SPEED_EPSILON)
    }

    fn cruise(&self, start: usize, stop: usize) -> Range<usize> {
        start..self.ticks.saturating_sub(stop).max(start)
    }

    fn shares_of_ends(&self, cruise: &Range<usize>) -> Shares {
        let mut shares = Shares::default();
        shares.add(Bound::Ends, (self.ticks - cruise.len()) as u64);
        shares
    }

    /// The limit with the highest use in a period.
    fn bound(&self, i: usize) -> Bound {
        let at = |i: usize| {
            let Pose { centre, c: Rotation(c) } = (self.pose)(i.min(self.ticks));
            [centre.x, centre.y, c]
        };
        let mut worst = ((self.way)(i) / ((self.feed)(i) * self.period), Bound::Feed);
        let [a, b, c, d] = [i.saturating_sub(1), i, i + 1, i + 2].map(at);
        for (axis, limits) in self.limits.iter().enumerate() {
            let [a, b, c, d] = [a[axis], b[axis], c[axis], d[axis]];
            let parts = [
                (c - b).abs() / (self.period * limits.speed),
                (c - 2.0 * b + a).abs() / (self.period.powi(2) * limits.acceleration),
                (d - 3.0 * c + 3.0 * b - a).abs() / (self.period.powi(3) * limits.jerk),
            ];
            for (order, part) in parts.into_iter().enumerate() {
                if part > worst.0 {
                    worst = (part, BOUNDS[2 + 3 * axis + order]);
                }
            }
        }
        worst.1
    }
}

/// Number of consecutive integers from 0, below `end`, for which `holds`. The search starts at `guess`, which should be close.
fn last_near(guess: usize, end: usize, holds: impl Fn(usize) -> bool) -> usize {
    let mut count = guess.min(end);
    while count > 0 && !holds(count - 1) {
        count -= 1;
    }
    while count < end && holds(count) {
        count += 1;
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Point, Vector};
    use crate::ir::motion::StraightCut;
    use crate::machine::MachineProfile;
    use crate::machine::kinematics::Move;

    #[test]
    fn the_shares_of_a_straight_cut_are_those_of_its_ticks() {
        let limits = MachineProfile::default().axes.limits();
        for (length, feed) in [(0.4, 900.0), (10.0, 900.0), (77.0, 900.0), (500.0, 700.0), (9000.0, f64::INFINITY)] {
            for degrees in [0.0_f64, 20.0, 90.0, 130.0] {
                let (sin, cos) = degrees.to_radians().sin_cos();
                let mut along = limits[0].along(cos).min(limits[1].along(sin));
                along.speed = along.speed.min(feed);
                let way = Move::new(length, along);
                let (from, direction) = (Point::new(40.0, -70.0), Vector::new(cos, sin));
                let stroke = StraightCut { from, along: direction, start: 6.6, lead: 4.4, c: Rotation(1.0), way };
                let ticks = (way.duration() / 1e-3).ceil() as usize;
                let reach = |i: usize| stroke.reach(i as f64, ticks as f64);
                let cutting = Cutting {
                    ticks,
                    period: 1e-3,
                    limits: &limits,
                    pose: &|i| stroke.at(i as f64, ticks as f64),
                    way: &|i| reach(i + 1) - reach(i),
                    feed: &|_| feed,
                };
                let rise = (way.rise() * ticks as f64) as usize;
                assert_eq!(cutting.shares_of_cruise(rise), cutting.shares(), "{length} mm, {degrees} degrees");
            }
        }
    }
}
