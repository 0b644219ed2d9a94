//! Stitches that the machine cannot make as they are: too short, or too long for the speed.
//!
//! Short ones are merged with the next, long ones are split or refused, or left for the speed of their run to suit.

use super::speed::{self, PITCH_EPSILON};
use super::stitches::{Op, Step, Stitches};
use super::train::Drive;
use crate::diagnostic::{Diagnostic, Diagnostics, code};
use crate::geom::Point;
use crate::machine::Sewing;
use crate::machine::sewing::OnLong;

/// Makes all stitches such as the machine can make.
pub(super) fn fit(stitches: &Stitches, sewing: &Sewing, out: &mut Diagnostics) -> Stitches {
    let merged = merge(stitches, sewing, out);
    match sewing.on_long {
        OnLong::Slow => {
            refuse(&merged, sewing, out, Drive::of(sewing), false);
            merged
        }
        OnLong::Split => split(&merged, sewing, out),
        OnLong::Reject => {
            refuse(&merged, sewing, out, Drive::of(sewing), true);
            merged
        }
    }
}

/// Merges stitches that are too short with the next, at the end of a run with the one before.
fn merge(stitches: &Stitches, sewing: &Sewing, out: &mut Diagnostics) -> Stitches {
    let least = sewing.min_pitch_mm - PITCH_EPSILON;
    let mut steps: Vec<Step> = Vec::with_capacity(stitches.steps.len());
    // A needle point that is left out when a stitch follows it.
    let mut pending: Option<Step> = None;
    let mut at = Point::origin();
    for step in &stitches.steps {
        if step.op == Op::Stitch {
            pending = None;
            let pitch = (step.to - at).norm();
            if !step.is_tie && pitch < least {
                report(step, pitch, sewing, out);
                pending = Some(*step);
                continue;
            }
        } else {
            end_run(&mut steps, pending.take(), least);
        }
        steps.push(*step);
        at = step.to;
    }
    end_run(&mut steps, pending.take(), least);
    Stitches { steps }
}

/// A run ends with a stitch that is too short: the one before it goes to its end instead.
fn end_run(steps: &mut Vec<Step>, pending: Option<Step>, least: f64) {
    let Some(short) = pending else { return };
    // A seam that turns back there would leave the one before it too short.
    let before = steps.len().checked_sub(2).map_or(Point::origin(), |i| steps[i].to);
    let is_long = (short.to - before).norm() >= least;
    match steps.last_mut() {
        Some(last) if last.op == Op::Stitch && !last.is_tie && is_long => last.to = short.to,
        // There is none that could: the thread is held there.
        Some(_) | None => steps.push(Step { is_tie: true, ..short }),
    }
}

fn report(step: &Step, pitch: f64, sewing: &Sewing, out: &mut Diagnostics) {
    let message = format!(
        "the stitch of record {} is {pitch:.3} mm long, less than `sewing.min_pitch_mm`, {} mm: it is merged with the next",
        step.record, sewing.min_pitch_mm
    );
    out.push(Diagnostic::new(&code::SEW_SHORT, message).on_cloth(step.to).by(sewing.min_pitch_mm - pitch));
}

/// The speed that a stitch of a pitch would have if it fitted, stitches a minute.
fn wanted(pitch: f64, sewing: &Sewing) -> f64 {
    speed::on_grid(speed::user(pitch, sewing).min(sewing.max_rpm), sewing)
}

/// Refuses stitches that are longer than the machine can make, and all that do not fit at full speed if so asked.
fn refuse(stitches: &Stitches, sewing: &Sewing, out: &mut Diagnostics, drive: Drive, at_speed: bool) {
    for (from, step) in stitches.moves().filter(|(_, step)| step.op == Op::Stitch) {
        let pitch = (step.to - from).norm();
        let record = step.record;
        if pitch > sewing.max_pitch_mm + PITCH_EPSILON {
            let message = format!(
                "the stitch of record {record} is {pitch:.3} mm long, more than `sewing.max_pitch_mm`, {} mm",
                sewing.max_pitch_mm
            );
            let hint = "no speed helps: split it with `--on-long split`, or make it a jump";
            out.push(Diagnostic::new(&code::SEW_LONG, message).on_cloth(step.to).by(pitch).hint(hint));
        } else if at_speed {
            let (rpm, wanted) = (speed::alone(from, step.to, sewing, &drive).0, wanted(pitch, sewing));
            if rpm < wanted {
                let message = format!(
                    "the stitch of record {record}, {pitch:.3} mm long, fits at {rpm:.0} rpm, not at {wanted:.0} rpm"
                );
                let hint = "`--on-long slow` sews its run more slowly, `--on-long split` makes it several stitches";
                out.push(Diagnostic::new(&code::SEW_LONG, message).on_cloth(step.to).by(pitch).hint(hint));
            }
        }
    }
}

/// Splits stitches that do not fit at full speed into equal ones.
fn split(stitches: &Stitches, sewing: &Sewing, out: &mut Diagnostics) -> Stitches {
    let drive = Drive::of(sewing);
    let mut steps = Vec::with_capacity(stitches.steps.len());
    let mut added = 0;
    for (from, step) in stitches.moves() {
        let parts = if step.op == Op::Stitch { parts(from, step, sewing, &drive) } else { 1 };
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

/// The longest pitch that fits in every direction at the speed that it would have, mm; at least the least one.
pub(super) fn longest(sewing: &Sewing) -> f64 {
    let drive = Drive::of(sewing);
    let most = (sewing.max_pitch_mm / drive.step + PITCH_EPSILON) as u32;
    let pitch = |pulses: u32| f64::from(pulses) * drive.step;
    let fits = |pulses: &u32| speed::fitting(*pulses, sewing, &drive) >= wanted(pitch(*pulses), sewing);
    // A stitch that is not longer than so many steps has no more pulses wherever it begins.
    (1..=most).rev().find(fits).map_or(0.0, pitch).max(sewing.min_pitch_mm).max(drive.step)
}

/// Into how many stitches one is split: the fewest that fit, and none shorter than the machine can make.
fn parts(from: Point, step: &Step, sewing: &Sewing, drive: &Drive) -> u32 {
    let way = step.to - from;
    let pitch = way.norm();
    if pitch <= sewing.max_pitch_mm + PITCH_EPSILON
        && speed::alone(from, step.to, sewing, drive).0 >= wanted(pitch, sewing)
    {
        return 1;
    }
    let fits = |parts: u32| {
        let part = pitch / f64::from(parts);
        // Rounding to whole pulses makes one of the parts a pulse longer.
        let longest = way.x.abs().max(way.y.abs()) / f64::from(parts);
        let pulses = (longest / drive.step - PITCH_EPSILON).ceil().max(0.0) as u32;
        part <= sewing.max_pitch_mm + PITCH_EPSILON && speed::fitting(pulses, sewing, drive) >= wanted(part, sewing)
    };
    let least = sewing.min_pitch_mm.max(drive.step);
    let most = ((pitch / least) as u32).max(1);
    (1..most).find(|&parts| fits(parts)).unwrap_or(most)
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
        let stitches = fit(&along(pitches_mm), sewing, &mut out);
        (pitches(&stitches), out.iter().map(|found| found.code.name).collect())
    }

    #[test]
    fn short_stitches_are_merged_with_the_next_and_at_the_end_with_the_one_before() {
        let sewing = Sewing::default();
        assert_eq!(fitted(&[2.0, 0.05, 2.0], &sewing), (vec![2.0, 2.05], vec!["sew/short-stitch"]));
        assert_eq!(fitted(&[2.0, 0.05], &sewing), (vec![2.05], vec!["sew/short-stitch"]));
        assert_eq!(fitted(&[2.0, 0.06, 0.06, 2.0], &sewing).0, [2.0, 0.12, 2.0]);
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
        fit(&along(&[2.0, 13.0]), &Sewing::default(), &mut out);
        assert!(out.has_errors() && out.iter().any(|found| found.message.contains("record 2")));
        assert_eq!(
            fitted(&[2.5, 3.0], &Sewing { on_long: OnLong::Reject, ..Sewing::default() }).1,
            ["sew/long-stitch"]
        );
        assert_eq!(fitted(&[2.5, 2.5], &Sewing { on_long: OnLong::Reject, ..Sewing::default() }).1, [""; 0]);
    }
}
