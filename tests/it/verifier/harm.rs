//! A damaged program, what must be found in it, and whether that was found.

use cutc::geom::{Point, polyline};
use cutc::ir::verdict::Verdict;

use crate::verifier::case::Case;

/// Rows by which a place may be off: a difference of the third order is seen three rows late, and one is for rounding.
const ROWS_LATE: f64 = 4.0;
/// Reach around a place that is enough whatever the blade, mm: a stroke that lies farther from a line is not one of it.
const REACH: f64 = 2.0;
/// Part of an amount that is rounding of the computation.
const AMOUNT_EPSILON: f64 = 1e-9;

/// A damaged program.
pub(crate) struct Harm {
    /// Its bytes.
    pub(crate) program: Vec<u8>,
    /// The least that the rule must report, in the rule's unit.
    pub(crate) amount: f64,
    /// Where it must see it.
    pub(crate) place: Place,
}

/// Where a damage is.
pub(crate) enum Place {
    /// All over the program.
    Anywhere,
    /// Between two times, s.
    During([f64; 2]),
    /// Within a blade's width of these points and the lines between them.
    Along(Vec<Point>),
}

impl Harm {
    pub(crate) fn anywhere(program: Vec<u8>, amount: f64) -> Self {
        Self { program, amount, place: Place::Anywhere }
    }

    /// Why a verdict does not show this harm under a rule; `None` when it does.
    pub(crate) fn unseen(&self, verdict: &Verdict, rule: &str, case: &Case) -> Option<String> {
        let finding =
            verdict.findings.iter().find(|finding| finding.rule.name == rule).expect("every rule has a finding");
        if finding.holds() {
            let broken: Vec<_> = verdict.broken().map(|finding| finding.rule.name).collect();
            return Some(format!("{rule} holds with {}, broken is {broken:?}", finding.worst));
        }
        if finding.worst < self.amount * (1.0 - AMOUNT_EPSILON) {
            return Some(format!("{rule} sees {} of {}", finding.worst, self.amount));
        }
        if finding.limit.is_some_and(|limit| self.amount <= limit) {
            return Some(format!("{} is allowed: the limit of {rule} is {:?}", self.amount, finding.limit));
        }
        let seen = finding.place.expect("what breaks a rule has a place");
        let profile = &case.job.profile;
        match &self.place {
            Place::Anywhere => None,
            Place::During([from, to]) => {
                let late = ROWS_LATE * profile.time.period();
                let time = seen.time.expect("what a program does has a time");
                (time < from - late || time > to + late).then(|| format!("seen at {time} s, not in {from} to {to} s"))
            }
            Place::Along(points) => {
                let away = |w: &[Point]| polyline::distance_to_segment(seen.point, w[0], w[1]);
                let away = if let [point] = points[..] {
                    (seen.point - point).norm()
                } else {
                    points.windows(2).map(away).fold(f64::INFINITY, f64::min)
                };
                (away > profile.knife.width_mm.max(REACH)).then(|| format!("seen {away} mm from its place"))
            }
        }
    }
}
