//! Programs that were made for another machine.

use crate::{Damage, damage};

pub(crate) const DAMAGES: &[Damage] = &[
    damage("another home", &["verify/start"], |case, _| Some(case.on(|job| job.profile.home[0] += 3.0))),
    damage("another heading at home", &["verify/start"], |case, _| Some(case.on(|job| job.profile.home[2] += 3.0))),
    damage("never parked", &["verify/end"], |case, _| Some(case.on(|job| job.profile.park = None))),
    damage("parked elsewhere", &["verify/end"], |case, _| {
        Some(case.on(|job| job.profile.park = job.profile.park.map(|[x, y, c]| [x, y + 3.0, c])))
    }),
    damage("another knife", &["verify/on-path", "verify/complete", "verify/stray"], |case, _| {
        Some(case.on(|job| {
            let knife = &mut job.profile.knife;
            (knife.radius_mm, knife.back_mm) = (Some(knife.radius() + 2.0), None);
        }))
    }),
    damage("faster than the feed", &["verify/feed"], |case, _| {
        Some(case.on(|job| job.profile.knife.feed_mm_s = job.profile.knife.feed_mm_s.map(|feed| 3.0 * feed)))
    }),
    damage("faster axes", &["verify/speed-x", "verify/speed-y", "verify/speed-c"], |case, _| {
        Some(case.on(|job| {
            let axes = &mut job.profile.axes;
            (axes.x.speed_mm_s, axes.y.speed_mm_s, axes.c.speed_deg_s) = (3600.0, 3600.0, 3240.0);
        }))
    }),
    damage("stronger axes", &["verify/acceleration-x", "verify/acceleration-y", "verify/acceleration-c"], |case, _| {
        Some(case.on(|job| {
            let axes = &mut job.profile.axes;
            (axes.x.acceleration_mm_s2, axes.y.acceleration_mm_s2) = (24_000.0, 24_000.0);
            axes.c.acceleration_deg_s2 = 60_000.0;
        }))
    }),
    damage("stiffer X", &["verify/jerk-x"], |case, _| Some(case.on(|job| job.profile.axes.x.jerk_mm_s3 *= 3.0))),
    damage("stiffer Y", &["verify/jerk-y"], |case, _| Some(case.on(|job| job.profile.axes.y.jerk_mm_s3 *= 3.0))),
    damage("stiffer C", &["verify/jerk-c"], |case, _| Some(case.on(|job| job.profile.axes.c.jerk_deg_s3 *= 3.0))),
    damage("another period", &["verify/time"], |case, _| Some(case.on(|job| job.profile.time.period_ms *= 0.5))),
    damage("short plunges", &["verify/rest", "verify/dwell"], |case, _| {
        Some(case.on(|job| job.profile.knife.plunge_ms -= 20.0))
    }),
    damage("short lifts", &["verify/rest", "verify/dwell"], |case, _| {
        Some(case.on(|job| job.profile.knife.lift_ms -= 20.0))
    }),
    damage("short work of the drill", &["verify/dwell"], |case, _| {
        let has_drills = case.marker.pieces.iter().any(|piece| !piece.drills.is_empty());
        has_drills.then(|| case.on(|job| job.profile.drill.dwell_ms -= 20.0))
    }),
    damage("a drill that stands elsewhere", &["verify/drill-place", "verify/drills"], |case, _| {
        let has_drills = case.marker.pieces.iter().any(|piece| !piece.drills.is_empty());
        has_drills.then(|| case.on(|job| job.profile.drill.offset_mm[1] += 2.0))
    }),
    damage("long overlaps", &["verify/stray", "verify/once"], |case, _| {
        Some(case.on(|job| {
            let knife = &mut job.profile.knife;
            (knife.front_overlap_mm, knife.corner_front_overlap_mm) = (5.0, 5.0);
        }))
    }),
    damage("another range of C", &["verify/c-range"], |case, _| {
        let [least, greatest] = case.job.profile.c.range_deg.expect("every case has a range");
        let shift = 360.0 * ((greatest - least) / 360.0).ceil();
        Some(case.on(|job| {
            job.profile.c.range_deg = Some([least + shift, greatest + shift]);
            job.profile.home[2] += shift;
        }))
    }),
    damage("a lower limit of corners", &["verify/complete", "verify/on-path", "verify/stray"], |case, _| {
        // Corners that a run rounds, which should be cut to their point.
        let finest = case.on(|job| job.profile.corner.angle_deg = 85.0);
        (finest != case.program).then_some(finest)
    }),
    damage("a wider tube", &["verify/on-path"], |case, _| {
        let program = case.on(|job| job.profile.path.tolerance_mm = Some(6.0 * case.tolerance()));
        (program != case.program).then_some(program)
    }),
];
