//! The speed of each run: the maximum constant speed at which every stitch fits into its window.
//!
//! It is the minimum of the user's limit, the machine's limit and 60 window / longest move, rounded down to the grid. A turn is
//! a stitch. The stitches of the soft start do not limit the rest of the run; `pace` has the speed of each stitch.

use std::collections::BTreeMap;
use std::ops::Range;

use super::pace::{self, on_grid};
use super::pattern::Pattern;
use super::stitches::{Op, Step, Stitches};
use super::train::Drive;
use crate::geom::Point;
use crate::machine::Sewing;
use crate::units::S_PER_MIN;

/// Relative amount below a multiple of the grid within which a speed counts as that multiple, because times of pulses are
/// rounded.
const GRID_EPSILON: f64 = 1e-6;

/// A run of stitches and its speed.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Range of its entries.
    pub steps: Range<usize>,
    /// Greatest speed after the soft start, stitches per minute.
    pub rpm: f64,
    /// Least speed after the soft start; below `rpm` if the spindle eases.
    pub slowest: f64,
    /// Speed of each stitch, stitches per minute.
    pub(super) speeds: Vec<f64>,
    /// Reason for the limit of its speed.
    pub limit: Limit,
    /// Additional time compared with the median speed of its stitches, s.
    pub cost: f64,
}

/// Limit of the speed of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limit {
    /// The maximum speed of the spindle.
    Machine,
    /// The user's limits by pitch, for the stitch of this entry.
    User(usize),
    /// The feed time of the stitch of this entry.
    Stitch(usize),
}

/// Limits of the speed of a stitch.
pub(super) struct Limits<'a> {
    pub(super) sewing: &'a Sewing,
    pub(super) drive: Drive,
    /// Speeds of seams that have one of their own, by the record where each begins; the lowest of one record.
    seams: BTreeMap<u32, f64>,
}

impl<'a> Limits<'a> {
    /// The limits of a machine, and of the seams of a pattern.
    pub(super) fn new(sewing: &'a Sewing, pattern: Option<&Pattern>) -> Self {
        let mut seams = BTreeMap::new();
        for seam in pattern.iter().flat_map(|pattern| &pattern.seams) {
            if let Some(rpm) = seam.rpm {
                let least = seams.entry(seam.span.block).or_insert(rpm);
                *least = f64::min(*least, rpm);
            }
        }
        Self { sewing, drive: Drive::of(sewing), seams }
    }

    /// Maximum speed of a stitch alone, stitches per minute, and true if it is the user's limit.
    pub(super) fn alone(&self, from: Point, step: &Step) -> (f64, bool) {
        let most = pulses(from, step.to, &self.drive).into_iter().map(i64::unsigned_abs).max().unwrap_or(0);
        let fits = fitting(u32::try_from(most).unwrap_or(u32::MAX), self.sewing, &self.drive);
        let user = on_grid(self.user((step.to - from).norm(), step.record), self.sewing);
        (fits.min(user), user < fits)
    }

    /// Speed limit of the user for the stitch of a record with a pitch in mm; infinite without a limit.
    pub(super) fn user(&self, pitch: f64, record: u32) -> f64 {
        let seam = self.seams.get(&record).copied().unwrap_or(f64::INFINITY);
        user(pitch, self.sewing).min(seam)
    }
}

/// Maximum speed at which a number of pulses of an axis fits into the window, stitches per minute; infinite for 0 pulses.
pub(super) fn fitting(pulses: u32, sewing: &Sewing, drive: &Drive) -> f64 {
    match drive.least_time(pulses) {
        0.0 => f64::INFINITY,
        time => on_grid(S_PER_MIN * sewing.window() / time * (1.0 + GRID_EPSILON), sewing),
    }
}

/// The user's limit for a stitch of a pitch, stitches per minute; infinite if there is none. `pitch` is in mm.
pub(super) fn user(pitch: f64, sewing: &Sewing) -> f64 {
    let rows = sewing.speeds.iter().filter(|[from, _]| pitch >= from - PITCH_EPSILON);
    rows.map(|[_, rpm]| *rpm).fold(f64::INFINITY, f64::min)
}

/// Rounding of positions, mm: a stitch has the same pitch wherever it lies.
pub(super) const PITCH_EPSILON: f64 = 1e-6;

/// Pulses of X and Y between two points.
pub(super) fn pulses(from: Point, to: Point, drive: &Drive) -> [i64; 2] {
    [drive.grid(to.x) - drive.grid(from.x), drive.grid(to.y) - drive.grid(from.y)]
}

/// The speeds of all runs.
pub(super) fn runs(stitches: &Stitches, limits: &Limits) -> Vec<Run> {
    let sewing = limits.sewing;
    let machine = on_grid(sewing.max_rpm, sewing);
    let run = |steps: Range<usize>| {
        let soft = pace::soft_stitches(steps.len(), sewing);
        // The soft start does not limit the rest, unless its stitches are all that there is or one fits at no speed.
        let first = steps.start + if soft < steps.len() { soft } else { 0 };
        let (mut least, mut limit) = (machine, Limit::Machine);
        let mut alone_rpm: Vec<f64> = Vec::with_capacity(steps.len());
        for i in steps.clone() {
            let from = if i == 0 { Point::origin() } else { stitches.steps[i - 1].to };
            let (rpm, is_user) = limits.alone(from, &stitches.steps[i]);
            if rpm < least && (i >= first || rpm <= 0.0) {
                (least, limit) = (rpm, if is_user { Limit::User(i) } else { Limit::Stitch(i) });
            }
            alone_rpm.push(rpm.min(machine));
        }
        if least <= 0.0 {
            let speeds = vec![0.0; steps.len()];
            return Run { steps, rpm: 0.0, slowest: 0.0, speeds, limit, cost: 0.0 };
        }
        let speeds = pace::paced(&alone_rpm, least, sewing);
        let rest = &speeds[first - steps.start..];
        let [slowest, rpm] =
            rest.iter().fold([f64::INFINITY, 0.0], |[least, most], &rpm| [least.min(rpm), f64::max(most, rpm)]);
        let middle = alone_rpm.len() / 2;
        let half = *alone_rpm.select_nth_unstable_by(middle, f64::total_cmp).1;
        alone_rpm.fill(half);
        let usual = pace::paced(&alone_rpm, half, sewing);
        let cost = pace::duration(&speeds, sewing) - pace::duration(&usual, sewing);
        Run { steps, rpm, slowest, speeds, limit, cost }
    };
    stitches.runs().into_iter().map(run).collect()
}

/// Time of a move with the needle up, s.
pub(super) fn jump_time(from: Point, to: Point, drive: &Drive) -> f64 {
    let most = pulses(from, to, drive).into_iter().map(i64::unsigned_abs).max().unwrap_or(0);
    drive.train(u32::try_from(most).unwrap_or(u32::MAX), None).time()
}

/// Speed of the spindle during each entry, in order, stitches per minute; 0 if it stands.
pub(super) fn speeds<'a>(stitches: &'a Stitches, runs: &'a [Run]) -> impl Iterator<Item = f64> + 'a {
    let mut runs = runs.iter().peekable();
    stitches.steps.iter().enumerate().map(move |(i, step)| {
        while runs.next_if(|run| run.steps.end <= i).is_some() {}
        match (step.op, runs.peek()) {
            (Op::Stitch, Some(run)) => {
                let at = i.saturating_sub(run.steps.start);
                run.speeds.get(at).or(run.speeds.last()).copied().unwrap_or(0.0)
            }
            (Op::Stitch | Op::Jump | Op::Trim | Op::Stop | Op::Color(_), _) => 0.0,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Stitches of these pitches along X.
    fn along(pitches: &[f64]) -> Stitches {
        let mut x = 0.0;
        let step = |pitch: &f64| {
            x += pitch;
            Step { op: Op::Stitch, to: Point::new(x, 0.0), is_tie: false, record: 0 }
        };
        Stitches { steps: pitches.iter().map(step).collect() }
    }

    #[test]
    fn the_headline_figures_are_computed() {
        let sewing = Sewing { max_rpm: 5000.0, ..Sewing::default() };
        for (pitch, rpm) in [(2.5, 3200.0), (3.0, 2800.0)] {
            let run = &runs(&along(&[pitch; 20]), &Limits::new(&sewing, None))[0];
            assert_eq!(run.rpm, rpm, "{pitch} mm");
            assert!(matches!(run.limit, Limit::Stitch(_)));
        }
        assert_eq!(runs(&along(&[1.0; 5]), &Limits::new(&Sewing::default(), None))[0].limit, Limit::Machine);
    }

    #[test]
    fn one_long_stitch_slows_its_run_down_and_tells_what_it_costs() {
        let sewing = Sewing {
            feed_acceleration_mm_s2: 80_000.0,
            start_hz: 0.0,
            soft_start_rpm: None,
            grid_rpm: 1,
            ..Sewing::default()
        };
        let mut pitches = [2.5; 201];
        pitches[100] = 6.0;
        let run = &runs(&along(&pitches), &Limits::new(&sewing, None))[0];
        // 2116.95 stitches per minute; the grid has whole ones.
        assert_eq!((run.rpm, run.limit), (2116.0, Limit::Stitch(100)));
        assert!((pace::duration(&run.speeds, &sewing) - 5.70).abs() < 0.005);
        assert!((run.cost - (5.697 - 3.769)).abs() < 0.005, "{}", run.cost);
    }

    #[test]
    fn the_stitches_of_a_soft_start_do_not_limit_the_rest() {
        let sewing = Sewing::default();
        let run = &runs(&along(&[6.0, 6.0, 2.0, 2.0, 2.0]), &Limits::new(&sewing, None))[0];
        assert_eq!((run.rpm, run.limit), (3200.0, Limit::Machine));
        assert_eq!(run.speeds, [400.0, 400.0, 3200.0, 3200.0, 3200.0]);
        // A soft start is no faster than its own stitches, and than the rest.
        let slow = Sewing { speeds: vec![[5.0, 300.0]], ..sewing.clone() };
        assert_eq!(runs(&along(&[6.0, 2.0, 2.0]), &Limits::new(&slow, None))[0].speeds, [300.0, 300.0, 3200.0]);
        assert_eq!(runs(&along(&[2.0, 2.0, 6.0]), &Limits::new(&slow, None))[0].speeds, [300.0; 3]);
        // A run that is all soft start.
        assert_eq!(runs(&along(&[6.0, 2.0]), &Limits::new(&sewing, None))[0].limit, Limit::Stitch(0));
    }

    #[test]
    fn limits_of_the_user_hold_from_their_pitch_on() {
        let sewing = Sewing { speeds: vec![[2.0, 1500.0], [3.0, 900.0]], ..Sewing::default() };
        let rpm = |pitch: f64| runs(&along(&[pitch; 8]), &Limits::new(&sewing, None))[0].rpm;
        assert_eq!([rpm(1.9), rpm(2.0), rpm(2.9), rpm(3.0)], [3200.0, 1500.0, 1500.0, 900.0]);
    }

    #[test]
    fn a_slower_spindle_never_makes_a_stitch_too_long() {
        let (sewing, mut random) = (Sewing::default(), fastrand::Rng::with_seed(7));
        let drive = Drive::of(&sewing);
        for _ in 0..2000 {
            let pulses = random.u32(1..=254);
            let fits = |rpm: f64| drive.least_time(pulses) <= sewing.window() * 60.0 / rpm;
            let rpm = 100.0 + 4000.0 * random.f64();
            let slower = rpm * random.f64().max(0.01);
            assert!(!fits(rpm) || fits(slower), "{pulses} pulses fit at {rpm} but not at {slower}");
        }
    }
}
