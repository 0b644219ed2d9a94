//! Joins solved runs to a motion by turns and rapids, and by plunges and lifts at rest.

use super::certify::{Allowed, Differences, EXCESS_EPSILON, Peaks, Regime};
use super::rapid;
use super::run::{Cut, whole_periods};
use crate::diagnostic::{Diagnostic, code};
use crate::geom::{Rotation, Vector};
use crate::ir::motion::{Kind, Motion, Phase, Poses, Spell, Task};
use crate::ir::toolpath::{Drill, Overcut, PlungeCut, Pose, Run, Step, Toolpath};
use crate::machine::Job;
use crate::source::Span;
use crate::units::number::fixed;
use crate::units::rad;

/// Joins solved runs to a program, tracking the pose of the axes and the time.
#[derive(Debug)]
pub struct Planner<'a> {
    job: &'a Job,
    allowed: Allowed,
    pose: Pose,
    tick: u64,
    steps: u64,
    time: f64,
    /// Time until the blade is fully up, s; it may be clear of the cloth before.
    rising: f64,
    differences: Differences,
    /// Advance of the cloth so far, mm. Runs have coordinates on the cloth, the axes have coordinates over the table.
    station: u32,
}

impl<'a> Planner<'a> {
    /// A program that starts at rest at home.
    pub fn new(job: &'a Job) -> Self {
        let pose = home(job);
        let allowed = Allowed { cut: job.profile.axes.limits(), rapid: job.profile.axes.travel_limits() };
        let mut differences = Differences::new(job.profile.time.period(), &allowed);
        differences.push(pose, Regime::Rapid);
        Self { job, allowed, pose, tick: 0, steps: 0, time: 0.0, rising: 0.0, differences, station: 0 }
    }

    /// A program that starts when the cloth has already advanced by `moved_on` mm.
    #[must_use]
    pub fn over(self, moved_on: u32) -> Self {
        Self { station: moved_on, ..self }
    }

    /// The timed motion of a toolpath with its solved runs.
    pub fn join(&mut self, toolpath: &Toolpath, cuts: Vec<Cut>) -> Motion {
        let mut motion = self.begin([toolpath.piece, toolpath.part]);
        for cut in &cuts {
            motion.shares.merge(&cut.shares);
        }
        let mut cuts = cuts.into_iter();
        let mut kind = Kind::Travel;
        for (step, next) in toolpath.steps.iter().zip(toolpath.steps.iter().skip(1).map(Some).chain([None])) {
            match step {
                Step::Turn(rapid) | Step::Travel(rapid) => {
                    kind = if matches!(step, Step::Turn(_)) { Kind::Turn } else { Kind::Travel };
                    // The step after a move decides where it ends; a move with no such step ends at its own target.
                    if next.is_none_or(|next| matches!(next, Step::Turn(_) | Step::Travel(_))) {
                        self.go(kind, self.on_table(rapid.to), &mut motion);
                    }
                }
                Step::Run(run) => {
                    motion.tasks.push(task_of_run(run));
                    self.run(kind, cuts.next().expect("solve gives a cut for each run"), &mut motion);
                }
                Step::PlungeCut(plunge_cut) => {
                    motion.tasks.push(task_of_plunge_cut(plunge_cut));
                    self.plunge_cut(kind, plunge_cut, &mut motion);
                }
                Step::Drill(drill) => {
                    motion.tasks.push(Task { blocks: [drill.span.block; 2], ..Task::default() });
                    self.drill(kind, drill, &mut motion);
                }
                Step::Event(event) => {
                    self.rise(&mut motion);
                    self.station += event.advance_mm();
                    self.hold(Kind::Event(*event), 0.0, 0, &mut motion);
                }
            }
        }
        motion
    }

    /// The end of the program: a move to the park pose, if any, and a last setpoint at rest.
    pub fn finish(&mut self) -> Motion {
        let mut motion = self.begin([0; 2]);
        if let Some([x, y, c]) = self.job.profile.park {
            self.go(Kind::Travel, Pose::new(x, y, rad(c)), &mut motion);
        }
        self.rise(&mut motion);
        self.hold(Kind::Rest, 0.0, 0, &mut motion);
        self.differences.rest(self.pose, Regime::Rapid);
        motion
    }

    /// Peak speed, acceleration and jerk of the program so far.
    pub fn peaks(&self) -> Peaks {
        self.differences.peaks()
    }

    /// Final check of every setpoint in order against the limits.
    pub fn certify(&self) -> Result<(), Diagnostic> {
        let rho = self.differences.excess();
        if rho <= 1.0 + EXCESS_EPSILON {
            return Ok(());
        }
        let percent = fixed((rho - 1.0) * 100.0, 3);
        Err(Diagnostic::new(
            &code::PLAN_CERTIFY,
            format!("the program as a whole exceeds a limit by {percent} % of time"),
        ))
    }

    /// Advance of the cloth so far, mm.
    fn moved_on(&self) -> Vector {
        Vector::new(f64::from(self.station), 0.0)
    }

    /// The pose over the table for a pose on the cloth.
    fn on_table(&self, pose: Pose) -> Pose {
        Pose { centre: pose.centre - self.moved_on(), ..pose }
    }

    /// An empty motion that starts now.
    fn begin(&self, [piece, part]: [u32; 2]) -> Motion {
        let (first_tick, first_step, first_time) = (self.tick, self.steps, self.time);
        Motion { piece, part, first_tick, first_step, first_time, ..Motion::default() }
    }

    /// Moves to the start of a run, plunges, cuts along it and lifts; `kind` is that of the rapid before it.
    fn run(&mut self, kind: Kind, mut cut: Cut, motion: &mut Motion) {
        cut.turn(self.job.profile.knife.yaw());
        cut.shift(-self.moved_on());
        self.go(kind, cut.start(), motion);
        self.plunge(cut.spells[0].block, motion);
        self.cut(cut, motion);
        self.lift(motion);
    }

    /// Moves to a plunge cut, plunges and lifts.
    fn plunge_cut(&mut self, kind: Kind, plunge_cut: &PlungeCut, motion: &mut Motion) {
        self.go(kind, yawed(self.on_table(plunge_cut.pose), self.job), motion);
        let block = plunge_cut.spans.last().map_or(0, |span| span.block);
        self.plunge(block, motion);
        self.lift(motion);
    }

    /// Moves the drill over a hole and drills.
    fn drill(&mut self, kind: Kind, drill: &Drill, motion: &mut Motion) {
        let keys = &self.job.profile.drill;
        let [x, y] = keys.offset_mm;
        let there = self.on_table(Pose::new(drill.at.x - x, drill.at.y - y, self.pose.c.0));
        if there == self.pose {
            // Raise the drill for at least one period, so that two holes at one place are distinct.
            self.hold(Kind::Travel, 0.0, 0, motion);
        }
        self.go(kind, there, motion);
        self.rise(motion);
        self.hold(Kind::Drill(drill.tool), keys.dwell(), 0, motion);
    }

    /// A rapid to a pose; nothing if the axes are already there.
    fn go(&mut self, kind: Kind, to: Pose, motion: &mut Motion) {
        if to == self.pose {
            return;
        }
        let glide = rapid::glide(self.pose, to, &self.allowed.rapid);
        let (duration, length) = (glide.duration(), glide.length());
        let ticks = whole_periods(duration, self.job.profile.time.period());
        self.emit(
            Phase { kind, ticks, poses: Poses::Glide(glide), spells: Vec::new(), duration, length, station: 0 },
            to,
            motion,
        );
    }

    /// Plunges once the blade is fully up.
    fn plunge(&mut self, block: u32, motion: &mut Motion) {
        self.rise(motion);
        self.hold(Kind::Plunge, self.job.profile.knife.plunge(), block, motion);
    }

    /// Lifts: the axes rest until the blade is clear of the cloth.
    fn lift(&mut self, motion: &mut Motion) {
        let knife = &self.job.profile.knife;
        self.hold(Kind::Lift, knife.clear(), 0, motion);
        self.rising = knife.lift() - knife.clear();
    }

    /// Rests until the blade is fully up.
    fn rise(&mut self, motion: &mut Motion) {
        if self.rising > 0.0 {
            self.hold(Kind::Wait, self.rising, 0, motion);
        }
    }

    /// Rests for a duration, rounded up to at least one period.
    fn hold(&mut self, kind: Kind, duration: f64, block: u32, motion: &mut Motion) {
        let ticks = whole_periods(duration, self.job.profile.time.period());
        let spells = vec![Spell { first: 0, block }];
        let phase = Phase { kind, ticks, poses: Poses::Still(self.pose), spells, duration, length: 0.0, station: 0 };
        self.emit(phase, self.pose, motion);
    }

    /// Cuts along a run; nothing if it has no length.
    fn cut(&mut self, cut: Cut, motion: &mut Motion) {
        if let Some((phase, end)) = cut.phase() {
            self.emit(phase, end, motion);
        }
    }

    fn emit(&mut self, mut phase: Phase, end: Pose, motion: &mut Motion) {
        if !self.job.mode.cuts() {
            phase = Phase { kind: phase.kind.raised(), spells: Vec::new(), ..phase };
        }
        phase.station = self.station;
        let regime = if phase.kind.knife_down() { Regime::Cut } else { Regime::Rapid };
        self.differences.pass(&phase, regime);
        // A phase rounded up to whole periods lets the blade rise farther.
        self.rising = (self.rising - f64::from(phase.ticks) * self.job.profile.time.period()).max(0.0);
        self.tick += u64::from(phase.ticks);
        self.steps += u64::from(phase.kind.begins_step());
        self.time += phase.duration;
        self.pose = end;
        motion.phases.push(phase);
    }
}

/// Task of a run.
fn task_of_run(run: &Run) -> Task {
    let Run { front, heel, turned, edge, orientation, .. } = *run;
    let sides = run.ends.map(|end| end.side);
    Task {
        blocks: ends(&run.spans),
        front,
        heel,
        sides,
        turned,
        edge,
        overcut: [Overcut::default(); 2],
        orientation: Some(orientation),
    }
}

/// Task of a plunge cut.
fn task_of_plunge_cut(plunge_cut: &PlungeCut) -> Task {
    let PlungeCut { front, heel, turned, edge, overcut, .. } = *plunge_cut;
    let sides = plunge_cut.ends.map(|end| end.side);
    Task { blocks: ends(&plunge_cut.spans), front, heel, sides, turned, edge, overcut, orientation: None }
}

/// The first and the last block of a chain; 0 when it is empty.
fn ends(spans: &[Span]) -> [u32; 2] {
    [spans.first(), spans.last()].map(|span| span.map_or(0, |span| span.block))
}

/// Pose of the axes for a pose of the blade: C is corrected by the yaw.
fn yawed(pose: Pose, job: &Job) -> Pose {
    Pose { c: Rotation(pose.c.0 + job.profile.knife.yaw()), ..pose }
}

/// Start pose of a program when the cloth has already advanced by `moved_on` mm.
pub fn home_over(moved_on: u32, job: &Job) -> Pose {
    let [x, y, c] = job.profile.home;
    Pose::new(x + f64::from(moved_on), y, rad(c))
}

/// Start pose of a program on cloth that has not advanced.
pub fn home(job: &Job) -> Pose {
    home_over(0, job)
}
