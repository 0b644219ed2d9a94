//! Motion of a head over the cloth along a chain, and its drift along the feed meanwhile.

use super::bound::Step;
use super::chains::Chain;
use super::moving::Moving;
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::geom::{Point, Rotation};
use crate::ir::Toolpath;
use crate::ir::motion::{Kind, Phase};
use crate::ir::toolpath::Pose;
use crate::machine::{Job, Knife};
use crate::pass::toolpath::{Scene, TOOLPATH_PASSES};
use crate::plan::{self, Planner};

/// A chain with its motion.
#[derive(Debug, Clone)]
pub struct Stroke {
    /// Index of the cut in the marker.
    pub cut: u32,
    /// Number of the piece, and its index in the marker.
    pub piece: [u32; 2],
    /// Points of the cut stretch of the line, mm.
    pub points: Vec<Point>,
    /// Phases over the cloth, from the first plunge to the last lift.
    pub(super) phases: Vec<Phase>,
    /// Periods of all phases.
    pub ticks: u32,
    /// Poses over the cloth at the first plunge and at the last lift.
    pub(super) ends: [Pose; 2],
    /// Maximum and minimum x of the line, mm.
    pub span: [f64; 2],
    /// Lag of the head along the feed.
    pub lag: Lag,
}

/// Lag of a head along the feed while it cuts: x + v t, mm, t counted from its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lag {
    /// Lag at the first plunge.
    pub first: f64,
    /// Lag at the last lift.
    pub last: f64,
    /// Minimum lag.
    pub least: f64,
    /// Maximum lag.
    pub most: f64,
}

impl Lag {
    /// Maximum and minimum lag including both ramps of length `ramp`, mm.
    fn reach(&self, ramp: f64) -> [f64; 2] {
        [self.most.max(self.last + ramp), self.least.min(self.first - ramp)]
    }

    /// Travel along the feed that the chain takes, with a ramp of length `ramp` at either end, mm.
    pub fn travel(&self, ramp: f64) -> f64 {
        let [most, least] = self.reach(ramp);
        most - least
    }

    /// Earliest and latest start, s after x = 0 of the cloth meets the station.
    pub(super) fn window(&self, moving: &Moving) -> [f64; 2] {
        let [most, least] = self.reach(moving.ramp.way);
        let reserve = moving.reserve();
        [(reserve - least) / moving.speed, (moving.travel + reserve - most) / moving.speed]
    }
}

/// The toolpath of a chain after all passes.
pub(super) fn toolpath(chain: &Chain, scene: &Scene, out: &mut Diagnostics) -> Toolpath {
    let mut toolpath = chain.toolpath.clone();
    for pass in TOOLPATH_PASSES {
        (pass.run)(&mut toolpath, scene, out);
    }
    toolpath
}

/// Plans the motion of a chain. The error holds the findings of the planner.
pub(super) fn stroke(chain: &Chain, toolpath: &Toolpath, moving: &Moving) -> Result<Stroke, Vec<Diagnostic>> {
    if chain.falls {
        let stroke = Stroke::of(chain, joined(toolpath, &moving.falling)?, moving);
        if keeps_up(&stroke, moving) {
            return Ok(stroke);
        }
    }
    Ok(Stroke::of(chain, joined(toolpath, &moving.either)?, moving))
}

/// True if the head never moves along the feed faster than its axis can at the speed of the cloth.
fn keeps_up(stroke: &Stroke, moving: &Moving) -> bool {
    let most = moving.either.profile.axes.x.speed_mm_s * moving.period;
    let mut last = stroke.ends[0].centre.x;
    stroke.poses().all(|(pose, _, _)| {
        let step = pose.centre.x - last;
        last = pose.centre.x;
        step <= most
    })
}

/// The motion along a toolpath from its first plunge on. The approach depends on the previous chain and is left out.
fn joined(toolpath: &Toolpath, job: &Job) -> Result<Vec<Phase>, Vec<Diagnostic>> {
    let cuts = plan::solve(toolpath, job)?;
    let motion = Planner::new(job).join(toolpath, cuts);
    Ok(motion.phases.into_iter().skip_while(|phase| phase.kind != Kind::Plunge).collect())
}

impl Stroke {
    /// A chain with its motion, which begins with a plunge.
    fn of(chain: &Chain, phases: Vec<Phase>, moving: &Moving) -> Self {
        let [Some(first), Some(last)] = [phases.first(), phases.last()] else {
            unreachable!("a chain is a run, which begins with a plunge")
        };
        let ends = [first.pose(0), last.pose(last.ticks - 1)];
        let ticks = phases.iter().map(|phase| phase.ticks).sum();
        let mut stroke = Self {
            cut: chain.cut,
            piece: [chain.toolpath.piece, chain.toolpath.part],
            points: chain.points().to_vec(),
            phases,
            ticks,
            ends,
            span: chain.span(),
            lag: Lag { first: 0.0, last: 0.0, least: f64::INFINITY, most: f64::NEG_INFINITY },
        };
        stroke.lag = stroke.measured(moving);
        stroke
    }

    /// The path of the motion, tick by tick, without the first plunge and the last lift. Its time without accelerations is a
    /// lower bound on the planned time.
    pub(super) fn way(&self, knife: &Knife) -> Vec<Step> {
        // With two edges either end of the blade may lead, so the speed of the tip does not count.
        let lead = if knife.edges == 1 { knife.radius() } else { 0.0 };
        let tip = |pose: &Pose| pose.centre + Rotation(pose.c.0 - knife.yaw()).unit() * lead;
        let mut way: Vec<Step> = Vec::with_capacity(self.ticks as usize);
        let mut last: Option<(Pose, bool)> = None;
        for (pose, down, _) in self.poses() {
            if let Some((before, was_down)) = last.replace((pose, down)) {
                let moved = (tip(&pose) - tip(&before)).norm();
                way.push(Step {
                    along: pose.centre - before.centre,
                    tip: if down && knife.edges == 1 { moved } else { 0.0 },
                    turned: (pose.c.0 - before.c.0).abs(),
                    lifted: down && !was_down,
                });
            }
        }
        way
    }

    /// Pose over the cloth, knife down or not, and block at each tick. The end tick belongs to the following motion and is not
    /// included.
    pub(super) fn poses(&self) -> impl Iterator<Item = (Pose, bool, u32)> + '_ {
        self.phases.iter().flat_map(|phase| {
            let down = phase.kind.knife_down();
            phase.setpoints().map(move |(pose, block)| (pose, down, block))
        })
    }

    fn measured(&self, moving: &Moving) -> Lag {
        let first = self.ends[0].centre.x;
        let last = self.ends[1].centre.x + f64::from(self.ticks) * moving.step();
        let mut lag = Lag { first, last, least: first, most: first.max(last) };
        for (tick, (pose, _, _)) in self.poses().enumerate() {
            let here = pose.centre.x + tick as f64 * moving.step();
            lag.least = lag.least.min(here);
            lag.most = lag.most.max(here);
        }
        lag
    }

    /// Length of the cut line, mm.
    pub fn length(&self) -> f64 {
        crate::geom::polyline::length(&self.points)
    }
}
