//! Damage to the rows of a program: where the blade points.

use std::ops::Range;

use crate::verifier::case::Case;
use crate::verifier::harm::{Harm, Place};
use crate::verifier::measure::{DAMAGING, heading_error};
use crate::verifier::rows::{Row, holes, parse, pick, print, renumber, strokes, travels};
use crate::verifier::{Damage, damage, scaled};

pub(crate) const HEADING: &str = "verify/heading";

/// What the blade of a sound program may seem to err by, degrees: the way of the tip is known by its rounded places.
const READING: f64 = 0.05;
/// Rows of a swing of the blade: slow enough for every axis.
const SWING: usize = 200;
/// Share of the limits of its axes that a program uses whose blade can then be turned a little and still keeps them.
const EASY: f64 = 0.5;
/// The axes of a plunge cut move less, mm and degrees.
const WAY_OF_PLUNGE_CUT: f64 = 1e-5;
/// Rows by which C may be late.
const LATE: usize = 100;

pub(crate) const DAMAGES: &[Damage] = &[
    damage("C mirrored", HEADING, |case, _| {
        let mirrored = |row: &Row| Row { pose: [row.pose[0], row.pose[1], -row.pose[2]], ..*row };
        erring(case, &case.rows.iter().map(mirrored).collect::<Vec<_>>())
    }),
    damage("C late", HEADING, |case, _| {
        let rows = &case.rows;
        let late = |by: usize| -> Vec<Row> {
            let turned = |(i, row): (usize, &Row)| {
                let c = rows[i.saturating_sub(by)].pose[2];
                Row { pose: [row.pose[0], row.pose[1], c], ..*row }
            };
            rows.iter().enumerate().map(turned).collect()
        };
        (1..LATE).step_by(3).find_map(|by| erring(case, &late(by)))
    }),
    damage("a blade that lags on curves", HEADING, |case, _| {
        let rows = &case.rows;
        let knife = &case.job.profile.knife;
        let rate = |i: usize| {
            let [before, behind] = [&rows[i.max(1) - 1], &rows[(i + 1).min(rows.len() - 1)]];
            if rows[i].knife == 1 { behind.pose[2] - before.pose[2] } else { 0.0 }
        };
        let greatest = (0..rows.len()).map(|i| rate(i).abs()).fold(0.0, f64::max);
        let twist = DAMAGING * case.job.profile.verify.max_heading_deg + 2.0 * READING;
        let lagging = |(i, row): (usize, &Row)| row.turned_to(row.pose[2] - rate(i) * twist / greatest, knife);
        (greatest > 0.0).then(|| erring(case, &rows.iter().enumerate().map(lagging).collect::<Vec<_>>()))?
    }),
    damage("a constant error of the blade's angle", HEADING, |case, _| Some(twisted(case, twist(case, DAMAGING)))),
    scaled("a blade askew along one stroke", HEADING, |case, rng, times| {
        let rows = easy(case);
        // It turns askew on the way to the stroke, and back on the way from it.
        let travels = travels(&rows);
        let holes = holes(&rows);
        let is_bare = |at: &Range<usize>| !holes.iter().any(|hole| at.contains(&hole.start));
        let lone = |w: &[Range<usize>]| {
            let led = rows[w[0].end].away(&rows[w[1].start]) > case.job.profile.knife.width_mm;
            led && strokes(&rows[w[0].start..w[1].end]).len() == 1
        };
        let between = travels.windows(2).filter(|w| is_bare(&(w[0].start..w[1].end)) && lone(w)).collect::<Vec<_>>();
        let [to, from] = pick(rng, &between)? else { return None };
        let stage = |at: &Range<usize>, i: usize| (i.saturating_sub(at.start) as f64 / at.len() as f64).min(1.0);
        let c = rows[to.end].pose[2];
        // Away from the end of the range of C.
        let twist = -twist(case, times).copysign(c);
        let turned = |(i, row): (usize, &Row)| {
            row.turned_to(row.pose[2] + twist * (fade(stage(to, i)) - fade(stage(from, i))), &case.job.profile.knife)
        };
        let program = print(&rows.iter().enumerate().map(turned).collect::<Vec<_>>());
        let amount = DAMAGING * case.job.profile.verify.max_heading_deg;
        Some(Harm { program, amount, place: Place::During([rows[to.end].t, rows[from.start].t]) })
    }),
    damage("a stab askew", HEADING, |case, rng| {
        let is_plunge_cut =
            |stroke: &Range<usize>| case.rows[stroke.start].away(&case.rows[stroke.end]) < WAY_OF_PLUNGE_CUT;
        let plunge_cuts: Vec<_> = strokes(&case.rows).into_iter().filter(is_plunge_cut).collect();
        let plunge_cut = pick(rng, &plunge_cuts)?;
        let twist = twist(case, DAMAGING);
        let turned = |(i, row): (usize, &Row)| {
            let by = if (plunge_cut.start..=plunge_cut.end).contains(&i) { twist } else { 0.0 };
            row.turned_to(row.pose[2] + by, &case.job.profile.knife)
        };
        let rows: Vec<Row> = case.rows.iter().enumerate().map(turned).collect();
        let place = Place::During([rows[plunge_cut.start].t, rows[plunge_cut.end].t]);
        Some(Harm { program: print(&rows), amount: DAMAGING * case.job.profile.verify.max_heading_deg, place })
    }),
    damage("a plunge askew on a straight line", HEADING, |case, rng| {
        // The blade plunges askew and comes straight along its width, as it may only on a curve.
        let knife = &case.job.profile.knife;
        let is_straight = |stroke: &Range<usize>| {
            let rows = &case.rows[stroke.clone()];
            let way = (rows[rows.len() - 1].tip(knife) - rows[0].tip(knife)).norm();
            rows.iter().all(|row| (row.pose[2] - rows[0].pose[2]).abs() < READING) && way > 2.0 * knife.width_mm
        };
        let straight: Vec<_> = strokes(&case.rows).into_iter().filter(is_straight).collect();
        let stroke = pick(rng, &straight)?;
        let from = case.rows[stroke.start].tip(knife);
        let twist = twist(case, DAMAGING);
        let turned = |(i, row): (usize, &Row)| {
            let way = ((row.tip(knife) - from).norm() / knife.width_mm).min(1.0);
            let by = if stroke.contains(&i) { twist * (1.0 - fade(way)) } else { 0.0 };
            row.turned_to(row.pose[2] + by, knife)
        };
        let rows: Vec<Row> = case.rows.iter().enumerate().map(turned).collect();
        let place = Place::During([rows[stroke.start].t, rows[stroke.end].t]);
        Some(Harm { program: print(&rows), amount: DAMAGING * case.job.profile.verify.max_heading_deg, place })
    }),
    damage("a blade that cuts backwards", HEADING, |case, _| Some(twisted(case, 180.0))),
    damage("a blade across the path", HEADING, |case, _| Some(twisted(case, 90.0))),
    scaled("a turn with the knife down", HEADING, |case, rng, times| {
        let profile = &case.job.profile;
        let stroke = pick(rng, &strokes(&case.rows))?;
        // The row of the lift command still is where the cut ends; the blade turns under the block that it cut there.
        let row = Row { knife: 1, block: case.rows[stroke.end - 1].block, ..case.rows[stroke.end] };
        // Away from the end of the range of C.
        let twist = -twist(case, times).copysign(row.pose[2]);
        // There and back, smooth enough for every axis.
        let turn = (0..=SWING).map(|i| {
            let swing = (std::f64::consts::PI * i as f64 / SWING as f64).sin().powi(4);
            row.turned_to(row.pose[2] + twist * swing, &profile.knife)
        });
        let mut rows = case.rows.clone();
        rows.splice(stroke.end..stroke.end, turn.collect::<Vec<_>>());
        renumber(&mut rows, profile.time.period());
        let place = Place::During([row.t, rows[stroke.end + SWING].t]);
        Some(Harm { program: print(&rows), amount: DAMAGING * profile.verify.max_heading_deg, place })
    }),
];

/// Angle of an error of some times the limit, degrees.
pub(crate) fn twist(case: &Case, times: f64) -> f64 {
    let reading = if times < 1.0 { 0.0 } else { READING };
    times * case.job.profile.verify.max_heading_deg + reading
}

/// A program of which the blade errs by three times what is allowed.
pub(crate) fn erring(case: &Case, rows: &[Row]) -> Option<Harm> {
    let amount = DAMAGING * case.job.profile.verify.max_heading_deg;
    (heading_error(case, rows) > amount + READING).then(|| Harm::anywhere(print(rows), amount))
}

/// The rows of a program that uses a part of what the axes can do.
fn easy(case: &Case) -> Vec<Row> {
    parse(&case.on(|job| {
        let axes = &mut job.profile.axes;
        for axis in [&mut axes.x, &mut axes.y] {
            axis.speed_mm_s *= EASY;
            axis.acceleration_mm_s2 *= EASY;
            axis.jerk_mm_s3 *= EASY;
        }
        axes.c.speed_deg_s *= EASY;
        axes.c.acceleration_deg_s2 *= EASY;
        axes.c.jerk_deg_s3 *= EASY;
    }))
}

/// From 0 to 1 with three derivatives that vanish at both ends.
pub(crate) fn fade(x: f64) -> f64 {
    x.powi(4) * (35.0 - x * (84.0 - x * (70.0 - x * 20.0)))
}

/// All blades turned about their tips.
fn twisted(case: &Case, by_deg: f64) -> Harm {
    let knife = &case.job.profile.knife;
    let rows: Vec<Row> = case.rows.iter().map(|row| row.turned_to(row.pose[2] + by_deg, knife)).collect();
    Harm::anywhere(print(&rows), by_deg - READING)
}
