//! What is said of a marker that is cut while it moves: heads, rows, travel, times, the verdict.

use std::fmt::Write as _;

use serde::Serialize;

use crate::cli::options::counted;
use crate::cli::report::{self, WorstOf};
use crate::flow::verify::Verdict;
use crate::flow::{self, Program};
use crate::source::Source;
use crate::units::number::fixed;

/// The figures of a plan.
#[derive(Debug, Serialize)]
pub(super) struct Figures {
    speed_mm_s: f64,
    #[serde(flatten)]
    plan: flow::Figures,
    verified: Vec<Verified>,
}

/// What the programs of a target are worth.
#[derive(Debug, Serialize)]
struct Verified {
    target: &'static str,
    rules: Vec<WorstOf>,
}

impl Figures {
    pub(super) fn of(program: &Program, verdicts: Vec<(&'static str, Verdict)>) -> Self {
        let rule = |seen: &flow::verify::Seen| WorstOf::from(&seen.finding);
        let verified = |(target, verdict): (&'static str, Verdict)| Verified {
            target,
            rules: verdict.seen.iter().map(rule).collect(),
        };
        Self {
            speed_mm_s: program.speed,
            plan: program.figures.clone(),
            verified: verdicts.into_iter().map(verified).collect(),
        }
    }
}

/// The keys of the figures, all null.
pub(super) fn nothing() -> serde_json::Value {
    report::nothing(&Figures { speed_mm_s: 0.0, plan: flow::Figures::default(), verified: Vec::new() })
}

/// Parts in percent.
const PERCENT: f64 = 100.0;

/// The figures for people.
pub(super) fn text(source: &Source, figures: &Figures, program: &Program, quiet: bool) -> String {
    let mut out = String::new();
    if quiet {
        return out;
    }
    let plan = &figures.plan;
    let mut line = |label: &str, text: String| {
        // Writing into a `String` cannot fail.
        let _ = writeln!(out, "  {label:10} {text}");
    };
    let bound = fixed(plan.speed_bound_mm_s, 1);
    line("conveyor", format!("{} mm/s; without accelerations {bound} at the most", fixed(figures.speed_mm_s, 1)));
    line("cuts", format!("{} in {}", fixed(plan.cut_m, 2) + " m", counted(plan.chains, "chain")));
    let exact = if plan.rows_exact { "" } else { " or fewer" };
    line("heads", format!("{} (bound {}) in {}{exact}", plan.heads, plan.heads_bound, counted(plan.rows, "row")));
    let travel = fixed(plan.travel_mm, 1);
    line("travel", format!("{travel} mm along the feed; without accelerations {}", fixed(plan.travel_bound_mm, 1)));
    line("time", format!("{} s, heads at work {} %", fixed(plan.time_s, 1), fixed(PERCENT * plan.busy, 0)));
    match &figures.verified[..] {
        [] => line("verified", "no".to_owned()),
        verified => {
            for target in verified {
                line("verified", format!("{}: {} hold", target.target, counted(target.rules.len(), "rule")));
            }
        }
    }
    format!("{}: {}\n{out}", source.name(), counted(program.heads.len(), "program"))
}
