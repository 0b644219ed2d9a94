//! One file from its bytes to programs in their places: the work of `cutc sew` on each file.

use super::arguments::Arguments;
use super::made::{Writing, Written};
use super::summary;
use crate::cli::destination::Place;
use crate::cli::draft::Whole;
use crate::cli::{files, made, report};
use crate::diagnostic::{Diagnostic, Diagnostics, code, render_with};
use crate::machine::Job;
use crate::sew::{self, Asked, Estimate, Fifo, Made, Program, Target};
use crate::source::Source;
use crate::units::number::fixed;

/// Common data of all files.
pub(super) struct Sewing<'a> {
    pub(super) arguments: &'a Arguments,
    pub(super) targets: &'a [&'static Target],
    pub(super) job: &'a Job,
}

/// Record of a sewn file in a manifest: its figures, `None` when it was refused, and its programs.
pub(super) type Record<'r> = dyn Fn(Option<&Estimate>, &Diagnostics, Vec<Whole>) -> anyhow::Result<()> + 'r;

/// Result for a file.
pub(super) struct Sewn {
    /// Diagnostics.
    pub(super) diagnostics: Diagnostics,
    /// Written programs; `None` when they were refused.
    pub(super) made: Option<Programs>,
    /// Text for standard error.
    pub(super) said: String,
}

/// Programs of a file.
pub(super) struct Programs {
    pub(super) estimate: Estimate,
    pub(super) figures: summary::Figures,
    pub(super) written: Written,
}

impl Sewing<'_> {
    /// Sews a file to programs in their places. A refused program leaves nothing; older programs of these names are moved
    /// aside.
    pub(super) fn sew(&self, source: &Source, place: &Place, record: Option<&Record>) -> anyhow::Result<Sewn> {
        let Self { arguments, targets, job } = *self;
        let asked = arguments.asked();
        let mut diagnostics = Diagnostics::default();
        let mut made = None;
        if let Some((program, fifo)) = planned(source, &asked, job, &mut diagnostics) {
            let of = Made { program: &program, source, job };
            let options = &typed(&asked);
            let estimate = sew::estimate(&program, job);
            let told = record.map(|record| {
                let estimate = &estimate;
                move |out: &Diagnostics, whole: Vec<Whole>| record(Some(estimate), out, whole)
            });
            let record = told.as_ref().map(|told| told as &made::Record);
            let verify = !arguments.no_verify;
            let written = Writing { made: of, targets, options, verify, record }.write(place, &mut diagnostics)?;
            let figures = summary::Figures::of(of, fifo, targets, &written.verdicts);
            made = Some(Programs { estimate, figures, written });
        }
        let mut said = render_with(&diagnostics, source, arguments.messages.detail(arguments.format));
        if diagnostics.has_errors() {
            made = None;
            record.map_or(Ok(()), |record| record(None, &diagnostics, Vec::new()))?;
            said.push_str(&report::nothing_written(source, &diagnostics));
            said.extend(place.files().iter().map(|path| files::move_aside(path)));
        }
        Ok(Sewn { diagnostics, made, said })
    }
}

impl Sewn {
    /// The figures as JSON, all null for a refused program.
    pub(super) fn json(&self, source: &Source, job: &Job) -> String {
        let blank = || report::nothing(&summary::Figures::default());
        let figures =
            self.made.as_ref().map(|made| serde_json::to_value(&made.figures).expect("figures are plain data"));
        report::json_by_profile(figures.unwrap_or_else(blank), &self.diagnostics, source, job)
    }
}

/// The program, and the course of its queue; `None` when nothing can be sewn.
fn planned(source: &Source, asked: &Asked, job: &Job, out: &mut Diagnostics) -> Option<(Program, Fifo)> {
    let program = sew::plan(source, asked, job, out)?;
    let fifo = sew::simulate(&program, job);
    if fifo.underruns > 0 {
        let message = format!(
            "a queue of {} entries, filled at {} a second, runs dry {} times from entry {} on; the machine waits {} s",
            fifo.depth,
            fifo.producer_hz,
            fifo.underruns,
            fifo.first_underrun,
            fixed(fifo.waited_s, 1)
        );
        let needed = fixed(fifo.needed_hz.ceil(), 0);
        let hint = format!("a host of {needed} entries a second keeps up (`sewing.producer_hz`)");
        out.push(Diagnostic::new(&code::SEW_UNDERRUN, message).hint(hint));
    }
    Some((program, fifo))
}

/// Options of a file that is sewn, as typed.
pub(in crate::cli) fn typed(asked: &Asked) -> String {
    let from = asked.from.as_ref().map(|from| format!("--from {from}"));
    let line = asked.line.as_ref().map(|line| format!("--line {line}"));
    let inset = (asked.inset != 0.0).then(|| format!("--inset {}", asked.inset));
    [from, line, inset].into_iter().flatten().collect::<Vec<_>>().join(" ")
}
