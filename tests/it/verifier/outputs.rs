//! Damage to the rows of a program: when the knife and the drills go up and down.

use std::ops::Range;

use cutc::geom::Point;

use crate::verifier::case::Case;
use crate::verifier::harm::{Harm, Place};
use crate::verifier::measure::{DAMAGING, SAME, STROKE_REACH, distance, once_limit};
use crate::verifier::rows::{Row, holes, pick, print, renumber, strokes, travels};
use crate::verifier::{Damage, damage};

const REST: &str = "verify/rest";
const END: &str = "verify/end";
const COMPLETE: &str = "verify/complete";
const DRILLS: &str = "verify/drills";

/// Way of an axis that is no rest, mm and degrees: three times what is allowed.
const WAY: f64 = DAMAGING * SAME;
/// Rows for which the knife touches down, or lifts, by mistake: far fewer than any plunge lasts.
const TOUCH: usize = 5;
/// Rows before the end of a cut at which the knife lifts by mistake: enough to be clearly on the move.
const BEFORE_END: usize = 12;

/// Way of a stroke along which the knife is led, mm: far more than the rows before its end.
const LED: f64 = 2.0;

pub(crate) const DAMAGES: &[Damage] = &[
    damage("a plunge on the move", REST, |case, rng| {
        let stroke = pick(rng, &behind_travels(case))?;
        let from = last_away(&case.rows, stroke.start)?;
        still(case, from..stroke.start, |row| row.knife = 1)
    }),
    damage("C late at a plunge", REST, |case, _| {
        let dwell = ticks(case, case.job.profile.knife.plunge());
        let late = |by: usize| -> Vec<Row> {
            let turned = |(i, row): (usize, &Row)| {
                let c = case.rows[i.saturating_sub(by)].pose[2];
                Row { pose: [row.pose[0], row.pose[1], c], ..*row }
            };
            case.rows.iter().enumerate().map(turned).collect()
        };
        let turns = |rows: &Vec<Row>| {
            let dwells = strokes(rows).into_iter().map(|stroke| stroke.start..=stroke.start + dwell);
            dwells.into_iter().any(|at| rows[at.clone()].iter().any(|row| row.away(&rows[*at.start()]) > WAY + SAME))
        };
        let rows = (1..=TOUCH).map(late).find(turns)?;
        Some(Harm::anywhere(print(&rows), WAY))
    }),
    damage("a lift on the move", REST, |case, rng| {
        let stroke = pick(rng, &cuts(case))?;
        let from = last_away(&case.rows, stroke.end)?;
        still(case, from..stroke.end, |row| row.knife = 0)
    }),
    damage("a drill on the move", REST, |case, rng| {
        let hole = pick(rng, &holes(&case.rows))?;
        let from = last_away(&case.rows, hole.start)?;
        let tool = case.rows[hole.start].drill;
        still(case, from..hole.start, |row| row.drill = tool)
    }),
    damage("a drill with the knife down", REST, |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        let at = stroke.start + 2..stroke.start + 2 + TOUCH;
        edited(case, (at, f64::INFINITY), |row| row.drill = 1)
    }),
    damage("knife down in a travel, on the move", REST, |case, rng| {
        let i = pick(rng, &travels(&case.rows)).map(|travel| travel.start + travel.len() / 3)?;
        still(case, i..i + TOUCH, |row| row.knife = 1)
    }),
    damage("knife down in a travel, too short for a plunge", "verify/dwell", |case, rng| {
        let i = pick(rng, &travels(&case.rows)).map(|travel| travel.start + travel.len() / 3)?;
        let profile = &case.job.profile;
        let amount = profile.knife.plunge() - (TOUCH + 1) as f64 * profile.time.period();
        edited(case, (i..i + TOUCH, amount), |row| row.knife = 1)
    }),
    damage("knife down in a travel, far from every line", "verify/stray", |case, rng| {
        let knife = &case.job.profile.knife;
        let clear = STROKE_REACH + knife.width_mm;
        let is_far = |i: &usize| (0..=TOUCH).all(|k| distance(&case.marker, case.rows[i + k].tip(knife)) > clear);
        let places: Vec<usize> = travels(&case.rows).iter().map(|travel| travel.start + travel.len() / 2).collect();
        let i = pick(rng, &places.into_iter().filter(is_far).collect::<Vec<_>>())?;
        edited(case, (i..i + TOUCH, knife.width_mm), |row| row.knife = 1)
    }),
    damage("knife up amid a cut", REST, |case, rng| {
        let stroke = pick(rng, &cuts(case))?;
        let i = last_away(&case.rows, stroke.end)?.checked_sub(BEFORE_END).filter(|i| *i > stroke.start)?;
        still(case, i..i + TOUCH, |row| row.knife = 0)
    }),
    damage("a lift left out", "verify/on-path", |case, rng| {
        let amount = DAMAGING * case.tolerance();
        let bulge = case.job.profile.path.chord_sag_max_mm;
        let [before, behind] = pick(rng, &neighbours(case, amount + bulge))?;
        let harm = edited(case, (before.end..behind.start, amount), |row| row.knife = 1)?;
        // Whichever of the two lines the stroke is taken for, it leaves the other's.
        Some(Harm { place: Place::During([case.rows[before.start].t, case.rows[behind.end].t]), ..harm })
    }),
    damage("a stroke without the knife", COMPLETE, |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        let knife = &case.job.profile.knife;
        let tips: Vec<Point> = case.rows[stroke.clone()].iter().map(|row| row.tip(knife)).collect();
        let harm = edited(case, (stroke, DAMAGING * case.job.profile.verify.max_uncut_mm), |row| row.knife = 0)?;
        Some(Harm { place: Place::Along(tips), ..harm })
    }),
    damage("cut short between two strokes", COMPLETE, |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        let amount = DAMAGING * case.job.profile.verify.max_uncut_mm;
        Some(Harm::anywhere(print(&case.rows[..stroke.start.max(1)]), amount))
    }),
    damage("cut short amid a stroke", END, |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        let place = Place::During([case.rows[stroke.end - 1].t; 2]);
        Some(Harm { program: print(&case.rows[..stroke.end]), amount: f64::INFINITY, place })
    }),
    damage("cut short a period before the end of a lift", "verify/dwell", |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        let end = stroke.end + ticks(case, case.job.profile.knife.lift());
        let amount = (1.0 - SAME) * case.job.profile.time.period();
        let place = Place::During([case.rows[stroke.end].t, case.rows[end].t]);
        Some(Harm { program: print(&case.rows[..end]), amount, place })
    }),
    damage("ends with the knife down", END, |case, _| {
        let last = case.rows.len() - 1;
        edited(case, (last..last + 1, f64::INFINITY), |row| row.knife = 1)
    }),
    damage("ends with a drill down", END, |case, _| {
        let last = case.rows.len() - 1;
        edited(case, (last..last + 1, f64::INFINITY), |row| row.drill = 1)
    }),
    damage("a hole drilled twice", DRILLS, |case, rng| {
        let hole = pick(rng, &holes(&case.rows))?;
        let mut again = vec![Row { drill: 0, ..case.rows[hole.start] }];
        again.extend_from_slice(&case.rows[hole.clone()]);
        Some(inserted(case, &again, (hole, 1.0)))
    }),
    damage("a hole without the drill", DRILLS, |case, rng| {
        let hole = pick(rng, &holes(&case.rows))?;
        let [x, y, _] = case.rows[hole.start].pose;
        let [aside, ahead] = case.job.profile.drill.offset_mm;
        let harm = edited(case, (hole, 1.0), |row| row.drill = 0)?;
        Some(Harm { place: Place::Along(vec![Point::new(x + aside, y + ahead)]), ..harm })
    }),
    damage("a plunge that cuts nothing new", "verify/once", |case, rng| {
        let stroke = pick(rng, &strokes(&case.rows))?;
        let knife = &case.job.profile.knife;
        let rest = Row { block: 0, knife: 0, ..case.rows[stroke.end] };
        let mut again = vec![rest; ticks(case, knife.lift())];
        again.extend(vec![Row { knife: 1, ..rest }; ticks(case, knife.plunge())]);
        Some(inserted(case, &again, (stroke, DAMAGING * once_limit(case))))
    }),
];

/// The program with some rows changed, which breaks a rule by an amount at their time.
#[allow(clippy::unnecessary_wraps, reason = "every way to damage may find nothing to damage")]
fn edited(case: &Case, (at, amount): (Range<usize>, f64), change: impl Fn(&mut Row)) -> Option<Harm> {
    let mut rows = case.rows.clone();
    rows[at.clone()].iter_mut().for_each(change);
    let place = Place::During([rows[at.start].t, rows[at.end.min(rows.len() - 1)].t]);
    Some(Harm { program: print(&rows), amount, place })
}

/// The program with other rows behind a stretch of it.
fn inserted(case: &Case, more: &[Row], (behind, amount): (Range<usize>, f64)) -> Harm {
    let period = case.job.profile.time.period();
    let mut rows = case.rows.clone();
    rows.splice(behind.end..behind.end, more.iter().copied());
    renumber(&mut rows, period);
    let place = Place::During([rows[behind.start].t, rows[behind.end + more.len()].t]);
    Harm { program: print(&rows), amount, place }
}

/// The program with an output that changes while the axes move: they do so by more than three times what is no motion.
fn still(case: &Case, at: Range<usize>, change: impl Fn(&mut Row)) -> Option<Harm> {
    let moved = case.rows[at.clone()].iter().map(|row| row.away(&case.rows[at.start])).fold(0.0, f64::max);
    let moved = moved.max(case.rows[at.end].away(&case.rows[at.start]));
    assert!(moved >= WAY, "{moved} is rest");
    let knife = &case.job.profile.knife;
    let dwell = ticks(case, knife.plunge().max(knife.lift()).max(case.job.profile.drill.dwell()));
    let harm = edited(case, (at.clone(), WAY), change)?;
    let end = (at.end + dwell).min(case.rows.len() - 1);
    Some(Harm { place: Place::During([case.rows[at.start].t, case.rows[end].t]), ..harm })
}

/// Periods that a time takes.
fn ticks(case: &Case, time: f64) -> usize {
    (time / case.job.profile.time.period()).round() as usize
}

/// The strokes that a travel leads to.
fn behind_travels(case: &Case) -> Vec<Range<usize>> {
    let travels = travels(&case.rows);
    let is_behind = |stroke: &Range<usize>| travels.iter().any(|travel| stroke.start.abs_diff(travel.end) <= 2);
    strokes(&case.rows).into_iter().filter(is_behind).collect()
}

/// The strokes along which the knife is led by more than the rows before their end.
fn cuts(case: &Case) -> Vec<Range<usize>> {
    let is_led = |stroke: &Range<usize>| case.rows[stroke.start].away(&case.rows[stroke.end]) > LED;
    strokes(&case.rows).into_iter().filter(is_led).collect()
}

/// The last row before another at which the axes are three times as far away as rest allows.
fn last_away(rows: &[Row], before: usize) -> Option<usize> {
    (0..before).rev().find(|&i| rows[i].away(&rows[before]) > WAY + SAME)
}

/// Strokes that follow each other, of which the middle of the way between lies farther aside than a distance: from the
/// straight extension of the line before and of the line behind.
fn neighbours(case: &Case, least: f64) -> Vec<[Range<usize>; 2]> {
    let rows = &case.rows;
    let knife = &case.job.profile.knife;
    let is_aside = |[before, behind]: &[Range<usize>; 2]| {
        let middle = rows[usize::midpoint(before.end, behind.start)].tip(knife);
        [before.end, behind.start].into_iter().all(|i| {
            let (sin, cos) = rows[i].pose[2].to_radians().sin_cos();
            let away = middle - rows[i].tip(knife);
            (cos * away.y - sin * away.x).abs() > least
        })
    };
    strokes(rows).windows(2).map(|w| [w[0].clone(), w[1].clone()]).filter(is_aside).collect()
}
