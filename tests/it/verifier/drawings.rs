//! Programs of a marker that has more, less or in another order than the one asked for: each is sound by itself.

use cutc::geom::{Point, Vector, left};
use cutc::ir::list::Segment;
use cutc::ir::marker::{Contour, Drill};

use crate::verifier::case::{self, Case};
use crate::verifier::harm::{Harm, Place};
use crate::verifier::measure::{DAMAGING, HOLE_REACH, SAME, STROKE_REACH, distance, once_limit, overlap_limit};
use crate::verifier::rows::pick;
use crate::verifier::sketch::{
    add, along, chain, contours, drill, edited, longest, midpoint, notches, redraw, segments, slit, turn,
};
use crate::verifier::{Damage, damage, scaled};

const COMPLETE: &str = "verify/complete";
const ONCE: &str = "verify/once";
const STRAY: &str = "verify/stray";
const ORDER: &str = "verify/order";
const DRILLS: &str = "verify/drills";

/// Chord of a ring that is long enough for the gap in its midst and the overlaps beside it, mm.
const SMOOTH_CHORD: f64 = 4.0;
/// A turn that is a corner to every eye, rad.
const SHARP: f64 = 1.2;

pub(crate) const DAMAGES: &[Damage] = &[
    damage("a contour left out", COMPLETE, |case, rng| {
        let (piece, contour) = pick(rng, &contours(&case.marker))?;
        let old = case.marker.pieces[piece].contours[contour];
        let program = edited(case, |marker| {
            let _ = marker.pieces[piece].contours.remove(contour);
        });
        let amount = longest(&chain(&case.marker, old))?.length() - SAME;
        Some(Harm { program, amount, place: Place::Along(case.marker.points(&old)) })
    }),
    damage("a piece left out", COMPLETE, |case, rng| {
        let piece = rng.usize(0..case.marker.pieces.len());
        let lost = case.marker.pieces[piece].contours.iter().flat_map(|contour| chain(&case.marker, *contour));
        let longest = longest(&lost.collect::<Vec<_>>())?;
        let program = edited(case, |marker| drop(marker.pieces.remove(piece)));
        Some(Harm::anywhere(program, longest.length() - SAME))
    }),
    damage("a slit left out", COMPLETE, |case, rng| {
        let (piece, notch) = pick(rng, &notches(&case.marker))?;
        let lost = case.marker.pieces[piece].notches[notch];
        let program = edited(case, |marker| {
            let _ = marker.pieces[piece].notches.remove(notch);
        });
        Some(Harm { program, amount: lost.depth() - SAME, place: Place::Along(vec![lost.root, lost.tip]) })
    }),
    scaled("a slit too short", COMPLETE, |case, rng, times| {
        let limit = case.job.profile.verify.max_uncut_mm;
        let by = times * limit + 3.0 * SAME;
        let (old, program) = slit(case, rng, |n| n.tip -= along(n) * by)?;
        Some(Harm { program, amount: DAMAGING * limit, place: Place::Along(vec![old.root, old.tip]) })
    }),
    scaled("a slit too long", STRAY, |case, rng, times| {
        // A blade that is longer than the slit may cut on by as much as it is longer by.
        let surplus = |depth: f64| (case.job.profile.knife.width_mm - depth).max(0.0);
        let (old, _) = slit(case, &mut rng.clone(), |_| {})?;
        let limit = overlap_limit(case).max(surplus(old.depth()) + case.tolerance());
        let (old, program) = slit(case, rng, |n| n.tip += along(n) * (times * limit + 2.0 * SAME))?;
        Some(Harm { program, amount: (DAMAGING - 1.0) * limit, place: Place::Along(vec![old.root, old.tip]) })
    }),
    scaled("a start left uncut", COMPLETE, |case, rng, times| {
        let limit = case.job.profile.verify.max_uncut_mm;
        let reach = times * limit + SAME + case.job.profile.knife.heel_overlap_mm;
        let at_corner = |segments: &[Segment], i: usize| turn(segments, i) > case.job.profile.corner_angle();
        gap(case, rng, (at_corner, |_| [0.0, reach]))
    }),
    scaled("an end left uncut", COMPLETE, |case, rng, times| {
        let limit = case.job.profile.verify.max_uncut_mm;
        let reach = times * limit + SAME + case.job.profile.knife.front_overlap_mm;
        let at_end = |segments: &[Segment], i: usize| turn(segments, i + 1) > case.job.profile.corner_angle();
        gap(case, rng, (at_end, |length| [length - reach, length]))
    }),
    scaled("a gap amid a line", COMPLETE, |case, rng, times| {
        let knife = &case.job.profile.knife;
        let limit = case.job.profile.verify.max_uncut_mm;
        let reach = times * limit + SAME + knife.heel_overlap_mm + knife.front_overlap_mm;
        // Amid a smooth contour the blade would plunge as a chord of it, which is a harm of its own.
        let least = if times < 1.0 { 3.0 * knife.width_mm } else { 0.0 };
        let fits = |segments: &[Segment], i: usize| segments[i].length() > least;
        gap(case, rng, (fits, |length| [0.5 * (length - reach), 0.5 * (length + reach)]))
    }),
    damage("another marker", COMPLETE, |case, _| {
        let others = case::names();
        let place = others.iter().position(|&name| name == case.name).expect("a case has a name");
        let program = case.redrawn(&case::marker(others[(place + 1) % others.len()], &case.job));
        Some(Harm::anywhere(program, DAMAGING * case.job.profile.verify.max_uncut_mm))
    }),
    damage("a contour cut twice", ONCE, |case, rng| again(case, rng, |contour| contour)),
    damage("a contour cut there and back", ONCE, |case, rng| {
        again(case, rng, |contour| Contour { range: contour.range.reversed(), ..contour })
    }),
    damage("a slit cut twice", ONCE, |case, rng| {
        let (piece, notch) = pick(rng, &notches(&case.marker))?;
        let program = edited(case, |marker| {
            let again = marker.pieces[piece].notches[notch];
            marker.pieces[piece].notches.insert(notch, again);
        });
        let twice = case.marker.pieces[piece].notches[notch];
        Some(Harm { program, amount: DAMAGING * once_limit(case), place: Place::Along(vec![twice.root, twice.tip]) })
    }),
    damage("a cut that is in no marker", STRAY, |case, _| {
        let width = case.job.profile.knife.width_mm;
        let far = STROKE_REACH + width;
        let from = case.marker.extent().max + Vector::new(far, far);
        strays(case, &[from, from + Vector::new(2.0 * width, 0.0)])
    }),
    damage("a cut along a line, too far beside to be one of it", STRAY, |case, rng| {
        let width = case.job.profile.knife.width_mm;
        let aside = STROKE_REACH + case.tolerance();
        let long = segments(&case.marker).into_iter().filter(|segment| segment.length() > 3.0 * width);
        let beside = long.map(|segment| {
            let along = (segment.to - segment.from).normalize();
            let from = segment.from + along * width + left(along) * aside;
            [from, from + along * width]
        });
        // Nothing else may be near: not where the blade starts, not where it ends.
        let free = |[from, to]: &[Point; 2]| {
            let along = (to - from).normalize() * width;
            [from - along, *from, midpoint(*from, *to), *to, to + along]
                .iter()
                .all(|point| distance(&case.marker, *point) > STROKE_REACH + 0.5 * case.tolerance())
        };
        strays(case, &pick(rng, &beside.filter(free).collect::<Vec<_>>())?)
    }),
    scaled("a line cut on beyond its end", STRAY, |case, rng, times| {
        let (piece, contour) = pick(rng, &contours(&case.marker))?;
        let segments = chain(&case.marker, case.marker.pieces[piece].contours[contour]);
        let least = case.job.profile.knife.width_mm + overlap_limit(case);
        let corners: Vec<usize> =
            (0..segments.len()).filter(|&i| turn(&segments, i + 1) > SHARP && segments[i].length() > least).collect();
        let i = pick(rng, &corners)?;
        // The overlap comes on top of that, but for an end that then lies in another part.
        let front = case.job.profile.knife.front_overlap_mm;
        let on = (times * overlap_limit(case) + SAME - front).max(SAME);
        let along = (segments[i].to - segments[i].from).normalize();
        let mut longer: Vec<Segment> = segments[i + 1..].iter().chain(&segments[..=i]).copied().collect();
        longer.last_mut().expect("a contour has segments").to += along * on;
        let program = edited(case, |marker| redraw(marker, [piece, contour], longer));
        let amount = (DAMAGING - 1.0) * overlap_limit(case) - front;
        Some(Harm { program, amount, place: Place::Along(vec![segments[i].to]) })
    }),
    damage("pieces in another order", ORDER, |case, _| {
        let several = case.marker.pieces.len() > 1;
        several.then(|| Harm::anywhere(edited(case, |marker| marker.pieces.swap(0, 1)), 1.0))
    }),
    damage("contours in another order", ORDER, |case, rng| {
        let several: Vec<usize> =
            (0..case.marker.pieces.len()).filter(|&i| case.marker.pieces[i].contours.len() > 1).collect();
        let piece = pick(rng, &several)?;
        Some(Harm::anywhere(edited(case, |marker| marker.pieces[piece].contours.reverse()), 1.0))
    }),
    damage("a hole left out", DRILLS, |case, rng| {
        let (lost, program) = drill(case, rng, |drills, i| {
            let _ = drills.remove(i);
        })?;
        Some(Harm { program, amount: 1.0, place: Place::Along(vec![lost.at]) })
    }),
    damage("a hole too many", DRILLS, |case, rng| {
        let aside = Vector::new(HOLE_REACH + SAME, 0.0);
        let more = |drills: &mut Vec<Drill>, i: usize| drills.push(Drill { at: drills[i].at + aside, ..drills[i] });
        let (_, program) = drill(case, rng, more)?;
        Some(Harm::anywhere(program, 1.0))
    }),
    scaled("a hole beside its place", "verify/drill-place", |case, rng, times| {
        let rounding = if times < 1.0 { 0.0 } else { SAME };
        let by = times * 2.0 * SAME + rounding;
        let (hole, program) = drill(case, rng, |drills, i| drills[i].at += Vector::new(by, 0.0))?;
        let [x, y] = case.job.profile.drill.offset_mm;
        // A row is where the C axis is.
        Some(Harm { program, amount: DAMAGING * 2.0 * SAME, place: Place::Along(vec![hole.at - Vector::new(x, y)]) })
    }),
    damage("a hole too far from its place to be the same", DRILLS, |case, rng| {
        let (_, program) = drill(case, rng, |drills, i| drills[i].at += Vector::new(HOLE_REACH + SAME, 0.0))?;
        Some(Harm::anywhere(program, 2.0))
    }),
    damage("a hole of another drill", DRILLS, |case, rng| {
        let (_, program) = drill(case, rng, |drills, i| drills[i].tool = 5 - drills[i].tool)?;
        Some(Harm::anywhere(program, 2.0))
    }),
];

/// A contour, and the same once more in the same or another way; long enough for that to be three times what overlaps.
fn again(case: &Case, rng: &mut fastrand::Rng, way: impl Fn(Contour) -> Contour) -> Option<Harm> {
    let amount = DAMAGING * once_limit(case);
    let is_long = |&(piece, contour): &(usize, usize)| {
        let segments = chain(&case.marker, case.marker.pieces[piece].contours[contour]);
        longest(&segments).is_some_and(|longest| longest.length() > amount)
    };
    let long: Vec<_> = contours(&case.marker).into_iter().filter(is_long).collect();
    let (piece, contour) = pick(rng, &long)?;
    let old = case.marker.pieces[piece].contours[contour];
    let program = edited(case, |marker| marker.pieces[piece].contours.insert(contour, way(old)));
    Some(Harm { program, amount, place: Place::Along(case.marker.points(&old)) })
}

/// The program with a cut that belongs to no line.
#[allow(clippy::unnecessary_wraps, reason = "every way to damage may find nothing to damage")]
fn strays(case: &Case, points: &[Point]) -> Option<Harm> {
    let program = edited(case, |marker| add(marker, points));
    Some(Harm { program, amount: case.job.profile.knife.width_mm, place: Place::Along(points.to_vec()) })
}

/// Leaves a stretch of one segment of a closed contour out: it then is an open contour. The segment fits, and the stretch
/// is known from its length.
fn gap(
    case: &Case,
    rng: &mut fastrand::Rng,
    (fits, out): (impl Fn(&[Segment], usize) -> bool, impl Fn(f64) -> [f64; 2]),
) -> Option<Harm> {
    let mut places = Vec::new();
    for (piece, contour) in contours(&case.marker) {
        let segments = chain(&case.marker, case.marker.pieces[piece].contours[contour]);
        if case.marker.pieces[piece].contours[contour].closed {
            // Beside a short line between corners the blade, which is longer, would cut the gap with its body.
            let smooth = (0..segments.len()).all(|i| turn(&segments, i) < case.job.profile.corner_angle());
            let least = if smooth { SMOOTH_CHORD } else { 3.0 * case.job.profile.knife.width_mm };
            let long = (0..segments.len()).filter(|&i| segments[i].length() > least && fits(&segments, i));
            places.extend(long.map(|i| (piece, contour, i)));
        }
    }
    let (piece, contour, i) = pick(rng, &places)?;
    let segments = chain(&case.marker, case.marker.pieces[piece].contours[contour]);
    let whole = segments[i];
    let along = (whole.to - whole.from) / whole.length();
    let [from, to] = out(whole.length());
    let mut open = Vec::new();
    if to < whole.length() {
        open.push(Segment { from: whole.from + along * to, ..whole });
    }
    open.extend(segments[i + 1..].iter().chain(&segments[..i]));
    if from > 0.0 {
        open.push(Segment { to: whole.from + along * from, ..whole });
    }
    let place = Place::Along(vec![whole.from + along * from, whole.from + along * to]);
    let program = edited(case, |marker| redraw(marker, [piece, contour], open));
    Some(Harm { program, amount: DAMAGING * case.job.profile.verify.max_uncut_mm, place })
}
