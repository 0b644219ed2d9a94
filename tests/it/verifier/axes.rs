//! Damage to the rows of a program: its clock, and how its axes move.

use std::ops::Range;

use crate::verifier::case::Case;
use crate::verifier::harm::{Harm, Place};
use crate::verifier::measure::{DAMAGING, ROUNDING, axis_amount, axis_limit, axis_rounding, differences, greatest};
use crate::verifier::rows::{Row, pick, print, renumber, travels};
use crate::verifier::{Damage, damage, scaled};

const TIME: &str = "verify/time";
const SPEED: [&str; 3] = ["verify/speed-x", "verify/speed-y", "verify/speed-c"];
const ACCELERATION: [&str; 3] = ["verify/acceleration-x", "verify/acceleration-y", "verify/acceleration-c"];
const JERK: [&str; 3] = ["verify/jerk-x", "verify/jerk-y", "verify/jerk-c"];

/// What the clock of a damaged program errs by, s: the amount, and its own rounding in whole units of the last decimal.
const LATE: f64 = DAMAGING * ROUNDING + ROUNDING;
/// Share of its limits that an axis may use where a sample is put beside its place: there is then room for a third of
/// the jerk, and for what little of the speed and the acceleration that takes.
const USED_JERK: f64 = 0.5;
const USED: f64 = 0.9;

pub(crate) const DAMAGES: &[Damage] = &[
    damage("two rows swapped", TIME, |case, rng| {
        let i = any(case, rng);
        timed(case, (i..i + 1, period(case)), |rows| rows.swap(i, i + 1))
    }),
    damage("a row dropped", TIME, |case, rng| {
        let i = any(case, rng);
        timed(case, (i..case.rows.len(), period(case)), |rows| {
            let _ = rows.remove(i);
        })
    }),
    damage("a row repeated", TIME, |case, rng| {
        let i = any(case, rng);
        timed(case, (i..case.rows.len(), period(case)), |rows| rows.insert(i, rows[i]))
    }),
    damage("a pause without rows", TIME, |case, rng| {
        let i = any(case, rng);
        let late = |rows: &mut Vec<Row>| rows[i..].iter_mut().for_each(|row| row.t += LATE);
        timed(case, (i..case.rows.len(), DAMAGING * ROUNDING), late)
    }),
    damage("a clock that runs slow", TIME, |case, _| {
        let end = case.rows[case.rows.len() - 1].t;
        let slow = |rows: &mut Vec<Row>| rows.iter_mut().for_each(|row| row.t *= 1.0 + LATE / end);
        timed(case, (0..case.rows.len(), DAMAGING * ROUNDING), slow)
    }),
    damage("a clock that starts late", TIME, |case, _| {
        let late = |rows: &mut Vec<Row>| rows.iter_mut().for_each(|row| row.t += LATE);
        timed(case, (0..case.rows.len(), DAMAGING * ROUNDING), late)
    }),
    damage("X too fast once", SPEED[0], spike::<0, 1>),
    damage("Y too fast once", SPEED[1], spike::<1, 1>),
    damage("C too fast once", SPEED[2], spike::<2, 1>),
    damage("X too strong once", ACCELERATION[0], spike::<0, 2>),
    damage("Y too strong once", ACCELERATION[1], spike::<1, 2>),
    damage("C too strong once", ACCELERATION[2], spike::<2, 2>),
    scaled("X jerks once", JERK[0], jerk::<0>),
    scaled("Y jerks once", JERK[1], jerk::<1>),
    scaled("C jerks once", JERK[2], jerk::<2>),
    damage("two samples swapped, as X feels it", JERK[0], swapped::<0>),
    damage("two samples swapped, as Y feels it", JERK[1], swapped::<1>),
    damage("two samples swapped, as C feels it", JERK[2], swapped::<2>),
    damage("a tenth faster, as X feels it", JERK[0], |case, _| jerky::<0>(case, &faster(case, 1.1))),
    damage("a tenth faster, as Y feels it", JERK[1], |case, _| jerky::<1>(case, &faster(case, 1.1))),
    damage("a tenth faster, as C feels it", JERK[2], |case, _| jerky::<2>(case, &faster(case, 1.1))),
    damage("X with too few decimals", JERK[0], |case, _| coarse::<0>(case)),
    damage("Y with too few decimals", JERK[1], |case, _| coarse::<1>(case)),
    damage("C with too few decimals", JERK[2], |case, _| coarse::<2>(case)),
    damage("X stops dead at the end", JERK[0], stopped::<0>),
    damage("Y stops dead at the end", JERK[1], stopped::<1>),
    damage("C stops dead at the end", JERK[2], stopped::<2>),
    damage("C a hair beyond its range", "verify/c-range", |case, _| {
        let [_, greatest] = case.job.profile.c.range_deg?;
        let amount = DAMAGING * ROUNDING;
        Some(turned(case, greatest + amount + ROUNDING - farthest(case), amount))
    }),
    damage("C whole turns beyond its range", "verify/c-range", |case, _| {
        let [_, greatest] = case.job.profile.c.range_deg?;
        let room = greatest - farthest(case);
        let turns = (room / 360.0).floor() + 1.0;
        Some(turned(case, 360.0 * turns, 360.0 * turns - room - ROUNDING))
    }),
];

fn period(case: &Case) -> f64 {
    case.job.profile.time.period()
}

/// A row amid the program.
fn any(case: &Case, rng: &mut fastrand::Rng) -> usize {
    rng.usize(1..case.rows.len() - 1)
}

/// A program whose clock errs by an amount at some rows.
#[allow(clippy::unnecessary_wraps, reason = "every way to damage may find nothing to damage")]
fn timed(case: &Case, (at, amount): (Range<usize>, f64), change: impl FnOnce(&mut Vec<Row>)) -> Option<Harm> {
    let mut rows = case.rows.clone();
    change(&mut rows);
    let place = Place::During([case.rows[at.start].t, case.rows[at.end - 1].t]);
    Some(Harm { program: print(&rows), amount: amount - ROUNDING.min(0.001 * amount), place })
}

/// Greatest position of C, degrees.
fn farthest(case: &Case) -> f64 {
    case.rows.iter().map(|row| row.pose[2]).fold(f64::NEG_INFINITY, f64::max)
}

/// The program with another zero of C.
fn turned(case: &Case, by_deg: f64, amount: f64) -> Harm {
    let turned = |row: &Row| Row { pose: [row.pose[0], row.pose[1], row.pose[2] + by_deg], ..*row };
    let rows: Vec<Row> = case.rows.iter().map(turned).collect();
    Harm::anywhere(print(&rows), amount)
}

/// The program with one sample of an axis beside its place.
fn beside(case: &Case, i: usize, axis: usize, by: f64) -> Vec<u8> {
    let mut rows = case.rows.clone();
    rows[i].pose[axis] += by;
    print(&rows)
}

/// The time from a row to the last one whose differences it changes.
fn felt(case: &Case, i: usize) -> Place {
    Place::During([case.rows[i].t, case.rows[i].t + 3.0 * period(case)])
}

/// One sample beside its place, far enough for a difference quotient of an order to be three times its limit, whatever
/// it is without: the sample counts once in it, twice in that of the second order.
fn spike<const AXIS: usize, const ORDER: u8>(case: &Case, rng: &mut fastrand::Rng) -> Option<Harm> {
    let travel = pick(rng, &travels(&case.rows))?;
    let i = travel.start + travel.len() / 3;
    let amount = axis_amount(case, AXIS, ORDER);
    let needed = amount + axis_limit(case, AXIS, ORDER) + axis_rounding(case, ORDER);
    let by = needed * period(case).powi(i32::from(ORDER)) / f64::from(ORDER);
    Some(Harm { program: beside(case, i, AXIS, by), amount, place: felt(case, i) })
}

/// One sample beside its place by as much as makes a jerk of some times the limit, where the axis has room: the sample
/// counts three times in it.
fn jerk<const AXIS: usize>(case: &Case, rng: &mut fastrand::Rng, times: f64) -> Option<Harm> {
    let h = period(case);
    let used = |order| differences(case.rows.iter().map(|row| row.pose[AXIS]), order, h);
    let (fast, strong, sharp) = (used(1), used(2), used(3));
    let limit = axis_limit(case, AXIS, 3);
    let has_room = |i: &usize| {
        sharp[*i..i + 4].iter().all(|jerk| *jerk <= USED_JERK * limit)
            && strong[*i..i + 3].iter().all(|a| *a <= USED * axis_limit(case, AXIS, 2))
            && fast[*i..i + 2].iter().all(|v| *v <= USED * axis_limit(case, AXIS, 1))
    };
    let places: Vec<usize> = travels(&case.rows).into_iter().flatten().filter(has_room).collect();
    let i = pick(rng, &places)?;
    let more = if times < 1.0 { 0.0 } else { USED_JERK * limit + 2.0 * axis_rounding(case, 3) };
    let by = (times * limit + more) * h.powi(3) / 3.0;
    Some(Harm { program: beside(case, i, AXIS, by), amount: axis_amount(case, AXIS, 3), place: felt(case, i) })
}

/// The two samples whose exchange jerks the axis the least of those that do so by three times the limit.
fn swapped<const AXIS: usize>(case: &Case, _: &mut fastrand::Rng) -> Option<Harm> {
    let rows = &case.rows;
    let amount = axis_amount(case, AXIS, 3);
    let jerk = |i: usize| {
        let place = |k: usize| {
            if k == i {
                i + 1
            } else if k == i + 1 {
                i
            } else {
                k
            }
        };
        let window = (i - 3..i + 5).map(|k| rows[place(k)].pose[AXIS]);
        // The first three differences of a window would take it for a start from rest.
        differences(window, 3, period(case))[3..8].iter().copied().fold(0.0, f64::max)
    };
    let jerks = (3..rows.len() - 5).map(|i| (i, jerk(i))).filter(|(_, jerk)| *jerk >= amount);
    let (i, _) = jerks.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let mut damaged = rows.clone();
    (damaged[i].pose, damaged[i + 1].pose) = (rows[i + 1].pose, rows[i].pose);
    Some(Harm { program: print(&damaged), amount, place: felt(case, i) })
}

/// A program that jerks an axis by three times its limit.
fn jerky<const AXIS: usize>(case: &Case, rows: &[Row]) -> Option<Harm> {
    let amount = axis_amount(case, AXIS, 3);
    (greatest(case, rows, AXIS, 3) > amount + axis_rounding(case, 3)).then(|| Harm::anywhere(print(rows), amount))
}

/// An axis printed with the most decimals that are too few.
fn coarse<const AXIS: usize>(case: &Case) -> Option<Harm> {
    (0..6).rev().find_map(|decimals| {
        let unit = 0.1_f64.powi(decimals);
        let mut rows = case.rows.clone();
        for row in &mut rows {
            row.pose[AXIS] = (row.pose[AXIS] / unit).round() * unit;
        }
        jerky::<AXIS>(case, &rows)
    })
}

/// A program that ends amid a travel, where that jerks the axis the least of the places where it does so by three times
/// the limit.
fn stopped<const AXIS: usize>(case: &Case, rng: &mut fastrand::Rng) -> Option<Harm> {
    let travel = pick(rng, &travels(&case.rows))?;
    let amount = axis_amount(case, AXIS, 3);
    let jerk = |i: usize| {
        let window = case.rows[i - 3..=i].iter().map(|row| row.pose[AXIS]);
        differences(window, 3, period(case))[4..].iter().copied().fold(0.0, f64::max)
    };
    let from = travel.start.max(3);
    let jerks = (from..travel.end).map(|i| (i, jerk(i))).filter(|(_, jerk)| *jerk >= amount);
    let (i, _) = jerks.min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(Harm { program: print(&case.rows[..=i]), amount, place: felt(case, i) })
}

/// The rows as a clock finds them that runs faster.
fn faster(case: &Case, factor: f64) -> Vec<Row> {
    let rows = &case.rows;
    let count = ((rows.len() - 1) as f64 / factor) as usize + 1;
    let mut quick: Vec<Row> = (0..count)
        .map(|i| {
            let at = i as f64 * factor;
            let (before, share) = (at as usize, at.fract());
            let behind = rows[(before + 1).min(rows.len() - 1)];
            let pose = std::array::from_fn(|axis| {
                rows[before].pose[axis] + (behind.pose[axis] - rows[before].pose[axis]) * share
            });
            Row { pose, ..rows[before] }
        })
        .collect();
    renumber(&mut quick, period(case));
    quick
}
