//! Summary of a sewn pattern: stitches, speeds, times, the queue, the verdict.

use std::fmt::Write as _;

use serde::Serialize;

use crate::cli::options::counted;
use crate::cli::report::WorstOf;
use crate::ir::verdict::Verdict;
use crate::machine::Sheet;
use crate::sew::{self, Estimate, Fifo, Limit, Made, Target};
use crate::source::Source;
use crate::units::number::{exact, fixed};

/// The figures of a pattern.
#[derive(Debug, Default, Serialize)]
pub(super) struct Figures {
    format: &'static str,
    /// Word for the records of the format.
    #[serde(skip)]
    record_word: &'static str,
    /// Placement in the field; `None` if it is that of the file.
    #[serde(skip_serializing_if = "Option::is_none")]
    sheet: Option<Sheet>,
    estimate: Estimate,
    runs: Vec<Run>,
    queue: Fifo,
    verified: Vec<Verified>,
}

/// A run of stitches.
#[derive(Debug, Serialize)]
struct Run {
    stitches: usize,
    rpm: f64,
    /// Least speed after the soft start; `None` if the spindle keeps its speed.
    #[serde(skip_serializing_if = "Option::is_none")]
    slowest_rpm: Option<f64>,
    /// Cause of the limit: "machine", "user" or "stitch".
    limit: &'static str,
    /// Record of the limiting stitch; null if no stitch limits the run.
    record: Option<u32>,
    /// Length of that stitch.
    pitch_mm: Option<f64>,
    cost_s: f64,
}

/// Verdict on a program.
#[derive(Debug, Serialize)]
struct Verified {
    target: &'static str,
    /// The target whose bytes were judged. It differs from `target` if that is a picture.
    judged: &'static str,
    rules: Vec<WorstOf>,
}

impl Figures {
    /// The figures of a program that was written for some targets. Some of these were judged.
    pub(super) fn of(
        Made { program, job, .. }: Made,
        queue: Fifo,
        targets: &[&'static Target],
        verdicts: &[(&'static Target, Verdict)],
    ) -> Self {
        let stitches = &program.stitches;
        let run = |run: &sew::Run| {
            let (limit, step) = match run.limit {
                Limit::Machine => ("machine", None),
                Limit::User(i) => ("user", Some(i)),
                Limit::Stitch(i) => ("stitch", Some(i)),
            };
            let pitch = |i: usize| {
                let from = if i == 0 { [0.0; 2] } else { stitches.steps[i - 1].to.into() };
                let to: [f64; 2] = stitches.steps[i].to.into();
                (to[0] - from[0]).hypot(to[1] - from[1])
            };
            Run {
                stitches: run.steps.len(),
                rpm: run.rpm,
                slowest_rpm: (run.slowest < run.rpm).then_some(run.slowest),
                limit,
                record: step.map(|i| stitches.steps[i].record),
                pitch_mm: step.map(pitch),
                cost_s: run.cost,
            }
        };
        let of = |target: &&'static Target| {
            let own = verdicts.iter().find(|(judged, _)| judged.name == target.name);
            let (judged, verdict) = own.or_else(|| verdicts.first())?;
            let rules = verdict.findings.iter().map(WorstOf::from).collect();
            Some(Verified { target: target.name, judged: judged.name, rules })
        };
        Self {
            format: program.format,
            record_word: program.record_word,
            sheet: Some(&job.profile.sheet).filter(|sheet| !sheet.is_plain()).cloned(),
            estimate: sew::estimate(program, job),
            runs: program.runs.iter().map(run).collect(),
            queue,
            verified: targets.iter().filter_map(of).collect(),
        }
    }
}

/// The speeds as text, with the stitch that limits the slowest run.
fn speed(figures: &Figures) -> String {
    let [least, most] = figures.estimate.rpm;
    let speed = if least == most {
        format!("{} stitches/min", exact(least))
    } else {
        format!("{} to {} stitches/min", exact(least), exact(most))
    };
    if figures.runs.iter().any(|run| run.slowest_rpm.is_some()) {
        return format!("{speed}, eased from stitch to stitch");
    }
    let slowest = figures.runs.iter().min_by(|a, b| a.rpm.total_cmp(&b.rpm));
    let told = slowest.and_then(|run| Some((run.limit, run.record?, run.pitch_mm?)));
    let why = told.map_or(String::new(), |(limit, record, pitch)| {
        let by = if limit == "user" { "your limit for a stitch" } else { "a stitch" };
        format!("; the slowest by {by} of {} mm ({} {record})", fixed(pitch, 2), figures.record_word)
    });
    speed + &why
}

/// The figures as text.
pub(super) fn text(source: &Source, figures: &Figures, quiet: bool) -> String {
    let mut out = String::new();
    if quiet {
        return out;
    }
    let sum = &figures.estimate;
    let mut line = |label: &str, text: String| {
        // Writing into a `String` cannot fail.
        let _ = writeln!(out, "  {label:10} {text}");
    };
    if let Some(sheet) = &figures.sheet {
        line("sheet", sheet.to_string());
    }
    line("stitches", format!("{} in {}, {} m", sum.stitches, counted(sum.runs, "run"), fixed(sum.thread_m, 2)));
    line("speed", speed(figures));
    line(
        "time",
        format!(
            "{} s: {} s sewing, {} s starting, {} s in {}, {} s in {}",
            fixed(sum.time_s, 1),
            fixed(sum.sewing_s, 1),
            fixed(sum.starting_s, 1),
            fixed(sum.jumping_s, 1),
            counted(sum.jumps, "jump"),
            fixed(sum.trimming_s, 1),
            counted(sum.trims, "trim"),
        ),
    );
    let queue = &figures.queue;
    let fares = match queue.underruns {
        0 => format!("never fewer than {} in it", queue.lowest),
        n => format!("runs dry {n} times"),
    };
    line("queue", format!("{} deep, {} entries/s: {fares}", queue.depth, exact(queue.producer_hz)));
    match &figures.verified[..] {
        [] => line("verified", "no (--no-verify)".to_owned()),
        verified => {
            for program in verified {
                let rules = counted(program.rules.len(), "rule");
                let text = if program.judged == program.target {
                    format!("{}: {rules} hold", program.target)
                } else {
                    format!("{}, a picture, is not read back: {rules} hold of {}", program.target, program.judged)
                };
                line("verified", text);
            }
        }
    }
    format!("{}: {}\n{out}", source.name(), figures.format)
}
