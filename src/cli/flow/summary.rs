//! Summary of a marker that is cut while it moves: heads, rows, travel, times, the verdict.

use std::fmt::Write as _;

use serde::Serialize;

use super::made::Written;
use crate::cli::options::counted;
use crate::cli::report::{self, WorstOf};
use crate::flow::{self, Program};
use crate::ir::verdict::Verdict;
use crate::source::Source;
use crate::units::number::fixed;

/// The figures of a plan.
#[derive(Debug, Serialize)]
pub(super) struct Figures {
    speed_mm_s: f64,
    #[serde(flatten)]
    plan: flow::Figures,
    verified: Vec<Verified>,
    /// Number of programs written.
    #[serde(skip)]
    programs: usize,
}

/// Verdict on the programs of a target.
#[derive(Debug, Serialize)]
struct Verified {
    target: &'static str,
    rules: Vec<WorstOf>,
}

impl Figures {
    pub(super) fn of(program: &Program, Written { verdicts, programs, .. }: Written) -> Self {
        let verified = |(target, verdict): (&'static str, Verdict)| Verified {
            target,
            rules: verdict.findings.iter().map(WorstOf::from).collect(),
        };
        Self {
            speed_mm_s: program.speed,
            plan: program.figures.clone(),
            verified: verdicts.into_iter().map(verified).collect(),
            programs,
        }
    }
}

/// The keys of the figures, all null.
pub(super) fn nothing() -> serde_json::Value {
    report::nothing(&Figures { speed_mm_s: 0.0, plan: flow::Figures::default(), verified: Vec::new(), programs: 0 })
}

/// Percent per unit.
const PERCENT: f64 = 100.0;

/// The figures as text.
pub(super) fn text(source: &Source, figures: &Figures, quiet: bool) -> String {
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
    let speed = fixed(figures.speed_mm_s, 1);
    line("conveyor", format!("{speed} mm/s; along these ways no more than {bound}, even without accelerations"));
    line("cuts", format!("{} in {}", fixed(plan.cut_m, 2) + " m", counted(plan.chains, "chain")));
    let exact = if plan.rows_exact { "" } else { " or fewer" };
    let [heads, least, abreast] = [plan.heads, plan.heads_bound, plan.chains_abreast];
    let rows = counted(plan.rows, "row");
    line(
        "heads",
        format!("{heads} in {rows}{exact}; no fewer than {least} can do it, up to {abreast} chains are abreast"),
    );
    let [travel, bound] = [plan.travel_mm, plan.travel_bound_mm].map(|travel| fixed(travel, 1));
    line(
        "travel",
        format!("{travel} mm along the feed; along these ways no less than {bound}, even without accelerations"),
    );
    line("time", format!("{} s, heads at work {} %", fixed(plan.time_s, 1), fixed(PERCENT * plan.busy, 0)));
    match &figures.verified[..] {
        [] if figures.programs == 0 => line("verified", "nothing: no program was asked for".to_owned()),
        [] => line("verified", "no".to_owned()),
        verified => {
            for target in verified {
                line("verified", format!("{}: {} hold", target.target, counted(target.rules.len(), "rule")));
            }
        }
    }
    format!("{}: {}\n{out}", source.name(), counted(figures.programs, "program"))
}
