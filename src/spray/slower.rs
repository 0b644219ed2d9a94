//! Places of a planned cut at which the jet is too fast for its edge, and the factors by which the head must be slower there.
//!
//! The curve of a planner swings a little about the curvature of the course where a line meets an arc. The jet is then faster
//! than the speed of the head suggests, so its speed is measured on the planned motion.

use std::f64::consts::FRAC_PI_2;

use super::course::{Leg, Role};
use crate::geom::{Heading, Point};
use crate::machine::Job;
use crate::plan::Cut;

/// Length of the jet's path over which its speed is measured, mm.
const WAY: f64 = 5.0;
/// Fraction of the permitted excess of speed that is used.
const SHARE: f64 = 0.8;
/// Ratio of a lowered speed to the permitted one.
const LOWERED: f64 = 0.99;
/// Length before and behind a place with a too fast jet over which the head is slowed down, mm.
const AROUND: f64 = 10.0;

/// Factors that lower the speed on each leg of a cut so that the jet is not too fast; `None` if it never is.
pub(super) fn shares(cut: &Cut, pass: &[Leg], job: &Job) -> Option<Vec<f64>> {
    let tool = &job.profile.tool;
    let most = tool.edge_speed_mm_s * (1.0 + SHARE * tool.edge_speed_percent / 100.0);
    let period = job.profile.time.period();
    let poses: Vec<_> = cut.poses().collect();
    let spots: Vec<Point> =
        poses.iter().map(|pose| pose.centre + Heading::new(pose.c.0 + FRAC_PI_2).unit() * tool.distance_mm).collect();
    let legs = legs_at(cut, poses.len());
    let (mut from, mut way) = (0, 0.0);
    let step = |i: usize| (spots[i] - spots[i - 1]).norm();
    let mut shares = vec![1.0_f64; pass.len()];
    for i in 1..spots.len() {
        way += step(i);
        while way - step(from + 1) >= WAY {
            from += 1;
            way -= step(from);
        }
        let speed = way / ((i - from) as f64 * period);
        if way >= WAY && speed > most && pass[legs[i]].role != Role::Air {
            // Ticks that are slow enough themselves are not the cause.
            for tick in (from + 1..=i).filter(|&tick| step(tick) > most * period) {
                for leg in [legs[tick - 1], legs[tick]] {
                    shares[leg] = shares[leg].min(LOWERED * most / speed);
                }
            }
        }
    }
    spread(&mut shares, pass);
    shares.iter().any(|&share| share < 1.0).then_some(shares)
}

/// The leg at each tick.
fn legs_at(cut: &Cut, ticks: usize) -> Vec<usize> {
    // A cut begins on the first leg of its pass.
    let first = cut.spells()[0].block;
    let mut legs = vec![0; ticks];
    for (spell, until) in
        cut.spells().iter().zip(cut.spells().iter().skip(1).map(|next| next.first as usize).chain([ticks]))
    {
        legs[spell.first as usize..until].fill((spell.block - first) as usize);
    }
    legs
}

/// Lowers the legs near a lowered leg by the same factor. A corner, at which the jet stays, does not lower edges.
pub(super) fn spread(shares: &mut [f64], pass: &[Leg]) {
    let known = shares.to_vec();
    let mut lower = |from: usize, legs: &mut dyn Iterator<Item = usize>| {
        let mut way = 0.0;
        for leg in legs {
            if pass[from].role == Role::Corner && pass[leg].role == Role::Edge {
                break;
            }
            shares[leg] = shares[leg].min(known[from]);
            way += pass[leg].length();
            if way > AROUND {
                break;
            }
        }
    };
    for from in (0..known.len()).filter(|&leg| known[leg] < 1.0) {
        lower(from, &mut (from..pass.len()));
        lower(from, &mut (0..from).rev());
    }
}
