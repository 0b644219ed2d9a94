//! Programs that were made for another machine.

use cutc::ir::marker::{Notch, OutlineNotch};
use cutc::machine::{Job, MachineProfile, NotchStyle};

use crate::support::program::setpoints;
use crate::verifier::case::Case;
use crate::verifier::harm::{Harm, Place};
use crate::verifier::measure::{
    DAMAGING, ROUNDING, SAME, axis_amount, axis_rounding, feed, greatest, once_limit, overlap_limit, passed_by,
};
use crate::verifier::rows::{Row, holes, parse, strokes};
use crate::verifier::sketch::{chain, contours, notches, turn};
use crate::verifier::{Damage, damage, scaled};

/// By how much a machine differs more from one trial to the next, and the most trials.
const STEP: f64 = 1.1;
const TRIALS: i32 = 24;
/// Places of pose, mm and degrees: three times what is allowed and the rounding.
const ELSEWHERE: f64 = DAMAGING * SAME + SAME;

/// How far ahead a knife is thought to stand, mm, and the most periods by which a dwell is too short: the least that is
/// clearly seen is taken.
const THOUGHT_AHEAD_MM: std::ops::Range<i32> = 4..16;
const SHORTER: i32 = 20;
/// By how much too far a knife goes that is never lifted, at the least, as a part of what it may.
const LONGER: f64 = 1.1;
/// By how much slits are cut too little, mm.
const SHALLOWER: f64 = 1.0;
/// Roundings of the tip's place that its speed allows for, which is computed from three numbers a row.
const PLACES_ROUNDING: f64 = 8.0;
/// What the end of a short line may be off beside the amount, mm: the blade rounds the corner.
const WIDE: f64 = 1.0;
/// More than the turn of a corner, and the most that a run can round, degrees.
const TURN_MORE_DEG: f64 = 0.01;
const BLUNT_DEG: f64 = 75.0;

pub(crate) const DAMAGES: &[Damage] = &[
    damage("V notches passed over", "verify/complete", |case, _| {
        let depth = case
            .marker
            .pieces
            .iter()
            .flat_map(|piece| &piece.outline_notches)
            .map(OutlineNotch::depth)
            .reduce(f64::min)?;
        Some(Harm::anywhere(case.on(|job| job.profile.notch.style = NotchStyle::Skip), depth))
    }),
    damage("V notches cut as slits", "verify/complete", |case, _| {
        let depth = case
            .marker
            .pieces
            .iter()
            .flat_map(|piece| &piece.outline_notches)
            .map(OutlineNotch::depth)
            .reduce(f64::min)?;
        Some(Harm::anywhere(case.on(|job| job.profile.notch.style = NotchStyle::Slit), depth / 2.0))
    }),
    damage("slits of another depth", "verify/complete", |case, _| {
        let depth = case.marker.pieces.iter().flat_map(|piece| &piece.notches).map(Notch::depth).reduce(f64::max)?;
        let program = case.on(|job| job.profile.notch.depth_mm = Some(depth - SHALLOWER));
        Some(Harm::anywhere(program, SHALLOWER - case.tolerance()))
    }),
    damage("a knife that is never lifted amid a cut", "verify/down", |case, _| {
        let longest = case.job.profile.knife.max_down_mm?;
        let program = case.on(|job| job.profile.knife.max_down_mm = None);
        (program != case.program).then(|| Harm::anywhere(program, LONGER * longest))
    }),
    damage("the yaw forgotten", "verify/heading", |case, _| {
        Some(Harm::anywhere(case.on(|job| job.profile.knife.yaw_deg = 2.0), 2.0 - 0.5))
    }),
    damage("another home", "verify/start", |case, _| home(case, 0)),
    damage("another heading at home", "verify/start", |case, _| home(case, 2)),
    damage("never parked", "verify/end", |case, _| {
        let park = case.job.profile.park?;
        let program = case.on(|job| job.profile.park = None);
        let rows = parse(&program);
        let last = rows[rows.len() - 1];
        let amount = (0..3).map(|i| (last.pose[i] - park[i]).abs()).fold(0.0, f64::max) - SAME;
        Some(Harm { program, amount, place: Place::During([last.t; 2]) })
    }),
    damage("parked elsewhere", "verify/end", |case, _| {
        let [x, y, c] = case.job.profile.park?;
        let program = case.on(|job| job.profile.park = Some([x, y + ELSEWHERE, c]));
        Some(Harm::anywhere(program, DAMAGING * SAME))
    }),
    scaled("a feed of three times", "verify/feed", |case, _, times| {
        let limit = case.job.profile.knife.feed_mm_s?;
        let amount = DAMAGING * limit + PLACES_ROUNDING * axis_rounding(case, 1);
        grown(case, (times, quicker), (|rows: &[Row]| feed(case, rows), amount))
    }),
    damage("a piece faster than the file lets it be", "verify/feed", |case, _| {
        let mut marker = case.marker.clone();
        let slowest = marker.pieces.iter_mut().filter_map(|piece| piece.feed.take()).reduce(f64::min)?;
        let mut job = case.job.clone();
        job.profile.knife.feed_mm_s = None;
        Some(Harm::anywhere(setpoints(&marker, &job), DAMAGING * slowest))
    }),
    scaled("a faster machine, as X feels it", "verify/speed-x", |case, _, times| axis::<0, 1>(case, times, quicker)),
    scaled("a faster machine, as Y feels it", "verify/speed-y", |case, _, times| axis::<1, 1>(case, times, quicker)),
    scaled("a faster machine, as C feels it", "verify/speed-c", |case, _, times| axis::<2, 1>(case, times, quicker)),
    scaled("stronger X", "verify/acceleration-x", |case, _, times| axis::<0, 2>(case, times, stronger::<0>)),
    scaled("stronger Y", "verify/acceleration-y", |case, _, times| axis::<1, 2>(case, times, stronger::<1>)),
    scaled("stronger C", "verify/acceleration-c", |case, _, times| axis::<2, 2>(case, times, stronger::<2>)),
    scaled("stiffer X", "verify/jerk-x", |case, _, times| axis::<0, 3>(case, times, stiffer::<0>)),
    scaled("stiffer Y", "verify/jerk-y", |case, _, times| axis::<1, 3>(case, times, stiffer::<1>)),
    scaled("stiffer C", "verify/jerk-c", |case, _, times| axis::<2, 3>(case, times, stiffer::<2>)),
    damage("another period", "verify/time", |case, _| {
        let end = case.rows[case.rows.len() - 1].t;
        let late = DAMAGING * ROUNDING + SAME;
        let program = case.on(|job| job.profile.time.period_ms *= 1.0 + late / end);
        Some(Harm::anywhere(program, DAMAGING * ROUNDING))
    }),
    damage("plunges too short before a cut", "verify/rest", |case, _| {
        let dwell = ticks(case, case.job.profile.knife.plunge());
        let moved = |rows: &[Row]| moved_during(rows, strokes(rows).iter().map(|stroke| stroke.start), dwell);
        shortened(case, |job, by_ms| job.profile.knife.plunge_ms -= by_ms, moved)
    }),
    damage("plunges of stabs too short", "verify/dwell", |case, _| {
        let dwell = ticks(case, case.job.profile.knife.plunge());
        let program = case.on(|job| job.profile.knife.plunge_ms -= job.profile.time.period_ms);
        let has_plunge_cuts = strokes(&parse(&program)).iter().any(|stroke| stroke.len() < dwell);
        has_plunge_cuts.then(|| Harm::anywhere(program, (1.0 - SAME) * case.job.profile.time.period()))
    }),
    damage("lifts too short", "verify/rest", |case, _| {
        let dwell = ticks(case, case.job.profile.knife.lift());
        let moved = |rows: &[Row]| moved_during(rows, strokes(rows).iter().map(|stroke| stroke.end), dwell);
        shortened(case, |job, by_ms| job.profile.knife.lift_ms -= by_ms, moved)
    }),
    damage("work of the drill too short", "verify/dwell", |case, _| {
        let program = case.on(|job| job.profile.drill.dwell_ms -= job.profile.time.period_ms);
        let amount = (1.0 - SAME) * case.job.profile.time.period();
        (!holes(&case.rows).is_empty()).then(|| Harm::anywhere(program, amount))
    }),
    scaled("a drill that stands elsewhere", "verify/drill-place", |case, _, times| {
        let reading = if times < 1.0 { 0.0 } else { SAME };
        let by = times * 2.0 * SAME + reading;
        let program = case.on(|job| job.profile.drill.offset_mm[1] += by);
        (!holes(&case.rows).is_empty()).then(|| Harm::anywhere(program, DAMAGING * 2.0 * SAME))
    }),
    damage("a blade that is thought longer in front", "verify/complete", |case, _| {
        let knife = &case.job.profile.knife;
        let amount = DAMAGING * case.job.profile.verify.max_uncut_mm;
        let by = knife.front_overlap_mm.max(knife.corner_front_overlap_mm) + amount + SAME;
        let program = case.on(|job| reground(job, [by, 0.0]));
        has_ends(case).then(|| Harm::anywhere(program, amount))
    }),
    damage("a blade that is thought shorter in front", "verify/stray", |case, _| {
        let amount = (DAMAGING - 1.0) * overlap_limit(case);
        let by = DAMAGING * overlap_limit(case) + SAME;
        let has_room = case.job.profile.knife.radius() > by && has_ends(case);
        has_room.then(|| Harm::anywhere(case.on(|job| reground(job, [-by, 0.0])), amount))
    }),
    damage("a blade that is thought longer behind", "verify/complete", |case, _| {
        let knife = &case.job.profile.knife;
        let amount = DAMAGING * case.job.profile.verify.max_uncut_mm;
        let by = knife.heel_overlap_mm.max(knife.corner_heel_overlap_mm) + amount + SAME;
        has_ends(case).then(|| Harm::anywhere(case.on(|job| reground(job, [0.0, by])), amount))
    }),
    damage("a blade that is thought shorter behind", "verify/stray", |case, _| {
        let amount = (DAMAGING - 1.0) * overlap_limit(case);
        let by = DAMAGING * overlap_limit(case) + SAME;
        let has_room = case.job.profile.knife.back() > by && has_ends(case);
        has_room.then(|| Harm::anywhere(case.on(|job| reground(job, [0.0, -by])), amount))
    }),
    damage("a knife that is thought to stand farther ahead, as a curve shows it", "verify/on-path", |case, _| {
        let amount = DAMAGING * case.tolerance();
        let program = THOUGHT_AHEAD_MM.map(|by| case.on(|job| reground(job, [f64::from(by), -f64::from(by)])));
        let off = |program: &Vec<u8>| passed_by(case, &parse(program)) > amount * STEP;
        (!has_ends(case)).then(|| program.into_iter().find(off).map(|program| Harm::anywhere(program, amount)))?
    }),
    scaled("long overlaps at ends and corners", "verify/stray", |case, _, times| {
        let front = times * overlap_limit(case) + SAME;
        let program = case.on(|job| overlapping(job, front));
        has_ends(case).then(|| Harm::anywhere(program, (DAMAGING - 1.0) * overlap_limit(case)))
    }),
    scaled("long overlaps of rings", "verify/once", |case, _, times| {
        // A ring is longer than its polygon, by less than the tolerance.
        let longer = if times < 1.0 { 0.0 } else { case.tolerance() };
        let front = times * once_limit(case) + longer;
        let program = case.on(|job| overlapping(job, front));
        (!has_ends(case)).then(|| Harm::anywhere(program, DAMAGING * once_limit(case)))
    }),
    damage("another range of C", "verify/c-range", |case, _| {
        let [least, most] = case.job.profile.c.range_deg.expect("every case has a range");
        let shift = 360.0 * ((most - least) / 360.0).ceil();
        let program = case.on(|job| {
            job.profile.c.range_deg = Some([least + shift, most + shift]);
            job.profile.home[2] += shift;
        });
        let farthest = parse(&program).iter().map(|row| row.pose[2]).fold(f64::NEG_INFINITY, f64::max);
        Some(Harm::anywhere(program, farthest - most - SAME))
    }),
    damage("a corner that is thought none", "verify/on-path", |case, _| {
        // The bluntest corner between two lines that are long enough to leave each other's extension by the amount.
        let amount = DAMAGING * case.tolerance();
        let corner = case.job.profile.corner_angle();
        let turns = case.marker.contours().flat_map(|(_, contour)| {
            let segments = chain(&case.marker, *contour);
            let far = |i: usize| segments[i].length().min(segments[i - 1].length()) * turn(&segments, i).sin();
            let corners = (1..segments.len()).filter(|i| turn(&segments, *i) > corner && far(*i) > amount + WIDE);
            corners.map(|i| turn(&segments, i)).collect::<Vec<_>>()
        });
        let bluntest = turns.fold(f64::INFINITY, f64::min).to_degrees() + TURN_MORE_DEG;
        let program = (bluntest < BLUNT_DEG).then(|| case.on(|job| job.profile.corner.angle_deg = bluntest))?;
        Some(Harm::anywhere(program, amount))
    }),
    scaled("another tube", "verify/on-path", |case, _, times| {
        let amount = DAMAGING * case.tolerance();
        let wider = |profile: &mut MachineProfile, factor: f64| {
            profile.path.tolerance_mm = Some(factor * case.tolerance());
        };
        grown(case, (times, wider), (|rows: &[Row]| passed_by(case, rows), amount))
    }),
];

/// Periods that a time takes.
fn ticks(case: &Case, time: f64) -> usize {
    (time / case.job.profile.time.period()).round() as usize
}

/// A program that starts elsewhere.
#[allow(clippy::unnecessary_wraps, reason = "every way to damage may find nothing to damage")]
fn home(case: &Case, axis: usize) -> Option<Harm> {
    let program = case.on(|job| job.profile.home[axis] += ELSEWHERE);
    Some(Harm { program, amount: DAMAGING * SAME, place: Place::During([0.0; 2]) })
}

/// Whether a line of the marker ends: what damages ends is then seen.
fn has_ends(case: &Case) -> bool {
    let is_ring = |&(piece, contour): &(usize, usize)| {
        let contour = case.marker.pieces[piece].contours[contour];
        let segments = chain(&case.marker, contour);
        contour.closed && (0..segments.len()).all(|i| turn(&segments, i) <= case.job.profile.corner_angle())
    };
    !notches(&case.marker).is_empty() || !contours(&case.marker).iter().all(is_ring)
}

/// The program of a machine that differs by a factor. A harmless one is used as it is; of the others the least by which a
/// measure of the program reaches an amount.
fn grown(
    case: &Case,
    (times, change): (f64, impl Fn(&mut MachineProfile, f64)),
    (measure, amount): (impl Fn(&[Row]) -> f64, f64),
) -> Option<Harm> {
    if times < 1.0 {
        let program = case.on(|job| change(&mut job.profile, times));
        return (program != case.program).then(|| Harm::anywhere(program, amount));
    }
    let programs = (0..TRIALS).map(|trial| case.on(|job| change(&mut job.profile, times * STEP.powi(trial))));
    programs
        .into_iter()
        .find(|program| measure(&parse(program)) >= amount)
        .map(|program| Harm::anywhere(program, amount))
}

/// A machine by which an axis feels three times its limit of an order.
fn axis<const AXIS: usize, const ORDER: u8>(
    case: &Case,
    times: f64,
    change: impl Fn(&mut MachineProfile, f64),
) -> Option<Harm> {
    let amount = axis_amount(case, AXIS, ORDER);
    let measured = |rows: &[Row]| greatest(case, rows, AXIS, ORDER) - axis_rounding(case, ORDER);
    grown(case, (times, change), (measured, amount))
}

/// A machine that does everything some times as fast: time runs faster for all derivatives.
fn quicker(profile: &mut MachineProfile, factor: f64) {
    let knife = &mut profile.knife;
    knife.feed_mm_s = knife.feed_mm_s.map(|feed| feed * factor);
    let axes = &mut profile.axes;
    for axis in [&mut axes.x, &mut axes.y] {
        axis.speed_mm_s *= factor;
        axis.acceleration_mm_s2 *= factor.powi(2);
        axis.jerk_mm_s3 *= factor.powi(3);
    }
    axes.c.speed_deg_s *= factor;
    axes.c.acceleration_deg_s2 *= factor.powi(2);
    axes.c.jerk_deg_s3 *= factor.powi(3);
}

/// An axis with another acceleration, and another jerk so that it reaches it.
fn stronger<const AXIS: usize>(profile: &mut MachineProfile, factor: f64) {
    let axes = &mut profile.axes;
    match AXIS {
        0 => axes.x.acceleration_mm_s2 *= factor,
        1 => axes.y.acceleration_mm_s2 *= factor,
        _ => axes.c.acceleration_deg_s2 *= factor,
    }
    stiffer::<AXIS>(profile, if factor < 1.0 { 1.0 } else { factor.powi(2) });
}

/// An axis with another jerk.
fn stiffer<const AXIS: usize>(profile: &mut MachineProfile, factor: f64) {
    let axes = &mut profile.axes;
    match AXIS {
        0 => axes.x.jerk_mm_s3 *= factor,
        1 => axes.y.jerk_mm_s3 *= factor,
        _ => axes.c.jerk_deg_s3 *= factor,
    }
}

/// A blade that reaches farther in front of the C axis and behind it.
fn reground(job: &mut Job, [front, behind]: [f64; 2]) {
    let knife = &mut job.profile.knife;
    let (radius, back) = (knife.radius() + front, knife.back() + behind);
    (knife.width_mm, knife.back_mm, knife.radius_mm) = (radius + back, None, Some(radius));
}

/// Another front overlap, at ends and at corners.
fn overlapping(job: &mut Job, front: f64) {
    let knife = &mut job.profile.knife;
    (knife.front_overlap_mm, knife.corner_front_overlap_mm) = (front, front);
}

/// Farthest that the axes move in the dwell behind some rows, mm and degrees.
fn moved_during(rows: &[Row], from: impl Iterator<Item = usize>, dwell: usize) -> f64 {
    let moved = |i: usize| rows.get(i + dwell).map_or(0.0, |row| row.away(&rows[i]));
    from.map(moved).fold(0.0, f64::max)
}

/// A machine with a dwell that is by so many periods shorter that the axes clearly move in the true one.
fn shortened(case: &Case, shorten: impl Fn(&mut Job, f64), moved: impl Fn(&[Row]) -> f64) -> Option<Harm> {
    let programs = (1..=SHORTER).map(|by| case.on(|job| shorten(job, f64::from(by) * job.profile.time.period_ms)));
    let amount = DAMAGING * SAME;
    programs.into_iter().find(|program| moved(&parse(program)) >= amount).map(|program| Harm::anywhere(program, amount))
}
