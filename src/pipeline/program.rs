//! Planning and writing. Toolpaths pass in windows through stages, each of which works on its own window on all cores: they are
//! made individually, linked to each other, planned, and written in order.

use std::io::{self, BufWriter, Write};

use rayon::prelude::*;

use super::advance::Advance;
use super::product::Medium;
use super::refusals::Refusals;
use super::report::{Axes, Program, Sides};
use super::rivals::Rivals;
use super::savings::{CLEAR_SHARE, Savings};
use super::sound::assert_sound;
use super::spent::Clock;
use super::swings;
use super::toolpaths::{Toolpaths, Window};
use crate::analysis::cloth::Cloth;
use crate::analysis::declare;
use crate::analysis::swing;
use crate::back::{Choice, Context, Emit, Estimate, Outcome, PageWriter, Parts};
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::ir::arcs::{Interpolation, Unfit};
use crate::ir::check;
use crate::ir::declaration::Declaration;
use crate::ir::motion::{Kind, Task};
use crate::ir::toolpath::{Edge, OrientationMode, Overcut, Side};
use crate::ir::{Arcs, Marker, Motion, Toolpath};
use crate::machine::{Follow, Job};
use crate::plan::{self, Cut, Planner, arcs};
use crate::units::MM_PER_M;

/// Program that is written as toolpaths arrive.
pub(super) struct Sink<'a> {
    form: Form<'a>,
    out: BufWriter<&'a mut dyn Medium>,
}

/// Input from which a program is made.
enum Form<'a> {
    Toolpath(&'static Parts<Toolpath>),
    Motion(&'static Parts<Motion>),
    Arcs(Rivals<'a>),
    Page(&'a mut (dyn PageWriter + 'a)),
}

impl<'a> Sink<'a> {
    /// Program of a target, the fastest of its choices of moves; `None` if the target needs no toolpaths.
    pub(super) fn new(
        emit: &'static Emit,
        context: &Context<'a>,
        choices: &'a [Choice],
        out: &'a mut dyn Medium,
    ) -> Option<Self> {
        let form = match emit {
            Emit::Marker(_) | Emit::Page(_) => return None,
            Emit::Toolpath(parts) | Emit::Picture(parts) => Form::Toolpath(parts),
            Emit::Motion(parts) => Form::Motion(parts),
            Emit::Arcs(target) => Form::Arcs(Rivals::new(target, context, choices)),
        };
        Some(Self { form, out: BufWriter::new(out) })
    }

    /// Program of timed motion written by `parts`.
    pub(super) fn of_motion(parts: &'static Parts<Motion>, out: &'a mut dyn Medium) -> Self {
        Self { form: Form::Motion(parts), out: BufWriter::new(out) }
    }

    /// Page that takes the timed motion and is written after its verification.
    pub(super) fn of_page(page: &'a mut (dyn PageWriter + 'a), out: &'a mut dyn Medium) -> Self {
        Self { form: Form::Page(page), out: BufWriter::new(out) }
    }

    /// True if it needs timed motion.
    fn needs_motion(&self) -> bool {
        matches!(self.form, Form::Motion(_) | Form::Page(_))
    }

    /// Features of a marker or a profile that its target cannot express.
    fn refusals(&self, context: &Context) -> Vec<Diagnostic> {
        match self.form {
            Form::Toolpath(parts) => (parts.refusals)(context),
            Form::Motion(parts) => (parts.refusals)(context),
            Form::Arcs(ref rivals) => (rivals.target.refusals)(context),
            Form::Page(_) => Vec::new(),
        }
    }

    /// Paths that its controller accepts, for each choice of moves.
    fn interpolations(&self) -> Vec<Interpolation> {
        match &self.form {
            Form::Arcs(rivals) => rivals.interpolations().collect(),
            Form::Toolpath(_) | Form::Motion(_) | Form::Page(_) => Vec::new(),
        }
    }
}

/// Facts about written programs.
#[derive(Default)]
pub(super) struct Written {
    /// Properties of the planned motion; default if none was planned.
    pub(super) program: Program,
    /// Estimate for the program of a controller that plans for itself.
    pub(super) estimate: Option<Estimate>,
    /// Deviations of the program from the drawing.
    pub(super) declared: Vec<Declaration>,
}

/// Toolpaths and the results computed for them in parallel.
struct Made {
    toolpaths: Vec<Toolpath>,
    /// Planned cuts of each toolpath; empty if no motion is wanted.
    cuts: Vec<Result<Vec<Cut>, Vec<Diagnostic>>>,
    /// Arcs of each toolpath, for each target of arcs and each choice of moves.
    arcs: Vec<Vec<Result<Arcs, Vec<Unfit>>>>,
    /// Deviations from the drawing.
    declared: Vec<Declaration>,
    findings: Vec<Diagnostics>,
}

/// Results to compute for toolpaths in parallel.
struct Wanted<'a> {
    job: &'a Job,
    marker: &'a Marker,
    /// Cloth with the parts; `None` if nothing is cut.
    cloth: Option<&'a Cloth<'a>>,
    motion: bool,
    advance: &'a Advance,
    /// Interpolation of each target of arcs and each choice of moves.
    interpolations: Vec<Interpolation>,
}

impl Wanted<'_> {
    fn of(&self, Window { toolpaths, cuts: cuts_of, mut findings }: Window) -> Made {
        let count = cuts_of.iter().flatten().count();
        let planned = if self.motion { &toolpaths[..] } else { &[] };
        let cuts: Vec<_> = planned.par_iter().map(|toolpath| plan::solve(toolpath, self.job)).collect();
        let arcs = |interpolation: &Interpolation| {
            let solve = |toolpath: &Toolpath| {
                let arcs = arcs::solve(toolpath, interpolation, self.job)?;
                assert_sound("arcs", || check::arcs(&arcs, toolpath));
                Ok(arcs)
            };
            toolpaths.par_iter().map(solve).collect()
        };
        let arcs = self.interpolations.iter().map(arcs).collect();
        let declared = (0..toolpaths.len()).into_par_iter().zip(cuts_of).zip(&mut findings);
        let declared = declared.filter_map(|((place, cut), found)| Some((place, cut?, self.cloth?, found)));
        let declared = declared.flat_map_iter(|(place, cut, cloth, found)| {
            let (toolpath, knife) = (&toolpaths[place], &self.job.profile.knife);
            let planned = cuts.get(place).and_then(|cuts| cuts.as_ref().ok());
            let planned = planned.filter(|_| self.interpolations.is_empty());
            let moved = |run: usize| swing::moved(toolpath.runs().nth(run)?, knife, planned?[run].poses());
            let drawn = self.marker.list.points(self.marker.cuts[cut as usize].range);
            let declared = declare::declarations(toolpath, (cut, &drawn), &moved, knife, cloth);
            swings::warn(toolpath, &declared, knife, found);
            declared
        });
        let declared = declared.collect();
        self.advance.plan(count);
        Made { toolpaths, cuts, arcs, declared, findings }
    }
}

/// Extra demands on a program.
#[derive(Clone, Copy)]
pub(super) struct Plan<'a> {
    /// True if the motion is to be planned even if no sink needs it.
    pub(super) motion: bool,
    /// Progress of the compile.
    pub(super) advance: &'a Advance,
}

/// Writes toolpaths to every sink, except the tails of sinks that wait for a verdict. Failures of planning or writing are
/// diagnostics; the written output is worthless then.
pub(super) fn write(
    mut toolpaths: Toolpaths,
    sinks: &mut [Sink],
    context: &Context,
    Plan { motion, advance }: Plan,
    diagnostics: &mut Diagnostics,
) -> io::Result<Written> {
    let job = context.job;
    let mut refused = Refusals::default();
    sinks.iter().flat_map(|sink| sink.refusals(context)).for_each(|refusal| refused.add(refusal));
    let interpolations = sinks.iter().flat_map(Sink::interpolations).collect();
    let motion = motion || sinks.iter().any(Sink::needs_motion);
    for Sink { form, out } in &mut *sinks {
        match form {
            Form::Toolpath(parts) => (parts.head)(context, out)?,
            Form::Motion(parts) => (parts.head)(context, out)?,
            Form::Arcs(rivals) => rivals.head(out)?,
            Form::Page(_) => {}
        }
    }
    let (planner, tally) = (Planner::new(job).over(context.marker.moved_on), Tally::default());
    let mut savings = None;
    let mut writer = Writer { sinks, context, planner, tally, declared: Vec::new(), refused };
    let (mut drawing, mut linking) = toolpaths.stages();
    let wanted = Wanted {
        job,
        marker: context.marker,
        cloth: linking.cloth().filter(|_| job.mode.cuts()),
        motion,
        advance,
        interpolations,
    };
    // Each stage has a window of its own, so that no core waits for the slowest.
    let (mut drawn, mut linked, mut made) = (drawing.next(), None, None);
    rayon::in_place_scope(|beside| {
        beside.spawn(|_| savings = wanted.motion.then(|| Savings::of(context.marker, job)));
        while drawn.is_some() || linked.is_some() || made.is_some() {
            let before = (drawn.take(), linked.take(), made.take());
            rayon::in_place_scope(|scope| {
                scope.spawn(|_| made = before.1.map(|window| wanted.of(window)));
                scope.spawn(|_| linked = before.0.map(|window| linking.link(window)));
                scope.spawn(|_| drawn = drawing.next());
                before.2.map_or(Ok(()), |made| writer.take(made, diagnostics))
            })?;
        }
        Ok::<(), io::Error>(())
    })?;
    writer.finish(savings, diagnostics)
}

/// Writer of windows in order.
struct Writer<'w, 's, 'c> {
    sinks: &'w mut [Sink<'s>],
    context: &'w Context<'c>,
    planner: Planner<'c>,
    tally: Tally,
    /// Deviations of the program from the drawing.
    declared: Vec<Declaration>,
    /// Features that a target cannot express.
    refused: Refusals,
}

impl Writer<'_, '_, '_> {
    fn take(&mut self, made: Made, diagnostics: &mut Diagnostics) -> io::Result<()> {
        let Made { toolpaths, cuts, arcs, declared, findings } = made;
        self.declared.extend(declared);
        for found in findings {
            diagnostics.extend(found);
        }
        for (toolpath, cuts) in toolpaths.iter().zip(cuts) {
            match cuts {
                Err(refused) => refused.into_iter().for_each(|finding| diagnostics.push(finding)),
                Ok(cuts) => {
                    self.tally.take(&cuts);
                    let motion = self.planner.join(toolpath, cuts);
                    assert_sound("plan", || check::motion(&motion));
                    self.motion(&motion)?;
                }
            }
        }
        let mut arcs = arcs.into_iter();
        for Sink { form, out } in &mut *self.sinks {
            match form {
                Form::Motion(_) | Form::Page(_) => {}
                Form::Toolpath(parts) => {
                    for toolpath in &toolpaths {
                        (parts.body)(toolpath, self.context, out)?;
                    }
                }
                Form::Arcs(rivals) => rivals.take(&toolpaths, &mut arcs, out)?,
            }
        }
        Ok(())
    }

    fn motion(&mut self, motion: &Motion) -> io::Result<()> {
        self.tally.add(motion);
        for Sink { form, out } in &mut *self.sinks {
            match form {
                Form::Motion(parts) => (parts.body)(motion, self.context, out)?,
                Form::Page(page) => page.take(motion),
                Form::Toolpath(_) | Form::Arcs(..) => {}
            }
        }
        Ok(())
    }

    /// Ends the programs. `savings` is known if they were planned.
    fn finish(mut self, savings: Option<Savings>, diagnostics: &mut Diagnostics) -> io::Result<Written> {
        for Sink { form, .. } in &mut *self.sinks {
            if let Form::Arcs(rivals) = form {
                rivals.refuse(&mut self.refused);
            }
        }
        std::mem::take(&mut self.refused).into_diagnostics().for_each(|refusal| diagnostics.push(refusal));
        let mut written = Written { declared: std::mem::take(&mut self.declared), ..Written::default() };
        if let Some(savings) = savings {
            let end = self.planner.finish();
            self.motion(&end)?;
            if let Err(diagnostic) = self.planner.certify() {
                diagnostics.push(diagnostic);
            }
            written.program = self.tally.program(&self.planner, self.context.job, savings);
        }
        for Sink { form, out } in &mut *self.sinks {
            match form {
                Form::Toolpath(_) | Form::Page(_) => {}
                Form::Motion(parts) => (parts.tail)(self.context, Outcome::default(), out)?,
                Form::Arcs(rivals) => written.estimate = Some(rivals.tail(out)?),
            }
            out.flush()?;
        }
        Ok(written)
    }
}

/// Totals of a program.
#[derive(Default)]
struct Tally {
    travel: f64,
    plunges: usize,
    plunge_cuts: usize,
    /// Number of cuts along the tangent.
    tangents: usize,
    lifts: usize,
    ticks: u64,
    /// Ticks by which moves could begin before the knife is all the way up, and the ticks of the previous lift.
    clear: f64,
    lifted: u32,
    sagitta: f64,
    sides: Sides,
    /// Use of the time, in total and by piece.
    clock: Clock,
    by_piece: Vec<([u32; 2], Clock)>,
}

impl Sides {
    fn add(&mut self, task: &Task) {
        let ends = |side: Side| task.sides.iter().filter(|&&other| other == side).count();
        self.inside += ends(Side::Part);
        self.shortened += ends(Side::Gap);
        self.turned += usize::from(task.turned);
        self.backwards += usize::from(task.edge == Edge::Back);
        self.rejoined += usize::from(task.sides[0] == Side::Contour);
        for (count, farthest, of) in [
            (&mut self.harmful, &mut self.overcut_mm, Overcut::deepest as fn(Overcut) -> f64),
            (&mut self.trespassing, &mut self.neighbour_overcut_mm, |overcut: Overcut| overcut.other),
        ] {
            let worst = task.overcut.into_iter().map(of).fold(0.0, f64::max);
            *count += usize::from(worst > 0.0);
            *farthest = farthest.max(worst);
        }
    }
}

impl Tally {
    /// Clock of a piece, by its number and its index in the marker; work outside of pieces has the number 0 and counts for the
    /// last piece.
    fn clock_of(&mut self, piece: [u32; 2]) -> &mut Clock {
        if self.by_piece.last().is_none_or(|(last, _)| *last != piece && piece[0] > 0) {
            self.by_piece.push((piece, Clock::default()));
        }
        let last = self.by_piece.len() - 1;
        &mut self.by_piece[last].1
    }

    /// Adds the facts known about cuts before they are joined to a motion.
    fn take(&mut self, cuts: &[Cut]) {
        self.sagitta = cuts.iter().fold(self.sagitta, |most, cut| most.max(cut.sagitta));
    }

    fn add(&mut self, motion: &Motion) {
        self.ticks += motion.ticks();
        self.clock.add(motion);
        self.clock_of([motion.piece, motion.part]).add(motion);
        motion.tasks.iter().for_each(|task| self.sides.add(task));
        self.tangents += motion.tasks.iter().filter(|task| task.orientation == Some(OrientationMode::Tangent)).count();
        let mut before = None;
        for phase in &motion.phases {
            match phase.kind {
                Kind::Travel | Kind::Turn => self.travel += phase.length,
                Kind::Plunge => self.plunges += 1,
                Kind::Lift => {
                    self.lifts += 1;
                    self.plunge_cuts += usize::from(before == Some(Kind::Plunge));
                }
                Kind::Cut | Kind::Rest | Kind::Wait | Kind::Drill(_) | Kind::Event(_) => {}
            }
            if matches!(phase.kind, Kind::Travel | Kind::Turn) {
                self.clear += f64::from(phase.ticks).min((1.0 - CLEAR_SHARE) * f64::from(self.lifted));
            }
            self.lifted = if phase.kind == Kind::Lift { phase.ticks } else { 0 };
            before = Some(phase.kind);
        }
    }

    fn program(&self, planner: &Planner, job: &Job, savings: Savings) -> Program {
        let period = job.profile.time.period();
        let clear_s = job.profile.knife.clear_ms.is_none().then_some(self.clear * period);
        Program {
            travel_m: Some(self.travel / MM_PER_M),
            runs: Some(self.plunges),
            notch_style: Some(job.profile.notch.style),
            follow: Some(job.profile.knife.follow),
            tangent_runs: Some(match job.profile.knife.follow {
                Follow::Tangent => 0,
                // A point cannot be a chord.
                Follow::Chord if job.profile.knife.width_mm == 0.0 => 0,
                Follow::Chord => self.tangents,
            }),
            plunge_cuts: Some(self.plunge_cuts),
            lifts: Some(self.lifts),
            // The last setpoint is at the last tick, and rows count from tick 0.
            time_s: Some((self.ticks - 1) as f64 * period),
            sides: Some(self.sides),
            spent: Some(self.clock.spent(period)),
            savings: Some(Savings { clear_s, ..savings }),
            by_piece: self.by_piece.iter().map(|(piece, clock)| (*piece, clock.spent(period))).collect(),
            bulge_mm: Some(self.sagitta),
            axes: Some(Axes::new(&planner.peaks())),
        }
    }
}
