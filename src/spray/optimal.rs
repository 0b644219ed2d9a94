//! The default planner: the cutter's, with the speed of the head as its feed.
//!
//! It smooths the way within the tolerance, and where a line meets an arc the curvature of the smooth way swings a little
//! about that of the course: there the jet would be faster than the head's feed says. So the jet is measured on what was
//! planned, and the feed lowered where it is too fast.

use std::f64::consts::FRAC_PI_2;

use super::course::{Leg, Pass, Role};
use crate::diagnostic::Diagnostic;
use crate::geom::{Heading, Point};
use crate::ir::toolpath::{Run, Step, Toolpath};
use crate::machine::Job;
use crate::plan::{self, Cut};

/// Way of the jet over which its speed is measured, mm.
const WAY: f64 = 5.0;
/// Share of how much faster the jet may be that is used.
const SHARE: f64 = 0.8;
/// How far below what is allowed it is brought.
const LOWERED: f64 = 0.99;
/// How far before and behind a place where the jet is too fast the feed is lowered, mm.
const AROUND: f64 = 10.0;
/// Rounds of lowering; what is left then the verifier judges.
const ROUNDS: usize = 6;

/// The cuts of all passes.
pub(super) fn solve(toolpath: &mut Toolpath, passes: &[Pass], job: &Job) -> Result<Vec<Cut>, Vec<Diagnostic>> {
    let mut cuts = plan::solve(toolpath, job)?;
    for _ in 0..ROUNDS {
        let runs = toolpath.steps.iter_mut().filter_map(|step| match step {
            Step::Run(run) => Some(run),
            Step::PlungeCut(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => None,
        });
        let mut is_lowered = false;
        for ((run, cut), pass) in runs.zip(&cuts).zip(passes) {
            is_lowered |= lower(run, cut, pass, job);
        }
        if !is_lowered {
            break;
        }
        cuts = plan::solve(toolpath, job)?;
    }
    Ok(cuts)
}

/// Lowers the feed of a run where the jet is too fast; whether it is anywhere.
fn lower(run: &mut Run, cut: &Cut, pass: &[Leg], job: &Job) -> bool {
    let tool = &job.profile.tool;
    let most = tool.edge_speed_mm_s * (1.0 + SHARE * tool.edge_speed_percent / 100.0);
    let period = job.profile.time.period();
    let poses: Vec<_> = cut.poses().collect();
    let spots: Vec<Point> =
        poses.iter().map(|pose| pose.centre + Heading::new(pose.c.0 + FRAC_PI_2).unit() * tool.distance_mm).collect();
    let legs = legs_at(cut, run, poses.len());
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
            for leg in &legs[from..=i] {
                shares[*leg] = shares[*leg].min(LOWERED * most / speed);
            }
        }
    }
    spread(&mut shares, pass);
    run.feeds.iter_mut().zip(&shares).for_each(|(feed, share)| *feed *= share);
    shares.iter().any(|&share| share < 1.0)
}

/// The leg at each tick.
fn legs_at(cut: &Cut, run: &Run, ticks: usize) -> Vec<usize> {
    let first = run.spans[0].block;
    let mut legs = vec![0; ticks];
    for (spell, until) in
        cut.spells().iter().zip(cut.spells().iter().skip(1).map(|next| next.first as usize).chain([ticks]))
    {
        legs[spell.first as usize..until].fill((spell.block - first) as usize);
    }
    legs
}

/// Lowers what is near a lowered leg as much.
fn spread(shares: &mut [f64], pass: &[Leg]) {
    let known = shares.to_vec();
    let mut lower = |legs: &mut dyn Iterator<Item = usize>, share: f64| {
        let mut way = 0.0;
        for leg in legs {
            shares[leg] = shares[leg].min(share);
            way += pass[leg].length();
            if way > AROUND {
                break;
            }
        }
    };
    for (i, &share) in known.iter().enumerate().filter(|(_, share)| **share < 1.0) {
        lower(&mut (i..pass.len()), share);
        lower(&mut (0..i).rev(), share);
    }
}
