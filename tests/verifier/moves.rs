//! Damage to the rows of a program: what the axes and the knife do.

use std::ops::Range;

use crate::case::Case;
use crate::rows::{self, Row, holes, pick, print, renumber, strokes, travels};
use crate::{Damage, damage};

const JERK: &[&str] = &["verify/jerk-x", "verify/jerk-y", "verify/jerk-c"];
const TIME: &[&str] = &["verify/time"];
const REST: &[&str] = &["verify/rest"];
const HEADING: &[&str] = &["verify/heading"];
const END: &[&str] = &["verify/end"];

/// Way of an axis that is clearly no rest, mm and degrees: far more than three times the rounding that is allowed.
const WAY: f64 = 0.01;
/// Error of the blade's angle, degrees: more than three times what is allowed.
const TWIST: f64 = 2.0;

pub(crate) const DAMAGES: &[Damage] = &[
    damage("two samples swapped", JERK, |case, rng| {
        let i = amid(case, rng)?;
        edited(case, |rows| {
            (rows[i].pose, rows[i + 1].pose) = (rows[i + 1].pose, rows[i].pose);
        })
    }),
    damage("two rows swapped", TIME, |case, rng| {
        let i = rng.usize(1..case.rows.len() - 1);
        edited(case, |rows| rows.swap(i, i + 1))
    }),
    damage("a row dropped", TIME, |case, rng| {
        let i = rng.usize(1..case.rows.len() - 1);
        edited(case, |rows| {
            let _ = rows.remove(i);
        })
    }),
    damage("a row repeated", TIME, |case, rng| {
        let i = rng.usize(1..case.rows.len() - 1);
        edited(case, |rows| rows.insert(i, rows[i]))
    }),
    damage("a pause without rows", TIME, |case, rng| {
        let i = rng.usize(1..case.rows.len() - 1);
        edited(case, |rows| rows[i..].iter_mut().for_each(|row| row.t += 0.5))
    }),
    damage("a clock that runs slow", TIME, |case, _| {
        edited(case, |rows| rows.iter_mut().for_each(|row| row.t *= 1.001))
    }),
    damage("a clock that starts late", TIME, |case, _| {
        edited(case, |rows| rows.iter_mut().for_each(|row| row.t += 0.01))
    }),
    damage("X too fast once", &["verify/speed-x"], spike::<0, 1>),
    damage("Y too fast once", &["verify/speed-y"], spike::<1, 1>),
    damage("C too fast once", &["verify/speed-c"], spike::<2, 1>),
    damage("X too strong once", &["verify/acceleration-x"], spike::<0, 2>),
    damage("Y too strong once", &["verify/acceleration-y"], spike::<1, 2>),
    damage("C too strong once", &["verify/acceleration-c"], spike::<2, 2>),
    damage("X jerks once", &["verify/jerk-x"], spike::<0, 3>),
    damage("Y jerks once", &["verify/jerk-y"], spike::<1, 3>),
    damage("C jerks once", &["verify/jerk-c"], spike::<2, 3>),
    damage("a tenth faster", JERK, |case, _| Some(print(&faster(case, 1.1)))),
    damage("positions with three decimals", JERK, |case, _| {
        edited(case, |rows| rows.iter_mut().for_each(|row| row.pose = row.pose.map(|v| (v * 1e3).round() / 1e3)))
    }),
    damage("axes that stop dead at the end", JERK, |case, rng| {
        let i = amid(case, rng)?;
        edited(case, |rows| rows.truncate(i))
    }),
    damage("a plunge on the move", REST, |case, rng| {
        let stroke = pick(rng, &behind_travels(case))?;
        let from = last_away(&case.rows, stroke.start)?;
        edited(case, |rows| rows[from..stroke.start].iter_mut().for_each(|row| row.knife = 1))
    }),
    damage("a lift on the move", REST, |case, rng| {
        let stroke = pick(rng, &cuts(case))?;
        let from = last_away(&case.rows, stroke.end)?;
        edited(case, |rows| rows[from..stroke.end].iter_mut().for_each(|row| row.knife = 0))
    }),
    damage("a drill on the move", REST, |case, rng| {
        let hole = pick(rng, &holes(&case.rows))?;
        let from = last_away(&case.rows, hole.start)?;
        edited(case, |rows| rows[from..hole.start].iter_mut().for_each(|row| row.drill = rows_drill(case, &hole)))
    }),
    damage("a drill with the knife down", REST, |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        edited(case, |rows| rows[stroke.start + 2..stroke.start + 12].iter_mut().for_each(|row| row.drill = 1))
    }),
    damage("knife down in a travel", REST, |case, rng| {
        let i = amid(case, rng)?;
        edited(case, |rows| rows[i..i + 5].iter_mut().for_each(|row| row.knife = 1))
    }),
    damage("knife up amid a cut", REST, |case, rng| {
        let stroke = pick(rng, &cuts(case))?;
        let i = last_away(&case.rows, stroke.end)? - 12;
        edited(case, |rows| rows[i..i + 6].iter_mut().for_each(|row| row.knife = 0))
    }),
    damage("a lift left out", &["verify/on-path", "verify/stray"], |case, rng| {
        let strokes = strokes(&case.rows);
        let far = |w: &&[Range<usize>]| case.rows[w[0].end].away(&case.rows[w[1].start]) > 10.0;
        let gaps: Vec<Range<usize>> = strokes.windows(2).filter(far).map(|w| w[0].end..w[1].start).collect();
        let gap = pick(rng, &gaps)?;
        edited(case, |rows| rows[gap.clone()].iter_mut().for_each(|row| row.knife = 1))
    }),
    damage("a stroke without the knife", &["verify/complete"], |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        edited(case, |rows| rows[stroke.clone()].iter_mut().for_each(|row| row.knife = 0))
    }),
    damage("C mirrored", HEADING, |case, _| {
        edited(case, |rows| rows.iter_mut().for_each(|row| row.pose[2] = -row.pose[2]))
    }),
    damage("C late", &["verify/heading", "verify/rest"], |case, _| {
        let late = |by: usize, i: usize| case.rows[i.saturating_sub(by)].pose[2];
        let errs = |by: usize| {
            (0..case.rows.len()).any(|i| case.rows[i].knife == 1 && (late(by, i) - case.rows[i].pose[2]).abs() > TWIST)
        };
        let by = (1..100).find(|&by| errs(by))?;
        edited(case, |rows| (0..rows.len()).for_each(|i| rows[i].pose[2] = late(by, i)))
    }),
    damage("a blade that lags on curves", HEADING, |case, _| {
        let rate = |i: usize| {
            let [before, behind] = [&case.rows[i.max(1) - 1], &case.rows[(i + 1).min(case.rows.len() - 1)]];
            if case.rows[i].knife == 1 { behind.pose[2] - before.pose[2] } else { 0.0 }
        };
        let greatest = (0..case.rows.len()).map(|i| rate(i).abs()).fold(0.0, f64::max);
        (greatest > WAY).then(|| {
            let lagging = |(i, row): (usize, &Row)| {
                row.turned_to(row.pose[2] - rate(i) * TWIST / greatest, &case.job.profile.knife)
            };
            print(&case.rows.iter().enumerate().map(lagging).collect::<Vec<_>>())
        })
    }),
    damage("a constant error of the blade's angle", HEADING, |case, _| Some(twisted(case, TWIST))),
    damage("a blade that cuts backwards", HEADING, |case, _| Some(twisted(case, 180.0))),
    damage("a blade across the path", HEADING, |case, _| Some(twisted(case, 90.0))),
    damage("a turn with the knife down", HEADING, |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        let knife = &case.job.profile.knife;
        let row = case.rows[stroke.end - 1];
        // There and back in 0.2 s, smooth enough for every axis.
        let turn = (0..=200).map(|i| {
            let swing = (std::f64::consts::PI * f64::from(i) / 200.0).sin().powi(4);
            row.turned_to(row.pose[2] + 2.5 * TWIST * swing, knife)
        });
        let mut rows = case.rows.clone();
        rows.splice(stroke.end..stroke.end, turn.collect::<Vec<_>>());
        renumber(&mut rows, case.job.profile.time.period());
        Some(print(&rows))
    }),
    damage("C beyond its range", &["verify/c-range"], |case, _| {
        let [least, greatest] = case.job.profile.c.range_deg?;
        edited(case, |rows| rows.iter_mut().for_each(|row| row.pose[2] += greatest - least + 360.0))
    }),
    damage("cut short between two strokes", &["verify/complete"], |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        edited(case, |rows| rows.truncate(stroke.start.max(1)))
    }),
    damage("cut short amid a stroke", END, |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        edited(case, |rows| rows.truncate(stroke.end))
    }),
    damage("cut short before the end of a lift", &["verify/dwell"], |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        edited(case, |rows| rows.truncate(stroke.end + 10))
    }),
    damage("ends with the knife down", END, |case, _| {
        edited(case, |rows| rows.last_mut().expect("a program has rows").knife = 1)
    }),
    damage("ends with a drill down", END, |case, _| {
        edited(case, |rows| rows.last_mut().expect("a program has rows").drill = 1)
    }),
    damage("a hole drilled twice", &["verify/drills"], |case, rng| {
        let hole = pick(rng, &holes(&case.rows))?;
        let mut rows = case.rows.clone();
        let again: Vec<Row> =
            std::iter::once(Row { drill: 0, ..rows[hole.start] }).chain(rows[hole.clone()].iter().copied()).collect();
        rows.splice(hole.end..hole.end, again);
        renumber(&mut rows, case.job.profile.time.period());
        Some(print(&rows))
    }),
    damage("a hole without the drill", &["verify/drills"], |case, rng| {
        let hole = pick(rng, &holes(&case.rows))?;
        edited(case, |rows| rows[hole.clone()].iter_mut().for_each(|row| row.drill = 0))
    }),
    damage("a plunge that cuts nothing new", &["verify/once"], |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        let mut rows = case.rows.clone();
        let profile = &case.job.profile;
        let ticks = |time: f64| (time / profile.time.period()).ceil() as usize;
        let rest = Row { block: 0, knife: 0, ..rows[stroke.end] };
        let mut again = vec![rest; ticks(profile.knife.lift())];
        again.extend(vec![Row { knife: 1, ..rest }; ticks(profile.knife.plunge())]);
        rows.splice(stroke.end..stroke.end, again);
        renumber(&mut rows, profile.time.period());
        Some(print(&rows))
    }),
];

/// The program with its rows changed.
#[allow(clippy::unnecessary_wraps, reason = "every way to damage may find nothing to damage")]
fn edited(case: &Case, change: impl FnOnce(&mut Vec<Row>)) -> Option<Vec<u8>> {
    let mut rows = case.rows.clone();
    change(&mut rows);
    Some(print(&rows))
}

/// A row in the midst of a travel.
fn amid(case: &Case, rng: &mut fastrand::Rng) -> Option<usize> {
    pick(rng, &travels(&case.rows)).map(|travel| travel.start + travel.len() / 3)
}

/// The strokes that a travel leads to.
fn behind_travels(case: &Case) -> Vec<Range<usize>> {
    let travels = travels(&case.rows);
    let is_behind = |stroke: &Range<usize>| travels.iter().any(|travel| stroke.start.abs_diff(travel.end) <= 2);
    strokes(&case.rows).into_iter().filter(is_behind).collect()
}

/// The strokes along which the knife is led.
fn cuts(case: &Case) -> Vec<Range<usize>> {
    let is_led = |stroke: &Range<usize>| case.rows[stroke.start].away(&case.rows[stroke.end]) > 2.0;
    strokes(&case.rows).into_iter().filter(is_led).collect()
}

/// The last row before another at which the axes are clearly elsewhere.
fn last_away(rows: &[Row], before: usize) -> Option<usize> {
    (0..before).rev().find(|&i| rows[i].away(&rows[before]) > WAY)
}

fn rows_drill(case: &Case, hole: &Range<usize>) -> u8 {
    case.rows[hole.start].drill
}

/// All blades turned about their tips.
fn twisted(case: &Case, by_deg: f64) -> Vec<u8> {
    let knife = &case.job.profile.knife;
    print(&case.rows.iter().map(|row| row.turned_to(row.pose[2] + by_deg, knife)).collect::<Vec<_>>())
}

/// One sample of an axis beside its place, far enough for its difference of an order to be three times its limit and
/// more whatever it is without.
fn spike<const AXIS: usize, const ORDER: i32>(case: &Case, rng: &mut fastrand::Rng) -> Option<Vec<u8>> {
    let i = amid(case, rng)?;
    let limits = case.job.profile.axes.limits()[AXIS];
    let limit = [limits.speed, limits.acceleration, limits.jerk][ORDER as usize - 1];
    let limit = if AXIS == 2 { limit.to_degrees() } else { limit };
    let by = 4.0 * limit * case.job.profile.time.period().powi(ORDER) + 1e-5;
    edited(case, |rows| rows[i].pose[AXIS] += by)
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
    rows::renumber(&mut quick, case.job.profile.time.period());
    quick
}
