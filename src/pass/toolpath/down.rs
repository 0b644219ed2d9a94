//! Pass `down`: no run is longer than the knife may stay down.
//!
//! Needs runs split at corners. Leaves none longer than `knife.max_down_mm`, when that is set: a longer one is lifted
//! after equal parts and rejoined with the overlaps of a corner, which here lie along the contour.

use super::ToolpathPass;
use crate::diagnostic::Diagnostics;
use crate::geom::{polyline, spline};
use crate::ir::list::Joint;
use crate::ir::toolpath::{End, Run, Shape, Step, Toolpath};
use crate::machine::{Job, Knife};

pub(super) const PASS: ToolpathPass =
    ToolpathPass { name: "down", about: "lifts runs that are longer than knife.max_down_mm", run };

fn run(toolpath: &mut Toolpath, job: &Job, _: &mut Diagnostics) {
    let Some(longest) = job.profile.knife.max_down_mm else { return };
    let steps = std::mem::take(&mut toolpath.steps);
    for step in steps {
        match step {
            Step::Run(run) => toolpath.steps.extend(split(run, longest, &job.profile.knife).into_iter().map(Step::Run)),
            Step::Stab(_) | Step::Turn(_) | Step::Travel(_) | Step::Drill(_) | Step::Event(_) => {
                toolpath.steps.push(step);
            }
        }
    }
}

/// Equal parts of a run, as few as keep below `longest`, each led on along the contour by the overlaps of a corner.
fn split(run: Run, longest: f64, knife: &Knife) -> Vec<Run> {
    let length = polyline::length(&run.points);
    let parts = (length / longest).ceil() as usize;
    if parts <= 1 {
        return vec![run];
    }
    let (heel, front) = (knife.corner_heel_overlap_mm, knife.corner_front_overlap_mm);
    let ring = run.shape == Shape::Ring;
    let way = Way::new(&run);
    let cut = |i: usize| length * i as f64 / parts as f64;
    (0..parts)
        .map(|i| {
            let (first, last) = (i == 0 && !ring, i + 1 == parts && !ring);
            let from = if first { 0.0 } else { cut(i) - heel };
            let to = if last { length } else { cut(i + 1) + front };
            let ends = [if first { run.ends[0] } else { REJOINED }, if last { run.ends[1] } else { REJOINED }];
            way.part(&run, from, to, ends)
        })
        .collect()
}

/// Where a run is lifted on its way: its overlap already lies along the contour.
const REJOINED: End = End { corner: true, bare: true };

/// The chords of a run by their stations; on a ring they go round and round.
struct Way {
    stations: Vec<f64>,
    ring: bool,
}

impl Way {
    fn new(run: &Run) -> Self {
        Self { stations: polyline::stations(&run.points), ring: run.shape == Shape::Ring }
    }

    fn length(&self) -> f64 {
        self.stations[self.stations.len() - 1]
    }

    /// The run from one station to another.
    fn part(&self, run: &Run, from: f64, to: f64, ends: [End; 2]) -> Run {
        let chords = self.stations.len() - 1;
        let (length, laps) = (self.length(), if self.ring { (from / self.length()).floor() } else { 0.0 });
        let (mut lap, from) = (laps * length, from.max(if self.ring { f64::NEG_INFINITY } else { 0.0 }));
        let mut chord = spline::span(&self.stations, from - lap);
        let at = |chord: usize, station: f64| {
            let (a, b) = (run.points[chord], run.points[chord + 1]);
            a + (b - a) * ((station - self.stations[chord]) / (self.stations[chord + 1] - self.stations[chord]))
        };
        let mut part = Run {
            points: vec![at(chord, from - lap)],
            spans: Vec::new(),
            joints: vec![Joint::default()],
            feeds: Vec::new(),
            shape: Shape::Open,
            ends,
            ..*run
        };
        loop {
            let end = self.stations[chord + 1] + lap;
            let (point, joint) = if to < end {
                (at(chord, to - lap), Joint::default())
            } else {
                (run.points[chord + 1], run.joints[chord + 1])
            };
            if part.points.last() != Some(&point) {
                part.points.push(point);
                part.spans.push(run.spans[chord]);
                part.feeds.push(run.feeds[chord]);
                part.joints.push(joint);
            }
            let over = chord + 1 == chords;
            if to <= end || over && !self.ring {
                return part;
            }
            (chord, lap) = if over { (0, lap + length) } else { (chord + 1, lap) };
        }
    }
}
