//! Content of a page, and the parts of it that both the report and the script need.

use super::piece::Piece;
use super::record::Record;
use crate::back::target::{Context, Outcome};
use crate::diagnostic::{Diagnostic, Severity};
use crate::geom::Point;
use crate::ir::Finding;
use crate::ir::declaration::{Declaration, Kind};
use crate::machine::file_name;
use crate::units::number;

/// Duration below which milliseconds are shown, s.
const SHORT: f64 = 0.1;
/// Maximum number of deviations listed on a page, of which the greatest are listed, and of marked places.
pub(super) const MOST_MARKS: usize = 400;

/// Content of a page.
#[derive(Clone, Copy)]
pub(super) struct About<'a> {
    pub(super) context: &'a Context<'a>,
    pub(super) record: &'a Record,
    pub(super) outcome: Outcome<'a>,
    /// Pieces in cut order.
    pub(super) pieces: &'a [Piece],
}

/// Status of a program, as shown on the page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Worth {
    Verified,
    NotJudged,
    Refused,
}

impl About<'_> {
    /// Title of the page.
    pub(super) fn title(&self) -> String {
        format!("{}: {}", self.file(), self.worth().words())
    }

    /// Name of the file without its directory.
    pub(super) fn file(&self) -> String {
        file_name(self.context.source)
    }

    pub(super) fn worth(&self) -> Worth {
        let Outcome { findings, refusals, is_judged, .. } = self.outcome;
        if !refusals.is_empty() || findings.iter().any(|finding| !finding.holds()) {
            Worth::Refused
        } else if is_judged {
            Worth::Verified
        } else {
            Worth::NotJudged
        }
    }

    /// Findings, the worst first: broken rules, then those closest to their limit, then those without a limit.
    pub(super) fn findings(&self) -> Vec<&Finding> {
        let mut findings: Vec<&Finding> = self.outcome.findings.iter().collect();
        let share = |finding: &Finding| match finding.limit {
            Some(limit) if limit > 0.0 => finding.worst / limit,
            Some(_) if finding.holds() => 0.0,
            Some(_) => f64::INFINITY,
            None => -1.0,
        };
        findings.sort_by(|a, b| a.holds().cmp(&b.holds()).then(share(b).total_cmp(&share(a))));
        findings
    }

    /// Declared deviations: those first by which the blade leaves the drawing, the greatest first. Where there are too many,
    /// of each kind the greatest.
    pub(super) fn deviations(&self) -> Vec<Declaration> {
        let worst_first = |a: &Declaration, b: &Declaration| {
            b.kind.is_off().cmp(&a.kind.is_off()).then(b.size_mm().total_cmp(&a.size_mm()))
        };
        let mut entries = self.outcome.deviations.to_vec();
        entries.sort_by(worst_first);
        let mut counts = [0; Kind::ALL.len()];
        let ranked = entries.into_iter().map(|entry| {
            let rank = &mut counts[entry.kind as usize];
            *rank += 1;
            (*rank, entry)
        });
        let mut ranked: Vec<(usize, Declaration)> = ranked.collect();
        ranked.sort_by_key(|(rank, _)| *rank);
        let mut entries: Vec<Declaration> = ranked.into_iter().take(MOST_MARKS).map(|(_, entry)| entry).collect();
        entries.sort_by(worst_first);
        entries
    }

    /// Places of broken rules and of errors, those first that are first in the report.
    pub(super) fn broken(&self) -> Vec<Point> {
        let broken = self.findings().into_iter().filter(|finding| !finding.holds());
        let broken = broken.filter_map(|finding| Some(finding.place?.point)).filter(|&at| is_finite(at));
        broken.chain(self.places(Severity::Error)).collect()
    }

    /// Places of the messages of a severity.
    pub(super) fn places(&self, severity: Severity) -> impl Iterator<Item = Point> {
        let messages = self.outcome.messages.iter().filter(move |message| message.code.severity == severity);
        messages.filter_map(|message| place(message))
    }

    /// Number of conveyor windows; `None` where the cloth does not advance.
    pub(super) fn windows(&self) -> Option<usize> {
        self.pieces.iter().filter_map(|piece| piece.window).max().map(|last| last + 1)
    }

    /// Duration of a number of ticks, s.
    pub(super) fn time(&self, ticks: u64) -> f64 {
        ticks as f64 * self.context.job.profile.time.period()
    }
}

impl Worth {
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Verified => "verified",
            Self::NotJudged => "not-judged",
            Self::Refused => "refused",
        }
    }

    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Verified => "verified",
            Self::NotJudged => "not verified",
            Self::Refused => "refused, no program was written",
        }
    }
}

/// A duration for people, as in `2 min 05.3 s`.
pub(super) fn clock(seconds: f64) -> String {
    number::clock(seconds, if seconds > 0.0 && seconds < SHORT { 3 } else { 1 })
}

/// Place of a message on the cloth.
pub(super) fn place(message: &Diagnostic) -> Option<Point> {
    message.at.as_deref().map(|&at| Point::from(at)).filter(|&at| is_finite(at))
}

/// True if a point can be drawn.
pub(super) fn is_finite(point: Point) -> bool {
    point.x.is_finite() && point.y.is_finite()
}
