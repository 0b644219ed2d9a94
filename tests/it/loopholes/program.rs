//! Programs that are written by hand, and what the verifier finds in them.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use cutc::geom::{Heading, Point};
use cutc::ir::Marker;
use cutc::ir::verdict::Verdict;
use cutc::machine::Job;
use cutc::pipeline::Declared;
use cutc::verify::{self, Ground};

use crate::support;

/// Time of the moves below, s: a little, and more the farther they go, so that no axis comes near a limit.
const TIME_LEAST: f64 = 0.2;
const TIME_A_STEP: f64 = 0.02;

/// A row's outputs.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Outputs {
    pub(crate) knife: u8,
    pub(crate) drill: u8,
    pub(crate) event: u8,
    pub(crate) block: u32,
}

/// A program that is written by hand: smooth moves from rest to rest, and dwells.
pub(crate) struct Program {
    pub(crate) job: Job,
    pub(crate) poses: Vec<[f64; 3]>,
    pub(crate) outputs: Vec<Outputs>,
    /// What it says that it does beside the drawing; `None` when it says nothing at all.
    pub(crate) declared: Option<Declared>,
}

impl Program {
    pub(crate) fn new(job: &Job) -> Self {
        Self { job: job.clone(), poses: vec![job.profile.home], outputs: vec![Outputs::default()], declared: None }
    }

    pub(crate) fn pose(&self) -> [f64; 3] {
        self.poses[self.poses.len() - 1]
    }

    /// Ticks of a dwell, the one at which it is over included.
    pub(crate) fn ticks(&self, ms: f64) -> usize {
        (ms / self.job.profile.time.period_ms).ceil() as usize + 1
    }

    pub(crate) fn rest(&mut self, ticks: usize, outputs: Outputs) {
        for _ in 0..ticks {
            self.poses.push(self.pose());
            self.outputs.push(outputs);
        }
    }

    /// From rest to rest along a way that is given by the share of it that is done.
    pub(crate) fn along(&mut self, steps: f64, outputs: Outputs, pose: impl Fn(f64) -> [f64; 3]) {
        let ticks = ((TIME_LEAST + TIME_A_STEP * steps) / self.job.profile.time.period()).ceil();
        for i in 1..=ticks as usize {
            let x = i as f64 / ticks;
            self.poses.push(pose(x * x * x * (10.0 - x * (15.0 - x * 6.0))));
            self.outputs.push(outputs);
        }
    }

    pub(crate) fn go(&mut self, to: [f64; 3], outputs: Outputs) {
        let from = self.pose();
        let way = |axis: usize| (to[axis] - from[axis]).abs();
        let steps = way(0).max(way(1)).max(way(2));
        self.along(steps, outputs, |x| std::array::from_fn(|axis| from[axis] + (to[axis] - from[axis]) * x));
    }

    /// The pose with the tip at a point.
    pub(crate) fn at(&self, tip: Point, heading_deg: f64) -> [f64; 3] {
        let centre = tip - Heading::new(heading_deg.to_radians()).unit() * self.job.profile.knife.radius();
        [centre.x, centre.y, heading_deg]
    }

    pub(crate) fn down(block: u32) -> Outputs {
        Outputs { knife: 1, block, ..Outputs::default() }
    }

    pub(crate) fn plunge(&mut self, tip: Point, heading_deg: f64, block: u32) {
        self.go(self.at(tip, heading_deg), Outputs::default());
        self.rest(self.ticks(self.job.profile.knife.plunge_ms), Self::down(block));
    }

    pub(crate) fn lift(&mut self) {
        self.rest(self.ticks(self.job.profile.knife.lift_ms), Outputs::default());
    }

    pub(crate) fn plunge_cut(&mut self, tip: Point, heading_deg: f64, block: u32) {
        self.plunge(tip, heading_deg, block);
        self.lift();
    }

    /// One straight stroke: the tail plunges at `tail`, the tip is lifted at `tip`.
    pub(crate) fn run(&mut self, tail: Point, tip: Point, block: u32) {
        let along = (tip - tail).normalize();
        let heading = along.y.atan2(along.x).to_degrees();
        self.plunge(tail + along * self.job.profile.knife.width_mm, heading, block);
        self.go(self.at(tip, heading), Self::down(block));
        self.lift();
    }

    pub(crate) fn drill(&mut self, at: Point, tool: u8) {
        let c = self.pose()[2];
        self.go([at.x, at.y, c], Outputs::default());
        self.rest(self.ticks(self.job.profile.drill.dwell_ms), Outputs { drill: tool, ..Outputs::default() });
    }

    pub(crate) fn judge(&mut self, marker: &Marker) -> Verdict {
        self.rest(2, Outputs::default());
        let mut text = String::from("t_s,x_mm,y_mm,c_deg,knife,drill,event,block\n");
        for (i, ([x, y, c], outputs)) in self.poses.iter().map(|p| p.map(|v| v + 0.0)).zip(&self.outputs).enumerate() {
            let Outputs { knife, drill, event, block } = outputs;
            let t = i as f64 * self.job.profile.time.period();
            let _ = writeln!(text, "{t:.6},{x:.6},{y:.6},{c:.6},{knife},{drill},{event},{block}");
        }
        verify::setpoints(
            &mut text.as_bytes(),
            self.declared.as_ref(),
            &Ground::new(marker, &self.job.profile),
            &self.job,
        )
    }
}

pub(crate) fn broken(verdict: &Verdict) -> Vec<&'static str> {
    verdict.broken().map(|finding| finding.rule.name).collect()
}

pub(crate) fn check(mut program: Program, marker: &Marker, expected: &[&str]) {
    let verdict = program.judge(marker);
    assert_eq!(broken(&verdict), expected, "{:#?}", verdict.broken().collect::<Vec<_>>());
}

pub(crate) fn p(x: f64, y: f64) -> Point {
    Point::new(x, y)
}

/// A circle of 48 chords.
pub(crate) fn circle(radius: f64) -> Marker {
    let at = |i: i32| p(100.0, 50.0) + Heading::new(TAU * f64::from(i % 48) / 48.0).unit() * radius;
    support::marker(&(0..=48).map(at).collect::<Vec<_>>())
}
