//! Adjustment of stitches that the machine cannot make: too short, or too long for the speed.
//!
//! Short stitches are merged with the next. Long ones are split or refused, or kept and sewn at a lower speed of their run.

use super::pace;
use super::speed::{self, Limits, PITCH_EPSILON};
use super::stitches::{Op, Step, Stitches};
use super::train::Drive;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Point;
use crate::machine::Sewing;
use crate::machine::sewing::OnLong;
use crate::units::number::{exact, fixed};

/// Adjustment of stitches to a machine.
pub(super) struct Fit<'a> {
    limits: &'a Limits<'a>,
    sewing: &'a Sewing,
    /// Word for the records of the file.
    record_word: &'static str,
}

impl<'a> Fit<'a> {
    /// Creates the adjustment for the limits of a machine and a word for records.
    pub(super) fn new(limits: &'a Limits<'a>, record_word: &'static str) -> Self {
        Self { limits, sewing: limits.sewing, record_word }
    }

    /// Adjusts all stitches to the machine.
    pub(super) fn fit(&self, stitches: &Stitches, out: &mut Diagnostics) -> Stitches {
        let merged = self.merge(stitches, out);
        match self.sewing.on_long {
            OnLong::Slow | OnLong::Reject => {
                self.refuse(&merged, out);
                merged
            }
            OnLong::Split => self.split(&merged, out),
        }
    }

    /// Merges stitches that are too short with the next one; at the end of a run with the previous one.
    fn merge(&self, stitches: &Stitches, out: &mut Diagnostics) -> Stitches {
        let least = self.sewing.min_pitch_mm - PITCH_EPSILON;
        let mut steps: Vec<Step> = Vec::with_capacity(stitches.steps.len());
        // Omitted needle points since the last kept stitch; a following stitch replaces them.
        let mut short: Vec<Step> = Vec::new();
        let mut at = Point::origin();
        for step in &stitches.steps {
            if step.op == Op::Stitch {
                let pitch = (step.to - at).norm();
                if !step.is_tie && pitch < least {
                    self.report_short(step, pitch, out);
                    short.push(*step);
                    continue;
                }
            } else {
                end_run(&mut steps, &short, least);
            }
            short.clear();
            steps.push(*step);
            at = step.to;
        }
        end_run(&mut steps, &short, least);
        Stitches { steps }
    }

    fn report_short(&self, step: &Step, pitch: f64, out: &mut Diagnostics) {
        let least = self.sewing.min_pitch_mm;
        let message = format!(
            "the stitch of {} {} is {} mm long, less than `sewing.min_pitch_mm`, {} mm: it is merged with the next",
            self.record_word,
            step.record,
            fixed(pitch, 3),
            exact(least)
        );
        out.push(Diagnostic::new(&code::SEW_SHORT, message).on_cloth(step.to).by(least - pitch));
    }

    /// Refuses stitches longer than the machine can make; with `OnLong::Reject` also all that do not fit at full speed.
    fn refuse(&self, stitches: &Stitches, out: &mut Diagnostics) {
        let Self { limits, sewing, record_word } = self;
        for (from, step) in stitches.moves().filter(|(_, step)| step.op == Op::Stitch) {
            let pitch = (step.to - from).norm();
            let (record, long) = (step.record, fixed(pitch, 3));
            if pitch > sewing.max_pitch_mm + PITCH_EPSILON {
                let most = sewing.max_pitch_mm;
                let message = format!(
                    "the stitch of {record_word} {record} is {long} mm long, more than `sewing.max_pitch_mm`, {} mm",
                    exact(most)
                );
                let hint = "no speed helps: split it with `--on-long split`, or make it a jump";
                out.push(Diagnostic::new(&code::SEW_LONG, message).on_cloth(step.to).by(pitch - most).hint(hint));
            } else if sewing.on_long == OnLong::Reject {
                let (rpm, wanted) = (limits.alone(from, step).0, self.wanted(pitch, record));
                if rpm < wanted {
                    let (fits, full) = (fixed(rpm, 0), fixed(wanted, 0));
                    let message = format!(
                        "the stitch of {record_word} {record}, {long} mm long, fits at {fits} rpm, not at {full} rpm"
                    );
                    let hint = "`--on-long slow` sews its run more slowly, `--on-long split` makes it several stitches";
                    let found = Diagnostic::new(&code::SEW_LONG, message).on_cloth(step.to);
                    out.push(found.by(self.excess([from, step.to], wanted)).hint(hint));
                }
            }
        }
    }

    /// Excess of a stitch over the longest one in its direction that fits at a speed, mm.
    fn excess(&self, [from, to]: [Point; 2], rpm: f64) -> f64 {
        let pulses = speed::pulses(from, to, &self.limits.drive).into_iter().map(i64::unsigned_abs).max().unwrap_or(0);
        let pulses = u32::try_from(pulses).unwrap_or(u32::MAX);
        let fits = |pulses: &u32| speed::fitting(*pulses, self.sewing, &self.limits.drive) >= rpm;
        let most = (0..pulses).rev().find(fits).unwrap_or(0);
        (to - from).norm() * f64::from(pulses - most) / f64::from(pulses.max(1))
    }

    /// True if any stitch does not fit at full speed.
    pub(super) fn splits(&self, stitches: &Stitches) -> bool {
        stitches.moves().any(|(from, step)| step.op == Op::Stitch && self.parts(from, step) > 1)
    }

    /// Splits stitches that do not fit at full speed into equal ones.
    fn split(&self, stitches: &Stitches, out: &mut Diagnostics) -> Stitches {
        let mut steps = Vec::with_capacity(stitches.steps.len());
        let mut added = 0;
        for (from, step) in stitches.moves() {
            let parts = if step.op == Op::Stitch { self.parts(from, step) } else { 1 };
            for part in 1..parts {
                let to = from + (step.to - from) * (f64::from(part) / f64::from(parts));
                steps.push(Step { to, ..*step });
            }
            added += parts - 1;
            steps.push(*step);
        }
        if added > 0 {
            let message =
                format!("{added} penetrations are added: stitches too long for the speed are split into equal ones");
            let hint = "needle holes weaken leather and coated cloth; `--on-long slow` keeps every stitch as it is";
            out.push(Diagnostic::new(&code::SEW_SPLIT, message).hint(hint));
        }
        Stitches { steps }
    }

    /// Speed of a stitch of a pitch and record without regard to the feed time, stitches per minute.
    fn wanted(&self, pitch: f64, record: u32) -> f64 {
        pace::on_grid(self.limits.user(pitch, record).min(self.sewing.max_rpm), self.sewing)
    }

    /// Number of parts of a stitch: the smallest one at which the parts fit, limited by the minimum pitch of the machine.
    fn parts(&self, from: Point, step: &Step) -> u32 {
        let Self { limits, sewing, .. } = self;
        let way = step.to - from;
        let pitch = way.norm();
        if pitch <= sewing.max_pitch_mm + PITCH_EPSILON && limits.alone(from, step).0 >= self.wanted(pitch, step.record)
        {
            return 1;
        }
        let fits = |parts: u32| {
            let part = pitch / f64::from(parts);
            // Rounding to whole pulses makes one of the parts a pulse longer.
            let longest = way.x.abs().max(way.y.abs()) / f64::from(parts);
            let pulses = (longest / limits.drive.step - PITCH_EPSILON).ceil().max(0.0) as u32;
            part <= sewing.max_pitch_mm + PITCH_EPSILON
                && speed::fitting(pulses, sewing, &limits.drive) >= self.wanted(part, step.record)
        };
        let least = sewing.min_pitch_mm.max(limits.drive.step);
        let most = ((pitch / least) as u32).max(1);
        (1..most).find(|&parts| fits(parts)).unwrap_or(most)
    }
}

/// Handles short stitches at the end of a run: the stitch before them is moved to the end.
fn end_run(steps: &mut Vec<Step>, short: &[Step], least: f64) {
    let Some(&end) = short.last() else { return };
    // At a reversal of the seam the moved stitch could become too short, or a corner could be lost.
    let before = steps.len().checked_sub(2).map_or(Point::origin(), |i| steps[i].to);
    let is_long = (end.to - before).norm() >= least;
    let is_near = short.iter().all(|step| (step.to - end.to).norm() <= least);
    match steps.last_mut() {
        Some(last) if last.op == Op::Stitch && !last.is_tie && is_long && is_near => last.to = end.to,
        // No stitch can be moved, so a short one holds the thread there.
        Some(_) | None => steps.push(Step { is_tie: true, ..end }),
    }
}

/// Longest pitch up to which all stitches, in every direction, fit at the speed wanted for them, mm; at least the minimum
/// pitch.
pub(super) fn longest(sewing: &Sewing) -> f64 {
    let drive = Drive::of(sewing);
    let most = (sewing.max_pitch_mm / drive.step + PITCH_EPSILON) as u32;
    let pitch = |pulses: u32| f64::from(pulses) * drive.step;
    let fits = |pulses: &u32| {
        speed::fitting(*pulses, sewing, &drive)
            >= pace::on_grid(speed::user(pitch(*pulses), sewing).min(sewing.max_rpm), sewing)
    };
    // A stitch that is not longer than n steps has at most n pulses, wherever it begins. Shorter ones must fit, too, at the
    // higher speed that the user's limits may permit for them.
    (1..=most).take_while(fits).last().map_or(0.0, pitch).max(sewing.min_pitch_mm).max(drive.step)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn along(pitches: &[f64]) -> Stitches {
        let mut x = 0.0;
        let steps = pitches.iter().zip(1..).map(|(pitch, record)| {
            x += pitch;
            Step { op: Op::Stitch, to: Point::new(x, 0.0), is_tie: false, record }
        });
        Stitches { steps: steps.collect() }
    }

    fn pitches(stitches: &Stitches) -> Vec<f64> {
        stitches.moves().map(|(from, step)| ((step.to - from).norm() * 1e6).round() / 1e6).collect()
    }

    fn fitted(pitches_mm: &[f64], sewing: &Sewing) -> (Vec<f64>, Vec<&'static str>) {
        let mut out = Diagnostics::default();
        let stitches = Fit::new(&Limits::new(sewing, None), "record").fit(&along(pitches_mm), &mut out);
        (pitches(&stitches), out.iter().map(|found| found.code.name).collect())
    }

    #[test]
    fn short_stitches_are_merged_with_the_next_and_at_the_end_with_the_one_before() {
        let sewing = Sewing::default();
        assert_eq!(fitted(&[2.0, 0.05, 2.0], &sewing), (vec![2.0, 2.05], vec!["sew/short-stitch"]));
        assert_eq!(fitted(&[2.0, 0.05], &sewing), (vec![2.05], vec!["sew/short-stitch"]));
        assert_eq!(fitted(&[2.0, 0.06, 0.06, 2.0], &sewing).0, [2.0, 0.12, 2.0]);
        // The points between are never farther from a needle point than the minimum pitch.
        assert_eq!(fitted(&[2.0, -0.09, 0.18], &sewing).0, [2.0, 0.09]);
    }

    #[test]
    fn long_stitches_are_split_into_equal_ones_that_fit() {
        let sewing =
            Sewing { feed_acceleration_mm_s2: 80_000.0, start_hz: 0.0, on_long: OnLong::Split, ..Sewing::default() };
        assert_eq!(fitted(&[2.5, 6.0, 2.5], &sewing), (vec![2.5, 2.0, 2.0, 2.0, 2.5], vec!["sew/split-stitches"]));
        assert_eq!(fitted(&[2.5, 2.6], &sewing).1, [""; 0]);
        let (pitches, _) = fitted(&[30.0], &sewing);
        assert!(pitches.len() >= 12 && pitches.iter().all(|&pitch| pitch <= 2.6), "{pitches:?}");
    }

    #[test]
    fn what_is_too_long_is_refused_with_its_record() {
        let mut out = Diagnostics::default();
        Fit::new(&Limits::new(&Sewing::default(), None), "record").fit(&along(&[2.0, 13.0]), &mut out);
        assert!(out.has_errors() && out.iter().any(|found| found.message.contains("record 2")));
        let by = |sewing: &Sewing, pitch: f64| {
            let mut out = Diagnostics::default();
            Fit::new(&Limits::new(sewing, None), "record").fit(&along(&[2.0, pitch]), &mut out);
            out.iter().map(|found| found.by.map(|by| (by * 1e6).round() / 1e6)).collect::<Vec<_>>()
        };
        // Of 3 mm, 2.5 fit at full speed.
        let reject = Sewing { on_long: OnLong::Reject, ..Sewing::default() };
        assert_eq!((by(&Sewing::default(), 13.0), by(&reject, 3.0)), (vec![Some(0.3)], vec![Some(0.5)]));
        assert_eq!(
            fitted(&[2.5, 3.0], &Sewing { on_long: OnLong::Reject, ..Sewing::default() }).1,
            ["sew/long-stitch"]
        );
        assert_eq!(fitted(&[2.5, 2.5], &Sewing { on_long: OnLong::Reject, ..Sewing::default() }).1, [""; 0]);
    }
}
