//! Candidate programs of one target; the controller is given the fastest.
//!
//! Each one is planned once, from the same toolpaths, and its time is that of the planner of the controller. If there is only
//! one, it is written to its destination at once; several are written aside, and the fastest is copied.

use std::cmp::Ordering;
use std::io::{self, Seek as _};

use tempfile::SpooledTempFile;

use super::refusals::Refusals;
use crate::back::{ArcTarget, ArcWriter, Choice, Chosen, Context, Estimate, Output};
use crate::ir::arcs::{Interpolation, Unfit};
use crate::ir::{Arcs, Toolpath};
use crate::machine::Job;

/// Size of a program up to which it is kept in memory, bytes; more goes to a temporary file.
const ASIDE_BYTES: usize = 16 << 20;
/// Relative difference between two models of one planner; times that differ by less count as equal.
pub const TIE_SHARE: f64 = 2e-4;

/// Arcs of each toolpath, or the runs that no arcs fit.
type Solved = Vec<Result<Arcs, Vec<Unfit>>>;

/// Programs of a target.
pub(super) struct Rivals<'a> {
    pub(super) target: &'static ArcTarget,
    rivals: Vec<Rival<'a>>,
}

/// Program with one choice of moves.
struct Rival<'a> {
    name: &'a str,
    job: &'a Job,
    writer: Box<dyn ArcWriter + 'a>,
    /// Its bytes; `None` if they go to the destination.
    aside: Option<SpooledTempFile>,
    /// Features that it cannot express.
    refused: Refusals,
}

impl Rival<'_> {
    /// Its writer, and the place of its bytes.
    fn parts<'b>(&'b mut self, out: &'b mut dyn Output) -> (&'b mut dyn ArcWriter, &'b mut dyn Output) {
        match &mut self.aside {
            Some(aside) => (&mut *self.writer, aside),
            None => (&mut *self.writer, out),
        }
    }
}

impl<'a> Rivals<'a> {
    /// Programs with each choice of moves.
    pub(super) fn new(target: &'static ArcTarget, context: &Context<'a>, choices: &'a [Choice]) -> Self {
        let is_one = choices.len() == 1;
        let rival = |choice: &'a Choice| Rival {
            name: &choice.name,
            job: &choice.job,
            writer: (target.begin)(&Context { job: &choice.job, ..*context }),
            aside: (!is_one).then(|| SpooledTempFile::new(ASIDE_BYTES)),
            refused: Refusals::default(),
        };
        Self { target, rivals: choices.iter().map(rival).collect() }
    }

    /// Paths that the controller accepts, for each program.
    pub(super) fn interpolations(&self) -> impl Iterator<Item = Interpolation> {
        self.rivals.iter().map(|rival| (self.target.interpolation)(rival.job))
    }

    /// Writes the heads.
    pub(super) fn head(&mut self, out: &mut dyn Output) -> io::Result<()> {
        for rival in &mut self.rivals {
            let (writer, out) = rival.parts(out);
            writer.head(out)?;
        }
        Ok(())
    }

    /// Writes toolpaths, with the arcs for each program.
    pub(super) fn take(
        &mut self,
        toolpaths: &[Toolpath],
        arcs: &mut impl Iterator<Item = Solved>,
        out: &mut dyn Output,
    ) -> io::Result<()> {
        for rival in &mut self.rivals {
            for (toolpath, arcs) in toolpaths.iter().zip(arcs.next().expect("every program has its arcs")) {
                match arcs {
                    Ok(arcs) => {
                        let (writer, out) = rival.parts(out);
                        writer.body(toolpath, &arcs, out)?;
                    }
                    Err(unfit) => {
                        for run in &unfit {
                            rival.refused.add((self.target.unfit)(run));
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// Adds the refusals of the preferred program if all programs are refused.
    pub(super) fn refuse(&mut self, refused: &mut Refusals) {
        if self.rivals.iter().all(|rival| !rival.refused.is_empty())
            && let Some(preferred) = self.rivals.first_mut()
        {
            refused.append(&mut preferred.refused);
        }
    }

    /// Ends the programs and copies the best one to the destination. Programs without a flaw come first, then those with coarse
    /// chords, then refused ones; within each group the fastest, and the first of equally fast ones.
    pub(super) fn tail(&mut self, out: &mut dyn Output) -> io::Result<Estimate> {
        let mut estimates = Vec::with_capacity(self.rivals.len());
        for rival in &mut self.rivals {
            let (writer, out) = rival.parts(out);
            estimates.push(writer.tail(out)?);
        }
        let flaw = |i: usize| (!self.rivals[i].refused.is_empty(), estimates[i].coarse > 0);
        let time = |i: usize| estimates[i].spent.time;
        let is_better = |one: usize, other: usize| match flaw(one).cmp(&flaw(other)) {
            Ordering::Less => true,
            Ordering::Equal => time(one) < time(other) * (1.0 - TIE_SHARE),
            Ordering::Greater => false,
        };
        let best = (1..estimates.len()).fold(0, |best, next| if is_better(next, best) { next } else { best });
        let others = (0..estimates.len()).filter(|&i| i != best);
        let other = |i: usize| (self.rivals[i].name.to_owned(), (flaw(i) == (false, false)).then(|| time(i)));
        let mut others: Vec<(String, Option<f64>)> = others.map(other).collect();
        others.sort_by(|a, b| a.1.unwrap_or(f64::INFINITY).total_cmp(&b.1.unwrap_or(f64::INFINITY)));
        let chosen = (!others.is_empty()).then(|| Chosen { name: self.rivals[best].name.to_owned(), others });
        if let Some(aside) = &mut self.rivals[best].aside {
            aside.rewind()?;
            io::copy(aside, out)?;
        }
        Ok(Estimate { chosen, ..estimates.swap_remove(best) })
    }
}
