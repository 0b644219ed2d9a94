//! Summary of a log or a scenario: statuses, speeds, and the quality of the tracking.

use std::fmt::Write as _;

use serde::Serialize;

use crate::cli::report;
use crate::source::Source;
use crate::track::Tracked;
use crate::track::controller::Status;
use crate::track::measure::Measures;
use crate::units::number::fixed;

/// The figures of a log or a scenario.
#[derive(Debug, Serialize, Default)]
pub(super) struct Figures {
    samples: usize,
    duration_s: f64,
    /// Number of samples with each status.
    statuses: Vec<Counted>,
    /// Maximum speed of the carriage.
    max_speed_mm_s: f64,
    /// Minimum and maximum position of the centre of the cloth, mm; null if unknown.
    centre_mm: Option<[f64; 2]>,
    /// Followers of the cloth in a scenario; empty for a log.
    followers: Vec<Follower>,
}

/// Number of samples with a status.
#[derive(Debug, Serialize)]
struct Counted {
    status: &'static str,
    samples: usize,
}

/// Quality with which a follower tracks the cloth.
#[derive(Debug, Serialize)]
struct Follower {
    name: String,
    #[serde(flatten)]
    measures: Measures,
}

/// Every status, in the order of the summary.
const STATUSES: [Status; 6] =
    [Status::Centred, Status::Waiting, Status::Driving, Status::LostCovered, Status::LostOpen, Status::Width];

impl Figures {
    pub(super) fn of(tracked: &Tracked) -> Self {
        let commands = &tracked.replay.commands;
        let rows = &tracked.replay.rows;
        let count = |status: Status| commands.iter().filter(|command| command.status == status).count();
        let counted = STATUSES.map(|status| Counted { status: status.name(), samples: count(status) });
        let ends = |[least, most]: [f64; 2], [_, at]: &[f64; 2]| [least.min(*at), most.max(*at)];
        let centre = tracked.centre.iter().fold([f64::INFINITY, f64::NEG_INFINITY], ends);
        Self {
            samples: rows.len(),
            duration_s: rows.last().map_or(0.0, |last| last.time - rows[0].time),
            statuses: counted.into_iter().filter(|counted| counted.samples > 0).collect(),
            max_speed_mm_s: commands.iter().map(|command| command.velocity.abs()).fold(0.0, f64::max),
            centre_mm: Some(centre).filter(|_| !tracked.centre.is_empty()),
            followers: tracked
                .followers
                .iter()
                .map(|(follower, measures)| Follower { name: follower.name.clone(), measures: *measures })
                .collect(),
        }
    }
}

/// The keys of the figures, all null.
pub(super) fn nothing() -> serde_json::Value {
    report::nothing(&Figures::default())
}

/// The figures as text.
pub(super) fn text(source: &Source, figures: &Figures, quiet: bool) -> String {
    let mut out = String::new();
    if quiet {
        return out;
    }
    // Writing into a `String` cannot fail.
    let _ = writeln!(out, "{}: {} samples, {} s", source.name(), figures.samples, fixed(figures.duration_s, 2));
    let statuses = figures.statuses.iter().map(|counted| format!("{} {}", counted.samples, counted.status));
    let _ = writeln!(out, "  {:9} {}", "samples", statuses.collect::<Vec<_>>().join(", "));
    let _ = writeln!(out, "  {:9} at most {} mm/s", "carriage", fixed(figures.max_speed_mm_s, 1));
    if let Some([least, most]) = figures.centre_mm {
        let _ = writeln!(out, "  {:9} from {} to {} mm", "centre", fixed(least, 2), fixed(most, 2));
    }
    if !figures.followers.is_empty() {
        out.push_str(&table(&figures.followers));
    }
    out
}

/// The table with one row per follower.
fn table(followers: &[Follower]) -> String {
    let width = followers.iter().map(|follower| follower.name.len()).max().unwrap_or(0);
    let columns = ["settling", "overshoot", "reversals", "residual", "worst", "rms"];
    let mut out = format!("\n  {:width$}", "");
    // Writing into a `String` cannot fail.
    for column in columns {
        let _ = write!(out, " {column:>10}");
    }
    out.push('\n');
    for Follower { name, measures } in followers {
        let jump = measures.overshoot_mm;
        let settling = match (jump, measures.settling_s) {
            (None, _) => "-".to_owned(),
            (Some(_), None) => "never".to_owned(),
            (Some(_), Some(time)) => format!("{} s", fixed(time, 2)),
        };
        let mm = |value: f64| format!("{} mm", fixed(value, 2));
        let cells = [
            settling,
            jump.map_or("-".to_owned(), mm),
            measures.reversals.to_string(),
            mm(measures.residual_mm),
            mm(measures.worst_mm),
            mm(measures.rms_mm),
        ];
        let _ = write!(out, "  {name:width$}");
        for cell in cells {
            let _ = write!(out, " {cell:>10}");
        }
        out.push('\n');
    }
    out
}
